"""A mechanism reduced to its inputs; the terms of the equation of one input. The general one: `equation_of_motion`.

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

from ilmek.arguments import Arguments
from ilmek.arrays import Float, FloatArray, Int8
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.input_loads import Drag, FollowerForce
from ilmek.dynamics.joint_friction import JointFriction, check_joints
from ilmek.dynamics.loads import Gravity, Load, PointForce, Torque
from ilmek.dynamics.springs import Spring
from ilmek.errors import MechanismError
from ilmek.linkage.model import Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.plane.vectors import dot
from ilmek.records import record

Samples: TypeAlias = Float[np.ndarray, " samples"]


@record
class Terms:
    """The terms of the reduced equation, one value per sample; NaN where the mechanism does not close.

    inertia  J [kg m²; kg for a sliding input]       slope   dJ/dq
    weight   Q of gravity [N m; N]                   push    Q of the steady loads at rest [N m; N]
    drag     fall of that Q by the speed [N m s; N s/m]          status  `Status` of each sample
    """

    inertia: Samples
    slope: Samples
    weight: Samples
    push: Samples
    drag: Samples
    status: Int8[np.ndarray, " samples"]


@record
class ReducedMechanism:
    """A mechanism with its masses, loads and friction, reduced to its inputs; built by `reduce`.

    weights    gravity loads
    steady     other loads that depend on the pose only, or linearly on the speed as well
    live       loads that may depend on speed and time as well
    wheels     input -> inertia that moves with it, including the motor's rotor [kg m²; kg for a sliding input]
    frictions  of joints
    """

    plan: Plan
    inertias: Mapping[str, Inertia]
    weights: tuple[Gravity, ...]
    steady: tuple[Load, ...]
    live: tuple[Load, ...]
    wheels: Mapping[str, float]
    frictions: tuple[JointFriction, ...] = ()

    @property
    def one(self) -> bool:
        """Whether the equation of one input, without friction, describes it."""
        return len(self.wheels) == 1 and not self.frictions

    def terms(self, position: FloatArray) -> Terms:
        """J, dJ/dq and Q of the only input at its values [rad; m], one value per sample, without friction."""
        with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
            return self._terms(position)

    def _terms(self, position: FloatArray) -> Terms:
        unit = solve(self.plan, position, 1.0)
        inertia, slope = np.full(len(unit), sum(self.wheels.values())), np.zeros(len(unit))
        for body, weighed in self.inertias.items():
            centre, omega = unit.carried(body, weighed.centre), unit.omega(body)
            inertia = inertia + weighed.mass * np.abs(centre.velocity) ** 2 + weighed.moment * omega**2
            turning = weighed.moment * omega * unit.alpha(body)
            slope = slope + 2 * (weighed.mass * dot(centre.velocity, centre.acceleration) + turning)
        weight, moving = (self._force(unit, unit, loads) for loads in (self.weights, self.steady))
        damped = any(isinstance(load, Drag | Spring) for load in self.steady)
        push = self._force(unit, solve(self.plan, position), self.steady) if damped else moving
        return Terms(inertia, slope, weight, push, push - moving, unit.status)

    def torque(self, position: Samples, speed: float) -> Samples:
        """Effort on the only input at a constant speed, J' q'² / 2 - Q [N m; N], without live loads and friction."""
        terms = self.terms(position)
        return terms.slope * speed**2 / 2 - terms.weight - terms.push + terms.drag * speed

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

    def energies(self, motion: Motion) -> tuple[Samples, Samples]:
        """Kinetic energy, and potential energy of gravity relative to the ground's origin [J], over a motion."""
        kinetic, potential = np.zeros(len(motion)), np.zeros(len(motion))
        for name, wheel in self.wheels.items():
            kinetic = kinetic + wheel * np.asarray(motion.drives[name].speed) ** 2 / 2
        for body, weighed in self.inertias.items():
            centre = motion.carried(body, weighed.centre)
            kinetic = kinetic + weighed.mass * np.abs(centre.velocity) ** 2 / 2
            kinetic = kinetic + weighed.moment * motion.omega(body) ** 2 / 2
            for load in self.weights:
                potential = potential - weighed.mass * dot(complex(load.acceleration), centre.position)
        return kinetic, potential

    def _force(self, unit: Motion, motion: Motion, loads: Iterable[Load]) -> Samples:
        force = np.zeros(len(unit))
        with np.errstate(invalid="ignore", over="ignore"):  # as in `terms`
            for load in loads:
                for wrench in load.wrenches(motion, self.inertias):
                    sliding = unit.carried(wrench.body, wrench.at).velocity
                    force = force + dot(wrench.force, sliding) + wrench.torque * unit.omega(wrench.body)
        return force


def reduce(
    plan: Plan,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    *,
    flywheel: float | Mapping[str, float] = 0.0,
    frictions: Sequence[JointFriction] = (),
) -> ReducedMechanism:
    """The mechanism reduced to its inputs.

    inertias   body -> inertia [kg, m, kg m²]; a body that is not listed is massless
    loads      loads such as `Gravity`; default: none
    flywheel   inertia that moves with the only input [kg m²; kg for a sliding input], or input -> inertia
    frictions  of joints; default: none

    Raises MechanismError for a mechanism without inputs, an unknown body, input or joint, a negative flywheel, a load
    given by sample, and a mechanism in which no mass moves.
    """
    mechanism = plan.mechanism
    if not mechanism.inputs:
        raise MechanismError(f"{mechanism.name} has no input", allowed="a mechanism with one input or more")
    for body in inertias:
        mechanism.body(body)
    check_joints(mechanism, frictions)
    wheels = _wheels(mechanism, flywheel)
    moving = {body: inertia for body, inertia in inertias.items() if body in mechanism.moving}
    if not any(wheels.values()) and not any(inertia.mass or inertia.moment for inertia in moving.values()):
        raise MechanismError(f"no body of {mechanism.name} has a mass", do="give inertias, or a flywheel")
    weights = tuple(load for load in loads if isinstance(load, Gravity))
    others = [load for load in loads if not isinstance(load, Gravity)]
    steady, live = (tuple(load for load in others if _steady(load) is kind) for kind in (True, False))
    return ReducedMechanism(plan, moving, weights, steady, live, wheels, tuple(frictions))


def _wheels(mechanism: Mechanism, flywheel: float | Mapping[str, float]) -> dict[str, float]:
    """Input -> inertia that moves with it. Raises MechanismError for an unknown input and a negative inertia."""
    names = [entry.name for entry in mechanism.inputs]
    given = flywheel if isinstance(flywheel, Mapping) else {names[0]: flywheel} if flywheel else {}
    if len(names) > 1 and given is not flywheel and flywheel:
        allowed = f"input -> flywheel; the inputs are {', '.join(names)}"
        raise MechanismError(f"one flywheel is given for {len(names)} inputs", allowed=allowed)
    wheels = dict.fromkeys(names, 0.0)
    for name, wheel in given.items():
        wheels[Arguments("", MechanismError).one_of("an input", name, names)] = wheel
        if not (np.isfinite(wheel) and wheel >= 0):
            raise MechanismError(f"flywheel of {mechanism.name} is {wheel:g}", allowed="finite and not negative")
    return wheels


def _steady(load: Load) -> bool:
    """Whether a load is known to depend on the pose only, or linearly on the speed as well."""
    law = load.force if isinstance(load, PointForce) else load.torque if isinstance(load, Torque) else None
    if np.ndim(law if not callable(law) else 0):  # type: ignore[arg-type]
        raise MechanismError(f"a load on {getattr(load, 'body', '?')!r} is given by sample", do="give it as a function")
    return isinstance(load, Drag | FollowerForce | Spring) or (law is not None and not callable(law))
