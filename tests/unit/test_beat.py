"""The beat of a loom: every kind behind one face, for the same task."""

import functools
import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS
from ilmek.machines import BEATS
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.cyclogram import HEADS
from ilmek.machines.beat import BeatDrive, stroke_needed
from ilmek.machines.catalogue import MACHINES
from ilmek.report import results_of
from ilmek.timing.cyclogram import Cyclogram, check_all
from ilmek.timing.track import peak_speed
from ilmek.units import turn


@functools.cache
def loom(beat: str, **settings: str) -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", **settings, "beat": beat}))


def driven(beat: str, **settings: str) -> BeatDrive:
    return loom(beat, **settings).beat


@pytest.mark.parametrize("kind", ["comb", "guide-cams"])
def test_the_comb_beats_as_quickly_as_its_acceleration_allows(kind) -> None:
    """Half of the time less the press for the stroke: a = Ca h / t^2."""
    beat = driven(kind).beat
    down = beat.forward * beat.time
    assert beat.law.acceleration_peak * beat.stroke / down**2 == pytest.approx(3.0)
    assert 2 * beat.forward + beat.pressed == pytest.approx(1.0)


@pytest.mark.parametrize("kind", BEATS)
@pytest.mark.parametrize("width", ["0.6m", "1.2m", "6m"])
def test_every_drive_is_as_strong_as_the_rows_need(kind, width) -> None:
    drive = driven(kind, width=width)
    assert drive.name == BEATS[kind]
    failed = [check.name for check in (*drive.checks, *drive.machine_checks) if not check.ok]
    assert failed == (["length of the flywheel"] if (kind, width) == ("linkage", "6m") else [])
    assert drive.beat_force_warp >= drive.beat_force_needed * (1 - 1e-9)
    assert drive.row_pitch_left <= drive.task.cloth.row_distance * (1 + 1e-9)
    assert drive.fabric.resistance(drive.row_pitch_left) == pytest.approx(drive.beat_force_warp)
    needed = stroke_needed(drive.task)
    assert needed * (1 - 1e-9) <= drive.path.rise
    # Crank-rockers may be longer, to clear the heads: property/test_beats_beside_heads.
    assert drive.crank_rockers or drive.path.rise <= needed + 2 * drive.task.params.clearance
    assert [work.per for work in drive.work] == ["beat"]
    assert drive.work[0].energy > drive.fabric.energy(drive.beat_force_needed)
    assert drive.frame_force > 0


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("kind", BEATS)
@pytest.mark.parametrize("pitch", ["0.25mm", "1mm", "4mm"])
def test_no_drive_raises_at_any_pitch(kind, pitch) -> None:
    drive = driven(kind, warp_pitch=pitch, width="0.8m")
    assert drive.beat_force_needed > 0
    for check in (*drive.checks, *drive.machine_checks):
        assert check.cure or check.ok, check.name


@pytest.mark.parametrize("kind", BEATS)
def test_the_path_leaves_the_fell_and_comes_back(kind) -> None:
    """At the fell between forward and back; at rest as high as the stroke's chord; the outline's edge is at 0."""
    drive = driven(kind)
    path, beat = drive.path, drive.beat
    assert abs(path(np.array([beat.forward]))[0]) == pytest.approx(0.0, abs=1e-3)
    ends = path(np.array([0.0, 1.0]))
    assert ends[0] == pytest.approx(ends[1], abs=1e-6)
    assert 0.9 * beat.stroke < ends[0].imag <= beat.stroke * (1 + 1e-9)
    assert drive.outline[0].imag.min() == 0.0
    assert min(float(path.tip.imag.min()), float(path.tip.real.min())) >= -1e-9


@pytest.mark.parametrize("kind", ["travelling", "linkage"])
def test_the_laws_of_the_cyclogram_follow_the_crank(kind) -> None:
    drive = driven(kind)
    beat, path = drive.beat, drive.path
    share = np.linspace(0.0, beat.forward, 50)
    arc = 2 * np.arcsin(np.abs(path(share)) / 2 / _arm(drive)) * _arm(drive)
    drawn = beat.stroke * (1 - beat.law.s(share / beat.forward))
    np.testing.assert_allclose(drawn, arc, atol=2e-3 * beat.stroke)


def _arm(drive: BeatDrive) -> float:
    one = drive.design.linkage.one if drive.name == "hammer" else drive.design
    return float(one.lengths["beater"])


def test_the_travelling_beater_strokes_across_the_width() -> None:
    """Whole warps as its force is enough for; the crank turns on, once a stroke, between a start and a stop."""
    drive = driven("travelling")
    assert drive.beaten == math.floor(drive.force / drive.beat_force_needed)
    assert drive.beat.strokes == math.ceil(drive.task.cloth.warps / drive.beaten)
    params = drive.design.params
    assert params.speed == pytest.approx(15.5)
    assert params.beater_mass == pytest.approx(2.5)
    assert drive.beat.time == pytest.approx((drive.beat.strokes + params.start.run_up) * turn / 15.5)
    assert sum(part.number for part in drive.parts if part.drives) == 2
    stands = driven("travelling", **{"beat-up.travel.mode": "start-stop"})
    single = (1 + params.start.run_up) * turn / 15.5
    assert stands.beat.time >= stands.beat.strokes * single * (1 - 1e-9)


def test_the_path_of_several_strokes_comes_to_the_fell_once_a_stroke() -> None:
    for mode in ("through", "start-stop"):
        drive = driven("travelling", **{"beat-up.travel.mode": mode})
        near = np.abs(drive.path(np.linspace(0.0, 1.0, 200_001))) < 1e-3
        assert np.count_nonzero(np.diff(near.astype(int)) == 1) == drive.beat.strokes


def test_results_of_a_drive() -> None:
    names = [one.name for one in results_of(driven("comb"))]
    assert {"beaters", "beat_force", "beat_force_warp", "beat_force_needed", "row_pitch_left"} <= set(names)
    assert {"beaten_warps", "beat_strokes", "beat_time", "beat_frame_force", "beat_warp_tension"} <= set(names)


def test_the_cams_go_down_on_the_guide_cams_alone() -> None:
    """With the carriages of both axes, 1 kg each, and the bearings and nuts of the cam shaft; see `moving_error`."""
    alone, together = driven("comb").design, driven("guide-cams").design
    assert alone.axis.mass == pytest.approx(alone.comb.mass + 2.0)
    stack = loom("guide-cams").machines["shedding"].design.stack.mass
    assert stack < together.axis.mass - together.comb.mass - 2.0 < 1.05 * stack
    assert alone.axis.mass < 40


def test_the_warp_is_tightened_by_the_yielding_fell() -> None:
    drive = driven("comb")
    yielded = float(drive.fabric.fell(drive.beat_force_warp))
    assert drive.warp_force_extra == pytest.approx(drive.fabric.warp_rate * yielded)


def test_values_set_for_the_machine_are_in_its_beat() -> None:
    law = driven("comb", **{"hammer.law": "cycloidal", "hammer.press_share": "0"}).beat
    assert law.law is LAWS["cycloidal"]
    assert law.forward == 0.5
    quick = driven("travelling", **{"beat-up.speed": "31rad/s"})
    assert quick.design.params.speed == 31.0
    assert quick.beaten > driven("travelling").beaten
    assert driven("linkage", **{"hammer.beaters": "2", "hammer.beat_speed": "20rad/s"}).crank_rockers == 2


def test_the_fabric_set_for_the_hammer_is_that_of_every_kind() -> None:
    usual = driven("comb")
    packing = f"{2e3 * usual.fabric.packing}mm"
    for kind in BEATS:
        harder = driven(kind, **{"hammer.packing": packing})
        assert harder.beat_force_needed == pytest.approx(2 * usual.beat_force_needed)


def test_a_comb_takes_the_time_of_its_beat_out_of_the_row() -> None:
    drive = driven("comb")
    params = drive.design.params
    assert params.step / params.shed_speed == pytest.approx(drive.beat.time)


def test_the_cams_stand_for_a_beat_that_takes_long() -> None:
    """The row is the turn of the cams, both stops, and both beats as far as the turn leaves no time for them."""
    made = loom("travelling")
    row, timing = made.row_cyclogram, made.row_timing
    assert check_order(row) == []
    cam_turn = timing.turning * row.period
    assert cam_turn == pytest.approx(turn / made.shedding.params.speed)
    beat = row.track("beater")
    first = (beat.segment("back 1").end - beat.segment("beat 1").start) / turn * row.period
    assert first == pytest.approx(made.beat.beat.time)
    closed = row.track("even warps").segment("lower").end
    stands = (turn / 2 - closed) / turn * row.period
    assert stands == pytest.approx((row.period - cam_turn) / 2)
    assert row.period < timing.beat.time * turn / (timing.beat_end - timing.window[1])
    at = np.array([0.0, closed / 2, closed, turn / 2 - 1e-9, turn / 2, turn / 2 + closed, turn - 1e-9])
    half = turn / 2
    np.testing.assert_allclose(timing.cam_angle(at), [0, half / 2, half, half, half, turn, turn], atol=1e-6)
    assert loom("comb").row_timing.turning == 1.0


def test_the_slide_crosses_the_carpet_while_the_beater_strokes() -> None:
    made = loom("travelling")
    slide, beater = made.row_cyclogram.track("slide of the beater"), made.row_cyclogram.track("beater")
    assert slide.segment("across").start >= beater.segment("beat 1").end * (1 - 1e-9)
    assert slide.segment("across").end <= beater.segment("back 1").start * (1 + 1e-9)
    assert slide.stroke == pytest.approx((made.task.cloth.warps - made.beat.beaten) * made.task.cloth.warp_pitch)


def check_order(row: Cyclogram) -> list[str]:
    return [check.name for check in check_all(row, row.relations) if not check.ok]


@pytest.mark.parametrize("kind", BEATS)
def test_the_motions_of_a_row_follow_each_other(kind) -> None:
    assert check_order(loom(kind).row_cyclogram) == []


def test_every_kind_names_a_machine() -> None:
    assert all(MACHINES[name].beat is not None for name in BEATS.values())


@pytest.mark.parametrize(("kind", "width"), [("travelling", "0.3m"), ("travelling", "1.2m"), ("linkage", "0.6m")])
def test_heads_retreat_in_time_from_what_beats_on_its_path(kind, width) -> None:
    """The row is timed by the retreat that the path needs; then the head is below all that beats, by the clearance."""
    made = loom(kind, width=width)
    heads = made.row_cyclogram.track(HEADS)
    assert heads.stroke == pytest.approx(made.side.of_heads.retreat)
    assert peak_speed(heads, made.row_cyclogram.period) <= made.params.retreat_speed * (1 + 1e-6)
    corners = np.concatenate(
        [made.beat.path.carried(one, made.beat.path.tip).ravel() for one in made.beat.path.outline]
    )
    top = made.side.of_heads.shape.top + made.side.of_heads.retreat * RETREAT.imag
    assert top + made.params.clearance <= min(0.0, corners.imag.min()) + 1e-9
