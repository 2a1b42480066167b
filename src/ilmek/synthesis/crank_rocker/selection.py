"""Selection of a crank-rocker of the family: allowed parameters, and defaults by three criteria.

The three criteria of [paper] (see `dead_centres`), in their order:

1. Grashof condition, strictly: every member inside the open intervals of `dead_centres` meets it.
2. Transmission angle: its deviation from 90 deg is at most 40 deg, otherwise at most 50 deg.
3. Ratio crank / coupler: the greatest one up to 0.3. A greater ratio gives a stronger beat-up, but too great a ratio
   causes vibration of the loom [paper, criterion ii, after Talavasek and Svaty]. Below 0.1 the linkage is small
   compared with its ground link.

For any swing and ratio the centric crank-rocker, phi = 180 deg, has the greatest transmission angle: the two extremes
of the angle are equal there. So `CENTRIC` is the default rotation of the crank.
"""

import math
from dataclasses import dataclass

import scipy

from ilmek.arrays import RealField
from ilmek.errors import ParameterError
from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    best_ratio,
    beta_limits,
    beta_of_ratio,
    links_of_beta,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
    transmission_angle_min,
)
from ilmek.units import deg, format_quantity

CENTRIC = math.pi
"""Rotation of the crank between dead centres with the best transmission angle at any ratio [rad]."""

DEVIATIONS = (40 * deg, 50 * deg)
"""Allowed deviations of the transmission angle from 90 deg [rad], the preferred one first [paper, criterion i]."""

RATIO_LIMIT = 0.3
"""Greatest ratio crank / coupler in use by loom makers [paper, criterion ii]."""

RATIO_FLOOR = 0.1
"""Least ratio crank / coupler that is selected by default."""

SAME_ANGLE = 1e-9
"""Difference below which angles count as equal [rad]: at phi = pi + psi the free parameter of the family changes."""


@dataclass(frozen=True, slots=True)
class Member:
    """A crank-rocker of the family: link lengths [ground links] and crank angle beta of the beat-up [rad]."""

    crank: float
    coupler: float
    rocker: float
    beta: float

    @property
    def links(self) -> LinkRatios:
        """Link lengths [ground links]."""
        return LinkRatios(self.crank, self.coupler, self.rocker)


def member(swing: float, rotation: float = CENTRIC, beta: float | None = None) -> Member:
    """The crank-rocker with a given swing and rotation of the crank.

    swing, rotation  psi, phi [rad]
    beta             crank angle of the extended dead centre [rad]; default: selected by the three criteria

    At phi = pi + psi only beta = pi - phi/2 exists and the coupler is free. With this beta given, the member with the
    greatest transmission angle, b = sqrt(a(1+a)), is selected [paper, Eq 12].

    Raises ParameterError, with the allowed interval in degrees, where no such crank-rocker exists.

    >>> round(member(30 * deg).beta / deg, 4)
    48.2299
    """
    require_rotation(swing, rotation)
    if beta is None:
        return _of_ratio(swing, rotation, select_ratio(swing, rotation))
    if _coupler_is_free(swing, rotation):
        _require_forced_beta(rotation, beta)
        return _of_ratio(swing, rotation, float(best_ratio(swing, rotation)))
    _require_beta(swing, rotation, beta)
    crank, coupler, rocker = links_of_beta(swing, rotation, beta)
    return Member(float(crank), float(coupler), float(rocker), beta)


def select_ratio(swing: float, rotation: float = CENTRIC, limit: float = RATIO_LIMIT) -> float:
    """Ratio crank / coupler by the three criteria: the greatest up to `limit` with an allowed transmission angle.

    swing, rotation  psi, phi [rad]

    The least transmission angle has one maximum over the ratio (`best_ratio`), so the allowed ratios form an interval.
    If it is empty, the ratio with the best transmission angle is returned.
    """
    least = max(RATIO_FLOOR, float(ratio_limits(swing, rotation).low))
    best = max(least, float(best_ratio(swing, rotation)))

    def excess(ratio: float, deviation: float) -> float:
        return float(transmission_angle_min(links_of_ratio(swing, rotation, ratio))) - (math.pi / 2 - deviation)

    for deviation in DEVIATIONS if least < limit else ():
        if excess(limit, deviation) >= 0:
            return limit
        if best < limit and excess(best, deviation) >= 0:
            return float(scipy.optimize.brentq(excess, best, limit, args=(deviation,), xtol=1e-15))
    return best


def require_rotation(swing: float, rotation: float) -> None:
    """Raise ParameterError unless crank-rockers with this swing and rotation of the crank [rad] exist."""
    if not 0 < swing < math.pi:
        raise ParameterError(f"swing={_shown(swing)} is out of bounds", allowed="allowed: above 0 deg, below 180 deg")
    low, high = rotation_limits(swing)
    if not low + SAME_ANGLE < rotation < high - SAME_ANGLE:
        raise ParameterError(
            f"no crank-rocker has swing={_shown(swing)} with crank_rotation={_shown(rotation)}",
            allowed=f"allowed: above {_shown(low)}, below {_shown(high)}",
            do=f"{_shown(CENTRIC)} gives the best transmission angle",
        )


def _coupler_is_free(swing: float, rotation: float) -> bool:
    return abs(rotation - math.pi - swing) < SAME_ANGLE


def _require_forced_beta(rotation: float, beta: float) -> None:
    forced = math.pi - rotation / 2
    # A value given in degrees with four decimals counts as the forced one.
    if abs(beta - forced) > 1e-4 * deg:
        raise ParameterError(
            f"beta={_shown(beta)} does not exist at crank_rotation = 180 deg + swing = {_shown(rotation)}",
            allowed=f"allowed: only {_shown(forced)}; the coupler is free there instead",
            do="omit beta",
        )


def _require_beta(swing: float, rotation: float, beta: float) -> None:
    low, high = beta_limits(swing, rotation)
    if not low + SAME_ANGLE < beta < high - SAME_ANGLE:
        slip = " (a bare number is in radians)" if beta > math.pi and low < beta * deg < high else ""
        raise ParameterError(
            f"beta={_shown(beta)} gives no crank-rocker for swing={_shown(swing)}, crank_rotation={_shown(rotation)}",
            allowed=f"allowed: above {_shown(low)}, below {_shown(high)}; at the ends it is at a toggle position",
            do=f"omit beta to have it selected{slip}",
        )


def _of_ratio(swing: float, rotation: float, ratio: float) -> Member:
    crank, coupler, rocker = links_of_ratio(swing, rotation, ratio)
    return Member(float(crank), float(coupler), float(rocker), float(beta_of_ratio(swing, rotation, ratio)))


def _shown(angle: RealField) -> str:
    return format_quantity(float(angle), "deg", digits=6)
