"""The kinds of beat that a loom may have, each with its drive, and the checks of what is wished of a loom."""

from collections.abc import Callable

from ilmek.elements.prices import price_of, read_prices
from ilmek.machines import BEATS
from ilmek.machines.automated_loom.params import AUTO
from ilmek.machines.beat import BeatDrive, PlannedBeat
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.report import Check, at_most


@record
class BeatOption:
    """A kind of beat for the loom: its plan, the row's period with it [s], its drive, price and checks."""

    kind: str
    plan: PlannedBeat
    period: float
    drive: BeatDrive
    price: float
    checks: tuple[Check, ...]


def beat_options(task: LoomTask, task_of: Callable[[PlannedBeat], LoomTask]) -> tuple[BeatOption, ...]:
    """The kinds of beat that the loom may have, in ascending order of their prices.

    task_of  plan of a beat -> the task with the side view for it, and the time of a row's wefts and beats
    """
    params, prices = task.params, read_prices(task.params.prices)
    options: list[BeatOption] = []
    for kind in BEATS if params.beat == AUTO else (params.beat,):
        component = MACHINES[BEATS[kind]]
        assert component.beat is not None
        plan: PlannedBeat = component.beat(task, kind)
        planned = task_of(plan)
        drive = plan.drive(planned)
        price = sum(price_of(part, prices) for part in drive.parts)
        checks = (row_check(drive), *drive.checks, *drive.machine_checks)
        options.append(BeatOption(kind, plan, planned.period, drive, price, checks))
    return tuple(sorted(options, key=lambda one: (one.price, one.period)))


def deadline_check(
    deadline: float, time: float, cure: str = "set more heads, aim=time, a later deadline, or a coarser quality"
) -> Check:
    """Whether the carpet is woven within the deadline [s], by the estimated time [s]."""
    return at_most("weaving time, estimated", time, deadline, "h", "parameter deadline").with_cure(cure)


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
