"""Knots as curves: the path of the pile yarn, and of the gripper that guides its end, in the section across the warps.

For the pitch p, warp k is at (k - 1) p, and the pile is upwards. The yarn's axis keeps the radius

    r = (D + d)/2 + e         D warp's, d yarn's diameter, e clearance

about every warp that it wraps. Between two warps it follows their common tangent: the outer one where it turns about
both in the same sense, the inner one where it turns in opposite senses, at the angle alpha to the row, sin alpha =
2r/p. Both ends rise vertically from the height of the warps' axes to the height a. So the curve is a chain of straight
lines and arcs of curvature 0 and +-1/r with a continuous tangent. A piece of curvature kappa from a start z0 of heading
h is

    z(s) = z0 + s sinc(kappa s/2) exp(i (h + kappa s/2))        sinc x = sin x / x

Its length is 2 a and the wrap of its kind [`elements.knot_kinds`], for warps of any pitch p >= 2r. Between closer warps
the yarn does not fit and there is no such curve; `carpet.pile` still gives the length of yarn of the pressed knot.
[derived: geometry]
"""

import math
from dataclasses import dataclass, fields

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray, RealField
from ilmek.elements.knot_kinds import asymmetric_wrap, single_wrap, symmetric_wrap
from ilmek.errors import CarpetError
from ilmek.units import format_quantity, mm
from ilmek.weaving.knots.word import SINGLE, Knot, Word

_QUARTER, _HALF = math.pi / 2, math.pi


@dataclass(frozen=True, slots=True)
class KnotDimensions:
    """Dimensions of a knot's curve [m].

    pitch           p, of two warps                 clearance  e, between yarn and warp
    warp_diameter   D                               leg        a, height of both ends above the warps' axes
    yarn_diameter   d, of the pile yarn
    Raises CarpetError for numbers out of bounds, and for a pitch below 2r.
    """

    pitch: float
    warp_diameter: float
    yarn_diameter: float
    clearance: float = 0.0
    leg: float = 10 * mm

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (0 <= value < math.inf) or (value == 0 and field.name != "clearance"):
                raise CarpetError(
                    f"{field.name.replace('_', ' ')} {format_quantity(value, 'mm')} of a knot",
                    allowed="0 or more" if field.name == "clearance" else "more than 0",
                )
        least = 2 * self.radius
        if self.pitch < least * (1 - 1e-12):
            shown = [format_quantity(getattr(self, field.name), "mm") for field in fields(self)]
            raise CarpetError(
                f"warps of {shown[1]} at a pitch of {shown[0]} leave no room for a yarn of {shown[2]} "
                f"with {shown[3]} clearance",
                allowed=f"a pitch of {format_quantity(least, 'mm')} or more",
                do="increase the pitch, or use a finer yarn",
            )

    @property
    def radius(self) -> float:
        """Radius of the yarn's axis about a warp's [m], r = (D + d)/2 + e."""
        return (self.warp_diameter + self.yarn_diameter) / 2 + self.clearance


@dataclass(frozen=True, slots=True, eq=False)
class KnotPath:
    """A knot's curve from one end of the yarn to the other: a chain of lines and arcs.

    starts      of the pieces [m]              headings  at the starts [rad]
    curvatures  [1/m], left turns positive     lengths   of the pieces [m]
    """

    knot: Knot
    dimensions: KnotDimensions
    starts: ComplexArray
    headings: FloatArray
    curvatures: FloatArray
    lengths: FloatArray

    @property
    def length(self) -> float:
        """Length of the curve in closed form [m]: two legs and the wrap."""
        return 2 * self.dimensions.leg + wrap_length(self.knot, self.dimensions)

    @property
    def warps(self) -> ComplexArray:
        """Positions of the knot's own warps [m]."""
        return warp_positions(self.knot.warps, self.dimensions.pitch)

    def point(self, s: RealField) -> ComplexArray:
        """Positions [m] at arc lengths s [m]; straight beyond the ends."""
        piece, along = self._at(s)
        half = self.curvatures[piece] * along / 2
        return np.asarray(
            self.starts[piece] + along * np.sinc(half / np.pi) * np.exp(1j * (self.headings[piece] + half))
        )

    def direction(self, s: RealField) -> ComplexArray:
        """Unit directions of the motion at arc lengths s [m]."""
        piece, along = self._at(s)
        return np.asarray(np.exp(1j * (self.headings[piece] + self.curvatures[piece] * along)))

    def curvature(self, s: RealField) -> FloatArray:
        """Curvatures [1/m] at arc lengths s [m], left turns positive; where two pieces meet, that of the later."""
        return np.asarray(self.curvatures[self._at(s)[0]])

    def distances(self, step: float) -> FloatArray:
        """Even arc lengths [m] from end to end, at most `step` [m] apart. Raises CarpetError unless step > 0."""
        if not 0 < step < math.inf:
            raise CarpetError(f"a step of {step} m", allowed="more than 0")
        return np.linspace(0.0, self.length, math.ceil(self.length / step) + 1)

    def _at(self, s: RealField) -> tuple[IntArray, FloatArray]:
        ends = np.cumsum(self.lengths)
        piece = np.asarray(np.minimum(np.searchsorted(ends, s, side="right"), len(ends) - 1))
        return piece, np.asarray(s - (ends - self.lengths)[piece])


def knot_path(knot: Knot, dimensions: KnotDimensions) -> KnotPath:
    """The curve of a knot, in the direction of its word.

    >>> from ilmek.weaving.knots.word import knot
    >>> path = knot_path(knot("symmetric"), KnotDimensions(4 * mm, 1 * mm, 1 * mm))
    >>> round(path.length / mm, 3), path.point(0.0).tolist() == (1 + 10j) * mm
    (33.425, True)
    """
    moves = np.array([move for move in _MAKERS[knot.kind](knot, dimensions) if move[0] > 0])
    lengths, turns = moves.T
    curvatures = turns / lengths
    begin = _begin(knot, dimensions)
    headings = -_QUARTER + np.append(0.0, np.cumsum(turns[:-1]))
    steps = lengths * np.sinc(turns / 2 / np.pi) * np.exp(1j * (headings + turns / 2))
    starts = begin + np.append(0.0, np.cumsum(steps[:-1]))
    if knot.opens == "right":  # the mirror image of the knot open left
        starts, headings, curvatures = _mirrored(knot, dimensions, starts, headings, curvatures)
    return KnotPath(knot, dimensions, starts, headings, curvatures, lengths)


def wrap_length(knot: Knot, dimensions: KnotDimensions) -> float:
    """Length of a knot's curve without its legs [m]; 3 pi r for a single-warp knot."""
    pitch, radius = dimensions.pitch, dimensions.radius
    left, right = len(knot.left), len(knot.right)
    if knot.kind == "symmetric":
        return symmetric_wrap(pitch, radius, left, right)
    if knot.kind == "asymmetric":
        return asymmetric_wrap(pitch, radius, *((left, right) if knot.opens == "left" else (right, left)))
    return single_wrap(radius)


def warp_positions(warps: Word, pitch: float) -> ComplexArray:
    """Positions [m] of warps by their numbers in a row of a pitch [m], warp 1 at 0.

    >>> warp_positions((2, 3), 4.0).tolist()
    [(4+0j), (8+0j)]
    """
    return (np.array(warps, float) - 1) * pitch + 0j


Moves = list[tuple[float, float]]
"""Pieces as (length [m], turn [rad]), from a start at the height of the legs heading down."""


def _symmetric(knot: Knot, d: KnotDimensions) -> Moves:
    r, p, left, right = d.radius, d.pitch, len(knot.left) - 1, len(knot.right) - 1
    quarter, half = (r * _QUARTER, -_QUARTER), (r * _HALF, -_HALF)
    leg, front = (d.leg, 0.0), ((left + right + 1) * p, 0.0)
    return [leg, quarter, (left * p, 0.0), half, front, half, (right * p, 0.0), quarter, leg]


def _open_left(knot: Knot, d: KnotDimensions) -> Moves:
    """Moves of the knot open left; the knot open right is its mirror image."""
    r, p = d.radius, d.pitch
    groups = (knot.left, knot.right) if knot.opens == "left" else (knot.right, knot.left)
    passed, round_ = ((len(group) - 1) * p for group in groups)
    alpha = math.asin(min(1.0, 2 * r / p))
    across = math.sqrt(max(p**2 - 4 * r**2, 0.0))
    behind: Moves = [(d.leg, 0.0), (r * _QUARTER, _QUARTER), (passed, 0.0), (r * alpha, alpha), (across, 0.0)]
    about: Moves = [(r * alpha, -alpha), (round_, 0.0), (r * _HALF, -_HALF), (round_, 0.0), (r * _QUARTER, -_QUARTER)]
    return [*behind, *about, (d.leg, 0.0)]


def _single(_: Knot, d: KnotDimensions) -> Moves:
    return [(d.leg, 0.0), (3 * math.pi * d.radius, 3 * math.pi), (d.leg, 0.0)]


_MAKERS = {"symmetric": _symmetric, "asymmetric": _open_left, SINGLE: _single}


def _begin(knot: Knot, d: KnotDimensions) -> complex:
    """Start of the first leg [m]: right of the left warps, or left of all of them."""
    warp = knot.left[-1] if knot.kind == "symmetric" else knot.left[0]
    side = 1 if knot.kind == "symmetric" else -1
    return complex((warp - 1) * d.pitch + side * d.radius, d.leg)


def _mirrored(
    knot: Knot, d: KnotDimensions, starts: ComplexArray, headings: FloatArray, curvatures: FloatArray
) -> tuple[ComplexArray, FloatArray, FloatArray]:
    """Pieces mirrored about the vertical line through the knot's middle."""
    twice = (knot.warps[0] + knot.warps[-1] - 2) * d.pitch
    return twice - np.conj(starts), math.pi - headings, -curvatures
