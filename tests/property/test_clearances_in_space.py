"""Least distances of parts in space: against closed forms, and against many poses computed without the package's own.

Evidence: a box that passes a box at a known gap; a bar that turns beside a wall; two boxes through each other by a
known volume; a bar on random cranks above a floor, its corners posed by scipy at 12,000 angles.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ilmek.elements.materials import MATERIALS
from ilmek.part.approach_search import TOLERANCE
from ilmek.part.clearances import approaches
from ilmek.part.contacts import contacts, groups
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, bar, box, rectangle
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle
from ilmek.report.scene import SceneMotion
from ilmek.units import mm, turn

STEEL = MATERIALS["structural steel"]
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def cube(name, side=20 * mm):
    return Part(name, name, "machined link", box(side, side, side), STEEL)


def body(name, part, *, at=(0.0, 0.0, 0.0), parent="", motion=None, axis=Z):
    joint = Joint(JointKind.PIN, axis, motion)
    return RigidBody(name, (Occurrence(part),), parent, joint, (placement(*at),))


def sliding(*shifts, drive="row"):
    angle = np.linspace(0.0, turn, len(shifts))
    return SceneMotion(drive, angle, np.array(shifts, dtype=float), np.zeros(len(shifts)))


def turning(turns=1.0, samples=2):
    angle = np.linspace(0.0, turn, samples)
    return SceneMotion("row", angle, np.zeros((samples, 3)), turns * angle)


@settings(max_examples=15, deadline=None)
@given(gap=st.floats(0.5, 8.0), run=st.floats(0.1, 2.0))
def test_a_cube_that_passes_another_comes_as_near_as_its_track(gap, run):
    """The track is shorter than its samples' step: only what lies between them is near."""
    apart = 20 * mm + gap * mm
    tree = Tree(
        (
            body("wall", cube("a/wall")),
            body("slide", cube("b/slide"), at=(-run, apart, 0.0), motion=sliding((0, 0, 0), (2 * run, 0, 0)), axis=X),
        )
    )
    (near,) = approaches(tree, "row", 10 * mm, required=lambda *_: 10 * mm)
    assert near.distance == pytest.approx(gap * mm, abs=TOLERANCE)
    assert abs(near.angle / turn - 0.5) < 0.6 * 20 * mm / run


@pytest.mark.parametrize("gap", [-1.0, 0.6, 3.0])
def test_a_bar_that_turns_comes_as_near_as_its_end(gap):
    """The end of a bar of length L, turned about its other end, is at L from the axis."""
    length, half = 200 * mm, 5 * mm
    lever = Part("a/lever", "lever", "machined link", box(2 * half, 2 * half, length), STEEL)
    wall = Part("b/wall", "wall", "machined link", box(400 * mm, 10 * mm, 400 * mm), STEEL)
    along_y = placement(about=X, angle=-math.pi / 2)
    arm = RigidBody("arm", (Occurrence(lever, (along_y,)),), joint=Joint(JointKind.PIN, Z, turning()))
    reach = math.hypot(length, half)
    plate = body("plate", wall, at=(0.0, reach + 5 * mm + gap * mm, -200 * mm))
    (near,) = approaches(Tree((arm, plate)), "row", 10 * mm, required=lambda *_: 10 * mm)
    if gap > 0:
        assert near.distance == pytest.approx(gap * mm, abs=TOLERANCE)
    else:
        assert near.distance < 0
        assert near.volume > 0


@settings(max_examples=10, deadline=None)
@given(gap=st.floats(0.5, 8.0), run=st.floats(0.1, 1.0), number=st.integers(2, 4), turned=st.floats(-math.pi, math.pi))
def test_bodies_on_several_carriers_come_as_near_as_on_one(gap, run, number, turned):
    """A cube passes another one on each carrier; carriers stand turned and far apart, and none meets another's."""
    places = tuple(placement(3.0 * k, about=Z, angle=k * turned) for k in range(number))
    apart = 20 * mm + gap * mm
    tree = Tree(
        (
            RigidBody("carrier", (), "", Joint(), places),
            body("wall", cube("a/wall"), parent="carrier"),
            body(
                "slide",
                cube("b/slide"),
                at=(-run, apart, 0.0),
                parent="carrier",
                motion=sliding((0, 0, 0), (2 * run, 0, 0)),
                axis=X,
            ),
        )
    )
    (near,) = approaches(tree, "row", 10 * mm, required=lambda *_: 10 * mm)
    assert near.distance == pytest.approx(gap * mm, abs=TOLERANCE)
    beside = Tree((*tree.bodies, body("last", cube("c/last"), at=(3.0 * (number - 1), 0.0, 20 * mm))))
    assert {one.bodies for one in approaches(beside, "row", 10 * mm)} == {("wall", "slide"), ("slide", "last")}


@settings(max_examples=20, deadline=None)
@given(depth=st.floats(0.6, 10.0))
def test_what_two_cubes_have_in_common(depth):
    """V = s² d, mean depth 2 V / A with A = 2 s² + 4 s d."""
    side, deep = 20 * mm, depth * mm
    tree = Tree((body("one", cube("a/one")), body("two", cube("b/two"), at=(side - deep, 0.0, 0.0))))
    assert approaches(tree, "row", 10 * mm) == ()
    (near,) = contacts(tree).through
    assert near.drive == ""
    assert near.volume == pytest.approx(side**2 * deep, rel=1e-4)
    assert -near.distance == pytest.approx(2 * side**2 * deep / (2 * side**2 + 4 * side * deep), rel=1e-4)


@pytest.mark.parametrize("run", [None, 0.0, 5 * mm])
def test_a_part_wholly_inside_another_is_through_it(run):
    """Its surface is nowhere near that of the other: only the volume in common tells."""
    small, large = cube("a/small"), cube("b/large", side=100 * mm)
    shift = None if run is None else sliding((0, 0, 0), (0, 0, run))
    tree = Tree((body("small", small, at=(0.0, 0.0, 40 * mm), motion=shift), body("large", large)))
    (near,) = approaches(tree, "row", 10 * mm) if run else contacts(tree).through
    assert near.volume == pytest.approx((20 * mm) ** 3, rel=1e-4)


@settings(max_examples=10, deadline=None)
@given(moved=st.integers(0, 59), out=st.floats(1.0, 4.0), across=st.booleans())
def test_one_of_a_row_of_many_that_is_moved_into_its_bar_or_its_neighbour_is_found(moved, out, across):
    """Sixty discs on a round bar with 1 mm between them: each lies alike to the bar but for its place along it."""
    disc = Prism(Profile(circle(0j, 30 * mm), (circle(0j, 10 * mm),)), 5 * mm)
    part, rod = Part("a/disc", "disc", "laser-cut part", disc, STEEL), bar(20 * mm, 400 * mm)
    places = [[0.0, 0.0, 6 * mm * k] for k in range(60)]

    def through():
        discs = Occurrence(part, tuple(placement(*at) for at in places))
        long = Occurrence(Part("b/bar", "bar", "turned part", rod, STEEL), (placement(z=-20 * mm),))
        return {pair.parts for pair in contacts(Tree((RigidBody("shaft", (long, discs)),))).through}

    assert through() == set()
    places[moved][0 if across else 2] += (out if across else 1.0 + out) * mm
    if across:
        assert through() == {("b/bar", "a/disc")}
    elif moved < 59:
        assert through() == {("a/disc", "a/disc")}


@given(pitch=st.floats(31.0, 70.0), first=st.floats(-4.0, 4.0))
@settings(max_examples=20, deadline=None)
def test_blocks_of_another_pitch_meet_those_of_a_row_of_many_that_their_places_say(pitch, first):
    """Intervals of 4 and 6 mm overlap where their middles are nearer than 5 mm; 0.1 mm on the average is a touch."""
    row, blocks = 10.0 * np.arange(60), first + pitch * np.arange(8)
    pin, block = Part("a/pin", "pin", "machined link", box(4 * mm, 4 * mm, 4 * mm), STEEL), cube("b/block", 6 * mm)
    parts = ((pin, row), (block, blocks))
    occurrences = tuple(Occurrence(part, tuple(placement(x * mm) for x in xs)) for part, xs in parts)
    found = contacts(Tree((RigidBody("beam", occurrences),)))
    apart = np.abs(row[:, None] - blocks).ravel()
    number = sum(set(one.parts) == {"a/pin", "b/block"} for one in found.through)
    assert np.count_nonzero(apart < 4.85) <= number <= np.count_nonzero(apart < 4.95)


@settings(max_examples=15, deadline=None)
@given(gap=st.floats(0.3, 6.0), eccentric=st.floats(0.0, 30.0))
def test_a_roller_that_turns_beside_a_wall_comes_as_near_as_its_eccentricity(gap, eccentric):
    """A disc of radius r about an axis e beside its own reaches r + e."""
    roller = Part("a/roller", "roller", "turned part", bar(40 * mm, 20 * mm), STEEL)
    wall = Part("b/wall", "wall", "machined link", box(10 * mm, 400 * mm, 400 * mm), STEEL)
    turned = Joint(JointKind.PIN, Z, turning())
    shaft = RigidBody("shaft", (Occurrence(roller, (placement(eccentric * mm),)),), joint=turned)
    far = 20 * mm + eccentric * mm + gap * mm + 5 * mm
    tree = Tree((shaft, body("wall", wall, at=(far, 0.0, -200 * mm))))
    (near,) = approaches(tree, "row", 10 * mm, required=lambda *_: 10 * mm)
    assert near.distance == pytest.approx(gap * mm, abs=TOLERANCE)


def test_a_pin_in_its_bore_touches_and_a_part_moved_by_a_millimetre_is_found():
    """Facets of a pin in those of its bore are no overlap; a plate 1 mm into its neighbour is."""
    eye = Part(
        "a/eye",
        "eye",
        "laser-cut part",
        Prism(Profile(rectangle(60 * mm, 30 * mm), (circle(0j, 10 * mm),)), 10 * mm),
        STEEL,
    )
    pin = Part("b/pin", "pin", "turned part", bar(20 * mm, 30 * mm), STEEL)

    def nearest(shift):
        tree = Tree((body("eye", eye, motion=turning()), body("pin", pin, at=(shift, 0.0, -10 * mm))))
        return approaches(tree, "row", 5 * mm)[0].distance

    assert nearest(0.0) == 0.0
    assert nearest(1 * mm) < 0


@settings(max_examples=5, deadline=None)
@given(
    turns=st.tuples(st.integers(-2, 2), st.integers(-2, 2)).filter(any),
    arm=st.floats(30.0, 80.0),
    height=st.floats(150.0, 250.0),
)
def test_a_crank_chain_is_nowhere_nearer_than_found(turns, arm, height):
    """A bar on a crank above a plane: its corners posed here, 12,000 times.

    A corner is lowered by at most a = 0.090 m 2² + 0.061 m 4² per rad²; between two of so many angles, which are
    0.5 mrad apart, it is at most a / 8 (0.5 mrad)² = 0.05 um lower than at these.
    """
    bar_part = Part("a/bar", "bar", "machined link", box(10 * mm, 10 * mm, 60 * mm), STEEL)
    crank = Part("a/crank", "crank", "machined link", box(10 * mm, 10 * mm, 10 * mm), STEEL)
    floor = Part("b/floor", "floor", "machined link", box(600 * mm, 600 * mm, 10 * mm), STEEL)
    tree = Tree(
        (
            body("crank", crank, at=(0.0, 0.0, height * mm), motion=turning(turns[0]), axis=X),
            body("bar", bar_part, at=(0.0, arm * mm, 0.0), parent="crank", motion=turning(turns[1]), axis=X),
            body("floor", floor, at=(0.0, 0.0, -10 * mm)),
        )
    )
    required = 500 * mm
    near = [pair for pair in approaches(tree, "row", required, required=lambda *_: required) if "bar" in pair.bodies]
    (pair,) = (pair for pair in near if "floor" in pair.bodies)
    corners = np.array([[x, y, z] for x in (-5, 5) for y in (-5, 5) for z in (0, 60)]) * mm
    angle = np.linspace(0.0, turn, 12001)
    carried = Rotation.from_rotvec(np.outer(turns[0] * angle, X))
    own = Rotation.from_rotvec(np.outer(turns[1] * angle, X))
    lowest = min(
        carried.apply(own.apply(corner) + np.array([0.0, arm * mm, 0.0]))[:, 2].min() + height * mm
        for corner in corners
    )
    assert lowest > 0
    assert lowest - 1e-6 <= pair.distance <= lowest + TOLERANCE


@settings(max_examples=20, deadline=None)
@given(number=st.integers(2, 12), gone=st.integers(0, 11), lifted=st.floats(0.3, 5.0))
def test_a_row_of_cubes_is_one_group_until_one_is_gone_or_lifted(number, gone, lifted):
    part = cube("a/cube")

    def row(*positions):
        return Tree((RigidBody("row", (Occurrence(part, tuple(placement(*at) for at in positions)),)),))

    side, gone = 20 * mm, gone % number
    every = [(k * side, 0.0, 0.0) for k in range(number)]
    (whole,) = groups(row(*every))
    assert whole.parts == {"a/cube": number}
    left = [at for k, at in enumerate(every) if k != gone]
    assert len(groups(row(*left))) == len({k > gone for k in range(number) if k != gone})
    raised = [(x, y, side + lifted * mm if k == gone else z) for k, (x, y, z) in enumerate(every)]
    assert [group.pieces for group in groups(row(*raised))][-1] == 1
