"""The loom as a plant: its times, yarns and faults as whole numbers, so that every machine computes the same.

Times are nanoseconds, lengths nanometres, tensions millinewtons, rates counts in 2^63.
"""

import math
from typing import TypeAlias

from ilmek.errors import LoomError
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import LONGEST_PACKAGE, ROW_ENDS, WEFT_OF, LoomSetup, RowEnd, Stop
from ilmek.loom.twin.draws import bound, draw
from ilmek.loom.twin.durations import Durations, durations_of, stop_duration
from ilmek.loom.twin.faults import StopParams
from ilmek.records import record, value_record
from ilmek.units import BILLION
from ilmek.weaving.tension import usual_tension

WATCHDOG = 3
"""Times of its duration after which an operation that does not end is reported as a failure."""

OPEN_SHED, SLACK = (16, 15), (1, 5)
"""Warp tension over that at rest: with the shed open, on a sprung back rest (`weaving.tension`), and when it is low.

Assumed by this project."""

JOG = BILLION
"""Time of a jog [ns]. Assumed by this project."""

HOMING = 3 * BILLION
"""Time in which an axis finds its switch [ns]; one that is there takes its position where it stands. Assumed."""

Limits: TypeAlias = tuple[tuple[int, Fault], ...]
Mark: TypeAlias = tuple[int, str, bool]
"""Time after the begin of an operation [ns], a sensor, its new value."""


@value_record
class FaultRates:
    """Probability of each fault: of a knot, of an insertion of weft, of a beat. It is drawn anew for every attempt.

    seed  of the draws; the same seed gives the same faults, whatever the time at which a knot is tied
    Raises LoomError for a probability that is not from 0 to 1, for a sum above 1, and for a seed below 0.
    """

    seed: int = 0
    pile_end: float = 0.0
    pile_break: float = 0.0
    missed_grip: float = 0.0
    weft_break: float = 0.0
    weft_end: float = 0.0
    warp_break: float = 0.0

    def __post_init__(self) -> None:
        of_knot = self.pile_end, self.pile_break, self.missed_grip
        rates = (*of_knot, self.weft_break, self.weft_end, self.warp_break)
        if not all(0 <= rate <= 1 for rate in rates) or sum(of_knot) > 1 or self.weft_break + self.weft_end > 1:
            raise LoomError(f"rates of faults {rates}", allowed="probabilities from 0 to 1, and their sums too")
        if not 0 <= self.seed < 1 << 64:
            raise LoomError(f"seed {self.seed}", allowed="0 to 2^64 - 1")


def fault_rates(params: StopParams, setup: LoomSetup, seed: int) -> FaultRates:
    """The probabilities of a loom's stops: of a Poisson process along a knot's yarn, a pass, a beat over all warps."""
    yarn = max(setup.knot_yarn, default=0.0)
    return FaultRates(
        seed,
        pile_end=-math.expm1(-params.pile_end * yarn),
        pile_break=-math.expm1(-params.pile_break * yarn),
        missed_grip=-math.expm1(-params.gripper_miss),
        weft_break=-math.expm1(-params.weft_break),
        weft_end=-math.expm1(-params.weft_end),
        warp_break=-math.expm1(-params.warp_break * 2 * setup.columns),
    )


NO_FAULTS = FaultRates()


@record
class PlantModel:
    """What of a loom does not change while it weaves.

    times      durations of its operations
    knot_yarn  pile yarn of a knot of each yarn      tension  of a warp at rest
    marks      changes of sensors during each of `ROW_ENDS`
    limits     a draw below the first limit is its fault, else below the second, ...; of a knot, of each of `ROW_ENDS`
    """

    setup: LoomSetup
    times: Durations
    knot_yarn: tuple[int, ...]
    tension: int
    marks: tuple[tuple[Mark, ...], ...]
    rates: FaultRates
    knot_limits: Limits
    end_limits: tuple[Limits, ...]

    def change_time(self, stop: Stop) -> int:
        """Duration of a stop: its changes one after the other [ns]. Raises LoomError for one that does not exist."""
        setup = self.setup
        for tube in stop.tubes:
            inside = 0 <= tube.head < setup.heads and 0 <= tube.tube < setup.tubes and 0 <= tube.yarn < len(setup.yarns)
            if not inside or not 0 <= tube.length <= LONGEST_PACKAGE:
                raise LoomError(
                    f"a package of {tube.length:g} m of yarn {tube.yarn} for tube {tube.tube} of head {tube.head}",
                    allowed=f"{len(setup.yarns)} yarns, {setup.tubes} tubes, {setup.heads} heads, all from 0",
                )
        if any(not 0 <= index < len(setup.wefts) for index in stop.wefts):
            raise LoomError(f"bobbins of weft {stop.wefts}", allowed=f"{len(setup.wefts)} bobbins, from 0")
        return stop_duration(stop, setup)

    def knot_fault(self, row: int, column: int, attempt: int) -> Fault | None:
        """What goes wrong with an attempt at a knot, by the rates of faults."""
        if not self.knot_limits:
            return None
        return _drawn(self.knot_limits, draw(self.rates.seed, row * self.setup.columns + column, attempt))

    def end_fault(self, row: int, operation: RowEnd, attempt: int) -> Fault | None:
        """What goes wrong with an attempt at an operation after the knots of a row, by the rates of faults."""
        limits = self.end_limits[operation]
        if not limits:
            return None
        index = self.setup.cells + len(ROW_ENDS) * row + operation
        return _drawn(limits, draw(self.rates.seed, index, attempt))


def plant_model(setup: LoomSetup, rates: FaultRates = NO_FAULTS) -> PlantModel:
    """The plant of a programme's loom."""
    times = durations_of(setup.times)
    return PlantModel(
        setup=setup,
        times=times,
        knot_yarn=tuple(nanometres(length) for length in setup.knot_yarn),
        tension=round(1000 * usual_tension(setup.warp_pitch)),
        marks=tuple(_marks(operation, times.of_end(operation)) for operation in ROW_ENDS),
        rates=rates,
        knot_limits=_limits(
            (rates.pile_end, Fault.PILE_END),
            (rates.pile_break, Fault.PILE_BREAK),
            (rates.missed_grip, Fault.MISSED_GRIP),
        ),
        end_limits=tuple(_end_limits(operation, rates) for operation in ROW_ENDS),
    )


def nanometres(length: float) -> int:
    """A length [m] in whole nanometres."""
    return round(BILLION * length)


def _marks(operation: RowEnd, duration: int) -> tuple[Mark, ...]:
    """The changes of sensors: the shed is open, and the beater away from its rest, in the middle half."""
    if operation == RowEnd.TAKE_UP:
        return ()
    sensor = "shed_closed" if operation in WEFT_OF else "beater_back"
    return (duration // 4, sensor, False), (duration - duration // 4, sensor, True)


def _end_limits(operation: RowEnd, rates: FaultRates) -> Limits:
    if operation in WEFT_OF:
        return _limits((rates.weft_break, Fault.WEFT_BREAK), (rates.weft_end, Fault.WEFT_END))
    return () if operation == RowEnd.TAKE_UP else _limits((rates.warp_break, Fault.WARP_BREAK))


def _limits(*rates: tuple[float, Fault]) -> Limits:
    """Sums of the rates that are not 0, as counts in 2^63."""
    found, total = [], 0
    for rate, fault in rates:
        if rate:
            total += bound(rate)
            found.append((total, fault))
    return tuple(found)


def _drawn(limits: Limits, drawn: int) -> Fault | None:
    for limit, fault in limits:
        if drawn < limit:
            return fault
    return None
