"""The arrangement of a loom: where its parts stand in the side view, and whether what moves has room.

Coordinates: the fell at 0, x to the front, towards the weaver, y up, in m. Positions are complex.
"""

from ilmek.machines.arrangement.side_view import SideView, laid_out
from ilmek.machines.arrangement.spans import ShedRoom, ShedSpans, shed_room, shed_spans, warp_length

__all__ = ["ShedRoom", "ShedSpans", "SideView", "laid_out", "shed_room", "shed_spans", "warp_length"]
