"""Rolling bearings: allowed slope, rating life, selection.

    L = a1 (C / P)^p 10^6 revolutions,   p = 3 for balls, 10/3 for rollers                     [ISO 281:2007, 5 to 9]
    P = X Fr + Y Fa,                     s0 = C0 / P0                                          [ISO 281, 76]

C, C0 load ratings, P equivalent load, Fr radial and Fa axial load [N], a1 factor of a reliability above 90 %. The
factor a_ISO of lubrication and cleanliness is 1.

>>> [bearing.name for bearing in bearings_for(0.0008)]
['deep-groove ball', 'cylindrical roller']
>>> ucf = find_bearing("UCF 207")
>>> ucf.dynamic, ucf.static
(25700.0, 15400.0)
>>> round(life(ucf.dynamic, 4500.0, ucf.kind) / 1e6, 3)
186.278
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ilmek.elements.bearing_table import (
    CYLINDRICAL,
    DEEP_GROOVE,
    INSERT,
    ROLLING_BEARINGS,
    THIN_BEARINGS,
    RollingBearing,
)
from ilmek.elements.catalogue import pick
from ilmek.errors import ParameterError

__all__ = [
    "BEARINGS",
    "RELIABILITY",
    "ROLLING_BEARINGS",
    "Bearing",
    "RollingBearing",
    "bearings_for",
    "equivalent_load",
    "find_bearing",
    "hours",
    "life",
    "reliability_factor",
    "slope_limit",
    "smallest_bearing",
    "static_load",
]


@dataclass(frozen=True, slots=True)
class Bearing:
    """A kind of rolling bearing and the allowed slope [rad] between shaft and outer ring."""

    name: str
    slope_limit: float
    source: str


BEARINGS = (
    Bearing("deep-groove ball", 0.004, "thesis 3.1; makers give 2' to 10', 0.0006 to 0.003 rad, by clearance and load"),
    Bearing("cylindrical roller", 0.001, "thesis 3.1; makers give 3' to 4', 0.0009 to 0.0012 rad"),
    Bearing("tapered roller", 0.0005, "thesis 3.1"),
)
"""The thesis' limits. Its UCF 207 is a deep-groove ball bearing with a spherical outer ring, which aligns itself by
some degrees when it is mounted; only the slope due to the load counts against the limit."""

RELIABILITY = {0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}
"""Life factor a1 by reliability [ISO 281:2007, table 12]."""

_AXIAL = (0.014, 0.021, 0.028, 0.042, 0.056, 0.070, 0.084, 0.110, 0.17, 0.28, 0.42, 0.56)
_E = (0.19, 0.21, 0.22, 0.24, 0.26, 0.27, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_Y = (2.30, 2.15, 1.99, 1.85, 1.71, 1.63, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
_X = 0.56


def bearings_for(slope: float) -> tuple[Bearing, ...]:
    """The kinds that allow a slope [rad]."""
    return tuple(bearing for bearing in BEARINGS if slope <= bearing.slope_limit)


def slope_limit(bearing: RollingBearing) -> float:
    """Allowed slope [rad] of the bearing's kind; an insert bearing is a deep-groove ball bearing."""
    kind = DEEP_GROOVE if bearing.kind == INSERT else bearing.kind
    return next(known.slope_limit for known in BEARINGS if known.name == kind)


@lru_cache(maxsize=256)
def find_bearing(name: str) -> RollingBearing:
    """The bearing of a designation. Raises ParameterError with the nearest designation for an unknown one.

    >>> find_bearing("ucf207").name, find_bearing("nu 205").kind
    ('UCF 207', 'cylindrical roller')
    """
    return pick(ROLLING_BEARINGS | THIN_BEARINGS, name, "bearing")


def life(dynamic: float, load: float, kind: str, reliability: float = 0.9) -> float:
    """Life [revolutions] under an equivalent load: a1 (C / P)^p 10^6; infinite without load.

    dynamic  C [N]      load  P [N]      kind  "ball" or "roller", or a bearing's kind, which ends in one of them
    reliability  0.90 to 0.99. Raises ParameterError outside this range
    >>> life(5.0, 1.0, "ball"), round(life(5.0, 1.0, "roller") / 1e6, 5)
    (125000000.0, 213.74699)
    """
    power = 10 / 3 if kind.endswith("roller") else 3.0
    return float(reliability_factor(reliability) * (dynamic / load) ** power * 1e6) if load > 0 else float("inf")


def hours(revolutions: float, speed: float) -> float:
    """Running time [h] of a number of revolutions at a speed [rad/s]; infinite at rest.

    >>> round(hours(125e6, 300 * 2 * np.pi / 60), 4)
    6944.4444
    """
    return revolutions * 2 * float(np.pi) / speed / 3600 if speed > 0 else float("inf")


def reliability_factor(reliability: float) -> float:
    """Life factor a1 [1] for a reliability from 0.90 to 0.99, linear between the values of the table.

    Raises ParameterError outside this range.
    """
    if not 0.9 <= reliability <= 0.99:
        raise ParameterError(
            f"a reliability of {reliability:g} for a bearing's life",
            allowed="0.90 to 0.99",
            do="use one of 0.90 0.95 0.96 0.97 0.98 0.99",
        )
    return float(np.interp(reliability, list(RELIABILITY), list(RELIABILITY.values())))


def equivalent_load(bearing: RollingBearing, radial: float, axial: float = 0.0) -> float:
    """Dynamic equivalent load P [N] of a radial and an axial load [N].

    Fr up to Fa / Fr = e, above it 0.56 Fr + Y Fa, at least Fr; e and Y are functions of Fa / C0. For ball bearings with
    normal clearance, and insert bearings within the axial limit of their set screws.
    Raises ParameterError for an axial load on a NU, which has no ribs for it.   [Shigley, table 11-1; ISO 281, table 3]
    """
    radial, axial = abs(radial), abs(axial)
    if bearing.kind == CYLINDRICAL and axial > 0:
        raise ParameterError(
            f"an axial load of {axial:g} N on {bearing.name}", allowed="none", do="use a deep-groove ball bearing"
        )
    share = axial / bearing.static
    if axial <= radial * float(np.interp(share, _AXIAL, _E)):
        return radial
    return max(radial, _X * radial + float(np.interp(share, _AXIAL, _Y)) * axial)


def static_load(bearing: RollingBearing, radial: float, axial: float = 0.0) -> float:
    """Static equivalent load P0 [N]: the larger of Fr and 0.6 Fr + 0.5 Fa; Fr for a roller bearing [ISO 76, 5.2]."""
    if bearing.kind == CYLINDRICAL:
        return abs(radial)
    return max(abs(radial), 0.6 * abs(radial) + 0.5 * abs(axial))


def smallest_bearing(
    radial: float,
    revolutions: float,
    *,
    axial: float = 0.0,
    kind: str = DEEP_GROOVE,
    bore: float = 0.0,
    speed: float = 0.0,
    reliability: float = 0.9,
    static_safety: float = 1.0,
) -> RollingBearing | None:
    """The lightest bearing of a kind with the required life under a load; None if none has it.

    radial, axial  load [N]             revolutions  required life        bore  least bore [m]
    speed          required [rad/s]     reliability  0.90 to 0.99         static_safety  least C0 / P0
    >>> smallest_bearing(4500.0, 1e8, kind="insert ball", bore=0.03).name
    'UC 207'
    """

    def is_sufficient(one: RollingBearing) -> bool:
        lasts = life(one.dynamic, equivalent_load(one, radial, axial), one.kind, reliability) >= revolutions
        carries = one.static >= static_safety * static_load(one, radial, axial)
        return one.bore >= bore * (1 - 1e-9) and one.speed >= speed and carries and lasts

    offered = [bearing for bearing in ROLLING_BEARINGS.values() if bearing.kind == kind and is_sufficient(bearing)]
    return min(offered, key=lambda one: (one.mass, one.bore), default=None)
