"""Rolling bearings: what slope they bear, how long they live, which is enough.

    L = a1 (C / P)^p 10^6 revolutions,   p = 3 of balls, 10/3 of rollers                       [ISO 281:2007, 5 to 9]
    P = X Fr + Y Fa,                     s0 = C0 / P0                                          [ISO 281, 76]

C, C0 load ratings, P equivalent load, Fr radial and Fa axial load [N], a1 for a reliability above 90 %. Lubrication and
cleanliness (the standard's factor a_ISO) are taken as ordinary: 1.

>>> [bearing.name for bearing in bearings_for(0.0008)]
['deep-groove ball', 'cylindrical roller']
>>> ucf = find_bearing("UCF 207")
>>> ucf.dynamic, ucf.static
(25700.0, 15400.0)
>>> round(life(ucf.dynamic, 4500.0, ucf.kind) / 1e6, 3)
186.278
"""

from dataclasses import dataclass

import numpy as np

from ilmek.elements.bearing_table import CYLINDRICAL, DEEP_GROOVE, INSERT, ROLLING_BEARINGS, RollingBearing
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
    """A kind of rolling bearing and the largest slope [rad] between its shaft and its outer ring."""

    name: str
    slope_limit: float
    source: str


BEARINGS = (
    Bearing("deep-groove ball", 0.004, "thesis 3.1; makers say 2' to 10', 0.0006 to 0.003 rad, by clearance and load"),
    Bearing("cylindrical roller", 0.001, "thesis 3.1; makers say 3' to 4', 0.0009 to 0.0012 rad"),
    Bearing("tapered roller", 0.0005, "thesis 3.1"),
)
"""The thesis' limits. Its own UCF 207 is a deep-groove ball bearing with a spherical outside, which takes up a slope of
some degrees once, when it is mounted, and so only what the load adds later counts against the limit."""

RELIABILITY = {0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}
"""Life factor a1 by reliability [ISO 281:2007, table 12]."""

_AXIAL = (0.014, 0.021, 0.028, 0.042, 0.056, 0.070, 0.084, 0.110, 0.17, 0.28, 0.42, 0.56)
_E = (0.19, 0.21, 0.22, 0.24, 0.26, 0.27, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_Y = (2.30, 2.15, 1.99, 1.85, 1.71, 1.63, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
_X = 0.56


def bearings_for(slope: float) -> tuple[Bearing, ...]:
    """The kinds that bear a slope [rad]."""
    return tuple(bearing for bearing in BEARINGS if slope <= bearing.slope_limit)


def slope_limit(bearing: RollingBearing) -> float:
    """Largest slope [rad] that the bearing's kind bears; an insert bearing is a deep-groove ball bearing."""
    kind = DEEP_GROOVE if bearing.kind == INSERT else bearing.kind
    return next(known.slope_limit for known in BEARINGS if known.name == kind)


def find_bearing(name: str) -> RollingBearing:
    """The bearing of a designation; ParameterError, naming the nearest, where it is not in the table.

    >>> find_bearing("ucf207").name, find_bearing("nu 205").kind
    ('UCF 207', 'cylindrical roller')
    """
    return pick(ROLLING_BEARINGS, name, "bearing")


def life(dynamic: float, load: float, kind: str, reliability: float = 0.9) -> float:
    """Life [revolutions] under an equivalent load [N]: a1 (C / P)^p 10^6; endless without load.

    kind  "ball" or "roller", or a bearing's kind, which ends in one of them
    >>> life(5.0, 1.0, "ball"), round(life(5.0, 1.0, "roller") / 1e6, 5)
    (125000000.0, 213.74699)
    """
    power = 10 / 3 if kind.endswith("roller") else 3.0
    return float(reliability_factor(reliability) * (dynamic / load) ** power * 1e6) if load > 0 else float("inf")


def hours(revolutions: float, speed: float) -> float:
    """Hours of running for so many revolutions at a speed [rad/s]; endless at rest.

    >>> round(hours(125e6, 300 * 2 * np.pi / 60), 4)
    6944.4444
    """
    return revolutions * 2 * float(np.pi) / speed / 3600 if speed > 0 else float("inf")


def reliability_factor(reliability: float) -> float:
    """Life factor a1 for a reliability from 0.90 to 0.99, even between the table's."""
    if not 0.9 <= reliability <= 0.99:
        raise ParameterError(
            f"a reliability of {reliability:g} for a bearing's life",
            allowed="0.90 to 0.99",
            do="take one of 0.90 0.95 0.96 0.97 0.98 0.99",
        )
    return float(np.interp(reliability, list(RELIABILITY), list(RELIABILITY.values())))


def equivalent_load(bearing: RollingBearing, radial: float, axial: float = 0.0) -> float:
    """Dynamic equivalent load P [N]: Fr up to Fa / Fr = e, above it 0.56 Fr + Y Fa; e and Y by Fa / C0.

    Ball bearings with ordinary clearance; an insert bearing likewise, as far as its set screws hold the axial load.
    Raises ParameterError for an axial load on a NU, which has no ribs for it.   [Shigley, table 11-1; ISO 281, table 3]
    """
    radial, axial = abs(radial), abs(axial)
    if bearing.kind == CYLINDRICAL and axial > 0:
        raise ParameterError(
            f"an axial load of {axial:g} N on {bearing.name}", allowed="none", do="take a deep-groove ball bearing"
        )
    share = axial / bearing.static
    if axial <= radial * float(np.interp(share, _AXIAL, _E)):
        return radial
    return max(radial, _X * radial + float(np.interp(share, _AXIAL, _Y)) * axial)


def static_load(bearing: RollingBearing, radial: float, axial: float = 0.0) -> float:
    """Static equivalent load P0 [N]: the larger of Fr and 0.6 Fr + 0.5 Fa; Fr of a roller bearing [ISO 76, 5.2]."""
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
    """The lightest bearing of a kind that lives so many revolutions under loads [N]; None where none does.

    bore  least bore [m]      speed  that its grease must bear [rad/s]      static_safety  least C0 / P0
    >>> smallest_bearing(4500.0, 1e8, kind="insert ball", bore=0.03).name
    'UC 207'
    """

    def enough(one: RollingBearing) -> bool:
        lives = life(one.dynamic, equivalent_load(one, radial, axial), one.kind, reliability) >= revolutions
        bears = one.static >= static_safety * static_load(one, radial, axial)
        return one.bore >= bore * (1 - 1e-9) and one.speed >= speed and bears and lives

    offered = [one for one in ROLLING_BEARINGS.values() if one.kind == kind and enough(one)]
    return min(offered, key=lambda one: (one.mass, one.bore), default=None)
