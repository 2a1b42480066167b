"""Result of a run of a general planar system: positions, speeds, forces, energies, at an instant or by sample."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.dynamics.clearance import ClearancePin
from ilmek.dynamics.events import EventRecord
from ilmek.dynamics.multibody.kernel import Model, joints
from ilmek.dynamics.multibody.model import System
from ilmek.dynamics.springs import Spring
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Joint, Pin
from ilmek.records import record

INDETERMINATE = 1e-6
"""Share of a joint in a self-equilibrated force above which its reaction counts as indeterminate."""


@record
class MultibodyHistory:
    """A system over the samples of a run, or at one instant; results are then arrays of dimension 0.

    time       [s]
    states     x, y [m], theta [rad] of the mass centres in the order of `system.order`; their rates; the work [J];
               one number per clearance pin: -1 in flight, otherwise the greatest speed of its contact so far [m/s]
    slopes     time derivatives of the states
    reactions  two forces per pin, a force and a moment per slide, two forces per clearance pin (see `pin`)

    The methods raise MechanismError for unknown names.
    """

    system: System
    model: Model
    time: RealField
    states: FloatArray
    slopes: FloatArray
    reactions: FloatArray

    def angle(self, body: str) -> FloatArray:
        """Angle of a body [rad], counted through all turns."""
        return self._column(body, self.states, 2)

    def omega(self, body: str) -> FloatArray:
        """Angular velocity of a body [rad/s]."""
        return self._column(body, self.slopes, 2)

    def alpha(self, body: str) -> FloatArray:
        """Angular acceleration of a body [rad/s²]."""
        return self._column(body, self.slopes[..., len(self.model.masses) :], 2)

    def position(self, body: str, point: str) -> ComplexArray:
        """Position of a body's point [m], complex."""
        arm = self.system.arm(body, point)
        if body == GROUND:
            return np.asarray(arm)
        return np.asarray(self._centre(body, self.states) + arm * np.exp(1j * self.angle(body)))

    def velocity(self, body: str, point: str) -> ComplexArray:
        """Velocity of a body's point [m/s], complex."""
        arm = self.system.arm(body, point) * np.exp(1j * self.angle(body))
        return np.asarray(self._centre(body, self.slopes) + 1j * self.omega(body) * arm)

    def travel(self, slide: str) -> FloatArray:
        """Displacement of a slide's body relative to the guide's point, along the line [m]."""
        one = next((one for one in self.system.slides if one.name == slide), None)
        if one is None:
            known = ", ".join(slide.name for slide in self.system.slides) or "none"
            raise MechanismError(f"{self.system.name} has no slide {slide!r}", allowed=f"it has {known}")
        line = one.along + (np.asarray(0.0) if one.guide == GROUND else self.angle(one.guide))
        apart = self.position(one.body, slide) - self.position(one.guide, slide)
        return np.asarray(np.real(np.exp(-1j * line) * apart))

    def pin(self, name: str) -> ComplexArray:
        """Force [N] of a pin, with or without clearance, on its second body, complex.

        Where joints are redundant, the force is that of least norm. The force of a pin with clearance is the sum of the
        contact force along the line of centres and the friction across it.
        """
        pins: list[Joint | ClearancePin] = [*self.system.rigid, *self.system.clearances]
        known = [pin.name for pin in pins if isinstance(pin, Pin | ClearancePin)]
        if name not in known:
            raise MechanismError(
                f"{self.system.name} has no pin {name!r}", allowed=f"it has {', '.join(known) or 'none'}"
            )
        row = 2 * [pin.name for pin in pins].index(name)
        return np.asarray(self.reactions[..., row] + 1j * self.reactions[..., row + 1])

    def eccentricity(self, name: str) -> ComplexArray:
        """Position of a clearance pin's journal relative to its bearing's centre [m], complex, in the ground frame."""
        one = self.system.clearance(name)
        return np.asarray(self.position(one.second, name) - self.position(one.first, name))

    @property
    def energy(self) -> FloatArray:
        """Kinetic energy, potential energy of gravity and springs, elastic energy of contacts [J]."""
        count = len(self.model.masses)
        energy = 0.5 * (self.slopes[..., :count] ** 2) @ self.model.masses
        for k, mass in enumerate(self.model.masses[::3]):
            position = self.states[..., 3 * k] + 1j * self.states[..., 3 * k + 1]
            energy = energy - mass * np.real(np.conj(self.model.gravity) * position)
        for load in self.system.loads:
            if isinstance(load, Spring):
                apart = self.position(*load.ends[0]) - self.position(*load.ends[1])
                energy = energy + 0.5 * load.stiffness * (np.abs(apart) - load.length) ** 2
        for k, pin in enumerate(self.system.clearances):
            touching = self.states[..., 2 * count + 1 + k] >= 0
            deep = np.asarray(np.abs(self.eccentricity(pin.name)) - pin.clearance)
            energy = energy + touching * pin.elastic_energy(deep)
        return np.asarray(energy)

    @property
    def work(self) -> FloatArray:
        """Work since the start of forces, torques, dampers and contact losses [J]."""
        return np.asarray(self.states[..., 2 * len(self.model.masses)])

    def _centre(self, body: str, rows: FloatArray) -> ComplexArray:
        return np.asarray(self._column(body, rows, 0) + 1j * self._column(body, rows, 1))

    def _column(self, body: str, rows: FloatArray, axis: int) -> FloatArray:
        if body not in self.system.order:
            known = ", ".join(self.system.order)
            raise MechanismError(f"{self.system.name} has no moving body {body!r}", allowed=f"it has {known}")
        column: FloatArray = np.asarray(rows[..., 3 * self.system.order.index(body) + axis])
        return column


@record
class SystemRun(MultibodyHistory):
    """A run of a general system, one row per sample; the last sample is the end.

    steps   number of integration steps, including rejected ones
    events  events that occurred, in their order
    peaks   clearance pin -> its greatest force at any step [N]
    """

    steps: int
    events: tuple[EventRecord[MultibodyHistory], ...]
    peaks: dict[str, float]

    @property
    def end(self) -> EventRecord[MultibodyHistory] | None:
        """The event that ended the run; None where the last time was reached."""
        return self.events[-1] if self.events and self.events[-1].terminal else None

    @property
    def energy_residual(self) -> FloatArray:
        """Energy gained minus work done since the start [J]: the error of the integration."""
        residual: FloatArray = self.energy - self.energy[0] - (self.work - self.work[0])
        return residual

    @property
    def gap(self) -> float:
        """Greatest opening of a joint without clearance over the samples [m]."""
        return max(float(np.max(np.abs(_gaps_and_rows(self.model, state)[0]), initial=0.0)) for state in self.states)

    def indeterminate(self, sample: int = 0) -> tuple[str, ...]:
        """Names of the joints whose reactions the motion does not determine in the pose of a sample.

        Computed from the self-equilibrated forces J^T f = 0. They exist where joints are redundant, and in a singular
        pose. `pin` gives the forces of least norm.
        """
        _, rows = _gaps_and_rows(self.model, self.states[sample])
        full = np.zeros((len(rows), len(self.model.masses)))
        for row, bodies, values in zip(full, self.model.joint_bodies, rows, strict=True):
            for side, body in enumerate(bodies):
                if body >= 0:
                    row[3 * body : 3 * body + 3] += values[3 * side : 3 * side + 3]
        eased = full / np.sqrt(self.model.masses)
        eased /= np.linalg.norm(eased, axis=1, keepdims=True)
        left, sizes, _ = np.linalg.svd(eased)
        idle = left[:, np.concatenate((sizes, np.zeros(len(left) - len(sizes)))) < INDETERMINATE]
        share = np.sqrt(np.sum(np.abs(idle) ** 2, axis=1)) > INDETERMINATE
        names = [joint.name for joint in self.system.rigid]
        return tuple(name for k, name in enumerate(names) if share[2 * k] or share[2 * k + 1])


def _gaps_and_rows(model: Model, state: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Gaps and Jacobian rows of the joints at a state."""
    count, size = len(model.joint_bodies), len(model.masses)
    gap, bias, rows = np.zeros(count), np.zeros(count), np.zeros((count, 6))
    joints(model, state[:size], state[size : 2 * size], gap, rows, bias)
    return gap, rows
