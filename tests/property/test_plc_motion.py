"""The drive of the operations after the knots: axes against the tracks of their cyclogram, errors, stops, homing."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import plc_loom
import pytest
from plc_loom import PlcLoom
from small_programme import TIMES, small_programme
from structured_text import Machine

from ilmek.io.plc.cam_function import ERROR, variable_name
from ilmek.io.plc.homing_logic import HOME_CODES
from ilmek.io.plc.motion_blocks import AxisError
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.row_drive import DRIVE, MARGIN, MOST_LAG, RAMP, TRACK_AXES, span
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import ROW_END_AXES, LoomAxis
from ilmek.loom.control.ports import Fault
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import RowEnd
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.cyclogram import TAKE_UP, row_ends
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn

CYCLE = 0.01


@cache
def programme() -> CompiledProgramme:
    cyclograms = design(AutomatedLoomParams(aim="price", beat="linkage")).cyclograms
    times = replace(TIMES, row_ends=row_ends(next(one for one in cyclograms if one.name == "row")))
    return small_programme(3, 6, 1, 2, loom_times=times, cyclograms=cyclograms)


def row() -> Cyclogram:
    return next(one for one in programme().setup.cyclograms if one.name == "row")


class Drive:
    """The block, its task of a cycle, and the axes of its tracks."""

    def __init__(self) -> None:
        self.machine = Machine(plc_project(programme(), CYCLE).text)
        self.block = self.machine.instance(DRIVE)
        self.axes = {f"Axis{variable_name(track.name)}": track for track in row().tracks if track.name in TRACK_AXES}
        self.scans = 0

    def scan(self, **inputs: Any) -> None:
        self.scans += 1
        self.machine.run(self.block, **inputs)

    def read(self, name: str) -> Any:
        return self.machine.read(self.block, name)

    def order(self, code: int, most: int = 20_000) -> int:
        """Carry out an order; the scans that it took."""
        begin = self.scans
        self.scan(Start=True, Code=code)
        while not self.read("Done"):
            assert self.read("Status") == 1
            assert self.scans - begin < most
            self.scan()
        taken = self.scans - begin
        self.scan(Start=False)
        assert (self.read("Done"), self.read("Status")) == (False, 0)
        return taken

    def home(self) -> None:
        for code in HOME_CODES.values():
            self.order(code)


def test_each_axis_goes_to_its_switch_and_its_position_is_zero_there() -> None:
    drive = Drive()
    away = {name: drive.read(f"{name}.Actual") for name in drive.axes}
    assert all(position == 0 for position in away.values())
    drive.home()
    for name, track in drive.axes.items():
        assert drive.read(f"{name}.Homed")
        if track.name != TAKE_UP:
            simulated = drive.read(f"Simulated{name[4:]}.Where")
            assert simulated == pytest.approx(drive.read(f"{name}.Actual"), abs=0.01 * track.stroke)


def test_axes_follow_the_tracks_of_the_row_within_table_and_lag() -> None:
    """A row and a weft: an axis of the operation is where its track is at the master's angle; the others stand."""
    drive = Drive()
    drive.home()
    for code in (*RowEnd, RowEnd.STRAIGHT_WEFT):
        first, last = span(row(), code)
        standing = {name: drive.read(f"{name}.Commanded") for name in drive.axes}
        angles: list[float] = []
        positions: list[list[float]] = []
        drive.scan(Start=True, Code=int(code))
        while not drive.read("Done"):
            drive.scan()
            if drive.read("Cammed"):
                angles.append(drive.read("Master.Commanded"))
                positions.append([drive.read(f"{name}.Commanded") for name in drive.axes])
        for (name, track), found in zip(drive.axes.items(), np.array(positions[1:]).T, strict=True):
            exact = sample(track, np.minimum(angles[1:], turn)).position
            if TRACK_AXES[track.name] not in ROW_END_AXES[code]:
                exact = np.full_like(found, standing[name])
            assert found == pytest.approx(exact, abs=1.05 * ERROR * track.stroke + 1e-6)
        assert angles[-1] == pytest.approx(last, abs=1e-5)
        time = (last - first) / turn * row().period
        assert len(angles) * CYCLE == pytest.approx(time + RAMP, abs=3 * CYCLE + RAMP)
        drive.scan(Start=False)


@pytest.mark.parametrize("error", list(AxisError))
def test_an_axis_with_an_error_ends_the_order_as_a_fault_and_moves_no_more(error: AxisError) -> None:
    drive = Drive()
    drive.home()
    drive.scan(Start=True, Code=1)
    while not drive.read("Cammed"):
        drive.scan()
    axis = drive.block.values["AXISBEATER"].values
    stroke = next(track.stroke for name, track in drive.axes.items() if name == "AxisBeater")
    if error is AxisError.DRIVE:
        axis["DRIVEFAULT"] = True
    elif error is AxisError.FOLLOWING:
        axis["ACTUAL"] += 1.5 * MOST_LAG * stroke
    else:
        axis["HIGH"] = axis["COMMANDED"] - MARGIN * stroke
    drive.scan()
    assert drive.read("Status") == ALARMS[Fault.TIMEOUT].number
    assert drive.read("ErrorID") == error
    still = axis["ACTUAL"]
    for _ in range(20):
        drive.scan()
    assert axis["ACTUAL"] == still
    assert not axis["POWERED"]
    axis["DRIVEFAULT"] = False
    axis["HIGH"] = stroke * (1 + MARGIN)
    drive.scan(Start=False)
    drive.order(HOME_CODES[LoomAxis.BEATER])
    drive.order(1)


def test_halt_brings_all_axes_to_a_stop_in_their_cams_and_takes_their_power() -> None:
    drive = Drive()
    drive.home()
    drive.scan(Start=True, Code=0)
    while drive.read("Master.Commanded") < 0.4:
        drive.scan()
    before = drive.read("Master.Commanded")
    for _ in range(round(3 * RAMP / CYCLE)):
        drive.scan(Halt=True, Start=False)
    speed = turn / programme().setup.times.row_ends[-1]
    assert 0 < drive.read("Master.Commanded") - before < speed * RAMP
    for name, track in drive.axes.items():
        if TRACK_AXES[track.name] in ROW_END_AXES[RowEnd.STRAIGHT_WEFT]:
            exact = float(sample(track, np.array([drive.read("Master.Commanded")])).position[0])
            assert drive.read(f"{name}.Actual") == pytest.approx(exact, abs=0.01 * track.stroke)
        assert not drive.read(f"{name}.Powered")
    drive.scan(Halt=False)
    drive.home()
    drive.order(0)


class DriveStation:
    """The loom behind the heads: the drive in place of an honest station."""

    def __init__(self, loom: PlcLoom) -> None:
        self.loom, self.drive = loom, Drive()
        self.done, self.status, self.elapsed = False, 0, 0

    def step(self, order: bool) -> None:
        was = self.done
        self.drive.scan(Start=order, Code=self.loom.end_code, Halt=self.loom.read("Halt"))
        self.done, self.status = self.drive.read("Done"), self.drive.read("Status")
        if self.done and not was:
            self.loom._end()
        shed = max(abs(self.drive.read(f"{name}.Actual")) for name in ("AxisEvenWarps", "AxisOddWarps"))
        self.loom.sensors["ShedClosed"] = shed < 0.005  # at home, and before the beat
        self.loom.sensors["BeaterBack"] = abs(self.drive.read("AxisBeater.Actual")) < 0.01


def test_the_program_weaves_with_its_own_drive(monkeypatch: pytest.MonkeyPatch) -> None:
    """The axes alone move what the sensors see: an operation in which beater or shed stand would be alarm 402."""
    monkeypatch.setattr(plc_loom, "CYCLE", CYCLE)
    loom = PlcLoom(programme())
    loom.stations[0].scans = lambda: loom.size.knot.least + 1
    loom.stations[-1] = DriveStation(loom)  # type: ignore[call-overload]
    loom.start()
    loom.until("Now.EndsDone", 2)
    assert [end for _, end in loom.ends] == [RowEnd.STRAIGHT_WEFT, RowEnd.FIRST_BEAT]
    assert not loom.alarms
