"""The arms that tie the loom's knots: the knotting dyad for the carpet's own pitch and knot."""

from dataclasses import dataclass
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.machines import knotting_dyad
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.report import Report
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class KnottingArms:
    """The arms of a loom's heads: what their design says where they can tie its knots; else None, and why, in words."""

    report: Report | None
    cannot: str = ""


def arms_of(params: AutomatedLoomParams) -> KnottingArms:
    """The arms for a loom's pitch and knot; never raises for a pitch that they cannot tie at."""
    return _arms(params.pitch, params.knot)


@lru_cache(maxsize=32)
def _arms(pitch: float, knot: str) -> KnottingArms:
    shown = format_quantity(pitch, "mm", 3)
    try:
        arms = knotting_dyad.MACHINE.report(knotting_dyad.design(knotting_dyad.params_at(pitch, knot)), in_a_loom=True)
    except ParameterError as error:
        return KnottingArms(None, f"no arms of a knotting-dyad tie on warps {shown} apart: {error.given}")
    if not arms.failed:
        return KnottingArms(arms)
    why = "; ".join(arms.warnings) or ", ".join(check.name for check in arms.failed)
    return KnottingArms(None, f"the arms of a knotting-dyad cannot tie on warps {shown} apart: {why}")
