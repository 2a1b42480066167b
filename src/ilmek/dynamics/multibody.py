"""General planar systems: bodies, pins and slides, any number of freedoms, through singular poses and redundant joints.

    system = System(bodies, joints, inertias, poses, loads...)        run = simulate(system, times)

Bodies and joints are those of `linkage.model`, here without inputs and branches: the poses say how the system stands
and moves at the start. See `multibody_kernel` for the equations and `multibody_steps` for the integration.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from jaxtyping import Complex, Float
from scipy.integrate import DOP853

from ilmek.arrays import FloatArray
from ilmek.dynamics.multibody_kernel import Model, joints
from ilmek.dynamics.multibody_model import Pose, Push, Spring, System, Twist, from_motion, modelled, start_of
from ilmek.dynamics.multibody_steps import DONE, STAGES, TOO_MANY, advance, project
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Pin, Slide

__all__ = ["Pose", "Push", "Spring", "System", "SystemRun", "Twist", "from_motion", "simulate"]

Reals: TypeAlias = Float[np.ndarray, " samples"]
Points: TypeAlias = Complex[np.ndarray, " samples"]
METHOD = (np.vstack((DOP853.A[:STAGES, :STAGES], DOP853.B)), np.array(DOP853.E3), np.array(DOP853.E5))
"""Coefficients of the integrator: stages and, last, the step; its errors of third and of fifth order."""

OPEN = 1e-6
"""A start whose joints gape, or part in a second, by more than this of the size of the system is refused."""


@dataclass(frozen=True, slots=True)
class SystemRun:
    """A run of a general system, sample by sample.

    states     x, y [m], theta [rad] of the mass centres in the order of `system.order`; their rates; the work [J]
    slopes     time derivatives of the states      reactions  two forces a pin, a force and a moment a slide (see `pin`)
    steps      the integrator's, those refused among them
    """

    system: System
    model: Model
    time: Reals
    states: FloatArray
    slopes: FloatArray
    reactions: FloatArray
    steps: int

    def angle(self, body: str) -> Reals:
        """Angle of a body [rad], counted through all turns."""
        return self._column(body, self.states, 2)

    def omega(self, body: str) -> Reals:
        """Angular velocity of a body [rad/s]."""
        return self._column(body, self.slopes, 2)

    def alpha(self, body: str) -> Reals:
        """Angular acceleration of a body [rad/s²]."""
        return self._column(body, self.slopes, 2, second=True)

    def position(self, body: str, point: str) -> Points:
        """Place of a body's point [m]."""
        centre: Points = self._column(body, self.states, 0) + 1j * self._column(body, self.states, 1)
        placed: Points = centre + self.system.arm(body, point) * np.exp(1j * self.angle(body))
        return placed

    def velocity(self, body: str, point: str) -> Points:
        """Velocity of a body's point [m/s]."""
        centre: Points = self._column(body, self.slopes, 0) + 1j * self._column(body, self.slopes, 1)
        arm = self.system.arm(body, point) * np.exp(1j * self.angle(body))
        moved: Points = centre + 1j * self.omega(body) * arm
        return moved

    def pin(self, name: str) -> Points:
        """Force [N] of a pin on its second body; of least norm where joints are redundant."""
        pins = [joint.name for joint in self.system.joints if isinstance(joint, Pin)]
        if name not in pins:
            raise MechanismError(f"{self.system.name} has no pin {name!r}", allowed=f"it has {', '.join(pins)}")
        row = 2 * pins.index(name)
        force: Points = self.reactions[:, row] + 1j * self.reactions[:, row + 1]
        return force

    @property
    def energy(self) -> Reals:
        """Kinetic energy and potential of weights and springs [J]."""
        count = len(self.model.weights)
        energy: Reals = 0.5 * (self.slopes[:, :count] ** 2) @ self.model.weights
        for k, mass in enumerate(self.model.weights[::3]):
            place = self.states[:, 3 * k] + 1j * self.states[:, 3 * k + 1]
            energy = energy - mass * np.real(np.conj(self.model.gravity) * place)
        for load in self.system.loads:
            if isinstance(load, Spring):
                apart = self._end(load.first, load.first_point) - self._end(load.second, load.second_point)
                energy = energy + 0.5 * load.stiffness * (np.abs(apart) - load.length) ** 2
        return energy

    @property
    def energy_residual(self) -> Reals:
        """Energy gained less the work of pushes, twists and dampers since the start [J]: zero but for errors."""
        energy = self.energy
        residual: Reals = energy - energy[0] - (self.states[:, -1] - self.states[0, -1])
        return residual

    @property
    def gap(self) -> float:
        """Greatest opening of a joint over the samples [m]."""
        count, size = len(self.model.touched), len(self.model.weights)
        gap, bias, rows = np.zeros(count), np.zeros(count), np.zeros((count, 6))
        most = 0.0
        for state in self.states:
            joints(self.model, state[:size], state[size : 2 * size], gap, rows, bias)
            most = max(most, float(np.max(np.abs(gap), initial=0.0)))
        return most

    def _end(self, body: str, point: str) -> Points | complex:
        return self.system.arm(GROUND, point) if body == GROUND else self.position(body, point)

    def _column(self, body: str, rows: FloatArray, axis: int, *, second: bool = False) -> Reals:
        if body not in self.system.order:
            raise MechanismError(f"{self.system.name} has no moving body {body!r}", do=", ".join(self.system.order))
        half = len(self.model.weights) if second else 0
        column: Reals = rows[:, half + 3 * self.system.order.index(body) + axis]
        return column


def simulate(system: System, times: FloatArray, *, rtol: float = 1e-9, steps: int = 200_000) -> SystemRun:
    """The system's motion at ascending times [s], the first of them the start's.

    rtol  error of a step against the length of the system, a radian, the fastest body, the energy

    Raises MechanismError where a joint gapes at the start or the velocities there part it, and where no step small
    enough is found or `steps` are not enough, with the time that was reached.
    """
    if len(times) < 2 or not np.all(np.isfinite(times)) or np.any(np.diff(times) <= 0):
        raise MechanismError(f"{len(times)} times of a run", allowed="two or more, finite and ascending")
    if not 3e-14 <= rtol <= 1e-2:
        raise MechanismError(f"relative error of a run is {rtol:g}", allowed="3e-14 to 1e-2")
    model, row = modelled(system), start_of(system)
    _check_start(system, model, row)
    project(model, row)
    states, slopes = np.empty((len(times), len(row))), np.empty((len(times), len(row)))
    reactions = np.empty((len(times), len(model.touched)))
    instants = np.array(times, dtype=float)
    ending, _, taken, reached = advance(model, row, instants, rtol, steps, METHOD, states, slopes, reactions)
    if ending != DONE:
        raise MechanismError(
            f"{system.name} came to {reached:.9g} s of {instants[-1]:g} s",
            allowed=f"{steps} steps" if ending == TOO_MANY else "its motion is too rough there for any step",
            do="allow more steps or more error" if ending == TOO_MANY else "look at its pose there",
        )
    return SystemRun(system, model, instants, states, slopes, reactions, taken)


def _check_start(system: System, model: Model, row: FloatArray) -> None:
    """Refuse a start whose joints gape or part; small differences are closed by the projection."""
    count, size = len(model.touched), len(model.weights)
    gap, bias, rows = np.zeros(count), np.zeros(count), np.zeros((count, 6))
    joints(model, row[:size], row[size : 2 * size], gap, rows, bias)
    ordered = sorted(system.joints, key=lambda joint: isinstance(joint, Slide))
    speeds = np.concatenate((row[size : 2 * size], np.zeros(3)))
    columns = (3 * model.touched[:, [0, 0, 0, 1, 1, 1]] + np.tile(np.arange(3), 2)) % (size + 3)
    parting = np.sum(rows * speeds[columns], axis=1)
    fastest = float(np.max(np.abs(row[size : 2 * size]), initial=0.0)) * max(model.length, 1.0)
    for k, joint in enumerate(ordered):
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
