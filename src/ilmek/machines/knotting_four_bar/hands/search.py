"""The search for hands that tie: four-bars at random near the fingers' centre, the best of them bettered step by step.

At every inclination `tried` four-bars are drawn: the finger's depth, both pivots about its centre C, both pins of the
coupler about C. Those within all limits but the clearance are ranked by it; then each of the best is varied, by steps
that shrink. Of several inclinations the least is taken at which the clearance is enough: there the fingers' path along
the warps is shortest. The random numbers are the same in every run.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.knotting_four_bar.hands.batch import LEAST_LINK, HandBatch, lacks, moved
from ilmek.machines.knotting_four_bar.hands.section import InclinedSection, least_inclination
from ilmek.machines.knotting_four_bar.hands.task import HandsTask
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Json
from ilmek.units import deg, mm, turn

INCLINATIONS = tuple(angle * deg for angle in (0, 30, 45, 60, 70, 75, 78, 80, 82, 84, 85, 86, 87))
"""Inclinations that are searched [rad]."""

DEPTHS, SPREAD, APART, PINS = (0.6 * mm, 8 * mm), 10 * mm, (LEAST_LINK, 24 * mm), (5 * mm, 35 * mm)
"""Bounds of the finger's depth beyond the warps, of the pivots' middle from C, of the pivots from each other, and of
the pins from C [m]."""

POPULATION, HOPELESS = 80, 60
"""Hands that are bettered together, and rounds without any hand within the limits after which it ends."""

COARSE, FINE = (140, 121, 49), (30, 401, 121)
"""Rounds, samples of the coupler's angle and points of a finger's edges: first, and then for what is promising."""

PROMISING = 0.5
"""Clearance of the best hand over the required one with which it goes on."""

TOWARDS, WEIGHT, CROSSED = 0.5, 0.6, 0.9
"""Of the way to the best hand, of the difference of two others, share of the values that change [Storn, Price 1997]."""

SEED = 32

REFUSED = -1.0
"""Rating of hands that just miss a limit: below every clearance [m]."""


@record
class SearchedPlane:
    """What was searched at an inclination [rad].

    tried       four-bars drawn and varied         within  of these within all limits but the clearance
    candidates  of these with the clearance        best    greatest rating of those within [m]; None: none is
    hands       the best, by clearance
    """

    inclination: float
    tried: int
    within: int
    candidates: int
    best: float | None
    hands: HandBatch

    def as_json(self) -> dict[str, Json]:
        """All but the hands [SI]."""
        own = {name: getattr(self, name) for name in ("inclination", "tried", "within", "candidates")}
        return {**own, "clearance": self.best}


def searched(task: HandsTask, progress: Progress = SILENT) -> Iterator[SearchedPlane]:
    """The planes in the order of their inclinations, each as it is searched. Raises Cancelled."""
    bound = least_inclination(task)
    angles = INCLINATIONS if task.inclination is None else (task.inclination,)
    for number, angle in enumerate(angles):
        progress(number / len(angles))
        section = InclinedSection(task, angle)
        if angle < bound:
            yield SearchedPlane(angle, 0, 0, 0, None, HandBatch.of(np.empty((0, 9))))
        else:
            yield _searched(section)


def _searched(section: InclinedSection) -> SearchedPlane:
    random, task = np.random.default_rng(SEED), section.task
    first = drawn(section, task.tried, random)
    rating = _rated(section, first, COARSE)
    counted = np.array([task.tried, np.sum(rating > REFUSED), 0])
    order = np.argsort(-rating, kind="stable")[:POPULATION]
    values, rating = first.values[order], rating[order]
    for stage in (COARSE, FINE):
        if stage is FINE:
            if rating[0] < PROMISING * task.clearance:
                break
            rating = _rated(section, HandBatch.of(values), FINE)
            values, rating = _ordered(values, rating)
        for number in range(stage[0]):
            if not counted[1] and number >= HOPELESS:
                break
            made = _varied(values, random)
            own = _rated(section, HandBatch.of(made), stage)
            enough = (own >= task.clearance) & (stage is FINE)
            counted += np.array([len(own), np.sum(own > REFUSED), np.sum(enough)])
            better = own > rating
            values[better], rating[better] = made[better], own[better]
            values, rating = _ordered(values, rating)
    fit = rating > REFUSED
    best = float(rating[0]) if fit.any() else None
    tried, within, clear = map(int, counted)
    return SearchedPlane(section.inclination, tried, within, clear, best, HandBatch.of(values[fit]))


def _ordered(values: FloatArray, rating: FloatArray) -> tuple[FloatArray, FloatArray]:
    order = np.argsort(-rating, kind="stable")
    return values[order], rating[order]


def drawn(section: InclinedSection, count: int, random: np.random.Generator) -> HandBatch:
    """Four-bars at random about the fingers' centre, for the left hand."""
    depth = section.task.warp / 2 + random.uniform(*DEPTHS, count)
    centre = -section.half_chord + 1j * (section.radius(depth) - depth)

    def pivots() -> tuple[ComplexArray, ComplexArray]:
        middle = centre + random.uniform(0, SPREAD, count) * np.exp(1j * random.uniform(0, turn, count))
        half = random.uniform(*APART, count) / 2 * np.exp(1j * random.uniform(0, turn, count))
        return middle + half, middle - half

    def pin() -> ComplexArray:
        angle = random.uniform(-0.3, math.pi + 0.3, count)
        return np.asarray(random.uniform(*PINS, count) * np.exp(1j * angle))

    return HandBatch(depth, *pivots(), centre + pin(), centre + pin())


def _varied(values: FloatArray, random: np.random.Generator) -> FloatArray:
    """One variation of each row, the best row first: towards the best, and by the difference of two others."""
    count = len(values)
    first, second = (random.permutation(count) for _ in range(2))
    tried = values + TOWARDS * (values[:1] - values) + WEIGHT * (values[first] - values[second])
    return np.asarray(np.where(random.random(values.shape) < CROSSED, tried, values))


def _rated(section: InclinedSection, hands: HandBatch, stage: tuple[int, int, int]) -> FloatArray:
    """Clearances [m] of hands within the limits, less by what their fingers bend beyond them.

    Of others `REFUSED` less what they lack, -inf without a motion.      stage  as `COARSE`
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        motion, closed = moved(section, hands, stage[1])
        wanting = np.where(closed, lacks(section, motion), np.nan)
    rating = np.where(np.isfinite(wanting), REFUSED - wanting, -np.inf)
    chosen = np.flatnonzero(wanting == 0)
    clear = motion.clearance(section, chosen, stage[2])
    bent = section.bent(motion.radius[chosen] * motion.span[chosen]) * section.cosine
    rating[chosen] = np.minimum(clear, 2 * clear - bent)
    return rating
