"""The bar of a cam shaft beyond its cams."""

import math

from ilmek.machines.shedding import SheddingDesign
from ilmek.machines.shedding.cam_shaft import RING
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import tree
from ilmek.plane.solids import volume
from ilmek.units import mm


def beyond_cams(design: SheddingDesign, index: int, length: float) -> float:
    """Volume of a shaft's bar without the square in the cams of a length [m], with both pressure rings [m³].

    By the mesh of the bar, whose chords take a little from its journals.
    """
    parts = {part.id: part for part, _ in tree(design).occurrences()}
    bar, side = parts[part_id("cam-shaft", index)], design.shafts[index].shaft.bar
    bore = design.shafts[index].nut.thread / 2 + 0.25 * mm
    assert bar.shape is not None
    return volume(bar.shape.mesh(1e-6)) - side**2 * length + 2 * RING * math.pi * (side**2 - bore**2)
