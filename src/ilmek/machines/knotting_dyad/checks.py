"""The checks of a knotting dyad: arms, knot, needle and yarn in the gaps, drives."""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.duty import MARGIN
from ilmek.machines.knotting_dyad.arm_drives import BELT, PROFILE, RADIUS, SERVO_BELTS, SLEEVE, TEETH
from ilmek.machines.knotting_dyad.arms import SERVOS, arm_parts
from ilmek.machines.knotting_dyad.design import KnottingDyad, longest_link
from ilmek.machines.knotting_dyad.drives import HeadMotion
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaws import jaw_checks
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import GREATEST_DEPTH, WarpSection
from ilmek.machines.knotting_dyad.strength import arm_strength_checks
from ilmek.machines.knotting_dyad.yarn import MISSED
from ilmek.machines.linkage_strength import equilibrium_test
from ilmek.num.brackets import bracketed_roots
from ilmek.report import Check, at_least, at_most, must
from ilmek.timing.path_speed.solve import TOLERANCE
from ilmek.units import format_quantity

CLOSURE, BALANCE, ROUNDING = 1e-9, 1e-9, 1e-9
MOVE = "move a point or an angle"


def dyad_checks(design: KnottingDyad, motion: HeadMotion | None) -> tuple[Check, ...]:
    """The arm to build is within its limits; the knot, the clearances, the limits of the drives."""
    params, head = design.params, design.head
    of_head = () if head is None else (*_knot_checks(params, head), *_needle_checks(params, head), *_gap_checks(head))
    return (
        *_arm_checks(design),
        *of_head,
        *(() if head is None or motion is None else _motion_checks(params, head, motion)),
    )


def dyad_self_tests(design: KnottingDyad, motion: HeadMotion | None) -> tuple[Check, ...]:
    """Every arm closes at its points and meets the centre gripper, and the torques keep the power balance."""
    missed = max(design.residual(dyad) / design.size(dyad) for dyad in design.dyads)
    closes = at_most(
        "closure of every arm at the points, of its size", missed, CLOSURE, "1", "loop equation"
    ).with_cure(MOVE)
    if design.head is None or motion is None:
        return (closes,)
    apart = float(abs(design.head.arm.tip(np.array([1.0]))[0] - design.head.section.handover))
    meets = at_most("arm and centre gripper apart at the hand-over", apart, MISSED, "um", "grip of the tips").with_cure(
        "leave the arm to the design"
    )
    masses = "set masses and speeds within their usual sizes"
    balance = at_most("power balance of the torques", motion.power_error, BALANCE, "1", "virtual power").with_cure(
        masses
    )
    limits = "limits of joints and centre gripper: the motion is as quick as they allow"
    used = at_most("greatest use of a drive's limit", motion.cycle.usage, 1 + TOLERANCE, "1", limits)
    return closes, meets, balance, used, equilibrium_test(motion.strength)


def _arm_checks(design: KnottingDyad) -> tuple[Check, ...]:
    links = sum(1 for dyad in design.dyads if dyad.first)
    real = at_least("real arms of two links", links, 1, "", "the task has three roots").with_cure(MOVE)
    if design.built is None:
        return (real,)
    where = "at the points" if design.head is None else "along the path"
    sine = float(design.bends[design.built]) if design.head is None else design.head.arm.bend
    off = float(np.arcsin(max(sine, 0.0)))
    longest, limits = longest_link(design.dyads[design.built]), design.params
    return (
        real,
        at_most("longest link of the arm to build", longest, limits.link_limit, "mm", "link_limit").with_cure(
            "set a larger link_limit, a smaller pivot_room or bend_limit, or a shorter leg"
        ),
        at_least(
            f"angle between its links, off straight, {where}", off + ROUNDING, limits.bend_limit, "deg", "bend_limit"
        ).with_cure("set a smaller bend_limit, or a larger link_limit"),
    )


def _knot_checks(params: KnottingDyadParams, head: Head) -> tuple[Check, ...]:
    """The knot is tied, everything stays clear, the motors have room."""
    section = head.section
    pivots, tied = 2 * (section.middle - head.arm.pivot.real), 1.0 if head.knot_tied else 0.0
    return (
        at_least("the required knot is tied", tied, 1.0, "", "word of the yarn's path").with_cure(
            "leave depth, opening and leg to the design"
        ),
        at_least(
            "clearance over the whole cycle", head.clearance_min, section.required - ROUNDING, "mm", "clearance"
        ).with_cure(remedy(params, section)),
        at_least(
            "room of the motors between the pivots", pivots, params.pivot_room, "mm", "parameter pivot_room"
        ).with_cure("set a larger link_limit, or a smaller pivot_room"),
    )


def _needle_checks(params: KnottingDyadParams, head: Head) -> Iterator[Check]:
    """The needle neither bends into the warps nor buckles."""
    source = "clearance_min; pull of the yarn assumed by this project: parameter yarn_pull"
    yield at_most("needle bent aside by the yarn", head.bent, max(head.clearance_min, 0.0), "um", source).with_cure(
        "set a broader or thicker needle, narrower links, or a larger opening"
    )
    title, limit = "needle against buckling under the yarn's pull", params.buckling_safety * params.yarn_pull
    yield at_least(
        title, head.buckling, limit, "N", "Euler; assumed by this project: parameters buckling_safety, yarn_pull"
    ).with_cure("set a broader or thicker needle, or narrower links")


def _gap_checks(head: Head) -> tuple[Check, ...]:
    """Yarn, and needle and yarn together, in the opened gaps; the gap of the warps as they stand."""
    section = head.section
    both = section.needle + section.yarn
    pressed = "thickness of the pressed pile assumed by this project: yarns.pressed_packing, yarns.flattening"
    opened = "leave opening and pair_opened to the design, or set a finer pile yarn"
    rooms = (
        ("pile yarn in the gap between the warps", section.yarn, min(section.between, section.beside), "opened gaps"),
        ("needle and pile yarn together, beside the pair", both, section.beside, "room across the needle"),
        ("needle and pile yarn together, between the pair", both, section.between, "gap of the pair"),
    )
    standing = "set a thinner warp, or a wider pitch"
    return (
        *(at_most(name, size, room, "mm", f"{what}; {pressed}").with_cure(opened) for name, size, room, what in rooms),
        at_least("gap between two warps", section.pitch - section.warp, 0.0, "mm", "warps beside each other").with_cure(
            standing
        ),
    )


def _motion_checks(params: KnottingDyadParams, head: Head, motion: HeadMotion) -> tuple[Check, ...]:
    return (
        must("servos of the joints", all(joint.motor for joint in motion.joints), "servos of the table").with_cure(
            "set a lower joint_acceleration, or a gear_ratio", *SERVOS
        ),
        at_most(
            "pull of a belt of the arms",
            MARGIN * motion.torque_max / RADIUS,
            (PROFILE.pull or 0.0) * BELT * (TEETH // 2),
            "N",
            f"{PROFILE.name}, {TEETH // 2} teeth in mesh, margin {MARGIN:g}",
        ).with_cure("set a lower joint_acceleration", *SERVO_BELTS),
        *jaw_checks(params, head, motion.jaws, motion.cycle),
        *arm_strength_checks(motion.strength, {**arm_parts(params, head, motion.hole).ids, "O": SLEEVE}),
    )


def remedy(params: KnottingDyadParams, section: WarpSection) -> str:
    """How the needle gets its room."""
    pair = section.pair - section.warp - 2 * section.required
    if pair < section.needle:
        fine = f"take a needle of {format_quantity(pair, 'mm', 3)} or less" if pair > ROUNDING else "take finer warps"
        return f"{fine}, or a pair of warps {format_quantity(section.pair + section.needle - pair, 'mm', 3)} apart"
    cosine = (section.warp + section.needle + 2 * section.required) / section.outer
    across = (section.pair + section.outer) / 2
    thin = section.needle - 2 * (section.required - section.clearance_bound)
    remedies = [f"a needle of {format_quantity(thin, 'mm', 3)}"] if thin > 0 else []
    if cosine < 1:
        remedies.append(f"a depth of {format_quantity(across / math.tan(math.acos(cosine)), 'mm', 3)}")
    opening = _opening(section)
    if opening is not None:
        remedies.append(f"an opening of {format_quantity(opening, 'mm', 3)}")
    limit = "" if params.depth else f" (unless given, the depth is {GREATEST_DEPTH:g} gaps at most)"
    return f"try {' or '.join(remedies)}{limit}" if remedies else "take finer warps, or a wider pitch"


def _opening(section: WarpSection) -> float | None:
    """The least opening that gives the outer gaps the clearance at this depth [m], None if none."""

    def spare(opening: FloatArray) -> FloatArray:
        outer = section.pitch + opening
        cosine = np.cos(np.arctan2((section.pair + outer) / 2, section.depth))
        return np.asarray(outer / 2 * cosine - (section.warp + section.needle) / 2 - section.required)

    low, high = section.outer - section.pitch, section.outer + 8 * section.pitch
    found = float(bracketed_roots(spare, np.array([low]), np.array([high]))[0])
    return found if math.isfinite(found) else None
