"""Motion of crank-rockers: speed and acceleration of the rocker and their greatest values, for arrays of linkages.

Frame and names are those of `dead_centres`: ground D = 0 to A = 1, crank DC = a, coupler CB = b, rocker AB = c, B above
the ground line. The crank has the constant speed omega = 1: angular velocities are in omega, angular accelerations in
omega^2, counter-clockwise. The formulas are those of the RRR dyad in `linkage` [Norton, Design of Machinery, sections
4.5, 6.7, 7.3].
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, IntArray, RealField
from ilmek.linkage.groups import rrr
from ilmek.num.periodic_maxima import periodic_maxima
from ilmek.synthesis.crank_rocker.dead_centres import LinkRatios, dead_centres

PIVOT = 1 + 0j
"""Pivot A of the rocker; the pivot of the crank is the origin, and the ground link the unit of length."""


class CrankRockerMotion(NamedTuple):
    """A crank-rocker at crank angles, at unit speed of the crank.

    pin              position of the crank pin C [ground links], complex
    coupler, rocker  vectors C -> B and A -> B [ground links], complex
    lean             coupler x rocker: b c sin(transmission angle)
    omega, alpha     angular velocity [omega] and acceleration [omega^2] of coupler and of rocker
    """

    pin: ComplexField
    coupler: ComplexField
    rocker: ComplexField
    lean: RealField
    omega: tuple[RealField, RealField]
    alpha: tuple[RealField, RealField]


class RockerExtremes(NamedTuple):
    """Greatest magnitudes over a turn of the rocker's angular velocity [omega] and acceleration [omega^2]."""

    speed: FloatArray
    acceleration: FloatArray


def moved(links: LinkRatios, angle: RealField) -> CrankRockerMotion:
    """Motion of crank-rockers at crank angles [rad]; links [ground links] and angles of any shapes that broadcast.

    [position, velocity and acceleration of the RRR dyad attached to the crank pin and to A]

    >>> at = moved(LinkRatios(0.25, 0.7, 0.75), 0.3)
    >>> ahead, behind = (np.angle(moved(LinkRatios(0.25, 0.7, 0.75), 0.3 + h).rocker) for h in (1e-6, -1e-6))
    >>> bool(abs((ahead - behind) / 2e-6 - at.omega[1]) < 1e-9)
    True
    """
    crank, coupler, rocker = links
    pin = crank * np.exp(1j * np.asarray(angle))
    joint = rrr.position(pin, PIVOT, coupler, rocker, 1)
    u, v = joint - pin, joint - PIVOT
    lean = rrr.turning(u, v)
    per_lean = 1 / lean
    slip = -1j * pin
    omega = rrr.first_rate(v, slip, per_lean), rrr.second_rate(u, slip, per_lean)
    pull = rrr.relative_acceleration(-pin, 0j, u, v, *omega)
    alpha = rrr.first_rate(v, pull, per_lean), rrr.second_rate(u, pull, per_lean)
    return CrankRockerMotion(pin, u, v, lean, omega, alpha)


def sharp_angles(links: LinkRatios) -> FloatArray:
    """Crank angles near which motion and forces may have narrow peaks [rad], shape (..., 4).

    They are 0 and pi, where the crank is on the ground line and the transmission angle is least or greatest, and the
    dead centres; the folded one has a high acceleration where coupler and crank are nearly equal.
    """
    beta, back = dead_centres(links).beta, dead_centres(links).beta + dead_centres(links).rotation
    zero = np.zeros_like(np.asarray(beta, dtype=float))
    found: FloatArray = np.nan_to_num(np.stack([zero, zero + np.pi, zero + beta, zero + back], axis=-1))
    return found


def rocker_extremes(links: LinkRatios) -> RockerExtremes:
    """Greatest angular speed and acceleration of the rocker at unit speed of the crank, one value per member.

    links  [ground links], shape (members,); the crank must rotate fully

    The suprema are accurate to about 1e-9, see `num.periodic_maxima`.

    >>> float(rocker_extremes(LinkRatios(*np.array([[0.2], [0.66], [0.77]]))).speed[0].round(4))
    0.2778
    """
    columns = [np.asarray(link, dtype=float) for link in links]

    def curves(row: IntArray, angle: FloatArray) -> dict[str, FloatArray]:
        at = moved(LinkRatios(*(column[row] for column in columns)), angle)
        return {"speed": np.abs(at.omega[1]), "acceleration": np.abs(at.alpha[1])}

    return RockerExtremes(**periodic_maxima(curves, sharp_angles(LinkRatios(*columns))))


def beat_acceleration(links: LinkRatios) -> RealField:
    """Angular acceleration of the rocker at the extended dead centre [omega^2].

        alpha = a (a + b) / (b c sin mu) > 0: away from the beat-up,   mu the angle between coupler and rocker there

    [centripetal accelerations of crank pin and coupler, both along the line D, C, B: omega^2 a and, because the coupler
    rotates at -omega a / b, omega^2 a^2 / b; their sum divided by sin mu is the tangential acceleration of B]
    """
    crank, coupler, rocker = links
    straight = crank + coupler
    # Twice the area of D, A, B, whose angle at B is mu [Heron's formula].
    area = np.sqrt((straight + rocker) ** 2 - 1) * np.sqrt(1 - (straight - rocker) ** 2) / 2
    return crank * straight**2 / (coupler * area)
