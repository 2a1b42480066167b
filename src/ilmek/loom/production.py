"""Breakdown of the weaving time of a programme, and the time of the best hand weaver."""

from dataclasses import dataclass

from ilmek.loom.programme import Programme

HAND_KNOT = 2.4
"""Time of the best hand weaver per knot [s]: 25 knots a minute."""


@dataclass(frozen=True, slots=True)
class Production:
    """Breakdown of the weaving time of a carpet [s].

    total        weaving time                       wefts      share of wefts and beats
    stops        share of the stops in which bobbins and packages are changed
    tying, changing, travelling, waiting            shares of the heads, their mean; their sum is the rest of the total
    knots        number of knots                    by_hand    time of the best hand weaver for the knots alone
    """

    total: float
    wefts: float
    stops: float
    tying: float
    changing: float
    travelling: float
    waiting: float
    knots: int
    by_hand: float

    @property
    def knots_per_minute(self) -> float:
        """Knots per minute of all heads, including wefts and waiting [1/min]."""
        return 60 * self.knots / self.total

    @property
    def utilisation(self) -> float:
        """Mean share of the weaving time in which a head ties [-]."""
        return self.tying / self.total


def production_time(programme: Programme) -> Production:
    """Breakdown of the weaving time of a programme [s], by the times of its loom."""
    times, work, heads = programme.times, programme.work, programme.heads
    wefts = programme.rows * times.weft
    knots = int(work.knots.sum())
    tying, changing = knots * times.knot / heads, int(work.changes.sum()) * times.colour_change / heads
    busy = float(work.busy.sum()) / heads
    total, stops = programme.duration, programme.stop_time
    waiting = max(0.0, total - wefts - stops - busy)
    # The remaining working time of a head is travel.
    travelling = max(0.0, busy - tying - changing)
    return Production(total, wefts, stops, tying, changing, travelling, waiting, knots, knots * HAND_KNOT)
