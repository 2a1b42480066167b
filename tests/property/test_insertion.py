"""Straight moves and orders of assembly against what can be said without a search: boxes, sleeves, closed frames."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold, Mesh

from ilmek.elements.materials import MATERIALS
from ilmek.elements.retaining_rings import retaining_ring
from ilmek.part.colliders import collider
from ilmek.part.insertion import Insertion, insertions
from ilmek.part.insertion_units import InsertedUnit, units_of
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.shapes import Placed, Shape, Sum, bar, box, tube
from ilmek.part.straight_moves import FIT, MovedSolids, fitted, meets, offset
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.solids import volume
from ilmek.units import mm

STEEL = MATERIALS["structural steel"]
UP = np.array([0.0, 0.0, 1.0])


def part(name: str, shape: Shape) -> Part:
    return Part(name, name, "machined link", shape=shape, material=STEEL)


def body(name: str, shape: Shape, position: Placement = IDENTITY, kind: JointKind = JointKind.FIXED) -> RigidBody:
    return RigidBody(name, (Occurrence(part(f"{name}-part", shape), (position,)),), joint=Joint(kind))


def names(steps: tuple[Insertion, ...]) -> list[str]:
    return ["+".join(unit.name for unit in step.units) for step in steps]


def blocked(steps: tuple[Insertion, ...]) -> dict[str, list[str]]:
    return {step.units[0].name: [unit.name for unit in step.blocking] for step in steps if step.blocking}


@given(st.floats(5e-3, 0.5), st.floats(5e-3, 0.5), st.floats(-2e-4, 2e-4))
def test_offset_boxes_and_bars_have_the_volume_of_smaller_ones(width: float, length: float, by: float) -> None:
    made = offset(collider(box(width, width, length)).solid, by)
    assert volume(made) == pytest.approx((width + 2 * by) ** 2 * (length + 2 * by), rel=1e-5)
    round_ = offset(collider(bar(width, length)).solid, by)
    ideal = math.pi / 4 * (width + 2 * by) ** 2 * (length + 2 * by)
    assert volume(round_) == pytest.approx(ideal, rel=0.2 * mm / width * 4 + 1e-3)


@settings(max_examples=150)
@given(st.lists(st.floats(-0.08, 0.08), min_size=3, max_size=3), st.lists(st.floats(-1, 1), min_size=3, max_size=3))
def test_a_straight_move_meets_what_its_swept_hull_meets(place: list[float], along: list[float]) -> None:
    """By manifold3d: the hull of a box at both ends of its move is what it sweeps."""
    move = 0.2 * np.array(along)
    first, other = fitted(box(0.03, 0.02, 0.04).mesh(), -FIT), fitted(box(0.05, 0.01, 0.02).mesh(), -FIT)
    moving, standing = MovedSolids([(first, IDENTITY)]), MovedSolids([(other, placement(*place))])
    points = np.concatenate([first.solid.points, first.solid.points + move])
    swept = Manifold.hull_points(points)
    there = other.solid.points + np.array(place)
    solid = Manifold(Mesh(there.astype(np.float32), other.solid.triangles.astype(np.uint32)))
    inside = Manifold.hull_points(first.solid.points) ^ solid
    common = (swept ^ solid).volume()
    if inside.volume() > 0 or 0 < common < 1e-9:
        return  # they are in each other, or touch
    assert meets(moving, standing, move) == (common > 0)


def test_a_pin_comes_into_its_bore_along_its_axis_only() -> None:
    sleeve, pin = body("sleeve", tube(0.04, 0.01, 0.05)), body("pin", bar(0.02, 0.07), kind=JointKind.PIN)
    first, second = insertions(Tree((sleeve, pin)), UP)
    assert names((first, second)) == ["sleeve", "pin"]
    assert not first.moves
    (move,) = second.moves
    assert move[:2] == pytest.approx([0.0, 0.0])
    assert move[2] < 0  # from above: nothing comes through the floor
    assert [unit.name for unit in second.onto] == ["sleeve"]


def closed_box() -> Shape:
    """Four walls, a floor and a lid."""
    walls = [Placed(box(0.1, 0.01, 0.1), (placement(y=y),)) for y in (-0.045, 0.045)]
    ends = [Placed(box(0.01, 0.08, 0.1), (placement(x=x),)) for x in (-0.045, 0.045)]
    lids = [Placed(box(0.1, 0.1, 0.01), (placement(z=z),)) for z in (-0.01, 0.1)]
    return Sum((*walls, *ends, *lids))


def test_what_is_closed_in_fails_with_what_is_in_its_way() -> None:
    tree = Tree((body("case", closed_box()), body("ball", box(0.02, 0.02, 0.02), kind=JointKind.SLIDE)))
    assert blocked(insertions(tree, UP, frozenset(("case",)))) == {"ball": ["case"]}


def frame(*, closed: bool) -> tuple[RigidBody, ...]:
    """A floor with two brackets in which a shaft with flanges turns, their slots open to +x or closed."""
    floor = body("frame", box(0.3, 0.6, 0.02), placement(z=-0.12))
    shapes = []
    for y in (-0.2, 0.2):
        low, high = box(0.1, 0.02, 0.088), box(0.1, 0.02, 0.05)
        shapes += [Placed(low, (placement(y=y, z=-0.1),)), Placed(high, (placement(y=y, z=0.012),))]
        shapes.append(Placed(box(0.038, 0.02, 0.024), (placement(x=-0.031, y=y, z=-0.012),)))
        if closed:
            shapes.append(Placed(box(0.038, 0.02, 0.024), (placement(x=0.031, y=y, z=-0.012),)))
    brackets = Occurrence(part("brackets", Sum(tuple(shapes))))
    return (RigidBody("frame", (*floor.occurrences, brackets)),)


def shaft() -> RigidBody:
    along = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    journal = Placed(bar(0.02, 0.5), (along.after(placement(z=-0.25)),))
    flanges = Placed(tube(0.08, 0.03, 0.01), tuple(along.after(placement(z=z)) for z in (-0.18, 0.17)))
    return body("shaft", Sum((journal, flanges)), kind=JointKind.PIN)


def test_a_shaft_with_flanges_comes_into_open_slots_and_into_no_closed_bores() -> None:
    slotted = insertions(Tree((*frame(closed=False), shaft())), UP, frozenset(("frame",)))
    assert blocked(slotted) == {}
    assert slotted[-1].moves[-1][0] < 0  # from +x
    bored = insertions(Tree((*frame(closed=True), shaft())), UP, frozenset(("frame",)))
    assert blocked(bored) == {"shaft": ["frame"]}


def test_a_fork_under_a_roof_comes_off_its_rod_by_little_more_than_half_its_size() -> None:
    """It must rise 4 mm to pass the collars before and behind it, and may not rise more than 5.5 mm."""
    tines = Placed(box(1 * mm, 2 * mm, 4 * mm), (placement(x=-2 * mm, z=-3 * mm), placement(x=2 * mm, z=-3 * mm)))
    fork = body("fork", Sum((tines, Placed(box(5 * mm, 2 * mm, 4 * mm), (placement(z=mm),)))), kind=JointKind.SLIDE)
    rod = Placed(box(2 * mm, 60 * mm, 2 * mm), (placement(z=-mm),))
    ends = tuple(placement(y=y, z=-mm) for y in (-3 * mm, 3 * mm))
    collars = Placed(box(10 * mm, mm, 2 * mm), ends)
    walls = Placed(box(mm, 60 * mm, 16.5 * mm), (placement(x=-5.5 * mm, z=-6 * mm), placement(x=5.5 * mm, z=-6 * mm)))
    lids = Placed(box(12 * mm, 60 * mm, mm), (placement(z=-7 * mm), placement(z=10.5 * mm)))
    case = body("case", Sum((rod, collars, walls, lids)))
    steps = insertions(Tree((case, fork)), UP, frozenset(("case",)))
    assert blocked(steps) == {}
    *_, along, down = steps[-1].moves
    assert abs(along[1]) > 60 * mm
    assert -5.5 * mm < down[2] < -4 * mm


def test_bearings_that_hold_a_shaft_come_with_it_from_the_bench() -> None:
    """A ring cannot come past the bracket beside it: ring and shaft are put together before."""
    along = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    rings = tuple(along.after(placement(z=z)) for z in (-0.21 + 0.03, 0.17))
    plain = body("shaft", Sum((Placed(bar(0.02, 0.5), (along.after(placement(z=-0.25)),)),)), kind=JointKind.PIN)
    bearing = RigidBody("bearings", (Occurrence(part("ring", tube(0.05, 0.015, 0.01)), rings),))
    steps = insertions(Tree((*frame(closed=False), plain, bearing)), UP, frozenset(("frame",)))
    assert blocked(steps) == {}
    together = steps[-1]
    assert sorted({unit.name for unit in together.units}) == ["bearings", "shaft"]
    assert names(together.bench)[0] == "shaft"
    assert all(abs(step.moves[0][1]) > 0.1 for step in together.bench[1:])  # along the shaft


def test_a_sliding_body_on_both_sides_of_a_bracket_comes_part_by_part() -> None:
    """Bearings and a drive move as one, but a post stands before the drive outside: it comes along the shaft."""
    along = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    rings = Occurrence(part("ring", tube(0.05, 0.015, 0.01)), tuple(along.after(placement(z=z)) for z in (-0.19, 0.18)))
    drive = Occurrence(part("drive", tube(0.08, 0.03, 0.03)), (along.after(placement(z=0.211)),))
    sliding = RigidBody("sliding", (rings, drive), joint=Joint(JointKind.SLIDE, (1.0, 0.0, 0.0)))
    post = Occurrence(part("post", box(0.02, 0.03, 0.08)), (placement(0.06, 0.226, 0.02),))

    def steps(*, closed: bool) -> tuple[Insertion, ...]:
        (standing,) = frame(closed=closed)
        standing = replace(standing, occurrences=(*standing.occurrences, post))
        return insertions(Tree((standing, sliding, replace(shaft(), parent="sliding"))), UP, frozenset(("frame",)))

    slotted = steps(closed=False)
    assert blocked(slotted) == {}
    assert [piece.part.id for piece in slotted[-1].units[0].pieces] == ["drive"]
    assert slotted[-1].moves[-1][1] < 0  # from outside, when the shaft is in its slots
    assert "shaft" in {unit.name for step in steps(closed=True) if step.blocking for unit in step.units}


def test_sampled_moves_meet_nothing() -> None:
    """Random blocks: the path of each, sampled every two millimetres, against all that stands, by their boxes."""
    rng = np.random.default_rng(3)
    blocks = [
        body(f"block-{k}", box(0.03, 0.03, 0.03), placement(*(0.03 * np.array(cell)).tolist()))
        for k, cell in enumerate(rng.permutation([(i, j, k) for i in range(3) for j in range(3) for k in range(2)]))
    ]
    steps = insertions(Tree(tuple(blocks)), UP)
    assert sorted(names(steps)) == sorted(one.id for one in blocks)
    standing: list[InsertedUnit] = [*steps[0].units]
    for step in steps[1:]:
        assert not step.blocking
        (unit,) = step.units
        ends = [np.zeros(3)]
        for move in reversed(step.moves):
            ends.append(ends[-1] - move)
        for start, end in pairwise(ends):
            length = min(float(np.linalg.norm(end - start)), 0.3)
            for far in np.arange(0.0, length, 2 * mm):
                shifted = start + (end - start) / np.linalg.norm(end - start) * far
                low, high = unit.solid.box + shifted
                for other in standing:
                    assert (np.minimum(high, other.solid.box[1]) - np.maximum(low, other.solid.box[0])).min() <= 1e-9
        standing.append(unit)


def test_a_row_of_bodies_that_are_there_several_times_comes_as_built() -> None:
    head = RigidBody(
        "head",
        (
            Occurrence(part("plate", box(0.02, 0.02, 0.01))),
            Occurrence(part("stud", box(0.01, 0.01, 0.02)), (placement(z=0.01),)),
        ),
        positions=(placement(x=-0.1), placement(x=0.1)),
    )
    units = units_of(Tree((head,)))
    assert [len(unit.pieces) for unit in units] == [2, 2]
    assert [len(unit.inner) for unit in units] == [2, 0]


@pytest.mark.parametrize("elastic", [True, False])
def test_a_retaining_ring_opens_over_its_shaft(elastic: bool) -> None:
    """A pin with a collar below and a groove above, a link between: the ring comes last, along the pin; a rigid ring
    of the same shape can come into the groove by no move."""
    row = retaining_ring(25 * mm)
    ends = (
        (32.0, 4.0, 0.0),
        (25.0, 10.0, 4.0),
        (row.groove / mm, row.slot / mm, 14.0),
        (25.0, 2.0, 14.0 + row.slot / mm),
    )
    steps_of_pin = tuple(Placed(bar(wide * mm, high * mm), (placement(z=low * mm),)) for wide, high, low in ends)
    shape = tube(row.outer, (row.outer - row.groove) / 2, row.thickness)
    bought = Bought(row.designation if elastic else "a rigid ring")
    ring = bought_part("ring", "ring", "fastener", shape, bought)
    bodies = (
        body("pin", Sum(steps_of_pin)),
        body("link", tube(0.06, 0.0175, 9.5 * mm), placement(z=4.2 * mm), JointKind.PIN),
        RigidBody("ring", (Occurrence(ring, (placement(z=14.05 * mm),)),)),
    )
    steps = insertions(Tree(bodies), UP, frozenset(("pin",)))
    assert bool(blocked(steps)) is not elastic
    if elastic:
        assert names(steps) == ["pin", "link", "ring"]
        assert steps[-1].moves[-1][:2] == pytest.approx([0.0, 0.0])


def test_discs_that_alternate_on_a_bar_come_as_one_stack() -> None:
    cam, ring = (part(name, tube(0.05, 0.01, 0.005)) for name in ("cam", "ring"))
    rows = tuple(tuple(placement(z=0.011 * k + low) for k in range(50)) for low in (0.0, 0.0055))
    shaft = Occurrence(part("shaft", bar(0.03, 0.6)), (placement(z=-0.02),))
    turning = RigidBody(
        "shaft", (shaft, Occurrence(cam, rows[0]), Occurrence(ring, rows[1])), joint=Joint(JointKind.PIN)
    )
    floor = body("floor", box(0.2, 0.2, 0.02), placement(z=-0.2))
    (unit,) = (unit for unit in units_of(Tree((floor, turning))) if unit.inner)
    stack = next(own for own in unit.inner if own.stack)
    assert [([piece.id for piece, _ in run.pieces], run.times) for run in stack.stack] == [(["cam", "ring"], 50)]
    assert len(stack.pieces) == 100
    assert {abs(own[2]) for own in stack.directions} == {1.0}  # along the shaft
