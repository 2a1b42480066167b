"""A mechanism with one degree of freedom, reduced to its input coordinate.

    T = J(q) q'^2 / 2,    J(q) q'' + J'(q) q'^2 / 2 = Q(q, q') + M
    J = Σ (m |dG/dq|^2 + I (dθ/dq)^2),    Q = Σ (F · dP/dq + T dθ/dq)        [Eksergian, Dynamical Analysis of Machines]

q is the input coordinate [rad; m for a sliding input], M the drive effort, G the mass centres. The motion is solved at
unit input speed: its velocities are then d/dq and its accelerations d²/dq². So J, J' and Q are exact, without finite
differences.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float, FloatArray, Int8
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Gravity, Load, PointForce, Torque
from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.plane.vectors import dot
from ilmek.records import record
from ilmek.units import counted

Samples: TypeAlias = Float[np.ndarray, " samples"]


@record
class Terms:
    """The terms of the reduced equation, one value per sample; NaN where the mechanism does not close.

    inertia  J [kg m²; kg for a sliding input]       slope   dJ/dq
    weight   Q of gravity [N m; N]                   push    Q of the other loads that depend on the pose only [N m; N]
    status   `Status` of each sample
    """

    inertia: Samples
    slope: Samples
    weight: Samples
    push: Samples
    status: Int8[np.ndarray, " samples"]


@record
class ReducedMechanism:
    """A mechanism with one input, its masses and loads; built by `reduce`.

    weights   gravity loads
    steady    other loads that depend on the pose only
    live      loads that may depend on speed and time as well
    flywheel  inertia that moves with the input, including the motor's rotor [kg m²; kg for a sliding input]
    """

    plan: Plan
    inertias: Mapping[str, Inertia]
    weights: tuple[Gravity, ...]
    steady: tuple[Load, ...]
    live: tuple[Load, ...]
    flywheel: float

    def terms(self, position: FloatArray) -> Terms:
        """J, dJ/dq and Q at input values [rad; m], one value per sample."""
        with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
            return self._terms(position)

    def _terms(self, position: FloatArray) -> Terms:
        unit = solve(self.plan, position, 1.0)
        inertia, slope = np.full(len(unit), self.flywheel), np.zeros(len(unit))
        for body, weighed in self.inertias.items():
            centre, omega = unit.carried(body, weighed.centre), unit.omega(body)
            inertia = inertia + weighed.mass * np.abs(centre.velocity) ** 2 + weighed.moment * omega**2
            turning = weighed.moment * omega * unit.alpha(body)
            slope = slope + 2 * (weighed.mass * dot(centre.velocity, centre.acceleration) + turning)
        weight, push = (self._force(unit, unit, loads) for loads in (self.weights, self.steady))
        return Terms(inertia, slope, weight, push, unit.status)

    def live_force(self, position: Samples, speed: Samples, time: Samples) -> Samples:
        """Q of the loads that may depend on the motion [N m; N], at input values [rad; m], speeds [rad/s; m/s] and
        times [s].

        The loads are evaluated with an input acceleration of 0.
        """
        if not self.live:
            return np.zeros(len(position))
        motion = replace(solve(self.plan, position, speed), time=time)
        if np.all(speed):  # the power of the loads over the speed: one motion serves both
            with np.errstate(invalid="ignore", over="ignore"):
                return np.asarray(self._force(motion, motion, self.live) / speed)
        return self._force(solve(self.plan, position, 1.0), motion, self.live)

    def potential(self, position: Samples) -> Samples:
        """Potential energy of gravity [J] at input values [rad; m], relative to the ground's origin."""
        motion = solve(self.plan, position)
        energy = np.zeros(len(motion))
        for load in self.weights:
            for body, weighed in self.inertias.items():
                centre = motion.carried(body, weighed.centre).position
                energy = energy - weighed.mass * dot(complex(load.acceleration), centre)
        return energy

    def _force(self, unit: Motion, motion: Motion, loads: Iterable[Load]) -> Samples:
        force = np.zeros(len(unit))
        with np.errstate(invalid="ignore", over="ignore"):  # as in `terms`
            for load in loads:
                for wrench in load.wrenches(motion, self.inertias):
                    sliding = unit.carried(wrench.body, wrench.at).velocity
                    force = force + dot(wrench.force, sliding) + wrench.torque * unit.omega(wrench.body)
        return force


def reduce(
    plan: Plan, inertias: Mapping[str, Inertia], loads: Sequence[Load] = (), *, flywheel: float = 0.0
) -> ReducedMechanism:
    """The mechanism reduced to its only input.

    inertias  body -> inertia [kg, m, kg m²]; a body that is not listed is massless
    loads     loads such as `Gravity`; default: none
    flywheel  inertia that moves with the input [kg m²; kg for a sliding input]

    Raises MechanismError for several inputs, an unknown body, a negative flywheel, a load given by sample, and
    a mechanism in which no mass moves with the input.
    """
    mechanism = plan.mechanism
    if len(mechanism.inputs) != 1:
        raise MechanismError(
            f"{mechanism.name} has {counted(len(mechanism.inputs), 'input')}",
            allowed="the reduced equation is for one degree of freedom",
        )
    for body in inertias:
        mechanism.body(body)
    if not (np.isfinite(flywheel) and flywheel >= 0):
        raise MechanismError(f"flywheel of {mechanism.name} is {flywheel:g}", allowed="finite and not negative")
    moving = {body: inertia for body, inertia in inertias.items() if body in mechanism.moving}
    if flywheel == 0 and not any(inertia.mass or inertia.moment for inertia in moving.values()):
        raise MechanismError(f"no body of {mechanism.name} has a mass", do="give inertias, or a flywheel")
    weights = tuple(load for load in loads if isinstance(load, Gravity))
    others = [load for load in loads if not isinstance(load, Gravity)]
    steady, live = ([load for load in others if _steady(load) is kind] for kind in (True, False))
    return ReducedMechanism(plan, moving, weights, tuple(steady), tuple(live), flywheel)


def _steady(load: Load) -> bool:
    """Whether a load is known to depend on the pose only."""
    law = load.force if isinstance(load, PointForce) else load.torque if isinstance(load, Torque) else None
    if np.ndim(law if not callable(law) else 0):  # type: ignore[arg-type]
        raise MechanismError(f"a load on {getattr(load, 'body', '?')!r} is given by sample", do="give it as a function")
    return law is not None and not callable(law)
