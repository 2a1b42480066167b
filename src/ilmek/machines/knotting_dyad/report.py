"""What a knotting dyad's design says: results, checks, tables and figures."""

import numpy as np

from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.figures import figures
from ilmek.machines.knotting_dyad.head_report import head_checks, head_results, head_tables, head_warnings
from ilmek.machines.knotting_dyad.motion_report import (
    head_motion,
    motion_checks,
    motion_figures,
    motion_results,
    motion_tables,
    motion_warnings,
)
from ilmek.report import Check, Column, Json, Report, Result, Table, at_least, at_most
from ilmek.synthesis.dyad import RootKind, TwoLinkArm
from ilmek.units import format_quantity

CLOSURE = 1e-9


def report(design: KnottingDyad) -> Report:
    """Everything that the design says."""
    head = design.head
    motion = None if head is None else head_motion(design.params, head)
    return Report(
        machine="knotting-dyad",
        title="Knotting dyad",
        parameters=design.params.as_dict(),
        results=(
            *(() if head is None else head_results(head)),
            *(() if motion is None else motion_results(motion)),
            *_task(design),
            *_arms(design),
        ),
        checks=(
            *_checks(design),
            *(() if head is None else head_checks(design.params, head)),
            *(() if motion is None else motion_checks(motion)),
        ),
        tables=(
            *(() if head is None else head_tables(head)),
            *(() if motion is None else motion_tables(motion)),
            _point_table(design),
            _arm_table(design),
        ),
        figures=(
            *figures(design, None if motion is None else motion.cycle),
            *(() if motion is None else motion_figures(motion)),
        ),
        warnings=(
            *_warnings(design),
            *(() if head is None else head_warnings(design.params, head)),
            *(() if motion is None else motion_warnings(motion)),
        ),
    )


def _task(design: KnottingDyad) -> tuple[Result, ...]:
    task = design.task
    points: list[Json] = [[float(point.real), float(point.imag)] for point in task.points]
    return (
        Result("timed_points", points, "mm", "the four points, x and y from the pair's left warp, the pile upwards"),
        Result("timed_angles", task.angles.tolist(), "deg", "angles of the first link there"),
        Result(
            "shares",
            None if task.shares is None else task.shares.tolist(),
            "",
            "of the left arm's way, its s, where the points were chosen on it",
        ),
    )


def _arms(design: KnottingDyad) -> tuple[Result, ...]:
    solutions: list[Json] = [_solution(design, at) for at in range(len(design.dyads))]
    kinds: list[Json] = [RootKind(int(found)).words for found in design.roots.found]
    chosen = None if design.chosen is None else design.chosen + 1
    return (
        Result("solutions", solutions, "", f"every real arm, SI and radians: {MEANING}"),
        Result("roots", kinds, "", "what each of the task's three roots is"),
        Result("chosen", chosen, "", "number of the arm to build, from 1"),
    )


MEANING = (
    "pivot a0 at theta0 = (pivot_x, pivot_y), also as ground_length and ground_angle; first link a1, below 0 if it "
    "points away from its angle; second link a2; link1, link2 their lengths; theta2, residual at the points; bend, "
    "least sine between the links, 0: elbow on both sides, -1: out of reach"
)


def _solution(design: KnottingDyad, at: int) -> dict[str, Json]:
    dyad = design.dyads[at]
    angle = float(np.angle(dyad.pivot))
    return {
        "ground_length": dyad.ground,
        "ground_angle": angle,
        "link1": abs(dyad.first),
        "link2": dyad.second,
        "a0": dyad.ground,
        "theta0": angle,
        "a1": dyad.first,
        "a2": dyad.second,
        "pivot_x": dyad.pivot.real,
        "pivot_y": dyad.pivot.imag,
        "theta2": design.second_angles(dyad).tolist(),
        "residual": float(np.max(design.residuals(dyad))),
        "bend": float(design.bends[at]),
    }


def _checks(design: KnottingDyad) -> tuple[Check, ...]:
    missed = max(float(np.max(design.residuals(dyad))) / design.size(dyad) for dyad in design.dyads)
    built = sum(1 for dyad in design.dyads if dyad.first)
    closes = at_most("closure of every arm at the points, of its size", missed, CLOSURE, "1", "loop equation")
    found = at_least("real arms of two links", built, 1, "", "the task has three roots")
    if design.chosen is None:
        return closes, found
    where = "at the points" if design.head is None else "along the way"
    sine = float(design.bends[design.chosen]) if design.head is None else design.head.arm.bend
    off = float(np.arcsin(max(sine, 0.0)))
    longest, limits = _longest(design.dyads[design.chosen]), design.params
    return (
        closes,
        found,
        at_most("longest link of the arm to build", longest, limits.link_limit, "mm", "link_limit"),
        # As bent as asked for is bent enough, though rounding may take its last digit.
        at_least(f"angle between its links, off straight, {where}", off + 1e-9, limits.bend_limit, "deg", "bend_limit"),
    )


def _longest(dyad: TwoLinkArm) -> float:
    return max(abs(dyad.first), dyad.second)


def _warnings(design: KnottingDyad) -> tuple[str, ...]:
    if design.head is not None:  # the other arms are by the way
        return ()
    kinds = dict.fromkeys(RootKind(int(found)) for found in design.roots.found)
    odd = [kind.words for kind in kinds if kind not in (RootKind.ARM, RootKind.COMPLEX)]
    return (*(f"one root is no arm of two links: {words}" for words in odd), *_elbow(design))


def _elbow(design: KnottingDyad) -> tuple[str, ...]:
    if design.chosen is None or design.bends[design.chosen] > 0:
        return ()
    number = design.chosen + 1
    return (f"arm {number} has its elbow on both sides at the points: between them it must pass a stretched pose",)


def _point_table(design: KnottingDyad) -> Table:
    columns = (Column("point"), Column("x", "mm"), Column("y", "mm"), Column("angle of the first link", "deg"))
    task = design.task
    rows = tuple(
        (f"P{at + 1}", float(point.real), float(point.imag), float(angle))
        for at, (point, angle) in enumerate(zip(task.points, task.angles, strict=True))
    )
    return Table("knotting-dyad-points", "Timed points", columns, rows)


def _arm_table(design: KnottingDyad) -> Table:
    columns = (
        Column("arm"),
        Column("first link", "mm"),
        Column("second link", "mm"),
        Column("pivot x", "mm"),
        Column("pivot y", "mm"),
        Column("elbow"),
    )
    words = {-1: "out of reach", 0: "on both sides"}
    rows = tuple(
        (at + 1, dyad.first, dyad.second, dyad.pivot.real, dyad.pivot.imag, words.get(bend, _angle(bend)))
        for at, (dyad, bend) in enumerate(zip(design.dyads, design.bends.tolist(), strict=True))
    )
    return Table("knotting-dyad-arms", "Arms, and how far they stay from straight", columns, rows)


def _angle(bend: float) -> str:
    return format_quantity(float(np.arcsin(max(bend, 0.0))), "deg")
