"""Durations of a loom's operations in whole nanoseconds, and the rules of time of a programme without faults.

- A knot of a head lasts `knot`, with `colour_change` if its tube differs from the head's last one, and with
  `travel` * max(|column - last column| - 1, 0).
- When a row begins a head stands at its first knot of the row. Before the carpet's first knot the tube is aligned.
- All heads begin a phase together, when the slowest has ended the one before. Travel into a phase counts.
- After the last phase the operations of `row_ends` follow. A stop lasts the sum of its changes' times.
"""

from itertools import pairwise

from ilmek.loom.operations import LoomSetup, OperationTimes, RowEnd, Stop
from ilmek.records import value_record
from ilmek.units import BILLION


def ns(seconds: float) -> int:
    """A time in whole nanoseconds.

    >>> ns(0.016)
    16000000
    """
    return round(BILLION * seconds)


@value_record
class Durations:
    """Durations of a loom's operations [ns], as of `OperationTimes`.

    ends  of each operation after the knots, in the order of `RowEnd`
    """

    knot: int
    colour_change: int
    travel: int
    ends: tuple[int, ...]
    tube_change: int

    @property
    def row_end(self) -> int:
        """Of all operations after the knots of a row [ns]."""
        return sum(self.ends)

    def of_end(self, operation: RowEnd) -> int:
        """Of an operation after the knots [ns]."""
        return self.ends[operation]


def durations_of(times: OperationTimes) -> Durations:
    """The durations of a loom's operations; of the operations after the knots the differences of their ends."""
    until = (0, *(ns(end) for end in times.row_ends))
    ends = tuple(end - begin for begin, end in pairwise(until))
    return Durations(ns(times.knot), ns(times.colour_change), ns(times.travel), ends, ns(times.tube_change))


def change_durations(stop: Stop, setup: LoomSetup) -> tuple[int, ...]:
    """Duration of each change of a stop [ns], in order: its bobbins of weft, then its packages of pile yarn."""
    wefts = (ns(setup.wefts[index].time) for index in stop.wefts)
    return (*wefts, *(ns(setup.times.tube_change) for _ in stop.tubes))


def stop_duration(stop: Stop, setup: LoomSetup) -> int:
    """Duration of a stop [ns]: its changes are made one after the other."""
    return sum(change_durations(stop, setup))
