"""Forces between cam and follower at a speed: what the follower needs, what the cam presses, what the shaft gives.

The cam turns counter-clockwise. Along its motion the follower needs

    F = m w^2 s'' + k s + P + load

(m mass moved, k and P rate and preload of the spring that holds it to the cam; for an arm the same with moment of
inertia, moments and angles). The cam presses with N along its outward normal n at the touched point c. With `way`, the
velocity there by the follower's coordinate, n . way = cos(pressure angle), and by virtual work the shaft's torque is
T = N (c x n) = F s': the whole of it without friction.

Friction takes part in two places. A sliding follower is dragged along by the cam's surface, the push is q = n + mu t;
a straight guide holds its side force and resists with mu_g |q x way|. Then N = F / (q . way - mu_g |q x way| sign(s'))
and T = N (c x q). Where the bracket is not above 0 the follower jams, NaN. A groove pulls too, N < 0, and friction
then has the other sign.                                              [Norton, Cam Design and Manufacturing, 9]
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.plane.vectors import cross, dot


@dataclass(frozen=True, slots=True)
class FollowerLoad:
    """What a follower carries and what holds it to the cam, at a speed [rad/s].

    mass [kg]    rate [N/m]    preload, of the spring at the lowest place [N]    load, always towards the cam [N]
    Of an arm: moment of inertia [kg m^2], rate [N m/rad], moments [N m].
    """

    speed: float
    mass: float
    rate: float = 0.0
    preload: float = 0.0
    load: float = 0.0

    def force(self, s: RealField, dds: RealField) -> FloatArray:
        """What the cam must give along the motion [N]; where below 0 the follower would lift off."""
        return np.asarray(self.mass * self.speed**2 * dds + self.rate * s + self.preload + self.load)


class Touch(NamedTuple):
    """Where and how cam and follower touch, in any frame whose origin is the cam's axis.

    point    touched point [m]              normal  outward unit normal of the cam there
    way      velocity of the follower there by its coordinate: a unit vector of a slide, i (point - pivot) of an arm [m]
    """

    point: ComplexField
    normal: ComplexField
    way: ComplexField


class ContactForce(NamedTuple):
    """Force of the cam on the follower along the normal [N], and the shaft's torque [N m]."""

    normal: FloatArray
    torque: FloatArray


def pressed(touch: Touch, ds: RealField, force: RealField, *, sliding: float = 0.0, guide: float = 0.0) -> ContactForce:
    """Normal force and torque for a follower's need along its motion.

    ds       s' [m/rad; 1 of an arm]        force    need along the motion [N; N m of an arm], `FollowerLoad.force`
    sliding  coefficient of friction between cam and follower; 0 for a roller
    guide    coefficient of friction in a straight guide; 0 for an arm
    """
    forward = 1j * np.asarray(touch.normal)
    slip = dot(1j * np.asarray(touch.point) - ds * touch.way, forward)
    sense = np.where(np.asarray(force) < 0, -1.0, 1.0)
    push = touch.normal + sense * sliding * np.sign(slip) * forward
    resisted = sense * guide * np.abs(cross(touch.way, push)) * np.sign(ds)
    along = dot(push, touch.way) - resisted
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = np.where(along > 0, force / along, np.nan)
    return ContactForce(np.asarray(normal), np.asarray(normal * cross(touch.point, push)))
