"""The loom of the thesis (chapter 3): 600 warps at 2 mm, 15 N each, tube 140 x 5 mm, cams at 5 rpm, four steps."""

import pytest
from default_machines import loom_report

from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.cyclogram import BEATER, EVEN, ODD
from ilmek.timing.cyclogram import Moment, moment_angle
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import deg, g, m, mm


@pytest.fixture(scope="module")
def loom() -> LoomDesign:
    return design(
        AutomatedLoomParams(
            aim="price",
            selvedge_warps=0,
            beat="guide-cams",
            weft="shuttle",
            pile_height=8 * mm,
            yarns=CarpetYarnParams(pile_density=0.8 * g / m),
        )
    )


def test_warps_and_knots_of_chapter_3_1(loom: LoomDesign) -> None:
    assert (loom.warps, loom.task.cloth.warp_pitch) == (600, 2 * mm)
    assert loom.columns == 300
    assert loom.warp_tension.params.cloth.warp_tension == pytest.approx(15.0)


def test_cylinder_of_chapter_3_1(loom: LoomDesign) -> None:
    assert loom.tube == pytest.approx((140 * mm, 5 * mm))
    # Eq. 3.8: 600 x 15 N x 0.07 m.
    assert loom.warp_tension.torque == pytest.approx(630.0)


def test_cams_of_chapter_3_2(loom: LoomDesign) -> None:
    # 30 (sqrt 13 - 1) mm for 60 mm lift in 90 degrees, harmonic, at 30 degrees; 12 s a turn at 5 rpm.
    assert loom.shedding.cam.prime_radius == pytest.approx(78.16653826 * mm)
    assert loom.row_cyclogram.period == pytest.approx(12.0)
    warps = loom.row_cyclogram.track(EVEN)
    assert peak_speed(warps, 12.0) == pytest.approx(31.41592654 * mm)
    assert peak_acceleration(warps, 12.0) == pytest.approx(32.89868134 * mm)


def test_four_steps_of_chapter_3_3(loom: LoomDesign) -> None:
    angles = [
        moment_angle(loom.row_cyclogram, moment) / deg
        for moment in (
            Moment(EVEN, "lift", "end"),
            Moment(EVEN, "lower", "end"),
            Moment(ODD, "lift", "end"),
            Moment(ODD, "lower", "end"),
        )
    ]
    assert angles == pytest.approx([90, 180, 270, 360])
    order = (
        Moment("shuttle", "pass"),
        Moment(BEATER, "beat 1"),
        Moment("shuttle", "pass back"),
        Moment(BEATER, "beat 2"),
    )
    steps = [int(moment_angle(loom.row_cyclogram, moment) / deg // 90) for moment in order]
    assert steps == [0, 1, 2, 3]


def test_the_thesis_loom_has_no_room_behind_the_warps_for_what_drags_its_shuttles(loom: LoomDesign) -> None:
    """The thesis prints no drive of the shuttle; a carriage behind the warps is in the way of cams that sink."""
    (failed,) = loom_report(loom).failed
    assert failed.name == "clearance: guide cams that sink and carriage of the shuttle"
    cam, carrier = loom.side.cams[0], loom.side.carrier
    sunk = cam.at.imag - cam.guide_radius - loom.side.beat_stroke
    assert failed.value == pytest.approx(sunk - carrier.corner.imag - carrier.size.imag)
    assert failed.value < 0


def test_one_head_takes_the_time_of_the_facts_sheet() -> None:
    # 135,000 knots at 2 s by one head: 75 h for the knots alone.
    one = design(AutomatedLoomParams(aim="price", heads=1))
    assert one.rows * one.columns * one.times.knot / 3600 == pytest.approx(75.0)
