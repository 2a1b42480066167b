"""The choice of the cam shafts and of what keeps the warps on their cams: the first in which the plates stand.

Candidates in ascending price: fewer shafts first, guide cams before a reed. Their checks are those of the plates.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.elements.nose_buckling import nose_buckling
from ilmek.machines.shedding.cam_shaft import least_prime, of_shaft
from ilmek.machines.shedding.params import AUTO, DISCS, MOST_SHAFTS, REED, SheddingParams
from ilmek.machines.shedding.positions import positions
from ilmek.machines.shedding.stack import PitchShares, shared
from ilmek.machines.shedding.tolerance_chain import chain_checks
from ilmek.machines.shedding.warp import warp_force
from ilmek.report import Alternative, Check, Choice, at_least, at_most, choose

THICKER = "set more shafts, guides=reed, or a coarser pitch"
BUCKLING = "buckling_safety (assumed by this project) on Timoshenko and Gere, 2.14"


@dataclass(frozen=True, slots=True)
class ChosenStack:
    """Number of shafts, kind of guides, how the pitch is shared; choice None where both were given."""

    shafts: int
    guides: str
    shares: PitchShares
    choice: Choice | None


def chosen_stack(params: SheddingParams, slender: float) -> ChosenStack:
    """The first candidate whose plates stand; else the one that is nearest to it.

    slender  prime radius for the pressure angle over the lift
    """
    numbers = (params.shafts,) if params.shafts else range(1, min(MOST_SHAFTS, max(params.cloth.warps // 2, 1)) + 1)
    kinds = (DISCS, REED) if params.guides == AUTO else (params.guides,)
    offered = [(number, kind, shared(params, number, kind)) for number in numbers for kind in kinds]
    if len(offered) == 1:
        return ChosenStack(*offered[0], None)
    candidates: list[Alternative] = []
    for number, kind, shares in offered:
        name = f"{number} shaft{'s' if number > 1 else ''} with {'a reed' if kind == REED else 'guide cams'}"
        judged = *plate_checks(params, shares), *_standing_checks(params, number, shares, slender)
        candidates.append(Alternative(name, judged))
        if all(check.ok for check in judged):
            break
    index, choice = choose("cam shafts", candidates)
    return ChosenStack(*offered[index], choice)


def plate_checks(params: SheddingParams, shares: PitchShares) -> tuple[Check, ...]:
    """Thickness of cams, guide cams or dents, their tolerances, room and play of the warps between them."""
    cut, reed = "assumed by this project: parameter least_plate", shares.guides == 0
    guide = "dent of the reed" if reed else "guide cam"
    return (
        at_least("thickness of a cam", shares.thickness, params.least_plate, "mm", cut).with_cure(THICKER),
        at_least(
            f"thickness of a {guide}",
            shares.guide,
            params.least_dent if reed else params.least_plate,
            "mm",
            "assumed by this project: parameter least_dent" if reed else cut,
        ).with_cure(THICKER),
        at_most(
            "cam, guides and passing warps on a pitch of the shaft",
            shares.used,
            shares.pitch,
            "mm",
            "warp pitch, shafts, diameter and clearance of the warps",
        ).with_cure("set a coarser pitch, or thinner warps"),
        *chain_checks(params, shares),
        at_most(
            "lateral play of a warp",
            shares.play,
            params.play_limit * params.cloth.warp_pitch,
            "mm",
            "assumed by this project: parameter play_limit",
        ).with_cure("set a thinner cam_thickness, or guides=reed"),
    )


def line_check(lifts: list[float], fronts: list[float]) -> Check:
    """That the lifted warps of all shafts lie on one line from the fell: their lifts' deviation at the first shaft."""
    aside = max(abs(lift * fronts[0] / front - lifts[0]) for lift, front in zip(lifts, fronts, strict=True))
    return at_most(
        "deviation of the shafts' shed lines", aside, ONE_LINE, "mm", "one shed for the shuttle; a lift is 1 m at most"
    ).with_cure("set fewer shafts, a longer front_span, or a lower lift")


ONE_LINE = 1e-4
"""Deviation of two shed lines at the first shaft that the warps' thickness hides [m]; assumed by this project."""


def _standing_checks(params: SheddingParams, shafts: int, shares: PitchShares, slender: float) -> tuple[Check, ...]:
    """Buckling on the last shaft, where the lift is highest, and the shed line; before the shafts are designed."""
    prime = params.prime_radius
    along = positions(params, shafts, slender if prime is None else prime / params.lift, least_prime(params))
    last = of_shaft(params, along[-1], along[-1], params.cloth.warps)
    cosine = math.cos(params.pressure_angle_limit)
    force = float(warp_force(last, np.array(last.lift))) / cosine
    critical = float(nose_buckling(shares.thickness, last.lift, cosine, params.modulus))
    spans = params.spans_of_warp
    stands = buckling_check(params.buckling_safety * force, critical), height_check(params, along[-1])
    if spans is None:
        return stands
    return *stands, line_check([params.lift, last.lift], [spans[0], spans[0] + along[-1]])


def height_check(params: SheddingParams, last: float) -> Check:
    """Distance of the last shaft beyond the first [m] against the room for the shafts."""
    title = "distance of the first and the last cam shaft"
    return at_most(
        title, last, params.shafts_height, "m", "assumed by this project: parameter shafts_height"
    ).with_cure("set fewer shafts, a longer front_span, or a lower lift")


def buckling_check(force: float, critical: float) -> Check:
    """Buckling of a cam's nose: force with its safety against the critical force [N]."""
    return at_most("buckling of a cam", force, critical, "N", BUCKLING).with_cure(
        "set more shafts for thicker cams, a lower tension, or a lower pressure_angle_limit"
    )
