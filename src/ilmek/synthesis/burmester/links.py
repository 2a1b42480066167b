"""Motion generation: links that guide a body through three or five poses, and the four-bars formed of them.

A link guides the body through the poses if a point of the body, the pin, keeps its distance from a fixed point, the
pivot: m̃ᵀ G_i w̃ = 0 for poses 2 to n (`constant_distance`). Three poses: every pivot has a pin, and every pin a pivot.
Four poses: pivots and pins lie on two curves (`curve`). Five poses: up to four links, the intersections of two conics.
In w, m and Q = conj(w) m the four equations are linear in seven homogeneous numbers, which leaves a space of dimension
three. There the real and the imaginary part of Q · 1 = conj(w) m are conics.

Pivot or pin may be at infinity: a slider, or a block that rotates about the pivot. [Burmester 1888; Bottema and Roth,
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
"""Relative singular value of the equations below which they have a family of solutions."""

TOUCHING = 1e-6
"""Relative accuracy of a double root."""


class GuideKind(StrEnum):
    """Kind of a link between ground and body."""

    CRANK = "crank"
    SLIDER = "slider"
    BLOCK = "turning block"
    ANGLE = "fixed angle"
    FREE = "any point of a line"

    @property
    def words(self) -> str:
        """Description of the kind."""
        return WORDS[self]


WORDS = {
    GuideKind.CRANK: "a link with two pins",
    GuideKind.SLIDER: "the pivot is infinitely far: the pin moves on a straight line, at right angles to its direction",
    GuideKind.BLOCK: "the pin is infinitely far: a line of the body passes through the pivot, in a turning block",
    GuideKind.ANGLE: "pivot and pin are infinitely far: the body has at most two angles",
    GuideKind.FREE: "this point is a pole of the poses: the other end may be any point of a line",
}


ENDS = {
    (True, True): GuideKind.CRANK,
    (True, False): GuideKind.BLOCK,
    (False, True): GuideKind.SLIDER,
    (False, False): GuideKind.ANGLE,
}
"""Kind of a guide by (pivot is finite, pin is finite)."""


@dataclass(frozen=True, slots=True)
class Guide:
    """A link between ground and body.

    pivot  m [m], complex; of a slider the unit vector at right angles to the pin's line
    pin    w at the first pose [m], complex; of a turning block the unit vector at right angles to the body's line
    """

    kind: GuideKind
    pivot: complex
    pin: complex

    @property
    def length(self) -> float:
        """Distance from pivot to pin [m]; inf where one of them is at infinity."""
        return abs(self.pin - self.pivot) if self.kind is GuideKind.CRANK else float("inf")

    @property
    def line(self) -> float:
        """Angle of the slider's line, or of the block's line at the first pose [rad]; NaN for other kinds."""
        normal = {GuideKind.SLIDER: self.pivot, GuideKind.BLOCK: self.pin}.get(self.kind)
        return float("nan") if normal is None else float(np.angle(1j * normal))

    def pins(self, points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> Complex[np.ndarray, " n"]:
        """Position of the pin at each pose [m]; of a block its unit vector.

        points  positions of the body's point [m], complex      angles  of the body [rad]
        """
        turned = unit(angles - angles[0])
        if self.kind in (GuideKind.BLOCK, GuideKind.ANGLE):
            return np.asarray(self.pin * turned)
        return np.asarray(points + (self.pin - points[0]) * turned)

    def reach(self, points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Quantity that is constant if this link guides the body through the poses, one value per pose [m].

        Distance of pin and pivot; of a slider the pin's position across its line; of a block the distance of the pivot
        from the body's line, measured from the body's point; of a fixed angle its cosine. The arguments are those of
        `pins`.
        """
        pins = self.pins(points, angles)
        if self.kind is GuideKind.BLOCK:
            return np.asarray(dot(pins, self.pivot - points))
        if self.kind in (GuideKind.SLIDER, GuideKind.ANGLE):
            return np.asarray(dot(self.pivot, pins))
        return np.asarray(np.abs(pins - self.pivot))


@dataclass(frozen=True, slots=True)
class GuidePair:
    """Two guides of one body: their four-bar, or None; `description` states what they form."""

    one: Guide
    other: Guide
    four_bar: FourBar | None
    description: str


def arms_of_pivots(points: ComplexArray, angles: FloatArray, pivots: Complex[np.ndarray, " m"]) -> tuple[Guide, ...]:
    """The link of each given pivot that guides a body through three poses; its pin is the intersection of two lines.

    points  positions of one point of the body [m], complex, shape (3,)
    angles  of the body [rad], shape (3,)
    pivots  [m], complex, shape (m,)

    Raises ParameterError for another number of poses, values that are not finite, and equal poses.

    >>> corner = np.array([0, 1 + 1j, 2 + 0j])
    >>> found = arms_of_pivots(corner, np.zeros(3), np.array([0.5 - 1j]))[0]  # a body that does not rotate
    >>> found.kind.value, complex(np.round(found.pin, 9)), found.reach(corner, np.zeros(3)).round(9)
    ('crank', (-0.5-1j), array([1., 1., 1.]))
    """
    require_task("pose", points, angles, 3, "arms_of_pivots")
    G, frame = pose_forms(points, angles)
    ends = homogeneous(frame.to_frame(pivots))
    return guides(ends, other_ends(ends, G), frame)


def arms_of_pins(points: ComplexArray, angles: FloatArray, pins: Complex[np.ndarray, " m"]) -> tuple[Guide, ...]:
    """The link of each pin, given by its position at the first of three poses; its pivot is the centre of a circle.

    pins  [m], complex, shape (m,); the other arguments and errors are those of `arms_of_pivots`
    """
    require_task("pose", points, angles, 3, "arms_of_pins")
    G, frame = pose_forms(points, angles)
    ends = homogeneous(frame.to_frame(pins))
    return guides(other_ends(ends, np.swapaxes(G, -1, -2)), ends, frame)


def arms_through_five_poses(points: ComplexArray, angles: FloatArray) -> tuple[Guide, ...]:
    """All links that guide a body through five poses: none, 2 or 4 in general, including sliders and blocks.

    points  positions of one point of the body [m], complex, shape (5,)
    angles  of the body [rad], shape (5,)

    Sorted: cranks by length, then links with an end at infinity. Raises ParameterError for another number of poses,
    values that are not finite, equal poses, angles in degrees, and poses that a family of links takes.
    """
    require_task("pose", points, angles, 5, "arms_through_five_poses")
    G, frame = pose_forms(points, angles)
    found = common_solutions(G)
    if found is None:
        raise family("pose", frame.to_frame(points), angles)
    return tuple(sorted(guides(*found, frame), key=lambda one: (one.length, one.kind, one.pivot.real)))


def common_solutions(G: Float[np.ndarray, "4 3 3"]) -> tuple[FloatArray, FloatArray] | None:
    """All real (m̃, w̃) with m̃ᵀ G_i w̃ = 0 for four forms, one per row; None where they are a family."""
    names = ((2, 0), (2, 1), (0, 2), (1, 2))  # w_x, w_y, m_x, m_y; then Re Q, Im Q and 1
    rows = np.stack([*(G[:, a, b] for a, b in names), G[:, 0, 0], G[:, 1, 0], G[:, 2, 2]], axis=-1)
    _, sizes, basis = np.linalg.svd(rows)
    plane = basis[4:]
    C, D = (plane @ conic @ plane.T for conic in CONICS)
    intersections = meet(C, D)
    if sizes[-1] < FAMILY * sizes[0] or intersections.share or max(np.abs(C).max(), np.abs(D).max()) < FAMILY:
        return None
    return _ends(_with_fixed_angle(rows, intersections.points[intersections.real].real @ plane))


def other_ends(ends: Float[np.ndarray, "n 3"], G: Float[np.ndarray, "2 3 3"]) -> Float[np.ndarray, "n 3"]:
    """The w̃ with m̃ᵀ G_i w̃ = 0 for two forms, the intersection of two lines; zeros where it is not unique."""
    ends = ends / np.linalg.norm(ends, axis=-1, keepdims=True)
    lines = np.einsum("na,iab->inb", ends, G / np.max(np.abs(G), axis=(-2, -1), keepdims=True))
    found = product(lines[0], lines[1])
    size = np.linalg.norm(found, axis=-1, keepdims=True)
    return np.asarray(np.where(size > FAMILY, found / np.where(size > FAMILY, size, 1.0), 0.0))


def guides(centres: Float[np.ndarray, "n 3"], circles: Float[np.ndarray, "n 3"], frame: TaskFrame) -> tuple[Guide, ...]:
    """Guides in the ground frame from pivots and pins, homogeneous in the task's frame."""
    return tuple(_guide(m, w, frame) for m, w in zip(centres, circles, strict=True))


def four_bars(found: Sequence[Guide], tracer: complex | None = None) -> tuple[GuidePair, ...]:
    """Every pair of guides of one body as a four-bar; the first is the crank (`FourBar.reversed` exchanges them).

    found   guides of the body
    tracer  a point of the body at its first pose [m]; default: none

    Pairs that form no four-bar are included, with a description.
    """
    return tuple(pair(one, other, tracer) for i, one in enumerate(found) for other in found[i + 1 :])


def pair(one: Guide, other: Guide, tracer: complex | None = None) -> GuidePair:
    """Two guides of one body, and their four-bar with a tracer [m] if they form one."""
    if one.kind is not GuideKind.CRANK or other.kind is not GuideKind.CRANK:
        return GuidePair(
            one, other, None, f"{one.kind} and {other.kind}: no four-bar; {_not_a_crank(one, other).kind.words}"
        )
    try:
        return GuidePair(one, other, FourBar(one.pivot, other.pivot, one.pin, other.pin, tracer), "a four-bar")
    except MechanismError as error:
        return GuidePair(one, other, None, f"two cranks, but no four-bar: {error.given}")


def _not_a_crank(one: Guide, other: Guide) -> Guide:
    """The guide that is not a crank."""
    return other if one.kind is GuideKind.CRANK else one


def _quadric(pairs: Sequence[tuple[int, int, float]]) -> FloatArray:
    """Symmetric matrix of a sum of factors times products of two of the seven numbers."""
    found = np.zeros((7, 7))
    for i, j, factor in pairs:
        found[i, j] += factor / 2
        found[j, i] += factor / 2
    return found


CONICS = (
    _quadric([(4, 6, 1.0), (0, 2, -1.0), (1, 3, -1.0)]),  # Re Q · 1 - (w_x m_x + w_y m_y)
    _quadric([(5, 6, 1.0), (0, 3, -1.0), (1, 2, 1.0)]),  # Im Q · 1 - (w_x m_y - w_y m_x)
)
"""Real and imaginary part of Q · 1 = conj(w) m in the seven numbers (w, m, Q, 1)."""


def _with_fixed_angle(rows: Float[np.ndarray, "4 7"], seven: Float[np.ndarray, "n 7"]) -> FloatArray:
    """The roots, with that of a body with two angles exact: only Q is not zero there, and the conics touch."""
    _, sizes, basis = np.linalg.svd(rows[:, 4:6])
    if sizes[1] > FAMILY * sizes[0]:
        return seven
    alone = np.linalg.norm(seven[:, 4:6], axis=-1) > 1 - TOUCHING
    exact = np.concatenate([np.zeros(4), basis[1], np.zeros(1)])
    return np.asarray(np.where(alone[:, None], exact, seven))


def _ends(seven: Float[np.ndarray, "n 7"]) -> tuple[FloatArray, FloatArray]:
    """m̃ and w̃ from the seven numbers, the products (w k, m l, conj(w) m, k l) of (m, k) and (w, l).

    Each is computed with the larger factor of the other: m̃ from (m l, k l) or from (Q, w k), w̃ likewise. Where only Q
    is not zero both are at infinity and the pin's direction is free; it is taken along x.
    """
    w, m, q = (seven[:, i] + 1j * seven[:, i + 1] for i in (0, 2, 4))
    last = seven[:, 6]
    only_product = np.maximum(np.abs(w), np.abs(m)) * FAR <= np.abs(q)
    pivots = _larger(m, last, w * q, np.abs(w) ** 2)
    pins = _larger(w, last, m * np.conj(q), np.abs(m) ** 2)
    pivots[only_product] = np.stack([q.real, q.imag, 0 * last], axis=-1)[only_product]
    pins[only_product] = (1.0, 0.0, 0.0)
    return pivots, pins


def _larger(a: ComplexArray, k: NumberArray, b: ComplexArray, j: NumberArray) -> FloatArray:
    """Unit vector of the longer one of two parallel vectors, (a, k) or (b, j)."""
    both = np.stack([np.stack([a.real, a.imag, k], axis=-1), np.stack([b.real, b.imag, j], axis=-1)])
    sizes = np.linalg.norm(both, axis=-1)
    chosen = np.where(sizes[0] >= sizes[1], 0, 1)
    index = np.arange(len(k))
    return np.asarray(both[chosen, index] / np.maximum(sizes[chosen, index], 1e-300)[:, None])


def _guide(m: NumberArray, w: NumberArray, frame: TaskFrame) -> Guide:
    if not (np.any(m) and np.any(w)):
        return Guide(
            GuideKind.FREE, *(frame.point_to_world(affine_point(v)[0]) if np.any(v) else complex("nan") for v in (m, w))
        )
    (pivot, near), (pin, close) = affine_point(m), affine_point(w)
    return Guide(
        ENDS[near, close], frame.point_to_world(pivot) if near else pivot, frame.point_to_world(pin) if close else pin
    )
