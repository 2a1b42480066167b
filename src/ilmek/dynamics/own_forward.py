"""Forward run of an own machine: its motion from a state under its drive and loads, and the joint forces of it.

The drive is a `MotorDrive`; the friction of joints is part of the run.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.dynamics.forward import RunEvent, forward
from ilmek.dynamics.forward_run import EndKind, ForwardRun, ForwardState
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.inverse_run import InverseRun, all_loads, greatest, inverse_run
from ilmek.dynamics.own_machine import ForwardTask, OwnMachine, StopEvent
from ilmek.dynamics.reduced import reduce
from ilmek.dynamics.reversals import RESTING
from ilmek.errors import MechanismError
from ilmek.linkage.model import Rotation
from ilmek.linkage.structure import Plan
from ilmek.records import computed, record
from ilmek.report import Check, at_least

SAMPLES = 600
"""Samples of a run that are reported."""

RTOL, MOST_STEPS = 1e-8, 20_000
"""Relative error of a step of the integrator, and its most steps."""


@record
class OwnForward:
    """A forward run and the forces over it, as far as it came.

    wheel     inertia of rotor and flywheel on the input [kg m²; kg]
    duration  of the task [s]
    """

    run: ForwardRun
    inverse: InverseRun
    wheel: float
    duration: float

    @property
    def forces(self) -> Forces:
        """Joint forces over the run."""
        return self.inverse.forces

    @property
    def effort_error(self) -> float:
        """Greatest difference between the drive's effort and the effort for the accelerations, relative [1].

        Relative to the greatest of that effort and of the effort J q'' of the inertia: a machine may coast. A sample at
        rest is left out: the direction of friction is not determined there.
        """
        required = self.forces.effort(str(self.inverse.driving)) + self.wheel * self.run.acceleration
        inertia = self.run.reduced.terms(self.run.position).inertia
        size = np.fmax(greatest(required), greatest(inertia * self.run.acceleration))
        moving = np.abs(self.run.speed) > RESTING * greatest(self.run.speed)
        return greatest(np.where(moving, required - self.run.effort, 0.0)) / float(size) if size > 0 else 0.0

    @property
    def checks(self) -> tuple[Check, ...]:
        """Of a run that ended early: that it did not reach its duration."""
        end = self.run.end
        if not end.kind.early:
            return ()
        soft = "make the drive softer (less torque, more slip), or the run shorter"
        cure = soft if end.kind in (EndKind.STEPS, EndKind.STEP) else "change the links, or end the run at an event"
        return (at_least("forward run: time reached", end.state.time, self.duration, "s", end.reason).with_cure(cure),)

    forward_end = computed("", "why the forward run ended", lambda it: it.run.end.reason)
    forward_time = computed("s", "time at its end", lambda it: float(it.run.end.state.time))
    forward_turns = computed("1", "turns of the input in it", lambda it: it.turned(2 * math.pi, True), optional=True)
    forward_travel = computed("mm", "travel of the input in it", lambda it: it.turned(1.0, False), optional=True)
    forward_energy_residual = computed(
        "1", "greatest energy residual of the forward run, relative", lambda it: it.run.energy_error, shown=False
    )

    @property
    def turning(self) -> bool:
        """Whether the input turns."""
        return isinstance(self.forces.mechanism.inputs[0], Rotation)

    def turned(self, unit: float, turning: bool) -> float | None:
        """Travel of an input of that kind over a unit [rad; m]; None for the other kind."""
        return float(np.ptp(self.run.position)) / unit if self.turning is turning else None

    @computed("", "events of the forward run: name, time [s], position and speed of the input [SI]", shown=False)
    def forward_events(self) -> list[dict[str, str | float]]:
        names = ("name", "time", "position", "speed")
        return [
            dict(zip(names, (one.name, one.time, float(one.state.position), float(one.state.speed)), strict=True))
            for one in self.run.events
        ]

    @computed("N", "greatest force of each pin in the forward run", shown=False)
    def forward_pin_forces_max(self) -> dict[str, float]:
        return self.inverse.pin_forces_max


def own_forward(machine: OwnMachine, plan: Plan, task: ForwardTask) -> OwnForward:
    """The forward run of a machine with one input, and its joint forces.

    Raises MechanismError as `reduce` and `forward`: for several inputs, no moving mass, and a start at which the
    mechanism does not close.
    """
    wheel = task.drive.inertia if task.drive is not None else 0.0
    reduced = reduce(plan, machine.inertias, all_loads(machine), flywheel=wheel, frictions=machine.frictions)
    start = ForwardState(task.position, task.speed)
    run = forward(
        reduced,
        start,
        task.duration,
        drive=task.drive,
        events=[_event(event) for event in task.events],
        stops=task.stops,
        ratchet=task.ratchet,
        every=task.duration / SAMPLES,
        rtol=RTOL,
        most_steps=MOST_STEPS,
    )
    forces = inverse_run(replace(machine, actuators=()), run.motion(), plan.mechanism.inputs[0].name, run.time)
    return OwnForward(run, forces, wheel, task.duration)


def _event(stop: StopEvent) -> RunEvent:
    """An event at a position, speed or time. Raises MechanismError for another quantity."""
    if stop.of not in ("position", "speed", "time"):
        raise MechanismError(f"event {stop.name!r} is of {stop.of!r}", allowed="position, speed or time")

    def value(state: ForwardState) -> float:
        return float(getattr(state, stop.of)) - stop.value

    return RunEvent(stop.name, value, stop.direction, stop.terminal)
