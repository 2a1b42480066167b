"""Hands that tie: their search, the proof of the knot, clearances in space, the bound, parts and servos."""

import dataclasses
import math
from functools import cache

import numpy as np
import pytest

from ilmek.elements.micro_servos import MARGIN, MICRO_SERVOS, lightest_servo
from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.knotting_four_bar.hands import HANDS, HandsTask, TyingHands, design
from ilmek.machines.knotting_four_bar.hands.batch import moved
from ilmek.machines.knotting_four_bar.hands.beside import heads_for, kinds
from ilmek.machines.knotting_four_bar.hands.design import proof
from ilmek.machines.knotting_four_bar.hands.hand import TyingHand
from ilmek.machines.knotting_four_bar.hands.parts import HandParts, hands_tree
from ilmek.machines.knotting_four_bar.hands.section import NEIGHBOURS, InclinedSection, least_inclination
from ilmek.part.contacts import contacts
from ilmek.report import Animation
from ilmek.sentences.nouns_turkish import named
from ilmek.units import deg, mm

TASK = {"knot": "turkish", "cloth.warp_pitch": "4mm", "inclination": "80deg", "tried": "1000"}


@cache
def made(**given: str) -> TyingHands:
    return design(HandsTask.read({**TASK, **given}))


def parts_of(hands: TyingHands) -> HandParts:
    assert hands.made is not None
    return hands.made


def hand_for(knot: str) -> TyingHand:
    """The hand of the search, leading the ends for another knot on two warps."""
    hand = parts_of(made()).hand
    task = dataclasses.replace(hand.section.task, knot=knot)
    return dataclasses.replace(hand, section=dataclasses.replace(hand.section, task=task))


def test_the_hands_tie_and_keep_every_limit() -> None:
    hands = made()
    report = HANDS.report(hands)
    assert hands.ties
    assert not report.failed
    assert hands.candidates > 0
    assert [plane.inclination for plane in hands.planes] == [pytest.approx(80 * deg)]


@pytest.mark.parametrize("knot", ["turkish", "persian-left", "persian-right"])
def test_the_same_hands_tie_each_knot_by_when_they_lead(knot: str) -> None:
    hand = hand_for(knot)
    assert proof(hand).knot == hand.section.task.knot_after(NEIGHBOURS)


def test_led_both_in_one_direction_no_symmetric_knot_is_tied() -> None:
    """The proof of another knot is no proof of this one: a check that can fail."""
    wrong = dataclasses.replace(made(), tied=proof(hand_for("persian-left")))
    assert not wrong.ties
    assert any(check.name == "knots tied, proved" and not check.ok for check in HANDS.checks(wrong))


def test_a_finger_keeps_its_clearance_in_space() -> None:
    """Corners of the blade's section in three dimensions, against warps as lines, from the engine's motion."""
    hand = parts_of(made()).hand
    section, task = hand.section, hand.section.task
    motion = hand.stroke(301)
    angles = np.linspace(0.0, hand.span, 200)
    b = section.inclination
    across, along = np.array([math.cos(b), 0.0, -math.sin(b)]), np.array([math.sin(b), 0.0, math.cos(b)])
    least = np.inf
    for edge in (-0.5, 0.5):
        arc = hand.centre - 1j * (hand.radius + edge * task.finger_width) * np.exp(-1j * angles)
        local = np.array([hand.on_coupler(complex(at)) for at in arc])
        points = motion.origin("coupler")[:, None] + motion.direction("coupler")[:, None] * local
        for side in (-0.5, 0.5):
            space = np.stack([points.real, points.imag, np.full(points.shape, side * task.finger_thickness)], axis=-1)
            for number in range(-6, 6):
                off = space - (number + 0.5) * task.cloth.warp_pitch * across
                off -= (off @ along)[..., None] * along
                least = min(least, float(np.min(np.linalg.norm(off, axis=-1))) - task.warp / 2)
    assert hand.clearance <= least <= hand.clearance + 0.06 * mm
    assert hand.clearance >= task.clearance


def test_positions_of_the_search_are_those_of_the_engine_and_close() -> None:
    hand = parts_of(made()).hand
    hands, closed = moved(hand.section, hand.pins, 801)
    assert closed.all()
    active = hands.active[0]
    links = hand.four_bar.lengths
    b0, a0 = hand.four_bar.b0, hand.four_bar.a0
    np.testing.assert_allclose(np.abs(hands.a[0, active] - a0), links.crank, rtol=1e-12)
    np.testing.assert_allclose(np.abs(hands.b[0, active] - b0), links.rocker, rtol=1e-12)
    np.testing.assert_allclose(np.abs(hands.b[0, active] - hands.a[0, active]), links.coupler, rtol=1e-12)
    motion = hand.stroke(11)
    tips = motion.origin("coupler") + motion.direction("coupler") * hand.tip
    path = hands.tip[0, active]
    assert max(float(np.min(np.abs(path - tip))) for tip in tips) < 0.1 * mm
    crank = np.unwrap(np.angle(hands.a[0, active] - a0))
    assert np.all(np.diff(crank) > 0) or np.all(np.diff(crank) < 0)


@pytest.mark.parametrize("pitch", ["2mm", "4mm"])
def test_below_the_bound_no_arc_clears_warps_and_reaches_over_the_standoff(pitch: str) -> None:
    task = HandsTask.read({**TASK, "cloth.warp_pitch": pitch})
    bound = least_inclination(task)
    depths = np.linspace(0.1 * mm, 30 * mm, 20_000)
    for angle, possible in ((bound - 0.2 * deg, False), (bound + 0.2 * deg, True)):
        section = InclinedSection(task, angle)
        top = 2 * section.radius(depths) - depths
        clear = depths >= task.warp / 2 + task.finger_width / 2 + task.clearance
        assert bool(np.any(clear & (top >= task.standoff + 3 * mm))) == possible


def test_in_the_section_itself_no_hands_are_found_and_the_check_fails() -> None:
    hands = made(inclination="0deg")
    assert not hands.ties
    assert hands.made is None
    report = HANDS.report(hands)
    assert {check.name for check in report.failed} == {"hands within all limits", "knots tied, proved"}
    assert report.figures == ()


def test_nothing_is_through_another_and_all_parts_are_held() -> None:
    found = contacts(hands_tree(parts_of(made()), made().servo))
    assert not found.through
    assert len(found.groups) == 1


def test_every_part_has_a_turkish_noun() -> None:
    bodies = hands_tree(parts_of(made()), made().servo).bodies
    titles = {str(one.part.title) for body in bodies for one in body.occurrences}
    assert [title for title in sorted(titles) if named(title) == title] == []


def test_the_animation_ends_with_the_tied_yarn() -> None:
    moving = next(figure for figure in HANDS.figures(made()) if isinstance(figure, Animation))
    yarn = next(stroke for stroke in moving.strokes if stroke.role == "yarn").points
    assert np.all(yarn[0].imag > 0)
    assert np.min(yarn[-1].imag) < 0 < min(yarn[-1, 0].imag, yarn[-1, -1].imag)


def test_checks_of_servo_and_finger_fail_where_they_must() -> None:
    hands = made()
    weak = dataclasses.replace(hands, servo=None)
    assert any("servo" in check.name for check in HANDS.checks(weak) if not check.ok)
    parts = parts_of(hands)
    section = parts.hand.section
    pulled = dataclasses.replace(section, task=dataclasses.replace(section.task, yarn_pull=10.0))
    bent = dataclasses.replace(parts, hand=dataclasses.replace(parts.hand, section=pulled))
    assert any("bent" in check.name for check in HANDS.checks(dataclasses.replace(hands, made=bent)) if not check.ok)


def test_limits_that_contradict_are_named_together() -> None:
    with pytest.raises(ParameterError) as caught:
        HandsTask.read({"knot": "turkish", "cloth.warp_pitch": "1mm", "room_height": "20mm"})
    text = str(caught.value)
    assert "warps 1 mm apart" in text
    assert "a gap of" in text
    assert "room 20 mm high" in text


def test_a_knot_of_the_task_names_other_hands() -> None:
    machine, params = MACHINES["knotting-four-bar"].ordered({"task.knot": "jufti", "task.cloth.warp_pitch": "4mm"})
    assert machine is HANDS
    assert isinstance(params, HandsTask)
    assert MACHINES["knotting-four-bar"].ordered({})[0] is MACHINES["knotting-four-bar"]


def test_the_lightest_servo_bears_its_load() -> None:
    masses = [row.mass for row in MICRO_SERVOS]
    assert masses == sorted(masses)
    assert masses[0] >= 2e-3
    assert masses[-1] <= 60e-3
    torque, speed = np.array([0.0, 0.04, 0.02]), np.array([0.0, 3.0, 6.0])
    row = lightest_servo(torque, speed, 1.0)
    assert row is not None
    assert np.all(MARGIN * torque <= row.torque * (1 - speed / row.speed))
    lighter = [other for other in MICRO_SERVOS if other.mass < row.mass]
    assert not any(other.bears(torque, speed) for other in lighter)
    assert lightest_servo(torque, speed, 4.0, row.mass) is None  # beyond a servo's travel


def test_hands_beside_cams_and_arms_of_a_head() -> None:
    """Mass by the parts of the tree; with the time of the arms the head with hands ties as quickly as theirs."""
    hands = made()
    cams, arms, own = HANDS.tables(hands)[-1].rows
    assert [row[:2] for row in (cams, arms, own)] == [
        ("cams", "symmetric"),
        ("arms", "symmetric"),
        ("hands", "turkish"),
    ]
    bodies = hands_tree(parts_of(hands), hands.servo).bodies
    mass = sum(one.part.mass * len(one.positions) * len(body.positions) for body in bodies for one in body.occurrences)
    assert own[3] == pytest.approx(mass)
    assert own[3] < arms[3] < cams[3]
    assert own[4] < cams[4] < arms[4]
    assert cams[2] < arms[2] < own[2]
    inside = heads_for(hands.params)[1].weaver
    assert inside is not None
    assert kinds(hands.params, inside.params.arms.time, ())[2].cycle == pytest.approx(arms[2])
    assert own[2] - arms[2] > 0.5 * (0.8 - inside.params.arms.time)
