"""The axis along which a part reaches its seat: in an exploded view, and first of all directions in an assembly.

It is that of the longest bore or journal by which the part meets another [`meetings`]; else of a turned or bought part
its own z, of any other the direction in which it is thinnest.
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Float
from ilmek.part.meetings import meetings
from ilmek.part.part import Part
from ilmek.part.shapes import Turned, shape_box
from ilmek.part.tree import Tree

Vector = Float[np.ndarray, " 3"]


def meeting_axes(tree: Tree) -> dict[str, Vector]:
    """By the id of a part the axis in its frame of the longest bore or journal by which it meets another."""
    longest: dict[str, tuple[float, Vector]] = {}
    for meeting in meetings(tree):
        for seat in (meeting.bore, meeting.inner):
            length = min(meeting.bore.feature.length, meeting.inner.feature.length)
            if length > longest.get(seat.part.id, (0.0, None))[0]:
                longest[seat.part.id] = length, seat.feature.position.rotation[:, 2]
    return {name: axis for name, (_, axis) in longest.items()}


def seat_axis(part: Part, axes: Mapping[str, Vector]) -> Vector:
    """The axis of a part with a shape in its frame; axes: those of `meeting_axes`."""
    assert part.shape is not None
    if part.id in axes:
        return axes[part.id]
    if isinstance(part.shape, Turned) or part.purchase is not None:
        return np.array([0.0, 0.0, 1.0])
    low, high = shape_box(part.shape)
    return np.asarray(np.eye(3)[int((high - low).argmin())])
