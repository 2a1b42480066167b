"""Four poses: the centre-point curve, on which the pivots lie, and the circle-point curve of their pins.

    det [m̃ᵀ G_2; m̃ᵀ G_3; m̃ᵀ G_4] = 0

is a cubic through the poles of the poses. A line through one pole P meets it in two more points, m = P + r e^{iφ},

    c3(φ) r² + c2(φ) r + c1(φ) = 0,

so that the curve is drawn in order by turning the line: where the discriminant is zero (a quartic in e^{2iφ}) the line
touches it, and a stretch between two such angles, out on one root and home on the other, is one closed part of the
curve in the projective plane. Going through infinity is nothing special there; for drawing, the curve is cut at it and
its asymptote told.                     [Bottema and Roth, Theoretical Kinematics, 8.3; the opposite poles: Burmester]
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.num.pencil3 import adjugate, determinant, null_vector, product
from ilmek.plane.vectors import unit
from ilmek.synthesis.burmester.constant_distance import (
    ANGLES,
    FAR,
    TaskFrame,
    family,
    homogeneous,
    pose_forms,
    require_task,
    still_points,
)
from ilmek.synthesis.burmester.links import FAMILY, Guide, guides

SAMPLES = 360
"""Points of each closed part of a curve, if it is not said."""

ON_CIRCLE = 1e-6
"""Distance from the unit circle of a root e^{2iφ} that is the angle of a touching line: a double one splits so far."""

POLISHED = 3
"""Newton's steps on to the cubic."""


LINE = 1e-6
"""Size of all three coefficients, in units of the task, that says that the turned line is part of the cubic."""

ROUNDS = 6
"""Times that the samples are spread anew."""

SLOWEST = 0.3
"""Share of the mean gap that every gap counts more, lest the samples crowd."""

CurveArc: TypeAlias = Callable[[FloatArray], FloatArray]
"""A closed part of the centre-point curve: a parameter from 0 to 2 pi -> homogeneous points."""


class Asymptote(NamedTuple):
    """The straight line that a curve nears at infinity: its point next to the origin [m] and its angle [rad]."""

    foot: complex
    angle: float


class CurveBranch(NamedTuple):
    """A stretch of a curve that can be drawn: places [m] in order; if `closed`, the last joins the first.

    An open one comes from infinity and goes there, along the asymptote.
    """

    places: Complex[np.ndarray, " n"]
    closed: bool


class CurveLoop(NamedTuple):
    """A closed part of both curves in the projective plane, in the task's frame: pivots and pins, row by row."""

    centres: Float[np.ndarray, "n 3"]
    circles: Float[np.ndarray, "n 3"]


@dataclass(frozen=True, slots=True)
class BurmesterCurve:
    """Centre-point and circle-point curve: one or two closed parts, sampled in order.

    loops   pivots and pins in the task's frames, unit vectors whose sign does not jump; zeros where any pin will do
    centre_frame, circle_frame  of pivots and of pins
    centre_asymptote, circle_asymptote  None where the curve falls apart into a circle and the line at infinity
    """

    loops: tuple[CurveLoop, ...]
    centre_frame: TaskFrame
    circle_frame: TaskFrame
    centre_asymptote: Asymptote | None
    circle_asymptote: Asymptote | None

    @property
    def centre_branches(self) -> tuple[CurveBranch, ...]:
        """The pivots [m] as drawn."""
        return tuple(branch for loop in self.loops for branch in _branches(loop.centres, self.centre_frame))

    @property
    def circle_branches(self) -> tuple[CurveBranch, ...]:
        """The pins at the first pose [m] as drawn."""
        return tuple(branch for loop in self.loops for branch in _branches(loop.circles, self.circle_frame))

    def guides(self) -> tuple[Guide, ...]:
        """The link of every sample, in order."""
        return tuple(one for loop in self.loops for one in guides(loop.centres, loop.circles, self.centre_frame))


def burmester_curve(points: ComplexArray, angles: FloatArray, samples: int = SAMPLES) -> BurmesterCurve:
    """Where the links through four poses have their pivots and their pins: for every pivot its pin.

    points [m]  of one point of the body      angles [rad]  of the body      samples  of each closed part
    Raises ParameterError for poses that are not four, not finite, two that are one, angles in degrees, all at one
    angle, or turned about one point.
    """
    require_task("pose", points, angles, 4, "burmester_curve")
    G, frame = pose_forms(points, angles)
    places = frame.into(points)
    found = curve(G, (frame, frame), still_points(places, angles), samples)
    if found is None:
        raise family("pose", places, angles)
    return found


def curve(
    G: Float[np.ndarray, "3 3 3"], frames: tuple[TaskFrame, TaskFrame], poles: Sequence[complex], samples: int
) -> BurmesterCurve | None:
    """The curves of three forms, by poles of the centre-point cubic (in its frame); None where all is pivot."""
    if samples < 8:
        raise ParameterError(f"{samples} samples of a curve", allowed="8 or more")
    chosen = None
    for pole in poles:
        seen = _ways(G, homogeneous(np.asarray(pole)))
        chosen = chosen or seen
        if seen is not None and not seen.lines:
            chosen = seen
            break
    if chosen is None:
        return None
    ways = (*chosen.parts, *chosen.lines)
    loops = tuple(_even(G, way, samples) for way in ways)
    across = np.swapaxes(G, -1, -2)
    return BurmesterCurve(loops, *frames, _asymptote(G, frames[0]), _asymptote(across, frames[1]))


def _value(G: FloatArray, m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The cubic det(m̃ᵀ G) and its gradient."""
    rows = np.einsum("...a,iab->...ib", m, G)
    gradient = np.einsum("...bi,iab->...a", adjugate(rows), G)
    return np.asarray(determinant(rows)), gradient


class CurveFromPole(NamedTuple):
    """Closed parts of a cubic as seen from a pole: those that a turning line draws, and lines through the pole.

    With a line there the parts may jump at it: another pole serves better.
    """

    parts: tuple[CurveArc, ...]
    lines: tuple[CurveArc, ...]


def _ways(G: FloatArray, start: FloatArray) -> CurveFromPole | None:
    """The closed parts of the centre-point curve; None where the cubic is zero all over."""
    fixed = np.einsum("a,iab->ib", start, G)

    def quadratic(phi: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        along = np.einsum("...a,iab->...ib", _direction(phi), G)
        by_fixed = np.einsum("bi,...ib->...", adjugate(fixed), along)
        by_along = np.einsum("...bi,ib->...", adjugate(along), fixed)
        return by_fixed, by_along, np.asarray(determinant(along))

    def points(phi: FloatArray, signs: FloatArray) -> FloatArray:
        c1, c2, c3 = quadratic(phi)
        root = signs * np.sqrt(np.maximum(c2**2 - 4 * c1 * c3, 0.0))
        same = c2 * root > 0  # -c2 + root would cancel
        r, k = np.where(same, 2 * c1, root - c2), np.where(same, -c2 - root, 2 * c3)
        return np.asarray(k[:, None] * start + r[:, None] * _direction(phi))

    def sheet(sign: float, tau: FloatArray) -> FloatArray:
        return points(tau / 2, np.full(tau.shape, sign))

    def stretch(middle: float, half: float, tau: FloatArray) -> FloatArray:
        return points(middle - half * np.cos(tau), np.sign(np.sin(tau)))

    def discriminant(phi: FloatArray) -> FloatArray:
        c1, c2, c3 = quadratic(phi)
        return np.asarray(c2**2 - 4 * c1 * c3)

    def line(phi: float, tau: FloatArray) -> FloatArray:
        far = np.sin(tau / 2)[:, None] * _direction(np.full(tau.shape, phi))
        return np.asarray(np.cos(tau / 2)[:, None] * start + far)

    sizes = np.max(np.abs(quadratic(np.linspace(0, math.pi, 7))))
    if sizes < FAMILY:
        return None
    ends = _touching(discriminant)
    if not len(ends):
        signs = (1.0, -1.0) if discriminant(np.zeros(1))[0] > 0 else ()
        return CurveFromPole(tuple(partial(sheet, sign) for sign in signs), ())
    on = ends[np.max(np.abs(quadratic(ends)), axis=0) < LINE * sizes]
    spans = _positive(discriminant, ends, narrowest=LINE if len(on) else ANGLES)
    return CurveFromPole(tuple(partial(stretch, *span) for span in spans), tuple(partial(line, phi) for phi in on[:1]))


def _positive(
    function: Callable[[FloatArray], FloatArray], zeros: FloatArray, narrowest: float
) -> list[tuple[float, float]]:
    """Middle and half width of the spans between zeros, of period pi, where a function is positive."""
    found = []
    for low, high in zip(zeros, np.append(zeros[1:], zeros[0] + math.pi), strict=True):
        middle, half = (low + high) / 2, (high - low) / 2
        if half > narrowest and function(np.array([middle]))[0] > 0:
            found.append((middle, half))
    return found


def _direction(phi: FloatArray) -> FloatArray:
    return np.stack([np.cos(phi), np.sin(phi), np.zeros(phi.shape)], axis=-1)


def _touching(discriminant: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Angles in [0, pi) at which a function that is a cubic's discriminant in e^{2iφ} is zero."""
    nodes = math.pi * np.arange(5) / 5
    terms = np.fft.fft(discriminant(nodes)) / 5  # of e^{2iφ n}, n = 0, 1, 2, -2, -1
    roots = np.roots(terms[[2, 1, 0, 4, 3]])
    on = np.abs(np.abs(roots) - 1) < ON_CIRCLE
    return np.sort(np.mod(np.angle(roots[on]) / 2, math.pi))


def _loop(G: FloatArray, way: FloatArray) -> CurveLoop:
    """Points of the centre-point curve to the last digit, and their pins."""
    m = way / np.linalg.norm(way, axis=-1, keepdims=True)
    for _ in range(POLISHED):
        value, gradient = _value(G, m)
        steep = np.sum(gradient**2, axis=-1)
        step = value / np.where(steep > FAMILY, steep, np.inf)
        m = m - step[:, None] * gradient
        m /= np.linalg.norm(m, axis=-1, keepdims=True)
    rows = np.einsum("na,iab->nib", m, G)
    alone = np.max(np.abs(adjugate(rows)), axis=(-2, -1)) > FAMILY * np.max(np.abs(G)) ** 2
    return CurveLoop(_followed(m), _followed(np.where(alone[:, None], null_vector(rows), 0.0)))


def _even(G: FloatArray, way: CurveArc, samples: int) -> CurveLoop:
    """A closed part with its samples about as far apart for the pivots and the pins together."""
    tau = 2 * math.pi * np.arange(samples) / samples
    loop = _loop(G, way(tau))
    for _ in range(ROUNDS):
        gaps = _gaps(loop.centres) + _gaps(loop.circles)
        if np.sum(gaps) < LINE:
            return CurveLoop(loop.centres[:1], loop.circles[:1])
        along = np.cumsum(np.append(0.0, gaps + SLOWEST * np.mean(gaps)))
        tau = np.interp(np.arange(samples) * along[-1] / samples, along, np.append(tau, 2 * math.pi))
        loop = _loop(G, way(tau))
    return loop


def _gaps(vectors: FloatArray) -> FloatArray:
    """Angle from each point of the projective plane to the next, the first after the last."""
    after = np.roll(vectors, -1, axis=0)
    return np.asarray(
        np.arctan2(np.linalg.norm(product(vectors, after), axis=-1), np.abs(np.sum(vectors * after, axis=-1)))
    )


def _followed(vectors: FloatArray) -> FloatArray:
    """The same points, the sign of each like that of the one before."""
    turned = np.sign(np.sum(vectors[1:] * vectors[:-1], axis=-1))
    return np.asarray(vectors * np.cumprod(np.append(1.0, np.where(turned == 0, 1.0, turned)))[:, None])


def _branches(loop: FloatArray, frame: TaskFrame) -> list[CurveBranch]:
    """A closed part of the projective plane, cut where it goes through infinity."""
    far = np.abs(loop[:, 2]) * FAR <= np.hypot(loop[:, 0], loop[:, 1])
    count, side = len(loop), np.where(far, 0.0, np.sign(loop[:, 2]))
    closes = 1.0 if loop[-1] @ loop[0] >= 0 else -1.0
    cuts = [k for k in range(count) if side[k] * (side[k - 1] if k else closes * side[-1]) <= 0]
    finite = side != 0
    places = frame.out((loop[:, 0] + 1j * loop[:, 1]) / np.where(finite, loop[:, 2], 1.0))
    if not cuts:
        return [CurveBranch(places, closed=True)]
    found = []
    for low, high in zip(cuts, [*cuts[1:], cuts[0] + count], strict=True):
        index = np.arange(low, high) % count
        index = index[finite[index]]
        if len(index):
            found.append(CurveBranch(places[index], closed=False))
    return found


def _asymptote(G: FloatArray, frame: TaskFrame) -> Asymptote | None:
    """The tangent of the cubic at its real point at infinity: (x² + y²)(l x + m y) leads, so that lies at (m, -l)."""
    (across, along), _ = _value(G, np.eye(3)[:2])
    size, turned, shifted = math.hypot(across, along), np.max(np.abs(G[:, :2, :2])), np.max(np.abs(G[:, :2, 2]))
    if size <= FAMILY * turned**2 * shifted:
        return None
    _, line = _value(G, np.array([along, -across, 0.0]) / size)
    square = line[0] ** 2 + line[1] ** 2
    if square == 0:
        return None
    foot = frame.spot(-line[2] * complex(line[0], line[1]) / square)
    angle = math.atan2(line[0], -line[1]) % math.pi
    normal = 1j * unit(angle)
    return Asymptote(complex((foot * np.conj(normal)).real * normal), angle)
