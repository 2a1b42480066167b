"""Retaining rings as bought parts."""

from ilmek.elements.columns import STEEL
from ilmek.elements.retaining_rings import RetainingRing
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.shapes import tube


def retaining_ring(name: str, row: RetainingRing) -> Part:
    """A retaining ring about z from z = 0, as it lies in its groove."""
    shape = tube(row.outer, (row.outer - row.groove) / 2, row.thickness)
    return bought_part(name, "retaining ring", "fastener", shape, Bought(row.designation, shape.volume * STEEL.density))
