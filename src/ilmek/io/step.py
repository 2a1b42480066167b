"""Plates as STEP solids (AP214, mm): the contours of the DXF, extruded. The only module that imports OCP.

OCP is the extra `step`; without it, importing this module raises ImportError. Its releases rename classes; therefore
all imports of it are here, and the extra is pinned below the next release.
"""

import io
from pathlib import Path

import numpy as np
from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.GC import GC_MakeArcOfCircle
from OCP.gp import gp_Pnt, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Message import Message, Message_Gravity
from OCP.STEPControl import STEPControl_Reader, STEPControl_StepModelType, STEPControl_Writer
from OCP.TCollection import TCollection_HAsciiString
from OCP.TopoDS import TopoDS_Shape, TopoDS_Wire

from ilmek.errors import OutputError
from ilmek.io.plate_shape import PlateShape
from ilmek.plane.contours import STRAIGHT, circle, on_piece
from ilmek.report import Contour, Plate
from ilmek.units import mm

TIME_STAMP = "2000-01-01T00:00:00"
"""Of every file, as in the DXF: the same plate gives the same bytes."""

for _printer in Message.DefaultMessenger_s().Printers():
    _printer.SetTraceLevel(Message_Gravity.Message_Fail)  # otherwise each transfer is printed on standard output


def write_step(path: Path, plate: Plate, shape: PlateShape) -> None:
    """Write a plate as a solid. Raises OutputError if the solid is invalid or cannot be written."""
    solid = _solid(plate, shape)
    if not BRepCheck_Analyzer(solid).IsValid():
        raise OutputError(f"{plate.name} gives no valid solid", do="check whether its outline crosses itself")
    writer = STEPControl_Writer()  # its constructor registers the settings below
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetCVal_s("write.step.product.name", plate.name)
    writer.Transfer(solid, STEPControl_StepModelType.STEPControl_AsIs)
    header = APIHeaderSection_MakeHeader(writer.Model(False))
    header.SetName(TCollection_HAsciiString(plate.title))
    header.SetTimeStamp(TCollection_HAsciiString(TIME_STAMP))
    header.SetAuthorValue(1, TCollection_HAsciiString("ilmek"))
    header.SetOriginatingSystem(TCollection_HAsciiString("ilmek"))
    written = io.BytesIO()  # the library opens only paths in UTF-8
    if writer.WriteStream(written) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OutputError(f"{path} cannot be written as STEP")
    path.write_bytes(written.getvalue())


def read_step_volume(path: Path) -> float:
    """Volume of the solid in a file, read back [m^3]. Raises OutputError if there is none."""
    reader = STEPControl_Reader()
    content = path.read_bytes() if path.is_file() else b""
    if reader.ReadStream("plate", io.BytesIO(content)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OutputError(f"{path} cannot be read back as STEP")
    reader.TransferRoots()
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(reader.OneShape(), found)
    return float(found.Mass()) * mm**3


def _solid(plate: Plate, shape: PlateShape) -> TopoDS_Shape:
    """The plate, extruded from z = 0."""
    face = BRepBuilderAPI_MakeFace(_wire(shape.outline), True)
    for cut in (*shape.cutouts, *(circle(bore.at, bore.radius) for bore in plate.holes)):
        hole = _wire(cut)
        hole.Reverse()
        face.Add(hole)
    return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, plate.thickness / mm)).Shape()


def _wire(contour: Contour) -> TopoDS_Wire:
    """A contour as a closed wire in the plane z = 0; arcs are exact."""
    wire = BRepBuilderAPI_MakeWire()
    points = [_point(complex(at)) for at in contour.points]
    for start, bulge in enumerate(contour.bulges):
        end = (start + 1) % len(points)
        if abs(bulge) < STRAIGHT:
            edge = BRepBuilderAPI_MakeEdge(points[start], points[end])
        else:
            ends = complex(contour.points[start]), complex(contour.points[end])
            middle = complex(on_piece(*ends, float(bulge), _HALF)[0])
            edge = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(points[start], _point(middle), points[end]).Value())
        wire.Add(edge.Edge())
    return wire.Wire()


_HALF = np.array([0.5])


def _point(at: complex) -> gp_Pnt:
    return gp_Pnt(at.real / mm, at.imag / mm, 0.0)
