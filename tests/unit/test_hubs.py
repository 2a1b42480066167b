"""What sits on shafts and pins, in every machine with a tree: keys, bores, teeth of pulleys, and what is ordered."""

import math
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np
import pytest
from default_machines import default_design
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.belts import BELTS
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.part.meetings import meetings
from ilmek.part.part import Part
from ilmek.part.shapes import Prism, Sum
from ilmek.part.tree import JointKind, Tree
from ilmek.plane.contours import along, polygon_moments

LOOMS = ({}, {"beat": "linkage"}, {"knotting": "arms"})
TREES = (
    *(("automated-loom", tuple(settings.items())) for settings in LOOMS),
    *((name, ()) for name, machine in MACHINES.items() if machine.tree is not None),
)

BOUGHT_WHOLE = {"weft/turning cutters", "weft/fingers of the selector"}
"""Bodies that are bought devices, turned inside."""

UNDER_WORK = {"weaver/magazine", "cam/cam", "hammer/comb"} | {
    f"weaver/{name} gripper's finger" for name in ("left side", "right side", "centre")
}


@cache
def tree_of(machine: str, settings: tuple[tuple[str, str], ...]) -> Tree:
    component = MACHINES[machine]
    design: Any = component.designed(component.params.read(dict(settings))) if settings else default_design(machine)
    if machine == "automated-loom":
        return loom_tree(design)
    assert component.tree is not None
    return component.tree(design)


def bought(tree: Tree, *kinds: str) -> Iterator[Part]:
    return (part for part, _ in tree.occurrences() if part.purchase is not None and part.process in kinds)


# DIN 6885-1: section, shortest and longest key [mm], typed here from the standard a second time
LENGTHS = {
    (2, 2): (6, 20),
    (3, 3): (6, 36),
    (4, 4): (8, 45),
    (5, 5): (10, 56),
    (6, 6): (14, 70),
    (8, 7): (18, 90),
    (10, 8): (22, 110),
    (12, 8): (28, 140),
    (14, 9): (36, 160),
    (16, 10): (45, 180),
}


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_every_key_is_one_of_the_standard_or_cut_from_key_steel(machine: str, settings: Any) -> None:
    tree = tree_of(machine, settings)
    for part in bought(tree, "fastener"):
        text = part.designation
        key = re.fullmatch(r"DIN (6885-1 B|6880 C45\+C) (\d+) x (\d+) x (\d+)", text)
        if key is None:
            assert "DIN 688" not in text
            continue
        width, height, length = map(int, key.groups()[1:])
        shortest, longest = LENGTHS[width, height]
        assert length >= shortest
        assert key[1].startswith("6880") or length <= longest
        assert part.shape is not None
        assert np.ptp(part.shape.mesh().points, axis=0) == pytest.approx([height / 1e3, width / 1e3, length / 1e3])


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_one_key_in_a_groove(machine: str, settings: Any) -> None:
    """Keys of a body on one axis, at one angle of it, are not behind one another with a hub's gap between them."""
    tree = tree_of(machine, settings)
    for body in tree.bodies:
        keys = [own for own in body.occurrences if own.part.designation.startswith("DIN 688")]
        lines = [
            tuple(np.round(position.inverse.points(np.zeros(3)), 6)[:2]) + tuple(np.round(position.rotation[:, 0], 6))
            for own in keys
            for position in own.positions
        ]
        assert len(lines) == len(set(lines)) or "linkage" in machine or "four-bar" in machine, body.id


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_what_turns_has_a_bore_or_is_the_pin(machine: str, settings: Any) -> None:
    tree = tree_of(machine, settings)
    turning = [meeting for meeting in meetings(tree) if meeting.joint is JointKind.PIN]
    met = {seat.part.id for meeting in turning for seat in (meeting.bore, meeting.inner)}
    bodies = {meeting.body for meeting in turning}
    for body in tree.bodies:
        ids = {own.part.id for own in body.occurrences}
        assert not {own.part.id for own in body.occurrences if own.turning} - met
        if body.joint.kind is JointKind.PIN and body.id not in BOUGHT_WHOLE | UNDER_WORK:
            assert ids & met or body.id in bodies, body.id


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_a_keyed_hub_sits_on_a_groove(machine: str, settings: Any) -> None:
    keyed: dict[tuple[str, str], bool] = {}
    for meeting in meetings(tree_of(machine, settings)):
        if meeting.bore.feature.keyway is not None and meeting.joint is JointKind.FIXED:
            pair = meeting.bore.part.id, meeting.inner.part.id
            keyed[pair] = keyed.get(pair, False) or meeting.inner.feature.keyway is not None
    assert all(keyed.values()), keyed


ORDERED = {
    "reducer": r"(planetary|worm) reducer \d+:1(?=.*(shaft \d|for a motor))",
    "servo": r"servo \d+ W, \d+ rpm, .*peak .*flange \d+.* mm, shaft \d+|to measure: .*",
    "stepper": r"stepper NEMA \d+, .*holding .*flange \d+.* mm, shaft \d+",
    "bearing": r"\d{4}-2RS, DIN 625-1|UCF \d{3}, ISO 9628.*|HF\d+|CF \d+.*|idler .*|NU .*",
    "toothed pulley": r"pulley .* \d+ teeth, \d+ mm wide.*bore \d+.*",
    "linear axis": r".*(\d+ mm wide|linear axis).*",
    "spring": r".*\d+.*coils.*",
    "belt and pulleys": r".*\d+ mm wide.*",
}


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_an_order_states_what_a_buyer_needs(machine: str, settings: Any) -> None:
    for part in bought(tree_of(machine, settings), *ORDERED):
        assert re.match(ORDERED[part.process], part.designation), (part.id, part.designation)


@given(st.sampled_from(sorted(BELTS)), st.integers(0, 60))
def test_a_pulley_has_its_teeth(name: str, more: int) -> None:
    """Grooves counted on a circle half a groove deep, radii at the tips and floors, area by a fine polygon."""
    belt = BELTS[name]
    teeth = belt.least_teeth + more
    outline = belt.pulley_outline(teeth)
    points = along(outline, 1e-6)
    tip = belt.pitch * teeth / (2 * math.pi) - belt.groove.offset
    assert np.abs(points).max() == pytest.approx(tip, abs=2e-6)
    assert np.abs(points).min() == pytest.approx(tip - belt.groove.depth, rel=0.02, abs=1e-4)
    inside = np.abs(points) < tip - belt.groove.depth / 2
    assert np.count_nonzero(inside & ~np.roll(inside, 1)) == teeth
    area, _ = polygon_moments(points)
    assert 0.5 < area / (math.pi * tip**2) < 1


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_every_pulley_of_a_machine_has_teeth(machine: str, settings: Any) -> None:
    """Of those that say how many: as many grooves in the outline of its teeth, a bore, a belt's tip diameter."""
    for part in bought(tree_of(machine, settings), "toothed pulley"):
        stated = re.search(r"pulley (\S+(?: \d+M)?), (\d+) teeth", part.designation)
        assert stated is not None
        assert isinstance(part.shape, Sum)
        toothed = part.shape.members[0].shape
        assert isinstance(toothed, Prism)
        belt, teeth = BELTS[stated[1]], int(stated[2])
        radii = np.abs(along(toothed.section.outline, 1e-5))
        inside = radii < radii.max() - belt.groove.depth / 2
        assert np.count_nonzero(inside & ~np.roll(inside, 1)) == teeth
        assert 2 * radii.max() == pytest.approx(belt.pitch * teeth / math.pi - 2 * belt.groove.offset, abs=3e-5)
        assert len(toothed.section.holes) == 1
