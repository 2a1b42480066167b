"""General planar systems of bodies, pins, slides and pins with clearance, with any number of degrees of freedom.

    system = System(bodies, joints, inertias, poses, loads...)        run = simulate(system, times)

Bodies and joints are those of `linkage.model`, without inputs and branches: the poses give the initial state. Singular
poses are allowed. Equations: `multibody.kernel`; integration: `multibody.steps`; pins with clearance: `clearance`.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from scipy.integrate import DOP853

from ilmek.arrays import FloatArray
from ilmek.dynamics.events import Event, EventRecord, crossing_time, until_terminal
from ilmek.dynamics.multibody.kernel import Model, joints
from ilmek.dynamics.multibody.model import (
    BodyForce,
    BodyState,
    BodyTorque,
    System,
    from_motion,
    model_arrays,
    start_state,
    with_clearance,
)
from ilmek.dynamics.multibody.run import MultibodyHistory, SystemRun
from ilmek.dynamics.multibody.steps import (
    DONE,
    NEXT_STEP,
    PEAKS,
    REACHED,
    STAGES,
    STEPPED,
    STEPS,
    TIME,
    TOO_MANY,
    advance,
    begin,
    single_step,
)
from ilmek.dynamics.springs import Spring
from ilmek.errors import MechanismError

__all__ = [
    "BodyForce",
    "BodyState",
    "BodyTorque",
    "Event",
    "MultibodyHistory",
    "Spring",
    "System",
    "SystemEvent",
    "SystemRun",
    "from_motion",
    "simulate",
    "with_clearance",
]  # fmt: skip

SystemEvent: TypeAlias = Event[MultibodyHistory]
"""An event of a run; its value is a function of the system at an instant (see `MultibodyHistory`)."""

METHOD = (np.vstack((DOP853.A[:STAGES, :STAGES], DOP853.B)), np.array(DOP853.E3), np.array(DOP853.E5))
"""Coefficients of the integrator: its stages and, in the last row, the step; its errors of third and of fifth order."""

MAX_GAP = 1e-6
"""Greatest gap of a joint in the initial poses, and greatest separation in 1 s, relative to the system's length."""


def simulate(
    system: System, times: FloatArray, *, events: Sequence[SystemEvent] = (), rtol: float = 1e-9, steps: int = 1_000_000
) -> SystemRun:
    """Motion of a system from its initial state.

    system  with its initial state
    times   ascending times of the samples [s], the first that of the initial state; shape (samples,)
    events  checked at each step of the integrator; a terminal event ends the run and is its last sample; default: none
    rtol    relative error of a step in length, angle (relative to 1 rad), speed and energy, 3e-14 to 1e-2
    steps   greatest number of steps

    Raises MechanismError for joints that do not close in the initial poses or separate by the initial velocities, and
    where no step is small enough or `steps` do not suffice; the message states the time reached.
    """
    if np.ndim(times) != 1 or len(times) < 2 or not np.all(np.isfinite(times)) or np.any(np.diff(times) <= 0):
        raise MechanismError(f"{np.size(times)} times of a run", allowed="two or more, finite and ascending")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")
    model, row = model_arrays(system), start_state(system)
    _check_start(system, model, row)
    return _Simulation(system, model, np.array(times, dtype=float), rtol, steps, row).run(tuple(events))


class _Simulation:
    """State of a run: the arrays that the kernels fill."""

    def __init__(  # noqa: PLR0917
        self, system: System, model: Model, times: FloatArray, rtol: float, steps: int, row: FloatArray
    ) -> None:
        self.system, self.model, self.times, self.rtol, self.steps, self.y = system, model, times, rtol, steps, row
        forces = len(model.joint_bodies) + 2 * len(model.contacts)
        self.slope, self.force = np.empty(len(row)), np.empty(forces)
        count, width = len(times), len(row)
        self.samples = np.empty((count, width)), np.empty((count, width)), np.empty((count, forces))
        self.clock = np.zeros(PEAKS + len(model.contacts))
        self.clock[TIME], self.clock[NEXT_STEP] = times[0], 1e-4 * (times[-1] - times[0])

    def run(self, events: tuple[SystemEvent, ...]) -> SystemRun:
        """Run from the initial state to the last time or the first terminal event."""
        begin(self.model, self.y, self.slope, self.force, self.samples)
        met: list[EventRecord[MultibodyHistory]] = []
        before = [event.evaluate(self._current()) for event in events]
        while int(self.clock[REACHED]) < len(self.times) - 1:
            start = float(self.clock[TIME]), self.y.copy(), self.slope.copy()
            self._advance(single=bool(events))
            after = [event.evaluate(self._current()) for event in events]
            met += self._events_in_step(events, before, after, start)
            if met and met[-1].terminal:
                return self._result(met)
            before = after
        return self._result(met)

    def _advance(self, *, single: bool) -> None:
        ending = advance(self.model, self.clock, self.y, self.slope, self.force, self.times, self.rtol, self.steps,
                         single, METHOD, self.samples)  # fmt: skip
        if ending not in {DONE, STEPPED}:
            many = ending == TOO_MANY
            raise MechanismError(
                f"{self.system.name} reached {self.clock[TIME]:.9g} s of {self.times[-1]:g} s",
                allowed=f"{self.steps} steps" if many else "no step is small enough for its motion there",
                do="allow more steps or more error" if many else "check its pose there",
            )

    def _current(self) -> MultibodyHistory:
        return MultibodyHistory(self.system, self.model, float(self.clock[TIME]), self.y, self.slope, self.force)

    def _events_in_step(
        self,
        events: tuple[SystemEvent, ...],
        before: list[float],
        after: list[float],
        start: tuple[float, FloatArray, FloatArray],
    ) -> list[EventRecord[MultibodyHistory]]:
        """Events in the last step in their order, up to the first terminal event."""
        time, y, slope = start
        length = float(self.clock[TIME]) - time

        def at(part: float) -> MultibodyHistory:
            new, end, force = np.empty_like(y), np.empty_like(slope), np.empty_like(self.force)
            single_step(self.model, y, slope, part, METHOD, new, end, force)
            return MultibodyHistory(self.system, self.model, time + part, new, end, force)

        found = []
        for event, old, new in zip(events, before, after, strict=True):
            if event.crossed(old, new):
                part = crossing_time(lambda part, event=event: event.evaluate(at(part)), 0.0, length)  # type: ignore[misc]
                found.append(EventRecord(event.name, time + part, at(part), event.terminal))
        return until_terminal(found)

    def _result(self, met: list[EventRecord[MultibodyHistory]]) -> SystemRun:
        """The run with its samples up to the end."""
        last, times = int(self.clock[REACHED]) + 1, self.times
        if met and met[-1].terminal:
            end = met[-1]
            last = int(np.searchsorted(times, end.time)) + 1
            times = np.append(times[: last - 1], end.time)
            for array, row in zip(self.samples, (end.state.states, end.state.slopes, end.state.reactions), strict=True):
                array[last - 1] = row
        states, slopes, reactions = (array[:last] for array in self.samples)
        peaks = {pin.name: float(peak) for pin, peak in zip(self.system.clearances, self.clock[PEAKS:], strict=True)}
        return SystemRun(self.system, self.model, times[:last], states, slopes, reactions, int(self.clock[STEPS]),
                         tuple(met), peaks)  # fmt: skip


def _check_start(system: System, model: Model, row: FloatArray) -> None:
    """Raise MechanismError for joints with a gap or a separation speed; the projection closes smaller ones."""
    count, size = len(model.joint_bodies), len(model.masses)
    gap, bias, rows = np.zeros(count), np.zeros(count), np.zeros((count, 6))
    joints(model, row[:size], row[size : 2 * size], gap, rows, bias)
    speeds = np.concatenate((row[size : 2 * size], np.zeros(3)))
    columns = (3 * model.joint_bodies[:, [0, 0, 0, 1, 1, 1]] + np.tile(np.arange(3), 2)) % (size + 3)
    separation = np.sum(rows * speeds[columns], axis=1)
    fastest = float(np.max(np.abs(row[size : 2 * size]), initial=0.0)) * max(model.length, 1.0)
    for k, joint in enumerate(system.rigid):
        open_by, speed = (float(np.hypot(*found[2 * k : 2 * k + 2])) for found in (gap, separation))
        if open_by > MAX_GAP * model.length:
            raise MechanismError(
                f"joint {joint.name!r} of {system.name} has a gap of {open_by:.3g} m at the start",
                do="give poses that close it",
            )
        if speed > MAX_GAP * fastest:
            raise MechanismError(
                f"joint {joint.name!r} of {system.name} separates at {speed:.3g} m/s at the start",
                do="give velocities that keep it closed",
            )
