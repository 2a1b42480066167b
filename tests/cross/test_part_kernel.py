"""Moments of shapes beside those of a CAD kernel, which builds the same solids from its own primitives."""

import io
import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from ilmek.part.moments import Moments
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, bar, box, disc, square_tube, stepped, tube
from ilmek.plane.contours import circle, polygon, rounded_hull, strip
from ilmek.report import WorkPiece

pytest.importorskip("OCP")  # its wheel is not made for every platform

from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon, BRepBuilderAPI_Transform
from OCP.BRepGProp import BRepGProp
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeRevol,
    BRepPrimAPI_MakeTorus,
)
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.STEPControl import STEPControl_Reader
from OCP.TopoDS import TopoDS_Shape

from ilmek.io import step

_UP = gp_Dir(0.0, 0.0, 1.0)


def _cylinder(radius: float, length: float, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> TopoDS_Shape:
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), _UP), radius, length).Shape()


def _box(width: float, height: float, length: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeBox(gp_Pnt(-width / 2, -height / 2, 0.0), width, height, length).Shape()


def _cut(body: TopoDS_Shape, *tools: TopoDS_Shape) -> TopoDS_Shape:
    for tool in tools:
        body = BRepAlgoAPI_Cut(body, tool).Shape()
    return body


def _fused(*bodies: TopoDS_Shape) -> TopoDS_Shape:
    whole, *others = bodies
    for other in others:
        whole = BRepAlgoAPI_Fuse(whole, other).Shape()
    return whole


def _moved(body: TopoDS_Shape, x: float, y: float, z: float, angle: float) -> TopoDS_Shape:
    """Turned about x by an angle, then moved."""
    turned, shifted = gp_Trsf(), gp_Trsf()
    turned.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)), angle)
    shifted.SetTranslation(gp_Vec(x, y, z))
    return BRepBuilderAPI_Transform(body, shifted.Multiplied(turned)).Shape()


def _polygon_face(corners: list[tuple[float, float, float]]) -> TopoDS_Shape:
    wire = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        wire.Add(gp_Pnt(*corner))
    wire.Close()
    return BRepBuilderAPI_MakeFace(wire.Wire(), True).Face()


def _cone() -> TopoDS_Shape:
    face = _polygon_face([(0, 0, 0), (0.3, 0, 0), (0.1, 0, 0.4), (0, 0, 0.4)])
    return BRepPrimAPI_MakeRevol(face, gp_Ax1(gp_Pnt(0, 0, 0), _UP)).Shape()


def _ell() -> TopoDS_Shape:
    corners = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.2, 0.1, 0.0), (0.1, 0.1, 0.0), (0.1, 0.3, 0.0), (0.0, 0.3, 0.0)]
    return BRepPrimAPI_MakePrism(_polygon_face(corners), gp_Vec(0, 0, 0.05)).Shape()


def _bent() -> TopoDS_Shape:
    """A strip with a square corner: two bars with round ends, and its quarter turn outside; the inner corner sharp."""
    pieces = [_moved(_box(0.2, 0.04, 0.01), 0.1, 0.0, 0.0, 0.0), _moved(_box(0.04, 0.3, 0.01), 0.2, 0.15, 0.0, 0.0)]
    return _fused(*pieces, *(_cylinder(0.02, 0.01, x, y) for x, y in ((0.0, 0.0), (0.2, 0.0), (0.2, 0.3))))


_WELDED = Sum(
    (Placed(box(0.2, 0.1, 0.3)), Placed(tube(0.08, 0.01, 0.4), (placement(0.1, 0.2, 0.3, about=(1, 0, 0), angle=0.7),)))
)
_CASES: dict[str, tuple[Shape, Callable[[], TopoDS_Shape]]] = {
    "box": (box(0.1, 0.2, 0.3), lambda: _box(0.1, 0.2, 0.3)),
    "round bar": (bar(0.05, 0.4), lambda: _cylinder(0.025, 0.4)),
    "tube": (tube(0.14, 0.005, 1.2), lambda: _cut(_cylinder(0.07, 1.2), _cylinder(0.065, 1.2))),
    "square tube": (square_tube(0.06, 0.004, 1.0), lambda: _cut(_box(0.06, 0.06, 1.0), _box(0.052, 0.052, 1.0))),
    "stepped shaft": (
        stepped((0.02, 0.1), (0.04, 0.2), (0.03, 0.05)),
        lambda: _fused(_cylinder(0.01, 0.1), _cylinder(0.02, 0.2, z=0.1), _cylinder(0.015, 0.05, z=0.3)),
    ),
    "cone": (Turned(Profile(polygon(np.array([0, 0.3j, 0.4 + 0.1j, 0.4])))), _cone),
    "ring": (Turned(Profile(circle(0.5j, 0.1))), lambda: BRepPrimAPI_MakeTorus(0.5, 0.1).Shape()),
    "bored disc": (
        Prism(disc(0.1, circle(0.04 + 0j, 0.02)), 0.01),
        lambda: _cut(_cylinder(0.1, 0.01), _cylinder(0.02, 0.01, 0.04)),
    ),
    "link": (
        Prism(Profile(rounded_hull(np.array([0, 0.2]), 0.02), (circle(0j, 0.008), circle(0.2 + 0j, 0.006))), 0.01),
        lambda: _cut(
            _fused(_moved(_box(0.2, 0.04, 0.01), 0.1, 0, 0, 0), _cylinder(0.02, 0.01), _cylinder(0.02, 0.01, 0.2)),
            _cylinder(0.008, 0.01),
            _cylinder(0.006, 0.01, 0.2),
        ),
    ),
    "bent strip": (Prism(Profile(strip(np.array([0, 0.2, 0.2 + 0.3j]), 0.02)), 0.01), _bent),
    "ell": (
        Prism(Profile(polygon(np.array([0, 0.2, 0.2 + 0.1j, 0.1 + 0.1j, 0.1 + 0.3j, 0.3j]))), 0.05),
        _ell,
    ),
    "weldment": (
        _WELDED,
        lambda: _fused(
            _box(0.2, 0.1, 0.3),
            _moved(_cut(_cylinder(0.04, 0.4), _cylinder(0.03, 0.4)), 0.1, 0.2, 0.3, 0.7),
        ),
    ),
}


def _of_kernel(body: TopoDS_Shape) -> tuple[float, np.ndarray, np.ndarray]:
    """Volume, centre and inertia tensor about the centre, integrated by the kernel to 1e-9."""
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(body, found, 1e-9, False, False)
    centre, tensor = found.CentreOfMass(), found.MatrixOfInertia()
    inertia = [[tensor.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)]
    return found.Mass(), np.array([centre.X(), centre.Y(), centre.Z()]), np.array(inertia)


@pytest.mark.parametrize("name", _CASES)
def test_the_moments_are_those_of_the_kernel(name: str) -> None:
    shape, build = _CASES[name]
    own: Moments = shape.moments
    volume, centre, inertia = _of_kernel(build())
    size = math.sqrt(np.trace(own.inertia) / own.zeroth)
    assert own.zeroth == pytest.approx(volume, rel=1e-7)
    assert own.centre == pytest.approx(centre, abs=1e-7 * size)
    assert np.abs(own.inertia - inertia).max() <= 1e-6 * np.trace(inertia)


@pytest.mark.parametrize("name", _CASES)
def test_the_file_of_a_shape_has_the_moments_of_the_shape(name: str, tmp_path: Path) -> None:
    """Written as STEP, read back by the kernel, lying where the shape says."""
    shape, _ = _CASES[name]
    piece = WorkPiece(name, name, "", "steel", 1, shape, shape.moments.zeroth)
    step.write_piece(tmp_path / "piece.step", piece)
    reader = STEPControl_Reader()
    reader.ReadStream("piece", io.BytesIO((tmp_path / "piece.step").read_bytes()))
    reader.TransferRoots()
    volume, centre, inertia = _of_kernel(reader.OneShape())
    own = shape.moments
    assert volume / 1e9 == pytest.approx(own.zeroth, rel=1e-6)
    assert centre / 1e3 == pytest.approx(own.centre, abs=1e-7)
    assert np.abs(inertia / 1e15 - own.inertia).max() <= 1e-5 * np.trace(own.inertia)
