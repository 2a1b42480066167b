"""Host and simulated loom beside a PLC over OPC UA: asyncua's server before the interpreter of the program."""

import threading
from pathlib import Path

import pytest
from plc_server import PlcServer
from small_programme import small_programme

from ilmek.errors import LoomError, ParameterError
from ilmek.io.programme_file import write_programme
from ilmek.jobs.plc.connection import PlcAddress, checked_address, connection
from ilmek.jobs.plc.feeder import HostError
from ilmek.jobs.plc.line import feed, weave_for_plc
from ilmek.jobs.run.order import RunOrder
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import OperationTimes
from ilmek.loom.twin.comparison import WovenResult

TIMES = OperationTimes(0.2, 0.05, 0.01, (0.4, 0.8, 1.2, 1.6, 1.8), 1.0)
"""A quick loom: the test waits for it [s]."""


@pytest.fixture
def quick() -> CompiledProgramme:
    return small_programme(3, 6, 2, 2, loom_times=TIMES)


class Line:
    """Host and loom of a programme at a PLC, each in its thread."""

    def __init__(self, programme: CompiledProgramme, folder: Path, address: PlcAddress) -> None:
        self.file, self.address, self.notes = folder / "programme.ilmek", address, list[str]()
        write_programme(self.file, programme)
        self.stop, self.failure = threading.Event(), list[LoomError]()
        self.woven = list[WovenResult]()
        self.threads = [threading.Thread(target=self._guarded, args=(act,)) for act in (self._feed, self._weave)]

    def _guarded(self, act: object) -> None:
        try:
            assert callable(act)
            act()
        except LoomError as failed:
            self.failure.append(failed)
            self.stop.set()

    def _feed(self) -> None:
        feed(RunOrder(self.file), self.address, self.stop, self.notes.append)

    def _weave(self) -> None:
        carpet = self.file.with_suffix(".woven")
        self.woven.append(weave_for_plc(RunOrder(self.file), carpet, self.address, self.stop, self.notes.append))

    def run(self) -> None:
        for thread in self.threads:
            thread.start()
        for thread in self.threads:
            thread.join(240)
        assert not self.failure


@pytest.mark.parametrize("unsecured", [True, False])
def test_a_carpet_is_woven_by_the_plc_between_host_and_loom(
    quick: CompiledProgramme, tmp_path: Path, unsecured: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its power fails twice on the way."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    with PlcServer(quick) as plc:
        line = Line(quick, tmp_path, PlcAddress(plc.url, node=f"ns={plc.index};s=Main.{{}}", unsecured=unsecured))

        def cut() -> None:
            for knots in (4, 10):
                while plc.read("KnotsDone") < knots and not line.stop.wait(0.05):
                    pass
                plc.power_cut()

        cutter = threading.Thread(target=cut)
        cutter.start()
        line.run()
        line.stop.set()
        cutter.join()
    assert line.woven[0].complete


def test_a_host_with_another_journal_ends_and_names_both_rows(quick: CompiledProgramme, tmp_path: Path) -> None:
    file = tmp_path / "programme.ilmek"
    write_programme(file, quick)
    with PlcServer(quick) as plc:
        address = PlcAddress(plc.url, node=f"ns={plc.index};s=Main.{{}}", unsecured=True)
        with connection(address) as variables:
            assert variables.read(["RowRequest"]) == {"RowRequest": -1}
            plc.machine.write(plc.main, "Control.Now.Begun", True)
            plc.machine.write(plc.main, "Control.Now.Row", 2)
            plc.machine.write(plc.main, "Control.Now.Carpet.Rows", 3)
        with pytest.raises(HostError, match="requests row 3"):
            feed(RunOrder(file), address, threading.Event(), lambda _: None)


def test_variables_that_the_server_does_not_have_are_named(quick: CompiledProgramme) -> None:
    with (
        PlcServer(quick) as plc,
        connection(PlcAddress(plc.url, node="ns=2;s=None.{}", unsecured=True)) as variables,
        pytest.raises(LoomError, match="has no variable ns=2;s=None.RowRequest"),
    ):
        variables.read(["RowRequest"])


@pytest.mark.parametrize(
    "address",
    [
        PlcAddress("http://127.0.0.1:4840"),
        PlcAddress("opc.tcp://"),
        PlcAddress("opc.tcp://127.0.0.1:4840", target="openplc"),
        PlcAddress("opc.tcp://127.0.0.1:4840", node="ns=4;s=Main"),
        PlcAddress("opc.tcp://192.168.1.5:4840", user="anna", unsecured=True),
    ],
)
def test_addresses_that_cannot_be_reached_are_refused(address: PlcAddress) -> None:
    with pytest.raises(ParameterError):
        checked_address(address)
