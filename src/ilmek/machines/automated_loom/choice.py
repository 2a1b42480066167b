"""What a loom chooses of what its parameters leave open: beat and number of heads; its machines choose the rest.

Candidates stand in ascending order of what `aim` makes least, price or time; for the least cost of a carpet they are
whole looms [`selection`]. The first whose checks all hold is chosen; where none does, the one that misses its limits
least, and its failed checks are the loom's.
"""

from collections.abc import Callable
from dataclasses import replace

from ilmek.elements.prices import price_of, read_prices
from ilmek.machines import BEATS
from ilmek.machines.automated_loom.params import AUTO, AutomatedLoomParams
from ilmek.machines.beat import BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import Alternative, Check, Choice, at_most, choose


@record
class BeatOption:
    """A kind of beat for the loom: its plan, the row's period with it [s], its drive, price and checks."""

    kind: str
    plan: PlannedBeat
    period: float
    drive: BeatDrive
    price: float
    checks: tuple[Check, ...]


def beat_options(task: LoomTask, period_of: Callable[[PlannedBeat], float]) -> tuple[BeatOption, ...]:
    """The kinds of beat that the loom may have, in ascending order of what its aim makes least.

    period_of  plan of a beat -> time of a row's wefts and beats [s]
    """
    params, prices = task.params, read_prices(task.params.prices)
    options: list[BeatOption] = []
    for kind in BEATS if params.beat == AUTO else (params.beat,):
        component = MACHINES[BEATS[kind]]
        assert component.beat is not None
        plan: PlannedBeat = component.beat(task, kind)
        period = period_of(plan)
        drive = plan.drive(replace(task, period=period))
        price = sum(price_of(part, prices) for part in drive.parts)
        checks = (row_check(drive), *drive.checks, *drive.machine_checks)
        options.append(BeatOption(kind, plan, period, drive, price, checks))
    by_time = params.aim == "time"
    return tuple(sorted(options, key=lambda one: (one.period, one.price) if by_time else (one.price, one.period)))


def chosen_heads(
    params: AutomatedLoomParams, most: int, time_of: Callable[[int], float]
) -> tuple[int, tuple[Choice, ...]]:
    """The number of heads: as given; the most, for the least time; the fewest that keep the deadline, for the price.

    most  that fit      time_of  number of heads -> weaving time, estimated [s]
    """
    if params.heads is not None:
        return params.heads, ()
    if params.aim == "time":
        return most, (Choice("heads", str(most), "time", str(most - 1) if most > 1 else ""),)
    if params.deadline is None:
        return 1, (Choice("heads", "1", "price"),)
    candidates = [
        Alternative(str(heads), (deadline_check(params.deadline, time_of(heads)),)) for heads in range(1, most + 1)
    ]
    index, choice = choose("heads", candidates)
    return index + 1, (choice,)


def deadline_check(deadline: float, time: float) -> Check:
    """Whether the carpet is woven within the deadline [s], by the estimated time [s]."""
    cure = "set more heads, aim=time, a later deadline, or a coarser quality"
    return at_most("weaving time, estimated", time, deadline, "h", "parameter deadline", cure=cure)


def row_check(drive: BeatDrive) -> Check:
    """The distance of the rows that the beat leaves."""
    most = drive.task.cloth.row_distance * (1 + drive.task.params.row_tolerance)
    source = (
        "row pitch of the quality; assumed by this project: parameters row_tolerance, hammer.laid_pitch, "
        "hammer.jammed_pitch, hammer.packing"
    )
    cure = "set beat=auto or beat=comb, or a coarser quality along"
    return at_most("distance of the rows that the beat leaves", drive.row_pitch_left, most, "mm", source, cure=cure)
