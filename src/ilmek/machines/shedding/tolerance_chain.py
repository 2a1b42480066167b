"""The chain of tolerances along a cam shaft: the sheets of cams, guide cams and spacers, and the shims between them.

Hundreds of sheets fill the width without play, and their deviations add up. After every n pitches a place of the stack
is filled by shims, which are chosen when the stack is built, so that the next cam stands at its warp again. With guide
cams of one shaft the shims are as high as a guide cam, and stand beside a thin one in its place; else they are rings in
the place of a spacer. The places are measured from one end, so that what a shim leaves does not add up.

    worst case    sum of the tolerances of n pitches <= range r of the shims: no sheet must be ground
    statistical   statistical sum of n pitches + step / 2 + gauge <= distance of a cam from its warp that is allowed
    groove        thickness of a cam at its lower limit >= diameter of the warp

The interval n is the largest that keeps both sums, 1 at least.                                          [derived]
"""

from bisect import bisect_left

from ilmek.elements.sheet_tolerances import sheet_tolerance, statistical_sum, worst_sum
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.stack import PitchShares
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm

STEP = 0.05 * mm
"""Step of a pile of shim rings of 0.1, 0.15, 0.2 mm and more [m]: DIN 988."""

SHIMS = tuple(thickness * mm for thickness in (0.1, 0.15, 0.2, 0.3, 0.5, 1.0))
"""Thicknesses of the sheets of which a pile is chosen [m]: DIN 988."""

GAUGE = 0.03 * mm
"""Uncertainty of a cam's place, measured from the end of the stack [m]; assumed by this project."""

_MOST = 1000


@record
class ToleranceChain:
    """The chain from one pile of shims to the next.

    interval     pitches from one pile of shims to the next      shims  nominal thickness of a pile, its range [m]
    worst        sum of the tolerances of these pitches [m]
    statistical  distance of a cam from its warp that 99.7 % of them keep [m]
    groove       least thickness of a cam: the groove of its warp, or room between neighbours for a reed [m]
    """

    interval: int
    shims: float
    worst: float
    statistical: float
    groove: float


def tolerance_chain(params: SheddingParams, shares: PitchShares) -> ToleranceChain:
    """The chain of a shaft whose pitch is shared so."""
    quality, limit = params.sheet_tolerance, params.offset_limit * params.cloth.warp_pitch
    widths = ((1, shares.thickness), (shares.guides, shares.guide), (int(shares.spacer > 0), shares.spacer))
    sheets = [(number, sheet_tolerance(width, quality)) for number, width in widths if number]

    def pile(interval: int) -> list[tuple[int, float]]:
        return [(interval * number, tolerance) for number, tolerance in sheets]

    def offset(interval: int) -> float:
        return statistical_sum(pile(interval)) + STEP / 2 + GAUGE

    def loose(interval: int) -> bool:
        return worst_sum(pile(interval)) > room + _ROUNDING or offset(interval) > limit

    room = shims_of(params, shares)
    interval = params.shim_interval or max(bisect_left(range(_MOST + 1), True, lo=2, key=loose) - 1, 1)
    tolerance = sheets[0][1]
    reed = 2 * params.cloth.warp_pitch - shares.thickness
    groove = (shares.thickness if shares.guides else reed) - tolerance
    return ToleranceChain(interval, room, worst_sum(pile(interval)), offset(interval), groove)


def shims_of(params: SheddingParams, shares: PitchShares) -> float:
    """Nominal thickness of the shims at a place, all of which can be left out [m]."""
    if shares.spacer > 0:
        return shares.spacer
    return max(min(shares.guide / 2, shares.guide - params.least_plate), 0.0) if shares.guides else 0.0


def chain_checks(params: SheddingParams, shares: PitchShares) -> tuple[Check, ...]:
    """The chain against the range of its shims, the warps' places, and the groove against the warp."""
    chain = tolerance_chain(params, shares)
    standard = f"EN 10131, {params.sheet_tolerance} tolerances"
    closer = "set sheet_tolerance=special, fewer pitches in shim_interval, or a coarser pitch"
    source = f"{standard}, mean and scatter; assumed by this project: parameter offset_limit"
    offset = params.offset_limit * params.cloth.warp_pitch
    wider = "set a larger warp_clearance or cam_thickness, sheet_tolerance=special, or thinner warps"
    return (
        at_most("cam stack, worst case", chain.worst, chain.shims, "mm", f"{standard}; shims of a place").with_cure(
            closer
        ),
        at_most("cam stack, statistical", chain.statistical, offset, "mm", source).with_cure(closer),
        at_least("groove against warp", chain.groove, params.diameter, "mm", f"warp; {standard}").with_cure(wider),
    )


_ROUNDING = 1e-12
