"""A PLC: the interpreter executes the program of a task, OPC UA shows its variables, an operator leads it on."""

import asyncio
import socket
import threading
import time
from types import TracebackType
from typing import Any

from asyncua import Server, ua
from plc_loom import COMMANDS
from structured_text import Instance, Machine

from ilmek.drivers.opcua.certificate import make_credentials
from ilmek.io.plc.io_list import io_rows
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.targets import whole_program
from ilmek.io.plc.units import PlcArray
from ilmek.loom.control.packml import PackState
from ilmek.loom.operations import LoomProgramme

KINDS = {"BOOL": ua.VariantType.Boolean, "INT": ua.VariantType.Int16, "DINT": ua.VariantType.Int32,
         "DWORD": ua.VariantType.UInt32, "USINT": ua.VariantType.Byte, "REAL": ua.VariantType.Float}  # fmt: skip
CYCLE = 0.02
"""Cycle of the program [s]."""
URI = "urn:test:plc"


class PlcServer:
    """Runs in a thread while the context lasts. `power_cut` begins anew with the retained variables."""

    def __init__(self, programme: LoomProgramme) -> None:
        project = plc_project(programme, CYCLE)
        project = whole_program(project, io_rows(project.units[-1]))
        self.machine = Machine(project.text)
        self.main: Instance = self.machine.instance("Main")
        structures = {structure.name: structure.variables for structure in project.structures}
        self.kinds: dict[str, str] = {}
        for variable in project.units[-1].variables:
            for member in structures.get(str(variable.kind), (None,)):
                own = variable if member is None else member
                name = variable.name if member is None else f"{variable.name}.{member.name}"
                kind = own.kind.element if isinstance(own.kind, PlcArray) else own.kind
                if kind in KINDS:
                    self.kinds[name] = kind
        self.url, self.alarms = "", set[int]()
        self._ready, self._end = threading.Event(), threading.Event()
        self._cut = threading.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._run()))

    def power_cut(self) -> None:
        """All but the retained variables is lost."""
        self._cut.set()
        while self._cut.is_set():
            time.sleep(0.01)

    def read(self, name: str) -> Any:
        return self.machine.read(self.main, name)

    async def _run(self) -> None:
        server = Server()
        await server.init()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            url = f"opc.tcp://127.0.0.1:{free.getsockname()[1]}/plc"
        server.set_endpoint(url)
        server.set_security_policy(
            [ua.SecurityPolicyType.NoSecurity, ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt]
        )
        own = make_credentials(URI, "plc", ("127.0.0.1",))
        await server.set_application_uri(URI)
        server.iserver.certificate, server.iserver.private_key = own.certificate, own.key
        index = await server.register_namespace(URI)
        nodes = {}
        for name, kind in self.kinds.items():
            value = ua.Variant(self.read(name), KINDS[kind])
            nodes[name] = await server.nodes.objects.add_variable(ua.NodeId(f"Main.{name}", index), name, value)
            await nodes[name].set_writable()
        await server.start()
        self.index, self.url = index, url
        self._ready.set()
        shown = {name: self.read(name) for name in self.kinds}
        scans = 0
        while not self._end.is_set():
            for name, node in nodes.items():
                value = await node.read_value()
                if value != shown[name]:
                    self.machine.write(self.main, name, value)
            scans += 1
            self._scan(scans)
            for name, node in nodes.items():
                shown[name] = self.read(name)
                await node.write_value(ua.Variant(shown[name], KINDS[self.kinds[name]]))
            await asyncio.sleep(CYCLE)
        await server.stop()

    def _scan(self, scans: int) -> None:
        if self._cut.is_set():
            control = self.main.values["CONTROL"]
            retained = {one.name for one in control.unit.variables if one.section == "VAR RETAIN"}
            kept = {name: value for name, value in control.values.items() if name in retained}
            self.main = self.machine.instance("Main")
            self.main.values["CONTROL"].values.update(kept)
            self._cut.clear()
        state, alarm = PackState(self.read("StateCurrent")), self.read("Alarm")
        self.alarms |= {alarm} - {0}
        command = int(COMMANDS.get(state, 0)) if not alarm or state is PackState.ABORTED else 0
        values = {"CntrlCmd": command, "CmdChangeRequest": command > 0 and scans % 2 == 0}
        for name, value in (values | {"Acknowledge": alarm > 0 and scans % 25 == 0}).items():
            self.machine.write(self.main, name, value)
        self.machine.run(self.main)

    def __enter__(self) -> "PlcServer":
        self._thread.start()
        assert self._ready.wait(60)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._end.set()
        self._thread.join()
