"""Path generation with given timing: four-bars whose tracer is at three to five points at given crank angles.

    p_i = m + W e^{i(th_i - th_1)} + Z_i,      |Z_i| constant

m pivot of the crank, W the crank at the first point, Z from its pin to the tracer. With the first point as origin the
arm is the equation of Burmester's problem between W and -m (`burmester.constant_distance`), so that five points give
up to four cranks, four points a curve of them (and, if the crank's own angle is given, three: `dyad`), three points one
for each pivot. The crank carries the coupler along: its angle at the points is then known, and the second link, the
rocker, is motion generation (`burmester`).   [thesis 2.1.3 generalised; Sandor and Erdman, Advanced Mechanism Design 3]
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
    require_task,
    still_points,
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


class CrankKind(StrEnum):
    """What a solution of the timed points is."""

    CRANK = "crank"
    STILL = "points on a circle"
    LINE = "points on a line"
    FAR_PIVOT = "pivot infinitely far"
    FAR_PIN = "crank infinitely long"
    FREE = "any crank of a line"

    @property
    def words(self) -> str:
        """The same, said in a sentence."""
        return CRANK_WORDS[self]


CRANK_WORDS = {
    CrankKind.CRANK: "a crank with a tracer on its coupler",
    CrankKind.STILL: "the points lie on a circle about the pivot: the crank has no length",
    CrankKind.LINE: "the points lie on a line: the pivot is infinitely far and the crank has no length",
    CrankKind.FAR_PIVOT: "the pivot is infinitely far: the crank would turn on a slide",
    CrankKind.FAR_PIN: "the crank is infinitely long",
    CrankKind.FREE: "more than one crank will do, a whole line of them",
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
    """A crank whose pin keeps its distance from the tracer at the points, at their times.

    pivot  m [m], complex; infinitely far: its direction, a unit vector
    arm    W, the crank as a vector at the first point [m], complex; infinitely long: its direction
    """

    kind: CrankKind
    pivot: complex
    arm: complex

    @property
    def pin(self) -> complex:
        """The crank's pin at the first point [m]."""
        return self.pivot + self.arm

    def pins(self, crank_angles: Float[np.ndarray, " n"]) -> Complex[np.ndarray, " n"]:
        """The crank's pin at each crank angle [m]."""
        return np.asarray(self.pivot + self.arm * unit(crank_angles - crank_angles[0]))

    def reach(
        self, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
    ) -> Float[np.ndarray, " n"]:
        """Distance of pin and tracer [m], which must be the same at all points; NaN where something is infinite."""
        if self.kind in (CrankKind.LINE, CrankKind.FAR_PIVOT, CrankKind.FAR_PIN, CrankKind.FREE):
            return np.full(len(points), np.nan)
        return np.asarray(np.abs(points - self.pins(crank_angles)))

    def coupler_angles(
        self, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
    ) -> Float[np.ndarray, " n"]:
        """Angle of the coupler, from the crank's pin to the tracer [rad], in (-pi, pi]."""
        return np.asarray(np.angle(points - self.pins(crank_angles)))


@dataclass(frozen=True, slots=True)
class TimedFourBar:
    """A crank with its second link: the four-bar, drawn at the first point, or None and in `said` why there is none."""

    crank: TimedCrank
    second: Guide | None
    four_bar: FourBar | None
    said: str


def cranks_through_five_points(points: ComplexArray, crank_angles: FloatArray) -> tuple[TimedCrank, ...]:
    """All cranks for five points [m] at crank angles [rad], of which the differences count: none, 2 or 4 in general.

    Raises ParameterError where the points are no task: not five, not finite, two that are one, angles in degrees, or
    points that a whole family of cranks meets.
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 5, "cranks_through_five_points")
    found = common_solutions(G)
    if found is None:
        raise family("timed point", circle_frame.into(points), crank_angles)
    cranks = [_crank(m, w, centre_frame, circle_frame) for m, w in zip(*found, strict=True)]
    return tuple(sorted(cranks, key=lambda one: (one.kind is not CrankKind.CRANK, abs(one.arm))))


def timed_curve(points: ComplexArray, crank_angles: FloatArray, samples: int = SAMPLES) -> BurmesterCurve:
    """All cranks for four points [m] at crank angles [rad], of which the differences count: a curve of them.

    Its centre-point curve holds the pivots; its circle-point curve the cranks as vectors W [m] at the first point.
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 4, "timed_curve")
    poles = still_points(centre_frame.into(points), crank_angles)
    found = curve(G, (centre_frame, circle_frame), poles, samples)
    if found is None:
        raise family("timed point", circle_frame.into(points), crank_angles)
    return found


def crank_of_pivot(points: ComplexArray, crank_angles: FloatArray, pivot: complex) -> TimedCrank:
    """The crank with a given pivot [m] for three points [m] at crank angles [rad], of which the differences count.

    >>> points, turns = np.array([2, 1 + 1j, 0]), np.array([0.0, 0.5, 1.2])
    >>> crank = crank_of_pivot(points, turns, -1j)
    >>> crank.kind.value, float(np.ptp(crank.reach(points, turns))) < 1e-12
    ('crank', True)
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 3, "crank_of_pivot")
    m = homogeneous(centre_frame.into(np.array([complex(pivot)])))
    (w,) = other_ends(m, G)
    if not np.any(w):
        return TimedCrank(CrankKind.FREE, complex(pivot), complex("nan"))
    return _crank(m[0], w, centre_frame, circle_frame)


def second_arms(
    crank: TimedCrank, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
) -> tuple[Guide, ...]:
    """The links that may go with a crank for five points: those of its coupler's poses, less the crank itself.

    Raises ParameterError as `arms_through_five_poses`, for the coupler's poses.
    """
    return _others(crank, points, crank.coupler_angles(points, crank_angles))


def timed_four_bars(
    points: ComplexArray,
    crank_angles: FloatArray,
    *,
    pivots: tuple[complex, complex] | None = None,
    samples: int = 24,
) -> tuple[TimedFourBar, ...]:
    """Four-bars whose tracer is at the points [m] at the crank angles [rad], crank first.

    five points   every solution: up to four cranks with up to three second links each
    four points   the crank's angles are its own, not differences: up to three cranks, each with second links from its
                  two curves at `samples` places of each closed part
    three points  the one with these `pivots` [m] of crank and rocker

    Where crank or second link are degenerate there is no four-bar, and it says why. Raises ParameterError for another
    number of points, for three without pivots, and as the methods that it puts together.
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
            lambda _, places, angles: burmester_curve(places, angles, samples).guides(),
        )
    if len(points) == 3:
        if pivots is None:
            raise ParameterError("three timed points leave both pivots free", do="give the pivots of crank and rocker")
        one, other = complex(pivots[0]), np.array([complex(pivots[1])])
        cranks = (crank_of_pivot(points, crank_angles, one),)
        return _joined(cranks, points, crank_angles, lambda _, places, angles: arms_of_pivots(places, angles, other))
    raise ParameterError(
        f"a timed path of {len(points)} points",
        allowed="3 to 5 points are met exactly",
        do="for more points search approximately" if len(points) > 5 else "give more points",
    )


def _frames(points: NumberArray) -> tuple[TaskFrame, TaskFrame]:
    """The frames of the pivots, which is turned round because the forms hold -m, and of the crank as a vector."""
    origin = complex(points[0])
    size = float(np.max(np.abs(points - origin))) or 1.0
    return TaskFrame(origin, -size), TaskFrame(0j, size)


def _task(
    points: NumberArray, crank_angles: FloatArray, wanted: int, name: str
) -> tuple[FloatArray, TaskFrame, TaskFrame]:
    require_task("timed point", points, crank_angles, wanted, name)
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
        kind,
        centre_frame.spot(pivot) if near else -pivot,
        circle_frame.spot(arm) if close else arm,
    )


def _cranks_of_four(points: NumberArray, crank_angles: FloatArray) -> tuple[TimedCrank, ...]:
    """The cranks whose own angles are given."""
    arms = arms_through_points(np.asarray(points, dtype=complex), crank_angles)
    start = complex(unit(crank_angles[0]))
    return tuple(
        TimedCrank(KIND_OF_ARM[RootKind(told)], complex(pivot), complex(start if np.isinf(first) else first * start))
        for pivot, first, told in zip(arms.pivot, arms.first, arms.found, strict=True)
        if told != RootKind.COMPLEX
    )


def _others(crank: TimedCrank, points: NumberArray, angles: FloatArray) -> tuple[Guide, ...]:
    """The guides of five poses of a coupler, less its crank."""
    found = arms_through_five_poses(np.asarray(points, dtype=complex), angles)
    itself = min(
        (one for one in found if one.kind is GuideKind.CRANK),
        key=lambda one: abs(one.pivot - crank.pivot) + abs(one.pin - crank.pin),
        default=None,
    )
    return tuple(one for one in found if one is not itself)


def _joined(
    cranks: Sequence[TimedCrank],
    points: NumberArray,
    crank_angles: FloatArray,
    others: Callable[[TimedCrank, NumberArray, FloatArray], Sequence[Guide]],
) -> tuple[TimedFourBar, ...]:
    """Each crank with each of the links that may go with it."""
    return tuple(one for crank in cranks for one in _of_crank(crank, points, crank_angles, others))


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
        yield TimedFourBar(crank, None, None, f"the poses of this crank's coupler: {error.given}")
        return
    link = Guide(GuideKind.CRANK, crank.pivot, crank.pin)
    for second in found:
        joined = pair(link, second, complex(points[0]))
        yield TimedFourBar(crank, second, joined.four_bar, joined.said)
