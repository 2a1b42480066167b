"""Four poses: the centre-point curve, on which the pivots lie, and the circle-point curve of their pins.

    det [m̃ᵀ G_2; m̃ᵀ G_3; m̃ᵀ G_4] = 0

is a cubic through the poles of the poses. A line through one pole P meets it in two more points, m = P + r e^{iφ},

    c3(φ) r² + c2(φ) r + c1(φ) = 0,

so that rotating the line gives the points of the curve in order. Where the discriminant (a quartic in e^{2iφ}) is zero,
the line touches the curve. A range between two such angles, outward on one root and back on the other, is one closed
part of the curve in the projective plane. Points at infinity are regular there; for drawing, the curve is cut at
infinity and its asymptote reported.    [Bottema and Roth, Theoretical Kinematics, 8.3; the opposite poles: Burmester]
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
    poles_of_poses,
    pose_forms,
    require_task,
)
from ilmek.synthesis.burmester.links import FAMILY, Guide, guides

SAMPLES = 360
"""Default number of points on each closed part of a curve."""

ON_CIRCLE = 1e-6
"""Distance of a root e^{2iφ} from the unit circle below which φ is the angle of a tangent: double roots split."""

NEWTON_STEPS = 3
"""Newton steps to the cubic."""

LINE = 1e-6
"""Relative magnitude of all three coefficients below which the line is a component of the cubic."""

RESAMPLINGS = 6
"""Number of redistributions of the samples along the curve."""

MIN_SPACING = 0.3
"""Share of the mean gap that is added to every gap, so that samples do not accumulate."""

CurveArc: TypeAlias = Callable[[FloatArray], FloatArray]
"""A closed part of the centre-point curve: a parameter from 0 to 2 pi -> homogeneous points."""


class Asymptote(NamedTuple):
    """Asymptote of a curve: its point nearest to the origin [m], complex, and its angle [rad]."""

    foot: complex
    angle: float


class CurveBranch(NamedTuple):
    """A finite part of a curve: points [m] in order; if `closed`, the last is connected to the first.

    An open branch begins and ends towards infinity, along the asymptote.
    """

    points: Complex[np.ndarray, " n"]
    closed: bool


class CurveLoop(NamedTuple):
    """A closed part of both curves in the projective plane: homogeneous pivots and pins in the task's frame, by row."""

    centres: Float[np.ndarray, "n 3"]
    circles: Float[np.ndarray, "n 3"]


@dataclass(frozen=True, slots=True)
class BurmesterCurve:
    """Centre-point and circle-point curve: one or two closed parts, sampled in order.

    loops                               pivots and pins in the task's frames, unit vectors with continuous signs; zeros
                                        where the pin is not determined
    centre_frame, circle_frame          frames of pivots and of pins
    centre_asymptote, circle_asymptote  None where the curve degenerates to a circle and the line at infinity
    """

    loops: tuple[CurveLoop, ...]
    centre_frame: TaskFrame
    circle_frame: TaskFrame
    centre_asymptote: Asymptote | None
    circle_asymptote: Asymptote | None

    @property
    def centre_branches(self) -> tuple[CurveBranch, ...]:
        """Branches of the centre-point curve, for drawing [m]."""
        return tuple(branch for loop in self.loops for branch in _branches(loop.centres, self.centre_frame))

    @property
    def circle_branches(self) -> tuple[CurveBranch, ...]:
        """Branches of the circle-point curve at the first pose, for drawing [m]."""
        return tuple(branch for loop in self.loops for branch in _branches(loop.circles, self.circle_frame))

    def guides(self) -> tuple[Guide, ...]:
        """The link of every sample, in order."""
        return tuple(guide for loop in self.loops for guide in guides(loop.centres, loop.circles, self.centre_frame))


def burmester_curve(points: ComplexArray, angles: FloatArray, samples: int = SAMPLES) -> BurmesterCurve:
    """Pivots and pins of all links that guide a body through four poses; every pivot has a pin.

    points   positions of one point of the body [m], complex, shape (4,)
    angles   of the body [rad], shape (4,)
    samples  on each closed part, 8 or more

    Raises ParameterError for another number of poses, values that are not finite, equal poses, angles in degrees, equal
    angles at all poses, and poses that are rotations about one point.
    """
    require_task("pose", points, angles, 4, "burmester_curve")
    G, frame = pose_forms(points, angles)
    scaled = frame.to_frame(points)
    found = curve(G, (frame, frame), poles_of_poses(scaled, angles), samples)
    if found is None:
        raise family("pose", scaled, angles)
    return found


def curve(
    G: Float[np.ndarray, "3 3 3"], frames: tuple[TaskFrame, TaskFrame], poles: Sequence[complex], samples: int
) -> BurmesterCurve | None:
    """Centre-point and circle-point curve of three forms; None where every point is a pivot.

    frames   of pivots and of pins      poles  points of the centre-point cubic, in its frame
    samples  on each closed part, 8 or more; otherwise ParameterError is raised
    """
    if samples < 8:
        raise ParameterError(f"{samples} samples of a curve", allowed="8 or more")
    chosen = None
    for pole in poles:
        seen = _arcs_from_pole(G, homogeneous(np.asarray(pole)))
        chosen = chosen or seen
        if seen is not None and not seen.lines:
            chosen = seen
            break
    if chosen is None:
        return None
    arcs = (*chosen.parts, *chosen.lines)
    loops = tuple(_evenly_sampled(G, arc, samples) for arc in arcs)
    across = np.swapaxes(G, -1, -2)
    return BurmesterCurve(loops, *frames, _asymptote(G, frames[0]), _asymptote(across, frames[1]))


def _value(G: FloatArray, m: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The cubic det(m̃ᵀ G) and its gradient."""
    rows = np.einsum("...a,iab->...ib", m, G)
    gradient = np.einsum("...bi,iab->...a", adjugate(rows), G)
    return np.asarray(determinant(rows)), gradient


class CurveFromPole(NamedTuple):
    """Closed parts of a cubic, computed from a pole: those traced by the rotating line, and lines through the pole.

    With a line the other parts may be discontinuous at it; then another pole is preferred.
    """

    parts: tuple[CurveArc, ...]
    lines: tuple[CurveArc, ...]


def _arcs_from_pole(G: FloatArray, start: FloatArray) -> CurveFromPole | None:
    """The closed parts of the centre-point curve; None where the cubic is identically zero."""
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
    """Middle and half width of the intervals between zeros, of period pi, in which a function is positive."""
    found = []
    for low, high in zip(zeros, np.append(zeros[1:], zeros[0] + math.pi), strict=True):
        middle, half = (low + high) / 2, (high - low) / 2
        if half > narrowest and function(np.array([middle]))[0] > 0:
            found.append((middle, half))
    return found


def _direction(phi: FloatArray) -> FloatArray:
    return np.stack([np.cos(phi), np.sin(phi), np.zeros(phi.shape)], axis=-1)


def _touching(discriminant: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Angles in [0, pi) at which the discriminant, a quartic in e^{2iφ}, is zero."""
    nodes = math.pi * np.arange(5) / 5
    terms = np.fft.fft(discriminant(nodes)) / 5  # of e^{2iφ n}, n = 0, 1, 2, -2, -1
    roots = np.roots(terms[[2, 1, 0, 4, 3]])
    on = np.abs(np.abs(roots) - 1) < ON_CIRCLE
    return np.sort(np.mod(np.angle(roots[on]) / 2, math.pi))


def _loop(G: FloatArray, arc: FloatArray) -> CurveLoop:
    """Points of the centre-point curve, refined by Newton steps, and their pins."""
    m = arc / np.linalg.norm(arc, axis=-1, keepdims=True)
    for _ in range(NEWTON_STEPS):
        value, gradient = _value(G, m)
        steep = np.sum(gradient**2, axis=-1)
        step = value / np.where(steep > FAMILY, steep, np.inf)
        m = m - step[:, None] * gradient
        m /= np.linalg.norm(m, axis=-1, keepdims=True)
    rows = np.einsum("na,iab->nib", m, G)
    alone = np.max(np.abs(adjugate(rows)), axis=(-2, -1)) > FAMILY * np.max(np.abs(G)) ** 2
    return CurveLoop(
        _with_continuous_signs(m), _with_continuous_signs(np.where(alone[:, None], null_vector(rows), 0.0))
    )


def _evenly_sampled(G: FloatArray, arc: CurveArc, samples: int) -> CurveLoop:
    """A closed part with samples spaced about evenly, for pivots and pins together."""
    tau = 2 * math.pi * np.arange(samples) / samples
    loop = _loop(G, arc(tau))
    for _ in range(RESAMPLINGS):
        gaps = _gaps(loop.centres) + _gaps(loop.circles)
        if np.sum(gaps) < LINE:
            return CurveLoop(loop.centres[:1], loop.circles[:1])
        along = np.cumsum(np.append(0.0, gaps + MIN_SPACING * np.mean(gaps)))
        tau = np.interp(np.arange(samples) * along[-1] / samples, along, np.append(tau, 2 * math.pi))
        loop = _loop(G, arc(tau))
    return loop


def _gaps(vectors: FloatArray) -> FloatArray:
    """Angle [rad] from each point of the projective plane to the next, cyclically."""
    after = np.roll(vectors, -1, axis=0)
    return np.asarray(
        np.arctan2(np.linalg.norm(product(vectors, after), axis=-1), np.abs(np.sum(vectors * after, axis=-1)))
    )


def _with_continuous_signs(vectors: FloatArray) -> FloatArray:
    """The same points with continuous signs."""
    turned = np.sign(np.sum(vectors[1:] * vectors[:-1], axis=-1))
    return np.asarray(vectors * np.cumprod(np.append(1.0, np.where(turned == 0, 1.0, turned)))[:, None])


def _branches(loop: FloatArray, frame: TaskFrame) -> list[CurveBranch]:
    """The finite branches of a closed part of the projective plane, cut at infinity."""
    far = np.abs(loop[:, 2]) * FAR <= np.hypot(loop[:, 0], loop[:, 1])
    count, side = len(loop), np.where(far, 0.0, np.sign(loop[:, 2]))
    closes = 1.0 if loop[-1] @ loop[0] >= 0 else -1.0
    cuts = [k for k in range(count) if side[k] * (side[k - 1] if k else closes * side[-1]) <= 0]
    finite = side != 0
    points = frame.to_world((loop[:, 0] + 1j * loop[:, 1]) / np.where(finite, loop[:, 2], 1.0))
    if not cuts:
        return [CurveBranch(points, closed=True)]
    branches = []
    for low, high in zip(cuts, [*cuts[1:], cuts[0] + count], strict=True):
        index = np.arange(low, high) % count
        index = index[finite[index]]
        if len(index):
            branches.append(CurveBranch(points[index], closed=False))
    return branches


def _asymptote(G: FloatArray, frame: TaskFrame) -> Asymptote | None:
    """Tangent of the cubic at its real point at infinity, (m, -l), from the leading terms (x² + y²)(l x + m y)."""
    (across, along), _ = _value(G, np.eye(3)[:2])
    size, turned, shifted = math.hypot(across, along), np.max(np.abs(G[:, :2, :2])), np.max(np.abs(G[:, :2, 2]))
    if size <= FAMILY * turned**2 * shifted:
        return None
    _, line = _value(G, np.array([along, -across, 0.0]) / size)
    square = line[0] ** 2 + line[1] ** 2
    if square == 0:
        return None
    foot = frame.point_to_world(-line[2] * complex(line[0], line[1]) / square)
    angle = math.atan2(line[0], -line[1]) % math.pi
    normal = 1j * unit(angle)
    return Asymptote(complex((foot * np.conj(normal)).real * normal), angle)
