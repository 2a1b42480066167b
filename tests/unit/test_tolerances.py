"""Fits of made parts from what meets in their joints: each kind of meeting by itself, and machines as they are."""

import math
from dataclasses import replace

import numpy as np
import pytest
from default_machines import default_design

from ilmek.elements.bearings import find_bearing
from ilmek.elements.fits import fit, tolerance_zone
from ilmek.elements.linear_guides import LINEAR_GUIDES
from ilmek.elements.machine_screws import SCREWS
from ilmek.elements.materials import MATERIALS
from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.elements.plates import round_bore
from ilmek.machines.catalogue import MACHINES
from ilmek.part import catalogue, guides
from ilmek.part.features import features_of_size
from ilmek.part.meetings import meetings
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, box, disc, stepped, tube
from ilmek.part.specification import specification
from ilmek.part.tolerances import Characteristic, FeatureKind, FitDuty, ToleratedFeature
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle
from ilmek.units import mm, um

STEEL = MATERIALS["structural steel"]


def _made(name: str, shape: Shape, process: str = "machined link") -> Part:
    return Part(name, name, process, shape, STEEL)


def _plate(name: str, *bores: tuple[float, float], thick: float = 10 * mm) -> Part:
    """A plate bored at x, with diameters [m]."""
    holes = (circle(complex(x), diameter / 2) for x, diameter in bores)
    return _made(name, Prism(disc(0.2, *holes), thick))


def _tree(standing: tuple[Occurrence, ...], moving: tuple[Occurrence, ...], kind: JointKind = JointKind.PIN) -> Tree:
    return Tree((RigidBody("frame", standing), RigidBody("mover", moving, "frame", Joint(kind))))


def _at(part: Part, z: float = 0.0, *, turning: bool = False) -> Occurrence:
    return Occurrence(part, (placement(z=z),), turning)


def _classes(tree: Tree) -> dict[str, list[tuple[str, FitDuty]]]:
    return {
        part: [(one.tolerance, one.duty) for one in features if not one.depth]
        for part, features in tolerances_of(tree).items()
    }


PIN = _made("pin", bar(12 * mm, 40 * mm))
LINK = _plate("link", (0.0, 12 * mm), (0.1, 12 * mm))
FRAME = _plate("frame", (0.0, 12 * mm))


def test_a_pin_that_is_fixed_in_one_part_and_on_which_another_runs_is_of_one_size() -> None:
    tree = _tree((_at(FRAME), _at(PIN)), (_at(LINK, 15 * mm),))
    assert _classes(tree) == {
        "frame": [("P7", FitDuty.FIXED)],
        "link": [("G7", FitDuty.RUNNING)],
        "pin": [("h6", FitDuty.RUNNING)],
    }
    assert {one.joint for one in tolerances_of(tree)["link"]} == {"mover"}


@pytest.mark.parametrize(
    ("kind", "bore", "journal"),
    [(JointKind.PIN, "H7", "g6"), (JointKind.SLIDE, "H7", "g6"), (JointKind.FIXED, "H7", "m6")],
)
def test_a_pin_in_one_bore_has_the_fit_of_its_joint(kind: JointKind, bore: str, journal: str) -> None:
    classes = _classes(_tree((_at(FRAME),), (_at(PIN),), kind))
    assert [name for name, _ in classes["frame"] + classes["pin"]] == [bore, journal]


def test_a_rod_in_a_bore_that_is_drilled_deep_is_loose() -> None:
    """Over 20 diameters; the same rod guided in a short bore."""
    for length, classes in ((0.19, ("H7", "g6")), (0.21, ("H11", "c11"))):
        rod, block = _made("rod", bar(10 * mm, 0.3)), _made("block", tube(30 * mm, 10 * mm, length))
        own = _classes(_tree((_at(block),), (_at(rod, -0.01),), JointKind.SLIDE))
        assert tuple(own[name][0][0] for name in ("block", "rod")) == classes


def test_a_roller_turns_on_its_pin_though_it_is_no_body() -> None:
    roller = _made("roller", tube(30 * mm, 9 * mm, 10 * mm))
    tree = Tree((RigidBody("fork", (_at(FRAME), _at(PIN), _at(roller, 15 * mm, turning=True))),))
    assert _classes(tree)["roller"] == [("G7", FitDuty.RUNNING), ("h6", FitDuty.ROLLING)]
    still = Tree((RigidBody("fork", (_at(FRAME), _at(PIN), _at(roller, 15 * mm))),))
    assert _classes(still)["roller"] == [("H7", FitDuty.FIXED)]


def test_a_bush_is_pressed_into_its_hub() -> None:
    bush = _made("bush", tube(18 * mm, 3 * mm, 10 * mm))
    hub = _plate("hub", (0.0, 18 * mm))
    tree = _tree((_at(FRAME), _at(PIN)), (_at(hub, 15 * mm), _at(bush, 15 * mm)))
    classes = _classes(tree)
    assert classes["bush"] == [("G7", FitDuty.RUNNING), ("s6", FitDuty.FIXED)]
    assert classes["hub"] == [("H7", FitDuty.FIXED)]


@pytest.mark.parametrize(("row", "shaft"), [("6004", "k6"), ("6002", "js6"), ("UCF 204", "h6")])
def test_seats_of_rolling_bearings(row: str, shaft: str) -> None:
    bearing = find_bearing(row)
    inserted = bearing.flange > 0
    housing = () if inserted else (_at(_plate("housing", (0.0, bearing.outer), thick=bearing.width)),)
    turned = _made("shaft", bar(bearing.bore, 0.1), "turned part")
    own = catalogue.bearing("bearing", "bearing", bearing)
    features = tolerances_of(_tree((_at(own), *housing), (_at(turned, -0.02),)))
    (journal,) = features["shaft"]
    assert (journal.tolerance, journal.roughness) == (shaft, 0.8 * um)
    (form,) = journal.geometric
    width = tolerance_zone("h5", bearing.bore).width
    assert (form.characteristic, form.value) == (Characteristic.CYLINDRICITY, pytest.approx(width / 2))
    if not inserted:
        (bore,) = features["housing"]
        assert (bore.tolerance, bore.duty) == ("H7", FitDuty.HOUSING)


def test_a_bearing_as_a_roller_does_not_turn_on_its_seat() -> None:
    own = catalogue.bearing("bearing", "bearing", find_bearing("6001"))
    tree = Tree((RigidBody("saddle", (_at(FRAME), _at(PIN), _at(own, 15 * mm))),))
    assert _classes(tree) == {"frame": [("P7", FitDuty.FIXED)], "pin": [("h6", FitDuty.BEARING)]}


def test_a_shaft_runs_true_about_both_its_bearings() -> None:
    own = catalogue.bearing("bearing", "bearing", find_bearing("6004"))
    shaft = _made("shaft", stepped((20 * mm, 30 * mm), (30 * mm, 90 * mm), (20 * mm, 30 * mm)), "turned part")
    cam = _plate("cam", (0.0, 30 * mm))
    bearings = Occurrence(own, (placement(z=5 * mm), placement(z=130 * mm)))
    features = tolerances_of(_tree((bearings,), (_at(shaft), _at(cam, 60 * mm))))["shaft"]
    assert [(one.datum, one.duty) for one in features] == [
        ("A", FitDuty.BEARING),
        ("", FitDuty.FIXED),
        ("B", FitDuty.BEARING),
    ]
    last = [one.geometric[-1] for one in features]
    assert [one.characteristic for one in last] == [
        Characteristic.TOTAL_RUN_OUT,
        Characteristic.RUN_OUT,
        Characteristic.TOTAL_RUN_OUT,
    ]
    assert {one.datums for one in last} == {("A-B",)}


def test_a_keyway_has_the_limits_of_its_standard() -> None:
    end = KeyedEnd(30 * mm, 20 * mm, 10.0, 235e6, 2)
    shaft = _made("shaft", Sum((Placed(catalogue.keyed_journal(end)),)), "turned part")
    hub = _made("hub", Prism(disc(0.05, *round_bore(30 * mm).cutouts), 12 * mm))
    features = tolerances_of(Tree((RigidBody("turning", (_at(shaft), _at(hub, 4 * mm))),)))
    journal, *keyways = features["shaft"]
    assert (journal.tolerance, journal.duty, journal.mates) == ("h6", FitDuty.KEYED, ("hub",))
    assert [one.kind for one in keyways] == [FeatureKind.SHAFT_KEYWAY] * 2
    across = keyways[0].position.rotation[:, 0] @ keyways[1].position.rotation[:, 0]
    assert across == pytest.approx(-1)
    assert _limits(keyways[0]) == pytest.approx((8, -0.036, 0.0, 26, -0.2, 0.0))  # 8 N9, 30 - 4
    bore, keyway = features["hub"]
    assert bore.tolerance == "H7"
    assert _limits(keyway) == pytest.approx((8, -0.018, 0.018, 33.3, 0.0, 0.2))  # 8 JS9, 30 + 3.3


def _limits(one: ToleratedFeature) -> tuple[float, ...]:
    """Sizes and limit deviations of a keyway [mm]."""
    return tuple(
        value / mm for value in (one.nominal, one.lower, one.upper, one.depth, one.depth_lower, one.depth_upper)
    )


def test_the_part_in_which_a_screw_ends_has_the_thread() -> None:
    screw = catalogue.screw("screw", "screw", SCREWS["M12"], 30 * mm)
    under, over = _plate("under", (0.0, 12 * mm), thick=20 * mm), _plate("over", (0.0, 12 * mm), thick=20 * mm)
    tree = Tree((RigidBody("frame", (_at(screw), _at(over), _at(under, 20 * mm))),))
    features = tolerances_of(tree)
    assert list(features) == ["under"]
    (thread,) = features["under"]
    assert (thread.kind, thread.tolerance, thread.nominal) == (FeatureKind.THREAD, "6H", pytest.approx(12 * mm))


def test_a_square_shaft_and_its_bore() -> None:
    shaft = _made("shaft", box(20 * mm, 20 * mm, 0.1), "steel bar")
    corners = box(20 * mm, 20 * mm, 1.0).section.outline
    cam = _made("cam", Prism(disc(0.05, corners), 1 * mm), "laser-cut part")
    classes = _classes(Tree((RigidBody("turning", (_at(shaft), _at(cam, 20 * mm))),)))
    assert classes == {"cam": [("H12", FitDuty.FIXED)], "shaft": [("h11", FitDuty.FIXED)]}


def test_bores_of_a_link_err_no_more_than_their_joints_have_play() -> None:
    far = replace(PIN, id="far")
    tree = _tree((_at(FRAME), _at(PIN)), (_at(LINK, 15 * mm), Occurrence(far, (placement(0.1, 0.0, 15 * mm),))))
    first, second = tolerances_of(tree)["link"]
    assert (first.datum, first.geometric) == ("A", ())
    (position,) = second.geometric
    play = fit("H7/g6", 12 * mm).largest_clearance
    assert (position.characteristic, position.round, position.datums) == (Characteristic.POSITION, True, ("A",))
    assert 0.8 * play < position.value <= play


@pytest.mark.parametrize("moved", [IDENTITY, placement(0.3, -0.2, 5.0, about=(1.0, 2.0, 3.0), angle=1.2)])
def test_parts_meet_wherever_they_stand(moved: Placement) -> None:
    tree = _tree((_at(FRAME), _at(PIN)), (_at(LINK, 15 * mm),))
    placed = tree.replaced(replace(body, positions=(moved,)) if body.id == "frame" else body for body in tree.bodies)
    assert len(meetings(placed)) == 2


@pytest.mark.parametrize(("x", "diameter", "z"), [(10 * um, 12 * mm, 0.0), (0.0, 12.01 * mm, 0.0), (0.0, 12 * mm, 0.1)])
def test_parts_beside_each_other_do_not_meet(x: float, diameter: float, z: float) -> None:
    tree = _tree((_at(_plate("frame", (x, diameter))),), (_at(PIN, z),))
    assert (meetings(tree), tolerances_of(tree)) == ((), {})


@pytest.mark.parametrize("machine", ["tufting", "weaver", "beat-up", "tension-compensator", "hand-shed"])
def test_what_runs_has_play_and_what_is_fixed_has_none(machine: str) -> None:
    """Over all meetings of two made parts: each has one class, and yet every pair has the fit of its joint."""
    tree = MACHINES[machine].tree(default_design(machine))
    classes = {
        (part, feature.nominal, tuple(feature.position.origin.tolist())): feature
        for part, features in tolerances_of(tree).items()
        for feature in features
        if not feature.depth
    }
    pairs = 0
    for meeting in meetings(tree):
        own = [
            classes.get((seat.part.id, round(seat.feature.size, 9), tuple(seat.feature.position.origin.tolist())))
            for seat in (meeting.bore, meeting.inner)
        ]
        hole, shaft = own
        if hole is None or shaft is None or hole.kind is FeatureKind.SQUARE_BORE:
            continue
        pairs += 1
        least, largest = hole.lower - shaft.upper, hole.upper - shaft.lower
        keyed = meeting.bore.feature.keyway or meeting.inner.feature.keyway
        if meeting.joint is not JointKind.FIXED:
            assert 0 < least < largest < (200 if hole.tolerance == "H11" else 100) * um  # drilled deep
        elif keyed:
            assert least <= 0 < largest
        else:
            assert least < 0
    assert pairs > 0


def test_the_face_under_a_rail_is_flat() -> None:
    rail = guides.guide_rail("rail", "rail", LINEAR_GUIDES[2], 0.8)
    beam = _made("beam", box(40 * mm, 20 * mm, 1.0))
    on_it = Occurrence(rail, (placement(0.0, 10 * mm, 0.1),))
    ((face,),) = tolerances_of(Tree((RigidBody("rail", (_at(beam), on_it)),))).values()
    assert (face.part, face.kind, face.mates, face.nominal) == ("beam", FeatureKind.FACE, ("rail",), 0.8)
    assert face.position.origin.tolist() == pytest.approx([0.0, 10 * mm, 0.5])
    assert face.position.rotation[:, 2].tolist() == pytest.approx([0.0, 1.0, 0.0])
    (flat,) = face.geometric
    assert (flat.characteristic, flat.value) == (Characteristic.FLATNESS, pytest.approx(24 * um))
    lifted = Occurrence(rail, (placement(0.0, 10.1 * mm, 0.1),))
    assert tolerances_of(Tree((RigidBody("rail", (_at(beam), lifted)),))) == {}


def test_features_of_a_sum_lie_where_its_members_do() -> None:
    two = Sum((Placed(tube(20 * mm, 4 * mm, 10 * mm), (placement(x=1.0, about=(0.0, 1.0, 0.0), angle=math.pi / 2),)),))
    bore, outside = features_of_size(two)
    assert (bore.inside, outside.inside, bore.length) == (True, False, pytest.approx(10 * mm))
    assert bore.position.origin.tolist() == pytest.approx([1.0, 0.0, 0.0])
    assert np.abs(bore.position.rotation[:, 2]).tolist() == pytest.approx([1.0, 0.0, 0.0])


def test_the_specification_of_a_part_states_its_process_and_hardening() -> None:
    hardened = Part("pin", "pin", "pin or bush", bar(8 * mm, 0.1), MATERIALS["induction-hardened steel"])
    made = specification(hardened)
    assert made.hardening is not None
    assert (made.hardening.kind, made.hardening.hardness, made.depth) == ("SHD", 55, pytest.approx(1 * mm))
    frame = specification(_made("beam", box(0.1, 0.1, 1.0), "welded frame"))
    assert (frame.designation, frame.general, frame.roughness) == ("S235JR EN 10025-2", "ISO 13920-AF", None)
