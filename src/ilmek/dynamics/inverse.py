"""Inverse dynamics: the forces in the joints and the effort of the drive that a given motion needs.

For any planar mechanism of pins and slides; the equations are those of `equations`.

Sign convention: a pin's force acts on its `second` body, from the first; a slide's force and couple act on its
`body`, from the guide; an input's effort acts on the driven body, from the other one. The opposite acts on the other.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.attached import Place, attached
from ilmek.dynamics.equations import (
    Sizes,
    Unknown,
    characteristic_length,
    receiver,
    right_side,
    solve_sizes,
    speed_of,
    unknowns,
)
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Load, Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.motion import Motion
from ilmek.linkage.status import Status
from ilmek.plane.vectors import dot

MASSLESS = Inertia(0.0, 0j, 0.0)


@dataclass(frozen=True, slots=True)
class Forces:
    """Forces over a motion, one a sample; NaN where the motion does not close or stands at a dead centre.

    reactions     joint -> force on the second body of the pin, or across the line on the slide's body [N], complex
    couples       slide -> couple on the slide's body [N m]
    efforts       input -> torque [N m] or force along the line [N] on the driven body
    input_power   Σ effort times speed of the drive [W]
    load_power    power of the loads, weight among them [W]
    kinetic_rate  time derivative of the kinetic energy [W]
    """

    mechanism: Mechanism
    reactions: Mapping[str, ComplexArray]
    couples: Mapping[str, FloatArray]
    efforts: Mapping[str, FloatArray]
    input_power: FloatArray
    load_power: FloatArray
    kinetic_rate: FloatArray

    def pin(self, name: str, on: str | None = None) -> ComplexArray:
        """Force in a joint [N] on body `on`; unsaid: on the second body of a pin, the sliding body of a slide."""
        joint = self.mechanism.joint(name)
        if on is not None and on not in joint.bodies:
            joined = " and ".join(joint.bodies)
            raise MechanismError(f"joint {name!r} does not touch {on!r}", allowed=f"it joins {joined}")
        return self.reactions[name] if on in (None, receiver(joint)) else -self.reactions[name]

    def effort(self, entry: str) -> FloatArray:
        """Torque [N m] or force [N] on the driven body, by the name of the input: that of the body, or of the slide."""
        if entry not in self.efforts:
            raise MechanismError(f"no input {entry!r}", allowed=f"inputs: {', '.join(self.efforts)}")
        return self.efforts[entry]

    @property
    def power_residual(self) -> FloatArray:
        """Input power + load power - rate of the kinetic energy [W]: zero but for rounding, at every instant.

        Joints do no work; the sum is formed without the equations that gave the forces in them.
        """
        residual: FloatArray = self.input_power + self.load_power - self.kinetic_rate
        return residual

    @property
    def power_error(self) -> float:
        """Greatest power residual over the greatest sum of the powers' sizes; samples that are NaN are left out."""
        size = np.abs(self.input_power) + np.abs(self.load_power) + np.abs(self.kinetic_rate)
        usable = np.isfinite(size)
        top = float(np.max(size[usable], initial=0.0))
        return float(np.max(np.abs(self.power_residual[usable]), initial=0.0)) / top if top else 0.0


def inverse(motion: Motion, inertias: Mapping[str, Inertia], loads: Sequence[Load] = ()) -> Forces:
    """Joint forces and efforts of a motion, under inertia and loads.

    inertias  body -> inertia; a body not named is massless. Raises MechanismError for an unknown body.
    """
    mechanism = motion.plan.mechanism
    for body in inertias:
        mechanism.body(body)
    bodies = {body: inertias.get(body, MASSLESS) for body in mechanism.moving}
    wrenches = [wrench for load in loads for wrench in load.wrenches(motion, bodies) if wrench.body != GROUND]
    centres = {body: attached(motion, body, inertia.centre) for body, inertia in bodies.items()}
    length = characteristic_length(mechanism)
    asked = unknowns(mechanism, motion)
    right = right_side(motion, bodies, centres, wrenches, length)
    sizes = solve_sizes(asked, centres, right, length, motion.status == Status.OK)
    return Forces(
        mechanism,
        *_by_name(asked, sizes),
        input_power=_input_power(motion, asked, sizes),
        load_power=_load_power(motion, wrenches),
        kinetic_rate=_kinetic_rate(motion, bodies, centres),
    )


def _by_name(
    asked: Sequence[Unknown], sizes: Sizes
) -> tuple[dict[str, ComplexArray], dict[str, FloatArray], dict[str, FloatArray]]:
    """Reactions, couples and efforts by the names of joints and inputs."""
    reactions: dict[str, ComplexArray] = {}
    couples: dict[str, FloatArray] = {}
    efforts: dict[str, FloatArray] = {}
    for unknown, size in zip(asked, sizes, strict=True):
        if unknown.effort:
            efforts[unknown.effort] = size
        elif unknown.torque:
            couples[unknown.joint] = size
        else:
            reactions[unknown.joint] = reactions.get(unknown.joint, 0) + size * unknown.force
    return reactions, couples, efforts


def _input_power(motion: Motion, asked: Sequence[Unknown], sizes: Sizes) -> FloatArray:
    power = np.zeros(motion.status.shape)
    for unknown, size in zip(asked, sizes, strict=True):
        if unknown.effort:
            power = power + size * speed_of(unknown, motion)
    return power


def _load_power(motion: Motion, wrenches: Sequence[Wrench]) -> FloatArray:
    power = np.zeros(motion.status.shape)
    for wrench in wrenches:
        power = power + dot(wrench.force, wrench.at.velocity) + wrench.torque * motion.omega(wrench.body)
    return power


def _kinetic_rate(motion: Motion, inertias: Mapping[str, Inertia], centres: Mapping[str, Place]) -> FloatArray:
    """d/dt Σ (m |v|² + J omega²) / 2 = Σ (m v · a + J omega alpha)."""
    rate = np.zeros(motion.status.shape)
    for body, inertia in inertias.items():
        moving = inertia.mass * dot(centres[body].velocity, centres[body].acceleration)
        rate = rate + moving + inertia.moment * motion.omega(body) * motion.alpha(body)
    return rate
