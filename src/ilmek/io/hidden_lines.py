"""Visible and hidden lines of a solid on a plane, by the kernel's exact hidden-line removal.

With `step` and `step_assembly` the only module that imports OCP; importing it without the extra raises ImportError.
"""

import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepLib import BRepLib
from OCP.GCPnts import GCPnts_TangentialDeflection
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.HLRAlgo import HLRAlgo_Projector
from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape

from ilmek.arrays import ComplexArray
from ilmek.io.step import shape_solid
from ilmek.units import mm

Direction = tuple[float, float, float]


def projected(shape: object, eye: Direction, right: Direction) -> tuple[list[ComplexArray], list[ComplexArray]]:
    """Visible and hidden lines of a shape of the package `part`, complex points of a plane [m].

    eye, right  directions towards the eye, and to the right on the plane
    Raises OutputError for a shape of which the kernel makes no solid.
    """
    algorithm = HLRBRep_Algo()
    algorithm.Add(shape_solid(shape), 0)
    algorithm.Projector(HLRAlgo_Projector(gp_Ax2(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(*eye), gp_Dir(*right))))
    algorithm.Update()
    algorithm.Hide()
    lines = HLRBRep_HLRToShape(algorithm)
    visible = [line for part in (lines.VCompound(), lines.OutLineVCompound()) for line in _polylines(part)]
    hidden = [line for part in (lines.HCompound(), lines.OutLineHCompound()) for line in _polylines(part)]
    return visible, hidden


def _polylines(compound: TopoDS_Shape | None) -> list[ComplexArray]:
    if compound is None or compound.IsNull():
        return []
    BRepLib.BuildCurves3d_s(compound)
    polylines = []
    explorer = TopExp_Explorer(compound, TopAbs_ShapeEnum.TopAbs_EDGE)
    while explorer.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
        points = GCPnts_TangentialDeflection(curve, 0.1, 0.01)
        values = [points.Value(number) for number in range(1, points.NbPoints() + 1)]
        polylines.append(np.array([complex(point.X(), point.Y()) for point in values]) * mm)
        explorer.Next()
    return polylines
