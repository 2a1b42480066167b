"""The loom as a plant: its times, yarns and faults as whole numbers, so that every machine computes the same.

Times are nanoseconds, lengths nanometres, tensions millinewtons, rates counts in 2^63.
"""

from ilmek.errors import LoomError
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import ROW_ENDS, LoomSetup, RowEnd, Stop
from ilmek.loom.twin.draws import bound, draw
from ilmek.records import record, value_record
from ilmek.weaving.tension import usual_tension

WATCHDOG = 3
"""Times of its duration after which an operation that does not end is reported as a failure."""

OPEN_SHED, SLACK = (16, 15), (1, 5)
"""Warp tension over that at rest: with the shed open, on a sprung back rest (`weaving.tension`), and when it is low.

Assumed by this project."""

JOG = 1_000_000_000
"""Time of a jog [ns]. Assumed by this project."""

Mark = tuple[int, str, bool]
"""Time after the begin of an operation [ns], a sensor, its new value."""


@value_record
class FaultRates:
    """Probability of each fault: of a knot, and of an insertion of weft. A fault is drawn anew when it is repeated.

    seed  of the draws; the same seed gives the same faults, whatever the time at which a knot is tied
    Raises LoomError for a probability that is not from 0 to 1, for a sum above 1, and for a seed below 0.
    """

    seed: int = 0
    pile_break: float = 0.0
    missed_grip: float = 0.0
    warp_break: float = 0.0
    weft_break: float = 0.0

    def __post_init__(self) -> None:
        rates = (self.pile_break, self.missed_grip, self.warp_break, self.weft_break)
        if not all(0 <= rate <= 1 for rate in rates) or sum(rates[:3]) > 1:
            raise LoomError(f"rates of faults {rates}", allowed="probabilities from 0 to 1, those of a knot at most 1")
        if not 0 <= self.seed < 1 << 64:
            raise LoomError(f"seed {self.seed}", allowed="0 to 2^64 - 1")


NO_FAULTS = FaultRates()


@record
class PlantModel:
    """What of a loom does not change while it weaves.

    row_ends   duration of each operation after the knots of a row      weft_changes  of a bobbin
    knot_yarn  pile yarn of a knot of each yarn                         tension       of a warp at rest
    marks      changes of sensors during each of `ROW_ENDS`
    limits     a draw below the first limit is its fault, else below the second, ...; of a knot and of a weft
    """

    setup: LoomSetup
    knot: int
    colour_change: int
    travel: int
    row_ends: tuple[int, ...]
    weft_changes: tuple[int, ...]
    tube_change: int
    knot_yarn: tuple[int, ...]
    tension: int
    marks: tuple[tuple[Mark, ...], ...]
    rates: FaultRates
    knot_limits: tuple[tuple[int, Fault], ...]
    weft_limits: tuple[tuple[int, Fault], ...]

    def change_time(self, stop: Stop) -> int:
        """Duration of a stop: its changes one after the other [ns]. Raises LoomError for one that does not exist."""
        setup = self.setup
        for one in stop.tubes:
            inside = 0 <= one.head < setup.heads and 0 <= one.tube < setup.tubes and 0 <= one.yarn < len(setup.yarns)
            if not inside or not 0 <= one.length <= LONGEST_PACKAGE:
                raise LoomError(
                    f"a package of {one.length:g} m of yarn {one.yarn} for tube {one.tube} of head {one.head}",
                    allowed=f"{len(setup.yarns)} yarns, {setup.tubes} tubes, {setup.heads} heads, all from 0",
                )
        if any(not 0 <= index < len(setup.wefts) for index in stop.wefts):
            raise LoomError(f"bobbins of weft {stop.wefts}", allowed=f"{len(setup.wefts)} bobbins, from 0")
        return sum(self.weft_changes[index] for index in stop.wefts) + len(stop.tubes) * self.tube_change

    def knot_fault(self, row: int, column: int, attempt: int) -> Fault | None:
        """What goes wrong with an attempt at a knot, by the rates of faults."""
        if not self.knot_limits:
            return None
        return _drawn(self.knot_limits, draw(self.rates.seed, row * self.setup.columns + column, attempt))

    def end_fault(self, row: int, operation: RowEnd, attempt: int) -> Fault | None:
        """What goes wrong with an attempt at an operation after the knots of a row, by the rates of faults."""
        if not self.weft_limits or operation not in _WEFTS:
            return None
        index = self.setup.knots + len(ROW_ENDS) * row + operation
        return _drawn(self.weft_limits, draw(self.rates.seed, index, attempt))


LONGEST_PACKAGE = 1e6
"""Largest length of yarn on a package [m]."""

_WEFTS = (RowEnd.STRAIGHT_WEFT, RowEnd.SINUOUS_WEFT)


def plant_model(setup: LoomSetup, rates: FaultRates = NO_FAULTS) -> PlantModel:
    """The plant of a programme's loom."""
    times = setup.times
    ends = [nanoseconds(time) for time in times.row_ends]
    durations = tuple(end - begin for begin, end in zip([0, *ends], ends, strict=False))
    return PlantModel(
        setup=setup,
        knot=nanoseconds(times.knot),
        colour_change=nanoseconds(times.colour_change),
        travel=nanoseconds(times.travel),
        row_ends=durations,
        weft_changes=tuple(nanoseconds(one.time) for one in setup.wefts),
        tube_change=nanoseconds(times.tube_change),
        knot_yarn=tuple(nanometres(length) for length in setup.knot_yarn),
        tension=round(1000 * usual_tension(setup.warp_pitch)),
        marks=tuple(_marks(operation, durations[operation]) for operation in ROW_ENDS),
        rates=rates,
        knot_limits=_limits(
            (rates.pile_break, Fault.PILE_BREAK),
            (rates.missed_grip, Fault.MISSED_GRIP),
            (rates.warp_break, Fault.WARP_BREAK),
        ),
        weft_limits=_limits((rates.weft_break, Fault.WEFT_BREAK)),
    )


def nanoseconds(time: float) -> int:
    """A time [s] in whole nanoseconds."""
    return round(1e9 * time)


def nanometres(length: float) -> int:
    """A length [m] in whole nanometres."""
    return round(1e9 * length)


def _marks(operation: RowEnd, duration: int) -> tuple[Mark, ...]:
    """The changes of sensors: the shed is open, and the beater away from its rest, in the middle half."""
    if operation == RowEnd.TAKE_UP:
        return ()
    sensor = "shed_closed" if operation in _WEFTS else "beater_back"
    return (duration // 4, sensor, False), (duration - duration // 4, sensor, True)


def _limits(*rates: tuple[float, Fault]) -> tuple[tuple[int, Fault], ...]:
    """Sums of the rates that are not 0, as counts in 2^63."""
    found, total = [], 0
    for rate, fault in rates:
        if rate:
            total += bound(rate)
            found.append((total, fault))
    return tuple(found)


def _drawn(limits: tuple[tuple[int, Fault], ...], drawn: int) -> Fault | None:
    for limit, fault in limits:
        if drawn < limit:
            return fault
    return None
