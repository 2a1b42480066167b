"""Coupler curves: the path of any point of any body of any mechanism, and what is remarkable on it.

    cusp: z' = 0        crossing: z(u) = z(v)        inflection: z' x z'' = 0        curvature: z' x z'' / |z'|^3

Found between samples, then polished to rounding with the mechanism's exact position and rates. A point has a cusp where
it lies on the moving centrode; the path of a four-bar's coupler point crosses itself at most three times, on a circle
through the ground pins [Hunt, Kinematic Geometry of Mechanisms, chapter 7; Roberts 1871].
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Bool, Complex, Float, FloatArray, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import PointMotion
from ilmek.linkage.configuration_path import ConfigurationPath, spaced
from ilmek.num.brackets import bracketed_roots
from ilmek.num.linear import solve_many
from ilmek.plane.curves import crossing_segments, curvature
from ilmek.plane.vectors import cross, dot

BETWEEN = 12
"""Samples between neighbouring breaks of the way."""

EVEN = 601
"""Samples along a way among which straight stretches are looked for."""

GAUSS = np.polynomial.legendre.leggauss(12)
"""Places and weights of the quadrature between neighbouring samples."""

CUSP = 1e-9
"""Speed at its least, of its mean along the path, below which it is none: a cusp."""

TOUCH = 1e-7
"""Sine of the angle between two passes below which they touch, or the path is run twice, and do not cross."""


MEET = 1e-9
"""Distance of two passes, of the path between them, below which they meet: at a cusp they nearly do."""


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """A remarkable spot of a path: place on the way, the input's value there [rad, m], and where it is [m]."""

    place: float
    input: float
    position: complex


@dataclass(frozen=True, slots=True)
class Crossing:
    """Where a path crosses itself: both places and inputs, the position [m], and the angle between the passes [rad]."""

    places: tuple[float, float]
    inputs: tuple[float, float]
    position: complex
    angle: float


@dataclass(frozen=True, slots=True)
class StraightSection:
    """A stretch of a path that stays within a strip along its chord.

    start, stop  places on the way      inputs  there [rad, m]      length  along the strip [m]
    direction    unit complex, along it    middle  a point of its middle line [m]    deviation  half its width [m]
    """

    start: float
    stop: float
    inputs: tuple[float, float]
    length: float
    direction: complex
    middle: complex
    deviation: float


@dataclass(frozen=True, slots=True)
class CouplerCurve:
    """The path of a point, at `local` [m] of a body's frame, along a way."""

    way: ConfigurationPath
    body: str
    local: complex

    def at(self, places: FloatArray) -> PointMotion:
        """Position, and first and second rates by the place."""
        found = self.way.bodies(places)[self.body].carry(self.local)
        shape = np.shape(places)
        return PointMotion(
            *(np.broadcast_to(one, shape) for one in (found.position, found.velocity, found.acceleration))
        )

    def curvature(self, places: FloatArray) -> FloatArray:
        """Curvature [1/m], above 0 where the path bends to the left of its way."""
        found = self.at(places)
        with np.errstate(divide="ignore", invalid="ignore"):
            bend: FloatArray = np.asarray(curvature(found.velocity, found.acceleration))
        return bend

    def samples(self) -> Float[np.ndarray, " places"]:
        """Places close enough to see what is to be polished; closest about the slowest spots, where loops are small."""
        places = spaced(self.way.breaks, BETWEEN)
        slow = self._roots(places, lambda one: dot(one.velocity, one.acceleration), rising=True)
        reach = (places[-1] - places[0]) / len(places) * 0.7 ** np.arange(40)
        near = (slow[:, None] + np.concatenate([-reach, reach])).ravel()
        return np.unique(np.concatenate([places, near[(near > places[0]) & (near < places[-1])]]))

    def length(self) -> float:
        """Length of the path [m]: Gauss's quadrature of |z'| between samples, closest where |z'| nearly vanishes."""
        nodes = np.unique(np.concatenate([self.samples(), self._slowest()]))
        half = 0.5 * np.diff(nodes)
        places = (nodes[:-1] + half)[:, None] + half[:, None] * GAUSS[0]
        speed = np.abs(self.at(places.ravel()).velocity).reshape(places.shape)
        return float(np.sum(speed * GAUSS[1] * half[:, None]))

    def cusps(self) -> tuple[CurvePoint, ...]:
        """Where the point stands still and turns back."""
        slow = self._slowest()
        if not len(slow):
            return ()
        mean = np.mean(np.abs(self.at(self.samples()).velocity))
        return self._spots(slow[np.abs(self.at(slow).velocity) <= CUSP * mean])

    def inflections(self) -> tuple[CurvePoint, ...]:
        """Where the path changes from bending left to bending right."""
        return self._spots(self._roots(self.samples(), lambda one: cross(one.velocity, one.acceleration)))

    def crossings(self) -> tuple[Crossing, ...]:
        """Where the path crosses itself, each once for every pair of passes; where it only touches itself, none."""
        places = self.samples()
        z = np.asarray(self.at(places).position)
        if self.way.closed:
            z = np.append(z[:-1], z[0])
        pairs = crossing_segments(z, self.way.closed)
        if not len(pairs):
            return ()
        both = 0.5 * (places[pairs] + places[pairs + 1])
        for _ in range(8):
            one, other = self.at(both[:, 0]), self.at(both[:, 1])
            v, w = np.asarray(one.velocity), -np.asarray(other.velocity)
            gap = np.asarray(one.position) - np.asarray(other.position)
            square = np.stack([np.stack([v.real, w.real], -1), np.stack([v.imag, w.imag], -1)], -2)
            both = both - solve_many(square, np.stack([gap.real, gap.imag], -1))
            both = np.where(np.isfinite(both), np.clip(both, places[0], places[-1]), places[0])
        return self._crossed(both)

    def straights(self, tolerance: float, *, least: float) -> tuple[StraightSection, ...]:
        """Stretches of at least `least` [m] within `tolerance` [m] of a line along their chord, longest first.

        None overlaps a longer one.

        The ends are fitted to 1/200 of the stretch, from its inside; on a closed way a stretch may run past its end.
        Raises MechanismError for a tolerance or length that is not above zero.
        """
        if not (tolerance > 0 and least > 0):
            given = f"straight within {tolerance} m for {least} m"
            raise MechanismError(given, allowed="a tolerance and a length above 0")
        places = np.linspace(self.way.breaks[0], self.way.breaks[-1], EVEN)
        if self.way.closed:
            places = np.concatenate([places, places[1:] + np.ptp(places)])
        z, turn = np.asarray(self.at(places).position), float(np.ptp(self.way.breaks))
        windows = [(abs(z[last] - z[first]), first, last) for first, last in _windows(z, tolerance)]
        step = float(np.max(np.abs(np.diff(z))))
        found: list[StraightSection] = []
        for extent, first, last in sorted(windows, reverse=True):
            start, stop = places[first], places[last]
            if extent + 2 * step >= least and stop - start < turn and not _overlaps(found, start, stop, turn):
                one = _fitted(self, places[max(first - 1, 0)], places[min(last + 1, len(places) - 1)], tolerance)
                if one.length >= least and not _overlaps(found, one.start, one.stop, turn):
                    found.append(one)
        return tuple(found)

    def _slowest(self) -> Float[np.ndarray, " places"]:
        return self._roots(self.samples(), lambda one: dot(one.velocity, one.acceleration), rising=True)

    def _roots(
        self, places: FloatArray, part: Callable[[PointMotion], RealField], *, rising: bool = False
    ) -> Float[np.ndarray, " roots"]:
        """Places between samples where something changes its sign (to above 0), polished."""

        def f(at: FloatArray) -> FloatArray:
            return np.asarray(part(self.at(at)), dtype=float)

        value = f(places)
        change = np.sign(value[:-1]) * np.sign(value[1:]) < 0
        (found,) = np.nonzero(change & (value[:-1] < 0) if rising else change)
        return bracketed_roots(f, places[found], places[found + 1]) if len(found) else np.empty(0)

    def _spots(self, places: FloatArray) -> tuple[CurvePoint, ...]:
        if not len(places):
            return ()
        inputs, positions = self.way.inputs(places), np.asarray(self.at(places).position)
        return tuple(CurvePoint(*one) for one in zip(places.tolist(), inputs.tolist(), positions.tolist(), strict=True))

    def _crossed(self, both: Float[np.ndarray, "pairs 2"]) -> tuple[Crossing, ...]:
        """The pairs of places that do cross, each once."""
        one, other = self.at(both[:, 0]), self.at(both[:, 1])
        turn = np.angle(np.asarray(other.velocity) * np.conj(np.asarray(one.velocity)))
        loop = np.abs(np.asarray(one.velocity)) * np.abs(both[:, 0] - both[:, 1])  # between the passes, roughly
        meets = np.abs(np.asarray(one.position) - np.asarray(other.position)) <= MEET * loop
        real = meets & (np.abs(np.sin(turn)) > TOUCH) & (both[:, 0] != both[:, 1])
        found: list[Crossing] = []
        for k in np.flatnonzero(real & _first_of_its_kind(both, 1e-8 * float(np.ptp(self.way.breaks)))):
            pair = both[k]
            inputs = self.way.inputs(pair)
            position = complex(np.asarray(one.position)[k])
            ends = (float(pair[0]), float(pair[1])), (float(inputs[0]), float(inputs[1]))
            found.append(Crossing(*ends, position, float(abs(turn[k]))))
        return tuple(found)


def _fitted(curve: CouplerCurve, low: float, high: float, tolerance: float) -> StraightSection:
    """The longest stretch between two places, in finer steps."""
    places = np.linspace(low, high, 200)
    every = np.asarray(curve.at(places).position)
    first, last = max(_windows(every, tolerance), key=lambda w: abs(every[w[1]] - every[w[0]]))
    z: Complex[np.ndarray, " z"] = every[first : last + 1]
    direction = complex((z[-1] - z[0]) / abs(z[-1] - z[0]))
    along, across = np.asarray(dot(direction, z)), np.asarray(cross(direction, z))
    middle = direction * (0.5 * (along.min() + along.max()) + 0.5j * (across.min() + across.max()))
    ends = curve.way.inputs(places[[first, last]])
    return StraightSection(
        float(places[first]),
        float(places[last]),
        (float(ends[0]), float(ends[1])),
        float(np.ptp(along)),
        direction,
        complex(middle),
        0.5 * float(np.ptp(across)),
    )


def _windows(z: Complex[np.ndarray, " points"], tolerance: float) -> list[tuple[int, int]]:
    """The longest runs of points within `tolerance` of a line parallel to their chord, none within another."""
    windows, last = [], 0
    for first in range(len(z)):
        reached = max(last, first)
        while reached + 1 < len(z) and np.ptp(cross(z[reached + 1] - z[first], z[first : reached + 2])) <= (
            2 * tolerance * abs(z[reached + 1] - z[first])
        ):
            reached += 1
        if reached > last or first == 0:
            windows.append((first, reached))
        last = reached
    return windows


def _first_of_its_kind(both: Float[np.ndarray, "pairs 2"], near: float) -> Bool[np.ndarray, " pairs"]:
    """Which pairs of places are not within `near` of one before."""
    alike = np.abs(both[:, None] - both[None, :]).max(axis=-1) < near
    first: Bool[np.ndarray, " pairs"] = np.argmax(alike, axis=1) == np.arange(len(both))
    return first


def _overlaps(found: list[StraightSection], start: float, stop: float, turn: float) -> bool:
    """Whether a stretch has places in common with one found, on any turn."""
    return any(one.start < stop + shift and one.stop > start + shift for one in found for shift in (-turn, 0.0, turn))


def coupler_curve(way: ConfigurationPath, body: str, point: str) -> CouplerCurve:
    """The path of a body's named point along a way. Raises MechanismError for an unknown body or point.

    >>> from ilmek.linkage.configuration_path import InputPath
    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> turn = InputPath(one_input(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))))
    >>> round(coupler_curve(turn, "coupler", "A").length() / (2 * np.pi), 12)
    0.06
    """
    return CouplerCurve(way, body, way.mechanism.point(body, point))
