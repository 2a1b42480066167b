"""The twin behind the ports: times by the rules, the woven carpet, faults, halts, and the state after a restart."""

from pathlib import Path

import numpy as np
import pytest
from tests.support.plant_driver import knots_of, weave
from tests.support.small_programme import small_programme

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError
from ilmek.io.woven_file import open_woven
from ilmek.loom.control.ports import Done, Failed, Fault, SensorsChanged
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.durations import ns
from ilmek.loom.twin.model import plant_model
from ilmek.loom.twin.state import Injected, first_state
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
