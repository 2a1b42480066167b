"""The report of a knotting dyad: checks, warnings, tables."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_dyad.design import KnottingDyad, longest_link
from ilmek.machines.knotting_dyad.drives import HeadMotion, head_motion
from ilmek.machines.knotting_dyad.figures import design_figures, head_figures, motion_figures
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import GREATEST_DEPTH, WarpSection
from ilmek.machines.knotting_dyad.yarn import MISSED
from ilmek.num.brackets import bracketed_roots
from ilmek.records import group, record
from ilmek.report import Check, Figure, Table, at_least, at_most, columns, must
from ilmek.synthesis.dyad import RootKind
from ilmek.timing.path_speed.solve import TOLERANCE
from ilmek.units import format_quantity

CLOSURE, BALANCE, ROUNDING = 1e-9, 1e-9, 1e-9


@record
class DyadAnalysis:
    """A knotting dyad, and where a knot is tied its head and the head's motion."""

    head: Head | None = group()
    motion: HeadMotion | None = group()
    design: KnottingDyad = group()


def analyse(design: KnottingDyad) -> DyadAnalysis:
    """The motion of a design's head."""
    motion = None if design.head is None else head_motion(design.params, design.head)
    return DyadAnalysis(design.head, motion, design)


def checks(found: DyadAnalysis) -> tuple[Check, ...]:
    """Every arm closes, the one to build is within its limits; the knot, the clearances, the limits of the drives."""
    params = found.design.params
    return (
        *_arm_checks(found.design),
        *(() if found.head is None else _head_checks(params, found.head)),
        *(() if found.motion is None else _motion_checks(found.motion)),
    )


def _arm_checks(design: KnottingDyad) -> tuple[Check, ...]:
    missed = max(design.residual(dyad) / design.size(dyad) for dyad in design.dyads)
    links = sum(1 for dyad in design.dyads if dyad.first)
    move = "move a point or an angle"
    closes = at_most(
        "closure of every arm at the points, of its size", missed, CLOSURE, "1", "loop equation", cure=move
    )
    real = at_least("real arms of two links", links, 1, "", "the task has three roots", cure=move)
    if design.built is None:
        return closes, real
    where = "at the points" if design.head is None else "along the way"
    sine = float(design.bends[design.built]) if design.head is None else design.head.arm.bend
    off = float(np.arcsin(max(sine, 0.0)))
    longest, limits = longest_link(design.dyads[design.built]), design.params
    return (
        closes,
        real,
        at_most(
            "longest link of the arm to build",
            longest,
            limits.link_limit,
            "mm",
            "link_limit",
            cure="set a larger link_limit, a smaller pivot_room or bend_limit, or a shorter leg",
        ),
        at_least(
            f"angle between its links, off straight, {where}",
            off + ROUNDING,
            limits.bend_limit,
            "deg",
            "bend_limit",
            cure="set a smaller bend_limit, or a larger link_limit",
        ),
    )


def _head_checks(params: KnottingDyadParams, head: Head) -> tuple[Check, ...]:
    section = head.section
    apart = float(abs(head.arm.tip(np.array([1.0]))[0] - section.handover))
    tied, both = 1.0 if head.knot_tied else 0.0, section.needle + section.yarn
    pressed = "thickness of the pressed pile assumed by this project: yarns.pressed_packing, yarns.flattening"
    opened = "leave opening and pair_opened to the design, or set a finer pile yarn"
    pivots = 2 * (section.middle - head.arm.pivot.real)
    return (
        at_least(
            "the knot asked for is tied, proved: 1", tied, 1.0, "", "word of the yarn's path", cure="leave the sequence"
        ),
        at_least(
            "clearance over the whole cycle",
            head.clearance_min,
            section.required - ROUNDING,
            "mm",
            "clearance",
            cure=_remedy(params, section),
        ),
        at_most(
            "needle bent aside by the yarn",
            head.bent,
            max(head.clearance_min, 0.0),
            "um",
            "clearance_min; pull of the yarn assumed by this project: parameter yarn_pull",
            cure="set a broader or thicker needle, narrower links, or a larger opening",
        ),
        at_least(
            "needle against buckling under the yarn's pull",
            head.buckling,
            params.buckling_safety * params.yarn_pull,
            "N",
            "Euler; assumed by this project: parameters buckling_safety, yarn_pull",
            cure="set a broader or thicker needle, or narrower links",
        ),
        at_most(
            "arm and centre gripper apart at the hand-over",
            apart,
            MISSED,
            "um",
            "grip of the tips",
            cure="leave the arm to the design",
        ),
        at_most(
            "pile yarn in the gap between the warps",
            section.yarn,
            min(section.between, section.beside),
            "mm",
            f"gaps of the opened warps; {pressed}",
            cure=opened,
        ),
        at_most(
            "needle and pile yarn together, beside the pair",
            both,
            section.beside,
            "mm",
            f"room across the needle; {pressed}",
            cure=opened,
        ),
        at_most(
            "needle and pile yarn together, between the pair",
            both,
            section.between,
            "mm",
            f"gap of the pair; {pressed}",
            cure=opened,
        ),
        at_least(
            "gap between two warps",
            section.pitch - section.warp,
            0.0,
            "mm",
            "warps beside each other",
            cure="set a thinner warp, or a wider pitch",
        ),
        at_least(
            "room of the motors between the pivots",
            pivots,
            params.pivot_room,
            "mm",
            "parameter pivot_room",
            cure="set a larger link_limit, or a smaller pivot_room",
        ),
    )


def _motion_checks(motion: HeadMotion) -> tuple[Check, ...]:
    used = "greatest use of a drive's limit: speed, acceleration, jerk"
    return (
        at_most(
            used,
            motion.cycle.usage,
            1 + TOLERANCE,
            "1",
            "limits of joints and centre gripper",
            cure="set higher limits of speed, acceleration and jerk",
        ),
        must(
            "servos of the joints",
            all(joint.motor for joint in motion.joints),
            "servos of the table",
            cure="set a lower joint_acceleration, or a gear_ratio",
        ),
        at_most(
            "power balance of the torques",
            motion.power_error,
            BALANCE,
            "1",
            "virtual power",
            cure="set masses and speeds within their usual sizes",
        ),
    )


def warnings(found: DyadAnalysis) -> tuple[str, ...]:
    """Roots without an arm, changes where something overlaps or comes too near, joints for which no servo is enough."""
    design, head, motion = found.design, found.head, found.motion
    return (
        *(_arm_warnings(design) if head is None else _head_warnings(design.params, head)),
        *(() if motion is None else _motion_warnings(motion)),
    )


def _arm_warnings(design: KnottingDyad) -> tuple[str, ...]:
    odd = [kind.words for kind in dict.fromkeys(design.kinds) if kind not in (RootKind.ARM, RootKind.COMPLEX)]
    warned = [f"one root is no arm of two links: {words}" for words in odd]
    if design.built is not None and design.bends[design.built] <= 0:
        warned.append(
            f"arm {design.chosen} has its elbow on both sides at the points: between them it must pass a stretched pose"
        )
    return tuple(warned)


def _head_warnings(params: KnottingDyadParams, head: Head) -> tuple[str, ...]:
    section, warned = head.section, []
    least = min(head.least, key=lambda one: one.value)
    if least.value < section.required - ROUNDING:
        found, required = format_quantity(least.value, "mm", 3), format_quantity(section.required, "mm")
        warned.append(f"{least.name}: {found}, {required} is required; {_remedy(params, section)}")
    if head.bent > max(head.clearance_min, 0.0):
        aside = format_quantity(head.bent, "mm", 3)
        warned.append(
            f"the yarn bends the needle {aside} aside between the warps: these warps are too close for it; "
            "take a broader needle, narrower links, a wider pitch or an opening"
        )
    return tuple(warned)


def _motion_warnings(motion: HeadMotion) -> tuple[str, ...]:
    return tuple(
        f"no servo of the catalogue gives the {joint.joint} {format_quantity(joint.torque_max, 'mN*m')} at "
        f"{format_quantity(joint.speed_max, 'rad/s')}, behind the gears that it may have"
        for joint in motion.joints
        if joint.motor is None
    )


def _remedy(params: KnottingDyadParams, section: WarpSection) -> str:
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


def tables(found: DyadAnalysis) -> tuple[Table, ...]:
    """Clearances and phases, drives and cycle, points and arms."""
    return (
        *(() if found.head is None else _head_tables(found.head)),
        *(() if found.motion is None else _motion_tables(found.motion)),
        *_arm_tables(found.design),
    )


def _head_tables(head: Head) -> tuple[Table, Table]:
    distances = Table(
        "knotting-dyad-clearances",
        "Least distances over the cycle",
        columns("of", "distance [mm]", "tolerance [um]"),
        tuple((one.name, one.value, one.sure) for one in head.least),
    )
    phases = Table(
        "knotting-dyad-phases",
        "Phases of a cycle",
        columns("phase", "left arm s", "right arm s", "centre gripper", "yarn's ends"),
        tuple(
            (
                one.name,
                _span(one.left),
                _span(one.right),
                " to ".join(dict.fromkeys(format_quantity(height, "mm", 3) for height in one.centre)),
                ", ".join(carrier or "in the pile" for carrier in one.carries),
            )
            for one in head.sequence
        ),
    )
    return distances, phases


def _span(span: tuple[float, float]) -> str:
    return " to ".join(dict.fromkeys(f"{value:g}" for value in span))


def _motion_tables(motion: HeadMotion) -> tuple[Table, Table]:
    drives = Table(
        "knotting-dyad-drives",
        "Drives, for the worse arm; servos with their rotors",
        columns(
            "joint",
            "torque [mN*m]",
            "root mean square [mN*m]",
            "speed [rad/s]",
            "gears",
            "servo's torque [mN*m]",
            "servo",
        ),
        tuple(
            (
                one.joint,
                one.torque_max,
                one.torque_rms,
                one.speed_max,
                one.gear_ratio,
                one.servo_torque_max,
                one.servo or "none is enough",
            )
            for one in motion.joints
        ),
    )
    cycle = Table(
        "knotting-dyad-cycle",
        "The cycle in time",
        columns("part", "begins [ms]", "takes [ms]", "grippers"),
        tuple((one.name, one.start, one.end - one.start, ", ".join(one.grippers)) for one in motion.cycle.parts),
    )
    return drives, cycle


def _arm_tables(design: KnottingDyad) -> tuple[Table, Table]:
    task, words = design.task, {-1: "out of reach", 0: "on both sides"}
    points = Table(
        "knotting-dyad-points",
        "Timed points",
        columns("point", "x [mm]", "y [mm]", "angle of the first link [deg]"),
        tuple(
            (f"P{at}", float(point.real), float(point.imag), float(angle))
            for at, (point, angle) in enumerate(zip(task.points, task.angles, strict=True), 1)
        ),
    )
    arms = Table(
        "knotting-dyad-arms",
        "Arms, and their least angle off straight",
        columns("arm", "first link [mm]", "second link [mm]", "pivot x [mm]", "pivot y [mm]", "elbow"),
        tuple(
            (at, dyad.first, dyad.second, dyad.pivot.real, dyad.pivot.imag, words.get(bend, _angle(bend)))
            for at, (dyad, bend) in enumerate(zip(design.dyads, design.bends.tolist(), strict=True), 1)
        ),
    )
    return points, arms


def _angle(bend: float) -> str:
    return format_quantity(float(np.arcsin(max(bend, 0.0))), "deg")


def figures(found: DyadAnalysis) -> tuple[Figure, ...]:
    """The head and its motion, where a knot is tied; all arms, and the arm to build; the motion over time."""
    head, motion = found.head, found.motion
    if head is None or motion is None:
        return design_figures(found.design)
    return (*head_figures(head, motion.cycle), *design_figures(found.design), *motion_figures(motion))
