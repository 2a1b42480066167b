"""The OPC UA server of a loom, in a thread and an event loop of its own.

The loom never waits for the network: the server reads snapshots at a stated rate, and gives commands from a thread
that may wait for the controller.
"""

import asyncio
import contextlib
import logging
import os
import socket
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType

from asyncua import ua

from ilmek.drivers.opcua.alarm_events import LoomEvents
from ilmek.drivers.opcua.certificate import Credentials
from ilmek.drivers.opcua.gate import GatedServer
from ilmek.drivers.opcua.job_orders import MOST_JOBS, Job, JobDesk
from ilmek.drivers.opcua.methods import CONTROL, RECEIVER, LoomMethods, job_values
from ilmek.drivers.opcua.model import LOOM, LoomNameplate
from ilmek.drivers.opcua.space import AddressSpace
from ilmek.drivers.opcua.users import UserList
from ilmek.drivers.opcua.values import NESTED, CurrentState, fixed_values, snapshot_values
from ilmek.errors import LoomError
from ilmek.loom.control.view import Answer, ControllerView, Snapshot

INTERVAL = 0.1
"""Interval of the snapshots [s]."""

ANSWER_TIME = 5.0
"""Time within which the controller must answer a command [s]."""

LIKELY_SPEED = 60.0
"""Upper end of the range of likely speeds of a head [knots a minute]."""

_START_TIME = 60.0
_MEMBERS = ("StateType", "TransitionType")


class LoomServer:
    """Shows a loom over OPC UA and takes commands for it, while the context lasts.

    view      the controller                       plate        what is fixed about the loom
    users     who may read and command             credentials  the server's certificate and key
    host      to listen at                         port         0: a free one
    interval  of the snapshots [s]                 log          takes remarks, such as refused clients
    paths     of all variables and of all methods, once it has started
    """

    def __init__(
        self,
        view: ControllerView,
        plate: LoomNameplate,
        users: UserList,
        credentials: Credentials,
        *,
        host: str = "127.0.0.1",
        port: int = 4840,
        interval: float = INTERVAL,
        log: Callable[[str], None] = lambda _: None,
    ) -> None:
        self._view, self._plate, self._users, self._credentials = view, plate, users, credentials
        self._host, self._port, self._interval, self._log = host, port, interval, log
        self._ready = threading.Event()
        self._failure: BaseException | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ended: asyncio.Event | None = None
        self._thread = threading.Thread(target=self._run, name="opc-ua", daemon=True)
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="opc-ua-command")
        self._changed: list[Job] = []
        self.paths: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())

    @property
    def url(self) -> str:
        """The address of the endpoint."""
        host = f"[{self._host}]" if ":" in self._host else self._host
        return f"opc.tcp://{host}:{self._port}/ilmek/loom"

    def start(self) -> None:
        """Start the server. Raises LoomError where the address cannot be listened at."""
        self._bound = self._bind()
        self._port = int(self._bound.getsockname()[1])
        self._thread.start()
        if not self._ready.wait(_START_TIME):
            raise LoomError("the OPC UA server did not start in time")
        if self._failure is not None:
            raise self._failure

    def _bind(self) -> socket.socket:
        try:
            family = socket.getaddrinfo(self._host, self._port, type=socket.SOCK_STREAM)[0][0]
            bound = socket.socket(family, socket.SOCK_STREAM)
            try:
                if os.name == "posix":  # an address of connections that ended a moment ago
                    bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
                bound.bind((self._host, self._port))
            except BaseException:
                bound.close()
                raise
        except (OSError, UnicodeError) as failed:
            reason = getattr(failed, "strerror", None) or "no such address"
            raise LoomError(
                f"{self._host}:{self._port} cannot be listened at ({reason})",
                do="free the port, or give another with --port",
            ) from None
        return bound

    def stop(self) -> None:
        """Close all connections and end the thread."""
        if self._loop is not None and self._ended is not None:
            with contextlib.suppress(RuntimeError):  # its loop is closed
                self._loop.call_soon_threadsafe(self._ended.set)
        if self._thread.ident is not None:
            self._thread.join()
        self._pool.shutdown(wait=False, cancel_futures=True)

    def __enter__(self) -> "LoomServer":
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def _run(self) -> None:
        logging.getLogger("asyncua").addHandler(logging.NullHandler())
        try:
            asyncio.run(self._serve())
        except BaseException as failed:
            self._failure = failed
            if self._ready.is_set():
                self._log(f"the OPC UA server has ended: {failed!r}; the loom goes on")
        finally:
            self._bound.close()
            self._ready.set()

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        server = GatedServer(self._bound, self._users, self._log)
        await server.init()
        self._configure(server)
        await server.set_application_uri(self._plate.uri)
        space = AddressSpace(server, self._plate)
        await space.build()
        await space.write(fixed_values(self._plate))
        snapshot = self._view.snapshot()
        desk = JobDesk(self._plate.programme, self._command, self._changed.append)
        shown = _Shown(space, desk, LoomEvents(space), snapshot)
        methods = LoomMethods(space, desk, self._command, lambda: shown.snapshot, shown.refused)
        server.iserver.open_methods |= methods.bind()
        server.iserver.acknowledged = methods.acknowledged
        self.paths = space.paths, space.methods
        await shown.prepare()
        await server.start()
        try:
            self._ready.set()
            await self._show(shown)
        finally:
            await server.stop()

    def _configure(self, server: GatedServer) -> None:
        server.set_endpoint(self.url)
        server.set_server_name(f"ilmek loom {self._plate.serial}")
        server.product_uri, server.manufacturer_name = "urn:ilmek", "ilmek"
        server.application_type = ua.ApplicationType.Server
        server.iserver.certificate, server.iserver.private_key = self._credentials.certificate, self._credentials.key

    async def _show(self, shown: "_Shown") -> None:
        assert self._ended is not None
        following = time.monotonic()
        while not self._ended.is_set():
            try:
                await shown.update(self._view.snapshot())
                changed, self._changed[:] = list(self._changed), []
                for job in changed:
                    await shown.events.job(job)
            except Exception as failed:  # one look that fails must not end the server
                self._log(f"the OPC UA server could not show the loom: {failed!r}")
            following = max(following + self._interval, time.monotonic())
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._ended.wait(), following - time.monotonic())

    async def _command(self, name: str) -> Answer:
        assert self._loop is not None
        given = self._loop.run_in_executor(self._pool, self._view.command, name)
        return await asyncio.wait_for(given, ANSWER_TIME)


class _Shown:
    """What clients see: the last snapshot, job orders and events."""

    def __init__(self, space: AddressSpace, desk: JobDesk, events: LoomEvents, snapshot: Snapshot) -> None:
        self.space, self.desk, self.events, self.snapshot = space, desk, events, snapshot

    async def prepare(self) -> None:
        plate = self.space.plate
        enumeration = self.space.type_id("PackML:ProductionMaintenanceModeEnum")
        master = ua.ISA95WorkMasterDataType(ID=plate.programme, Description=ua.LocalizedText(plate.title))
        speeds = ua.Range(0.0, LIKELY_SPEED * plate.heads)
        machines = {path: [self.space.members(kind, member) for member in _MEMBERS] for path, kind in NESTED.items()}
        await self.space.write(
            {
                **{f"{LOOM}.PackML.Status.{name}.EURange": speeds for name in ("MachSpeed", "CurMachSpeed")},
                **{f"{path}.AvailableStates": states for path, (states, _) in machines.items()},
                **{f"{path}.AvailableTransitions": transitions for path, (_, transitions) in machines.items()},
                f"{CONTROL}.MaxDownloadableJobOrders": MOST_JOBS,
                f"{CONTROL}.WorkMaster": [master],
                f"{CONTROL}.EquipmentID": [plate.serial],
                **{f"{CONTROL}.{name}": [] for name in ("MaterialClassID", "MaterialDefinitionID", "PersonnelID")},
                f"{CONTROL}.PhysicalAssetID": [plate.serial],
                f"{LOOM}.PackML.Status.UnitSupportedModes": enumeration,
                f"{LOOM}.Status.LastRefusal": "",
            }
        )
        await self.events.prepare()
        await self.update(self.snapshot)

    async def update(self, snapshot: Snapshot) -> None:
        self.snapshot = snapshot
        try:
            await self.desk.advance(snapshot)
        except TimeoutError:
            await self.refused("the controller did not answer in time")
        values = snapshot_values(self.space.plate, snapshot)
        current = next((job for job in self.desk.jobs if job.in_work), None)
        values[f"{CONTROL}.CurrentState"] = None if current is None else CurrentState(RECEIVER, current.state)
        await self.space.write({**values, **job_values(self.space, self.desk.jobs)})
        await self.events.alarms(snapshot.alarms)

    async def refused(self, reason: str) -> None:
        await self.space.write({f"{LOOM}.Status.LastRefusal": reason})
