"""A hand loom from the side and from the front: projections of its parts, with its warps."""

from dataclasses import replace

import numpy as np

from ilmek.machines.automated_loom.views import drawn, named
from ilmek.machines.hand_loom.frame import tree
from ilmek.machines.hand_loom.report import HandLoomAnalysis
from ilmek.machines.hand_shed.figures import moving
from ilmek.part.projection import View, outlines
from ilmek.part.tree import Tree
from ilmek.report import Animation, Dot, Drawing, Figure, Stroke


def figures(found: HandLoomAnalysis) -> tuple[Figure, ...]:
    """The loom from the side and from the front, and the change of its shed."""
    return (_side(found), _front(found), _moving(found))


def _moving(found: HandLoomAnalysis) -> Animation:
    """The change of the shed before the loom from the side."""
    shed = moving(found.loom.shed)
    bodies = tuple(body for body in tree(found.loom).bodies if body.joint.motion is None)
    seen = drawn(outlines(Tree(bodies), View.SIDE))
    still = replace(shed.still, name="hand-loom-moving", strokes=tuple(replace(one, filled=False) for one in seen))
    return replace(shed, still=replace(still, unit="m"))


def _side(found: HandLoomAnalysis) -> Drawing:
    """From the side, the weaver on the right, the rod pulled down."""
    loom = found.loom
    seen, params = outlines(tree(loom), View.SIDE), loom.shed.params
    rod, half, top = 1j * params.rod_low, loom.shed.rod.outer / 2, 1j * params.free_length
    low = complex(0.0, loom.layout.lower.at.imag)
    strokes = (
        *drawn(seen),
        Stroke(np.array([low, 0j, rod - half, top]), "yarn", "rear warps"),
        Stroke(np.array([0j, rod + half, top]), "yarn", "front warps"),
        *named(seen),
    )
    note = "the weaver sits on the right; the rod is pulled down, the strings are slack"
    return Drawing("hand-loom-side", "The hand loom from the side", strokes, (Dot(0j, "fell", "point"),), "m", note)


def _front(found: HandLoomAnalysis) -> Drawing:
    """From the front, as the weaver sees it."""
    loom, seen = found.loom, outlines(tree(found.loom), View.FRONT)
    cloth, low, high = loom.params.cloth, loom.layout.lower.at.imag, loom.layout.upper.at.imag
    ends = cloth.width / 2 * np.array([-1.0, 1.0])
    strokes = (
        *drawn(outline for outline in seen if outline.near <= 0),
        *(Stroke(x + 1j * np.array([low, high]), "yarn") for x in ends),
        *drawn(outline for outline in seen if outline.near > 0),
        *named(seen),
    )
    note = f"{cloth.warps} warps between the two lines"
    return Drawing("hand-loom-front", "The hand loom from the front", strokes, (), "m", note)
