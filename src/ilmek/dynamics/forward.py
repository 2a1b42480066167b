"""Forward dynamics of a machine with one degree of freedom: its motion under drive and loads.

    J q'' + J' q'^2 / 2 = Q + M,   written as   q' = p / √J,   p' = (Q + M) / √J       [see `reduced`; M drive effort]

With p = √J q' the kinetic energy is p^2 / 2, J' is not needed, and p stays finite where J does not: at a dead centre.

Start-up, running, coasting and stopping are consecutive runs; each starts at the end of the previous one. A run ends at
its duration, at a terminal event, at a dead centre, where the mechanism cannot close, or after its most steps. What it
reached is kept, and its end is reported with time, state and reason. The integrator is the Dormand-Prince method of
order 8 with error control [Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.10]. The
work of drive and loads is integrated as well, for the energy balance.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy

from ilmek.arrays import Float
from ilmek.dynamics.events import Event, EventRecord, crossing_time, until_terminal
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

MOST_STEPS = 200_000
"""Steps of the integrator in a run: about a minute. A drive that is much too strong for the masses needs more."""

Row: TypeAlias = Float[np.ndarray, " 4"]
"""Integrated quantities: position, p, work of the drive, work of the loads except gravity."""


RunEvent: TypeAlias = Event[ForwardState]
"""An event of a run; its value is a function of the state of the input."""


def at_speed(speed: float) -> RunEvent:
    """Terminal event: the input reaches a speed [rad/s; m/s]."""
    return RunEvent(f"speed {speed:g} reached", lambda state: state.speed - speed)


def at_angle(position: float) -> RunEvent:
    """Terminal event: the input reaches a position [rad; m], counted through all turns."""
    return RunEvent(f"position {position:g} reached", lambda state: state.position - position)


def at_rest() -> RunEvent:
    """Terminal event: the input comes to rest; a start from rest does not count."""
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
    most_steps: int = MOST_STEPS,
) -> ForwardRun:
    """A run of the machine from a given state.

    reduced   the mechanism with masses and loads; see `reduce`
    start     state at the start
    duration  [s]
    drive     effort on the input [N m; N] as a function of time, position and speed, for example a motor's torque-speed
              curve; default: no drive, the machine coasts
    events    checked at each step of the integrator; a terminal event ends the run; default: none
    every     time between the reported samples [s]; default: the steps of the integrator
    rtol      relative error of a step in angle (relative to 1 rad), speed and work, 3e-14 to 1e-2
    most_steps  of the integrator

    A machine whose input rotates fully is run on its Fourier table (see `fourier_terms`), any other on the mechanism's
    equations. A run that ends early, also after its most steps, keeps what it reached: see `ForwardRun.end`. Raises
    MechanismError for a start at which the mechanism does not close, a state, duration or effort that is not finite,
    and a tolerance outside its range.
    """
    _check(duration, every, rtol)
    equation = _Equation(reduced, tabulate(reduced), drive)
    first, scale = _first_row(equation, start)
    solver = scipy.integrate.DOP853(
        equation.rates, start.time, first, start.time + duration, rtol=rtol, atol=rtol * scale
    )
    return _forward_run(equation, _advance(solver, equation, tuple(events), every, most_steps))


@dataclass(frozen=True, slots=True)
class _Equation:
    """Right-hand side of the differential equation."""

    reduced: ReducedMechanism
    table: FourierTerms | None
    drive: Drive | None

    def terms(self, position: float) -> tuple[float, float, float]:
        """J, Q of gravity and Q of the other steady loads; NaN where the mechanism does not close."""
        if self.table is not None:
            return self.table(position)
        found = self.reduced.terms(np.array([position]))
        if found.status[0] != Status.OK:
            return math.nan, math.nan, math.nan
        return float(found.inertia[0]), float(found.weight[0]), float(found.push[0])

    def efforts(self, time: float, position: float, speed: float) -> tuple[float, float]:
        """Efforts of the drive and of the live loads [N m; N]."""
        effort = float(self.drive(time, position, speed)) if self.drive is not None else 0.0
        if not self.reduced.live:
            return effort, 0.0
        return effort, float(self.reduced.live_force(*np.array([[position], [speed], [time]]))[0])

    def rates(self, time: float, row: Row) -> tuple[float, float, float, float]:
        """Time derivative of a row; NaN where the mechanism does not close."""
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
class _Integration:
    """Samples (time and row), events that occurred, and the end."""

    samples: list[tuple[float, Row]]
    happened: list[EventRecord[ForwardState]]
    end: RunEnd


def _check(duration: float, every: float | None, rtol: float) -> None:
    if not (np.isfinite(duration) and duration > 0):
        raise MechanismError(f"duration of a run is {duration:g} s", allowed="finite and above 0")
    if every is not None and not (np.isfinite(every) and every > 0):
        raise MechanismError(f"time between samples of a run is {every:g} s", allowed="finite and above 0")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")


def _first_row(equation: _Equation, start: ForwardState) -> tuple[Row, Row]:
    """The first row, and the scale of the errors: 1 rad, and the energy at the start or the work over 1 rad."""
    if not (math.isfinite(start.position) and math.isfinite(start.speed) and math.isfinite(start.time)):
        raise MechanismError(f"the start of the run is {start}", allowed="finite values")
    solve(equation.reduced.plan, start.position).require()
    inertia, weight, steady = equation.terms(start.position)
    effort, live = equation.efforts(start.time, start.position, start.speed)
    if not math.isfinite(effort + live):
        raise MechanismError(
            f"effort of the drive or a load is {effort + live} at the start",
            allowed="finite efforts",
            do="correct its function",
        )
    if not inertia > 0:
        raise MechanismError("no mass moves with the input at the start", do="give a flywheel or another start")
    momentum = math.sqrt(inertia) * start.speed
    energy = max(0.5 * momentum**2, abs(weight) + abs(steady) + abs(effort) + abs(live)) or inertia
    return np.array([start.position, momentum, 0.0, 0.0]), np.array([1.0, math.sqrt(2 * energy), energy, energy])


def _advance(
    solver: "scipy.integrate.DOP853",
    equation: _Equation,
    events: tuple[RunEvent, ...],
    every: float | None,
    most_steps: int,
) -> _Integration:
    """Integrate to the end of the run; the last sample is the end."""
    samples: list[tuple[float, Row]] = [(float(solver.t), np.array(solver.y))]
    happened: list[EventRecord[ForwardState]] = []
    before = _values(events, equation.state(solver.t, solver.y))
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        for _ in range(most_steps):
            if solver.status != "running":
                break
            solver.step()
            if solver.status == "failed" or _stopped_at_limit(solver, equation):
                if samples[-1][0] < solver.t:
                    samples.append((float(solver.t), np.array(solver.y)))
                return _Integration(samples, happened, _failure(solver, equation))
            now = _values(events, equation.state(solver.t, solver.y)) if events else []
            happened += _events_in_step(solver, equation, events, before, now)
            hit = happened[-1] if happened and happened[-1].terminal else None
            until = float(solver.t) if hit is None else hit.time
            if every is None:
                samples.append((until, solver.dense_output()(until) if hit else np.array(solver.y)))
            else:
                last = bool(hit) or solver.status == "finished"
                samples += _samples_in_step(solver, every, samples[0][0], until, last=last)
            if hit is not None:
                return _Integration(samples, happened, RunEnd(EndKind.EVENT, hit.state, hit.name))
            before = now
    if solver.status == "running":
        if samples[-1][0] < solver.t:
            samples.append((float(solver.t), np.array(solver.y)))
        reason = f"{most_steps} steps of the integrator reached {solver.t:.4g} s of {solver.t_bound:.4g} s"
        return _Integration(samples, happened, RunEnd(EndKind.STEPS, equation.state(*samples[-1]), reason))
    return _Integration(
        samples, happened, RunEnd(EndKind.TIME, equation.state(*samples[-1]), "its duration was reached")
    )


def _samples_in_step(
    solver: "scipy.integrate.DOP853", every: float, start: float, until: float, *, last: bool
) -> list[tuple[float, Row]]:
    """Samples at multiples of `every` in the last step up to `until`, and at `until` if the run ends there."""
    first = int(np.floor((solver.t_old - start) / every + 1e-9)) + 1
    final = int(np.floor((until - start) / every + 1e-9))
    at = [min(start + every * k, until) for k in range(first, final + 1)]
    if last and not (at and at[-1] > until - 1e-9 * every):
        at.append(until)
    if not at:
        return []
    return list(zip(at, solver.dense_output()(np.array(at)).T, strict=True))


def _events_in_step(
    solver: "scipy.integrate.DOP853",
    equation: _Equation,
    events: tuple[RunEvent, ...],
    before: list[float],
    now: list[float],
) -> list[EventRecord[ForwardState]]:
    """Events in the last step in their order, up to the first terminal event."""
    met: list[EventRecord[ForwardState]] = []
    for event, old, new in zip(events, before, now, strict=True):
        if event.crossed(old, new):
            dense = solver.dense_output()

            def at(time: float, dense: Callable[[float], Row] = dense) -> ForwardState:
                return equation.state(time, dense(time))

            time = crossing_time(lambda time, event=event, at=at: event.evaluate(at(time)), solver.t_old, solver.t)  # type: ignore[misc]
            met.append(EventRecord(event.name, time, at(time), event.terminal))
    return until_terminal(met)


def _values(events: tuple[RunEvent, ...], state: ForwardState) -> list[float]:
    return [event.evaluate(state) for event in events]


CREEP = 1e-9
"""Motion of the input in one step [rad; m] below which the poses just ahead are checked for a limit."""

PROBES = np.concatenate(([0.0], np.logspace(-15, -3, 25)))
"""Distances ahead of the last state at which the reason of a failure is sought [rad; m]."""


def _stopped_at_limit(solver: "scipy.integrate.DOP853", equation: _Equation) -> bool:
    """Whether the input is at the end of its range: q' tends to 0 there while p does not, and q creeps."""
    if equation.table is not None or abs(float(solver.y[0]) - float(solver.y_old[0])) > CREEP:
        return False
    near = float(solver.y[0]) + np.sign(solver.y[1]) * PROBES[PROBES <= CREEP]
    return bool(solve(equation.reduced.plan, near, 1.0).status.any())


def _failure(solver: "scipy.integrate.DOP853", equation: _Equation) -> RunEnd:
    """Reason why no further step is possible, from the status of the poses just ahead."""
    last = equation.state(float(solver.t), solver.y)
    plan = equation.reduced.plan
    ahead = last.position + np.sign(solver.y[1] or 1.0) * PROBES
    status = solve(plan, ahead, 1.0).status
    bad = np.flatnonzero(status != Status.OK)
    if len(bad) == 0:
        return RunEnd(EndKind.STEP, last, "the drive or a load is not finite, or not smooth enough for this error")
    reason = ""
    try:
        solve(plan, float(ahead[bad[-1]]), 1.0).require()
    except MechanismError as fault:
        reason = fault.given
    # A pose that can be passed is a dead centre; at the end of the input's range the links cannot close beyond it.
    beyond = status[-1] if status[-1] != Status.OK else Status.DEAD_CENTRE
    return RunEnd(EndKind[Status(beyond).name], last, reason)


def _forward_run(equation: _Equation, integration: _Integration) -> ForwardRun:
    """The samples as arrays, with accelerations, efforts and energies from the mechanism's equations."""
    time = np.array([sample[0] for sample in integration.samples])
    position, momentum, drive_work, load_work = np.stack([sample[1] for sample in integration.samples], axis=1)
    found = equation.reduced.terms(position)
    speed = momentum / np.sqrt(found.inertia)
    efforts = [equation.efforts(*state) for state in zip(time, position, speed, strict=True)]
    effort, live = np.array(efforts).T
    acceleration = (found.weight + found.push + live + effort - 0.5 * found.slope * speed**2) / found.inertia
    kinetic, potential = energies(equation.reduced, position, speed)
    return ForwardRun(
        equation.reduced,
        time,
        position,
        speed,
        acceleration,
        effort,
        kinetic,
        potential,
        drive_work,
        load_work,
        integration.end,
        tuple(integration.happened),
        equation.table.error if equation.table else None,
    )
