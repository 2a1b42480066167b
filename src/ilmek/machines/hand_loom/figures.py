"""A hand loom from the side and from the front: projections of its parts, with its warps."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.machines.automated_loom.cyclogram import WEAVERS_ROW
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.views import named
from ilmek.machines.hand_loom.design import HandLoom
from ilmek.machines.hand_loom.driven_beat import BEAT
from ilmek.machines.hand_loom.frame import tree
from ilmek.machines.hand_loom.report import HandLoomAnalysis
from ilmek.machines.hand_shed.figures import moving
from ilmek.machines.part_views import drawn
from ilmek.part.projection import View, outlines
from ilmek.part.tree import GROUND, RigidBody, Tree
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Stroke
from ilmek.timing.figures import draw


def figures(found: HandLoomAnalysis) -> tuple[Figure, ...]:
    """The loom from the side and from the front, the change of its shed, and the cyclograms of a driven beat."""
    timings = (
        draw(cyclogram, *_TITLES[cyclogram.name], drive=Axis("angle", "deg")) for cyclogram in found.loom.cyclograms
    )
    return (_side(found), _front(found), _moving(found), *timings)


_TITLES = {
    WEAVERS_ROW: ("One row with its weavers", "The loom beats twice; all else of a row is the weavers'."),
    BEAT: ("Two beats", "The beater goes across in the first beat, and back in the second; between them weavers work."),
}


@lru_cache(maxsize=2)
def _open_tree(loom: HandLoom) -> Tree:
    """The bodies of a loom without its guards, which hide it."""
    return Tree(tuple(body for body in tree(loom).bodies if body.id not in GUARDS))


def _moving(found: HandLoomAnalysis) -> Animation:
    """The change of the shed before the loom from the side."""
    shed = moving(found.loom.shed)
    standing: list[RigidBody] = []
    for body in _open_tree(found.loom).bodies:
        if body.joint.motion is None and body.parent in {GROUND, *(one.id for one in standing)}:
            standing.append(body)
    seen = drawn(outlines(Tree(tuple(standing)), View.SIDE), filled=False)
    still = replace(shed.still, name="hand-loom-moving", strokes=seen)
    return replace(shed, still=replace(still, unit="m"))


def _side(found: HandLoomAnalysis) -> Drawing:
    """From the side, the weaver on the right, the rod pulled down."""
    loom = found.loom
    seen, params = outlines(_open_tree(loom), View.SIDE), loom.shed.params
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
    loom, seen = found.loom, outlines(_open_tree(found.loom), View.FRONT)
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
