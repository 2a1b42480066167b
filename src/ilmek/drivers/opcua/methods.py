"""The methods of the server: commands of PackML, job control of ISA-95."""

from collections.abc import Awaitable, Callable, Sequence
from typing import Any

from asyncua import ua

from ilmek.drivers.opcua.job_orders import Job, JobDesk, JobState, ReturnStatus
from ilmek.drivers.opcua.model import LOOM, METHODS, own_objects
from ilmek.drivers.opcua.space import AddressSpace
from ilmek.drivers.opcua.values import BLOCKS, PACKML
from ilmek.loom.control.view import Answer, Snapshot

CONTROL = f"{BLOCKS}.JobManagement.JobOrderControl"
RESULTS = f"{BLOCKS}.JobManagement.JobOrderResults"
RECEIVER = "ISA95:ISA95JobOrderReceiverObjectType"

_BASE = f"{PACKML}.BaseStateMachine"
COMMANDS = {
    f"{_BASE}.Abort": "abort",
    f"{_BASE}.Clear": "clear",
    f"{_BASE}.MachineState.Reset": "reset",
    f"{_BASE}.MachineState.Stop": "stop",
    **{
        f"{_BASE}.MachineState.ExecuteState.{name.capitalize()}": name
        for name in ("hold", "reset", "start", "suspend", "unhold", "unsuspend")
    },
}
"""Command of the controller for each method of the state machines of PackML."""

UNSUPPORTED = tuple(f"{PACKML}.{name}" for name in ("SetMachSpeed", "SetProduct", "SetParameter"))
"""Mandatory methods of PackML that the loom does not have: speed, product and parameters are the programme's."""

_LONGEST = 1000
_GOOD, _C = ua.StatusCode(), ua.StatusCodes


class LoomMethods:
    """Answers the calls of operators; what the controller refuses is refused with Bad_InvalidState.

    command  gives the controller a command     snapshot  the last one     refused  takes the reason of a refusal
    """

    def __init__(
        self,
        space: AddressSpace,
        desk: JobDesk,
        command: Callable[[str], Awaitable[Answer]],
        snapshot: Callable[[], Snapshot],
        refused: Callable[[str], Awaitable[None]],
    ) -> None:
        self._space, self._desk, self._command = space, desk, command
        self._snapshot, self._refused = snapshot, refused

    def bind(self) -> set[ua.NodeId]:
        """Bind all methods; the identifiers of those that only read."""
        for path, name in COMMANDS.items():
            self._space.bind(path, self._packml(name))
        for path, kind in own_objects(self._space.plate).items():
            for name, (command, _) in METHODS.get(kind, {}).items():
                self._space.bind(f"{path}.{name}", self._packml(command))
        for path in UNSUPPORTED:
            self._space.bind(path, _unsupported)
        self._space.bind(f"{PACKML}.SetUnitMode", self._set_mode)
        for name, called in self._job_control().items():
            self._space.bind(f"{CONTROL}.{name}", called)
        reads = (
            self._space.bind(f"{RESULTS}.RequestJobResponseByJobOrderID", self._response_by_id),
            self._space.bind(f"{RESULTS}.RequestJobResponseByJobOrderState", self._responses_by_state),
        )
        return {identifier for pair in reads for identifier in pair}

    def _packml(self, name: str) -> Callable[..., Awaitable[ua.CallMethodResult]]:
        async def called(_: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
            if len(arguments) > (1 if name == "start" else 0):
                return _result(_C.BadTooManyArguments)
            return await self._answered(name)

        return called

    async def acknowledged(self, request: ua.CallMethodRequest) -> ua.CallMethodResult:
        """Acknowledge of a condition: the loom's alarms are acknowledged together."""
        condition = request.ObjectId.Identifier
        known = {f"{LOOM}.Alarms.{alarm.name}" for alarm in self._snapshot().alarms}
        if condition not in known or request.ObjectId.NamespaceIndex != self._space.spaces["Loom"]:
            return _result(_C.BadNodeIdUnknown)
        return await self._answered("acknowledge")

    async def _set_mode(self, _: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
        modes = {1: "production", 2: "maintenance", 3: "manual"}
        if len(arguments) != 1:
            return _result(_C.BadArgumentsMissing if not arguments else _C.BadTooManyArguments)
        name = modes.get(arguments[0].Value) if isinstance(arguments[0].Value, int) else None
        return _result(_C.BadInvalidArgument) if name is None else await self._answered(name)

    async def _answered(self, command: str) -> ua.CallMethodResult:
        try:
            answer = await self._command(command)
        except TimeoutError:
            await self._refused(f"{command}: the controller did not answer in time")
            return _result(_C.BadTimeout)
        if answer.ok:
            return _result(_C.Good)
        await self._refused(f"{command}: {answer.reason}")
        return _result(_C.BadInvalidState)

    def _job_control(self) -> dict[str, Callable[..., Awaitable[ua.CallMethodResult]]]:
        desk = self._desk

        async def at_once(status: ReturnStatus) -> ReturnStatus:
            return status

        return {
            "Store": self._ordering(JobState.NOT_ALLOWED_TO_START),
            "StoreAndStart": self._ordering(JobState.ALLOWED_TO_START),
            "Start": self._on_order(lambda order: at_once(desk.start(order))),
            "RevokeStart": self._on_order(lambda order: at_once(desk.revoke_start(order))),
            "Cancel": self._on_order(lambda order: at_once(desk.cancel(order))),
            "Clear": self._on_order(lambda order: at_once(desk.clear(order))),
            "Stop": self._on_order(desk.stop),
            "Pause": self._on_order(desk.pause),
            "Resume": self._on_order(lambda order: desk.resume(order, self._snapshot())),
            "Abort": self._on_order(desk.abort),
        }

    def _ordering(self, state: JobState) -> Callable[..., Awaitable[ua.CallMethodResult]]:
        async def called(_: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
            wrong = _wrong(arguments, ua.ISA95JobOrderDataType)
            if wrong is not None:
                return wrong
            try:
                job = job_of(arguments[0].Value, state)
            except (TypeError, ValueError):
                return _result(_C.BadInvalidArgument)
            return await self._returned(self._desk.store(job, self._snapshot()))

        return called

    def _on_order(self, act: Callable[[str], Awaitable[ReturnStatus]]) -> Callable[..., Awaitable[ua.CallMethodResult]]:
        async def called(_: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
            wrong = _wrong(arguments, str)
            if wrong is not None:
                return wrong
            try:
                status = await act(arguments[0].Value)
            except TimeoutError:
                return _result(_C.BadTimeout)
            return await self._returned(status)

        return called

    async def _returned(self, status: ReturnStatus) -> ua.CallMethodResult:
        """The return status; where it is not NoError the call is uncertain (OPC 10031-4, B.2)."""
        await self._space.write(job_values(self._space, self._desk.jobs))
        code = _C.Good if status is ReturnStatus.NO_ERROR else _C.Uncertain
        return _result(code, ua.Variant(int(status), ua.VariantType.UInt64))

    async def _response_by_id(self, _: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
        wrong = _wrong(arguments, str)
        if wrong is not None:
            return wrong
        found = [job for job in self._desk.jobs if job.order == arguments[0].Value]
        status = ReturnStatus.NO_ERROR if found else ReturnStatus.UNKNOWN_JOB_ORDER
        response = job_response(self._space, found[0]) if found else ua.ISA95JobResponseDataType()
        returned = ua.Variant(int(status), ua.VariantType.UInt64)
        return _result(_C.Good if found else _C.Uncertain, ua.Variant(response), returned)

    async def _responses_by_state(self, _: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:
        wrong = _wrong(arguments, list)
        if wrong is not None:
            return wrong
        names = {state.StateText.Text for state in arguments[0].Value if isinstance(state, ua.ISA95StateDataType)}
        found = [job_response(self._space, job) for job in self._desk.jobs if job.state in names]
        returned = ua.Variant(int(ReturnStatus.NO_ERROR), ua.VariantType.UInt64)
        return _result(_C.Good, ua.Variant(found, ua.VariantType.ExtensionObject, is_array=True), returned)


async def _unsupported(_: ua.NodeId, *arguments: ua.Variant) -> ua.CallMethodResult:  # noqa: ARG001
    return _result(_C.BadNotSupported)


def _result(code: int, *outputs: ua.Variant) -> ua.CallMethodResult:
    return ua.CallMethodResult(StatusCode=ua.StatusCode(code), OutputArguments=list(outputs))


def _wrong(arguments: Sequence[ua.Variant], kind: type) -> ua.CallMethodResult | None:
    """The refusal of a call whose first argument is not of a kind; a comment may follow."""
    if not arguments:
        return _result(_C.BadArgumentsMissing)
    if len(arguments) > 2:
        return _result(_C.BadTooManyArguments)
    return None if isinstance(arguments[0].Value, kind) else _result(_C.BadTypeMismatch)


def job_of(given: Any, state: JobState) -> Job:
    """A job from an order of ISA-95. Raises ValueError or TypeError for one that is malformed or too long."""
    masters = [master.ID for master in given.WorkMasterID or ()]
    texts = [text.Text for text in given.Description or ()]
    order, programme, description = given.JobOrderID, (masters or [""])[0], (texts or [""])[0]
    if not all(isinstance(one, str) and len(one) <= _LONGEST for one in (order, programme, description)):
        raise ValueError
    if len(masters) > 1:
        raise ValueError
    return Job(order, programme, description, int(given.Priority or 0), state)


def job_values(space: AddressSpace, jobs: Sequence[Job]) -> dict[str, object]:
    """The variables of job control by path."""
    listed = [ua.ISA95JobOrderAndStateDataType(JobOrder=job_order(job), State=job_state(space, job)) for job in jobs]
    begun = [job for job in jobs if job.start is not None or job.over]
    return {
        f"{CONTROL}.JobOrderList": listed,
        f"{RESULTS}.JobOrderResponseList": [job_response(space, job) for job in begun],
    }


def job_order(job: Job) -> Any:
    """A job as an order of ISA-95."""
    return ua.ISA95JobOrderDataType(
        JobOrderID=job.order,
        Description=[ua.LocalizedText(text) for text in (job.description, job.remark) if text],
        WorkMasterID=[ua.ISA95WorkMasterDataType(ID=job.programme)] if job.programme else [],
        Priority=job.priority,
    )


def job_state(space: AddressSpace, job: Job) -> list[Any]:
    """The state of a job: one level, without substates."""
    _, number = space.state_number(RECEIVER, job.state)
    element = ua.RelativePathElement(
        ReferenceTypeId=ua.NodeId(ua.ObjectIds.HasComponent),
        TargetName=ua.QualifiedName(job.state.value, space.spaces["ISA95"]),
    )
    path = ua.RelativePath(Elements=[element])
    return [ua.ISA95StateDataType(BrowsePath=path, StateText=ua.LocalizedText(job.state.value), StateNumber=number)]


def job_response(space: AddressSpace, job: Job) -> Any:
    """What came of a job: the knots tied for it, and whether the carpet is complete."""
    data = {
        "KnotsTied": ua.Variant(job.knots[1] - job.knots[0], ua.VariantType.UInt32),
        "CarpetComplete": ua.Variant(job.completed, ua.VariantType.Boolean),
    }
    return ua.ISA95JobResponseDataType(
        JobResponseID=f"{job.order}-response",
        JobOrderID=job.order,
        StartTime=job.start,
        EndTime=job.end,
        JobState=job_state(space, job),
        JobResponseData=[ua.ISA95ParameterDataType(ID=name, Value=value) for name, value in data.items()],
    )
