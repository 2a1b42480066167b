"""A pin with radial clearance: a journal free in its bearing, contact by a compliant law, Coulomb friction.

    e = P_journal - P_bearing,   n = e / |e|,   penetration  d = |e| - c,   contact while d > 0
    F = K d^m (1 + h d' / v),    v = the contact's approach speed          [Hunt and Crossley, J. Appl. Mech. 42 (1975)]
    friction  mu F u / sqrt(u² + u_s²),  u = sliding speed at the contact point, u_s = `slip`

The journal feels -F n and the friction against its sliding, the bearing the opposite at the same point. v is the
greatest |d'| since the contact began: in an impact that is the speed it began with, in a pin pressed for long it keeps
the factor between 1 - h and 1 + h. It is taken no less than a quarter of the speed with which the two bodies, free,
would go as deep, (2 K d^(m+1) / ((m+1) M))^½: a free impact never feels that, a journal that comes to lie on its
bearing is damped at most about critically instead of without limit. The factor never falls below 0: nothing is pulled.
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
    """Hysteresis h that gives the restitution e exactly, at any speed and any exponent.

        h (1 + e) = ln((1 + h) / (1 - h e)),    0 < h < 1 / e

    From m d'' = -K d^m (1 + h d'/v): ∫ u du / (1 + h u), u = d'/v from -e to 1, vanishes, whatever K and m are.

    >>> round(exact_hysteresis(0.5), 6), exact_hysteresis(1.0)
    (1.432751, 0.0)
    """
    e = restitution
    cubic = (1 + e**3) / 3
    # To fourth order in h; nearer to e = 1 the logarithms cancel to nothing else.
    first = (1 - e**2) / 2 / cubic
    if e > NEARLY_ELASTIC:
        return first + first**2 * (1 - e**4) / 4 / cubic

    def apart(u: float) -> float:
        h = -math.expm1(-u) / e
        return math.log1p(h) + u - h * (1 + e)

    return -math.expm1(-float(scipy.optimize.brentq(apart, 0.1 * e * first, 1 / e + 2, xtol=1e-300, rtol=1e-15))) / e


def flores_hysteresis(restitution: float) -> float:
    """Hysteresis h = 8 (1 - e) / (5 e)  [Flores, Machado, Silva and Martins, Multibody Syst. Dyn. 25 (2011)]."""
    return 8 * (1 - restitution) / (5 * restitution)


def lankarani_hysteresis(restitution: float) -> float:
    """Hysteresis h = 3 (1 - e²) / 4, for e near 1  [Lankarani and Nikravesh, J. Mech. Design 112 (1990)]."""
    return 0.75 * (1 - restitution**2)


LAWS: Mapping[str, Callable[[float], float]] = MappingProxyType(
    {"exact": exact_hysteresis, "flores": flores_hysteresis, "lankarani-nikravesh": lankarani_hysteresis}
)
"""Hysteresis of each contact law as a function of the restitution."""


def hertz_stiffness(radius: float, clearance: float, modulus: float, poisson: float = 0.3) -> float:
    """Contact stiffness K [N/m^1.5] of a journal of `radius` [m] in a bearing of radius + clearance, of one material.

        K = 4 / (3 (s + s)) sqrt(R_b R_j / (R_b - R_j)),    s = (1 - nu²) / E

    modulus  Young's, E [Pa]; of two materials E1, E2 that with 2 / E = 1 / E1 + 1 / E2, nu alike
    [Lankarani and Nikravesh, 1990; Hertz's law of two spheres, customary for journals of ordinary length]

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
    """A pin with radial clearance, in place of a `Pin` of a `System`.

    first, second  the bearing's body and the journal's; both carry a point of the pin's name, their centres
    clearance      bearing's radius less the journal's, c [m]      radius  of the journal [m]
    stiffness      K [N/m^exponent], see `hertz_stiffness`         exponent  m, 1.5 by Hertz, 1 for a straight law
    restitution    e, above 0 to 1                                 law  of the hysteresis h, one of `LAWS`
    friction       mu                                              slip  u_s: friction fades below it [m/s]

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
            self._demand(what, math.isfinite(getattr(self, what)) and getattr(self, what) > 0, "finite and above 0")
        self._demand("restitution", 0 < self.restitution <= 1, "above 0, to 1")
        self._demand("friction", 0 <= self.friction < math.inf, "finite, not negative")
        self._demand("exponent", 1 <= self.exponent <= 3, "1 to 3")
        self._demand("law", self.law in LAWS, " or ".join(LAWS))

    @property
    def bodies(self) -> tuple[str, str]:
        """The two bodies: the bearing's and the journal's."""
        return self.first, self.second

    @property
    def hysteresis(self) -> float:
        """Hysteresis h of the law at this restitution."""
        return LAWS[self.law](self.restitution)

    def elastic_energy(self, depth: FloatArray) -> FloatArray:
        """Energy stored at a penetration [J]: K d^(m+1) / (m + 1); none in flight."""
        stored: FloatArray = self.stiffness * np.maximum(depth, 0.0) ** (self.exponent + 1) / (self.exponent + 1)
        return stored

    def _demand(self, what: str, fulfilled: bool, allowed: str) -> None:
        if not fulfilled:
            raise MechanismError(f"{what} of clearance pin {self.name!r} is {getattr(self, what)}", allowed=allowed)
