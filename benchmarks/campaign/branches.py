"""Closed forms never leave their branch, however few the steps of a turn are and however near the change point."""

import math
from dataclasses import dataclass

import numpy as np

from benchmarks.campaign.read import field
from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.batch import sweep
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.num.compiled import compiled


@dataclass
class Branches:
    """What became of crank-rockers: greatest Grashof ratio, samples checked, and those on a wrong branch."""

    mechanisms: int = 0
    greatest: float = 0.0
    samples: int = 0
    wrong: int = 0


STEPS = (36, 72, 360)
"""Steps a turn."""

FINE = 100
"""Finer steps in each of the most."""


def crank_rockers(count: int, rng: np.random.Generator) -> Branches:
    """Random crank-rockers with Grashof ratios up to 0.99999, on both branches, at few steps a turn.

    What they are held to knows nothing of branches: from the first pose on, the way of the coupler's pin that goes on
    without a jump over a hundred times finer steps, by the nearer of the two places where it can be.
    """
    found = Branches()
    chain = plan(four_bar(1.0, 0.5, 1.0, 1.0, branch=+1))
    around = np.exp(2j * np.pi * np.arange(max(STEPS) * FINE) / (max(STEPS) * FINE))
    while found.mechanisms < count:
        lengths, ratio = _crank_rockers(min(256, count - found.mechanisms), rng)
        ground, crank, coupler, rocker = lengths
        signs = rng.choice([-1.0, 1.0], len(crank))
        places = {
            ("ground", "B0"): ground + 0j,
            ("crank", "A"): crank + 0j,
            ("coupler", "B"): coupler + 0j,
            ("rocker", "B"): rocker + 0j,
        }
        found.mechanisms += len(crank)
        found.greatest = max(found.greatest, float(ratio.max()))
        right = np.empty((len(crank), max(STEPS)), dtype=complex)
        for k in range(len(crank)):
            follow(lengths[:, k].copy(), signs[k], around, right[k])
        for steps in STEPS:
            angle = np.arange(steps) * (2 * np.pi / steps)
            swept = sweep(chain, places, angle, branches={"B": signs}, points=[("rocker", "B")])
            stride = max(STEPS) // steps
            apart = np.abs(field(swept, "rocker", "B", 0) - right[:, ::stride])
            found.samples += apart.size
            found.wrong += int((~(apart <= 1e-9)).sum() + (swept.status != Status.OK).sum())
    return found


def _crank_rockers(count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Ground, crank, coupler, rocker [m], the crank the shortest; and (shortest + longest) / (the others)."""
    three = rng.uniform(0.3, 2.0, (3, count))
    three = np.where(three.max(axis=0) < three.sum(axis=0) - three.max(axis=0), three, three[:1])
    ratio = 1 - 10.0 ** rng.uniform(-5, -0.5, count)
    longest = three.max(axis=0)
    crank = ratio * (three.sum(axis=0) - longest) - longest
    good = (crank > 0.02) & (crank < three.min(axis=0))
    if not good.all():
        more, ratios = _crank_rockers(int((~good).sum()), rng)
        three[:, ~good], crank[~good], ratio[~good] = more[[0, 2, 3]], more[1], ratios
    return np.stack([three[0], crank, three[1], three[2]]), ratio


@compiled
def _places(ground: float, pin: complex, coupler: float, rocker: float) -> tuple[complex, complex]:
    """Where the rocker's pin can be: left and right of the line from the crank's pin to the ground's."""
    away = ground - pin
    square = away.real * away.real + away.imag * away.imag
    along = 0.5 * (square + coupler * coupler - rocker * rocker) / square
    height = math.sqrt(max(coupler * coupler / square - along * along, 0.0))
    return pin + complex(along, height) * away, pin + complex(along, -height) * away


@compiled
def follow(lengths: FloatArray, sign: float, around: ComplexArray, kept: ComplexArray) -> None:
    """The rocker's pin over a turn by continuity alone, the crank in the fine directions `around`; some are kept.

    It sets out where the two places are farthest apart, so that its first steps are in no doubt.
    """
    ground, crank, coupler, rocker = lengths
    fine, stride = len(around), len(around) // len(kept)
    start, most = 0, -1.0
    for k in range(0, fine, stride):
        one, other = _places(ground, crank * around[k], coupler, rocker)
        if abs(one - other) > most:
            start, most = k, abs(one - other)
    before, last = 0j, 0j
    for step in range(fine):
        k = (start + step) % fine
        one, other = _places(ground, crank * around[k], coupler, rocker)
        expected = 2 * last - before
        if step == 0:
            last = expected = one if sign > 0 else other
        to_one, to_other = one - expected, other - expected
        nearer = to_one.real**2 + to_one.imag**2 <= to_other.real**2 + to_other.imag**2
        before, last = last, one if nearer else other
        if k % stride == 0:
            kept[k // stride] = last
