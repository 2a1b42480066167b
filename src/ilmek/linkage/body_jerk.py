"""The third rate of motion: how a rigid body carries the jerk of its points.

    p''' = a''' + (i (beta - w^3) - 3 w alpha) r,    beta = alpha'

with a the motion of the body's anchor and r the arm from it: the acceleration's equation differentiated once more. It
is computed on request only.
"""

from ilmek.arrays import ComplexField, RealField
from ilmek.linkage.body_motion import STILL, BodyMotion
from ilmek.records import record


def carried_jerk(
    jerk: ComplexField, arm: ComplexField, omega: RealField, alpha: RealField, beta: RealField
) -> ComplexField:
    """Jerk [m/s^3] of a body's point at `arm` r [m] from one with the jerk a'''.

    >>> carried_jerk(1j, 2 + 0j, 3.0, 4.0, 5.0)
    (-72-43j)
    """
    return jerk + (1j * (beta - omega * omega * omega) - 3 * omega * alpha) * arm


def slid_jerk(  # noqa: PLR0917 - arguments in the order of the equation
    e: ComplexField,
    omega: RealField,
    alpha: RealField,
    beta: RealField,
    s: ComplexField,
    ds: ComplexField,
    dds: ComplexField,
    ddds: ComplexField,
) -> ComplexField:
    """Third rate [m/s^3] of the displacement s e along a direction e that turns at w; s [m] may be complex.

    (s e)''' = (s''' - 3 w^2 s' - 3 w alpha s + i (beta s + 3 alpha s' + 3 w s'' - w^3 s)) e
    >>> slid_jerk(1j, 3.0, 4.0, 0.0, 2.0, 5.0, 7.0, 1.0)
    (-69-206j)
    """
    rate = ddds - 3 * omega * (omega * ds + alpha * s)
    return (rate + 1j * (beta * s + 3 * alpha * ds + 3 * omega * dds - omega * omega * omega * s)) * e


@record
class BodyJerk:
    """A body's motion with its jerk: that of its anchor [m/s^3], and beta = alpha' [rad/s^3]."""

    motion: BodyMotion
    anchor: ComplexField
    beta: RealField

    def carry(self, local: complex, further: complex = 0j) -> ComplexField:
        """Jerk [m/s^3] of the point `further` from `local` [m] in the body's frame."""
        arm = (local - self.motion.at) + further
        return self.anchor if arm == 0 else self.reach(self.motion.direction * arm)

    def reach(self, arm: ComplexField) -> ComplexField:
        """Jerk [m/s^3] of the body's point at `arm` [m] from the anchor, in world directions."""
        return carried_jerk(self.anchor, arm, self.motion.omega, self.motion.alpha, self.beta)


STILL_JERK = BodyJerk(STILL, 0j, 0.0)
"""Jerk of the ground: zero."""
