"""General planar systems: bodies, pins, slides and pins with clearance, any number of freedoms, singular poses too.

    system = System(bodies, joints, inertias, poses, loads...)        run = simulate(system, times)

Bodies and joints are those of `linkage.model`, here without inputs and branches: the poses say how the system stands
and moves at the start. See `multibody.kernel` for the equations, `multibody.steps` for the integration, `clearance`
for pins with clearance.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from scipy.integrate import DOP853

from ilmek.arrays import FloatArray
from ilmek.dynamics.events import Event, EventRecord, located, until_terminal
from ilmek.dynamics.multibody.kernel import Model, joints
from ilmek.dynamics.multibody.model import (
    BodyForce,
    BodyState,
    BodyTorque,
    System,
    from_motion,
    loosened,
    modelled,
    start_of,
)
from ilmek.dynamics.multibody.run import MultibodyHistory, SystemRun
from ilmek.dynamics.multibody.steps import (
    DONE,
    DONE_TO,
    NEXT,
    PEAKS,
    STAGES,
    STEPPED,
    TAKEN,
    TIME,
    TOO_MANY,
    advance,
    begin,
    leap,
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
    "loosened",
    "simulate",
]  # fmt: skip

SystemEvent: TypeAlias = Event[MultibodyHistory]
"""An event of a system's run: its value is a function of the system at an instant (see `MultibodyHistory`)."""

METHOD = (np.vstack((DOP853.A[:STAGES, :STAGES], DOP853.B)), np.array(DOP853.E3), np.array(DOP853.E5))
"""Coefficients of the integrator: stages and, last, the step; its errors of third and of fifth order."""

OPEN = 1e-6
"""A start whose joints gape, or part in a second, by more than this of the size of the system is refused."""


def simulate(
    system: System, times: FloatArray, *, events: Sequence[SystemEvent] = (), rtol: float = 1e-9, steps: int = 1_000_000
) -> SystemRun:
    """The system's motion at ascending times [s], the first of them the start's.

    events  looked for at each step of the integrator; a terminal one ends the run and is its last sample
    rtol    error of a step against the length of the system, a radian, the fastest body, the energy

    Raises MechanismError where a joint gapes at the start or the velocities there part it, and where no step small
    enough is found or `steps` are not enough, with the time that was reached.
    """
    if np.ndim(times) != 1 or len(times) < 2 or not np.all(np.isfinite(times)) or np.any(np.diff(times) <= 0):
        raise MechanismError(f"{np.size(times)} times of a run", allowed="two or more, finite and ascending")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")
    model, row = modelled(system), start_of(system)
    _check_start(system, model, row)
    return _Simulation(system, model, np.array(times, dtype=float), rtol, steps, row).run(tuple(events))


class _Simulation:
    """A run on its way: the arrays that the kernels fill."""

    def __init__(  # noqa: PLR0917
        self, system: System, model: Model, times: FloatArray, rtol: float, steps: int, row: FloatArray
    ) -> None:
        self.system, self.model, self.times, self.rtol, self.steps, self.y = system, model, times, rtol, steps, row
        forces = len(model.touched) + 2 * len(model.contacts)
        self.slope, self.force = np.empty(len(row)), np.empty(forces)
        count, width = len(times), len(row)
        self.kept = np.empty((count, width)), np.empty((count, width)), np.empty((count, forces))
        self.clock = np.zeros(PEAKS + len(model.contacts))
        self.clock[TIME], self.clock[NEXT] = times[0], 1e-4 * (times[-1] - times[0])

    def run(self, events: tuple[SystemEvent, ...]) -> SystemRun:
        """From the start to the last time or the first terminal event."""
        begin(self.model, self.y, self.slope, self.force, self.kept)
        met: list[EventRecord[MultibodyHistory]] = []
        before = [event.look(self._now()) for event in events]
        while int(self.clock[DONE_TO]) < len(self.times) - 1:
            start = float(self.clock[TIME]), self.y.copy(), self.slope.copy()
            self._advance(single=bool(events))
            after = [event.look(self._now()) for event in events]
            met += self._met(events, before, after, start)
            if met and met[-1].terminal:
                return self._told(met)
            before = after
        return self._told(met)

    def _advance(self, *, single: bool) -> None:
        ending = advance(self.model, self.clock, self.y, self.slope, self.force, self.times, self.rtol, self.steps,
                         single, METHOD, self.kept)  # fmt: skip
        if ending not in {DONE, STEPPED}:
            many = ending == TOO_MANY
            raise MechanismError(
                f"{self.system.name} came to {self.clock[TIME]:.9g} s of {self.times[-1]:g} s",
                allowed=f"{self.steps} steps" if many else "its motion is too rough there for any step",
                do="allow more steps or more error" if many else "look at its pose there",
            )

    def _now(self) -> MultibodyHistory:
        return MultibodyHistory(self.system, self.model, float(self.clock[TIME]), self.y, self.slope, self.force)

    def _met(
        self,
        events: tuple[SystemEvent, ...],
        before: list[float],
        after: list[float],
        start: tuple[float, FloatArray, FloatArray],
    ) -> list[EventRecord[MultibodyHistory]]:
        """What happened in the last step, in its order, up to the first terminal event."""
        time, y, slope = start
        length = float(self.clock[TIME]) - time

        def at(part: float) -> MultibodyHistory:
            new, end, force = np.empty_like(y), np.empty_like(slope), np.empty_like(self.force)
            leap(self.model, y, slope, part, METHOD, new, end, force)
            return MultibodyHistory(self.system, self.model, time + part, new, end, force)

        found = []
        for event, old, new in zip(events, before, after, strict=True):
            if event.crossed(old, new):
                part = located(lambda part, event=event: event.look(at(part)), 0.0, length)  # type: ignore[misc]
                found.append(EventRecord(event.name, time + part, at(part), event.terminal))
        return until_terminal(found)

    def _told(self, met: list[EventRecord[MultibodyHistory]]) -> SystemRun:
        """The samples up to the end."""
        last, times = int(self.clock[DONE_TO]) + 1, self.times
        if met and met[-1].terminal:
            end = met[-1]
            last = int(np.searchsorted(times, end.time)) + 1
            times = np.append(times[: last - 1], end.time)
            for kept, row in zip(self.kept, (end.state.states, end.state.slopes, end.state.reactions), strict=True):
                kept[last - 1] = row
        states, slopes, reactions = (kept[:last] for kept in self.kept)
        peaks = {pin.name: float(peak) for pin, peak in zip(self.system.clearances, self.clock[PEAKS:], strict=True)}
        return SystemRun(self.system, self.model, times[:last], states, slopes, reactions, int(self.clock[TAKEN]),
                         tuple(met), peaks)  # fmt: skip


def _check_start(system: System, model: Model, row: FloatArray) -> None:
    """Refuse a start whose joints gape or part; small differences are closed by the projection."""
    count, size = len(model.touched), len(model.weights)
    gap, bias, rows = np.zeros(count), np.zeros(count), np.zeros((count, 6))
    joints(model, row[:size], row[size : 2 * size], gap, rows, bias)
    speeds = np.concatenate((row[size : 2 * size], np.zeros(3)))
    columns = (3 * model.touched[:, [0, 0, 0, 1, 1, 1]] + np.tile(np.arange(3), 2)) % (size + 3)
    parting = np.sum(rows * speeds[columns], axis=1)
    fastest = float(np.max(np.abs(row[size : 2 * size]), initial=0.0)) * max(model.length, 1.0)
    for k, joint in enumerate(system.rigid):
        opened, parted = (float(np.hypot(*found[2 * k : 2 * k + 2])) for found in (gap, parting))
        if opened > OPEN * model.length:
            raise MechanismError(
                f"joint {joint.name!r} of {system.name} gapes by {opened:.3g} m at the start", do="give a closed pose"
            )
        if parted > OPEN * fastest:
            raise MechanismError(
                f"joint {joint.name!r} of {system.name} parts at {parted:.3g} m/s at the start",
                do="give velocities that keep it together",
            )
