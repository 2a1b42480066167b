"""The knot that the head's grippers tie: proved from the cyclogram, and missed where order or reach are wrong."""

import math
from dataclasses import replace

import numpy as np
import pytest
from cloths import cloth

from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import Quality
from ilmek.errors import ParameterError
from ilmek.machines.weaver import MACHINE, WeaverParams, design
from ilmek.machines.weaver.grippers import clearance_min, crossing_point, taut
from ilmek.machines.weaver.knot import on_the_pair, tied_by
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, SIDE_GRASP, SIDE_MOTION
from ilmek.timing.cyclogram import Cyclogram, TrackEvent
from ilmek.timing.track import Track, TrackSegment


def moved(cyclogram: Cyclogram, track: str, **ends: tuple[float, float]) -> Cyclogram:
    """The cyclogram with motions of a track at other cam angles [rad]; spaces of names are underscores."""

    def part(one: TrackSegment) -> TrackSegment:
        at = ends.get(one.name.replace(" ", "_"))
        return one if at is None else replace(one, start=at[0], end=at[1])

    tracks = tuple(
        replace(one, segments=tuple(part(segment) for segment in one.segments), events=()) if one.name == track else one
        for one in cyclogram.tracks
    )
    return replace(cyclogram, tracks=tracks)


@pytest.mark.parametrize("law", ["modified-sine", "cycloidal", "parabolic"])
@pytest.mark.parametrize("pitch", [0.001, 0.004, 0.02, 0.1])
def test_the_head_ties_the_symmetric_knot_at_any_pitch(law: str, pitch: float) -> None:
    made = design(WeaverParams(law=law, cloth=cloth(warp_pitch=pitch / 2)))
    assert made.knot_tied == "symmetric"
    assert made.tied.word == (-2, -3)


def test_the_yarn_drawn_is_the_yarn_bills() -> None:
    head = design(WeaverParams(pile_height=0.010, cut_waste=0.002, cloth=cloth(pile_density=0.9e-3)))
    billed = knot_length("symmetric", Quality(250.0, 250.0), 0.9e-3, PileParams(pile_height=0.010, cut_waste=0.002))
    results = MACHINE.report(head).as_json()["results"]
    assert results["yarn_drawn"] == pytest.approx(billed, rel=1e-12)
    assert results["yarn_in_knot"] == pytest.approx(billed - 0.004, rel=1e-12)
    assert results["cut_waste"] == pytest.approx(0.004, rel=1e-9)


def test_short_yarn_of_a_fine_carpet_is_drawn_longer_and_reported() -> None:
    made = MACHINE.report(design(WeaverParams(cloth=cloth(warp_pitch=0.00025), pile_height=0.003)))
    results = made.as_json()["results"]
    assert results["yarn_drawn"] > results["yarn_billed"] + 0.005
    assert [check.name for check in made.failed] == ["opener: points between two warps", "sag of the head at its tools"]
    assert "reach round the pair with no less" in made.warnings[0]


def test_a_bill_that_is_given_is_drawn_or_more_where_the_grippers_need_it() -> None:
    long, short = design(WeaverParams(knot_yarn=0.045)), design(WeaverParams(knot_yarn=0.030))
    assert long.drawn == 0.045
    assert MACHINE.report(long).warnings == ()
    assert short.drawn > 0.032
    assert "more yarn than the bill's" in MACHINE.report(short).warnings[0]


def test_yarn_too_short_for_a_turn_that_is_given_fails() -> None:
    failed = [check.name for check in MACHINE.report(design(WeaverParams(crossing_turn=math.pi))).failed]
    assert failed == ["yarn needed between the grippers", "room of the side grippers"]


def test_no_asymmetric_knot_and_why() -> None:
    made = MACHINE.report(design(WeaverParams(knot="asymmetric")))
    assert [check.name for check in made.failed] == ["asymmetric knot tied"]
    assert "both come out between them" in made.warnings[0]
    assert made.as_json()["results"]["knot_tied"] == "symmetric"


def test_ends_let_go_behind_the_warps_tie_no_knot() -> None:
    """As the thesis may be read: the centre gripper opens, and then goes back."""
    head = design(WeaverParams())
    back = head.cyclogram.track(CENTRE_MOTION).segment("return")
    early = moved(head.cyclogram, CENTRE_GRASP, open=(back.start - 0.1, back.start - 0.01))
    tied = tied_by(early, head.grippers, head.params.jaw)
    assert on_the_pair(tied) is None
    assert "behind the front of the warps" in tied.words


def test_side_grippers_that_let_go_too_early_tie_no_knot() -> None:
    head = design(WeaverParams())
    taken = head.cyclogram.track(CENTRE_GRASP).segment("close")
    early = moved(head.cyclogram, SIDE_GRASP, open=(taken.start - 0.05, taken.end - 0.01))
    assert "before the centre gripper holds it" in tied_by(early, head.grippers, head.params.jaw).words


def test_warps_that_close_on_a_gripper_tie_no_knot() -> None:
    head = design(WeaverParams())
    out = head.cyclogram.track(CENTRE_MOTION).segment("return")
    back = head.cyclogram.track(SIDE_MOTION).segment("turn back")
    middle = (out.start + out.end) / 2
    ends = {"turn_back": (back.start, middle - 0.1), "return": (middle - 0.1, out.end)}
    early = moved(head.cyclogram, SIDE_MOTION, **ends)
    assert "the warps are not held open" in tied_by(early, head.grippers, head.params.jaw).words


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        (dict(crossing_turn=1.8), "the ends do not cross"),
        (dict(jaw=0.002), "jaws open 2 mm"),
        (dict(crossing=0.008), "into the side grippers' arms"),
    ],
)
def test_dimensions_that_do_not_tie_say_why(settings: dict[str, float], why: str) -> None:
    made = design(WeaverParams(**settings))
    assert made.knot_tied is None
    assert why in made.tied.words
    assert "symmetric knot tied" in [check.name for check in MACHINE.report(made).failed]


def test_the_pair_must_leave_the_centre_gripper_room() -> None:
    with pytest.raises(ParameterError, match="leaves the centre gripper no path"):
        WeaverParams(pair_opened=0.003)


def test_geometry_of_the_default_grippers() -> None:
    """The arm from the yarn, the turn that crosses the ends, the room before the arms; all by hand."""
    params, head = WeaverParams(), design(WeaverParams())
    by = head.grippers
    assert by.apart == pytest.approx(head.drawn - 2 * params.tail)
    assert by.end.real == pytest.approx(params.overlap)
    assert by.axis - by.pair / 2 == pytest.approx(by.warp / 2 + by.finger / 2 + by.clearance)
    assert -by.end.imag - by.stagger - by.finger / 2 - by.depth == pytest.approx(params.clearance)
    assert clearance_min(by) == pytest.approx(params.clearance)
    assert crossing_point(by).real == 0.0


def test_taut_yarn_is_shorter_than_any_other_way_round_the_warps() -> None:
    """Against the length of the polygon that hugs both warps, from tip to tip."""
    by = design(WeaverParams()).grippers
    far = np.array([by.opening + by.crossing])
    radius = (by.warp + by.yarn) / 2
    ring = radius * np.exp(1j * np.linspace(0.0, 2 * np.pi, 721)) - by.pair / 2
    top = np.argmax(ring.imag)
    around = sum(
        min(
            float(np.abs(np.diff(ring[top:at])).sum() + abs(ring[at - 1] - tip))
            for at in range(top + 90, top + 420)
            if _sees(tip, complex(ring[at - 1]), -by.pair / 2, radius)
        )
        for tip in (complex(by.tip(far)[0]), complex(-np.conj(by.tip(far, +1)[0])))
    )
    assert float(taut(by, far)[0]) == pytest.approx(np.hypot(by.pair + around, by.lift), rel=1e-4)


def test_the_arms_pass_one_another_where_their_ends_cross() -> None:
    """Bars of the finger's thickness, sampled over their travel and their length: nowhere nearer than the clearance."""
    params, by = WeaverParams(), design(WeaverParams()).grippers
    along = np.linspace(0.0, 1.0, 60)
    nearest = math.inf
    for position in np.linspace(by.opening, by.opening + by.crossing, 60):
        turn = float(by.turned(position))
        bars = []
        for hand in (-1, 1):
            tip = complex(by.tip(np.array(position), hand))
            rod = np.array([hand * by.axis, hand * by.lift / 2, tip.imag])
            arm = by.arm * np.array([hand * math.cos(turn), math.sin(turn), 0.0])
            bars.append(rod + along[:, None] * arm)
        nearest = min(nearest, float(np.linalg.norm(bars[0][:, None] - bars[1], axis=2).min()))
    assert nearest >= params.finger + params.clearance - 1e-9


def _sees(tip: complex, place: complex, axis: float, radius: float) -> bool:
    share = np.linspace(0.0, 0.98, 50)
    return bool((np.abs(tip + share * (place - tip) - axis) >= radius * (1 - 1e-9)).all())


def test_events_name_what_happens_to_the_yarn() -> None:
    names = [event.name for track in design(WeaverParams()).cyclogram.tracks for event in track.events]
    assert names.index("pile held") < names.index("warps open")
    assert {"knot held", "ends drawn out", "knot released", "knot down"} <= set(names)
    assert all(
        isinstance(event, TrackEvent) for track in design(WeaverParams()).cyclogram.tracks for event in track.events
    )
    assert all(isinstance(track, Track) for track in design(WeaverParams()).cyclogram.tracks)
