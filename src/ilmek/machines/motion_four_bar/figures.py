"""A four-bar for a motion, drawn: the poses, the curves or links that it was chosen from, itself in motion."""

from collections.abc import Iterator

import numpy as np

from ilmek.machines.four_bars.figures import body, drawn, links, moving, pins
from ilmek.machines.motion_four_bar.design import MotionFourBar
from ilmek.report import Animation, Dot, Drawing, Figure, Stroke
from ilmek.synthesis.burmester.curve import CurveBranch
from ilmek.synthesis.burmester.links import GuideKind

WINDOW = 2.0
"""Radius of what is drawn of curves and links, in extents of the poses: they go on to infinity."""

FLAG = 0.25
"""Length of the mark of a pose, in extents of the poses."""


def figures(design: MotionFourBar) -> tuple[Figure, ...]:
    """The solution at its first pose and in motion, and what it was chosen from."""
    best, found = design.choice.best, _chosen_from(design)
    if best is None:
        return found or (Drawing("motion-four-bar", "The poses", _flags(design), _numbers(design)),)
    still = Drawing("motion-four-bar", f"Solution {(design.choice.chosen or 0) + 1} at its first pose", ())
    shown = drawn(best.candidate, still, _flags(design), _numbers(design))
    return (shown, *_moving(design), *found)


def _moving(design: MotionFourBar) -> tuple[Animation, ...]:
    best = design.choice.best
    if best is None:
        return ()
    title = "In motion" if best.candidate.crank_turns else "In motion, from the first pose to the last"
    still = Drawing("motion-four-bar-moving", title, _flags(design), _numbers(design))
    moved = moving(best.candidate, still)
    return (moved,) if moved else ()


def _chosen_from(design: MotionFourBar) -> tuple[Drawing, ...]:
    """Both curves of four poses, or the links of five, with the solution's own."""
    best = design.choice.best
    solution = () if best is None else (*links(best.candidate.four_bar)[1:],)
    dots = (*_numbers(design), *(() if best is None else pins(best.candidate.four_bar)[:4]))
    if design.curve is not None:
        pivots = [stroke for branch in design.curve.centre_branches for stroke in _within(design, branch, "pivots")]
        ends = [stroke for branch in design.curve.circle_branches for stroke in _within(design, branch, "pins")]
        title, note = "Where pivots and pins may be", "Every pivot of the one curve has its pin on the other."
        strokes = (*_flags(design), *pivots, *ends, *solution)
        return (Drawing("motion-four-bar-curves", title, strokes, dots, note=note),)
    guides = [(at, one) for at, one in enumerate(design.guides, 1) if one.kind is GuideKind.CRANK]
    if not guides:
        return ()
    arms = [Stroke(np.array([one.pivot, one.pin]), "link", f"link {at}") for at, one in guides]
    joints = [dot for _, one in guides for dot in (Dot(one.pivot, "", "pivot"), Dot(one.pin, ""))]
    title = "Every link that guides the body through the poses"
    return (Drawing("motion-four-bar-links", title, (*_flags(design), *arms), (*joints, *_numbers(design))),)


def _flags(design: MotionFourBar) -> tuple[Stroke, ...]:
    size = FLAG * design.extent
    return tuple(
        Stroke(body(complex(point), float(angle), size), "outline") for point, angle in zip(*design.poses, strict=True)
    )


def _numbers(design: MotionFourBar) -> tuple[Dot, ...]:
    return tuple(Dot(complex(point), str(at), "point") for at, point in enumerate(design.poses.points, 1))


def _within(design: MotionFourBar, branch: CurveBranch, label: str) -> Iterator[Stroke]:
    """The parts of a branch that lie in the window."""
    middle = complex(np.mean(design.poses.points))
    places = np.append(branch.places, branch.places[:1]) if branch.closed else branch.places
    inside = np.abs(places - middle) < WINDOW * design.extent
    cuts = np.flatnonzero(np.diff(inside.astype(int))) + 1
    for part, kept in zip(np.split(places, cuts), np.split(inside, cuts), strict=True):
        if len(part) > 1 and kept[0]:
            yield Stroke(part, "path", label)
