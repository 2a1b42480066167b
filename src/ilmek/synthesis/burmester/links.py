"""Motion generation: the links that guide a body through three or five poses, and the four-bars made of them.

A link guides the body through the poses where a point of the body, its pin, keeps its distance from a fixed point, its
pivot: m̃ᵀ G_i w̃ = 0 for poses 2 to n (`constant_distance`). Three poses: every pivot has its pin, and every pin its
pivot. Four: pivots and pins lie on two curves (`curve`). Five: up to four links, found as the meeting points
of two conics: written in w, m and Q = conj(w) m the four equations are linear in seven numbers, so that these lie in a
plane of three, in which Q · 1 = conj(w) m is a conic for its real part and one for its imaginary part.

Pivot or pin may be infinitely far: a slider, or a block that turns about the pivot. [Burmester 1888; Bottema and Roth,
Theoretical Kinematics, 8.4; McCarthy and Soh, Geometric Design of Linkages, 5]
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray, NumberArray
from ilmek.errors import MechanismError
from ilmek.num.conics import meet
from ilmek.num.pencil3 import product
from ilmek.plane.vectors import dot, unit
from ilmek.synthesis.burmester.constant_distance import (
    FAR,
    TaskFrame,
    affine_point,
    family,
    homogeneous,
    pose_forms,
    require_task,
)
from ilmek.synthesis.four_bar import FourBar

FAMILY = 1e-12
"""Singular value of the equations, in units of the task, that leaves more than points."""


TOUCHING = 1e-6
"""Accuracy of a double root."""


class GuideKind(StrEnum):
    """What guides the body."""

    CRANK = "crank"
    SLIDER = "slider"
    BLOCK = "turning block"
    ANGLE = "fixed angle"
    FREE = "any point of a line"

    @property
    def words(self) -> str:
        """The same, said in a sentence."""
        return WORDS[self]


WORDS = {
    GuideKind.CRANK: "a link with two pins",
    GuideKind.SLIDER: "the pivot is infinitely far: the pin goes on a straight line, at right angles to its direction",
    GuideKind.BLOCK: "the pin is infinitely far: a line of the body goes through the pivot, in a turning block",
    GuideKind.ANGLE: "pivot and pin are infinitely far: the body has no more than two angles",
    GuideKind.FREE: "this point is a pole of the poses: any point of a line will do at the other end",
}


ENDS = {
    (True, True): GuideKind.CRANK,
    (True, False): GuideKind.BLOCK,
    (False, True): GuideKind.SLIDER,
    (False, False): GuideKind.ANGLE,
}
"""What a guide is, by whether its pivot and its pin are finite."""


@dataclass(frozen=True, slots=True)
class Guide:
    """A link between ground and body.

    pivot  m [m], complex; of a slider the direction, a unit vector, at right angles to the pin's line
    pin    w [m] at the first pose, complex; of a turning block the unit vector at right angles to the body's line
    """

    kind: GuideKind
    pivot: complex
    pin: complex

    @property
    def length(self) -> float:
        """From pivot to pin [m]; infinite where one of them is."""
        return abs(self.pin - self.pivot) if self.kind is GuideKind.CRANK else float("inf")

    @property
    def line(self) -> float:
        """Angle [rad] of the slider's line, or at the first pose of the body's line in the block; NaN without one."""
        normal = {GuideKind.SLIDER: self.pivot, GuideKind.BLOCK: self.pin}.get(self.kind)
        return float("nan") if normal is None else float(np.angle(1j * normal))

    def pins(self, points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> Complex[np.ndarray, " n"]:
        """The pin at each pose [m]; of a block its direction."""
        turned = unit(angles - angles[0])
        if self.kind in (GuideKind.BLOCK, GuideKind.ANGLE):
            return np.asarray(self.pin * turned)
        return np.asarray(points + (self.pin - points[0]) * turned)

    def reach(self, points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """What must be the same at all poses [m]: the proof that this link guides the body through them.

        Distance of pin and pivot; of a slider the pin's place across its line; of a block the distance of the pivot
        from the body's line, measured from the body's point; of a fixed angle the cosine of it.
        """
        pins = self.pins(points, angles)
        if self.kind is GuideKind.BLOCK:
            return np.asarray(dot(pins, self.pivot - points))
        if self.kind in (GuideKind.SLIDER, GuideKind.ANGLE):
            return np.asarray(dot(self.pivot, pins))
        return np.asarray(np.abs(pins - self.pivot))


@dataclass(frozen=True, slots=True)
class GuidePair:
    """Two guides of one body: the four-bar, or None and in `said` what they are instead."""

    one: Guide
    other: Guide
    four_bar: FourBar | None
    said: str


def arms_of_pivots(points: ComplexArray, angles: FloatArray, pivots: Complex[np.ndarray, " m"]) -> tuple[Guide, ...]:
    """The link of each pivot [m] that guides a body through three poses: its pin is where two lines meet.

    points [m]  of one point of the body      angles [rad]  of the body
    Raises ParameterError for poses that are not three, finite and different.

    >>> corner = np.array([0, 1 + 1j, 2 + 0j])
    >>> found = arms_of_pivots(corner, np.zeros(3), np.array([0.5 - 1j]))[0]  # a body that does not turn
    >>> found.kind.value, complex(np.round(found.pin, 9)), found.reach(corner, np.zeros(3)).round(9)
    ('crank', (-0.5-1j), array([1., 1., 1.]))
    """
    require_task("pose", points, angles, 3, "arms_of_pivots")
    G, frame = pose_forms(points, angles)
    ends = homogeneous(frame.into(pivots))
    return guides(ends, other_ends(ends, G), frame)


def arms_of_pins(points: ComplexArray, angles: FloatArray, pins: Complex[np.ndarray, " m"]) -> tuple[Guide, ...]:
    """The link of each pin, given by its place [m] at the first of three poses: its pivot is the centre of a circle.

    As `arms_of_pivots`, the other way round.
    """
    require_task("pose", points, angles, 3, "arms_of_pins")
    G, frame = pose_forms(points, angles)
    ends = homogeneous(frame.into(pins))
    return guides(other_ends(ends, np.swapaxes(G, -1, -2)), ends, frame)


def arms_through_five_poses(points: ComplexArray, angles: FloatArray) -> tuple[Guide, ...]:
    """All links that guide a body through five poses: none, 2 or 4 in general, sliders and blocks among them.

    points [m]  of one point of the body      angles [rad]  of the body
    Sorted: cranks by length, then what is infinitely long. Raises ParameterError where the poses are no task: not five,
    not finite, two that are one, angles in degrees, or poses that a whole family of links takes.
    """
    require_task("pose", points, angles, 5, "arms_through_five_poses")
    G, frame = pose_forms(points, angles)
    found = common_solutions(G)
    if found is None:
        raise family("pose", frame.into(points), angles)
    return tuple(sorted(guides(*found, frame), key=lambda one: (one.length, one.kind, one.pivot.real)))


def common_solutions(G: Float[np.ndarray, "4 3 3"]) -> tuple[FloatArray, FloatArray] | None:
    """All real (m̃, w̃) with m̃ᵀ G_i w̃ = 0 for four forms; None where they are more than points."""
    names = ((2, 0), (2, 1), (0, 2), (1, 2))  # w_x, w_y, m_x, m_y; then Re Q, Im Q and 1
    rows = np.stack([*(G[:, a, b] for a, b in names), G[:, 0, 0], G[:, 1, 0], G[:, 2, 2]], axis=-1)
    _, sizes, basis = np.linalg.svd(rows)
    plane = basis[4:]
    C, D = (plane @ conic @ plane.T for conic in CONICS)
    found = meet(C, D)
    if sizes[-1] < FAMILY * sizes[0] or found.share or max(np.abs(C).max(), np.abs(D).max()) < FAMILY:
        return None
    return _ends(_with_fixed_angle(rows, found.points[found.real].real @ plane))


def other_ends(ends: Float[np.ndarray, "n 3"], G: Float[np.ndarray, "2 3 3"]) -> Float[np.ndarray, "n 3"]:
    """w̃ with m̃ᵀ G_i w̃ = 0 for two forms, where two lines meet; nothing (zeros) where they are one, or one is none."""
    ends = ends / np.linalg.norm(ends, axis=-1, keepdims=True)
    lines = np.einsum("na,iab->inb", ends, G / np.max(np.abs(G), axis=(-2, -1), keepdims=True))
    found = product(lines[0], lines[1])
    size = np.linalg.norm(found, axis=-1, keepdims=True)
    return np.asarray(np.where(size > FAMILY, found / np.where(size > FAMILY, size, 1.0), 0.0))


def guides(centres: Float[np.ndarray, "n 3"], circles: Float[np.ndarray, "n 3"], frame: TaskFrame) -> tuple[Guide, ...]:
    """Guides in the world from pivots and pins, homogeneous in the task's frame."""
    return tuple(_guide(m, w, frame) for m, w in zip(centres, circles, strict=True))


def four_bars(found: Sequence[Guide], tracer: complex | None = None) -> tuple[GuidePair, ...]:
    """Every two guides of one body as a four-bar: the first is its crank (`FourBar.reversed` makes it the rocker).

    tracer  a point of the body at its first pose [m]
    Nothing is left out: where two guides are no four-bar, their pair says what they are.
    """
    return tuple(pair(one, other, tracer) for i, one in enumerate(found) for other in found[i + 1 :])


def pair(one: Guide, other: Guide, tracer: complex | None = None) -> GuidePair:
    """Two guides of one body."""
    if one.kind is not GuideKind.CRANK or other.kind is not GuideKind.CRANK:
        return GuidePair(one, other, None, f"{one.kind} and {other.kind}: no four-bar; {_odd(one, other).kind.words}")
    try:
        return GuidePair(one, other, FourBar(one.pivot, other.pivot, one.pin, other.pin, tracer), "a four-bar")
    except MechanismError as error:
        return GuidePair(one, other, None, f"two cranks, but no four-bar: {error.given}")


def _odd(one: Guide, other: Guide) -> Guide:
    """The guide that is no crank."""
    return other if one.kind is GuideKind.CRANK else one


def _quadric(pairs: Sequence[tuple[int, int, float]]) -> FloatArray:
    """Symmetric matrix of a sum of products of the seven numbers."""
    found = np.zeros((7, 7))
    for i, j, factor in pairs:
        found[i, j] += factor / 2
        found[j, i] += factor / 2
    return found


CONICS = (
    _quadric([(4, 6, 1.0), (0, 2, -1.0), (1, 3, -1.0)]),  # Re Q · 1 - (w_x m_x + w_y m_y)
    _quadric([(5, 6, 1.0), (0, 3, -1.0), (1, 2, 1.0)]),  # Im Q · 1 - (w_x m_y - w_y m_x)
)
"""Q · 1 = conj(w) m of the seven numbers (w, m, Q, 1)."""


def _with_fixed_angle(rows: Float[np.ndarray, "4 7"], seven: Float[np.ndarray, "n 7"]) -> FloatArray:
    """The same roots, that of a body with two angles exact: only Q is left there, and the conics touch."""
    _, sizes, basis = np.linalg.svd(rows[:, 4:6])
    if sizes[1] > FAMILY * sizes[0]:
        return seven
    alone = np.linalg.norm(seven[:, 4:6], axis=-1) > 1 - TOUCHING
    exact = np.concatenate([np.zeros(4), basis[1], np.zeros(1)])
    return np.asarray(np.where(alone[:, None], exact, seven))


def _ends(seven: Float[np.ndarray, "n 7"]) -> tuple[FloatArray, FloatArray]:
    """m̃ and w̃ of the seven numbers, which are the products (w k, m l, conj(w) m, k l) of (m, k) and (w, l).

    Each is read off with the larger factor of the other: m̃ from (m l, k l) or from (Q, w k), w̃ alike. Where only Q is
    left both are infinitely far, and the pin's direction is free: it is taken along x.
    """
    w, m, q = (seven[:, i] + 1j * seven[:, i + 1] for i in (0, 2, 4))
    one = seven[:, 6]
    lone = np.maximum(np.abs(w), np.abs(m)) * FAR <= np.abs(q)
    pivots = _larger(m, one, w * q, np.abs(w) ** 2)
    pins = _larger(w, one, m * np.conj(q), np.abs(m) ** 2)
    pivots[lone] = np.stack([q.real, q.imag, 0 * one], axis=-1)[lone]
    pins[lone] = (1.0, 0.0, 0.0)
    return pivots, pins


def _larger(a: ComplexArray, k: NumberArray, b: ComplexArray, j: NumberArray) -> FloatArray:
    """The unit vector of (a, k) or of (b, j), which are parallel: of the longer one."""
    both = np.stack([np.stack([a.real, a.imag, k], axis=-1), np.stack([b.real, b.imag, j], axis=-1)])
    sizes = np.linalg.norm(both, axis=-1)
    chosen = np.where(sizes[0] >= sizes[1], 0, 1)
    index = np.arange(len(k))
    return np.asarray(both[chosen, index] / np.maximum(sizes[chosen, index], 1e-300)[:, None])


def _guide(m: NumberArray, w: NumberArray, frame: TaskFrame) -> Guide:
    if not (np.any(m) and np.any(w)):
        return Guide(GuideKind.FREE, *(frame.spot(affine_point(v)[0]) if np.any(v) else complex("nan") for v in (m, w)))
    (pivot, near), (pin, close) = affine_point(m), affine_point(w)
    return Guide(ENDS[near, close], frame.spot(pivot) if near else pivot, frame.spot(pin) if close else pin)
