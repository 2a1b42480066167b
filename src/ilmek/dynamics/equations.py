"""The equations of Newton and Euler for a planar mechanism, assembled and solved for every sample.

    Σ f = m a_G        Σ (p - G) x f + Σ t = J alpha        for each moving body, G its mass centre

Every unknown is a unit wrench between two bodies, times a number: two forces for a pin, a force across the line and
a couple for a slide, a torque or a force along the line for an input. A mechanism whose inputs leave no freedom has
as many unknowns as equations, three a moving body.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from ilmek.arrays import BoolArray, ComplexArray, ComplexField, FloatArray
from ilmek.dynamics.attached import Place, attached, passing
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Wrench
from ilmek.linkage.model import GROUND, Displacement, Input, Joint, Mechanism, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, unit

BLOCK = 4096
"""Samples solved at a time: more would leave the processor's cache."""

Sizes = Float[np.ndarray, "unknowns samples"]
Sides = Float[np.ndarray, "equations samples"]


@dataclass(frozen=True, slots=True)
class Unknown:
    """A wrench of unknown size between two bodies: this force and torque on `on`, the opposite on `by`.

    joint  whose reaction it is, or of the input whose effort it is (`effort`)
    """

    joint: str
    on: str
    by: str
    force: ComplexField
    at: ComplexArray
    torque: float
    effort: str = ""


def receiver(joint: Joint) -> str:
    """The body on which a joint's force is counted: the second of a pin, the sliding one of a slide."""
    return joint.second if isinstance(joint, Pin) else joint.body


def unknowns(mechanism: Mechanism, motion: Motion) -> tuple[Unknown, ...]:
    """All unknown unit wrenches: two a joint, in the order of the joints, then one an input."""
    reactions = [unknown for joint in mechanism.joints for unknown in _of_joint(joint, motion)]
    return (*reactions, *(_of_input(mechanism, entry, motion) for entry in mechanism.inputs))


def _of_joint(joint: Joint, motion: Motion) -> Iterator[Unknown]:
    on = receiver(joint)
    by = _other(joint, on)
    at = _place(motion, on, joint.name)
    if isinstance(joint, Pin):
        yield Unknown(joint.name, on, by, 1.0 + 0j, at, 0.0)
        yield Unknown(joint.name, on, by, 1j, at, 0.0)
    else:
        yield Unknown(joint.name, on, by, 1j * _line(joint, motion), at, 0.0)
        yield Unknown(joint.name, on, by, 0j, at, 1.0)


def _of_input(mechanism: Mechanism, entry: Input, motion: Motion) -> Unknown:
    joint = mechanism.joint(entry.joint)
    if isinstance(entry, Displacement) and isinstance(joint, Slide):
        at = _place(motion, joint.body, joint.name)
        return Unknown(joint.name, joint.body, joint.guide, _line(joint, motion), at, 0.0, effort=entry.name)
    at = _place(motion, entry.name, joint.name)
    return Unknown(joint.name, entry.name, _other(joint, entry.name), 0j, at, 1.0, effort=entry.name)


def _place(motion: Motion, body: str, point: str) -> ComplexArray:
    return attached(motion, body, motion.plan.mechanism.point(body, point)).position


def _line(slide: Slide, motion: Motion) -> ComplexArray:
    direction: ComplexArray = motion.direction(slide.guide) * unit(slide.along)
    return direction


def _other(joint: Joint, body: str) -> str:
    first, second = joint.bodies
    return second if body == first else first


def right_side(
    motion: Motion,
    inertias: Mapping[str, Inertia],
    centres: Mapping[str, Place],
    wrenches: Sequence[Wrench],
    length: float,
) -> Sides:
    """What the unknown wrenches must come to: three rows a body, x, y, and moment about its centre over `length`."""
    rows = []
    for body, inertia in inertias.items():
        force: ComplexArray = inertia.mass * centres[body].acceleration
        moment: FloatArray = inertia.moment * motion.alpha(body)
        for wrench in wrenches:
            if wrench.body == body:
                force = force - wrench.force
                arm = wrench.at.position - centres[body].position
                moment = moment - cross(arm, wrench.force) - wrench.torque
        rows += [force.real, force.imag, moment / length]
    return np.stack(rows)


def solve_sizes(
    wrenches: Sequence[Unknown], centres: Mapping[str, Place], right: Sides, length: float, usable: BoolArray
) -> Sizes:
    """Size of every unknown wrench; NaN at samples that are not usable, or whose equations are singular.

    length  a length of the mechanism [m]: moments are divided by it, so that they weigh like forces
    """
    sizes = np.full((len(wrenches), right.shape[1]), np.nan)
    for start in range(0, right.shape[1], BLOCK):
        block = np.arange(start, min(start + BLOCK, right.shape[1]))
        block = block[usable[block]]
        matrix = _matrix(wrenches, centres, length, block)
        try:
            solved = np.linalg.solve(matrix, right.T[block, :, None])
        except np.linalg.LinAlgError:
            regular = np.linalg.slogdet(matrix).sign != 0
            block = block[regular]
            solved = np.linalg.solve(matrix[regular], right.T[block, :, None])
        sizes[:, block] = solved[..., 0].T
    torques = np.array([wrench.torque * length if wrench.torque else 1.0 for wrench in wrenches])
    scaled: Sizes = sizes * torques[:, None]
    return scaled


def _matrix(
    wrenches: Sequence[Unknown], centres: Mapping[str, Place], length: float, block: np.ndarray
) -> Float[np.ndarray, "samples equations unknowns"]:
    row = {body: 3 * place for place, body in enumerate(centres)}
    matrix = np.zeros((block.size, 3 * len(row), len(wrenches)))
    for column, wrench in enumerate(wrenches):
        force = wrench.force[block] if isinstance(wrench.force, np.ndarray) else wrench.force
        for body, sign in ((wrench.on, +1), (wrench.by, -1)):
            if body == GROUND:
                continue
            top = row[body]
            arm = wrench.at[block] - centres[body].position[block]
            matrix[:, top, column] = sign * np.real(force)
            matrix[:, top + 1, column] = sign * np.imag(force)
            matrix[:, top + 2, column] = sign * (cross(arm, force) / length + wrench.torque)
    return matrix


def characteristic_length(mechanism: Mechanism) -> float:
    """Greatest distance of a joint from its body's origin [m]; 1 where there is none."""
    return max((abs(point) for body in mechanism.bodies for point in body.points.values()), default=1.0) or 1.0


def speed_of(wrench: Unknown, motion: Motion) -> FloatArray:
    """Power of a unit of the wrench: how fast `on` moves against `by` along it [m/s or rad/s]."""
    sliding = passing(motion, wrench.on, wrench.at) - passing(motion, wrench.by, wrench.at)
    turning = motion.omega(wrench.on) - motion.omega(wrench.by)
    speed: FloatArray = np.real(np.conj(wrench.force) * sliding) + wrench.torque * turning
    return speed
