"""Beside dead centres, a status says what a number does not hold."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from benchmarks.campaign.exact import truth
from benchmarks.campaign.random_linkages import Course, Family, draw
from benchmarks.campaign.read import NEW, carried, field, poses
from ilmek.arrays import FloatArray, IntArray
from ilmek.linkage.batch import Sweep
from ilmek.linkage.groups.prp import CrossedSliders
from ilmek.linkage.status import Status


@dataclass
class NearDead:
    """What was found beside dead centres.

    samples    looked at                         solved    of these with status OK
    velocity   worst error of those, of the largest velocity                 acceleration  likewise
    silent     of those with either wrong by more than a hundredth
    misjudged  samples that close said not to, or the other way round, 1e-9 to 1e-4 rad from the dead centre
    """

    mechanisms: int = 0
    samples: int = 0
    solved: int = 0
    velocity: float = 0.0
    acceleration: float = 0.0
    silent: int = 0
    misjudged: int = 0


AWAY = 3 * 10.0 ** -np.arange(2.0, 16.0)
"""Distances of the first crank from where the group is dead [rad]."""

SECOND = 1.0
"""Angle of the second crank."""


def near_dead(kind: str, count: int, rng: np.random.Generator) -> NearDead:
    """Mechanisms of which one crank is brought to a dead centre, to 3e-15 rad on either side."""
    found = NearDead()
    while found.mechanisms < count:
        drawn = draw(kind, min(1024, 4 * (count - found.mechanisms) + 16), rng)
        dead, side = _parallel(drawn) if kind == "PRP" else _limit(drawn)
        which = np.flatnonzero(side != 0)[: count - found.mechanisms]
        if len(which):
            _look(drawn.chosen(which), dead[which], side[which], found)
    return found


def _look(family: Family, dead: FloatArray, side: FloatArray, found: NearDead) -> None:
    """One family at all distances; side 1 or -1: where it closes, 2: on both."""
    found.mechanisms += len(family)
    for away in (*AWAY, *-AWAY):
        posed, courses = _at(family, dead + away * np.where(side == 2, 1, side))
        swept = posed.move(courses)
        status = swept.status[:, 0]
        closes = (away > 0) | (side == 2)
        found.samples += len(family)
        if 1e-9 < abs(away) < 1e-4:
            found.misjudged += int((closes != (status != Status.CANNOT_CLOSE)).sum())
        ok = np.flatnonzero(status == Status.OK)
        found.solved += len(ok)
        if len(ok):
            errors = _errors(posed, swept, courses, ok)
            found.velocity = max(found.velocity, float(errors[0].max()))
            found.acceleration = max(found.acceleration, float(errors[1].max()))
            found.silent += int((~(errors <= 0.01)).any(axis=0).sum())


def _errors(family: Family, swept: Sweep, courses: tuple[Course, Course, Course], which: IntArray) -> FloatArray:
    """Errors of the variants' velocities and accelerations, of their largest; infinite where the pose is wrong."""
    chosen = family.chosen(which)
    given = {crank: [course[crank] + np.zeros(len(which)) for course in courses] for crank in courses[0]}
    at = np.zeros(len(family), dtype=int)
    start = {body: (origin[which], angle[which]) for body, (origin, angle) in poses(family, swept, at).items()}
    known = truth(chosen, start, given)
    error, scale = np.zeros((2, len(which))), np.full((2, len(which)), 1e-3)
    for body in NEW:
        for point, motion in carried(chosen, known[body], body).items():
            ours = [field(swept, body, point, order)[which, 0] for order in range(3)]
            lost = np.abs(ours[0] - motion[0]) > 1e-6 * np.maximum(1, np.abs(motion[0]))
            for order in (1, 2):
                apart = np.where(lost, np.inf, np.abs(ours[order] - motion[order]))
                error[order - 1] = np.maximum(error[order - 1], apart)
                scale[order - 1] = np.maximum(scale[order - 1], np.abs(motion[order]))
    errors: FloatArray = error / scale
    return errors


def _limit(family: Family) -> tuple[FloatArray, FloatArray]:
    """Where on the first crank's turn each variant ceases to close [rad], and on which side of that it closes, or 0."""
    grid = np.linspace(0, 2 * np.pi, 97)
    course: Course = {"left": grid, "right": np.full(len(grid), SECOND)}
    lost = family.judge((course, {}, {})).status == Status.CANNOT_CLOSE
    changes = lost[:, 1:] != lost[:, :-1]
    first = changes.argmax(axis=1)
    side = np.where(lost[np.arange(len(family)), first], 1.0, -1.0)
    low, high = grid[first], grid[first + 1]
    for _ in range(48):
        middle = 0.5 * (low + high)
        posed, courses = _at(family, middle)
        below = (posed.judge(courses).status[:, 0] == Status.CANNOT_CLOSE) == (side > 0)
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high), np.where(changes.any(axis=1), side, 0.0)


def _parallel(family: Family) -> tuple[FloatArray, FloatArray]:
    """Where the two lines of sliders are parallel: in the same place for all variants, which close on both sides."""
    step = family.plan.steps[-1]
    assert isinstance(step, CrossedSliders)
    first, second = step.tracks
    angle = SECOND + float(np.angle(second.lead / first.lead))
    return np.full(len(family), angle), np.full(len(family), 2.0)


def _at(family: Family, angle: FloatArray) -> tuple[Family, tuple[Course, Course, Course]]:
    """The family with the first crank at each variant's own angle: its points turned, not the crank.

    Lines on the crank cannot be turned so; they have one angle for all.
    """
    left = 0.0
    places = dict(family.places)
    if family.kind == "PRP":
        left = float(angle[0])
    else:
        places |= {one: place * np.exp(1j * angle) for one, place in places.items() if one[0] == "left"}
    courses = ({"left": left, "right": SECOND}, {"left": 1.0, "right": -0.6}, {"left": 0.3, "right": -0.2})
    values = tuple({crank: np.array([value]) for crank, value in course.items()} for course in courses)
    return dataclasses.replace(family, places=places), (values[0], values[1], values[2])
