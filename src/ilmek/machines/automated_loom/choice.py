"""The kinds of beat that a loom may have, each with its drive, and the checks of what is wished of a loom."""

import math
from collections.abc import Callable
from functools import lru_cache

from ilmek.elements.prices import price_of, read_prices
from ilmek.machines import BEATS
from ilmek.machines.automated_loom.cyclogram import RowTiming
from ilmek.machines.automated_loom.params import AUTO
from ilmek.machines.beat import BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import format_quantity


@record
class BeatOption:
    """A kind of beat for the loom: its plan, its task with side view and period, and the timing of the row with it.

    Its drive, the price of that and its checks are computed where they are read: a given beat is not compared.
    """

    kind: str
    plan: PlannedBeat
    task: LoomTask
    timing: RowTiming

    @property
    def period(self) -> float:
        """Time of a row's wefts and beats [s]."""
        return self.task.period

    @property
    def drive(self) -> BeatDrive:
        """Its drive at that period."""
        return _drive(self)

    @property
    def price(self) -> float:
        """Price of the parts of its drive."""
        prices = read_prices(self.task.params.prices)
        return sum(price_of(part, prices) for part in self.drive.parts)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Whether it does its work in the loom."""
        return (row_check(self.drive), *self.drive.checks, *self.drive.machine_checks)


@lru_cache(maxsize=64)
def _drive(option: BeatOption) -> BeatDrive:
    return option.plan.drive(option.task)


def beat_options(task: LoomTask, timed: Callable[[PlannedBeat], tuple[LoomTask, RowTiming]]) -> tuple[BeatOption, ...]:
    """The kinds of beat that the loom may have, in ascending order of their prices.

    timed  plan of a beat -> the task with the side view for it and the period of the row, and the timing of the row
    """
    options: list[BeatOption] = []
    for kind in BEATS if task.params.beat == AUTO else (task.params.beat,):
        component = MACHINES[BEATS[kind]]
        assert component.beat is not None
        plan: PlannedBeat = component.beat(task, kind)
        options.append(BeatOption(kind, plan, *timed(plan)))
    if len(options) > 1:
        options.sort(key=lambda option: (option.price, option.period))
    return tuple(options)


def deadline_check(
    deadline: float, time: float, cure: str = "set more heads, aim=time, a later deadline, or a coarser quality"
) -> Check:
    """Whether the carpet is woven within the deadline [s], by the estimated time [s]."""
    return at_most("weaving time, estimated", time, deadline, "h", "parameter deadline").with_cure(cure)


def weavers_deadline_check(deadline: float, time: float, needed: int | None, width: float) -> Check:
    """The same where weavers tie: no weaver is quicker, so that persons are missing.

    needed  weavers who would keep it, whether they find room or not; None: no number does      width  of one [m]
    """
    wide = format_quantity((needed or 0) * width, "m")
    cure = f"{needed} weavers are needed, who find room on {wide}: set a later deadline, or knotting=cams"
    alone = "no number of weavers is enough: set a later deadline"
    return deadline_check(deadline, time, cure if needed else alone)


def weavers_needed(knots: float, knot_time: float, columns: int) -> int | None:
    """The fewest weavers who tie a row of knots within a time of the row for them [s]; None: no number does.

    >>> weavers_needed(10.0, 3.0, 300), weavers_needed(2.0, 3.0, 300)
    (100, None)
    """
    each = math.floor(knots / knot_time + _ROUNDING)
    return math.ceil(columns / each) if each >= 1 else None


_ROUNDING = 1e-9


def row_check(drive: BeatDrive) -> Check:
    """The distance of the rows that the beat leaves."""
    most = drive.task.cloth.row_distance * (1 + drive.task.params.row_tolerance)
    source = (
        "row pitch of the quality; assumed by this project: parameters row_tolerance, hammer.laid_pitch, "
        "hammer.jammed_pitch, hammer.packing"
    )
    cure = "set beat=auto or beat=comb, or a coarser quality along"
    return at_most("distance of the rows that the beat leaves", drive.row_pitch_left, most, "mm", source).with_cure(
        cure
    )
