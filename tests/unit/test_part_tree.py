"""The tree of a machine's parts: its list, its frames in space, errors, and the compensator as its first machine."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.tension_compensator import MACHINE, TensionCompensatorParams, design
from ilmek.machines.tension_compensator.parts import sprung_bar
from ilmek.machines.tension_compensator.tree import tree
from ilmek.part.bill import bill
from ilmek.part.part import Bought, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import Prism, bar, box, disc, tube
from ilmek.part.space import frames_of, parts_of
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle
from ilmek.plane.solids import is_closed, volume
from ilmek.report.scene import SceneMotion
from ilmek.units import deg

STEEL = MATERIALS["structural steel"]
AXLE = Part("stub/axle", "axle", "steel bar", bar(0.02, 0.5), STEEL)
WHEEL = Part("stub/wheel", "wheel", "laser-cut part", Prism(disc(0.1, circle(0j, 0.01)), 0.01), STEEL)
MOTOR = Part("stub/motor", "motor", "stepper", purchase=Bought("NEMA 17", 0.4, power=50.0, drives=True))


def _stub() -> Tree:
    """Two axles, each with three wheels in two bodies, and one motor."""
    wheels = tuple(placement(z=z) for z in (0.1, 0.2, 0.3))
    return Tree(
        (
            RigidBody(
                "axles",
                (Occurrence(AXLE), Occurrence(WHEEL, wheels[:2])),
                positions=(placement(x=-1.0), placement(x=1.0)),
            ),
            RigidBody("outer wheel", (Occurrence(WHEEL, wheels[2:]),), "axles", Joint(JointKind.PIN)),
            RigidBody("drive", (Occurrence(MOTOR),)),
        )
    )


def test_the_list_counts_what_is_placed() -> None:
    lines = {line.part: line for line in bill(_stub())}
    assert {name: line.number for name, line in lines.items()} == {"stub/axle": 2, "stub/wheel": 6, "stub/motor": 1}
    wheel = math.pi * (0.1**2 - 0.01**2) * 0.01 * STEEL.density
    assert lines["stub/wheel"].mass == pytest.approx(wheel, rel=1e-12)
    assert (lines["stub/motor"].description, lines["stub/motor"].drives) == ("NEMA 17", True)
    assert _stub().mass == pytest.approx(2 * math.pi * 0.01**2 * 0.5 * STEEL.density + 6 * wheel + 0.4, rel=1e-12)


def test_a_body_on_another_lies_where_both_places_say() -> None:
    """Every corner of the scene's solids, by its frames, is where the tree's own positions put it."""
    base = Tree((RigidBody("base", (), positions=(placement(1.0, 2.0, 3.0),)),))
    whole = base.carrying("base", _stub(), placement(0.5, about=(0, 1, 0), angle=90 * deg))
    position = placement(0.1, 0.2, 0.3, about=(1, 1, 0), angle=0.4)
    frames = {frame.name: frame for frame in frames_of(whole, "", position)}
    for part in parts_of(whole, "stub", position):
        if part.frame != "outer wheel":
            continue
        chain = [frames[part.frame]]
        while chain[-1].parent:
            chain.append(frames[chain[-1].parent])
        origin = sum((frame.origins[0] for frame in chain), np.zeros(3))
        axles, floor = whole.body("axles"), whole.body("base")
        own = position.after(floor.positions[0]).after(axles.positions[0])
        expected = own.after(placement(z=0.3)).points(WHEEL.shape.mesh().points) if WHEEL.shape else None
        assert part.solids[0].points + origin == pytest.approx(expected, abs=1e-9)
        return
    pytest.fail("the outer wheel is not in space")


def test_the_axis_of_a_joint_turns_with_the_place_of_its_body() -> None:
    motion = SceneMotion("row", np.array([0.0, 1.0]), np.array([[0.0, 0, 0], [0, 0, 1.0]]), np.array([0.0, 0.5]))
    body = RigidBody("lever", (Occurrence(AXLE),), joint=Joint(JointKind.PIN, motion=motion))
    (frame,) = frames_of(Tree((body,)), "ground", placement(about=(0, 1, 0), angle=90 * deg))
    assert frame.axis == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    assert frame.motion is not None
    assert frame.motion.shift[1] == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: Part("a", "a", "bearing"), "without one source"),
        (lambda: Part("a", "a", "steel bar", material=STEEL), "without a shape"),
        (lambda: Tree((RigidBody("a", ()), RigidBody("a", ()))), "two bodies named 'a'"),
        (lambda: Tree((RigidBody("a", (), "b"), RigidBody("b", ()))), "body 'a' on 'b'"),
        (lambda: Tree((RigidBody("a", (Occurrence(AXLE), Occurrence(replace(AXLE)))),)), "two parts named"),
        (lambda: Tree().body("a"), "no body 'a'"),
        (lambda: box(1.0, 0.0, 1.0), "height"),
        (lambda: tube(0.1, 0.06, 1.0), "a wall of 60 mm"),
        (lambda: Placement(np.zeros(3), np.diag([1.0, 1.0, -1.0])), "no rotation"),
    ],
)
def test_what_cannot_be_is_refused(build: Callable[[], object], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        build()


def test_every_line_of_the_compensator_is_a_part_of_its_tree_and_back() -> None:
    made = design(TensionCompensatorParams())
    report, bodies = MACHINE.report(made, in_a_loom=True), tree(made)
    parts = {part.id: (part, number) for part, number in bodies.occurrences()}
    assert [line.part for line in report.parts] == list(parts)
    for line in report.parts:
        part, number = parts[line.part]
        assert line.number == number
        if part.material is not None and part.shape is not None:
            assert line.mass == pytest.approx(part.shape.moments.zeroth * part.material.density, rel=1e-12)


def test_the_checks_of_the_compensator_name_parts_that_it_has() -> None:
    made = design(TensionCompensatorParams())
    names = {part.id for part, _ in tree(made).occurrences()}
    concerned = {name for check in MACHINE.report(made).checks for name in check.parts}
    assert concerned
    assert concerned <= names


def test_the_moving_mass_is_that_of_the_parts_about_the_pivot() -> None:
    """By the mesh of each part, by its positions; the eyes with their sleeves at the springs, a third of these."""
    made = design(TensionCompensatorParams())
    moment = 0.0
    for occurrence in sprung_bar(made.parts, "any", None).occurrences:
        shape, part = occurrence.part.shape, occurrence.part
        assert shape is not None
        density = part.mass / shape.moments.zeroth
        for position in occurrence.positions:
            solid = shape.mesh(1e-6)
            corners = position.points(solid.points)[solid.triangles]
            sixth = np.linalg.det(corners) / 6
            sums = corners.sum(axis=1)
            second = np.einsum("t,tci->i", sixth, corners**2) + np.einsum("t,ti->i", sixth, sums**2)
            moment += density * float(second[0] + second[1]) / 20
    one, params, strut = made.one, made.params, made.parts.struts
    assert one.spring is not None
    assert strut.eye is not None
    assert strut.sleeve is not None
    each = one.spring.mass / 3 + strut.eye.mass + strut.sleeve.mass
    moment += params.levers * one.springs * each * params.spring_arm**2
    assert made.moving_mass == pytest.approx(moment / params.bar_arm**2, rel=1e-4)


_PARAMS = st.fixed_dictionaries(
    {
        "cloth": st.builds(
            lambda warps, tension, width: cloth(warps=warps, tension=tension, warp_pitch=min(width / warps, 50e-3)),
            st.integers(20, 3000),
            st.floats(1.0, 60.0),
            st.floats(0.2, 6.0),
        ),
        "bar_arm": st.floats(0.02, 0.6),
        "spring_arm": st.floats(0.01, 0.6),
        "strut": st.floats(0.05, 0.5),
        "lever_thickness": st.floats(0.002, 0.05),
        "bars": st.sampled_from([1, 2, None]),
    }
)


@given(_PARAMS)
def test_whatever_compensator_is_designed_can_be_built_in_space(settings: dict[str, Any]) -> None:
    """Its solids are closed, and weigh what the list says but for the chords of their arcs."""
    try:
        made = design(TensionCompensatorParams(**settings))
    except ParameterError:
        return
    bodies = tree(made)
    shown = {part.name.split(" of ")[0]: part for part in parts_of(bodies, "tension-compensator")}
    for part, _ in bodies.occurrences():
        if part.shape is None:
            continue
        solid = part.shape.mesh()
        assert is_closed(solid), part.id
        assert part.id in shown
        assert volume(solid) == pytest.approx(part.shape.moments.zeroth, rel=0.02)
