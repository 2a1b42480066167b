"""Names of events beside their ticks, in tiers, so that no tick crosses a name and no two names touch."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Flag:
    """A name at a tick.

    x         position of the tick along the axis
    tier      line above the axis on which the name is written, from 0
    leftward  the name ends at the tick; default: it begins there
    """

    x: float
    tier: int
    leftward: bool


def flags(positions: Sequence[float], widths: Sequence[float], end: float) -> list[Flag]:
    """Flags for names at ticks.

    positions  of the ticks along an axis from 0 to `end`
    widths     of the names, in the same unit

    A name lies to the right of its tick. It lies to the left if it would otherwise leave the axis or cross the tick of
    another leftward name. Of overlapping names the earlier is higher (of leftward ones, the later).

    >>> flags([10.0, 20.0, 95.0], [30.0, 30.0, 20.0], 100.0)
    [Flag(x=10.0, tier=1, leftward=False), Flag(x=20.0, tier=0, leftward=False), Flag(x=95.0, tier=0, leftward=True)]
    """
    order = sorted(range(len(positions)), key=lambda number: positions[number])
    leftward: dict[int, bool] = {}
    nearest = end
    for number in reversed(order):
        leftward[number] = positions[number] + widths[number] > nearest and positions[number] > widths[number]
        nearest = min(nearest, positions[number]) if leftward[number] else nearest
    tiers: dict[int, int] = {}
    for number in [n for n in reversed(order) if not leftward[n]] + [n for n in order if leftward[n]]:
        tiers[number] = _tier(number, tiers, positions, widths, leftward)
    return [Flag(x, tiers[number], leftward[number]) for number, x in enumerate(positions)]


def _tier(
    number: int, tiers: dict[int, int], positions: Sequence[float], widths: Sequence[float], leftward: dict[int, bool]
) -> int:
    """The lowest tier on which a name touches no name placed before and lies above every tick that it crosses."""

    def extent(one: int) -> tuple[float, float]:
        start = positions[one] - widths[one] if leftward[one] else positions[one]
        return start, start + widths[one]

    start, stop = extent(number)
    lowest = max((tier + 1 for one, tier in tiers.items() if start <= positions[one] <= stop), default=0)
    occupied = {tier for one, tier in tiers.items() if extent(one)[0] < stop and extent(one)[1] > start}
    return next(tier for tier in range(lowest, lowest + len(tiers) + 1) if tier not in occupied)
