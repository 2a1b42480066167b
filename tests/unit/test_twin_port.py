"""The twin behind the ports: times by the rules, the woven carpet, faults, halts, and the state after a restart."""

import errno
import signal
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from plant_driver import knots_of, weave
from processes import ended, python
from small_programme import small_programme

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError, OutputError
from ilmek.io.output import disk
from ilmek.io.woven_file import open_woven
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Failed, Fault, Jog, SensorsChanged, Tie
from ilmek.loom.operations import LoomProgramme, RowEnd, Stop, TubeChange
from ilmek.loom.twin.durations import ns
from ilmek.loom.twin.faults import StopParams
from ilmek.loom.twin.model import FaultRates, fault_rates, plant_model
from ilmek.loom.twin.state import (
    Door,
    Halt,
    Injected,
    PlantInput,
    Repaired,
    SensorFault,
    SetSpeed,
    first_state,
    sensors_of,
)
from ilmek.loom.twin.step import step
from ilmek.loom.twin.woven import Woven, woven_size


def in_memory(programme: LoomProgramme) -> Woven:
    """A new carpet in memory."""
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    woven.keep(first_state(plant_model(programme.setup)))
    return woven


def time_by_the_rules(programme: LoomProgramme) -> int:
    """The rules of time, written down once more."""
    setup, total = programme.setup, 0
    times = setup.times
    tubes: dict[int, int] = {}
    for number in range(setup.rows):
        row = programme.operations(number)
        total += sum(ns(setup.wefts[index].time) for stop in row.stops for index in stop.wefts)
        columns: dict[int, int] = {}
        for heads in knots_of(row):
            longest = 0
            for knots in heads:
                busy = 0
                for one in knots:
                    apart = abs(one.column - columns.get(one.head, one.column)) - 1
                    busy += ns(times.knot) + ns(times.travel) * max(apart, 0)
                    busy += ns(times.colour_change) * (tubes.get(one.head, one.tube) != one.tube)
                    columns[one.head], tubes[one.head] = one.column, one.tube
                longest = max(longest, busy)
            total += longest
        total += ns(times.row_ends[-1])
    return total


@pytest.mark.parametrize("heads", [1, 2, 5])
def test_a_carpet_takes_the_time_of_the_rules_and_is_that_of_its_chart(heads: int) -> None:
    programme = small_programme(6, 24, heads, 3)
    woven = in_memory(programme)
    port = TwinPort(programme.setup, woven)
    reports = list(weave(port, programme))
    assert port.time == time_by_the_rules(programme)
    assert [one.time for one in reports] == sorted(one.time for one in reports)
    for row in range(6):
        assert np.array_equal(woven.yarns(row), programme.chart_row(row))
        assert woven.counts(row).tolist() == [1] * 24
        assert woven.ends(row).tolist() == [1] * 5
    assert isinstance(reports[0], SensorsChanged)


def test_a_failed_knot_leaves_nothing_in_the_carpet_and_lasts_its_whole_time() -> None:
    programme = small_programme(3, 12, 1, 1)
    port = TwinPort(programme.setup, in_memory(programme))
    first, second = knots_of(programme.operations(0))[0][0][:2]
    port.act(Injected(Fault.MISSED_GRIP, 0, first.column))
    port.send([first])
    assert isinstance(port.receive(0.0)[0], SensorsChanged)
    assert port.receive(0.0) == (Failed(first, Fault.MISSED_GRIP, ns(2.0)),)
    assert port.knotted(0, first.column) is False
    port.send([first])
    assert port.receive(0.0) == (Done(first, ns(4.0)),)
    assert port.knotted(0, first.column) is True
    assert port.knotted(0, second.column) is False


def test_the_loom_is_after_a_restart_where_it_was(tmp_path: Path) -> None:
    programme = small_programme(4, 12, 2, 3)
    with open_woven(tmp_path / "woven", programme) as woven:
        list(weave(port := TwinPort(programme.setup, woven), programme, range(2)))
        state = port.state
    with open_woven(tmp_path / "woven", programme) as woven:
        again = TwinPort(programme.setup, woven)
        assert (again.time, again.state.heads) == (state.time, state.heads)
        assert again.state.condition == state.condition
        list(weave(again, programme, range(2, 4)))
        assert [woven.counts(row).tolist() for row in range(4)] == [[1] * 12] * 4
    assert again.time == time_by_the_rules(programme)


def test_the_woven_file_is_that_of_its_programme_and_whole(tmp_path: Path) -> None:
    path, programme = tmp_path / "woven", small_programme(4, 12, 2, 3)
    with open_woven(path, programme):
        pass
    with pytest.raises(LoomError, match="another programme"), open_woven(path, small_programme(4, 12, 2, 3, seed=2)):
        pass
    content = path.read_bytes()
    for damaged in (content[:100], b"?" + content[1:], content[:40] + b"?" + content[41:], content[:-1], b""):
        path.write_bytes(damaged)
        with pytest.raises(LoomError, match="woven"), open_woven(path, programme):
            pass
    path.write_bytes(content[:128] + bytes([255] * 8) + content[136:])
    with pytest.raises(LoomError, match="is damaged"), open_woven(path, programme):
        pass
    path.unlink()
    with pytest.raises(LoomError, match="check the path"), open_woven(path, programme, change=False):
        pass


def test_a_halt_leaves_a_gripper_closed_until_the_operator_opens_it() -> None:
    programme = small_programme(3, 12, 2, 3)
    plant = plant_model(programme.setup)
    rest = sensors_of(plant, first_state(plant))
    order = Tie(1, 0, 0, 6, 0)
    tying, reports = step(plant, first_state(plant), [order], ns(1.0))
    assert reports == ()
    assert sensors_of(plant, tying).grippers_open == (True, False)
    halted, (report,) = step(plant, tying, [Halt()], ns(9.0))
    assert isinstance(report, SensorsChanged)
    assert (report.time, report.sensors.grippers_open, report.sensors.heads_clear) == (ns(1.0), (True, False), False)
    moved = replace(halted, heads=(halted.heads[0], replace(halted.heads[1], column=9)))
    with pytest.raises(LoomError, match="gripper closed on warps"):
        step(plant, moved, [Tie(1, 0, 1, 6, 0)], 0)
    for cure in (Repaired(), Jog("gripper 1", 0.01)):
        mended, _ = step(plant, halted, [cure], ns(1.0))
        assert sensors_of(plant, mended).grippers_open == (True, True)
    assert sensors_of(plant, step(plant, halted, [Repaired()], 0)[0]) == rest


def test_the_sensors_follow_the_operations_after_the_knots() -> None:
    programme = small_programme(3, 12, 2, 3)
    plant = plant_model(programme.setup)
    state, seen = first_state(plant), []
    for operation in RowEnd:
        state, reports = step(plant, state, [EndRow(0, operation)], plant.times.of_end(operation))
        assert reports[-1] == Done(EndRow(0, operation), state.time)
        seen += [one.sensors for one in reports if isinstance(one, SensorsChanged)]
    assert [(one.shed_closed, one.beater_back) for one in seen] == [
        (False, True), (True, True), (True, False), (True, True), (False, True), (True, True), (True, False),
        (True, True),
    ]  # fmt: skip
    assert all(one.heads_clear for one in seen)
    assert [one.warp_tension for one in seen[:2]] == [plant.tension * 16 // 15 / 1000, plant.tension / 1000]


def test_a_disc_that_is_full_leaves_no_carpet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, content: bytes) -> None:
        path.write_bytes(content[:100])
        raise OSError(errno.ENOSPC, "No space left on device")

    programme = small_programme(3, 12, 2, 3)
    with monkeypatch.context() as patch:
        patch.setattr("ilmek.io.woven_file.disk.write", full)
        with pytest.raises(OutputError, match="No space left"), open_woven(tmp_path / "woven", programme):
            pass
    assert list(tmp_path.iterdir()) == []
    with open_woven(tmp_path / "woven", programme) as woven:
        assert woven.times_tied(0, 0) == 0


@pytest.mark.parametrize("number", range(5))
def test_a_carpet_is_made_whole_or_not_at_all(number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    programme, calls = small_programme(3, 12, 2, 3), [0]

    class Killed(BaseException):
        pass

    def counted(function: Callable[..., object]) -> Callable[..., object]:
        def call(*args: object) -> object:
            calls[0] += 1
            if calls[0] > number:
                raise Killed
            return function(*args)

        return call

    with monkeypatch.context() as patch:
        for name in ("unlink", "write", "sync", "rename"):
            patch.setattr(f"ilmek.io.woven_file.disk.{name}", counted(getattr(disk, name)))
        with pytest.raises(Killed), open_woven(tmp_path / "woven", programme):
            pass
    whole = (tmp_path / "woven").exists()
    assert whole == (number == 4)
    with open_woven(tmp_path / "woven", programme) as woven:
        assert woven.restored(plant_model(programme.setup)) == first_state(plant_model(programme.setup))
    assert [one.name for one in tmp_path.iterdir()] == ["woven"]


def test_what_a_killed_process_has_woven_is_in_the_file(tmp_path: Path) -> None:
    programme = small_programme(3, 12, 1, 3)
    path = tmp_path / "woven"
    code = f"""
import os, signal
from pathlib import Path
from ilmek.drivers.twin_port import TwinPort
from ilmek.io.output import disk
from ilmek.io.woven_file import open_woven
from plant_driver import weave
from small_programme import small_programme
programme = small_programme(3, 12, 1, 3)
with open_woven(Path({str(path)!r}), programme) as woven:
    for number, _ in enumerate(weave(TwinPort(programme.setup, woven), programme)):
        if number == 30:
            os.kill(os.getpid(), signal.SIGKILL)
"""
    assert ended(python("-c", code)).returncode == -signal.SIGKILL
    with open_woven(path, programme) as woven:
        tied = sum(int(woven.counts(row).sum()) for row in range(3))
        ends = sum(int(woven.ends(row).sum()) for row in range(3))
        assert (tied, ends) == (17, 5)
        again = TwinPort(programme.setup, woven)
        assert again.time > 0
        assert again.state.heads[0].tube >= 0


def test_a_loom_without_wefts_or_with_many_is_restored() -> None:
    small = small_programme(3, 12, 2, 3).setup
    for wefts in ((), small.wefts * 2):
        setup = replace(small, wefts=wefts)
        plant = plant_model(setup)
        woven = Woven(setup, bytearray(woven_size(setup)))
        woven.keep(first_state(plant))
        assert woven.restored(plant) == first_state(plant)
        assert TwinPort(setup, woven).time == 0


class HandClock:
    """A clock that waits at once."""

    def __init__(self) -> None:
        self.time = 0.0
        self.waits: list[float] = []

    def now(self) -> float:
        return self.time

    def wait(self, seconds: float, woken: threading.Event) -> None:
        self.waits.append(seconds)
        self.time += 0.0 if woken.is_set() else seconds


def test_a_speed_is_kept_by_the_callers_clock_and_the_loom_stands_while_he_works() -> None:
    programme, clock = small_programme(3, 12, 1, 1), HandClock()
    port = TwinPort(programme.setup, in_memory(programme), speed=10.0, clock=clock)
    first, second = knots_of(programme.operations(0))[0][0][:2]
    port.receive(0.0)
    port.send([first])
    assert port.receive(0.05) == ()
    assert (port.time, clock.time) == (ns(0.5), 0.05)
    assert port.receive(1.0) == (Done(first, ns(2.0)),)
    assert clock.time == pytest.approx(0.2)
    clock.time += 0.05  # of work
    port.send([second])
    assert port.receive(1.0) == (Done(second, ns(4.0)),)
    assert clock.time == pytest.approx(0.4)
    assert port.receive(0.3) == ()
    assert port.time == ns(7.0)


def test_a_caller_who_was_away_for_long_is_not_overrun() -> None:
    programme, clock = small_programme(3, 12, 1, 1), HandClock()
    port = TwinPort(programme.setup, in_memory(programme), speed=1.0, clock=clock)
    knots = knots_of(programme.operations(0))[0][0][:3]
    port.receive(0.0)
    port.send(knots[:1])
    clock.time = 1000.0
    port.receive(0.0)
    assert port.time == ns(1.0)


def test_an_act_of_another_thread_ends_the_wait_and_acts_at_once() -> None:
    programme = small_programme(3, 12, 1, 1)
    port = TwinPort(programme.setup, in_memory(programme))
    port.receive(0.0)
    threading.Timer(0.02, port.act, [Door(False)]).start()
    assert port.receive(60.0) == ()
    (report,) = port.receive(0.0)
    assert isinstance(report, SensorsChanged)
    assert not report.sensors.door_closed


@pytest.mark.parametrize("speed", [0.0, -1.0, 1e9, float("nan")])
def test_a_speed_out_of_bounds_is_refused(speed: float) -> None:
    programme = small_programme(3, 12, 1, 1)
    with pytest.raises(LoomError, match="speed"):
        TwinPort(programme.setup, in_memory(programme), speed=speed)


@pytest.mark.parametrize(
    ("one", "wrong"),
    [
        (Tie(0, 3, 0, 0, 0), "row 3"),
        (Tie(2, 0, 0, 0, 0), "head 2"),
        (Tie(0, 0, 0, 12, 0), "column 12"),
        (EndRow(-1, RowEnd.TAKE_UP), "row -1"),
        (ChangePackages(Stop(0, 0, (7,))), "bobbins of weft"),
        (ChangePackages(Stop(0, 0, (), (TubeChange(0, 0, 9, 1.0),))), "yarn 9"),
        (SensorFault("nose", True), "sensor 'nose'"),
        (SetSpeed(0), "speed 0"),
        (SetSpeed(1001), "speed 1001"),
    ],
)
def test_what_no_loom_can_do_is_refused(one: PlantInput, wrong: str) -> None:
    plant = plant_model(small_programme(3, 12, 2, 3).setup)
    with pytest.raises(LoomError, match=wrong):
        step(plant, first_state(plant), [one], 0)
    with pytest.raises(LoomError, match="does not go back"):
        step(plant, first_state(plant), (), -1)


def test_a_slower_loom_takes_longer_and_a_lie_is_answered_until_it_is_mended() -> None:
    programme = small_programme(3, 12, 1, 1)
    port = TwinPort(programme.setup, in_memory(programme))
    (knot,) = knots_of(programme.operations(0))[0][0][:1]
    port.set_speed(0.5)
    port.act(SensorFault("knotted", None), SensorFault("warp_tension", 3.5))
    port.send([knot])
    assert port.sensors().warp_tension != 3.5
    port.receive(0.0)
    assert port.sensors().warp_tension == 3.5
    assert port.receive(0.0) == (Done(knot, ns(4.0)),)
    assert port.knotted(0, knot.column) is None
    port.act(Repaired())
    port.receive(0.0)
    assert port.knotted(0, knot.column) is True


def test_a_rate_out_of_bounds_is_refused_and_those_of_a_simulation_are_taken() -> None:
    for wrong in (FaultRates, lambda **rates: FaultRates(seed=-1, **rates)):
        with pytest.raises(LoomError):
            wrong(pile_break=1.5)
    rates = fault_rates(StopParams(), small_programme(3, 12, 1, 1).setup, 7)
    assert rates.seed == 7
    assert rates.missed_grip == pytest.approx(5e-4, rel=1e-3)
    assert rates.pile_break == pytest.approx(0.1e-3 * 0.04, rel=1e-3)
