"""The four-bar that a synthesis draws, as a tree of bodies: crank, coupler and rocker on a plate that stands."""

from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.animation import frames
from ilmek.elements.materials import MATERIALS
from ilmek.elements.plates import PIN_SHARE
from ilmek.linkage.model import GROUND
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.four_bar_figures import crank_range
from ilmek.machines.link_tree import Levels, LinkSize, linkage_parts, linkage_tree
from ilmek.part.tree import Tree
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.four_bar import LinkLengths
from ilmek.synthesis.selection import FourBarDesign, FourBarTaskParams
from ilmek.units import mm

WIDTH_SHARE, SLENDER, WIDE = 0.2, 4 * mm, 40 * mm
"""Width of a link that is not given: a fifth of the shortest one, within these bounds."""

THICKNESS_SHARE = 1 / 3
"""Thickness of a link that is not given, over its width."""

STEEL = MATERIALS["structural steel"]

LEVELS = ((GROUND,), ("crank", "rocker"), ("coupler",))


@lru_cache(maxsize=8)
def four_bar_tree(machine: str, design: FourBarDesign) -> Tree:
    """The bodies of the solution that is drawn, at its first position; none without one.

    machine  first part of the ids
    """
    if design.best is None:
        return Tree()
    found = design.best.candidate
    mechanism, size = found.four_bar.mechanism(), _size(design.params, found.four_bar.lengths)
    levels = Levels(LEVELS, {body: size for level in LEVELS for body in level})
    return linkage_tree(linkage_parts(machine, mechanism, levels), solve(plan(mechanism), _angles(found)))


def _size(params: FourBarTaskParams, lengths: LinkLengths) -> LinkSize:
    shortest = min(lengths.crank, lengths.coupler, lengths.rocker)
    width = params.link_width or min(max(WIDTH_SHARE * shortest, SLENDER), WIDE)
    thickness = params.link_thickness or THICKNESS_SHARE * width
    return LinkSize(width, thickness, PIN_SHARE * width, STEEL)


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
