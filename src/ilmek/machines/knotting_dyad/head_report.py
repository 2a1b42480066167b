"""What is said of the knotting head: the knot it ties, its clearances, its phases and the servo angles of its way."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import GREATEST_DEPTH, WarpSection
from ilmek.machines.knotting_dyad.yarn import MISSED
from ilmek.num.brackets import bracketed_roots
from ilmek.report import Check, Column, Json, Result, Table, at_least, at_most
from ilmek.units import format_quantity

TABLED = 40
"""Every so many places of the way are told."""


def head_results(head: Head) -> tuple[Result, ...]:
    """The head's results."""
    section, arm = head.section, head.arm
    phases: list[Json] = [
        {
            "name": one.name,
            "left": list(one.left),
            "right": list(one.right),
            "centre": list(one.centre),
            "carries": list(one.carries),
        }
        for one in head.phases
    ]
    apart: dict[str, Json] = {one.name: one.value for one in head.clearances}
    room: dict[str, Json] = {"inner": abs(arm.first - arm.second), "outer": arm.first + arm.second}
    return (
        Result("knot_tied", head.knot_tied, "", "the knot that the motion is proved to tie, none if not the one asked"),
        Result("proof", head.proof, "", "what the proof of the yarn's way says"),
        Result("clearance_min", head.clearance_min, "mm", "least of all clearances over the cycle, below 0: overlap"),
        Result("clearances", apart, "", "each least distance over the cycle [m]"),
        Result("clearance_bound", section.clearance_bound, "mm", "the greatest that a needle has at this depth"),
        Result("handover_depth", section.depth, "mm", "of the hand-over behind the warps' axes"),
        Result("needle_length", section.needle_length, "mm", "from the tip to where the second link grows wide"),
        Result("needle_tilt", section.tilt, "deg", "from upright, at the hand-over"),
        Result("needle_bent", head.bent, "um", "aside by the yarn's pull, at the warps' axes"),
        Result("centre_stroke", head.centre_stroke, "mm", "way of the centre gripper"),
        Result("workspace", room, "", "radii about the pivot that bound it, where the arm is singular [m]"),
        Result("phases", phases, "", "of a cycle: arms' s at begin and end, the centre gripper's height [m], carriers"),
        Result("servo_angles", _angles(head), "", "of the left arm along its way, and their derivatives by s [rad]"),
    )


def _angles(head: Head) -> list[Json]:
    way = head.way
    columns = (way.s, *way.theta.T, *way.first.T)
    names = ("s", "theta1", "theta2", "theta1_by_s", "theta2_by_s")
    return [
        {name: float(column[at]) for name, column in zip(names, columns, strict=True)}
        for at in range(0, len(way.s), TABLED)
    ]


def head_checks(params: KnottingDyadParams, head: Head) -> tuple[Check, ...]:
    """The head's checks."""
    section = head.section
    handed = float(abs(head.arm.tip(np.array([1.0]))[0] - section.handover))
    gap = section.pitch - section.warp
    return (
        at_least(
            "the knot asked for is tied, proved: 1", 1.0 if head.knot_tied else 0.0, 1.0, "", "word of the yarn's way"
        ),
        at_least("clearance over the whole cycle", head.clearance_min, section.asked - 1e-9, "mm", "clearance"),
        at_most("needle bent aside by the yarn", head.bent, max(head.clearance_min, 0.0), "um", "clearance_min"),
        at_most("arm and centre gripper apart at the hand-over", handed, MISSED, "um", "grip of the tips"),
        at_most(
            "pile yarn in the gap between the warps", params.yarn_diameter, gap, "mm", "warp_pitch - warp_diameter"
        ),
    )


def head_warnings(params: KnottingDyadParams, head: Head) -> tuple[str, ...]:
    """What to change where something overlaps or comes too near."""
    section, said = head.section, []
    least = min(head.clearances, key=lambda one: one.value)
    if least.value < section.asked - 1e-9:
        found, asked = format_quantity(least.value, "mm", 3), format_quantity(section.asked, "mm")
        said.append(f"{least.name}: {found}, {asked} is asked for; {_mend(params, section)}")
    if head.bent > max(head.clearance_min, 0.0):
        aside = format_quantity(head.bent, "mm", 3)
        said.append(
            f"the yarn bends the needle {aside} aside between the warps: these warps are too close for it; "
            "take a broader needle, narrower links, a wider pitch or an opening"
        )
    return tuple(said)


def _mend(params: KnottingDyadParams, section: WarpSection) -> str:
    """How the needle gets its room."""
    pair = section.pitch - section.warp - 2 * section.asked
    if pair < section.needle:
        fine = f"take a needle of {format_quantity(pair, 'mm', 3)} or less" if pair > 0 else "take finer warps"
        return f"{fine}, or a pitch of {format_quantity(section.pitch + section.needle - pair, 'mm', 3)} or more"
    cosine = (section.warp + section.needle + 2 * section.asked) / section.outer
    across = (section.pitch + section.outer) / 2
    thin = section.needle - 2 * (section.asked - section.clearance_bound)
    ways = [f"a needle of {format_quantity(thin, 'mm', 3)}"] if thin > 0 else []
    if cosine < 1:
        ways.append(f"a depth of {format_quantity(across / math.tan(math.acos(cosine)), 'mm', 3)}")
    opening = _opening(section)
    if opening is not None:
        ways.append(f"an opening of {format_quantity(opening, 'mm', 3)}")
    limit = "" if params.depth else f" (unless given, the depth is {GREATEST_DEPTH:g} pitches at most)"
    return f"try {' or '.join(ways)}{limit}"


def _opening(section: WarpSection) -> float | None:
    """The least opening that gives the outer gaps the clearance at this depth [m], None if none."""

    def spare(opening: FloatArray) -> FloatArray:
        outer = section.pitch + opening
        cosine = np.cos(np.arctan2((section.pitch + outer) / 2, section.depth))
        return np.asarray(outer / 2 * cosine - (section.warp + section.needle) / 2 - section.asked)

    low, high = section.outer - section.pitch, section.outer + 8 * section.pitch
    found = float(bracketed_roots(spare, np.array([low]), np.array([high]))[0])
    return found if math.isfinite(found) else None


def head_tables(head: Head) -> tuple[Table, ...]:
    """Clearances and phases."""
    apart = Table(
        "knotting-dyad-clearances",
        "Least distances over the cycle",
        (Column("of"), Column("distance", "mm"), Column("less at most by", "um")),
        tuple((one.name, one.value, one.sure) for one in head.clearances),
    )
    columns = (
        Column("phase"),
        Column("left arm s"),
        Column("right arm s"),
        Column("centre gripper"),
        Column("yarn's ends"),
    )
    rows = tuple(
        (
            one.name,
            _span(one.left),
            _span(one.right),
            " to ".join(dict.fromkeys(format_quantity(height, "mm", 3) for height in one.centre)),
            ", ".join(carrier or "in the pile" for carrier in one.carries),
        )
        for one in head.phases
    )
    return apart, Table("knotting-dyad-phases", "Phases of a cycle", columns, rows)


def _span(span: tuple[float, float]) -> str:
    return " to ".join(dict.fromkeys(f"{value:g}" for value in span))
