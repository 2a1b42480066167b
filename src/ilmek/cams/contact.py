"""Forces between cam and follower at a speed: force along the motion, contact force and shaft torque.

The cam turns counter-clockwise. The force required along the follower's motion is

    F = m w^2 s'' + k s + P + load

m is the moving mass, k and P are the rate and the preload of the return spring; an arm has a moment of inertia, moments
and angles instead. The cam presses with N along its outward normal n at the contact point c. Let g be the velocity of
the follower at c per unit of its coordinate; n . g = cos(pressure angle) for a slide. Without friction, the shaft's
torque follows from virtual work: T = N (c x n) = F s'.

Friction acts at the contact and in the guide. The cam's surface drags a sliding follower along t, so the contact force
acts along q = n + mu t. A straight guide carries the side force and resists with mu_g |q x g|. Then
N = F / (q . g - mu_g |q x g| sign(s')) and T = N (c x q). Where the denominator is not above 0 the follower jams, and N
is NaN. A groove can also pull, N < 0; friction then has the opposite sign.
[Norton, Cam Design and Manufacturing, 9]
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.plane.vectors import cross, dot


@dataclass(frozen=True, slots=True)
class FollowerLoad:
    """Inertia, spring and load of a follower, at a speed of the cam.

    speed    of the cam [rad/s]                          mass  moving mass [kg; an arm's moment of inertia kg m^2]
    rate     of the return spring [N/m; N m/rad]         load  constant load towards the cam [N; N m]
    preload  of the spring at displacement 0 [N; N m]
    """

    speed: float
    mass: float
    rate: float = 0.0
    preload: float = 0.0
    load: float = 0.0

    def force(self, s: RealField, dds: RealField) -> FloatArray:
        """Force required along the motion [N; N m of an arm]; below 0 the follower would lift off.

        s    displacement [m; rad]      dds  its second derivative by the cam angle [m/rad^2; 1/rad]
        """
        return np.asarray(self.mass * self.speed**2 * dds + self.rate * s + self.preload + self.load)


class ContactPoint(NamedTuple):
    """Contact of cam and follower, in any frame whose origin is the cam's axis; fields of one shape.

    point     contact point [m]
    normal    outward unit normal of the cam at that point
    velocity  of the follower at that point per unit of its coordinate: a unit vector for a slide, i (point - pivot) [m]
              for an arm
    """

    point: ComplexField
    normal: ComplexField
    velocity: ComplexField


class ContactForce(NamedTuple):
    """Force of the cam on the follower along the normal [N], the shaft's torque [N m], and what friction leaves.

    along  share of the normal force along the motion, friction subtracted: 0 and below the follower jams
    """

    normal: FloatArray
    torque: FloatArray
    along: FloatArray


def contact_force(
    contact: ContactPoint, ds: RealField, force: RealField, *, sliding: float = 0.0, guide: float = 0.0
) -> ContactForce:
    """Contact force and shaft torque for the force that the follower requires along its motion.

    contact  contact points and directions
    ds       s' [m/rad; 1 of an arm]        force    required along the motion [N; N m of an arm], `FollowerLoad.force`
    sliding  coefficient of friction between cam and follower; 0 for a roller
    guide    coefficient of friction in a straight guide; 0 for an arm
    Force and torque are NaN where the follower jams.
    """
    forward = 1j * np.asarray(contact.normal)
    slip = dot(1j * np.asarray(contact.point) - ds * contact.velocity, forward)
    sense = np.where(np.asarray(force) < 0, -1.0, 1.0)
    push = contact.normal + sense * sliding * np.sign(slip) * forward
    resisted = sense * guide * np.abs(cross(contact.velocity, push)) * np.sign(ds)
    along = dot(push, contact.velocity) - resisted
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = np.where(along > 0, force / along, np.nan)
    return ContactForce(np.asarray(normal), np.asarray(normal * cross(contact.point, push)), np.asarray(along))
