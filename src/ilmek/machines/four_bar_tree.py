"""The four-bar that a synthesis draws, as it is made: its construction and its tree, and whether it can be made."""

from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import frames
from ilmek.dynamics.own_machine import FlatMember, OwnMachine
from ilmek.errors import IlmekError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.four_bar_figures import crank_range
from ilmek.machines.own_linkage.construction import Construction, construction
from ilmek.machines.own_linkage.report import construction_checks
from ilmek.machines.own_linkage.sizes import MATERIAL, THICKNESS_SHARE, THIN
from ilmek.machines.own_linkage.tree import own_tree
from ilmek.part.tree import Tree
from ilmek.report import Check, at_most
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.selection import FourBarDesign, FourBarTaskParams


def four_bar_tree(machine: str, design: FourBarDesign) -> Tree:
    """The bodies of the solution that is drawn, at its first position; none without one, or without room for its pins.

    machine  first part of the ids
    """
    built = _built(machine, design)
    return own_tree(built) if isinstance(built, Construction) else Tree()


def made_checks(machine: str, design: FourBarDesign) -> tuple[Check, ...]:
    """Whether the solution that is drawn can be made: layers in depth, room for its pins; none without one."""
    built = _built(machine, design)
    if isinstance(built, Construction):
        return construction_checks(built)
    cure = "require longer links, or make them yourself: --to writes the linkage"
    return (at_most("links too short for their pins", 1, 0, "1", built).with_cure(cure),) if built else ()


@lru_cache(maxsize=8)
def _built(machine: str, design: FourBarDesign) -> Construction | str:
    """The construction, or why there is none; "" without a solution."""
    if design.best is None:
        return ""
    found = design.best.candidate
    mechanism = found.four_bar.mechanism()
    member = _member(design.params)
    own = OwnMachine(mechanism, members=dict.fromkeys(mechanism.moving, member) if member else {})
    try:
        return construction(own, solve(plan(mechanism), _angles(found)), name=machine)
    except IlmekError as error:
        return str(error)


def _member(params: FourBarTaskParams) -> FlatMember | None:
    """The section of the links; None: by the shortest of them."""
    width, thickness = params.link_width, params.link_thickness
    if width is None and thickness is None:
        return None
    width = width or (thickness or 0.0) / THICKNESS_SHARE
    return FlatMember(width, thickness or max(THICKNESS_SHARE * width, THIN), MATERIAL)


def _angles(candidate: Candidate) -> FloatArray:
    """Crank angles from the first position on, over a turn, or over its way to and fro."""
    start = candidate.four_bar.crank_angle
    if candidate.crank_turns:
        return np.append(frames(start), start + 2 * np.pi)
    ends = crank_range(candidate)
    if ends is None:
        return np.array([start])
    low, high = ends
    return np.concatenate([frames(start, high), frames(high, low)[1:], frames(low, start)[1:]])
