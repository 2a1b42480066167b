"""What a mechanism shakes its frame with, and the counterweights against it.

    F = -Σ m a_G        M = -Σ ((G - O) x m a_G + J alpha)        [d'Alembert; O the point of reference]

A weight on the crank of static moment U = m r [kg m], complex in the crank's frame, adds U omega² e^{i theta} while the
speed is constant. The force's first harmonic is c_1 e^{i theta} + c_-1 e^{-i theta}: one part turns with the crank, and
can be cancelled there, the other turns against it, and asks for a second weight that does so too [Lanchester].
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, NumberArray
from ilmek.dynamics.attached import attached
from ilmek.dynamics.inertia import Inertia, combined, point_mass
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.pose_block import posed
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, unit


@dataclass(frozen=True, slots=True)
class Shaking:
    """Force on the frame [N] and its moment [N m] about a point, one a sample."""

    force: ComplexArray
    moment: FloatArray


def shaking(motion: Motion, inertias: Mapping[str, Inertia], about: complex = 0j) -> Shaking:
    """Shaking force and moment of the moving masses; weight and loads do not count."""
    force, moment = np.zeros(len(motion), complex), np.zeros(len(motion))
    for body, inertia in inertias.items():
        centre = attached(motion, body, inertia.centre)
        change = inertia.mass * centre.acceleration
        force = force - change
        moment = moment - cross(centre.position - about, change) - inertia.moment * motion.alpha(body)
    return Shaking(force, moment)


def on_frame(forces: Forces, about: complex = 0j) -> Shaking:
    """Force and moment of all joints, teeth, drives and frictions on the ground, from weight and loads too."""
    motion = forces.motion
    force, moment = np.zeros(len(motion), complex), np.zeros(len(motion))
    for name, joint in posed(motion, {}).joints.items():
        if GROUND not in (joint.on, joint.by):
            continue
        sign = 1.0 if joint.on == GROUND else -1.0
        couple, along = sign * forces.couples.get(name, 0.0), sign * forces.frictions.get(name, 0.0)
        for entry in forces.mechanism.inputs:
            if entry.joint == name:
                driven = joint.on if entry.name in (joint.on, name) else joint.by
                along = along + (1.0 if driven == GROUND else -1.0) * forces.efforts[entry.name]
        push = sign * forces.reactions[name] + along * joint.drive.force
        force = force + push
        moment = moment + cross(joint.at - about, push) + couple + along * joint.drive.moment
    return Shaking(force, moment)


def harmonics(values: NumberArray, most: int) -> dict[int, complex]:
    """c_k of Σ c_k e^{i k theta}, k = -most ... most, from samples at equal steps of a turn, its end left out.

    Of a complex force, k > 0 turns with the crank and -k against it; of a real curve c_-k is the conjugate of c_k.
    >>> theta = np.arange(8) * np.pi / 4
    >>> found = harmonics(3 * np.cos(theta), 1)
    >>> round(found[1].real, 12), round(found[-1].real, 12)
    (1.5, 1.5)
    """
    series = np.fft.fft(values) / len(values)
    return {k: complex(series[k]) for k in range(-most, most + 1)}


class Counterweights(NamedTuple):
    """Static moments m r [kg m] against the first harmonic of a shaking force, at the crank angle 0.

    with_crank     of a weight on the crank, in its frame
    against_crank  of one on a shaft that turns as fast the other way
    """

    with_crank: complex
    against_crank: complex


def first_harmonic(force: ComplexArray, speed: float) -> Counterweights:
    """The two weights that cancel the first harmonic of a shaking force in full; the first alone leaves c_-1.

    force  at equal steps of a turn of the crank, its end left out, at constant `speed` [rad/s]
    """
    found = harmonics(force, 1)
    return Counterweights(-found[1] / speed**2, -found[-1] / speed**2)


def crank_counterweight(
    force: ComplexArray, speed: float, *, share: float = 1.0, along: float | None = None
) -> complex:
    """Static moment m r [kg m] of a weight on the crank against the first harmonic of a shaking force.

    share  of the part that turns with the crank: 1 leaves the least greatest value, |c_-1|
    along  a direction [rad] in which the first harmonic is to vanish altogether, that across it growing in return;
           `share` is then of the weight that does so
    """
    pair = first_harmonic(force, speed)
    if along is None:
        return share * pair.with_crank
    return share * (pair.with_crank + pair.against_crank.conjugate() * complex(unit(2 * along)))


def counterweighted(inertia: Inertia, static_moment: complex, radius: float) -> Inertia:
    """A body with a point mass at a radius [m] from its origin that gives it a static moment [kg m].

    Raises MechanismError for a radius that is not above 0.
    """
    if not (math.isfinite(radius) and radius > 0):
        raise MechanismError(f"radius of a counterweight is {radius:g} m", allowed="finite and above 0")
    mass = abs(static_moment) / radius
    return combined(inertia, point_mass(mass, radius * static_moment / abs(static_moment))) if mass else inertia


def four_bar_counterweights(lengths: Mapping[str, float], inertias: Mapping[str, Inertia]) -> tuple[complex, complex]:
    """Static moments [kg m] on crank and rocker that cancel a four-bar's shaking force altogether, at any speed.

        on the crank   -(m_2 c_2 + m_3 a_2 (1 - c_3 / a_3))       on the rocker   -(m_4 c_4 + m_3 a_4 c_3 / a_3)

    With the loop's equation, Σ m G has one term in e^{i theta_2} and one in e^{i theta_4}; both are made to vanish
    [method of linearly independent vectors, Berkof and Lowen, Journal of Engineering for Industry 91 (1969) 21].

    lengths   of crank a_2, coupler a_3, rocker a_4 [m]
    inertias  of the same, in frames from the fixed pin (crank, rocker) or the crank pin (coupler) along the link
    """
    crank, coupler, rocker = (inertias[name] for name in ("crank", "coupler", "rocker"))
    part = coupler.centre / lengths["coupler"]
    on_crank = -(crank.mass * crank.centre + coupler.mass * lengths["crank"] * (1 - part))
    return on_crank, -(rocker.mass * rocker.centre + coupler.mass * lengths["rocker"] * part)
