"""A pin with radial clearance: a journal free in its bearing, contact by a compliant law, Coulomb friction.

    e = P_journal - P_bearing,   n = e / |e|,   penetration  d = |e| - c,   contact while d > 0
    F = K d^m (1 + h d' / v),    v approach speed of the contact           [Hunt and Crossley, J. Appl. Mech. 42 (1975)]
    friction  mu F u / sqrt(u² + u_s²),  u = sliding speed at the contact point, u_s = `slip`

-F n and the friction act on the journal; the opposite acts on the bearing at the same point. v is the greatest |d'|
since the contact began: in an impact its initial speed; in a lasting contact it keeps the factor between 1 - h and
1 + h. Lower bound of v: a quarter of the impact speed at which the free bodies would reach the same penetration,
(2 K d^(m+1) / ((m+1) M))^½. It does not affect a free impact. It limits the damping of a journal at rest on its bearing
to about the critical damping. The factor is never below 0: the contact does not pull.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import scipy

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError

NEARLY_ELASTIC = 0.999
"""Restitution above which the exact hysteresis is taken from its series."""


def exact_hysteresis(restitution: float) -> float:
    """Hysteresis h [1] that gives the coefficient of restitution e exactly, at any speed and any exponent.

        h (1 + e) = ln((1 + h) / (1 - h e)),    0 < h < 1 / e

    From M d'' = -K d^m (1 + h d'/v): ∫ u du / (1 + h u) over u = d'/v from -e to 1 is zero, for any K and m. Above
    e = 0.999 its series is used.

    >>> round(exact_hysteresis(0.5), 6), exact_hysteresis(1.0)
    (1.432751, 0.0)
    """
    e = restitution
    cubic = (1 + e**3) / 3
    # Series to fourth order in h: the logarithms cancel near e = 1.
    first = (1 - e**2) / 2 / cubic
    if e > NEARLY_ELASTIC:
        return first + (first**2 * (1 - e**4) / 4 - first**3 * (1 + e**5) / 5) / cubic

    def residual(u: float) -> float:
        h = -math.expm1(-u) / e
        return math.log1p(h) + u - h * (1 + e)

    return -math.expm1(-float(scipy.optimize.brentq(residual, 0.1 * e * first, 1 / e + 2, xtol=1e-300, rtol=1e-15))) / e


def flores_hysteresis(restitution: float) -> float:
    """Hysteresis h = 8 (1 - e) / (5 e) [1]  [Flores, Machado, Silva and Martins, Multibody Syst. Dyn. 25 (2011)]."""
    return 8 * (1 - restitution) / (5 * restitution)


def lankarani_hysteresis(restitution: float) -> float:
    """Hysteresis h = 3 (1 - e²) / 4 [1], for e near 1  [Lankarani and Nikravesh, J. Mech. Design 112 (1990)]."""
    return 0.75 * (1 - restitution**2)


LAWS: Mapping[str, Callable[[float], float]] = MappingProxyType(
    {"exact": exact_hysteresis, "flores": flores_hysteresis, "lankarani-nikravesh": lankarani_hysteresis}
)
"""Hysteresis of each contact law as a function of the coefficient of restitution."""


def hertz_stiffness(radius: float, clearance: float, modulus: float, poisson: float = 0.3) -> float:
    """Contact stiffness K [N/m^1.5] of a journal in a bearing of the same material.

        K = 4 / (3 (s + s)) sqrt(R_b R_j / (R_b - R_j)),    s = (1 - nu²) / E

    radius     of the journal, R_j [m]      clearance  radial, R_b - R_j [m]
    modulus    Young's modulus E [Pa]; for two materials with the same nu: 2 / E = 1 / E1 + 1 / E2
    poisson    Poisson's ratio nu [1]

    Raises MechanismError for a radius, clearance or modulus that is not above 0, and a ratio outside 0 to 0.5.
    [Lankarani and Nikravesh, J. Mech. Design 112 (1990); Hertz's law of two spheres, customary for journals]

    >>> f"{hertz_stiffness(9.5e-3, 0.5e-3, 207e9):.3g}"
    '6.61e+10'
    """
    bearing = radius + clearance
    if not (
        min(radius, clearance, modulus) > 0 and math.isfinite(radius * clearance * modulus) and 0 <= poisson <= 0.5
    ):
        raise MechanismError(
            f"journal of radius {radius:g} m, clearance {clearance:g} m, modulus {modulus:g} Pa, Poisson {poisson:g}",
            allowed="radius, clearance, modulus above 0; Poisson's ratio 0 to 0.5",
        )
    softness = 2 * (1 - poisson**2) / modulus
    return 4 / (3 * softness) * math.sqrt(bearing * radius / clearance)


@dataclass(frozen=True, slots=True)
class ClearancePin:
    """A pin with radial clearance, instead of a `Pin` of a `System`.

    first, second  names of the bearing's and the journal's body; each has a point of the pin's name, its centre
    clearance      radial clearance c: bearing radius minus journal radius [m]
    radius         of the journal [m]
    stiffness      K [N/m^exponent], see `hertz_stiffness`         exponent  m: 1.5 by Hertz, 1 for a linear law
    restitution    e, above 0, at most 1                           law       of the hysteresis h, one of `LAWS`
    friction       mu [1]                                          slip      u_s [m/s]; friction fades below it

    Raises MechanismError for numbers outside these ranges.
    """

    name: str
    first: str
    second: str
    clearance: float
    radius: float
    stiffness: float
    restitution: float = 0.9
    friction: float = 0.0
    exponent: float = 1.5
    slip: float = 0.01
    law: str = "exact"

    def __post_init__(self) -> None:
        for what in ("clearance", "radius", "stiffness", "slip"):
            self._require(what, math.isfinite(getattr(self, what)) and getattr(self, what) > 0, "finite and above 0")
        self._require("restitution", 0 < self.restitution <= 1, "above 0, to 1")
        self._require("friction", 0 <= self.friction < math.inf, "finite, not negative")
        self._require("exponent", 1 <= self.exponent <= 3, "1 to 3")
        self._require("law", self.law in LAWS, " or ".join(LAWS))

    @property
    def bodies(self) -> tuple[str, str]:
        """The two bodies: the bearing's and the journal's."""
        return self.first, self.second

    @property
    def hysteresis(self) -> float:
        """Hysteresis h of the law at this restitution."""
        return LAWS[self.law](self.restitution)

    def elastic_energy(self, depth: FloatArray) -> FloatArray:
        """Elastic energy at penetrations [m]: K d^(m+1) / (m + 1) [J]; 0 without contact."""
        stored: FloatArray = self.stiffness * np.maximum(depth, 0.0) ** (self.exponent + 1) / (self.exponent + 1)
        return stored

    def _require(self, what: str, fulfilled: bool, allowed: str) -> None:
        if not fulfilled:
            raise MechanismError(f"{what} of clearance pin {self.name!r} is {getattr(self, what)}", allowed=allowed)
