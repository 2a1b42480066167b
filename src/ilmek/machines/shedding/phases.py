"""The shed of the cams on the shaft: all of a parity at once, in staggered groups, or for the least torque.

Torque and opening of opposed, staggered cams: `ilmek.cams.opposed_cams`. `flattest` searches every number of groups and
every spread that leaves the shuttle its window for the least of the greatest |torque|.
"""

from functools import partial

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.opposed_cams import OpposedCams, flattest_spread, parities
from ilmek.cams.programme import TURN, CamProgramme
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.warp import LIFTED, warp_force
from ilmek.num.brackets import bracketed_roots
from ilmek.num.piecewise import Curve
from ilmek.records import record
from ilmek.weaving.draping import DrapedWarp

GRID = 2049
"""Angles at which the shed is sampled, besides the ends of the motions; its edges are then found to rounding."""


@record
class Shed(OpposedCams):
    """Both parities of cams, with the warps on them and the shuttle between these."""

    params: SheddingParams

    def draped_torque(self, warp: DrapedWarp) -> FloatArray:
        """Torque of all warps [N m], each like one that is draped over its cam, at `one.angle`."""
        total = np.zeros_like(warp.angle)
        for parity, lag in ((self.even, 0.0), (self.odd, TURN / 2)):
            for number, offset in zip(parity.numbers, self.offsets, strict=True):
                total += number * np.interp(warp.angle - lag - offset, warp.angle, warp.torque, period=TURN)
        return total

    def across(self, angle: FloatArray) -> FloatArray:
        """Force of all lifted warps across the shaft [N]."""
        total = np.zeros_like(angle)
        for number, at in self.moving(angle):
            total += number * np.where(at.s > LIFTED * self.params.lift, self.force(at.s), 0.0)
        return total

    def room(self, angle: FloatArray) -> FloatArray:
        """Height of the even shed above the shuttle [m]; negative where the shuttle does not fit."""
        lowest = np.min([at.s for at in self.even.motions(angle)], axis=0)
        highest = np.max([at.s for at in self.odd.motions(angle)], axis=0)
        return np.asarray(lowest - highest - self.params.shuttle_height)

    def window(self) -> tuple[float, float]:
        """Longest interval of shaft angles in which the even shed has the shuttle's height; its middle twice if none.

        Found on a grid, its edges to rounding. An angle past a turn belongs to the next one.
        """
        angle = np.unique(np.concatenate([self.knots, np.linspace(0.0, TURN, GRID)]))
        edges = np.diff(np.concatenate([[False], self.room(angle) >= 0, [False]]).astype(np.int8))
        begins, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1
        if begins.size == 0:
            return self.params.rise, self.params.rise
        longest = int(np.argmax(angle[ends] - angle[begins]))
        first, last = int(begins[longest]), int(ends[longest])
        return (
            _edge(self.room, float(angle[max(first - 1, 0)]), float(angle[first])),
            _edge(self.room, float(angle[min(last + 1, angle.size - 1)]), float(angle[last])),
        )


def _edge(room: Curve, outside: float, inside: float) -> float:
    """Where the room, negative outside, becomes 0 [rad]."""
    found = float(bracketed_roots(room, np.array([outside]), np.array([inside]))[0])
    return found if np.isfinite(found) else inside


def shed_of(
    params: SheddingParams,
    even: CamProgramme,
    spread: float = 0.0,
    groups: int = 1,
    numbers: tuple[int, int] | None = None,
) -> Shed:
    """The shed of cams by the programme `even`, odd ones half a turn later, in groups over a spread [rad].

    numbers  of even and odd cams; default: half of the warps each
    """
    evens = params.cloth.warps // 2
    cams = parities(even, numbers or (evens, params.cloth.warps - evens), spread, groups if spread else 1)
    return Shed(*cams, spread, partial(warp_force, params), params)


def chosen_shed(params: SheddingParams, even: CamProgramme, numbers: tuple[int, int]) -> Shed:
    """The shed of the phase required, of so many even and odd cams."""
    if params.phase == "together":
        return shed_of(params, even, numbers=numbers)
    if params.phase == "staggered":
        return shed_of(params, even, params.stagger, params.stagger_groups, numbers)
    return flattest(params, even, numbers)


def required_window(params: SheddingParams, together: float) -> float:
    """Required window of the shuttle [rad]: as given, or half of the window of cams `together` [rad]."""
    return together / 2 if params.shuttle_angle is None else params.shuttle_angle


def flattest(params: SheddingParams, even: CamProgramme, numbers: tuple[int, int]) -> Shed:
    """The groups and the spread of least |torque| that leave the shuttle its window; all at once where none does."""
    together = shed_of(params, even, numbers=numbers)
    first, last = together.window()
    widest = _widest(params, even, last - first, required_window(params, last - first))
    most = min(params.stagger_groups, params.cloth.warps // 2)
    found = [(*flattest_spread(together.torque, groups, widest), groups) for groups in range(2, most + 1)]
    best = min(found, default=(np.inf, 0.0, 1))
    return shed_of(params, even, best[1], best[2], numbers)


def _widest(params: SheddingParams, even: CamProgramme, together: float, window: float) -> float:
    """The largest spread [rad] that leaves a window [rad], `together` that of cams without spread.

    The window shrinks by the spread, and more quickly where the other parity limits it.
    """
    most = min(together - window, TURN / 2) * (1 - _SPARE)
    if most <= 0:
        return 0.0

    def spare(spread: FloatArray) -> FloatArray:
        windows = [shed_of(params, even, one, 2).window() for one in spread.tolist()]
        return np.array([last - first - window for first, last in windows])

    if spare(np.array([most]))[0] >= 0:
        return most
    found = float(bracketed_roots(spare, np.zeros(1), np.array([most]))[0])
    return found * (1 - _SPARE) if np.isfinite(found) else 0.0


_SPARE = 1e-9
