"""A tree of bodies as one STEP assembly (AP242, mm): each part once, with name, colour and tolerances; each body an
assembly of the parts that it has, placed where it is at an angle of a drive. The kernel orders the colours as it likes.
"""

from collections.abc import Sequence

import numpy as np
from OCP.Quantity import Quantity_ColorRGBA
from OCP.TDF import TDF_Label
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

from ilmek.io.colours import colour_of
from ilmek.io.step import displacement, part_solid
from ilmek.io.step_document import StepDocument
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.tolerances import ToleratedFeature
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree


def assembly_bytes(tree: Tree, title: str, drive: str = "", angle: float = 0.0) -> bytes:
    """The content of a STEP file; parts without a shape are left out.

    title  of the assembly      drive, angle  the pose of the bodies [rad]; all other drives are at 0
    Raises OutputError for a part that gives no valid solid, and where nothing can be written.
    """
    assembly, tolerances = _Assembly(title), tolerances_of(tree)
    for chain in chains(tree):
        here = poses(chain, drive, np.array([angle]))
        body = assembly.body(chain[-1].name, Placement(here.origin[0], here.rotation[0]))
        for occurrence in chain[-1].body.occurrences:
            if occurrence.part.shape is not None:
                for position in occurrence.positions:
                    assembly.add(body, occurrence.part, position, tolerances.get(occurrence.part.id, ()))
    return assembly.content()


class _Assembly(StepDocument):
    """An assembly while it is made."""

    def __init__(self, title: str) -> None:
        super().__init__(title)
        self._colours = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())
        self._root = self.named(self.shapes.NewShape(), title)
        self._parts: dict[str, TDF_Label] = {}

    def body(self, name: str, position: Placement) -> TDF_Label:
        """A new body at a position."""
        body = self.named(self.shapes.NewShape(), name)
        self.named(self.shapes.AddComponent(self._root, body, _location(position)), name)
        return body

    def add(self, body: TDF_Label, part: Part, position: Placement, features: Sequence[ToleratedFeature]) -> None:
        """A part in a body."""
        if part.id not in self._parts:
            label = self._parts[part.id] = self.solid(part.id, part_solid(part), features)
            self._colours.SetColor(label, Quantity_ColorRGBA(*colour_of(part)), XCAFDoc_ColorType.XCAFDoc_ColorSurf)
        self.named(self.shapes.AddComponent(body, self._parts[part.id], _location(position)), part.title)


def _location(position: Placement) -> TopLoc_Location:
    return TopLoc_Location(displacement(position))
