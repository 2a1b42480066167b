"""The arms that can tie the knots in a loom's heads: the knotting dyad for the carpet's own pitch and knot.

The finer the pitch, the thinner the needle, until the yarn bends it into the warps: then arms cannot tie this carpet,
and the loom reports the reason.
"""

import math
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.component import Child
from ilmek.machines.loom_task import LoomTask
from ilmek.params import Params
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import format_quantity

DYAD = "knotting-dyad"


@record
class KnottingArms:
    """The arms of a loom's heads.

    children  the arms, an alternative to the head's cams and grippers, not in the parts list; empty: none can tie
    cycle     time of a knot [s]; nan: none            reason  why none can tie
    """

    children: tuple[Child, ...]
    cycle: float
    reason: str

    def checks(self, knot_time: float) -> tuple[Check, ...]:
        """Whether the arms, where they can tie, tie within the time of a knot [s]."""
        source = "time of a knot of one head"
        return tuple(at_most("arms of the heads: cycle", self.cycle, knot_time, "s", source) for _ in self.children)


def arms_for(task: LoomTask) -> KnottingArms:
    """The arms for a loom's pitch and knot; never raises for a pitch that they cannot tie at."""
    component, shown = MACHINES[DYAD], format_quantity(task.params.pitch, "mm", 3)
    assert component.fit is not None
    try:
        return _designed(task.parameters(DYAD, component.fit(task)), shown)
    except ParameterError as error:
        return KnottingArms((), math.nan, f"no arms of a knotting-dyad tie on warps {shown} apart: {error.given}")


@lru_cache(maxsize=32)
def _designed(params: Params, shown: str) -> KnottingArms:
    """The same, designed once for each set of parameters."""
    component = MACHINES[DYAD]
    made = component.design(params)
    report = component.report(made, in_a_loom=True)
    if report.failed:
        why = "; ".join(report.warnings) or ", ".join(check.name for check in report.failed)
        reason = f"the arms of a knotting-dyad cannot tie on warps {shown} apart: {why}"
        return KnottingArms((), math.nan, reason)
    return KnottingArms((Child(component, made, 0, report),), float(str(report["cycle_time"])), "")
