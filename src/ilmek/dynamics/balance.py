"""Shaking force and shaking moment of a mechanism on its frame, and counterweights.

    F = -Σ m a_G        M = -Σ ((G - O) x m a_G + J alpha)        [d'Alembert's principle; O reference point]

A counterweight on the crank with static moment U = m r [kg m], complex in the crank's frame, adds U omega² e^{i theta}
at constant speed. The first harmonic of the force is c_1 e^{i theta} + c_-1 e^{-i theta}. The first part rotates with
the crank and is cancelled by a counterweight on it. The second part rotates in the opposite direction and requires a
second, counter-rotating weight [Lanchester balancer; Norton, Design of Machinery, chapter 12].
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, NumberArray
from ilmek.dynamics.inertia import Inertia, combined, point_mass
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.pose_block import pose_block
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, unit
from ilmek.records import record


@record
class Shaking:
    """Force on the frame [N] and its moment [N m] about a point, one value per sample."""

    force: ComplexArray
    moment: FloatArray


def shaking(motion: Motion, inertias: Mapping[str, Inertia], about: complex = 0j) -> Shaking:
    """Shaking force and moment of the moving masses, without gravity and loads.

    motion    with accelerations      inertias  body -> inertia [kg, m, kg m²]; a body that is not listed is massless
    about     reference point O [m]; default: the ground's origin
    """
    force, moment = np.zeros(motion.status.shape, complex), np.zeros(motion.status.shape)
    with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
        for body, inertia in inertias.items():
            centre = motion.carried(body, inertia.centre)
            change = inertia.mass * centre.acceleration
            force = force - change
            moment = moment - cross(centre.position - about, change) - inertia.moment * motion.alpha(body)
    return Shaking(force, moment)


def on_frame(forces: Forces, about: complex = 0j) -> Shaking:
    """Force and moment on the ground of all joints, teeth, drives and frictions, including gravity and loads.

    forces  from `inverse`      about  reference point O [m]; default: the ground's origin
    """
    motion = forces.motion
    force, moment = np.zeros(motion.status.shape, complex), np.zeros(motion.status.shape)
    for name, joint in pose_block(motion, {}).joints.items():
        if GROUND in (joint.on, joint.by):
            sign = 1.0 if joint.on == GROUND else -1.0
            push, turning = forces.acting[name]
            force = force + sign * push
            moment = moment + sign * (turning + cross(joint.at - about, push))
    return Shaking(force, moment)


def harmonics(values: NumberArray, most: int) -> dict[int, complex]:
    """Fourier coefficients c_k of Σ c_k e^{i k theta}, k = -most ... most, in the unit of the values.

    values  samples at equal steps over one turn, without its end; shape (samples,)
    most    greatest order of a harmonic

    For a complex force, k > 0 rotates with the crank and k < 0 in the opposite direction. For real values c_-k is the
    conjugate of c_k.
    >>> theta = np.arange(8) * np.pi / 4
    >>> found = harmonics(3 * np.cos(theta), 1)
    >>> round(found[1].real, 12), round(found[-1].real, 12)
    (1.5, 1.5)
    """
    series = np.fft.fft(values) / len(values)
    return {k: complex(series[k]) for k in range(-most, most + 1)}


class Counterweights(NamedTuple):
    """Static moments m r [kg m], complex, that balance the first harmonic of a shaking force; at the crank angle 0.

    with_crank     of a counterweight on the crank, in its frame
    against_crank  of a counterweight on a shaft that rotates at the same speed in the opposite direction
    """

    with_crank: complex
    against_crank: complex


def first_harmonic(force: ComplexArray, speed: float) -> Counterweights:
    """The two counterweights that cancel the first harmonic of a shaking force; the first alone leaves c_-1.

    force  [N] at equal steps over one turn of the crank, without its end; shape (samples,)
    speed  constant speed of the crank [rad/s]
    """
    found = harmonics(force, 1)
    return Counterweights(-found[1] / speed**2, -found[-1] / speed**2)


def crank_counterweight(
    force: ComplexArray, speed: float, *, share: float = 1.0, along: float | None = None
) -> complex:
    """Static moment m r [kg m] of a counterweight on the crank against the first harmonic of a shaking force.

    force  [N] at equal steps over one turn of the crank, without its end; shape (samples,)
    speed  constant speed of the crank [rad/s]
    share  share of the part that rotates with the crank [1]; 1 minimises the greatest remaining force, |c_-1|
    along  direction [rad] in which the first harmonic is cancelled; its component across grows in return, and `share`
           is a share of this counterweight; default: no preferred direction
    """
    pair = first_harmonic(force, speed)
    if along is None:
        return share * pair.with_crank
    return share * (pair.with_crank + pair.against_crank.conjugate() * complex(unit(2 * along)))


def counterweighted(inertia: Inertia, static_moment: complex, radius: float) -> Inertia:
    """Inertia of a body with a point mass added as its counterweight.

    static_moment  m r of the point mass, complex in the body's frame [kg m]
    radius         distance r of the point mass from the body's origin [m]

    Raises MechanismError for a radius that is not above 0.
    """
    if not (math.isfinite(radius) and radius > 0):
        raise MechanismError(f"radius of a counterweight is {radius:g} m", allowed="finite and above 0")
    mass = abs(static_moment) / radius
    return combined(inertia, point_mass(mass, radius * static_moment / abs(static_moment))) if mass else inertia


def four_bar_counterweights(lengths: Mapping[str, float], inertias: Mapping[str, Inertia]) -> tuple[complex, complex]:
    """Static moments [kg m] on crank and rocker that cancel a four-bar's shaking force completely, at any speed.

        on the crank   -(m_2 c_2 + m_3 a_2 (1 - c_3 / a_3))       on the rocker   -(m_4 c_4 + m_3 a_4 c_3 / a_3)

    With the loop equation, Σ m G has one term in e^{i theta_2} and one in e^{i theta_4}; both are set to zero
    [method of linearly independent vectors, Berkof and Lowen, Journal of Engineering for Industry 91 (1969) 21].

    lengths   "crank" a_2, "coupler" a_3, "rocker" a_4 [m]
    inertias  of the same links, in frames from the fixed pin (crank, rocker) or the crank pin (coupler) along the link
    """
    crank, coupler, rocker = (inertias[name] for name in ("crank", "coupler", "rocker"))
    part = coupler.centre / lengths["coupler"]
    on_crank = -(crank.mass * crank.centre + coupler.mass * lengths["crank"] * (1 - part))
    return on_crank, -(rocker.mass * rocker.centre + coupler.mass * lengths["rocker"] * part)
