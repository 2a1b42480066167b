"""Moments of a plane section, bounded by straight pieces and arcs, exact to rounding.

    M(p, q) = integral of x^p y^q dA = 1/(p + 1) closed integral of x^(p + 1) y^q dy            [Green's theorem]

On a straight piece the integrand is a polynomial, for which Gauss' rule is exact; on an arc it is a trigonometric
polynomial of its angle of degree p + q + 2, for which `_NODES` nodes leave less than rounding over a whole turn.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.plane.contours import STRAIGHT, area, as_hole, circle, counter_clockwise
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.report import Contour, Hole

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)
_SHARE, _WEIGHT = (_NODES + 1) / 2, _WEIGHTS / 2

_ORDERS = 4
"""Moments of orders below this."""

_FEW_NODES, _FEW_WEIGHTS = np.polynomial.legendre.leggauss(3)
_FEW_SHARE, _FEW_WEIGHT = (_FEW_NODES + 1) / 2, _FEW_WEIGHTS / 2  # exact to degree 5: of straight pieces


@record
class Profile:
    """A plane figure: all within its outline that is in none of its holes [m].

    outline  closed, in either direction        holes  closed, inside the outline, apart from each other
    smooth   the corners of the outline are points of a curve, so near that arcs can be laid through them

    Raises ParameterError where its area is not above 0.
    """

    outline: Contour
    holes: tuple[Contour, ...] = ()
    smooth: bool = False

    def __post_init__(self) -> None:
        if not self.area > 0:
            raise ParameterError(
                f"a section of {self.area:g} m²", allowed="above 0", do="set holes that lie within the outline"
            )

    @property
    def contours(self) -> tuple[Contour, ...]:
        """Its outline counter-clockwise, and its holes clockwise: the section lies to the left of each."""
        return (counter_clockwise(self.outline), *(_clockwise(hole) for hole in self.holes))

    @property
    def least_wall(self) -> float:
        """Of a disc from its edge to the corners of its holes [m]: how far chords may lie inside of it; else inf."""
        disc = as_hole(self.outline)
        if disc is None:
            return math.inf
        farthest = (float(np.abs(hole.points - disc.at).max()) for hole in self.holes)
        return min((disc.radius - far for far in farthest), default=math.inf)

    @property
    def area(self) -> float:
        """Area [m²]."""
        return _area(self)

    def moment(self, p: int, q: int) -> float:
        """Moment M(p, q) about the origin [m^(p + q + 2)], p + q of 0 to 3.

        >>> round(Profile(circle(0j, 1.0)).moment(2, 0) / math.pi, 12)
        0.25
        """
        return _moments(self)[p, q]


@lru_cache(maxsize=4096)
def _area(profile: Profile) -> float:
    return abs(area(profile.outline)) - math.fsum(abs(area(hole)) for hole in profile.holes)


def drilled(outline: Contour, holes: Sequence[Hole], cutouts: Sequence[Contour] = ()) -> Profile:
    """The section of a plate with round holes and other cutouts."""
    return Profile(outline, (*(circle(hole.at, hole.radius) for hole in holes), *cutouts))


def _clockwise(contour: Contour) -> Contour:
    turned = counter_clockwise(contour)
    return Contour(turned.points[::-1], -following(turned.bulges[::-1]))


@lru_cache(maxsize=1024)
def _moments(profile: Profile) -> Mapping[tuple[int, int], float]:
    """All moments up to the third order."""
    each = [_contour_moments(contour) for contour in profile.contours]
    return {order: math.fsum(moments[order] for moments in each) for order in each[0]}


def _contour_moments(contour: Contour) -> Mapping[tuple[int, int], float]:
    """The moments of all within a contour, negative for a clockwise one."""
    share, weight = (_SHARE, _WEIGHT) if contour.bulges.any() else (_FEW_SHARE, _FEW_WEIGHT)
    point, step = _pieces(contour, share)
    moments, x = {}, step.imag * weight
    for p in range(_ORDERS):
        x = x * point.real
        across = x
        for q in range(_ORDERS - p):
            moments[p, q] = float(np.add.reduce(across, axis=None)) / (p + 1)
            across = across * point.imag
    return moments


def line_moment(contour: Contour) -> float:
    """Moment of a contour's line about the x axis, integral of y ds [m²]: 2 pi of it is the surface turned about x.

    >>> round(2 * math.pi * line_moment(circle(3j, 1.0)) / (4 * math.pi**2 * 3.0), 12)
    1.0
    """
    point, step = _pieces(contour, _SHARE)
    return float(np.sum(point.imag * np.abs(step) * _WEIGHT))


def _pieces(contour: Contour, share: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """Points of each piece at shares of it [m], and their derivatives by the share, (pieces, shares)."""
    start = contour.points[:, None]
    chord = following(contour.points)[:, None] - start
    if not contour.bulges.any():
        return start + chord * share, np.broadcast_to(chord, (len(chord), len(share)))
    bulge: FloatArray = contour.bulges[:, None]
    straight = np.abs(bulge) < STRAIGHT
    half = 2 * np.arctan(np.where(straight, 1.0, bulge))  # half of the sweep
    turned = np.exp(-1j * half * (1 - share)) / np.sin(half)
    along = np.where(straight, share, turned * np.sin(half * share))
    speed = np.where(straight, 1.0, turned * half * np.exp(1j * half * share))
    return start + chord * along, chord * speed
