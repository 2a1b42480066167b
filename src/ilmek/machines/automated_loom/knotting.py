"""The arms that tie the loom's knots: the knotting dyad for the carpet's own pitch and knot.

A warp's mass per length goes with its pitch, as the thesis' tension does, so its diameter goes with the root of it: 0.8
mm at 2 mm. The needles take a share of the gap that is left, up to their usual thickness. The finer the pitch, the
thinner the needle, until the yarn bends it into the warps: then arms cannot tie this carpet, which is said.
"""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from ilmek.errors import ParameterError
from ilmek.machines import knotting_dyad
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.report import Report
from ilmek.units import format_quantity, mm

WARP, PITCH = 0.8 * mm, 2 * mm
"""Diameter of a taut warp [m] and its pitch [m]."""

NEEDLE, NEEDLE_SHARE, CLEARANCE, CLEARANCE_SHARE = 0.5 * mm, 0.4, 0.1 * mm, 0.1
"""Of a needle: usual diameter [m], and most of the gap between two warps; the clearance that is asked for, likewise."""

CLOSEST = 0.9
"""Diameter of a warp over its pitch at most."""


SHOWN = ("knotting-dyad-head", "knotting-dyad-passing", "knotting-dyad-moving", "knotting-dyad-cycle")
"""Figures of the arms that the loom's page has; `ilmek design knotting-dyad` has all of them."""


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
        arms = knotting_dyad.report(knotting_dyad.design(arms_params(pitch, knot)))
    except ParameterError as error:
        return KnottingArms(None, f"no arms of a knotting-dyad tie on warps {shown} apart: {error.given}")
    if not arms.failed:
        return KnottingArms(replace(arms, figures=tuple(figure for figure in arms.figures if figure.name in SHOWN)))
    why = "; ".join(arms.warnings) or ", ".join(check.name for check in arms.failed)
    return KnottingArms(None, f"the arms of a knotting-dyad cannot tie on warps {shown} apart: {why}")


def arms_params(pitch: float, knot: str) -> knotting_dyad.KnottingDyadParams:
    """What is asked of the arms. Raises ParameterError where the pitch is beyond all measure."""
    warp = min(WARP * math.sqrt(pitch / PITCH), CLOSEST * pitch)
    gap = pitch - warp
    return knotting_dyad.KnottingDyadParams(
        knot=knot,
        warp_pitch=pitch,
        warp_diameter=warp,
        needle_diameter=min(NEEDLE, NEEDLE_SHARE * gap),
        clearance=min(CLEARANCE, CLEARANCE_SHARE * gap),
        yarn_diameter=min(WARP, gap),
    )
