"""The knotting head: the arm's way, what is tied by it and by wrong hand-overs, and how clear everything stays."""

import dataclasses
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from ilmek.machines.knotting_dyad import MACHINE, KnottingDyad, KnottingDyadParams, design
from ilmek.machines.knotting_dyad.clearance import arm_bars, mirrored_bars, to_warps
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.section import NEIGHBOURS, section_of
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT, Phase, sequence
from ilmek.machines.knotting_dyad.yarn import tied_by
from ilmek.plane.round_bars import apart
from ilmek.report import Animation
from ilmek.weaving.knots.word import knot


@cache
def made(**settings: str) -> KnottingDyad:
    return design(KnottingDyadParams.read(settings))


def head(**settings: str) -> Head:
    found = made(**settings).head
    assert found is not None
    return found


CLOSED = {"opening": "0mm", "cloth.yarns.warp_diameter": "0.8mm"}
"""Warps of 0.8 mm without an opener, with `pair_opened` as the pitch."""

SECTIONS: list[dict[str, str]] = [
    {},
    {"cloth.warp_pitch": "1.25mm", "cloth.yarns.warp_diameter": "0.5mm", "cloth.yarns.pile_density": "0.167g/m"},
    {"cloth.warp_pitch": "8mm"},
    {"cloth.warp_pitch": "1.5mm", "cloth.yarns.warp_diameter": "0.5mm", "opening": "0.7mm"},
    {
        "cloth.warp_pitch": "0.5mm",
        "cloth.yarns.warp_diameter": "0.2mm",
        "needle_diameter": "0.15mm",
        "clearance": "20um",
        "cloth.yarns.pile_density": "0.042g/m",
        "yarn_pull": "0.2N",
    },
]


@pytest.mark.parametrize("settings", SECTIONS)
def test_every_check_holds_and_the_needle_has_the_greatest_clearance_that_the_section_has(
    settings: dict[str, str],
) -> None:
    assert not MACHINE.report(made(**settings)).failed
    found = head(**settings)
    assert found.clearance_min == pytest.approx(found.section.clearance_bound, abs=1e-9)


@pytest.mark.parametrize("settings", SECTIONS)
def test_the_needle_always_goes_through_the_middle_of_the_gap_and_both_links_keep_their_length(
    settings: dict[str, str],
) -> None:
    arm, s = head(**settings).arm, np.linspace(0, 1, 501)
    elbow, tip = arm.elbow(s), arm.tip(s)
    along = (tip - elbow) / arm.second
    assert np.abs(along) == pytest.approx(np.ones(501), abs=1e-12)
    assert np.abs(elbow - arm.pivot) == pytest.approx(np.full(501, arm.first), abs=1e-15)
    assert (np.conj(along) * (arm.swivel - elbow)).imag == pytest.approx(np.zeros(501), abs=1e-14)
    assert tip[-1] == pytest.approx(head(**settings).section.handover, abs=1e-12)


@pytest.mark.parametrize("settings", SECTIONS)
def test_each_derivative_of_the_joint_angles_is_that_of_a_polynomial_through_the_one_before(
    settings: dict[str, str],
) -> None:
    """One derivative at a time: three in one go lose nine digits, and how many more depends on the arm found."""
    arm, s = head(**settings).arm, np.linspace(0, 1, 33)
    for lower, higher in pairwise(("theta", "first", "second", "third")):
        exact = getattr(arm.path(s), higher)
        for joint in (0, 1):

            def values(s: np.ndarray, name: str = lower, joint: int = joint) -> np.ndarray:
                return getattr(arm.path(s), name)[:, joint]

            slope = np.polynomial.Chebyshev.interpolate(values, 60, domain=[0, 1]).deriv()(s)
            assert slope == pytest.approx(exact[:, joint], abs=1e-7 * np.abs(exact[:, joint]).max())


def test_no_point_of_an_arm_is_faster_than_its_bound_and_no_pose_nearer_to_straight() -> None:
    for settings in SECTIONS:
        arm, s = head(**settings).arm, np.linspace(0, 1, 4001)
        bars = arm_bars(head(**settings).section, arm, s)
        fastest = max(np.abs(np.diff(places, axis=0)).max() / s[1] for places in (bars.starts, bars.ends))
        assert fastest <= arm.speed_bound < 3 * fastest
        theta = arm.path(s).theta
        assert np.abs(np.sin(theta[:, 1] - theta[:, 0])).min() == pytest.approx(arm.bend, rel=1e-9)


@pytest.mark.parametrize("settings", SECTIONS[:4])
def test_no_sampled_distance_is_less_than_the_least_that_is_reported(settings: dict[str, str]) -> None:
    found, rng = head(**settings), np.random.default_rng(7)
    told = {one.name: one for one in found.least}
    s, t = rng.uniform(0, 1, (2, 4000))
    s, t = np.where(s + t > 1, 1 - s, s), np.where(s + t > 1, 1 - t, t)
    left = arm_bars(found.section, found.arm, s)
    right = mirrored_bars(found.section, arm_bars(found.section, found.arm, t))
    for name, sampled in (("arms to warps", to_warps(found.section, left)), ("arm to arm", apart(left, right))):
        assert sampled.min() >= told[name].value - told[name].sure
    assert to_warps(found.section, right).min() >= told["arms to warps"].value - told["arms to warps"].sure
    assert told["arm to arm"].value > 0


def test_there_are_six_warps_on_each_side_of_the_pair_and_the_opener_moves_them_aside() -> None:
    shut, opened = (section_of(KnottingDyadParams(opening=one, pair_opened=2e-3)).warps for one in (0.0, 0.7e-3))
    assert len(shut) == 2 * NEIGHBOURS + 2
    assert np.diff(shut.real) == pytest.approx(np.full(13, 0.002))
    wide = np.full(13, 0.002)
    wide[[5, 7]] = 0.0027
    assert np.diff(opened.real) == pytest.approx(wide)
    assert opened[6] == 0


KNOTS = [("symmetric", "left"), ("asymmetric", "left"), ("asymmetric", "right")]


@pytest.mark.parametrize(("kind", "opens"), KNOTS)
def test_the_phases_tie_the_knot_and_no_other(kind: str, opens: str) -> None:
    found = head(knot=kind, opens=opens)
    assert found.tied.knot == knot(kind, NEIGHBOURS + 1, opens=opens)
    assert MACHINE.report(made(knot=kind, opens=opens)).as_json()["results"]["knot_tied"] == kind


def _carried(phases: tuple[Phase, ...], end: int, *by: str) -> tuple[Phase, ...]:
    """The phases with other carriers of an end."""
    return tuple(
        dataclasses.replace(phase, carries=(carrier, phase.carries[1]) if end == 0 else (phase.carries[0], carrier))
        for phase, carrier in zip(phases, by, strict=True)
    )


def test_an_arm_that_keeps_its_end_ties_nothing_round_its_warp() -> None:
    found = head()
    kept = _carried(found.sequence, 0, LEFT, LEFT, LEFT, LEFT, "", "", "")
    assert tied_by(found.section, found.arm, kept).words.startswith("no knot: the yarn only passes behind warp 8")
    both = _carried(kept, 1, *(RIGHT,) * 7)
    assert tied_by(found.section, found.arm, both).words == "no knot: pulled, the yarn comes away from every warp"


def test_the_carriers_of_the_other_side_tie_the_mirrored_knot() -> None:
    found = head(knot="asymmetric", opens="left")
    phases = sequence(knot("asymmetric", NEIGHBOURS + 1, opens="right"), found.section.front, -found.section.depth)
    tied = tied_by(found.section, found.arm, phases)
    assert tied.knot is not None
    assert tied.knot.opens == "right"
    assert tied.knot != found.knot


def test_a_hand_over_at_two_positions_is_reported_with_the_distance() -> None:
    found = head()
    early = _carried(found.sequence, 0, CENTRE, LEFT, CENTRE, "", "", "", "")
    assert "first end is 14 mm from the left gripper" not in tied_by(found.section, found.arm, found.sequence).words
    words = tied_by(found.section, found.arm, early).words
    assert words.startswith("no knot: at 'centre gripper to the left arm' the first end is ")


def test_a_needle_that_just_passes_the_warps_is_distinguished_from_one_that_does_not() -> None:
    """A long way past warps that leave it 0.02 mm: coarse samples do not tell on which side it passes."""
    fine = {"cloth.warp_pitch": "0.54mm", "cloth.yarns.warp_diameter": "0.43mm"}
    fine |= dict(needle_diameter="0.05mm", clearance="0mm", depth="2.4mm")
    fine |= dict(opening="0mm", pair_opened="0.54mm")
    found = head(**fine, leg="33mm")
    assert 0 < found.clearance_min < 0.03e-3
    assert found.tied.knot == found.knot


def test_an_end_left_behind_the_warps_is_no_knot() -> None:
    found = head()
    left = _carried(found.sequence, 0, LEFT, LEFT, "", "", "", "", "")
    assert "4.701 mm behind the front of the warps" in tied_by(found.section, found.arm, left).words


def test_the_needle_bends_as_the_curvature_of_a_clamped_bar_adds_up() -> None:
    found, pull, modulus = head(), 0.5, 210e9
    section, arm = found.section, found.arm
    s = np.linspace(0, 1, 2001)
    way = np.gradient(arm.tip(s), s)
    needle = np.exp(1j * arm.path(s).theta[:, 1])
    across = pull * np.abs((np.conj(needle) * way).imag) / np.abs(way)
    inertia = 2e-3 * section.needle**3 / 12
    most = 0.0
    for at in range(0, 2001, 20):
        x = np.linspace(0, section.needle_length - arm.beyond(s[at : at + 1])[0], 2001)
        if x[-1] <= section.needle_length:
            curvature = across[at] * (section.needle_length - x) / (modulus * inertia)
            slope = np.append(0, np.cumsum((curvature[1:] + curvature[:-1]) / 2 * np.diff(x)))
            most = max(most, float(np.sum((slope[1:] + slope[:-1]) / 2 * np.diff(x))))
    assert found.bent == pytest.approx(most, rel=1e-2)


def test_a_thin_needle_bends_into_the_warps_and_is_reported() -> None:
    found = MACHINE.report(made(needle_diameter="0.1mm"))
    assert [check.name for check in found.failed] == [
        "needle bent aside by the yarn",
        "needle against buckling under the yarn's pull",
        "stress of a finger",
    ]
    assert "the yarn bends the needle" in found.warnings[0]


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"cloth.warp_pitch": "1mm", "pair_opened": "1mm"}, "take finer warps, or a pair of warps 1.5 mm apart"),
        (
            {"cloth.warp_pitch": "1.4mm", "pair_opened": "1.4mm"},
            "take a needle of 0.4 mm or less, or a pair of warps 1.5 mm apart",
        ),
        ({"depth": "1mm", "pair_opened": "2mm"}, "try a depth of 2.27 mm or an opening of 4.68 mm"),
    ],
)
def test_too_little_room_is_a_failed_check_and_a_warning_that_says_what_to_change(
    settings: dict[str, str], said: str
) -> None:
    settings = {**CLOSED, **settings}
    found = MACHINE.report(made(**settings))
    assert [check.name for check in found.failed if "clearance" in check.name] == ["clearance over the whole cycle"]
    assert said in found.warnings[0]
    assert head(**settings).clearance_min < 1e-4


def test_what_a_warning_advises_helps() -> None:
    for better in (
        {"depth": "2.27mm", "pair_opened": "2mm"},
        {"depth": "1mm", "opening": "4.68mm", "pair_opened": "2mm"},
        {"cloth.warp_pitch": "1.4mm", "needle_diameter": "0.3mm", "pair_opened": "1.4mm"},
    ):
        assert head(**{**CLOSED, **better}).clearance_min >= 1e-4 - 1e-6


def test_a_given_depth_is_kept_and_a_deeper_hand_over_has_more_room() -> None:
    shut = {**CLOSED, "pair_opened": "2mm"}
    least, usual, most = (head(**shut, **depth).clearance_min for depth in ({"depth": "2.27mm"}, {}, {"depth": "6mm"}))
    assert least < usual < most
    assert head(depth="6mm").section.depth == pytest.approx(0.006)


def test_the_animation_shows_both_arms_that_never_do_more_than_one_way_together() -> None:
    moving = next(figure for figure in MACHINE.report(made()).figures if isinstance(figure, Animation))
    assert {stroke.label for stroke in moving.strokes} >= {"left arm", "right arm"}
    assert all(np.isfinite(stroke.points).all() for stroke in moving.strokes)
    assert [reading.values[0] for reading in moving.readings[:2]] == [0.0, 0.0]
    assert [reading.values.max() for reading in moving.readings[:2]] == pytest.approx([1.0, 1.0])
    assert np.max(moving.readings[0].values + moving.readings[1].values) == pytest.approx(1.0)
    assert moving.period == MACHINE.report(made()).as_json()["results"]["cycle_time"]
    tips = [stroke.points[:, 1] for stroke in moving.strokes if stroke.role == "outline"]
    assert len(tips) == 4
