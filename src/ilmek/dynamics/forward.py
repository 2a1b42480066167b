"""Forward dynamics of a machine: its motion under drives, loads and the friction of its joints.

With one input and no friction the equation is that of `one_input`, else that of `equation_of_motion`.

Start-up, running, coasting and stopping are consecutive runs; each starts at the end of the previous one. A run ends at
its duration, at a terminal event, at a dead centre, where the mechanism cannot close, where friction holds it, or after
its most steps. What it reached is kept, and its end is reported with time, state and reason. The integrator is the
Dormand-Prince method of order 8 with error control [Hairer, Norsett and Wanner, Solving Ordinary Differential Equations
I, section II.10]. The work of drives and loads is integrated as well, for the energy balance.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import TypeAlias

import numpy as np
import scipy

from ilmek.arguments import Arguments
from ilmek.arrays import BoolArray, FloatArray
from ilmek.dynamics.end_stops import Contact, Limits, after_contact, limits_of, rest
from ilmek.dynamics.equation_of_motion import GeneralEquation, general_equation
from ilmek.dynamics.events import Event, EventRecord, crossing_time, until_terminal
from ilmek.dynamics.forward_run import Drive, EndKind, ForwardRun, ForwardState, Row, RunEnd, motion_of
from ilmek.dynamics.fourier_terms import tabulate
from ilmek.dynamics.one_input import OneInputEquation
from ilmek.dynamics.own_machine import EndStop
from ilmek.dynamics.pose_block import part_of
from ilmek.dynamics.reduced import ReducedMechanism
from ilmek.dynamics.reversals import Equation, RunSample, between, restarted, reversal
from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status

__all__ = [
    "Drive",
    "EndKind",
    "ForwardRun",
    "ForwardState",
    "RunEnd",
    "RunEvent",
    "at_angle",
    "at_rest",
    "at_speed",
    "forward",
]

MOST_STEPS = 200_000
"""Steps of the integrator in a run: about a minute. A drive that is much too strong for the masses needs more."""

PACE, SLOW = 400, 0.1
"""Steps after which a run is ended that advanced less than a share of what its most steps need to reach its end: at
rest, a load or drive that jumps there makes the integrator chatter.
"""


RunEvent: TypeAlias = Event[ForwardState]
"""An event of a run; its value is a function of the state of the input."""


def at_speed(speed: float) -> RunEvent:
    """Terminal event: the input reaches a speed [rad/s; m/s]."""
    return RunEvent(f"speed {speed:g} reached", lambda state: float(state.speed) - speed)


def at_angle(position: float) -> RunEvent:
    """Terminal event: the input reaches a position [rad; m], counted through all turns."""
    return RunEvent(f"position {position:g} reached", lambda state: float(state.position) - position)


def at_rest() -> RunEvent:
    """Terminal event: the input comes to rest; a start from rest does not count."""
    return RunEvent("at rest", lambda state: float(state.speed))


def forward(
    reduced: ReducedMechanism,
    start: ForwardState,
    duration: float,
    *,
    drive: Drive | Mapping[str, Drive] | None = None,
    events: Sequence[RunEvent] = (),
    stops: Sequence[EndStop] = (),
    ratchet: int = 0,
    every: float | None = None,
    rtol: float = 1e-9,
    most_steps: int = MOST_STEPS,
) -> ForwardRun:
    """A run of the machine from a given state.

    reduced   the mechanism with masses, loads and friction; see `reduce`
    start     state at the start
    duration  [s]
    drive     a `MotorDrive`, or the effort on the input [N m; N] as a function of time, position and speed; of several
              inputs by name; default: no drive, the machine coasts
    events    checked at each step of the integrator; a terminal event ends the run; default: none
    stops     of one input      ratchet  the direction in which one input is free, +1 or -1; 0: both
    every     time between the reported samples [s]; default: the steps of the integrator
    rtol      relative error of a step in angle (relative to 1 rad), speed and work, 3e-14 to 1e-2
    most_steps  of the integrator

    A run that ends early, also after its most steps, keeps what it reached: see `ForwardRun.end`. Raises MechanismError
    for a start at which the mechanism does not close, a state, duration or effort that is not finite, and a tolerance
    outside its range.
    """
    _check(duration, every, rtol)
    _check_start(reduced, start)
    equation = _equation(reduced, start, drive)
    first, scale = equation.first(start)
    task = _Task(
        start.time,
        start.time + duration,
        rtol,
        rtol * scale,
        tuple(events),
        every,
        most_steps,
        limits_of(stops, ratchet, start),
    )
    at: RunSample | RunEnd = RunSample(start.time, first, equation)
    if isinstance(equation, GeneralEquation) and 0.0 in equation.signs:
        at = restarted(RunSample(start.time, first, equation), np.array(equation.signs[: equation.dry]) == 0)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        if isinstance(at, RunEnd):
            return _forward_run(reduced, _Integration([RunSample(start.time, first, equation)], [], at))
        return _forward_run(reduced, _advance(task, at))


def _equation(reduced: ReducedMechanism, start: ForwardState, drive: Drive | Mapping[str, Drive] | None) -> Equation:
    names = tuple(reduced.wheels)
    if drive is not None and not isinstance(drive, Mapping):
        if len(names) > 1:
            given = f"one drive is given for {len(names)} inputs"
            raise MechanismError(given, allowed=f"input -> drive; the inputs are {', '.join(names)}")
        drive = {names[0]: drive}
    for name in drive or {}:
        Arguments("", MechanismError).one_of("an input", name, names)
    drives = [(drive or {}).get(name) for name in names]
    if reduced.one:
        return OneInputEquation(reduced, tabulate(reduced), drives[0])
    return general_equation(reduced, drives, start)


@dataclass(frozen=True, slots=True)
class _Task:
    """What is integrated: to an end [s], with errors, events, time between samples [s] and most steps."""

    start: float
    end: float
    rtol: float
    atol: Row
    events: tuple[RunEvent, ...]
    every: float | None
    most_steps: int
    limits: Limits | None = None

    def solver(self, at: RunSample) -> "scipy.integrate.DOP853":
        """The integrator from a sample."""
        return scipy.integrate.DOP853(at.equation.rates, at.time, at.row, self.end, rtol=self.rtol, atol=self.atol)


@dataclass(frozen=True, slots=True)
class _Integration:
    """Samples, events that occurred, and the end."""

    samples: list[RunSample]
    happened: list[EventRecord[ForwardState]]
    end: RunEnd
    rests: list[tuple[float, float]] = field(default_factory=list)


def _check(duration: float, every: float | None, rtol: float) -> None:
    if not (np.isfinite(duration) and duration > 0):
        raise MechanismError(f"duration of a run is {duration:g} s", allowed="finite and above 0")
    if every is not None and not (np.isfinite(every) and every > 0):
        raise MechanismError(f"time between samples of a run is {every:g} s", allowed="finite and above 0")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")


def _check_start(reduced: ReducedMechanism, start: ForwardState) -> None:
    """Raise MechanismError for a start that is not finite, for other inputs, or at which the mechanism cannot close."""
    state = np.atleast_1d(start.position), np.atleast_1d(start.speed), np.atleast_1d(start.time)
    if not np.isfinite(np.concatenate(state)).all():
        raise MechanismError(f"the start of the run is {start}", allowed="finite values")
    if len(state[0]) != len(reduced.wheels) or len(state[1]) != len(reduced.wheels):
        given = f"the start has {len(state[0])} positions and {len(state[1])} speeds"
        raise MechanismError(given, allowed=f"one of each input: {', '.join(reduced.wheels)}")
    solve(reduced.plan, dict(zip(reduced.wheels, state[0].tolist(), strict=True))).require()


def _advance(task: _Task, at: RunSample) -> _Integration:
    """Integrate to the end of the run; the last sample is the end."""
    solver, equation, samples = task.solver(at), at.equation, [at]
    happened: list[EventRecord[ForwardState]] = []
    rests: list[tuple[float, float]] = []
    before, mark, greatest = _values(task.events, at.state), at.time, abs(float(at.row[1]))
    for step in range(1, task.most_steps + 1):
        if solver.status != "running" or _crawls(task, step, solver.t - mark):
            break
        mark = solver.t if step % PACE == 0 else mark
        solver.step()
        if solver.status == "failed" or _stopped_at_limit(solver, equation):
            _add_end(samples, RunSample(float(solver.t), np.array(solver.y), equation))
            return _Integration(samples, happened, _failure(solver, equation), rests)
        last, resting, contact = _step_end(task, solver, equation)
        greatest = max(greatest, abs(float(last.row[1])))
        now = _values(task.events, last.state) if task.events else []
        happened += _events_in_step(solver, last, task.events, before, now)
        if happened and happened[-1].terminal:
            hit = happened[-1]
            samples += _samples_in_step(solver, task, between(solver, equation, hit.time), ends=True)
            return _Integration(samples, happened, RunEnd(EndKind.EVENT, hit.state, hit.name), rests)
        samples += _samples_in_step(solver, task, last, ends=solver.status == "finished" and resting is None)
        before = now
        if contact is not None:
            happened.append(EventRecord(contact.name, last.time, last.state, terminal=False))
            on = _after(task, contact, greatest, samples, rests)
            if on is None:
                break
            before, equation, solver = _values(task.events, on.state), on.equation, task.solver(on)
        if resting is not None:
            after = restarted(last, resting)
            if isinstance(after, RunEnd):
                _add_end(samples, last)
                return _Integration(samples, happened, after, rests)
            equation, solver = after.equation, task.solver(after)
    if solver.status == "running" and samples[-1].time < task.end:
        _add_end(samples, RunSample(float(solver.t), np.array(solver.y), equation))
        reason = f"{step} steps of the integrator reached {solver.t:.4g} s of {solver.t_bound:.4g} s"
        return _Integration(samples, happened, RunEnd(EndKind.STEPS, samples[-1].state, reason), rests)
    return _Integration(samples, happened, RunEnd(EndKind.TIME, samples[-1].state, "its duration was reached"), rests)


def _step_end(
    task: _Task, solver: "scipy.integrate.DOP853", equation: Equation
) -> tuple[RunSample, BoolArray | None, Contact | None]:
    """The state up to which the last step holds; which joints rest there; the contact there."""
    last, resting = reversal(solver, equation)
    contact = task.limits.contact(solver, last) if task.limits is not None else None
    return (last, resting, None) if contact is None else (contact.at, None, contact)


def _crawls(task: _Task, step: int, advance: float) -> bool:
    """Whether the last `PACE` steps advanced [s] so little that the most steps will not reach the end."""
    return step % PACE == 0 and advance * task.most_steps < SLOW * PACE * (task.end - task.start)


def _add_end(samples: list[RunSample], last: RunSample) -> None:
    """Add the last state of a run, if it is not a sample yet."""
    if samples[-1].time < last.time:
        samples.append(last)


def _samples_in_step(solver: "scipy.integrate.DOP853", task: _Task, last: RunSample, *, ends: bool) -> list[RunSample]:
    """Samples in the last step up to a state: multiples of `every`, and the state itself if the run ends there."""
    if task.every is None:
        return [last]
    first = int(np.floor((solver.t_old - task.start) / task.every + 1e-9)) + 1
    final = int(np.floor((last.time - task.start) / task.every + 1e-9))
    at = [min(task.start + task.every * k, last.time) for k in range(first, final + 1)]
    if ends and not (at and at[-1] > last.time - 1e-9 * task.every):
        at.append(last.time)
    rows = solver.dense_output()(np.array(at)).T if at else ()
    return [RunSample(time, row, last.equation) for time, row in zip(at, rows, strict=True)]


def _after(
    task: _Task, contact: Contact, greatest: float, samples: list[RunSample], rests: list[tuple[float, float]]
) -> RunSample | None:
    """The state after a contact, and after the rest that may follow; None: it rests until the end of the run."""
    after = after_contact(contact, greatest)
    if after is None:
        after = rest(contact, task.end)
        rests.append((contact.at.time, task.end if after is None else after.time))
        samples += _samples_of_rest(task, contact.at, rests[-1], ends=after is None)
    return after


def _samples_of_rest(task: _Task, at: RunSample, span: tuple[float, float], *, ends: bool) -> list[RunSample]:
    """Samples of an input at rest over a span [s]."""
    times = [] if task.every is None else np.arange(task.start, span[1], task.every).tolist()
    times = [time for time in times if time > span[0]]
    return [at._replace(time=time) for time in (*times, *([span[1]] if ends or task.every is None else []))]


def _events_in_step(
    solver: "scipy.integrate.DOP853",
    last: RunSample,
    events: tuple[RunEvent, ...],
    before: list[float],
    now: list[float],
) -> list[EventRecord[ForwardState]]:
    """Events in the last step up to a state, in their order, up to the first terminal event."""
    met: list[EventRecord[ForwardState]] = []
    for event, old, new in zip(events, before, now, strict=True):
        if event.crossed(old, new):
            dense = solver.dense_output()

            def at(time: float, dense: Callable[[float], Row] = dense) -> ForwardState:
                return last.equation.state(time, dense(time))

            time = crossing_time(lambda time, event=event, at=at: event.evaluate(at(time)), solver.t_old, last.time)  # type: ignore[misc]
            met.append(EventRecord(event.name, time, at(time), event.terminal))
    return until_terminal(met)


def _values(events: tuple[RunEvent, ...], state: ForwardState) -> list[float]:
    return [event.evaluate(state) for event in events]


CREEP = 1e-9
"""Motion of the input in one step [rad; m] below which the poses just ahead are checked for a limit."""

PROBES = np.concatenate(([0.0], np.logspace(-15, -3, 25)))
"""Distances ahead of the last state at which the reason of a failure is sought [rad; m]."""


def _ahead(solver: "scipy.integrate.DOP853", equation: Equation, distances: FloatArray) -> Motion:
    """The mechanism at distances ahead of the last state [rad; m], in the direction of its motion."""
    names = tuple(equation.reduced.wheels)
    position, pace = solver.y[: len(names)], solver.y[len(names) : 2 * len(names)]
    size = float(np.linalg.norm(pace))
    direction = pace / size if size > 0 else np.ones(len(names))
    at = {name: one + way * distances for name, one, way in zip(names, position, direction, strict=True)}
    return solve(equation.reduced.plan, at, dict.fromkeys(names, 1.0))


def _stopped_at_limit(solver: "scipy.integrate.DOP853", equation: Equation) -> bool:
    """Whether one input is at the end of its range: q' tends to 0 there while √J q' does not, and q creeps."""
    if len(equation.reduced.wheels) > 1 or (isinstance(equation, OneInputEquation) and equation.table is not None):
        return False
    if abs(float(solver.y[0]) - float(solver.y_old[0])) > CREEP:
        return False
    return bool(_ahead(solver, equation, PROBES[PROBES <= CREEP]).status.any())


def _failure(solver: "scipy.integrate.DOP853", equation: Equation) -> RunEnd:
    """Reason why no further step is possible, from the status of the poses just ahead."""
    last = equation.state(float(solver.t), solver.y)
    moved = _ahead(solver, equation, PROBES)
    bad = np.flatnonzero(moved.status != Status.OK)
    if len(bad) == 0:
        reason = "the drive or a load is not finite, or not smooth enough for this error"
        return RunEnd(EndKind.STEP, last, reason if equation.reduced.one else f"{reason}, or friction locks it")
    reason = ""
    try:
        part_of(moved, slice(bad[-1], bad[-1] + 1)).require()
    except MechanismError as fault:
        reason = fault.given
    # A pose that can be passed is a dead centre; at the end of the input's range the links cannot close beyond it.
    beyond = moved.status[-1] if moved.status[-1] != Status.OK else Status.DEAD_CENTRE
    return RunEnd(EndKind[Status(beyond).name], last, reason)


def _forward_run(reduced: ReducedMechanism, found: _Integration) -> ForwardRun:
    """The samples as arrays, with accelerations, efforts and energies from the mechanism's equations."""
    time = np.array([sample.time for sample in found.samples])
    rows = np.stack([sample.row for sample in found.samples])
    count = len(reduced.wheels)
    parts = []
    for _, group in groupby(range(len(time)), key=lambda k: id(found.samples[k].equation)):
        at = list(group)
        parts.append(found.samples[at[0]].equation.history(time[at], rows[at]))
    speed, acceleration, effort = (np.concatenate(one, axis=-1) for one in zip(*parts, strict=True))
    for begin, end in found.rests:
        acceleration[(time > begin) & (time <= end)] = 0.0
    position = rows[:, 0] if count == 1 else rows[:, :count].T
    equation = found.samples[0].equation
    table = equation.table if isinstance(equation, OneInputEquation) else None
    return ForwardRun(
        reduced,
        time,
        position,
        speed,
        acceleration,
        effort,
        *reduced.energies(motion_of(reduced, time, position, speed)),
        rows[:, -2],
        rows[:, -1],
        found.end,
        tuple(found.happened),
        table.error if table else None,
    )
