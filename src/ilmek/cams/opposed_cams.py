"""Cams of two parities on one shaft, opposed by half a turn: all at once, or each parity in staggered groups.

The cams of a parity form g groups, taken in turn along the shaft; group k lags by delta_k, evenly from -a/2 to a/2.

    M(theta) = sum over groups of n_k F(s_k) s'_k,   s_k = s(theta - delta_k)
    opening  = least displacement of one parity - largest of the other

The opening depends on the first and the last group alone. Where one cam's torque is m sin(2 theta), g groups give
m |sum n_k e^(2 i delta_k)|: for a given spread nothing is flatter than two groups at its ends, cos(a) of the torque
(each term has the least real part there, and the ends are alike), while g even ones give sin(g a / (g - 1)) /
(g sin(a / (g - 1))). Other motions and forces have more harmonics, so that `flattest_spread` searches the spreads.
[derived here: sum of shifted periodic functions]
"""

from collections.abc import Callable, Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion
from ilmek.num.piecewise import Curve, Extremum, infimum, integral, supremum
from ilmek.records import record


@record
class Parity:
    """The cams of a parity: the programme of each group, and its number of cams."""

    programmes: tuple[CamProgramme, ...]
    numbers: tuple[int, ...]

    def motions(self, angle: FloatArray) -> tuple[FollowerMotion, ...]:
        """Motions of the groups."""
        return tuple(programme.at(angle) for programme in self.programmes)


@record
class OpposedCams:
    """Both parities: `spread` [rad] is the angle between the first and the last group of each.

    force  on one cam along the follower's motion [N], by its displacement [m]
    """

    even: Parity
    odd: Parity
    spread: float
    force: Callable[[FloatArray], FloatArray]

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

    def moving(self, angle: FloatArray) -> Iterator[tuple[int, FollowerMotion]]:
        """Number of cams and motion of each group of both parities."""
        for parity in (self.even, self.odd):
            yield from zip(parity.numbers, parity.motions(angle), strict=True)

    def torque(self, angle: FloatArray) -> FloatArray:
        """Torque of all cams on the shaft [N m], without inertia."""
        groups = self.moving(angle)
        return sum((number * self.force(at.s) * at.ds for number, at in groups), np.zeros_like(angle))

    def opening(self, angle: FloatArray) -> FloatArray:
        """Distance [m] of the least lifted even follower over the most lifted odd one; below 0 if odd ones are up."""
        even, odd = ([at.s for at in parity.motions(angle)] for parity in (self.even, self.odd))
        up = np.min(even, axis=0) - np.max(odd, axis=0)
        down = np.min(odd, axis=0) - np.max(even, axis=0)
        return np.asarray(np.where(up >= down, np.maximum(up, 0.0), -np.maximum(down, 0.0)))

    def peaks(self) -> tuple[Extremum, Extremum]:
        """Largest and least torque over the turn [N m]."""
        return supremum(self.torque, self.knots), infimum(self.torque, self.knots)

    def rms(self) -> float:
        """Root mean square of the torque over the turn [N m]."""
        return float(np.sqrt(integral(lambda angle: self.torque(angle) ** 2, self.knots) / TURN))


def offsets(spread: float, groups: int) -> FloatArray:
    """Lag of each group [rad]: evenly from -spread/2 to spread/2; one group stands in the middle."""
    return np.linspace(-spread / 2, spread / 2, groups) if groups > 1 else np.zeros(1)


def turn_knots(*programmes: CamProgramme) -> FloatArray:
    """Shaft angles of one turn [rad] between which all programmes move smoothly."""
    inner = np.mod(np.concatenate([programme.knots for programme in programmes]), TURN)
    return np.unique(np.concatenate([inner, [0.0, TURN]]))


def parities(even: CamProgramme, cams: tuple[int, int], spread: float, groups: int) -> tuple[Parity, Parity]:
    """The even cams by a programme and the odd ones half a turn later, in groups over a spread [rad].

    cams  number of even and of odd ones
    """
    made_even, made_odd = (
        Parity(
            tuple(even.shifted(lag + float(offset)) for offset in offsets(spread, groups)),
            tuple(number // groups + (index < number % groups) for index in range(groups)),
        )
        for lag, number in zip((0.0, TURN / 2), cams, strict=True)
    )
    return made_even, made_odd


def flattest_spread(together: Curve, groups: int, widest: float) -> tuple[float, float]:
    """Greatest |torque| [N m] and spread [rad] of the flattest of so many groups, by grids that close in on it.

    together  torque of all cams without spread, over the shaft's angle      widest  spread that is allowed [rad]
    """
    angle = np.arange(_TABLE) * (TURN / _TABLE)
    torque = together(angle)
    low, high = 0.0, widest
    for _ in range(_ZOOMS):
        spreads = np.linspace(low, high, _SPREADS)
        at = angle - spreads[:, None, None] * offsets(1.0, groups)[:, None]
        mean = np.interp(at, angle, torque, period=TURN).mean(axis=1)
        peaks = np.max(np.abs(mean), axis=1)
        best = int(np.argmin(peaks))
        low, high = float(spreads[max(best - 1, 0)]), float(spreads[min(best + 1, _SPREADS - 1)])
    return float(peaks[best]), float(spreads[best])


_TABLE, _SPREADS, _ZOOMS = 360, 17, 4
