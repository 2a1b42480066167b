"""Forward dynamics of a machine of one freedom: how it moves under its drive and its loads.

    J q'' + J' q'^2 / 2 = Q + M,   written as   q' = p / √J,   p' = (Q + M) / √J           [see `reduced`; M: drive]

p = √J q' has p^2 / 2 for its energy, needs no slope of J, and stays finite where J does not: at a dead centre.

Start-up, running, coasting and stopping are runs one after the other, each from the last one's end. A run ends at its
time, at an event, or where the mechanism comes to a dead centre or cannot close: there, with time, state and reason.
Integrated by the Dormand-Prince pair of order 8 with error control [Hairer, Norsett and Wanner, Solving Ordinary
Differential Equations I, section II.10]; the work of drive and loads is integrated along, for the energy balance.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Float
from ilmek.dynamics.events import Event, EventRecord, located, until_terminal
from ilmek.dynamics.forward_run import Drive, EndKind, ForwardRun, ForwardState, RunEnd, energies
from ilmek.dynamics.fourier_terms import FourierTerms, tabulate
from ilmek.dynamics.reduced import ReducedMechanism
from ilmek.errors import MechanismError
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

Row: TypeAlias = Float[np.ndarray, " 4"]
"""What is integrated: position, p, work of the drive, work of the loads other than weight and constants."""


RunEvent: TypeAlias = Event[ForwardState]
"""An event of a run: its value is a function of the input's state: position, speed, time."""


def at_speed(speed: float) -> RunEvent:
    """End where the input reaches a speed [rad/s, m/s]."""
    return RunEvent(f"speed {speed:g} reached", lambda state: state.speed - speed)


def at_angle(position: float) -> RunEvent:
    """End where the input comes to a position [rad, m], counted through all turns: an end of travel."""
    return RunEvent(f"position {position:g} reached", lambda state: state.position - position)


def at_rest() -> RunEvent:
    """End where the input comes to rest; a start from rest is not meant."""
    return RunEvent("at rest", lambda state: state.speed)


def forward(
    reduced: ReducedMechanism,
    start: ForwardState,
    duration: float,
    *,
    drive: Drive | None = None,
    events: Sequence[RunEvent] = (),
    every: float | None = None,
    rtol: float = 1e-9,
) -> ForwardRun:
    """A run of the machine from a state, for a time [s].

    drive  effort on the input [N m, or N] of (t, q, q'): a motor's torque-speed curve, for example; None: coasting
    events looked for at each step of the integrator; a terminal one ends the run
    every  time between the samples of the answer [s]; None: the integrator's own steps
    rtol   relative error of a step in angle (against 1 rad), speed and work

    A machine that turns fully is run on its Fourier table (see `fourier_terms`), any other on the engine itself.
    Raises MechanismError for a start in which the mechanism does not close, a state, duration or effort that is not
    finite, and a tolerance that cannot be kept.
    """
    _check(duration, every, rtol)
    course = _Course(reduced, tabulate(reduced), drive)
    first, scale = _first(course, start)
    solver = scipy.integrate.DOP853(
        course.rates, start.time, first, start.time + duration, rtol=rtol, atol=rtol * scale
    )
    return _run(course, _advance(solver, course, tuple(events), every))


@dataclass(frozen=True, slots=True)
class _Course:
    """The right-hand side of a run."""

    reduced: ReducedMechanism
    table: FourierTerms | None
    drive: Drive | None

    def terms(self, position: float) -> tuple[float, float, float]:
        """J, Q of the weights and of the other steady loads; NaN where the mechanism does not close."""
        if self.table is not None:
            return self.table(position)
        found = self.reduced.terms(np.array([position]))
        if found.status[0] != Status.OK:
            return math.nan, math.nan, math.nan
        return float(found.inertia[0]), float(found.weight[0]), float(found.push[0])

    def efforts(self, time: float, position: float, speed: float) -> tuple[float, float]:
        """Efforts of the drive and of the live loads."""
        effort = float(self.drive(time, position, speed)) if self.drive is not None else 0.0
        if not self.reduced.live:
            return effort, 0.0
        return effort, float(self.reduced.live_force(np.array([position]), np.array([speed]))[0])

    def rates(self, time: float, row: Row) -> tuple[float, float, float, float]:
        """Derivative of what is integrated."""
        position = float(row[0])
        if not math.isfinite(position):
            return math.nan, math.nan, math.nan, math.nan
        inertia, weight, steady = self.terms(position)
        if not inertia > 0:
            return math.nan, math.nan, math.nan, math.nan
        root = math.sqrt(inertia)
        speed = float(row[1]) / root
        effort, live = self.efforts(time, position, speed)
        load = steady + live
        return speed, (weight + load + effort) / root, effort * speed, load * speed

    def state(self, time: float, row: Row) -> ForwardState:
        """Position and speed of a row."""
        position = float(row[0])
        return ForwardState(position, float(row[1]) / math.sqrt(self.terms(position)[0]), time)


@dataclass(frozen=True, slots=True)
class _Told:
    """What the integration found: samples (time and row), events met, the end."""

    samples: list[tuple[float, Row]]
    happened: list[EventRecord[ForwardState]]
    end: RunEnd


def _check(duration: float, every: float | None, rtol: float) -> None:
    if not (np.isfinite(duration) and duration > 0):
        raise MechanismError(f"duration of a run is {duration:g} s", allowed="finite and above 0")
    if every is not None and not (np.isfinite(every) and every > 0):
        raise MechanismError(f"samples of a run every {every:g} s", allowed="finite and above 0")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")


def _first(course: _Course, start: ForwardState) -> tuple[Row, Row]:
    """The first row, and what an error is small against: 1 rad, and the energy at the start or that of a rad's work."""
    if not (math.isfinite(start.position) and math.isfinite(start.speed) and math.isfinite(start.time)):
        raise MechanismError(f"the start of the run is {start}", allowed="finite values")
    solve(course.reduced.plan, start.position).require()
    inertia, weight, steady = course.terms(start.position)
    effort, live = course.efforts(start.time, start.position, start.speed)
    if not math.isfinite(effort + live):
        raise MechanismError(
            f"the drive or a load gives {effort + live} at the start", allowed="finite efforts", do="mend its function"
        )
    if not inertia > 0:
        raise MechanismError("no mass moves with the input at the start", do="give a flywheel or another start")
    momentum = math.sqrt(inertia) * start.speed
    energy = max(0.5 * momentum**2, abs(weight) + abs(steady) + abs(effort) + abs(live)) or inertia
    return np.array([start.position, momentum, 0.0, 0.0]), np.array([1.0, math.sqrt(2 * energy), energy, energy])


def _advance(
    solver: "scipy.integrate.DOP853", course: _Course, events: tuple[RunEvent, ...], every: float | None
) -> _Told:
    """Step to the end; the samples wanted, the last of them the end, and what happened."""
    samples: list[tuple[float, Row]] = [(float(solver.t), np.array(solver.y))]
    happened: list[EventRecord[ForwardState]] = []
    before = _values(events, course.state(solver.t, solver.y))
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        while solver.status == "running":
            solver.step()
            if solver.status == "failed" or _arrested(solver, course):
                return _Told([*samples, (float(solver.t), np.array(solver.y))], happened, _failure(solver, course))
            now = _values(events, course.state(solver.t, solver.y)) if events else []
            happened += _met(solver, course, events, before, now)
            hit = happened[-1] if happened and happened[-1].terminal else None
            until = float(solver.t) if hit is None else hit.time
            if every is None:
                samples.append((until, solver.dense_output()(until) if hit else np.array(solver.y)))
            else:
                samples += _between(solver, every, samples[0][0], until, last=bool(hit) or solver.status == "finished")
            if hit is not None:
                return _Told(samples, happened, RunEnd(EndKind.EVENT, hit.state, hit.name))
            before = now
    return _Told(samples, happened, RunEnd(EndKind.TIME, course.state(*samples[-1]), "its time was over"))


def _between(
    solver: "scipy.integrate.DOP853", every: float, start: float, until: float, *, last: bool
) -> list[tuple[float, Row]]:
    """Samples every so often in the last step up to `until`; that instant too if it is the run's last."""
    first = int(np.floor((solver.t_old - start) / every + 1e-9)) + 1
    final = int(np.floor((until - start) / every + 1e-9))
    at = [min(start + every * k, until) for k in range(first, final + 1)]
    if last and not (at and at[-1] > until - 1e-9 * every):
        at.append(until)
    if not at:
        return []
    dense = solver.dense_output()
    return [(time, dense(time)) for time in at]


def _met(
    solver: "scipy.integrate.DOP853",
    course: _Course,
    events: tuple[RunEvent, ...],
    before: list[float],
    now: list[float],
) -> list[EventRecord[ForwardState]]:
    """What happened in the last step, in its order, up to the first terminal event."""
    met: list[EventRecord[ForwardState]] = []
    for event, old, new in zip(events, before, now, strict=True):
        if event.crossed(old, new):
            dense = solver.dense_output()

            def at(time: float, dense: Callable[[float], Row] = dense) -> ForwardState:
                return course.state(time, dense(time))

            time = located(lambda time, event=event, at=at: event.look(at(time)), solver.t_old, solver.t)  # type: ignore[misc]
            met.append(EventRecord(event.name, time, at(time), event.terminal))
    return until_terminal(met)


def _values(events: tuple[RunEvent, ...], state: ForwardState) -> list[float]:
    return [event.look(state) for event in events]


ARREST = 1e-9
"""Where a step moves the input by less [rad, m], it is asked whether a limit stands right ahead."""

PROBES = np.concatenate(([0.0], np.logspace(-15, -3, 25)))
"""How far beyond the last state the reason of a failure is looked for [rad, m]."""


def _arrested(solver: "scipy.integrate.DOP853", course: _Course) -> bool:
    """Whether the input has come to the end of its range: there q' falls to 0 with p undiminished, and q creeps."""
    if course.table is not None or abs(float(solver.y[0]) - float(solver.y_old[0])) > ARREST:
        return False
    near = float(solver.y[0]) + np.sign(solver.y[1]) * PROBES[PROBES <= ARREST]
    return bool(solve(course.reduced.plan, near, 1.0).status.any())


def _failure(solver: "scipy.integrate.DOP853", course: _Course) -> RunEnd:
    """Why no further step could be made: what the engine says of the poses just ahead."""
    last = course.state(float(solver.t), solver.y)
    plan = course.reduced.plan
    ahead = last.position + np.sign(solver.y[1] or 1.0) * PROBES
    status = solve(plan, ahead, 1.0).status
    bad = np.flatnonzero(status != Status.OK)
    if len(bad) == 0:
        return RunEnd(EndKind.STEP, last, "the drive or a load is not finite, or too rough for this error")
    words = ""
    try:
        solve(plan, float(ahead[bad[-1]]), 1.0).require()
    except MechanismError as fault:
        words = fault.given
    # A pose that can be passed is a dead centre; one that ends the input's range is where links cannot close further.
    beyond = status[-1] if status[-1] != Status.OK else Status.DEAD_CENTRE
    return RunEnd(EndKind[Status(beyond).name], last, words)


def _run(course: _Course, told: _Told) -> ForwardRun:
    """The samples as arrays, with accelerations, efforts and energies from the engine."""
    time = np.array([sample[0] for sample in told.samples])
    position, momentum, drive_work, load_work = np.stack([sample[1] for sample in told.samples], axis=1)
    found = course.reduced.terms(position)
    speed = momentum / np.sqrt(found.inertia)
    efforts = [course.efforts(*state) for state in zip(time, position, speed, strict=True)]
    effort, live = np.array(efforts).T
    acceleration = (found.weight + found.push + live + effort - 0.5 * found.slope * speed**2) / found.inertia
    kinetic, potential = energies(course.reduced, position, speed)
    return ForwardRun(
        course.reduced,
        time,
        position,
        speed,
        acceleration,
        effort,
        kinetic,
        potential,
        drive_work,
        load_work,
        told.end,
        tuple(told.happened),
        course.table.error if course.table else None,
    )
