"""The beat of a loom: both machines behind one face, for the same task."""

import math
from dataclasses import replace

import pytest

from ilmek.cams.laws import LAWS
from ilmek.machines import BEATS
from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.beat import BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.loom_task import LoomTask
from ilmek.report import results_of
from ilmek.units import mm, turn


class Cams:
    """As much of the shedding's design as the comb needs."""

    class stack:
        mass = 500.0


def task_of(**settings) -> LoomTask:
    return LoomTask(AutomatedLoomParams.read(settings), 450, 300, 15.0, 1800.0, {"shedding": Cams}, period=12.0)


def planned(**settings) -> PlannedBeat:
    task = task_of(**settings)
    plan = MACHINES[BEATS[task.params.hammer]].beat
    assert plan is not None
    return plan(task)


def driven(**settings) -> BeatDrive:
    return planned(**settings).drive(task_of(**settings))


def test_the_comb_beats_as_quickly_as_its_acceleration_allows() -> None:
    """Half of the time less the press for the stroke: a = Ca h / t^2."""
    beat = planned(hammer="comb").beat
    down = beat.forward * beat.time
    assert LAWS[beat.law].acceleration_peak * 100 * mm / down**2 == pytest.approx(3.0)
    assert 2 * beat.forward + beat.pressed == pytest.approx(1.0)


def test_a_crank_rocker_beats_once_a_turn() -> None:
    beat = planned(hammer="linkage").beat
    assert (beat.time, beat.forward, beat.pressed) == pytest.approx((turn / 15.5, 0.5, 0.0))


@pytest.mark.parametrize("hammer", BEATS)
def test_every_drive_states_force_parts_work_and_rows(hammer) -> None:
    drive = driven(hammer=hammer)
    assert drive.name == BEATS[hammer]
    assert drive.force > 0
    assert sum(part.number for part in drive.parts if part.drives) == (1 if hammer == "linkage" else 2)
    assert [work.per for work in drive.work] == ["beat"]
    assert drive.work[0].energy > 0
    assert drive.fabric.resistance(drive.row_pitch_left) == pytest.approx(drive.force / 600)
    assert drive.beat_force_needed == pytest.approx(10.0)
    assert [one.name for one in results_of(drive)] == [
        "beaters",
        "beat_force",
        "beat_force_width",
        "beat_force_warp",
        "beat_force_knot",
        "beat_torque_max",
        "beat_force_needed",
        "row_pitch_left",
    ]


def test_crank_rockers_share_the_beater_of_a_wide_loom() -> None:
    one, two = driven(), driven(width="2.4m")
    assert (one.number, two.number) == (1, 2)
    assert two.force == pytest.approx(2 * one.force)
    assert two.torque == pytest.approx(2 * one.torque)
    assert two.work[0].energy == pytest.approx(2 * one.work[0].energy)
    component = MACHINES["beat-up"]
    (single,) = component.work(two.design)
    assert two.work[0].energy == pytest.approx(2 * single.energy)
    assert component.parts(two.design)[0].mass == pytest.approx(two.parts[0].mass / 2)


def test_values_set_for_the_machine_are_in_its_beat() -> None:
    law = planned(hammer="comb", **{"hammer.law": "cycloidal", "hammer.press_share": 0.0}).beat
    assert (law.law, law.forward) == ("cycloidal", 0.5)
    assert planned(**{"beat-up.speed": "31rad/s"}).beat.time == pytest.approx(turn / 31)


def test_the_comb_takes_the_time_of_its_beat_out_of_the_row() -> None:
    drive = driven(hammer="comb")
    params = drive.design.params
    assert params.step / params.shed_speed == pytest.approx(drive.beat.time)
    assert drive.design.axis.mass == pytest.approx(500.0 + drive.design.comb.mass)
    later = replace(task_of(hammer="comb"), period=24.0)
    slower = planned(hammer="comb").drive(later).design.params
    assert slower.step == pytest.approx(params.step / 2)
    assert math.isclose(slower.step / slower.shed_speed, drive.beat.time)
