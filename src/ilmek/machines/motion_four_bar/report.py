"""Checks, tables, figures and warnings of a four-bar for a motion."""

import cmath
import math
from collections.abc import Iterator

import numpy as np

from ilmek.machines.four_bar_figures import drawn_and_moving, links, numbered, pins
from ilmek.machines.motion_four_bar.design import MotionFourBar
from ilmek.report import Check, Dot, Drawing, Figure, Stroke, Table, at_most, columns
from ilmek.synthesis import selection_report as shared
from ilmek.synthesis.burmester.curve import CurveBranch
from ilmek.synthesis.burmester.links import Guide, GuideKind

MET = 1e-6
"""Error of a pose that counts as none, in extents of the poses."""

WINDOW = 2.0
"""Radius of what is drawn of curves and links, in extents of the poses: they are infinite."""

FLAG = 0.25
"""Length of the mark of a pose, in extents of the poses."""


def self_tests(design: MotionFourBar) -> tuple[Check, ...]:
    """Whether the motion of the best solution takes the poses."""
    if design.best is None:
        return ()
    missed, most = design.best.candidate.point_error, MET * design.extent
    return (at_most("distance from the poses", missed, most, "mm", "from its motion"),)


def warnings(design: MotionFourBar) -> tuple[str, ...]:
    """Those of all four-bars, and links that are no cranks: they may be built otherwise."""
    odd = [(at, guide) for at, guide in enumerate(design.guides, 1) if guide.kind is not GuideKind.CRANK]
    return (*shared.warnings(design), *(f"link {at} is a {one.kind}: {one.kind.words}" for at, one in odd))


def tables(design: MotionFourBar) -> tuple[Table, ...]:
    """The solutions, and the links that guide the body where they are few."""
    found = shared.tables(design.choice, "motion-four-bar")
    return (*found, _guide_table(design)) if design.guides else found


def _guide_table(design: MotionFourBar) -> Table:
    heads = columns(
        *("link", "kind", "pivot x [mm]", "pivot y [mm]", "pin x [mm]", "pin y [mm]", "length [mm]"),
        "change over the poses [mm]",
    )
    rows = tuple(
        (at, str(one.kind), *_joints(one), one.length, _change(one, design)) for at, one in enumerate(design.guides, 1)
    )
    title = "Links that guide the body, pins at the first pose"
    return Table("motion-four-bar-links", title, heads, rows, brief=True)


def _joints(guide: Guide) -> tuple[float, float, float, float]:
    """Pivot and pin [m]; NaN where they are infinitely far."""
    pivot = guide.pivot if guide.kind in (GuideKind.CRANK, GuideKind.BLOCK) else complex(math.nan, math.nan)
    pin = guide.pin if guide.kind in (GuideKind.CRANK, GuideKind.SLIDER) else complex(math.nan, math.nan)
    return pivot.real, pivot.imag, pin.real, pin.imag


def _change(guide: Guide, design: MotionFourBar) -> float:
    """Change over the poses of what must be constant [m]: of a crank its length."""
    return float(np.ptp(guide.reach(*design.poses))) if guide.kind is not GuideKind.FREE else math.nan


def figures(design: MotionFourBar) -> tuple[Figure, ...]:
    """The solution at its first pose and in motion, and the curves or links that it was chosen from."""
    best, found = design.best, _chosen_from(design)
    still = Drawing("motion-four-bar", "The poses", _flags(design), numbered(design.poses.points))
    if best is None:
        return found or (still,)
    title = f"Solution {design.choice.number} at its first pose"
    still = Drawing(still.name, title, still.strokes, still.dots)
    moving = "In motion" if best.candidate.crank_turns else "In motion, from the first pose to the last"
    return (*drawn_and_moving(best.candidate, still, moving), *found)


def _chosen_from(design: MotionFourBar) -> tuple[Drawing, ...]:
    """Both curves of four poses, or the links of five, with those of the solution."""
    best, flags, poses = design.best, _flags(design), numbered(design.poses.points)
    if design.curve is not None:
        pivots = [stroke for branch in design.curve.centre_branches for stroke in _within(design, branch, "pivots")]
        ends = [stroke for branch in design.curve.circle_branches for stroke in _within(design, branch, "pins")]
        title, note = "Possible pivots and pins", "Every pivot of the one curve has its pin on the other."
        solution = () if best is None else links(best.candidate.four_bar)[1:]
        dots = (*poses, *(() if best is None else pins(best.candidate.four_bar)[:4]))
        strokes = (*flags, *pivots, *ends, *solution)
        return (Drawing("motion-four-bar-curves", title, strokes, dots, note=note),)
    guides = [(at, guide) for at, guide in enumerate(design.guides, 1) if guide.kind is GuideKind.CRANK]
    if not guides:
        return ()
    arms = [Stroke(np.array([one.pivot, one.pin]), "link", f"link {at}") for at, one in guides]
    joints = [dot for _, one in guides for dot in (Dot(one.pivot, "", "pivot"), Dot(one.pin, ""))]
    title = "Every link that guides the body through the poses"
    return (Drawing("motion-four-bar-links", title, (*flags, *arms), (*joints, *poses)),)


def _flags(design: MotionFourBar) -> tuple[Stroke, ...]:
    """Marks of the poses: an arm from the body's point along its line, with a short one across."""
    along = [FLAG * design.extent * cmath.exp(1j * float(angle)) for angle in design.poses.angles]
    return tuple(
        Stroke(np.array([point + 0.35j * arm, point, point + arm]), "outline")
        for point, arm in zip(design.poses.points, along, strict=True)
    )


def _within(design: MotionFourBar, branch: CurveBranch, label: str) -> Iterator[Stroke]:
    """The parts of a branch that lie in the window."""
    middle = complex(np.mean(design.poses.points))
    points = np.append(branch.points, branch.points[:1]) if branch.closed else branch.points
    inside = np.abs(points - middle) < WINDOW * design.extent
    cuts = np.flatnonzero(np.diff(inside.astype(int))) + 1
    for part, kept in zip(np.split(points, cuts), np.split(inside, cuts), strict=True):
        if len(part) > 1 and kept[0]:
            yield Stroke(part, "path", label)
