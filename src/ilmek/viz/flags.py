"""Names of events flown like flags from their ticks, so that no tick crosses a name and no two names touch."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Flag:
    """A name at a tick: its place along the axis, the line above the axis it is written on, and whether it ends there
    (else it begins there).
    """

    x: float
    tier: int
    leftward: bool


def flags(places: Sequence[float], widths: Sequence[float], end: float) -> list[Flag]:
    """Flags for names of these widths at these places; all lengths in one unit, the axis running from 0 to `end`.

    A name flies to the right of its tick; to the left where it would leave the axis, or would lie across the tick of
    one that flies left. Of names over one another the earlier flies higher (to the left: the later).

    >>> flags([10.0, 20.0, 95.0], [30.0, 30.0, 20.0], 100.0)
    [Flag(x=10.0, tier=1, leftward=False), Flag(x=20.0, tier=0, leftward=False), Flag(x=95.0, tier=0, leftward=True)]
    """
    order = sorted(range(len(places)), key=lambda number: places[number])
    leftward: dict[int, bool] = {}
    nearest = end
    for number in reversed(order):
        leftward[number] = places[number] + widths[number] > nearest and places[number] > widths[number]
        nearest = min(nearest, places[number]) if leftward[number] else nearest
    tiers: dict[int, int] = {}
    for number in [n for n in reversed(order) if not leftward[n]] + [n for n in order if leftward[n]]:
        tiers[number] = _tier(number, tiers, places, widths, leftward)
    return [Flag(place, tiers[number], leftward[number]) for number, place in enumerate(places)]


def _tier(
    number: int, tiers: dict[int, int], places: Sequence[float], widths: Sequence[float], leftward: dict[int, bool]
) -> int:
    """The lowest line on which a name touches none of those placed and lies above every tick it crosses."""

    def extent(one: int) -> tuple[float, float]:
        start = places[one] - widths[one] if leftward[one] else places[one]
        return start, start + widths[one]

    start, stop = extent(number)
    lowest = max((tier + 1 for one, tier in tiers.items() if start <= places[one] <= stop), default=0)
    taken = {tier for one, tier in tiers.items() if extent(one)[0] < stop and extent(one)[1] > start}
    return next(tier for tier in range(lowest, lowest + len(tiers) + 1) if tier not in taken)
