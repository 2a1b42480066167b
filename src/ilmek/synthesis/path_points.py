"""Path generation with given timing: four-bars whose tracer is at three to five points at given crank angles.

    p_i = m + W e^{i(th_i - th_1)} + Z_i,      |Z_i| constant

m pivot of the crank, W the crank at the first point, Z from its pin to the tracer. With the first point as origin the
arm is the equation of Burmester's problem between W and -m (`burmester_forms`), so that five points give up to four
cranks, four points a curve of them (and, if the crank's own angle is given, three: `dyad`), three points one for each
pivot. The crank carries the coupler along: its angle at the points is then known, and the second link, the rocker, is
motion generation (`burmester`).              [thesis 2.1.3 generalised; Sandor and Erdman, Advanced Mechanism Design 3]
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Complex, Float

from ilmek.arrays import FloatArray, NumberArray
from ilmek.errors import ParameterError
from ilmek.num.pencil3 import product
from ilmek.plane.vectors import unit
from ilmek.synthesis.burmester import (
    FAMILY,
    POINT,
    Guide,
    Kind,
    Pair,
    arms_of_pivots,
    arms_through_five_poses,
    common_solutions,
    pair,
)
from ilmek.synthesis.burmester_curve import SAMPLES, BurmesterCurve, burmester_curve, curve, still_point
from ilmek.synthesis.burmester_forms import Frame, homogeneous, place, require_task, timed_forms
from ilmek.synthesis.dyad import Found, arms_through_points


class CrankKind(StrEnum):
    """What a solution of the timed points is."""

    CRANK = "crank"
    STILL = "points on a circle"
    ON_PIN = "tracer on the crank's pin"
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
    CrankKind.ON_PIN: "the points lie on the crank's own circle, timed as it turns: the tracer is its pin",
    CrankKind.FAR_PIVOT: "the pivot is infinitely far, as for points on a line: the crank would turn on a slide",
    CrankKind.FAR_PIN: "the crank is infinitely long",
    CrankKind.FREE: "any crank whose tip is on a line will do",
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
        if self.kind in (CrankKind.FAR_PIVOT, CrankKind.FAR_PIN, CrankKind.FREE):
            return np.full(len(points), np.nan)
        return np.asarray(np.abs(points - self.pins(crank_angles)))

    def coupler_angles(
        self, points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
    ) -> Float[np.ndarray, " n"]:
        """Angle of the coupler, from the crank's pin to the tracer [rad], in (-pi, pi]."""
        return np.asarray(np.angle(points - self.pins(crank_angles)))


def cranks_through_five_points(
    points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"]
) -> tuple[TimedCrank, ...]:
    """All cranks for five points [m] at crank angles [rad], of which the differences count: none, 2 or 4 in general.

    Raises ParameterError where the points are no task: not five, not finite, two that are one, angles in degrees, or
    points that a whole family of cranks meets.
    """
    G, _, _ = _task(points, crank_angles, 5, "cranks_through_five_points")
    centres, circles = common_solutions(G)
    found = [_crank(m, w, *_frames(points)) for m, w in zip(centres, circles, strict=True)]
    return tuple(sorted(found, key=lambda one: (one.kind is not CrankKind.CRANK, abs(one.arm))))


def timed_curve(
    points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"], samples: int = SAMPLES
) -> BurmesterCurve:
    """All cranks for four points [m] at crank angles [rad], of which the differences count: a curve of them.

    Its centre-point curve holds the pivots; its circle-point curve the cranks as vectors W [m] at the first point.
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 4, "timed_curve")
    pole = still_point(centre_frame.into(points), crank_angles)
    return curve(G, (centre_frame, circle_frame), pole, samples)


def crank_of_pivot(
    points: Complex[np.ndarray, " n"], crank_angles: Float[np.ndarray, " n"], pivot: complex
) -> TimedCrank:
    """The crank with a given pivot [m] for three points [m] at crank angles [rad], of which the differences count.

    >>> crank = crank_of_pivot(np.array([2, 1 + 1j, 0]), np.array([0.0, 0.5, 1.2]), -1j)
    >>> crank.kind.value, np.ptp(crank.reach(np.array([2, 1 + 1j, 0]), np.array([0.0, 0.5, 1.2]))) < 1e-12
    ('crank', True)
    """
    G, centre_frame, circle_frame = _task(points, crank_angles, 3, "crank_of_pivot")
    m = homogeneous(centre_frame.into(complex(pivot)))
    rows = np.einsum("a,iab->ib", m, G)
    w = product(rows[0], rows[1])
    if np.linalg.norm(w) <= FAMILY:
        return TimedCrank(CrankKind.FREE, complex(pivot), complex("nan"))
    return _crank(m, w, centre_frame, circle_frame)


def second_arms(
    crank: TimedCrank, points: Complex[np.ndarray, " 5"], crank_angles: Float[np.ndarray, " 5"]
) -> tuple[Guide, ...]:
    """The links that may go with a crank for five points: those of its coupler's poses, less the crank itself."""
    angles = np.unwrap(crank.coupler_angles(points, crank_angles))
    found = arms_through_five_poses(points, angles - 2 * np.pi * np.round(angles[0] / (2 * np.pi)))
    itself = min(
        (one for one in found if one.kind is Kind.CRANK),
        key=lambda one: abs(one.pivot - crank.pivot) + abs(one.pin - crank.pin),
        default=None,
    )
    return tuple(one for one in found if one is not itself)


def path_four_bars(
    points: Complex[np.ndarray, " n"],
    crank_angles: Float[np.ndarray, " n"],
    *,
    pivots: tuple[complex, complex] | None = None,
    samples: int = 24,
) -> tuple[Pair, ...]:
    """Four-bars whose tracer is at the points [m] at the crank angles [rad], crank first.

    five points   every solution: up to four cranks with up to three second links each
    four points   the crank's angles are its own, not differences: up to three cranks, each with second links from its
                  two curves at `samples` places of each closed part
    three points  the one with these `pivots` [m] of crank and rocker

    Where crank or second link are degenerate the pair has no four-bar and says why. Raises ParameterError for another
    number of points, for three without pivots, and as the methods that it puts together.
    """
    if len(points) == 5:
        return tuple(_of_five(points, crank_angles))
    if len(points) == 4:
        return tuple(_of_four(points, crank_angles, samples))
    if len(points) == 3 and pivots is None:
        raise ParameterError("three timed points leave both pivots free", do="give the pivots of crank and rocker")
    if len(points) == 3 and pivots is not None:
        crank = crank_of_pivot(points, crank_angles, pivots[0])
        return tuple(_joined(crank, arms_of_pivots, points, crank_angles, np.array([complex(pivots[1])])))
    raise ParameterError(
        f"a timed path of {len(points)} points",
        allowed="3 to 5 points are met exactly",
        do="for more points search approximately",
    )


def _frames(points: NumberArray) -> tuple[Frame, Frame]:
    """The frames of the pivots, which is turned round because the forms hold -m, and of the crank as a vector."""
    origin = complex(points[0])
    size = float(np.max(np.abs(points - origin))) or 1.0
    return Frame(origin, -size), Frame(0j, size)


def _task(points: NumberArray, crank_angles: FloatArray, wanted: int, name: str) -> tuple[FloatArray, Frame, Frame]:
    require_task("timed point", points, crank_angles, wanted, name)
    centre_frame, circle_frame = _frames(points)
    return timed_forms(points, crank_angles, np.asarray(circle_frame.size)), centre_frame, circle_frame


def _crank(m: NumberArray, w: NumberArray, centre_frame: Frame, circle_frame: Frame) -> TimedCrank:
    (pivot, near), (arm, close) = place(m), place(w)
    if not close:
        kind = CrankKind.FAR_PIN
    elif not near:
        kind = CrankKind.FAR_PIVOT
    elif abs(arm) <= POINT:
        kind = CrankKind.STILL
    else:
        kind = CrankKind.ON_PIN if abs(arm - pivot) <= POINT * max(1.0, abs(arm)) else CrankKind.CRANK
    return TimedCrank(
        kind,
        complex(centre_frame.out(np.asarray(pivot))) if near else -pivot,
        complex(circle_frame.out(np.asarray(arm))) if close else arm,
    )


def _of_five(points: NumberArray, crank_angles: FloatArray) -> Iterator[Pair]:
    for crank in cranks_through_five_points(points, crank_angles):
        if crank.kind is not CrankKind.CRANK:
            yield _alone(crank, crank.kind.words)
            continue
        try:
            others = second_arms(crank, points, crank_angles)
        except ParameterError as error:
            yield _alone(crank, f"the coupler of this crank: {error.given}")
            continue
        yield from (pair(_as_guide(crank), other, complex(points[0])) for other in others)


def _of_four(points: NumberArray, crank_angles: FloatArray, samples: int) -> Iterator[Pair]:
    require_task("timed point", points, crank_angles, 4, "path_four_bars")
    arms = arms_through_points(points, crank_angles)
    start = complex(unit(crank_angles[0]))
    for pivot, first, told in zip(arms.pivot, arms.first, arms.found, strict=True):
        if told == Found.COMPLEX:
            continue
        crank = TimedCrank(CrankKind.CRANK, complex(pivot), complex(first * start) if told == Found.ARM else 0j)
        if told != Found.ARM:
            yield _alone(crank, Found(told).words)
            continue
        yield from _joined(crank, None, points, crank_angles, samples)
