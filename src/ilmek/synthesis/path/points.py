"""Path generation with prescribed timing: four-bars whose tracer is at three to five points at given crank angles.

    p_i = m + W e^{i(th_i - th_1)} + Z_i,      |Z_i| constant

m pivot of the crank, W crank at the first point, Z from its pin to the tracer. With the first point as origin the arm
has the equation of Burmester's problem between W and -m (`burmester.constant_distance`). So five points give up to four
cranks, four points a curve of cranks (up to three if the crank angle itself is given: `dyad`), three points one crank
for each pivot. With the crank the coupler angle at the points is known, and the second link, the rocker, is a problem
of motion generation (`burmester`).           [thesis 2.1.3 generalised; Sandor and Erdman, Advanced Mechanism Design 3]
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray, NumberArray
from ilmek.errors import ParameterError
from ilmek.plane.vectors import unit
from ilmek.synthesis.burmester.constant_distance import (
    TaskFrame,
    affine_point,
    family,
    homogeneous,
    poles_of_poses,
    require_task,
    timed_forms,
)
from ilmek.synthesis.burmester.curve import SAMPLES, BurmesterCurve, burmester_curve, curve
from ilmek.synthesis.burmester.links import (
    Guide,
    GuideKind,
    arms_of_pivots,
    arms_through_five_poses,
    common_solutions,
    other_ends,
    pair,
)
from ilmek.synthesis.dyad import STILL, RootKind, arms_through_points
from ilmek.synthesis.four_bar import FourBar
from ilmek.units import counted


class CrankKind(StrEnum):
    """Kind of a solution for timed points."""

    CRANK = "crank"
    STILL = "points on a circle"
    LINE = "points on a line"
    FAR_PIVOT = "pivot infinitely far"
    FAR_PIN = "crank infinitely long"
    FREE = "any crank of a line"

    @property
    def words(self) -> str:
        """Description of the kind."""
        return CRANK_WORDS[self]


CRANK_WORDS = {
    CrankKind.CRANK: "a crank with a tracer on its coupler",
    CrankKind.STILL: "the points lie on a circle about the pivot: the crank has no length",
    CrankKind.LINE: "the points lie on a line: the pivot is infinitely far and the crank has no length",
    CrankKind.FAR_PIVOT: "the pivot is infinitely far: the crank would rotate on a slide",
    CrankKind.FAR_PIN: "the crank is infinitely long",
    CrankKind.FREE: "the crank is not unique: its pin may be any point of a line",
}

KIND_OF_ARM = {
    RootKind.ARM: CrankKind.CRANK,
    RootKind.STILL: CrankKind.STILL,
    RootKind.FAR_PIVOT: CrankKind.FAR_PIVOT,
    RootKind.LINE: CrankKind.LINE,
    RootKind.LONG: CrankKind.FAR_PIN,
    RootKind.FAMILY: CrankKind.FREE,
}


@dataclass(frozen=True, slots=True)
class TimedCrank:
    """A crank whose pin has the same distance from the tracer at all points.

    pivot  m [m], complex; of a pivot at infinity its direction, a unit vector
    arm    W, the vector of the crank at the first point [m], complex; of an infinitely long crank its direction
    """

    kind: CrankKind
    pivot: complex
    arm: complex

    @property
    def pin(self) -> complex:
        """The crank's pin at the first point [m]."""
        return self.pivot + self.arm

    def pins(self, crank_angles: Float[np.ndarray, " n"]) -> Complex[np.ndarray, " n"]:
        """Position of the crank's pin [m] at each crank angle [rad]."""
        return np.asarray(self.pivot + self.arm * unit(crank_angles - crank_angles[0]))

    def reach(
        self, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
    ) -> Float[np.ndarray, " n"]:
        """Distance of pin and tracer [m] at each point, constant for a solution; NaN for kinds with infinite parts.

        points  [m], complex      crank_angles  [rad]
        """
        if self.kind in (CrankKind.LINE, CrankKind.FAR_PIVOT, CrankKind.FAR_PIN, CrankKind.FREE):
            return np.full(len(points), np.nan)
        return np.asarray(np.abs(points - self.pins(crank_angles)))

    def coupler_angles(
        self, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
    ) -> Float[np.ndarray, " n"]:
        """Angle of the coupler at each point, from the crank's pin to the tracer [rad], in (-pi, pi]."""
        return np.asarray(np.angle(points - self.pins(crank_angles)))


@dataclass(frozen=True, slots=True)
class TimedFourBar:
    """A crank with its second link: the four-bar drawn at the first point, or None; `description` states the reason."""

    crank: TimedCrank
    second: Guide | None
    four_bar: FourBar | None
    description: str


def cranks_through_five_points(points: ComplexArray, crank_angles: FloatArray) -> tuple[TimedCrank, ...]:
    """All cranks for five points at crank angles: none, 2 or 4 in general.

    points        [m], complex, shape (5,)
    crank_angles  [rad], shape (5,); only their differences count

    Raises ParameterError for another number of points, values that are not finite, equal points, angles in degrees, and
    points met by a family of cranks.
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 5, "cranks_through_five_points")
    found = common_solutions(G)
    if found is None:
        raise family("timed point", circle_frame.to_frame(points), crank_angles)
    cranks = [_crank(m, w, centre_frame, circle_frame) for m, w in zip(*found, strict=True)]
    return tuple(sorted(cranks, key=lambda one: (one.kind is not CrankKind.CRANK, abs(one.arm))))


def timed_curve(points: ComplexArray, crank_angles: FloatArray, samples: int = SAMPLES) -> BurmesterCurve:
    """All cranks for four points at crank angles, as curves.

    points        [m], complex, shape (4,)
    crank_angles  [rad], shape (4,); only their differences count
    samples       on each closed part

    The centre-point curve contains the pivots, the circle-point curve the vectors W of the cranks at the first point
    [m]. Errors as for `cranks_through_five_points`.
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 4, "timed_curve")
    poles = poles_of_poses(centre_frame.to_frame(points), crank_angles)
    found = curve(G, (centre_frame, circle_frame), poles, samples)
    if found is None:
        raise family("timed point", circle_frame.to_frame(points), crank_angles)
    return found


def crank_of_pivot(points: ComplexArray, crank_angles: FloatArray, pivot: complex) -> TimedCrank:
    """The crank with a given pivot for three points at crank angles.

    points        [m], complex, shape (3,)
    crank_angles  [rad], shape (3,); only their differences count
    pivot         [m], complex

    Errors as for `cranks_through_five_points`.

    >>> points, turns = np.array([2, 1 + 1j, 0]), np.array([0.0, 0.5, 1.2])
    >>> crank = crank_of_pivot(points, turns, -1j)
    >>> crank.kind.value, float(np.ptp(crank.reach(points, turns))) < 1e-12
    ('crank', True)
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 3, "crank_of_pivot")
    m = homogeneous(centre_frame.to_frame(np.array([complex(pivot)])))
    (w,) = other_ends(m, G)
    if not np.any(w):
        return TimedCrank(CrankKind.FREE, complex(pivot), complex("nan"))
    return _crank(m[0], w, centre_frame, circle_frame)


def timed_four_bars(
    points: ComplexArray, crank_angles: FloatArray, *, pivots: tuple[complex, complex] | None = None, samples: int = 24
) -> tuple[TimedFourBar, ...]:
    """Four-bars whose tracer is at given points at given crank angles.

    points        [m], complex, three to five
    crank_angles  [rad], one per point
    pivots        of crank and rocker [m], for three points
    samples       on each closed part of the curves, for four points

    Five points: all solutions, up to four cranks with up to three second links each. Four points: the crank angles
    themselves count, not only their differences; up to three cranks, each with the sampled second links of its two
    curves. Three points: the four-bar with the given pivots.

    Where crank or second link is degenerate there is no four-bar, and the description states the reason. Raises
    ParameterError for another number of points, for three points without pivots, and as the methods used.
    """
    if len(points) == 5:
        cranks = cranks_through_five_points(points, crank_angles)
        return _joined(cranks, points, crank_angles, _others)
    if len(points) == 4:
        require_task("timed point", points, crank_angles, 4, "timed_four_bars")
        return _joined(
            _cranks_of_four(points, crank_angles),
            points,
            crank_angles,
            lambda _, positions, angles: burmester_curve(positions, angles, samples).guides(),
        )
    if len(points) == 3:
        if pivots is None:
            raise ParameterError(
                "three timed points do not determine the pivots", do="give the pivots of crank and rocker"
            )
        one, other = complex(pivots[0]), np.array([complex(pivots[1])])
        cranks = (crank_of_pivot(points, crank_angles, one),)
        return _joined(
            cranks, points, crank_angles, lambda _, positions, angles: arms_of_pivots(positions, angles, other)
        )
    raise ParameterError(
        f"a timed path of {counted(len(points), 'point')}",
        allowed="3 to 5 points for an exact solution",
        do="for more points use approximate synthesis" if len(points) > 5 else "give more points",
    )


def _frames(points: NumberArray) -> tuple[TaskFrame, TaskFrame]:
    """Frames of the pivots, rotated by half a turn because the forms contain -m, and of the vector of the crank."""
    origin = complex(points[0])
    size = float(np.max(np.abs(points - origin))) or 1.0
    return TaskFrame(origin, -size), TaskFrame(0j, size)


def _task(
    points: NumberArray, crank_angles: FloatArray, count: int, name: str
) -> tuple[FloatArray, TaskFrame, TaskFrame]:
    require_task("timed point", points, crank_angles, count, name)
    centre_frame, circle_frame = _frames(points)
    return timed_forms(points, crank_angles, np.asarray(circle_frame.size)), centre_frame, circle_frame


def _crank(m: NumberArray, w: NumberArray, centre_frame: TaskFrame, circle_frame: TaskFrame) -> TimedCrank:
    (pivot, near), (arm, close) = affine_point(m), affine_point(w)
    still = close and abs(arm) <= STILL
    if not close:
        kind = CrankKind.FAR_PIN
    elif not near:
        kind = CrankKind.LINE if still else CrankKind.FAR_PIVOT
    else:
        kind = CrankKind.STILL if still else CrankKind.CRANK
    return TimedCrank(
        kind, centre_frame.point_to_world(pivot) if near else -pivot, circle_frame.point_to_world(arm) if close else arm
    )


def _cranks_of_four(points: NumberArray, crank_angles: FloatArray) -> tuple[TimedCrank, ...]:
    """The cranks for four points whose angles themselves are given."""
    arms = arms_through_points(np.asarray(points, dtype=complex), crank_angles)
    start = complex(unit(crank_angles[0]))
    return tuple(
        TimedCrank(KIND_OF_ARM[RootKind(root)], complex(pivot), complex(start if np.isinf(first) else first * start))
        for pivot, first, root in zip(arms.pivot, arms.first, arms.found, strict=True)
        if root != RootKind.COMPLEX
    )


def _others(crank: TimedCrank, points: NumberArray, angles: FloatArray) -> tuple[Guide, ...]:
    """The guides of five poses of a coupler, without its crank."""
    guides = arms_through_five_poses(np.asarray(points, dtype=complex), angles)
    itself = min(
        (guide for guide in guides if guide.kind is GuideKind.CRANK),
        key=lambda one: abs(one.pivot - crank.pivot) + abs(one.pin - crank.pin),
        default=None,
    )
    return tuple(guide for guide in guides if guide is not itself)


def _joined(
    cranks: Sequence[TimedCrank],
    points: NumberArray,
    crank_angles: FloatArray,
    others: Callable[[TimedCrank, NumberArray, FloatArray], Sequence[Guide]],
) -> tuple[TimedFourBar, ...]:
    """Each crank with each of its possible second links."""
    return tuple(bar for crank in cranks for bar in _of_crank(crank, points, crank_angles, others))


def _of_crank(
    crank: TimedCrank,
    points: NumberArray,
    crank_angles: FloatArray,
    others: Callable[[TimedCrank, NumberArray, FloatArray], Sequence[Guide]],
) -> Iterator[TimedFourBar]:
    if crank.kind is not CrankKind.CRANK:
        yield TimedFourBar(crank, None, None, crank.kind.words)
        return
    try:
        found = others(crank, points, crank.coupler_angles(points, crank_angles))
    except ParameterError as error:
        yield TimedFourBar(crank, None, None, f"poses of this crank's coupler: {error.given}")
        return
    link = Guide(GuideKind.CRANK, crank.pivot, crank.pin)
    for second in found:
        joined = pair(link, second, complex(points[0]))
        yield TimedFourBar(crank, second, joined.four_bar, joined.description)
