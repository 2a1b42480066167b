"""A tree of bodies as one STEP assembly (AP242, mm): each part once, with name and colour; each body an assembly of the
parts that it has, placed where it is at an angle of a drive.

With `step` the only module that imports OCP, as there. The kernel orders the colours in a file as it likes.
"""

import io
from collections.abc import Mapping, Sequence

import numpy as np
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.gp import gp_Trsf
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Quantity import Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

from ilmek.errors import OutputError
from ilmek.io.colours import colour_of
from ilmek.io.step import displacement, part_solid, with_header
from ilmek.io.step_tolerances import add_tolerances
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.tolerances import ToleratedFeature, tolerances_of
from ilmek.part.tree import Tree

SCHEMA = "AP242DIS"


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


def part_bytes(part: Part, features: Sequence[ToleratedFeature]) -> bytes:
    """The content of a STEP file of one part in its own axes, with what its features must hold.

    Raises OutputError as `assembly_bytes`, and for a feature that is not on its solid.
    """
    alone = _Assembly(part.title)
    alone.part(part, features)
    return alone.content()


class _Assembly:
    """An assembly while it is made."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._document = TDocStd_Document(_words("XmlOcaf"))
        XCAFApp_Application.GetApplication_s().NewDocument(_words("MDTV-XCAF"), self._document)
        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(self._document.Main())
        self._colours = XCAFDoc_DocumentTool.ColorTool_s(self._document.Main())
        self._root: TDF_Label | None = None
        self._parts: dict[str, TDF_Label] = {}

    def body(self, name: str, position: Placement) -> TDF_Label:
        """A new body at a position."""
        if self._root is None:
            self._root = self._named(self._shapes.NewShape(), self._title)
        body = self._named(self._shapes.NewShape(), name)
        self._named(self._shapes.AddComponent(self._root, body, _location(position)), name)
        return body

    def part(self, part: Part, features: Sequence[ToleratedFeature]) -> None:
        """A part with its tolerances, once."""
        if part.id in self._parts:
            return
        solid = part_solid(part)
        if not BRepCheck_Analyzer(solid).IsValid():
            raise OutputError(f"{part.id} gives no valid solid", do="check whether its outline crosses itself")
        label = self._parts[part.id] = self._named(self._shapes.AddShape(solid, False), part.id)
        self._colours.SetColor(label, Quantity_ColorRGBA(*colour_of(part)), XCAFDoc_ColorType.XCAFDoc_ColorSurf)
        add_tolerances(self._document, label, solid, features)

    def add(self, body: TDF_Label, part: Part, position: Placement, features: Sequence[ToleratedFeature]) -> None:
        """A part in a body."""
        self.part(part, features)
        self._named(self._shapes.AddComponent(body, self._parts[part.id], _location(position)), part.title)

    def content(self) -> bytes:
        """The file."""
        self._shapes.UpdateAssemblies()
        writer = STEPCAFControl_Writer()  # its constructor registers the settings below
        writer.SetDimTolMode(True)
        settings: Mapping[str, str] = {"write.step.schema": SCHEMA, "write.step.unit": "MM"}
        for name, value in settings.items():
            Interface_Static.SetCVal_s(name, value)
        written = io.BytesIO()
        try:
            done = writer.Transfer(self._document)
            with_header(writer.ChangeWriter().Model(False), self._title)
            if not done or writer.WriteStream(written) != IFSelect_ReturnStatus.IFSelect_RetDone:
                raise OutputError(f"{self._title} cannot be written as STEP")
        finally:
            Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
        return written.getvalue()

    @staticmethod
    def _named(label: TDF_Label, name: str) -> TDF_Label:
        TDataStd_Name.Set_s(label, _words(name))
        return label


def _location(position: Placement) -> TopLoc_Location:
    motion: gp_Trsf = displacement(position)
    return TopLoc_Location(motion)


def _words(text: str) -> TCollection_ExtendedString:
    return TCollection_ExtendedString(text, True)
