"""Coupler curves: the path of any point of any body of any mechanism, and its special points.

    cusp: z' = 0        crossing: z(u) = z(v)        inflection: z' x z'' = 0        curvature: z' x z'' / |z'|^3

Roots are bracketed by samples, then refined to rounding with the exact position and rates. A point has a cusp where it
lies on the moving centrode; the path of a four-bar's coupler point crosses itself at most three times, on a circle
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
"""Samples between neighbouring breaks of the path."""

EVEN = 601
"""Samples along a path for the search of straight sections."""

GAUSS = np.polynomial.legendre.leggauss(12)
"""Nodes and weights of the quadrature between neighbouring samples."""

CUSP = 1e-9
"""Least speed relative to the mean, below which a point is a cusp."""

TOUCH = 1e-7
"""Sine of the angle between two passes, below which they touch or coincide and do not cross."""

MEET = 1e-9
"""Greatest distance of passes that meet, relative to the path between them; near a cusp they nearly meet."""


@dataclass(frozen=True, slots=True)
class CurvePoint:
    """A special point of a coupler curve: parameter of the path, value of the input [rad, m], position [m]."""

    parameter: float
    input: float
    position: complex


@dataclass(frozen=True, slots=True)
class Crossing:
    """A crossing of a curve with itself: both parameters, both inputs [rad, m], position [m], angle [rad]."""

    parameters: tuple[float, float]
    inputs: tuple[float, float]
    position: complex
    angle: float


@dataclass(frozen=True, slots=True)
class StraightSection:
    """A section of a curve within a strip along its chord.

    start, stop  parameters of the path    inputs  at both [rad, m]               length     along the strip [m]
    direction    of the strip, unit        middle  a point of its centre line [m]    deviation  half its width [m]
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
    """The curve of a point, at `local` [m] of a body's frame, over a path of configurations."""

    path: ConfigurationPath
    body: str
    local: complex

    def at(self, parameters: FloatArray) -> PointMotion:
        """Position [m], first and second rates by the parameter."""
        found = self.path.bodies(parameters)[self.body].carry(self.local)
        shape = np.shape(parameters)
        return PointMotion(
            *(np.broadcast_to(one, shape) for one in (found.position, found.velocity, found.acceleration))
        )

    def curvature(self, parameters: FloatArray) -> FloatArray:
        """Curvature [1/m], above 0 where the curve bends to the left; NaN or infinite at a cusp."""
        found = self.at(parameters)
        with np.errstate(divide="ignore", invalid="ignore"):
            bend: FloatArray = np.asarray(curvature(found.velocity, found.acceleration))
        return bend

    def samples(self) -> Float[np.ndarray, " parameters"]:
        """Parameters dense enough to bracket all roots; densest near the slowest points, where loops are small."""
        parameters = spaced(self.path.breaks, BETWEEN)
        slow = self._roots(parameters, lambda one: dot(one.velocity, one.acceleration), rising=True)
        reach = (parameters[-1] - parameters[0]) / len(parameters) * 0.7 ** np.arange(40)
        near = (slow[:, None] + np.concatenate([-reach, reach])).ravel()
        return np.unique(np.concatenate([parameters, near[(near > parameters[0]) & (near < parameters[-1])]]))

    def length(self) -> float:
        """Length of the curve [m]: Gauss quadrature of |z'| between samples, densest where |z'| nearly vanishes."""
        nodes = np.unique(np.concatenate([self.samples(), self._slowest()]))
        half = 0.5 * np.diff(nodes)
        parameters = (nodes[:-1] + half)[:, None] + half[:, None] * GAUSS[0]
        speed = np.abs(self.at(parameters.ravel()).velocity).reshape(parameters.shape)
        return float(np.sum(speed * GAUSS[1] * half[:, None]))

    def cusps(self) -> tuple[CurvePoint, ...]:
        """The cusps: points of zero speed, where the direction reverses."""
        slow = self._slowest()
        if not len(slow):
            return ()
        mean = np.mean(np.abs(self.at(self.samples()).velocity))
        return self._curve_points(slow[np.abs(self.at(slow).velocity) <= CUSP * mean])

    def inflections(self) -> tuple[CurvePoint, ...]:
        """The inflections: points at which the curvature changes its sign."""
        return self._curve_points(self._roots(self.samples(), lambda one: cross(one.velocity, one.acceleration)))

    def crossings(self) -> tuple[Crossing, ...]:
        """The crossings of the curve with itself, one for each pair of passes; none where it touches itself."""
        parameters = self.samples()
        z = np.asarray(self.at(parameters).position)
        if self.path.closed:
            z = np.append(z[:-1], z[0])
        pairs = crossing_segments(z, self.path.closed)
        if not len(pairs):
            return ()
        both = 0.5 * (parameters[pairs] + parameters[pairs + 1])
        for _ in range(8):
            one, other = self.at(both[:, 0]), self.at(both[:, 1])
            v, w = np.asarray(one.velocity), -np.asarray(other.velocity)
            gap = np.asarray(one.position) - np.asarray(other.position)
            square = np.stack([np.stack([v.real, w.real], -1), np.stack([v.imag, w.imag], -1)], -2)
            both = both - solve_many(square, np.stack([gap.real, gap.imag], -1))
            both = np.where(np.isfinite(both), np.clip(both, parameters[0], parameters[-1]), parameters[0])
        return self._crossed(both)

    def straights(self, tolerance: float, *, least: float) -> tuple[StraightSection, ...]:
        """Straight sections, longest first; none overlaps a longer one.

        tolerance  greatest distance [m] from a line along the chord        least  least length [m]
        The ends are resolved to 1/200 of the section, inside it; on a closed path a section may extend past the end.
        Raises MechanismError for a tolerance or length that is not above zero.
        """
        if not (tolerance > 0 and least > 0):
            given = f"straight within {tolerance} m for {least} m"
            raise MechanismError(given, allowed="a tolerance and a length above 0")
        parameters = np.linspace(self.path.breaks[0], self.path.breaks[-1], EVEN)
        if self.path.closed:
            parameters = np.concatenate([parameters, parameters[1:] + np.ptp(parameters)])
        z, turn = np.asarray(self.at(parameters).position), float(np.ptp(self.path.breaks))
        windows = [(abs(z[last] - z[first]), first, last) for first, last in _windows(z, tolerance)]
        step = float(np.max(np.abs(np.diff(z))))
        straights: list[StraightSection] = []
        for extent, first, last in sorted(windows, reverse=True):
            start, stop = parameters[first], parameters[last]
            if extent + 2 * step >= least and stop - start < turn and not _overlaps(straights, start, stop, turn):
                one = _fitted(
                    self, parameters[max(first - 1, 0)], parameters[min(last + 1, len(parameters) - 1)], tolerance
                )
                if one.length >= least and not _overlaps(straights, one.start, one.stop, turn):
                    straights.append(one)
        return tuple(straights)

    def _slowest(self) -> Float[np.ndarray, " parameters"]:
        return self._roots(self.samples(), lambda one: dot(one.velocity, one.acceleration), rising=True)

    def _roots(
        self, parameters: FloatArray, part: Callable[[PointMotion], RealField], *, rising: bool = False
    ) -> Float[np.ndarray, " roots"]:
        """Parameters between samples at which a function changes its sign (rising: to above 0), refined."""

        def f(at: FloatArray) -> FloatArray:
            return np.asarray(part(self.at(at)), dtype=float)

        value = f(parameters)
        change = np.sign(value[:-1]) * np.sign(value[1:]) < 0
        (found,) = np.nonzero(change & (value[:-1] < 0) if rising else change)
        return bracketed_roots(f, parameters[found], parameters[found + 1]) if len(found) else np.empty(0)

    def _curve_points(self, parameters: FloatArray) -> tuple[CurvePoint, ...]:
        if not len(parameters):
            return ()
        inputs, positions = self.path.inputs(parameters), np.asarray(self.at(parameters).position)
        return tuple(
            CurvePoint(*one) for one in zip(parameters.tolist(), inputs.tolist(), positions.tolist(), strict=True)
        )

    def _crossed(self, both: Float[np.ndarray, "pairs 2"]) -> tuple[Crossing, ...]:
        """The pairs of parameters of true crossings, each once."""
        one, other = self.at(both[:, 0]), self.at(both[:, 1])
        turn = np.angle(np.asarray(other.velocity) * np.conj(np.asarray(one.velocity)))
        loop = np.abs(np.asarray(one.velocity)) * np.abs(both[:, 0] - both[:, 1])  # between the passes, roughly
        meets = np.abs(np.asarray(one.position) - np.asarray(other.position)) <= MEET * loop
        real = meets & (np.abs(np.sin(turn)) > TOUCH) & (both[:, 0] != both[:, 1])
        crossings: list[Crossing] = []
        for k in np.flatnonzero(real & _first_of_its_kind(both, 1e-8 * float(np.ptp(self.path.breaks)))):
            pair = both[k]
            inputs = self.path.inputs(pair)
            position = complex(np.asarray(one.position)[k])
            ends = (float(pair[0]), float(pair[1])), (float(inputs[0]), float(inputs[1]))
            crossings.append(Crossing(*ends, position, float(abs(turn[k]))))
        return tuple(crossings)


def _fitted(curve: CouplerCurve, low: float, high: float, tolerance: float) -> StraightSection:
    """The longest section between two parameters, in finer steps."""
    parameters = np.linspace(low, high, 200)
    every = np.asarray(curve.at(parameters).position)
    first, last = max(_windows(every, tolerance), key=lambda w: abs(every[w[1]] - every[w[0]]))
    z: Complex[np.ndarray, " z"] = every[first : last + 1]
    direction = complex((z[-1] - z[0]) / abs(z[-1] - z[0]))
    along, across = np.asarray(dot(direction, z)), np.asarray(cross(direction, z))
    middle = direction * (0.5 * (along.min() + along.max()) + 0.5j * (across.min() + across.max()))
    ends = curve.path.inputs(parameters[[first, last]])
    return StraightSection(
        float(parameters[first]),
        float(parameters[last]),
        (float(ends[0]), float(ends[1])),
        float(np.ptp(along)),
        direction,
        complex(middle),
        0.5 * float(np.ptp(across)),
    )


def _windows(z: Complex[np.ndarray, " points"], tolerance: float) -> list[tuple[int, int]]:
    """The longest runs of points within `tolerance` [m] of a line parallel to their chord, none within another."""
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
    """Which pairs of parameters are not within `near` of an earlier pair."""
    alike = np.abs(both[:, None] - both[None, :]).max(axis=-1) < near
    first: Bool[np.ndarray, " pairs"] = np.argmax(alike, axis=1) == np.arange(len(both))
    return first


def _overlaps(found: list[StraightSection], start: float, stop: float, turn: float) -> bool:
    """Whether a section overlaps one of those found, on any turn."""
    return any(
        section.start < stop + shift and section.stop > start + shift
        for section in found
        for shift in (-turn, 0.0, turn)
    )


def coupler_curve(path: ConfigurationPath, body: str, point: str) -> CouplerCurve:
    """The curve of a body's named point over a path. Raises MechanismError for an unknown body or point.

    >>> from ilmek.linkage.configuration_path import InputPath
    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> turn = InputPath(one_input(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))))
    >>> round(coupler_curve(turn, "coupler", "A").length() / (2 * np.pi), 12)
    0.06
    """
    return CouplerCurve(path, body, path.mechanism.point(body, point))
