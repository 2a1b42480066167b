"""Phases of the cams of a parity on the shaft: all at once, in staggered groups, or for the least torque.

The cams of a parity form g groups, taken in turn along the shaft; group k lags by delta_k, evenly from -a/2 to a/2.

    M(theta) = sum over groups of n_k F(s_k) s'_k,   s_k = s(theta - delta_k)
    opening  = least lifted warp of one parity - most lifted of the other

The opening depends on the first and the last group alone. Where one warp's torque is m sin(2 theta), g groups give
m |sum n_k e^(2 i delta_k)|: for a given spread nothing is flatter than two groups at its ends, cos(a) of the torque
(each term has the least real part there, and the ends are alike), while g even ones give sin(g a / (g - 1)) /
(g sin(a / (g - 1))). Other laws and tensions have more harmonics, so that `flattest` searches every number of groups
and every spread that leaves the shuttle its window for the least of the greatest |M|.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.warp import LIFTED, warp_force
from ilmek.num.brackets import bracketed_roots
from ilmek.num.piecewise import Curve, Extremum, infimum, integral, supremum
from ilmek.records import record
from ilmek.weaving.draping import DrapedWarp

GRID = 2049
"""Angles at which the shed is sampled, besides the ends of the motions; its edges are then found to rounding."""


@record
class Parity:
    """The cams of a parity: the programme of each group, and its number of cams."""

    programmes: tuple[CamProgramme, ...]
    numbers: tuple[int, ...]

    def motions(self, angle: FloatArray) -> tuple[FollowerMotion, ...]:
        """Motions of the groups."""
        return tuple(programme.at(angle) for programme in self.programmes)


@record
class Shed:
    """Both parities: `spread` [rad] is the angle between the first and the last group of each."""

    params: SheddingParams
    even: Parity
    odd: Parity
    spread: float

    @property
    def groups(self) -> int:
        """Groups of each parity."""
        return len(self.even.programmes)

    @property
    def offsets(self) -> FloatArray:
        """Angle by which each group lags behind the middle [rad]."""
        return offsets(self.spread, self.groups)

    @property
    def knots(self) -> FloatArray:
        """Shaft angles of one turn [rad] between which all groups move smoothly."""
        return turn_knots(*self.even.programmes, *self.odd.programmes)

    def _moving(self, angle: FloatArray) -> Iterator[tuple[int, FollowerMotion]]:
        """Number of cams and motion of each group of both parities."""
        for parity in (self.even, self.odd):
            yield from zip(parity.numbers, parity.motions(angle), strict=True)

    def torque(self, angle: FloatArray) -> FloatArray:
        """Torque of the warps on the shaft [N m], quasi-static."""
        moving = self._moving(angle)
        return sum((number * warp_force(self.params, at.s) * at.ds for number, at in moving), np.zeros_like(angle))

    def draped_torque(self, one: DrapedWarp) -> FloatArray:
        """Torque of all warps [N m], each like one that is draped over its cam, at `one.angle`."""
        total = np.zeros_like(one.angle)
        for parity, lag in ((self.even, 0.0), (self.odd, TURN / 2)):
            for number, offset in zip(parity.numbers, self.offsets, strict=True):
                total += number * np.interp(one.angle - lag - offset, one.angle, one.torque, period=TURN)
        return total

    def across(self, angle: FloatArray) -> FloatArray:
        """Force of all lifted warps across the shaft [N]."""
        total = np.zeros_like(angle)
        for number, at in self._moving(angle):
            total += number * np.where(at.s > LIFTED * self.params.lift, warp_force(self.params, at.s), 0.0)
        return total

    def opening(self, angle: FloatArray) -> FloatArray:
        """Distance [m] of the least lifted even warp over the most lifted odd one; negative in the odd shed."""
        even, odd = ([at.s for at in parity.motions(angle)] for parity in (self.even, self.odd))
        up = np.min(even, axis=0) - np.max(odd, axis=0)
        down = np.min(odd, axis=0) - np.max(even, axis=0)
        return np.asarray(np.where(up >= down, np.maximum(up, 0.0), -np.maximum(down, 0.0)))

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

    def peaks(self) -> tuple[Extremum, Extremum]:
        """Largest and least torque over the turn [N m]."""
        return supremum(self.torque, self.knots), infimum(self.torque, self.knots)

    def rms(self) -> float:
        """Root mean square of the torque over the turn [N m]."""
        return float(np.sqrt(integral(lambda angle: self.torque(angle) ** 2, self.knots) / TURN))


def _edge(room: Curve, outside: float, inside: float) -> float:
    """Where the room, negative outside, becomes 0 [rad]."""
    found = float(bracketed_roots(room, np.array([outside]), np.array([inside]))[0])
    return found if np.isfinite(found) else inside


def offsets(spread: float, groups: int) -> FloatArray:
    """Lag of each group [rad]: evenly from -spread/2 to spread/2; one group stands in the middle."""
    return np.linspace(-spread / 2, spread / 2, groups) if groups > 1 else np.zeros(1)


def turn_knots(*programmes: CamProgramme) -> FloatArray:
    """Shaft angles of one turn [rad] between which all programmes move smoothly."""
    inner = np.mod(np.concatenate([programme.knots for programme in programmes]), TURN)
    return np.unique(np.concatenate([inner, [0.0, TURN]]))


def shed_of(params: SheddingParams, even: CamProgramme, spread: float = 0.0, groups: int = 1) -> Shed:
    """The shed of cams by the programme `even`, odd ones half a turn later, in groups over a spread [rad]."""
    if spread == 0:
        groups = 1
    evens = params.warps // 2
    even_cams, odd_cams = (
        Parity(
            tuple(even.shifted(lag + float(offset)) for offset in offsets(spread, groups)),
            tuple(number // groups + (index < number % groups) for index in range(groups)),
        )
        for lag, number in ((0.0, evens), (TURN / 2, params.warps - evens))
    )
    return Shed(params, even_cams, odd_cams, spread)


def chosen_shed(params: SheddingParams, even: CamProgramme) -> Shed:
    """The shed of the phase required."""
    if params.phase == "together":
        return shed_of(params, even)
    if params.phase == "staggered":
        return shed_of(params, even, params.stagger, params.stagger_groups)
    return flattest(params, even)


def required_window(params: SheddingParams, together: float) -> float:
    """Required window of the shuttle [rad]: as given, or half of the window of cams `together` [rad]."""
    return together / 2 if params.shuttle_angle is None else params.shuttle_angle


def flattest(params: SheddingParams, even: CamProgramme) -> Shed:
    """The groups and the spread of least |torque| that leave the shuttle its window; all at once where none does."""
    first, last = shed_of(params, even).window()
    widest = _widest(params, even, last - first, required_window(params, last - first))
    most = min(params.stagger_groups, params.warps // 2)
    found = [_flattest_spread(params, even, groups, widest) for groups in range(2, most + 1)]
    best = min(found, default=(np.inf, 0.0, 1))
    return shed_of(params, even, best[1], best[2])


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


def _flattest_spread(
    params: SheddingParams, even: CamProgramme, groups: int, widest: float
) -> tuple[float, float, int]:
    """Greatest |torque| [N m] and spread [rad] of the flattest of so many groups, by grids that close in on it."""
    angle = np.arange(_TABLE) * (TURN / _TABLE)
    together = shed_of(params, even).torque(angle)
    low, high = 0.0, widest
    for _ in range(_ZOOMS):
        spreads = np.linspace(low, high, _SPREADS)
        at = angle - spreads[:, None, None] * offsets(1.0, groups)[:, None]
        mean = np.interp(at, angle, together, period=TURN).mean(axis=1)
        peaks = np.max(np.abs(mean), axis=1)
        best = int(np.argmin(peaks))
        low, high = float(spreads[max(best - 1, 0)]), float(spreads[min(best + 1, _SPREADS - 1)])
    return float(peaks[best]), float(spreads[best]), groups


_SPARE = 1e-9
_TABLE, _SPREADS, _ZOOMS = 360, 17, 4
