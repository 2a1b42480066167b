"""The control program between the host that feeds it and the simulated loom: the carpet against its chart.

The loom is the twin of `ilmek run`, which refuses what would damage it and keeps the carpet.
"""

import numpy as np
import pytest
from plc_plant import PlantedProgram
from shaped_orders import compiled
from small_programme import small_programme

from ilmek.carpet.chart import Chart
from ilmek.carpet.shape import ShapeParams, shaped
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import LoomError
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.plc.feeder import READ, SILENCE, HostError
from ilmek.jobs.plc.host_journal import HostJournal
from ilmek.jobs.plc.plant import HONEST, DriveAct
from ilmek.loom.control.alarms import ALARMS, ControlFault, JournalFault
from ilmek.loom.control.ports import Fault
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.twin.comparison import compare
from ilmek.loom.twin.state import Injected


@pytest.mark.parametrize("heads", [1, 2, 3])
def test_a_carpet_is_woven_as_its_chart_has_it(heads: int) -> None:
    loom = PlantedProgram(small_programme(3, 12, heads, 3, weft_rows=2))
    loom.weave()
    assert loom.equal_to_the_chart()
    assert loom.read("KnotsDone") == 36
    assert loom.feeder.journal.row == 2


@pytest.mark.parametrize(("shape", "ends"), [("round", 0.0), ("rectangle", 0.02), ("octagon", 0.02)])
def test_a_round_carpet_and_kilim_ends_are_woven_as_their_chart_has_them(shape: str, ends: float) -> None:
    """Also when the power fails: every knot once, in its colour, none outside the shape."""
    random = np.random.default_rng(3)
    knots = random.integers(0, 3, (4 if shape == "rectangle" else 8, 8))
    chart = Chart(knots, default_yarns()[:3], CarpetSize(0.08, len(knots) / 100), "10x10/dm", "symmetric")
    chart = shaped(chart, ShapeParams(shape=shape, kilim_ends=ends))
    programme = CompiledProgramme(*compiled(random, chart))
    loom = PlantedProgram(programme)
    for _ in range(2):
        for _ in range(150):
            loom.scan()
        loom.power_cut(int(random.integers(1500)))
    loom.weave()
    assert loom.equal_to_the_chart()
    assert loom.read("KnotsDone") == chart.tally().knots < chart.rows * chart.columns
    assert not loom.alarms


def test_breaks_of_yarn_weft_and_warp_are_repaired_and_the_carpet_is_whole() -> None:
    faults = (Fault.PILE_BREAK, Fault.MISSED_GRIP, Fault.WARP_BREAK, Fault.WEFT_BREAK)
    loom = PlantedProgram(small_programme(3, 12, 2, 3, seed=5))
    loom.port.act(*(Injected(fault, row) for row in (0, 1) for fault in faults))
    loom.weave()
    assert loom.equal_to_the_chart()
    assert set(loom.alarms) == {ALARMS[fault].number for fault in faults if fault is not Fault.MISSED_GRIP}


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("seed", range(20))
def test_a_carpet_cut_off_at_random_instants_is_woven_as_its_chart_has_it(seed: int) -> None:
    """Power of program and loom fails in the middle of a scan; now and then the host starts anew as well."""
    random = np.random.default_rng(seed)
    heads = 1 + seed % 3
    programme = small_programme(3, 12, heads, 3, seed=seed, weft_rows=2)
    loom = PlantedProgram(programme)
    for _ in range(5):
        for _ in range(random.integers(800 // heads)):
            loom.scan()
        loom.power_cut(int(random.integers(1500)))
        if random.random() < 0.3:
            loom.host_starts()
    loom.weave()
    assert loom.equal_to_the_chart()
    assert not loom.alarms


ACTS = [
    DriveAct(silent=True),
    DriveAct(tied=False, silent=True),
    DriveAct(early=True),
    DriveAct(hasty=True),
    DriveAct(stuck=3),
    DriveAct(stuck=400),
    DriveAct(fault=ALARMS[Fault.TIMEOUT].number),
    DriveAct(tied=False, fault=ALARMS[Fault.PILE_BREAK].number),
]


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("act", ACTS)
def test_drives_that_are_silent_early_or_stuck_cost_no_knot(act: DriveAct) -> None:
    random = np.random.default_rng(len(str(act)))
    loom = PlantedProgram(small_programme(3, 12, 2, 2), lambda _: act if random.random() < 0.15 else HONEST)
    loom.weave()
    assert loom.equal_to_the_chart()
    assert loom.alarms or act.stuck == 3


def test_a_drive_that_reports_a_knot_in_its_time_and_has_not_tied_it_is_beyond_the_program() -> None:
    ordered = []

    def lies_once(station: int) -> DriveAct:
        ordered.append(station)
        return DriveAct(tied=ordered.count(0) != 3 or station > 0)

    loom = PlantedProgram(small_programme(3, 12, 1, 2), lies_once)
    loom.weave()
    assert compare(loom.woven, loom.programme).missing == 1
    assert not loom.alarms


def test_a_host_that_dies_stops_the_loom_in_the_middle_of_a_row() -> None:
    loom = PlantedProgram(small_programme(3, 12, 1, 2))
    loom.until("KnotsDone", 3)
    step, loom.feeder.step = loom.feeder.step, lambda *_: []  # type: ignore[method-assign]
    for _ in range(1100):
        loom.scan()
    assert loom.alarms[-1] == ALARMS[ControlFault.NO_HOST].number
    loom.feeder.step = step  # type: ignore[method-assign]
    loom.weave()
    assert loom.equal_to_the_chart()


def test_a_program_that_stands_ends_the_host() -> None:
    loom = PlantedProgram(small_programme(3, 12, 1, 2))
    plc = {name: loom.read(name) for name in READ}
    loom.feeder.step(0.0, plc)
    loom.feeder.step(SILENCE, plc)
    with pytest.raises(HostError, match="not counted on"):
        loom.feeder.step(SILENCE + 0.1, plc)


def test_a_host_without_its_journal_gives_no_row_to_a_carpet_in_work() -> None:
    loom = PlantedProgram(small_programme(3, 12, 1, 2))
    loom.until("RowRequest", 1)
    loom.store.truncate(0)
    loom.host_starts()
    with pytest.raises(HostError, match="requests row 2"):
        loom.scan()


def test_a_program_without_its_retained_record_stops_at_the_journal_of_the_host() -> None:
    loom = PlantedProgram(small_programme(3, 12, 1, 2))
    loom.until("KnotsDone", 14)
    loom.plant.halt()
    loom.loom = loom.machine.instance("Loom")
    for _ in range(300):
        loom.scan()
    assert loom.alarms[-1] == ALARMS[JournalFault.BEHIND].number


@pytest.mark.parametrize("rows", [0, 1, 2])
def test_rows_back_by_the_host_are_woven_again(rows: int) -> None:
    loom = PlantedProgram(small_programme(4, 12, 2, 2))
    loom.until("KnotsDone", 29)
    with pytest.raises(LoomError, match="Stopped"):
        loom.feeder.take_out(rows, {name: loom.read(name) for name in READ})
    loom.stop()
    loom.feeder.take_out(rows, {name: loom.read(name) for name in READ})
    loom.host_starts()  # what it has noted it does after its start
    for _ in range(8):
        loom.scan()
    assert (loom.plant.row, loom.read("RowRequest"), loom.read("KnotsDone")) == (2 - rows, 2 - rows, 12 * (2 - rows))
    loom.weave()
    assert loom.equal_to_the_chart()


def test_rows_back_that_the_program_refuses_end_the_host_and_leave_its_journal() -> None:
    loom = PlantedProgram(small_programme(5, 12, 2, 2, weft_rows=2))
    loom.until("RowRequest", 3)
    loom.stop()
    loom.feeder.take_out(2, {name: loom.read(name) for name in READ})
    plc = {name: loom.read(name) for name in READ}
    loom.feeder.step(0.0, plc)
    with pytest.raises(HostError, match="does not weave 2 rows"):
        loom.feeder.step(SILENCE + 1, {**plc, "PlcBeat": -2})
    assert HostJournal(loom.programme, loom.store).row == 3
