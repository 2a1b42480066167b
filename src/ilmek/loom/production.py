"""Where the weaving time of a programme goes, and what the best hand weaver needs for its knots."""

from dataclasses import dataclass

from ilmek.loom.programme import Programme

HAND_KNOT = 2.4
"""The best hand weaver's time for a knot [s]: 25 a minute."""


@dataclass(frozen=True, slots=True)
class Production:
    """Where the weaving time of a carpet goes [s].

    total        weaving time                       wefts      of it, wefts and beats
    tying, changing, travelling, waiting            the rest, as the mean of the heads: together total - wefts
    by_hand      time of the best hand weaver for the knots alone
    """

    total: float
    wefts: float
    tying: float
    changing: float
    travelling: float
    waiting: float
    knots: int
    by_hand: float

    @property
    def knots_per_minute(self) -> float:
        """Knots a minute of all heads, wefts and waiting included."""
        return 60 * self.knots / self.total

    @property
    def utilisation(self) -> float:
        """Share of the weaving time that a head ties, on average."""
        return self.tying / self.total


def production_time(programme: Programme) -> Production:
    """Where the time of a programme goes, on the loom whose times it was made with."""
    times, work, heads = programme.times, programme.work, programme.heads
    wefts = programme.rows * times.weft
    knots = int(work.knots.sum())
    tying, changing = knots * times.knot / heads, int(work.changes.sum()) * times.colour_change / heads
    busy = float(work.busy.sum()) / heads
    total = programme.duration
    waiting = max(0.0, total - wefts - busy)
    # Besides tying and changing, a busy head moves.
    travelling = max(0.0, busy - tying - changing)
    return Production(total, wefts, tying, changing, travelling, waiting, knots, knots * HAND_KNOT)
