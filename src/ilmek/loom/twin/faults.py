"""Stops of a loom: rates, the operator, repairs; as parameters and as the whole numbers that the kernels use.

Each cause is a Poisson process along the programme: distances of faults are exponentially distributed, in metres of
pile yarn, in knots, in passes of the weft or in beats. A fault belongs to the knot or the operation in which it falls.
The positions depend on seed, cause, head and rate alone, not on how long a repair takes.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ilmek.arrays import IntArray
from ilmek.errors import ParameterError
from ilmek.loom.control.ports import Fault
from ilmek.loom.operations import LoomSetup
from ilmek.loom.twin.durations import ns
from ilmek.loom.twin.random import chance_of
from ilmek.params import Params, kind, param
from ilmek.units import hour, minute

CAUSES = (
    Fault.PILE_END, Fault.PILE_BREAK, Fault.MISSED_GRIP, Fault.WEFT_BREAK, Fault.WEFT_END, Fault.WARP_BREAK,
)  # fmt: skip
"""The causes of stops in the order of the tables: the first three of a head's knot, the others of the whole loom."""

OF_A_HEAD = 3
"""Number of causes that concern a head."""

UNIT = 1024
"""Exposure of a knot, a pass or a beat in the whole numbers of the kernels; that of pile yarn is in micrometres."""

RATES = ("pile_end", "pile_break", "gripper_miss", "weft_break", "weft_end", "warp_break")
"""The parameters that are rates, of each of `CAUSES`."""

LONGEST_REPAIR = 24 * hour
"""Largest mean of a repair or a response."""


@dataclass(frozen=True, slots=True)
class StopParams(Params):
    """Rates of stops, the operator, and what comes before and after the weaving."""

    pile_end: float = param(
        0.02e-3, unit="1/km", at_least=0.0, at_most=1.0, doc="packages of pile yarn that end early, per length of yarn"
    )
    pile_break: float = param(0.1e-3, unit="1/km", at_least=0.0, at_most=1.0, doc="breaks of pile yarn, per length")
    gripper_miss: float = kind.ratio(5e-4, at_least=0.0, at_most=0.5, doc="knots that the grippers miss, of all")
    weft_break: float = kind.ratio(15e-5, at_least=0.0, at_most=0.5, doc="breaks of weft per pass")
    weft_end: float = kind.ratio(2e-5, at_least=0.0, at_most=0.5, doc="bobbins of weft that end early, per pass")
    warp_break: float = kind.ratio(1e-7, at_least=0.0, at_most=1e-3, doc="breaks of a warp per beat")
    retries: int = kind.count(2, at_least=0, at_most=100, doc="attempts of the head after a miss, before it calls")
    retry_fails: float = kind.ratio(0.1, at_least=0.0, at_most=1.0, doc="of these attempts, those that miss again")
    others: str = kind.choice(
        "finish", ("finish", "stop"), doc="what the other heads do while one waits: finish their phase, or stop"
    )
    response: float = kind.time(
        60.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean time from a call until a free operator comes"
    )
    looms: int = kind.count(1, at_least=1, at_most=200, doc="looms of an operator")
    repair_pile_end: float = kind.time(60.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean repair of a pile yarn end")
    repair_pile_break: float = kind.time(45.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean repair of a pile break")
    repair_miss: float = kind.time(45.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean repair of a lasting miss")
    repair_weft_break: float = kind.time(18.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean repair of a weft break")
    repair_weft_end: float = kind.time(90.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean change of a weft bobbin")
    repair_warp_break: float = kind.time(172.0, at_least=0.0, at_most=LONGEST_REPAIR, doc="mean repair of a warp break")
    waste: float = kind.length(0.3, unit="m", at_least=0.0, at_most=100.0, doc="pile yarn lost by a repair at a head")
    dressing: float = kind.time(6 * hour, unit="h", at_least=0.0, at_most=1e7, doc="drawing in and tensioning the warp")
    doffing: float = kind.time(60 * minute, unit="min", at_least=0.0, at_most=1e7, doc="taking the carpet off the loom")
    hours: float = kind.time(24 * hour, unit="h", above=0.0, at_most=24 * hour, doc="working time of a day")
    days: int = kind.count(7, at_least=1, at_most=7, doc="working days of a week")

    @property
    def rates(self) -> tuple[float, ...]:
        """Of each of `CAUSES`: per metre of pile yarn, per knot, per pass, per warp and beat."""
        return (self.pile_end, self.pile_break, self.gripper_miss, self.weft_break, self.weft_end, self.warp_break)

    @property
    def repairs(self) -> tuple[float, ...]:
        """Mean repair of each of `CAUSES` [s]."""
        return (self.repair_pile_end, self.repair_pile_break, self.repair_miss, self.repair_weft_break,
                self.repair_weft_end, self.repair_warp_break)  # fmt: skip

    def without_faults(self) -> "StopParams":
        """The same with all rates 0: the loom stops only as planned."""
        return self.with_values(dict.fromkeys(RATES, 0.0))


class FaultTable(NamedTuple):
    """The stops of a loom in whole numbers: times in ns, probabilities Q32 (`ilmek.loom.twin.random`).

    gaps      mean distance of two faults of each of `CAUSES`: 1/1024 of a knot, pass or beat, or um of yarn; 0: none
    repairs   mean repair of each cause        response  mean time until a free operator comes
    busy      probability that the operator is at another loom        queue     mean wait for that
    fails     probability that an attempt after a miss misses again   retries   attempts before the operator is called
    halts     1: the loom stands while a head waits; 0: the other heads finish their phase
    """

    gaps: IntArray
    repairs: IntArray
    response: int
    busy: int
    queue: int
    fails: int
    retries: int
    halts: int


def fault_table(params: StopParams, setup: LoomSetup) -> FaultTable:
    """The table of a loom and its carpet.

    The operator's other looms weave the same carpet: he is busy with a probability rho, the share of his time that they
    need, and then a call waits exponentially with the mean m / (1 - rho), m: mean repair. This is the wait of a queue
    with random calls and one operator (M/M/1; D. R. Cox and W. L. Smith, Queues, 1961, chapter 2).
    Raises ParameterError for an operator who has more work than time.
    """
    yarn = setup.knots * sum(setup.knot_yarn) / len(setup.knot_yarn)
    calls = expected_calls(params, Exposure(setup.knots, yarn, setup.rows, setup.columns))
    work = sum(count * time for count, time in zip(calls, params.repairs, strict=True))
    times = setup.times
    woven = setup.knots * times.knot / setup.heads + setup.rows * times.row_ends[-1]
    load = (params.looms - 1) * work / (woven + work)
    if load >= 1:
        given = f"{params.looms} looms of an operator need {load:.0%} of his time"
        raise ParameterError(given, allowed="below 100 %", do="set fewer looms, or lower rates")
    mean = work / sum(calls) if sum(calls) else 0.0
    warps = 2 * setup.columns
    per_unit = [1e6, 1e6, UNIT, UNIT, UNIT, UNIT / warps]
    gaps = [round(unit / rate) if rate else 0 for unit, rate in zip(per_unit, params.rates, strict=True)]
    return FaultTable(
        np.array(gaps, np.int64),
        np.array([ns(time) for time in params.repairs], np.int64),
        ns(params.response),
        chance_of(load),
        ns(mean / (1 - load)),
        chance_of(params.retry_fails),
        int(params.retries),
        int(params.others == "stop"),
    )


class Exposure(NamedTuple):
    """What of a carpet can stop the loom: knots, pile yarn in them [m], rows and columns of knots."""

    knots: float
    yarn: float
    rows: float
    columns: float


def expected_calls(params: StopParams, exposure: Exposure) -> tuple[float, ...]:
    """Mean number of calls of the operator for the carpet, of each of `CAUSES`."""
    passes, warps = 2 * exposure.rows, 2 * exposure.columns
    exposures = (exposure.yarn, exposure.yarn, exposure.knots, passes, passes, passes * warps)
    lasting = params.retry_fails**params.retries
    shares = (lasting if cause is Fault.MISSED_GRIP else 1.0 for cause in CAUSES)
    return tuple(rate * many * share for rate, many, share in zip(params.rates, exposures, shares, strict=True))


def expected_standstill(params: StopParams, exposure: Exposure) -> float:
    """Mean time for which a loom waits for its operator [s], until he comes and until it is mended: sum n_i (r + t_i).

    Where the other heads finish their phase, and one waits while a slower one ties, the loom stands for less.
    """
    calls = expected_calls(params, exposure)
    return sum(number * (params.response + repair) for number, repair in zip(calls, params.repairs, strict=True))
