"""Parts as STEP solids (AP242, mm): plates as the contours of the DXF, extruded; barrel and end cams with their flanks
as smooth surfaces through exact points; each with the tolerances of its features.

OCP is the extra `step`; without it, importing this module raises ImportError. Its releases rename classes; therefore
all imports of it are here, and the extra is pinned below the next release.
"""

import io
from functools import lru_cache
from pathlib import Path

import numpy as np
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Splitter
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_Copy,
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeSolid,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_Sewing,
    BRepBuilderAPI_Transform,
)
from OCP.BRepGProp import BRepGProp
from OCP.BRepOffsetAPI import BRepOffsetAPI_ThruSections
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakePrism, BRepPrimAPI_MakeRevol
from OCP.GC import GC_MakeArcOfCircle
from OCP.GeomAbs import GeomAbs_Shape
from OCP.GeomAPI import GeomAPI_PointsToBSplineSurface
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.OCP.collections import Array2_gp_Pnt, List_TopoDS_Shape
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Shape, TopoDS_Wire

from ilmek.arrays import FloatArray
from ilmek.errors import OutputError
from ilmek.io.plate_shape import PlateShape
from ilmek.io.step_document import StepDocument
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, Placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Sum, Turned
from ilmek.part.tolerances import ToleratedFeature
from ilmek.part.twisted import TwistedBar
from ilmek.plane.biarcs import fitted
from ilmek.plane.contours import STRAIGHT, circle, on_piece
from ilmek.report import Contour, Plate, RoundSolid, WorkPiece
from ilmek.units import mm, um


def write_step(path: Path, plate: Plate, shape: PlateShape) -> None:
    """Write a plate as a solid. Raises OutputError if the solid is invalid or cannot be written."""
    _write(path, plate, _plate_solid(plate, shape))


def _plate_solid(plate: Plate, shape: PlateShape) -> TopoDS_Shape:
    if plate.solid is None:
        return _solid(plate, shape)
    return _round_solid(plate.solid) if isinstance(plate.solid, RoundSolid) else shape_solid(plate.solid.shape)


def write_piece(path: Path, piece: WorkPiece) -> None:
    """Write a piece that is turned, sawn or welded. Raises OutputError as `write_step`."""
    _write(path, piece, shape_solid(piece.shape))


def _write(path: Path, made: Plate | WorkPiece, solid: TopoDS_Shape) -> None:
    document = StepDocument(made.title)
    document.solid(made.name, solid, [feature for feature in made.features if isinstance(feature, ToleratedFeature)])
    path.write_bytes(document.content())


def read_step_volume(path: Path) -> float:
    """Volume of the solid in a file, read back [m^3]. Raises OutputError if there is none."""
    reader = STEPControl_Reader()
    content = path.read_bytes() if path.is_file() else b""
    if reader.ReadStream("plate", io.BytesIO(content)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OutputError(f"{path} cannot be read back as STEP")
    reader.TransferRoots()
    return _volume(reader.OneShape()) * mm**3


def _volume(shape: TopoDS_Shape) -> float:
    """Volume [mm^3]; below 0 where the surface is inside out.

    With a stated error: the default rule has too few points for a surface of a cam (off by 1 %).
    """
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, found, _INTEGRATED, False, False)
    return float(found.Mass())


_INTEGRATED = 1e-5
"""Relative error of a volume."""


def _solid(plate: Plate, shape: PlateShape) -> TopoDS_Shape:
    """The plate, extruded from z = 0."""
    face = BRepBuilderAPI_MakeFace(_wire(shape.outline), True)
    for cut in (*shape.cutouts, *(circle(bore.at, bore.radius) for bore in plate.holes)):
        hole = _wire(cut)
        hole.Reverse()
        face.Add(hole)
    return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, plate.thickness / mm)).Shape()


def part_solid(part: Part) -> TopoDS_Shape:
    """The solid of a part with a shape, in its own axes [mm]."""
    drawn = None if part.drawing is None else part.drawing.solid
    # The kernel takes one solid for one part: those of a shape that several parts have are copies.
    return (
        _round_solid(drawn) if isinstance(drawn, RoundSolid) else BRepBuilderAPI_Copy(shape_solid(part.shape)).Shape()
    )


@lru_cache(maxsize=1024)
def shape_solid(shape: object) -> TopoDS_Shape:
    """A shape of the package `part` [mm]: prisms, turned profiles; twisted bars and sums as one compound of solids."""
    if isinstance(shape, Prism):
        solid = BRepPrimAPI_MakePrism(_face(shape.section), gp_Vec(0, 0, shape.length / mm)).Shape()
        if not shape.drilled:
            return solid
        cut = BRepAlgoAPI_Cut()
        cut.SetArguments(_shapes(solid))
        cut.SetTools(_shapes(*(_placed(shape_solid(hole.shape), hole.position) for hole in shape.drilled)))
        cut.Build()
        return cut.Shape()
    if isinstance(shape, Turned):
        around_x = BRepPrimAPI_MakeRevol(_face(shape.profile), gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0))).Shape()
        return _placed(around_x, ALONG_WIDTH.inverse)
    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    if isinstance(shape, TwistedBar):
        for stretch in shape.stretches(_TWIST):
            builder.Add(whole, _lofted(stretch))
        return whole
    if not isinstance(shape, Sum):
        allowed = "prisms, turned profiles, twisted bars and sums of them"
        raise OutputError(f"no solid of {type(shape).__name__}", allowed=allowed)
    for member in shape.members:
        solid = shape_solid(member.shape)
        for position in member.positions:
            builder.Add(whole, _placed(solid, position))
    return whole


_TWIST = np.deg2rad(5.0)
"""Twist between two sections of a twisted bar, between which its sides are smooth."""


def _lofted(sections: FloatArray) -> TopoDS_Shape:
    """A solid through plane sections, (sections, corners, 3) [m]; straight between two."""
    loft = BRepOffsetAPI_ThruSections(True, len(sections) == 2, 1e-7)
    for section in sections / mm:
        polygon = BRepBuilderAPI_MakePolygon()
        for corner in section.tolist():
            polygon.Add(gp_Pnt(*corner))
        polygon.Close()
        loft.AddWire(polygon.Wire())
    return loft.Shape()


def _placed(solid: TopoDS_Shape, position: Placement) -> TopoDS_Shape:
    return BRepBuilderAPI_Transform(solid, displacement(position), True).Shape()


def displacement(position: Placement) -> gp_Trsf:
    """A position as a rigid displacement of the kernel [mm]."""
    motion, (x, y, z) = gp_Trsf(), (position.origin / mm).tolist()
    first, second, third = position.rotation.tolist()
    motion.SetValues(*first, x, *second, y, *third, z)
    return motion


def _face(profile: Profile) -> TopoDS_Shape:
    """A figure in the plane z = 0; a smooth outline as arcs through its points."""
    outline, *holes = profile.contours
    outline = fitted(outline.points, _ARCS) if profile.smooth else outline
    face = BRepBuilderAPI_MakeFace(_wire(outline), True)
    for hole in holes:  # they run clockwise
        face.Add(_wire(hole))
    return face.Face()


_ARCS = 0.1 * um
"""Allowed deviation of arcs from the points of a smooth outline [m]."""


def _round_solid(part: RoundSolid) -> TopoDS_Shape:
    """A barrel less its groove and bore, or the ring below the flank of an end cam."""
    body = _cylinder(part, part.outer)
    if part.upper is not None:
        body = BRepAlgoAPI_Cut(body, _groove(part.lower, part.upper)).Shape()
        return body if part.bore is None else BRepAlgoAPI_Cut(body, _prism(part, part.bore)).Shape()
    ring = BRepAlgoAPI_Cut(body, _cylinder(part, part.inner)).Shape()
    cut = BRepAlgoAPI_Splitter()
    cut.SetArguments(_shapes(ring))
    cut.SetTools(_shapes(_face_through(part.lower)))
    cut.Build()
    return min(_parts(cut.Shape(), TopAbs_ShapeEnum.TopAbs_SOLID), key=_middle_height)


def _groove(lower: FloatArray, upper: FloatArray) -> TopoDS_Shape:
    """The groove as a closed body: both flanks, its floor, and a lid above the barrel."""
    floor, lid = (_between(lower[:, at], upper[:, at]) for at in (0, lower.shape[1] - 1))
    sewing = BRepBuilderAPI_Sewing(_SEAM)
    for points in (lower, upper, floor, lid):
        sewing.Add(_face_through(points))
    sewing.Perform()
    (shell,) = _parts(sewing.SewedShape(), TopAbs_ShapeEnum.TopAbs_SHELL)
    body = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid()
    if _volume(body) < 0:
        body.Reverse()
    return body


def _between(one: FloatArray, other: FloatArray) -> FloatArray:
    """A strip between two curves on a cylinder about z, on that cylinder."""
    share = np.linspace(0.0, 1.0, 5)[np.newaxis, :, np.newaxis]
    strip = one[:, np.newaxis] * (1 - share) + other[:, np.newaxis] * share
    radius = np.hypot(one[:, 0], one[:, 1])[:, np.newaxis]
    strip[..., :2] *= (radius / np.hypot(strip[..., 0], strip[..., 1]))[..., np.newaxis]
    return np.asarray(strip)


def _face_through(points: FloatArray) -> TopoDS_Shape:
    """A smooth face through a grid of points [m]."""
    rows, columns, _ = points.shape
    grid = Array2_gp_Pnt(1, rows, 1, columns)
    for row in range(rows):
        for column in range(columns):
            grid.SetValue(row + 1, column + 1, gp_Pnt(*(points[row, column] / mm).tolist()))
    surface = GeomAPI_PointsToBSplineSurface()
    surface.Init(grid, 3, 8, GeomAbs_Shape.GeomAbs_C2, _FITTED)
    return BRepBuilderAPI_MakeFace(surface.Surface(), _FITTED).Face()


_FITTED, _SEAM = 1e-4, 1e-2
"""Allowed distance of a surface from its points, and between the edges of neighbouring surfaces [mm]."""


def _cylinder(part: RoundSolid, radius: float) -> TopoDS_Shape:
    axis = gp_Ax2(gp_Pnt(0.0, 0.0, part.low / mm), gp_Dir(0.0, 0.0, 1.0))
    return BRepPrimAPI_MakeCylinder(axis, radius / mm, (part.high - part.low) / mm).Shape()


def _prism(part: RoundSolid, bore: Contour) -> TopoDS_Shape:
    """The bore over the whole length."""
    raised = gp_Trsf()
    raised.SetTranslation(gp_Vec(0.0, 0.0, part.low / mm))
    face = BRepBuilderAPI_Transform(BRepBuilderAPI_MakeFace(_wire(bore), True).Face(), raised).Shape()
    return BRepPrimAPI_MakePrism(face, gp_Vec(0.0, 0.0, (part.high - part.low) / mm)).Shape()


def _shapes(*shapes: TopoDS_Shape) -> List_TopoDS_Shape:
    found = List_TopoDS_Shape()
    for shape in shapes:
        found.Append(shape)
    return found


def _parts(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> list[TopoDS_Shape]:
    explorer, parts = TopExp_Explorer(shape, kind), []
    while explorer.More():
        parts.append(explorer.Current())
        explorer.Next()
    return parts


def _middle_height(shape: TopoDS_Shape) -> float:
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, found)
    return float(found.CentreOfMass().Z())


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
