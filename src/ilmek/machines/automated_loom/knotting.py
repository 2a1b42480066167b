"""The arms that can tie the knots in a loom's heads: the knotting dyad for the carpet's own pitch and knot.

The finer the pitch, the thinner the needle, until the yarn bends it into the warps: then arms cannot tie this carpet,
and the loom reports the reason.
"""

from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Child
from ilmek.machines.loom_task import LoomTask
from ilmek.records import record
from ilmek.units import format_quantity

DYAD = "knotting-dyad"


@record
class KnottingArms:
    """The arms of a loom's heads, where they can tie its knots.

    child   the arms; not in the parts list, as an alternative to the head's cams and grippers; None: they cannot tie
    cycle   time of a knot [s]; nan: none           reason  why they cannot tie
    """

    child: Child | None
    cycle: float = float("nan")
    reason: str = ""


def arms_for(task: LoomTask) -> KnottingArms:
    """The arms for a loom's pitch and knot; never raises for a pitch that they cannot tie at."""
    component, shown = MACHINES[DYAD], format_quantity(task.params.pitch, "mm", 3)
    assert component.fit is not None
    try:
        made = component.design(task.parameters(DYAD, component.fit(task)))
    except ParameterError as error:
        return KnottingArms(None, reason=f"no arms of a knotting-dyad tie on warps {shown} apart: {error.given}")
    report = component.report(made, in_a_loom=True)
    if report.failed:
        why = "; ".join(report.warnings) or ", ".join(check.name for check in report.failed)
        return KnottingArms(None, reason=f"the arms of a knotting-dyad cannot tie on warps {shown} apart: {why}")
    return KnottingArms(Child(component, made, 0, report), float(str(report["cycle_time"])))
