"""Semantic tolerances of a part in a STEP document (AP242): sizes with their fits, datums, form and position on faces.

A feature is found on the solid by its axis, size and reach: cylinders by their surfaces, squares and keyways by their
sides. With `step` and `step_assembly` the only modules that import OCP. Roughness has no entity in the kernel's writer.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.GProp import GProp_GProps
from OCP.OCP.collections import Sequence_TDF_Label
from OCP.TCollection import TCollection_HAsciiString
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shape
from OCP.XCAFDimTolObjects import (
    XCAFDimTolObjects_DatumObject,
    XCAFDimTolObjects_DimensionFormVariance,
    XCAFDimTolObjects_DimensionGrade,
    XCAFDimTolObjects_DimensionObject,
    XCAFDimTolObjects_DimensionType,
    XCAFDimTolObjects_GeomToleranceObject,
    XCAFDimTolObjects_GeomToleranceType,
    XCAFDimTolObjects_GeomToleranceTypeValue,
)
from OCP.XCAFDoc import XCAFDoc_Datum, XCAFDoc_Dimension, XCAFDoc_DocumentTool, XCAFDoc_GeomTolerance

from ilmek.arrays import FloatArray
from ilmek.errors import OutputError
from ilmek.part.tolerances import Characteristic, FeatureKind, GeometricTolerance, ToleratedFeature
from ilmek.records import record
from ilmek.units import mm

_NEAR = 1e-4
"""Distance that counts as rounding of the kernel [mm], and of directions."""

_TYPES = {
    Characteristic.FLATNESS: "Flatness",
    Characteristic.CYLINDRICITY: "Cylindricity",
    Characteristic.POSITION: "Position",
    Characteristic.RUN_OUT: "CircularRunout",
    Characteristic.TOTAL_RUN_OUT: "TotalRunout",
}

_SQUARES = {FeatureKind.SQUARE, FeatureKind.SQUARE_BORE}
_THREADS, _OUTER = {FeatureKind.THREAD, FeatureKind.OUTER_THREAD}, {FeatureKind.JOURNAL, FeatureKind.OUTER_THREAD}


@record
class _Surface:
    """A face: a cylinder with its radius, or a plane with radius 0 [mm].

    inside  of a bore      middle  of its area      point, along  on its axis and along it; of a plane its normal
    """

    face: TopoDS_Face
    radius: float
    inside: bool
    middle: FloatArray
    point: FloatArray
    along: FloatArray


def add_tolerances(
    document: TDocStd_Document, part: TDF_Label, solid: TopoDS_Shape, features: Sequence[ToleratedFeature]
) -> None:
    """Add the tolerances of a part's features to its faces.

    Raises OutputError for a feature that is not on the solid.
    """
    added = _Added(document, part)
    surfaces: tuple[_Surface, ...] = tuple(_surfaces(solid))
    faces = {feature.name: _faces(feature, surfaces) for feature in features}
    for feature in features:
        for first, second in faces[feature.name] if feature.kind is not FeatureKind.FACE else ():
            added.size(feature, first, second)
        if feature.depth:
            added.depth(feature, surfaces)
    lettered = {
        letter: added.labels(_both([pair for own in features if own.datum == letter for pair in faces[own.name]]))
        for letter in {feature.datum for feature in features if feature.datum}
    }
    for feature in features:
        for tolerance in feature.geometric:
            added.geometric(tolerance, added.labels(_both(faces[feature.name])), lettered)


_Sides = tuple[tuple[_Surface, ...], tuple[_Surface, ...]]


def _both(pairs: Sequence[_Sides]) -> tuple[_Surface, ...]:
    return tuple(surface for first, second in pairs for surface in (*first, *second))


class _Added:
    """The tolerances of a part while they are added."""

    def __init__(self, document: TDocStd_Document, part: TDF_Label) -> None:
        self._shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
        self._table = XCAFDoc_DocumentTool.DimTolTool_s(document.Main())
        self._part = part

    def labels(self, surfaces: Sequence[_Surface]) -> Sequence_TDF_Label:
        """The labels of faces."""
        labels = Sequence_TDF_Label()
        for surface in surfaces:
            labels.Append(self._shapes.AddSubShape(self._part, surface.face))
        return labels

    def size(self, one: ToleratedFeature, first: Sequence[_Surface], second: Sequence[_Surface]) -> None:
        """The nominal size with its class and limits: of a cylinder, or from side to side."""
        size = _dimension("Size_Diameter" if not second else "Location_LinearDistance", one.nominal, one.name)
        if one.kind not in _THREADS:
            _limit(size, one.lower, one.upper)
            size.SetClassOfTolerance(*_class(one.tolerance))
        self._set(size, first, second)

    def depth(self, one: ToleratedFeature, surfaces: tuple[_Surface, ...]) -> None:
        """The depth of a keyway, from its floor to the opposite side of the shaft or bore."""
        floor, opposite = _floor(one, surfaces)
        size = _dimension("Location_LinearDistance", one.depth, f"{one.name}-depth")
        _limit(size, one.depth_lower, one.depth_upper)
        self._set(size, floor, opposite)

    def _set(
        self, size: XCAFDimTolObjects_DimensionObject, first: Sequence[_Surface], second: Sequence[_Surface]
    ) -> None:
        label = self._table.AddDimension()
        self._table.SetDimension(self.labels(first), self.labels(second), label)
        XCAFDoc_Dimension.Set_s(label).SetObject(size)

    def geometric(
        self, tolerance: GeometricTolerance, faces: Sequence_TDF_Label, lettered: Mapping[str, Sequence_TDF_Label]
    ) -> None:
        """A tolerance of form or position, with its datums."""
        label = self._table.AddGeomTolerance()
        self._table.SetGeomTolerance(faces, label)
        made = XCAFDimTolObjects_GeomToleranceObject()
        kind = f"XCAFDimTolObjects_GeomToleranceType_{_TYPES[tolerance.characteristic]}"
        made.SetType(getattr(XCAFDimTolObjects_GeomToleranceType, kind))
        if tolerance.round:
            diameter = XCAFDimTolObjects_GeomToleranceTypeValue.XCAFDimTolObjects_GeomToleranceTypeValue_Diameter
            made.SetTypeOfValue(diameter)
        made.SetValue(tolerance.value / mm)
        XCAFDoc_GeomTolerance.Set_s(label).SetObject(made)
        for number, letters in enumerate(tolerance.datums, 1):
            for letter in letters.split("-"):
                datum = XCAFDimTolObjects_DatumObject()
                datum.SetName(TCollection_HAsciiString(letter))
                datum.SetPosition(number)
                on = self._table.AddDatum()
                XCAFDoc_Datum.Set_s(on).SetObject(datum)
                self._table.SetDatum(lettered[letter], on)
                self._table.SetDatumToGeomTol(on, label)


def _dimension(kind: str, value: float, name: str) -> XCAFDimTolObjects_DimensionObject:
    size = XCAFDimTolObjects_DimensionObject()
    size.SetType(getattr(XCAFDimTolObjects_DimensionType, f"XCAFDimTolObjects_DimensionType_{kind}"))
    size.SetValue(value / mm)
    size.SetSemanticName(TCollection_HAsciiString(name))
    return size


def _limit(size: XCAFDimTolObjects_DimensionObject, lower: float, upper: float) -> None:
    """Set limit deviations [m]; the kernel takes the lower one as what the size may be less."""
    size.SetUpperTolValue(upper / mm)
    size.SetLowerTolValue(-lower / mm)


def _class(
    tolerance: str,
) -> tuple[bool, XCAFDimTolObjects_DimensionFormVariance, XCAFDimTolObjects_DimensionGrade]:
    """Whether it is of a hole, letters and grade of a tolerance class."""
    letters = tolerance.rstrip("0123456789")
    grade, letter = int(tolerance[len(letters) :]) - _WRITTEN_HIGHER, letters.upper()
    return (
        letters.isupper(),
        getattr(XCAFDimTolObjects_DimensionFormVariance, f"XCAFDimTolObjects_DimensionFormVariance_{letter}"),
        getattr(XCAFDimTolObjects_DimensionGrade, f"XCAFDimTolObjects_DimensionGrade_IT{grade}"),
    )


_WRITTEN_HIGHER = 2
"""The kernel writes a grade as this much higher than it is set: the number of its row, not its name."""


def _surfaces(solid: TopoDS_Shape) -> Iterator[_Surface]:
    """The cylinders and planes of a solid."""
    explorer = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        face = TopoDS.Face(explorer.Current())
        explorer.Next()
        surface, properties = BRepAdaptor_Surface(face), GProp_GProps()
        kind = surface.GetType()
        if kind == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            axis, radius = surface.Cylinder().Axis(), surface.Cylinder().Radius()
            reverse = (face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED) == surface.Cylinder().Direct()
        elif kind == GeomAbs_SurfaceType.GeomAbs_Plane:
            axis, radius, reverse = surface.Plane().Axis(), 0.0, False
        else:
            continue
        BRepGProp.SurfaceProperties_s(face, properties)
        centre, on, along = properties.CentreOfMass(), axis.Location(), axis.Direction()
        yield _Surface(face, radius, reverse, *(np.array([one.X(), one.Y(), one.Z()]) for one in (centre, on, along)))


@record
class _Frame:
    """The faces of a solid from a feature's frame [mm]."""

    one: ToleratedFeature
    surfaces: tuple[_Surface, ...]

    def _seen(self, surface: _Surface) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Middle of a face, point on its axis or plane, and direction of the axis or normal."""
        turned, origin = self.one.position.rotation, self.one.position.origin / mm
        return (surface.middle - origin) @ turned, (surface.point - origin) @ turned, surface.along @ turned

    def cylinders(self, radius: float, inside: bool | None = None) -> tuple[_Surface, ...]:
        """The faces on the feature's cylinder of a radius [mm]; inside: of a bore, None: of either."""
        seen = ((surface, *self._seen(surface)) for surface in self.surfaces if abs(surface.radius - radius) < _NEAR)
        return tuple(
            surface
            for surface, middle, point, along in seen
            if (inside is None or surface.inside == inside)
            and self._beside(middle)
            and abs(abs(along[2]) - 1) < _NEAR
            and np.hypot(point[0], point[1]) < _NEAR
        )

    def planes(self, axis: int, *, sense: int, distance: float, beyond: float = -np.inf) -> tuple[_Surface, ...]:
        """The plane faces across x (0) or y (1), at a distance to a side [mm], their middle beyond an x."""
        seen = ((surface, *self._seen(surface)) for surface in self.surfaces if surface.radius == 0)
        return tuple(
            surface
            for surface, middle, _, along in seen
            if abs(abs(along[axis]) - 1) < _NEAR
            and abs(sense * middle[axis] - distance) < _NEAR
            and self._beside(middle)
            and middle[0] > beyond
        )

    def facing(self) -> tuple[_Surface, ...]:
        """The plane face in the feature's plane whose middle is nearest."""
        seen = ((surface, *self._seen(surface)) for surface in self.surfaces if surface.radius == 0)
        apart = [
            (float(np.hypot(middle[0], middle[1])), number, surface)
            for number, (surface, middle, _, along) in enumerate(seen)
            if abs(abs(along[2]) - 1) < _NEAR and abs(middle[2]) < _NEAR
        ]
        return (min(apart)[2],) if apart else ()

    def _beside(self, middle: FloatArray) -> bool:
        """Whether the middle of a face is that of the feature along its axis."""
        return bool(abs(middle[2] - self.one.length / mm / 2) < _NEAR)


def _faces(one: ToleratedFeature, surfaces: tuple[_Surface, ...]) -> tuple[_Sides, ...]:
    """The faces of a feature: of a cylinder, without others; of a keyway its sides, of a square two pairs of them."""
    frame, half = _Frame(one, surfaces), one.nominal / mm / 2
    if one.kind is FeatureKind.FACE:
        under = frame.facing()
        return _required(one, ((under, ()),), under)
    if one.kind in _SQUARES:
        pairs = tuple(
            (frame.planes(axis, sense=1, distance=half), frame.planes(axis, sense=-1, distance=half)) for axis in (0, 1)
        )
    elif one.depth:
        sides = (frame.planes(1, sense=sense, distance=half, beyond=0.0) for sense in (1, -1))
        pairs = ((next(sides), next(sides)),)
    else:
        found = frame.cylinders(half, inside=one.kind not in _OUTER)
        return _required(one, ((found, ()),), found)
    return _required(one, pairs, *(side for pair in pairs for side in pair))


def _required(one: ToleratedFeature, faces: tuple[_Sides, ...], *each: tuple[_Surface, ...]) -> tuple[_Sides, ...]:
    if not all(each):
        raise OutputError(f"{one.name} of {one.part} is not on its solid")
    return faces


def _floor(one: ToleratedFeature, surfaces: tuple[_Surface, ...]) -> _Sides:
    """The floor of a keyway, and the cylinder of its shaft or bore."""
    frame = _Frame(one, surfaces)
    for radius in sorted({round(surface.radius, 6) for surface in surfaces} - {0.0}):
        floor, opposite = frame.planes(0, sense=1, distance=one.depth / mm - radius), frame.cylinders(radius)
        if floor and opposite:
            return floor, opposite
    raise OutputError(f"the floor of {one.name} of {one.part} is not on its solid")
