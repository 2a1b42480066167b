"""The room of a carrier in the shed.

The shed is a wedge from the fell to the cams. Where it is a share r of its opening o at the cams, there is room for a
carrier of depth d, with a play p to both sheets of warps of diameter D, if

    d + 2 p + D = r o,      r < 1

The nearer r is to 1, the farther the cams must stand from the fell, so that r has a limit; where the carrier runs, the
side view of the loom states (`ilmek.machines.arrangement`).                                [similar triangles; derived]
"""

from ilmek.machines.arrangement.spans import HIGHEST_SHARE
from ilmek.machines.weft.params import WeftParams
from ilmek.report import Check, at_most


def needed_opening(params: WeftParams, depth: float) -> float:
    """Opening of the shed that a carrier of a depth [m] needs where it runs [m].

    >>> round(needed_opening(WeftParams(play=0.003), 0.026), 4)
    0.0329
    """
    return depth + 2 * params.play + params.cloth.carpet_yarns.warp.diameter


def shed_check(params: WeftParams, opening: float, thinner: str, part: str) -> Check:
    """Whether the shed opens far enough; thinner: what to set for a thinner carrier, part: its id."""
    source = "0.8 of the opening at the cams, assumed by this project; parameters lift, open_share, play"
    return at_most(
        "opening of the shed for the carrier", opening, HIGHEST_SHARE * params.open_share * params.lift, "mm", source
    ).with_cure(f"set a higher lift, or {thinner}", part)
