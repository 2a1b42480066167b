"""How a rigid body carries its points.

    p = a + r,    p' = a' + i w r,    p'' = a'' + (i alpha - w^2) r,     r = e (local - anchor)

with a the motion of the body's anchor, e its direction (unit complex), w and alpha its angular velocity and
acceleration [Norton, Design of Machinery, chapters 4, 6, 7: the complex vector method].
"""

from ilmek.arrays import ComplexField, RealField
from ilmek.records import record


def carried_velocity(velocity: ComplexField, arm: ComplexField, omega: RealField) -> ComplexField:
    """Velocity p' = a' + i w r [m/s] of a body's point at `arm` r [m] from one with the velocity a'.

    >>> carried_velocity(1j, 2 + 0j, 3.0)
    7j
    """
    return velocity + 1j * omega * arm


def carried_acceleration(
    acceleration: ComplexField, arm: ComplexField, omega: RealField, alpha: RealField
) -> ComplexField:
    """Acceleration p'' = a'' + (i alpha - w^2) r [m/s^2] of a body's point at `arm` r [m] from one with a''.

    >>> carried_acceleration(1j, 2 + 0j, 3.0, 4.0)
    (-18+9j)
    """
    return acceleration + (1j * alpha - omega * omega) * arm


@record
class PointMotion:
    """A point's position [m], velocity [m/s] and acceleration [m/s^2]: complex, one value or one per sample."""

    position: ComplexField
    velocity: ComplexField
    acceleration: ComplexField


@record
class BodyMotion:
    """A body's motion: the motion of one point, the anchor, and the rotation.

    anchor     motion of the anchor             at     position of the anchor in the body's frame [m]
    direction  unit complex e^{i theta}         omega  [rad/s]         alpha  [rad/s^2]
    """

    anchor: PointMotion
    at: complex
    direction: ComplexField
    omega: RealField
    alpha: RealField

    def carry(self, local: complex, further: complex = 0j) -> PointMotion:
        """Motion of the point `further` from `local` [m] in the body's frame."""
        arm = (local - self.at) + further  # in this order: both may be small, and `local` large
        still = isinstance(arm, complex) and arm == 0  # an array has one arm for each variant
        return self.anchor if still else self.reach(self.direction * arm)

    def reach(self, arm: ComplexField) -> PointMotion:
        """Motion of the body's point at `arm` [m] from the anchor, in world directions."""
        return PointMotion(
            self.anchor.position + arm,
            carried_velocity(self.anchor.velocity, arm, self.omega),
            carried_acceleration(self.anchor.acceleration, arm, self.omega, self.alpha),
        )


STILL = BodyMotion(PointMotion(0j, 0j, 0j), 0j, 1 + 0j, 0.0, 0.0)
"""The ground's motion."""
