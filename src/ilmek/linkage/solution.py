"""The solutions of a plan's steps, one after the other, in the world with its origin at the ground's anchor."""

from collections.abc import Mapping

from ilmek.linkage.anchors import anchors, local_ground
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.group import GroupSolution, InputMotion, Known
from ilmek.linkage.model import GROUND
from ilmek.linkage.newton_starts import starts
from ilmek.linkage.structure import Plan


def local_starts(plan: Plan, drives: Mapping[str, InputMotion]) -> dict[str, BodyMotion]:
    """The starts of Newton's method in the world of a solution; see `anchors`."""
    origin = anchors(plan.mechanism)[GROUND]
    return {body: _shifted(motion, -origin) for body, motion in starts(plan, drives).items()}


def _shifted(body: BodyMotion, shift: complex) -> BodyMotion:
    anchor = PointMotion(body.anchor.position + shift, body.anchor.velocity, body.anchor.acceleration)
    return BodyMotion(anchor, body.at, body.direction, body.omega, body.alpha)


def solved_steps(
    plan: Plan, drives: Mapping[str, InputMotion], start: Mapping[str, BodyMotion]
) -> tuple[Known, list[GroupSolution]]:
    """The bodies' motions that the steps need, and the solution of each step."""
    known: dict[str, BodyMotion] = {GROUND: local_ground(plan.mechanism), **start}
    solved = []
    for step in plan.steps:
        solved.append(step.solve(known, drives))
        if step is not plan.steps[-1]:
            known.update(step.locate(known, solved[-1].columns))
    return known, solved
