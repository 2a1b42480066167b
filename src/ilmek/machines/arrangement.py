"""The arrangement of a loom: where its parts stand in the side view, the fell at the origin."""

from ilmek.units import mm

HALF_SPAN = 170 * mm
"""From the shedding cams to the next hold of the warps [m]."""
