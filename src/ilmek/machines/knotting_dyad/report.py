"""The report of a knotting dyad: checks, warnings, tables."""

import numpy as np

from ilmek.machines.knotting_dyad.checks import ROUNDING, dyad_checks, dyad_self_tests, remedy
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.drives import HeadMotion, head_motion
from ilmek.machines.knotting_dyad.figures import design_figures, head_figures, motion_figures
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.strength_tables import strength_table
from ilmek.records import group, record
from ilmek.report import Check, Figure, Table, columns
from ilmek.synthesis.dyad import RootKind
from ilmek.units import format_quantity


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
    """The checks of a dyad."""
    return dyad_checks(found.design, found.motion)


def self_tests(found: DyadAnalysis) -> tuple[Check, ...]:
    """The tests of the computation of a dyad."""
    return dyad_self_tests(found.design, found.motion)


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
        warned.append(f"{least.name}: {found}, {required} is required; {remedy(params, section)}")
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


def tables(found: DyadAnalysis) -> tuple[Table, ...]:
    """Clearances and phases, drives and cycle, points and arms."""
    return (
        *(() if found.head is None else _head_tables(found.head)),
        *(() if found.motion is None else _motion_tables(found.motion)),
        *(() if found.motion is None else strength_table(found.motion.strength, "knotting-dyad")),
        *_arm_tables(found.design),
    )


def _head_tables(head: Head) -> tuple[Table, Table]:
    title, rows = "Least distances over the cycle", tuple((one.name, one.value, one.sure) for one in head.least)
    distances = Table("knotting-dyad-clearances", title, columns("of", "distance [mm]", "tolerance [um]"), rows)
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
    heads = columns(
        "joint", "torque [mN*m]", "root mean square [mN*m]", "speed [rad/s]", "gears", "servo's torque [mN*m]", "servo"
    )
    rows = tuple(
        (
            joint.joint,
            joint.torque_max,
            joint.torque_rms,
            joint.speed_max,
            joint.gear_ratio,
            joint.servo_torque_max,
            joint.servo or "none is enough",
        )
        for joint in motion.joints
    )
    drives = Table("knotting-dyad-drives", "Drives, for the worse arm; servos with their rotors", heads, rows)
    cycle = Table(
        "knotting-dyad-cycle",
        "The cycle in time",
        columns("part", "begins [ms]", "takes [ms]", "grippers"),
        tuple((part.name, part.start, part.end - part.start, ", ".join(part.grippers)) for part in motion.cycle.parts),
    )
    return drives, cycle


def _arm_tables(design: KnottingDyad) -> tuple[Table, Table]:
    task, words = design.task, {-1: "out of reach", 0: "on both sides"}
    heads = columns("point", "x [mm]", "y [mm]", "angle of the first link [deg]")
    rows = tuple(
        (f"P{at}", float(point.real), float(point.imag), float(angle))
        for at, (point, angle) in enumerate(zip(task.points, task.angles, strict=True), 1)
    )
    points = Table("knotting-dyad-points", "Timed points", heads, rows)
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
