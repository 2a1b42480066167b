"""What sits on shafts and pins, in every machine with a tree: keys, bores, teeth of pulleys, and what is ordered."""

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from axial import loose_hubs
from default_machines import SETTLED, default_design
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.belts import BELTS
from ilmek.elements.materials import MATERIALS
from ilmek.elements.parallel_keys import keyed_end
from ilmek.elements.plates import round_bore
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.hand_shed.tree import ROD_END, ROD_PLAY
from ilmek.part import catalogue
from ilmek.part.joint_fits import joints_without_fit
from ilmek.part.meetings import meetings
from ilmek.part.part import SET_SCREW, Part, Seat
from ilmek.part.placement import placement
from ilmek.part.plates import pieces_of
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, disc, tube
from ilmek.part.tolerances import FeatureKind
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import along, circle, polygon_moments
from ilmek.report.sheet import Issue
from ilmek.viz.drawings.compose import sheets_of
from ilmek.viz.drawings.drawn_part import drawn_piece

LOOMS = (SETTLED, {**SETTLED, "beat": "linkage"}, {**SETTLED, "knotting": "arms"})
TREES = (
    *(("automated-loom", tuple(settings.items())) for settings in LOOMS),
    *((name, ()) for name, machine in MACHINES.items() if machine.tree is not None),
)

BOUGHT_WHOLE = {"weft/turning cutters", "weft/fingers of the selector"}
"""Bodies that are bought devices, turned inside."""


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


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_something_holds_every_hub_along_its_shaft(machine: str, settings: Any) -> None:
    assert loose_hubs(tree_of(machine, settings)) == set()


def test_a_hub_between_nothing_is_found() -> None:
    """A keyed ring on a shaft: loose; beside a shoulder only: loose; between shoulder and nut: held; by a set screw."""
    end = keyed_end(0.02, 1.0, 490e6)
    long = replace(end, length=0.1)
    steel = MATERIALS["structural steel"]
    hub = Part("hub", "hub", "turned part", Prism(disc(0.02, *round_bore(0.02).cutouts), 0.02), steel)
    plain = catalogue.keyed_journal(long)
    shafts = plain, Sum((Placed(bar(0.03, 0.01)), Placed(plain, (placement(z=0.01),))))
    nut = Part("nut", "nut", "turned part", tube(0.03, 0.005, 0.01), steel)
    screwed = replace(hub, seats={SET_SCREW: Seat(placement(), 0.004)})
    cases = (
        (shafts[0], hub, (), True),
        (shafts[1], hub, (), True),
        (shafts[1], hub, (Occurrence(nut, (placement(z=0.03),)),), False),
        (shafts[0], screwed, (), False),
    )
    for shape, ring, others, loose in cases:
        shaft = Part("shaft", "shaft", "turned part", shape, steel)
        parts = (Occurrence(shaft), Occurrence(ring, (placement(z=0.01),)), *others)
        tree = Tree((RigidBody("turning", parts, joint=Joint(JointKind.PIN)),))
        assert loose_hubs(tree) == ({"hub"} if loose else set())


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
        if body.joint.kind is JointKind.PIN and body.id not in BOUGHT_WHOLE | {"cam/cam", "hammer/comb"}:
            assert ids & met or body.id in bodies, body.id


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_every_joint_that_moves_has_a_fit(machine: str, settings: Any) -> None:
    """By a bore and its pin, faces on each other, or a bought part."""
    assert set(joints_without_fit(tree_of(machine, settings))) == set()


def test_the_rod_that_a_hand_lifts_has_play_within_general_tolerances() -> None:
    """Slot and end of the shed rod at their limits of ISO 2768-m for 6 to 30 mm."""
    assert ROD_PLAY - 2 * 0.2e-3 > 0.05e-3
    assert ROD_END > 6e-3
    assert ROD_END + ROD_PLAY < 30e-3


def test_a_joint_without_a_fit_is_found() -> None:
    """A pin of another size than its bore, a slide beside its face; a roller on nothing; and each as it should be."""
    steel = MATERIALS["structural steel"]
    plate = Part("plate", "plate", "machined link", Prism(disc(0.05, circle(0j, 0.006)), 0.01), steel)
    for size, apart, loose in ((0.012, 0.0, ()), (0.0118, 0.0001, ("turns", "slides", "roller"))):
        pin = Part("pin", "pin", "pin or bush", bar(size, 0.03), steel)
        shoe = Part("shoe", "shoe", "machined link", box(0.02, 0.02, 0.01), steel)
        roller = Part("roller", "roller", "turned part", tube(0.03, 0.009, 0.01), steel)
        bodies = (
            RigidBody("stands", (Occurrence(plate),)),
            RigidBody("turns", (Occurrence(pin),), "stands", Joint(JointKind.PIN)),
            RigidBody("slides", (Occurrence(shoe, (placement(0.03, z=0.01 + apart),)),), "stands", SLIDING),
            RigidBody("carries", (Occurrence(pin), Occurrence(roller, turning=True)), "stands"),
        )
        assert joints_without_fit(Tree(bodies)) == loose


SLIDING = Joint(JointKind.SLIDE, (1.0, 0.0, 0.0))


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_a_keyed_hub_sits_on_a_groove(machine: str, settings: Any) -> None:
    keyed: dict[tuple[str, str], bool] = {}
    for meeting in meetings(tree_of(machine, settings)):
        if meeting.bore.feature.keyway is not None and meeting.joint is JointKind.FIXED:
            pair = meeting.bore.part.id, meeting.inner.part.id
            keyed[pair] = keyed.get(pair, False) or meeting.inner.feature.keyway is not None
    assert all(keyed.values()), keyed


ORDERED = {
    "reducer": r"(right-angle )?(planetary|worm) reducer \d+:1(?=.*(shaft \d|for a motor))",
    "servo": r"servo \d+ W, \d+ rpm, .*peak .*flange \d+.* mm, shaft \d+.*, absolute multi-turn encoder|to measure: .*",
    "stepper": r"stepper NEMA \d+, .*holding .*flange \d+.* mm, shaft \d+.*, absolute multi-turn encoder",
    "bearing": r"\d{4,5}-2RS, DIN 625-1|UCF \d{3}, ISO 9628.*|HF\d+|CF \d+.*|idler .*|NU .*",
    "toothed pulley": r"pulley .* \d+ teeth, \d+ mm wide.*bore \d+.*",
    "linear axis": r".*(\d+ mm wide|linear axis).*, stroke at least \d.*",
    "holding brake": r".*, built by its maker onto .+",
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


@pytest.mark.parametrize(("machine", "settings"), TREES)
def test_the_sheet_of_a_shaft_states_where_its_keyway_lies(machine: str, settings: Any) -> None:
    """Length and begin, measured on the mesh: where points lie on the floor of the groove."""
    for piece in pieces_of(tree_of(machine, settings)):
        grooved = [one for one in piece.features if getattr(one, "kind", None) is FeatureKind.SHAFT_KEYWAY]
        if not grooved:
            continue
        (sheet,) = sheets_of(drawn_piece(piece, machine, "shaft"), Issue(), None)
        points = piece.shape.mesh().points
        stated = [re.search(r"keyway .*, (\S+) long, (\S+) from the left end", str(text.text)) for text in sheet.texts]
        seats = sorted((float(one[2]), float(one[1])) for one in stated if one)
        half = grooved[0].nominal / 2
        corners = points[(np.abs(np.abs(points[:, 1]) - half) < 1e-7) & (points[:, 0] > 0)]
        levels = np.unique(np.round(corners[:, 2], 7))
        assert seats, piece.title
        for begin, long in seats:
            low = points[:, 2].min() + begin / 1e3
            assert np.abs(levels - low).min() < 1e-4
            assert np.abs(levels - low - long / 1e3).min() < 1e-4
