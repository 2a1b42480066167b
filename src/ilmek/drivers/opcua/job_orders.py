"""Job orders by OPC 40001-3 and OPC 10031-4 (ISA-95): a desk that takes orders and has the loom weave them.

    Store, StoreAndStart      Start, RevokeStart         the loom starts        Pause, Resume
    NotAllowedToStart  <->  AllowedToStart  ->  Running  <->  Interrupted  ->  Ended (Stop, or the carpet is complete)
                                                                           ->  Aborted (Abort)

The loom has one carpet on it. A job is to weave it, from wherever its journal stands, to its end. One job is in work
at a time; of those that are allowed to start the one of the highest priority is next.
"""

from collections.abc import Awaitable, Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from enum import IntEnum, StrEnum

from ilmek.drivers.opcua.states import OUT_OF_SERVICE
from ilmek.loom.control.view import Answer, Snapshot

MOST_JOBS = 32
"""Largest number of job orders in the list, those that ended included."""

LONGEST_ID = 100
"""Largest length of a job order's ID."""


class JobState(StrEnum):
    """A state of a job order, by its browse name."""

    NOT_ALLOWED_TO_START = "NotAllowedToStart"
    ALLOWED_TO_START = "AllowedToStart"
    RUNNING = "Running"
    INTERRUPTED = "Interrupted"
    ENDED = "Ended"
    ABORTED = "Aborted"


class ReturnStatus(IntEnum):
    """What a method of job control returns: OPC 10031-4, annex B.2; the last is of this project."""

    NO_ERROR = 1
    UNKNOWN_JOB_ORDER = 1 << 1
    INVALID_STATUS = 1 << 3
    UNABLE_TO_ACCEPT = 1 << 4
    INVALID_REQUEST = 1 << 32
    REFUSED_BY_CONTROLLER = 1 << 33


@dataclass(frozen=True)
class Job:
    """A job order.

    programme          digest of the programme to weave; "": the one that the loom has
    knots              certain knots of the carpet when the job began and now
    remark             why the controller refused to start it; ""
    """

    order: str
    programme: str = ""
    description: str = ""
    priority: int = 0
    state: JobState = JobState.NOT_ALLOWED_TO_START
    start: datetime | None = None
    end: datetime | None = None
    knots: tuple[int, int] = (0, 0)
    total: int = 0
    remark: str = ""

    @property
    def in_work(self) -> bool:
        """Whether the loom works on it."""
        return self.state in (JobState.RUNNING, JobState.INTERRUPTED)

    @property
    def over(self) -> bool:
        """Whether it ended, with success or not."""
        return self.state in (JobState.ENDED, JobState.ABORTED)

    @property
    def completed(self) -> bool:
        """Whether the carpet is complete."""
        return self.state is JobState.ENDED and self.total > 0 and self.knots[1] == self.total


Command = Callable[[str], Awaitable[Answer]]

_STOPPED = frozenset(("Stopping", "Stopped"))
_WAITING = frozenset(("Holding", "Held", "Suspending", "Suspended"))


class JobDesk:
    """The job orders of a loom. All calls come from one event loop.

    programme  digest of the programme that the loom has      command  gives the controller a command
    changed    called with each job whose state has changed
    """

    def __init__(self, programme: str, command: Command, changed: Callable[[Job], None] = lambda _: None) -> None:
        self._programme, self._command, self._changed = programme, command, changed
        self._jobs: dict[str, Job] = {}
        self._starting = False

    @property
    def jobs(self) -> tuple[Job, ...]:
        """All job orders, in the order in which they came."""
        return tuple(self._jobs.values())

    def store(self, job: Job, snapshot: Snapshot) -> ReturnStatus:
        """Take an order, in the state that it has."""
        if not 0 < len(job.order) <= LONGEST_ID or not job.order.isprintable() or job.order in self._jobs:
            return ReturnStatus.INVALID_REQUEST
        finished = snapshot.knots == snapshot.total
        if len(self._jobs) >= MOST_JOBS or finished or job.programme not in ("", self._programme):
            return ReturnStatus.UNABLE_TO_ACCEPT
        self._put(job)
        return ReturnStatus.NO_ERROR

    def start(self, order: str) -> ReturnStatus:
        """Allow an order to start."""
        return self._move(order, JobState.NOT_ALLOWED_TO_START, JobState.ALLOWED_TO_START)

    def revoke_start(self, order: str) -> ReturnStatus:
        """Forbid an order to start."""
        return self._move(order, JobState.ALLOWED_TO_START, JobState.NOT_ALLOWED_TO_START)

    def clear(self, order: str) -> ReturnStatus:
        """Remove an order that is over."""
        return self._remove(order, JobState.ENDED, JobState.ABORTED)

    def cancel(self, order: str) -> ReturnStatus:
        """Remove an order that was not started."""
        return self._remove(order, JobState.NOT_ALLOWED_TO_START, JobState.ALLOWED_TO_START)

    async def stop(self, order: str) -> ReturnStatus:
        """Stop the loom; the order ends with the carpet as far as it is."""
        return await self._give(order, "stop")

    async def pause(self, order: str) -> ReturnStatus:
        """Hold the loom."""
        return await self._give(order, "hold", JobState.RUNNING)

    async def resume(self, order: str, snapshot: Snapshot) -> ReturnStatus:
        """Let the loom go on."""
        return await self._give(order, "unsuspend" if snapshot.state == "Suspended" else "unhold", JobState.INTERRUPTED)

    async def abort(self, order: str) -> ReturnStatus:
        """Bring the loom to a stop at once; an order that was not started is over."""
        job = self._jobs.get(order)
        if job is not None and not job.in_work and not job.over:
            self._put(replace(job, state=JobState.ABORTED, end=datetime.now(UTC)))
            return ReturnStatus.NO_ERROR
        return await self._give(order, "abort")

    async def advance(self, snapshot: Snapshot) -> None:
        """Follow the loom's state, and start the next order when the loom is ready."""
        current = next((job for job in self._jobs.values() if job.in_work), None)
        if current is not None:
            self._follow(current, snapshot)
        elif not self._starting:
            self._starting = True
            try:
                await self._start_next(snapshot)
            finally:
                self._starting = False

    def _follow(self, job: Job, snapshot: Snapshot) -> None:
        state, end = JobState.RUNNING, None
        if snapshot.state == "Complete" or snapshot.state in _STOPPED:
            state, end = JobState.ENDED, datetime.now(UTC)
        elif snapshot.state in OUT_OF_SERVICE:
            state, end = JobState.ABORTED, datetime.now(UTC)
        elif snapshot.state in _WAITING:
            state = JobState.INTERRUPTED
        followed = replace(job, state=state, end=end, knots=(job.knots[0], snapshot.knots))
        if followed != job:
            self._put(followed, quiet=state is job.state)

    async def _start_next(self, snapshot: Snapshot) -> None:
        ready = [job for job in self._jobs.values() if job.state is JobState.ALLOWED_TO_START]
        if not ready:
            return
        job = max(ready, key=lambda one: one.priority)  # the first of the highest priority
        if snapshot.state == "Complete":
            self._put(replace(job, state=JobState.NOT_ALLOWED_TO_START, remark="the carpet is complete"))
            return
        if snapshot.state not in ("Execute", "Starting"):
            name = next((one for one in ("start", "reset") if one in snapshot.commands), None)
            if name is None:
                return
            answer = await self._command(name)
            if self._jobs.get(job.order) is not job:
                return  # cancelled, aborted or revoked meanwhile
            if not answer.ok:
                self._put(replace(job, state=JobState.NOT_ALLOWED_TO_START, remark=answer.reason))
                return
            if name == "reset":
                return
        knots = (snapshot.knots, snapshot.knots)
        self._put(
            replace(job, state=JobState.RUNNING, start=datetime.now(UTC), knots=knots, total=snapshot.total, remark="")
        )

    async def _give(self, order: str, command: str, *states: JobState) -> ReturnStatus:
        job = self._jobs.get(order)
        if job is None:
            return ReturnStatus.UNKNOWN_JOB_ORDER
        if not job.in_work or (states and job.state not in states):
            return ReturnStatus.INVALID_STATUS
        answer = await self._command(command)
        if not answer.ok and order in self._jobs:
            self._put(replace(self._jobs[order], remark=answer.reason), quiet=True)
        return ReturnStatus.NO_ERROR if answer.ok else ReturnStatus.REFUSED_BY_CONTROLLER

    def _move(self, order: str, before: JobState, after: JobState) -> ReturnStatus:
        job = self._jobs.get(order)
        if job is None:
            return ReturnStatus.UNKNOWN_JOB_ORDER
        if job.state is not before:
            return ReturnStatus.INVALID_STATUS
        self._put(replace(job, state=after, remark=""))
        return ReturnStatus.NO_ERROR

    def _remove(self, order: str, *states: JobState) -> ReturnStatus:
        job = self._jobs.get(order)
        if job is None:
            return ReturnStatus.UNKNOWN_JOB_ORDER
        if job.state not in states:
            return ReturnStatus.INVALID_STATUS
        del self._jobs[order]
        return ReturnStatus.NO_ERROR

    def _put(self, job: Job, *, quiet: bool = False) -> None:
        self._jobs[job.order] = job
        if not quiet:
            self._changed(job)
