"""The OPC UA server of a loom, by asyncua's client: security, what is shown, commands, job orders, alarms."""

import asyncio
import re
import socket
import threading
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from asyncua import Client, ua
from asyncua.crypto.security_policies import SecurityPolicyBasic256Sha256
from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat
from opcua_loom import PROGRAMME, SteppingLoom
from small_programme import small_programme

from ilmek.drivers.opcua.certificate import make_credentials
from ilmek.drivers.opcua.gate import LARGEST_CHUNK, LEAST_INTERVAL, MOST_OF_SESSION
from ilmek.drivers.opcua.job_orders import ReturnStatus
from ilmek.drivers.opcua.model import METHODS, TYPES, LoomNameplate, own_objects
from ilmek.drivers.opcua.server import LoomServer
from ilmek.drivers.opcua.users import LoomUser, UserList, UserRight, hashed
from ilmek.errors import LoomError
from ilmek.io.programme_file import write_programme
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import RunOrder
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.view import AlarmView, Answer, ControllerView, Snapshot

PLATE = LoomNameplate(
    "ilmek", "automated loom", "0123456789ab", "0.1.0", PROGRAMME, "carpet", 6, 24, 2, 3, ("red", "ivory", "blue"),
    ("straight weft", "sinuous weft"),
)  # fmt: skip
CONTROL = "Loom.MachineryBuildingBlocks.JobManagement.JobOrderControl"
RESULTS = "Loom.MachineryBuildingBlocks.JobManagement.JobOrderResults"
EXECUTE = "Loom.PackML.BaseStateMachine.MachineState.ExecuteState"
Pair = tuple[bytes, bytes]


class ShownLoom:
    """The loom that the server shows: the stepping one, or another while a test lasts."""

    def __init__(self) -> None:
        self.stepping = SteppingLoom()
        self.shown: ControllerView = self.stepping

    def snapshot(self) -> Snapshot:
        return self.shown.snapshot()

    def command(self, name: str) -> Answer:
        return self.shown.command(name)


@pytest.fixture(scope="module")
def running() -> Iterator[tuple[LoomServer, ShownLoom]]:
    stored = {name: LoomUser(name, UserRight(name), hashed(f"{name}-password")) for name in ("operator", "viewer")}
    shown, remarks = ShownLoom(), list[str]()
    credentials = make_credentials(PLATE.uri, "loom", ("127.0.0.1",))
    with LoomServer(shown, PLATE, UserList(stored), credentials, port=0, interval=0.02, log=remarks.append) as server:
        yield server, shown
    assert [remark for remark in remarks if "refused a client" not in remark] == []


@pytest.fixture
def server(running: tuple[LoomServer, ShownLoom]) -> LoomServer:
    return running[0]


@pytest.fixture
def loom(running: tuple[LoomServer, ShownLoom]) -> SteppingLoom:
    running[1].shown = running[1].stepping
    running[1].stepping.reset()
    return running[1].stepping


@pytest.fixture
def woven(running: tuple[LoomServer, ShownLoom], tmp_path: Path) -> Iterator[LoomRun]:
    """A carpet on the simulated loom under its controller, in place of the stepping loom."""
    path = tmp_path / "programme.ilmek"
    write_programme(path, small_programme(6, 24, 2, 3))
    with LoomRun(RunOrder(path, tmp_path / "journal", speed=None, start=False, serves=True)) as run:
        thread = threading.Thread(target=run.work)
        thread.start()
        running[1].shown = run
        yield run
        running[1].shown = running[1].stepping
        run.stop()
        thread.join()


@pytest.fixture(scope="module")
def pair() -> Pair:
    made = make_credentials("urn:test:client", "client", ("localhost",))
    key = made.key.private_bytes(Encoding.DER, PrivateFormat.PKCS8, NoEncryption())
    return made.certificate.public_bytes(Encoding.DER), key


class Calls:
    """A client that is connected, and the loom's namespace."""

    def __init__(self, client: Client, index: int) -> None:
        self.client, self.index = client, index

    def node(self, path: str) -> Any:
        return self.client.get_node(ua.NodeId(path, self.index))

    async def read(self, path: str) -> Any:
        value = await self.node(path).read_value()
        return value.Text if isinstance(value, ua.LocalizedText) else value

    async def call(self, path: str, *arguments: Any) -> ua.CallMethodResult:
        request = ua.CallMethodRequest(
            ObjectId=ua.NodeId(path.rpartition(".")[0], self.index),
            MethodId=ua.NodeId(path, self.index),
            InputArguments=[one if isinstance(one, ua.Variant) else ua.Variant(one) for one in arguments],
        )
        (result,) = await self.client.uaclient.call([request])
        return result

    async def status(self, path: str, *arguments: Any) -> str:
        return str((await self.call(path, *arguments)).StatusCode.name)

    async def returned(self, name: str, *arguments: Any) -> int:
        """The return status of a method of job control."""
        return int((await self.call(f"{CONTROL}.{name}", *arguments)).OutputArguments[-1].Value)

    async def job_states(self) -> dict[str, str]:
        listed = await self.read(f"{CONTROL}.JobOrderList")
        return {one.JobOrder.JobOrderID: one.State[0].StateText.Text for one in listed}

    async def until(self, check: Callable[[], Awaitable[bool]]) -> None:
        async with asyncio.timeout(60):
            while not await check():
                await asyncio.sleep(0.02)


def connected(
    server: LoomServer,
    pair: Pair | None,
    act: Callable[[Calls], Awaitable[None]],
    user: str | None = "operator",
    password: str | None = None,
) -> None:
    asyncio.run(session(server, pair, act, user, password))


async def session(
    server: LoomServer,
    pair: Pair | None,
    act: Callable[[Calls], Awaitable[None]],
    user: str | None,
    password: str | None,
) -> None:
    client = Client(server.url, timeout=20)
    client.application_uri = "urn:test:client"
    if pair is not None:
        await client.set_security(SecurityPolicyBasic256Sha256, *pair)
    if user is not None:
        client.set_user(user)
        client.set_password(f"{user}-password" if password is None else password)
    async with client:
        await act(Calls(client, await client.get_namespace_index("urn:ilmek:loom")))


def order(identifier: str, programme: str = PROGRAMME, priority: int = 0) -> Any:
    master = [ua.ISA95WorkMasterDataType(ID=programme)] if programme else []
    return ua.ISA95JobOrderDataType(JobOrderID=identifier, WorkMasterID=master, Priority=priority)


def test_shows_the_loom(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        machines = await calls.client.nodes.objects.get_child(
            f"{await calls.client.get_namespace_index('http://opcfoundation.org/UA/Machinery/')}:Machines"
        )
        assert [(await node.read_browse_name()).Name for node in await machines.get_children()] == ["Loom"]
        assert await calls.read("Loom.Identification.ProductInstanceUri") == PLATE.uri
        assert await calls.read("Loom.MachineryBuildingBlocks.MachineryItemState.CurrentState") == "NotExecuting"
        assert await calls.read("Loom.MachineryBuildingBlocks.MachineryOperationMode.CurrentState") == "Processing"
        assert await calls.read("Loom.PackML.BaseStateMachine.MachineState.CurrentState") == "Stopped"
        with pytest.raises(ua.uaerrors.BadStateNotActive):
            await calls.read(f"{EXECUTE}.CurrentState")
        assert await calls.read("Loom.PackML.Status.UnitModeCurrent") == 1
        assert await calls.read("Loom.Heads.Head0.Yarn") == "ivory"
        with pytest.raises(ua.uaerrors.BadNoData):
            await calls.read("Loom.Heads.Head1.Yarn")
        assert await calls.read("Loom.Heads.Head1.Tube2.Left") == 12.0
        assert await calls.read("Loom.Bobbins.Bobbin0.RowsLeft") == 3
        assert await calls.read("Loom.PackML.Status.CurMachSpeed") == 150.0
        assert await calls.read("Loom.Status.Commands") == ["reset", "abort"]

    connected(server, pair, act)


def test_weaves_a_job_from_order_to_end(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        assert await calls.returned("StoreAndStart", order("first")) == ReturnStatus.NO_ERROR
        assert await calls.returned("StoreAndStart", order("first")) == ReturnStatus.INVALID_REQUEST
        assert await calls.returned("Store", order("second", priority=3)) == ReturnStatus.NO_ERROR
        assert await calls.returned("Store", order("third", "ff" * 32)) == ReturnStatus.UNABLE_TO_ACCEPT
        assert await calls.returned("Stop", "second") == ReturnStatus.INVALID_STATUS
        assert await calls.returned("Stop", "nobody") == ReturnStatus.UNKNOWN_JOB_ORDER
        await calls.until(lambda: state_is(calls, "first", "Running"))
        if await calls.returned("Pause", "first") == ReturnStatus.NO_ERROR:
            await calls.until(lambda: state_is(calls, "first", "Interrupted"))
            await calls.until(lambda: permitted(calls, "unhold"))
            assert await calls.returned("Resume", "first") == ReturnStatus.NO_ERROR
        await calls.until(lambda: state_is(calls, "first", "Ended"))
        assert await calls.read("Loom.Carpet.Knots") == loom.total
        answer = await calls.call(f"{RESULTS}.RequestJobResponseByJobOrderID", "first")
        response, status = (one.Value for one in answer.OutputArguments)
        assert status == ReturnStatus.NO_ERROR
        assert {one.ID: one.Value.Value for one in response.JobResponseData} == {
            "KnotsTied": loom.total,
            "CarpetComplete": True,
        }
        assert await calls.returned("Store", order("fourth")) == ReturnStatus.UNABLE_TO_ACCEPT
        assert await calls.returned("Cancel", "second") == ReturnStatus.NO_ERROR
        assert await calls.returned("Clear", "first") == ReturnStatus.NO_ERROR
        assert await calls.job_states() == {}

    async def state_is(calls: Calls, name: str, state: str) -> bool:
        return (await calls.job_states()).get(name) == state

    async def permitted(calls: Calls, command: str) -> bool:
        return command in await calls.read("Loom.Status.Commands")

    connected(server, pair, act)


def test_a_job_is_woven_on_the_simulated_loom(server: LoomServer, woven: LoomRun, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        assert await calls.status(f"{EXECUTE}.Unhold") == "BadInvalidState"
        assert await calls.returned("StoreAndStart", order("carpet", "")) == ReturnStatus.NO_ERROR
        await calls.until(lambda: ended(calls))
        assert await calls.read("Loom.Carpet.Knots") == await calls.read("Loom.Carpet.KnotsTotal") == 6 * 24
        assert await calls.read("Loom.Status.State") == "Complete"
        assert await calls.read("Loom.Heads.Head1.Tube0.Left") < 1000.0
        assert await calls.returned("Clear", "carpet") == ReturnStatus.NO_ERROR

    async def ended(calls: Calls) -> bool:
        return (await calls.job_states())["carpet"] == "Ended"

    connected(server, pair, act)
    assert woven.result().ok


def test_a_command_that_the_state_forbids_is_refused(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        assert await calls.status(f"{EXECUTE}.Start") == "BadInvalidState"
        assert await calls.read("Loom.Status.LastRefusal") == "start: Start in state Stopped; allowed are Reset, Abort"
        assert await calls.status(f"{EXECUTE}.Hold", 1) == "BadTooManyArguments"
        assert await calls.status("Loom.PackML.SetMachSpeed", 1.0) == "BadNotSupported"
        assert await calls.status("Loom.PackML.SetUnitMode", "manual") == "BadInvalidArgument"
        assert await calls.status(f"{CONTROL}.Start") == "BadArgumentsMissing"
        assert await calls.status(f"{CONTROL}.StoreAndStart", "first") == "BadTypeMismatch"
        assert await calls.status(f"{CONTROL}.Store", order("x" * 5000)) == "BadInvalidArgument"
        assert await calls.returned("Store", order("")) == ReturnStatus.INVALID_REQUEST
        assert loom.given == ["start"]
        assert await calls.status("Loom.PackML.BaseStateMachine.MachineState.Reset") == "Good"
        assert loom.given == ["start", "reset"]

    connected(server, pair, act)


@pytest.mark.parametrize("user", ["operator", "viewer"])
def test_nobody_writes_and_a_viewer_does_not_command(
    server: LoomServer, loom: SteppingLoom, pair: Pair, user: str
) -> None:
    async def act(calls: Calls) -> None:
        for path, value in (("Loom.Carpet.Knots", 7), ("Loom.Identification.SerialNumber", "x")):
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await calls.node(path).write_value(value)
        with pytest.raises(ua.uaerrors.BadServiceUnsupported):
            await calls.client.nodes.objects.add_folder(calls.index, "mine")
        if user == "viewer":
            assert await calls.status(f"{EXECUTE}.Start") == "BadUserAccessDenied"
            assert await calls.status(f"{CONTROL}.Abort", "first") == "BadUserAccessDenied"
            assert await calls.status("Loom.PackML.SetUnitMode", 1) == "BadUserAccessDenied"
            assert await calls.status(f"{RESULTS}.RequestJobResponseByJobOrderID", "first") == "Uncertain"
            assert loom.given == []

    connected(server, pair, act, user)


def test_strangers_are_refused(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    async def act(_: Calls) -> None:
        pytest.fail("connected")

    with pytest.raises(ua.uaerrors.BadUserAccessDenied):
        connected(server, pair, act, "operator", "wrong-password")
    with pytest.raises(ua.uaerrors.BadUserAccessDenied):
        connected(server, pair, act, "nobody")
    with pytest.raises((ua.uaerrors.BadIdentityTokenRejected, ua.UaError)):
        connected(server, pair, act, None)
    with pytest.raises(ua.uaerrors.BadSecurityModeInsufficient):
        connected(server, None, act)


def test_alarms_are_conditions(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    class Events:
        def __init__(self) -> None:
            self.seen: list[Any] = []

        def event_notification(self, event: Any) -> None:
            self.seen.append(event)

    async def act(calls: Calls) -> None:
        events = Events()
        subscription = await calls.client.create_subscription(50, events)
        await subscription.subscribe_alarms_and_conditions(calls.client.nodes.server, calls.node("LoomAlarmType"))
        loom.alarms = (AlarmView("weft break", "the weft broke", "thread it", True, 5),)
        await calls.until(lambda: count_is(calls, 1))
        assert await calls.read("Loom.Alarms.Remedies") == ["thread it"]
        request = ua.CallMethodRequest(
            ObjectId=calls.node("Loom.Alarms.weft break").nodeid,
            MethodId=ua.NodeId(ua.ObjectIds.AcknowledgeableConditionType_Acknowledge),
            InputArguments=[ua.Variant(b"0"), ua.Variant(ua.LocalizedText("threaded"))],
        )
        (acknowledged,) = await calls.client.uaclient.call([request])
        assert acknowledged.StatusCode.is_good()
        await calls.until(lambda: count_is(calls, 0))
        assert await calls.status("Loom.Alarms.Acknowledge") == "Good"
        assert loom.given == ["acknowledge", "acknowledge"]
        await calls.until(lambda: seen(events, 2))
        raised, cleared = (event for event in events.seen if event.ConditionName)
        assert (raised.Cause, raised.Remedy, raised.Severity, raised.Retain) == (
            "the weft broke",
            "thread it",
            600,
            True,
        )
        assert (getattr(raised, "ActiveState/Id"), getattr(cleared, "ActiveState/Id")) == (True, False)

    async def count_is(calls: Calls, count: int) -> bool:
        return bool(await calls.read("Loom.Alarms.Count") == count)

    async def seen(events: Events, count: int) -> bool:
        return sum(bool(event.ConditionName) for event in events.seen) == count

    connected(server, pair, act)


def test_clients_stay_within_bounds(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    class Silent:
        def datachange_notification(self, *_: Any) -> None:
            pass

        def status_change_notification(self, *_: Any) -> None:
            pass

    async def act(calls: Calls) -> None:
        made = [await calls.client.create_subscription(1, Silent()) for _ in range(MOST_OF_SESSION)]
        assert made[0].parameters.RequestedPublishingInterval == LEAST_INTERVAL
        with pytest.raises(ua.uaerrors.BadTooManySubscriptions):
            await calls.client.create_subscription(1, Silent())
        with pytest.raises(ua.uaerrors.BadTooManyOperations):
            await calls.client.uaclient.read_attributes([calls.node("Loom.Carpet.Knots").nodeid] * 1001, 13)

        async def other(others: Calls) -> None:
            with pytest.raises(ua.uaerrors.BadSubscriptionIdInvalid):
                await others.client.uaclient.delete_monitored_items(
                    ua.DeleteMonitoredItemsParameters(made[0].subscription_id, [112])
                )

        await session(server, pair, other, "operator", None)

    connected(server, pair, act, "viewer")


def test_a_session_stays_on_its_channel(server: LoomServer, loom: SteppingLoom, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        token = calls.client.uaclient.session.authentication_token
        other = Client(server.url, timeout=20)
        other.application_uri = "urn:test:client"
        await other.set_security(SecurityPolicyBasic256Sha256, *pair)
        other.set_user("operator")
        other.set_password("wrong-password")
        await other.connect_socket()
        try:
            await other.send_hello()
            await other.open_secure_channel()
            other.uaclient.session.restore_authentication_token(token)
            with pytest.raises(ua.uaerrors.BadSessionIdInvalid):
                await other.activate_session("operator", "wrong-password")
            with pytest.raises(ua.uaerrors.BadUserAccessDenied):
                await other.get_node(ua.NodeId("Loom.Carpet.Knots", calls.index)).read_value()
        finally:
            await other.close_secure_channel()
            other.disconnect_socket()

    connected(server, pair, act)


def test_messages_of_any_size_are_cut_off(server: LoomServer) -> None:
    host, port = server.url.removeprefix("opc.tcp://").partition("/")[0].split(":")
    for begin in (b"HELF\xff\xff\xff\x7f", b"GET / HTTP/1.1\r\n\r\n"):
        with socket.create_connection((host, int(port)), timeout=10) as raw:
            raw.sendall(begin + bytes(2 * LARGEST_CHUNK))
            assert closed(raw)


def closed(raw: socket.socket) -> bool:
    try:
        return raw.recv(1) == b""
    except ConnectionResetError:
        return True


def test_a_port_in_use_is_an_error(server: LoomServer, loom: SteppingLoom) -> None:
    port = int(server.url.removeprefix("opc.tcp://127.0.0.1:").partition("/")[0])
    credentials = make_credentials(PLATE.uri, "loom", ("127.0.0.1",))
    for host, given in (("127.0.0.1", port), ("nowhere.invalid", 4840), ("192.0.2.1", 4840)):
        other = LoomServer(loom, PLATE, UserList({}), credentials, host=host, port=given)
        with pytest.raises(LoomError, match=f"{host}:{given} cannot be listened at"):
            other.start()
        other.stop()


def test_states_of_the_loom(loom: SteppingLoom, server: LoomServer, pair: Pair) -> None:
    async def act(calls: Calls) -> None:
        loom.state = PackState.ABORTED
        await calls.until(lambda: is_state(calls, "Aborted"))
        assert await calls.read("Loom.MachineryBuildingBlocks.MachineryItemState.CurrentState") == "OutOfService"
        assert await calls.read("Loom.PackML.BaseStateMachine.CurrentState") == "Aborted"
        assert await calls.status("Loom.PackML.BaseStateMachine.Clear") == "Good"
        await calls.until(lambda: is_state(calls, "Stopped"))

    async def is_state(calls: Calls, state: str) -> bool:
        return bool(await calls.read("Loom.Status.State") == state)

    connected(server, pair, act)


def test_the_reference_has_the_nodes_of_the_server(server: LoomServer) -> None:
    page = (Path(__file__).parents[2] / "docs/reference/opc-ua.md").read_text(encoding="utf-8")
    variables, methods = server.paths
    nodes = {*variables, *methods}
    stated = set(re.findall(r"`(Loom\.[\w.]+)`", page))
    assert {one for one in stated if not any(f"{node}.".startswith(f"{one}.") for node in nodes)} == set()
    for path, kind in own_objects(PLATE).items():
        if re.sub(r"\d", "0", path) == path:
            for field in TYPES[kind]:
                data = f"{field.data}[]" if field.array else field.data
                assert f"| `{path}.{field.name}` | {data} | {field.meaning} |" in page
            for name, (_, meaning) in METHODS.get(kind, {}).items():
                assert f"| `{path}.{name}` | method | {meaning} |" in page
    others = [path for path in methods if not path.startswith(CONTROL) and not path.startswith(RESULTS)]
    assert {re.sub(r"\d", "0", path) for path in others} <= stated
    assert [path for path in methods if path.startswith(CONTROL) and f"| {path.rpartition('.')[2]} |" not in page] == []
    assert all(f"| {status.value} |" in page for status in ReturnStatus)
