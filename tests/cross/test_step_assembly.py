"""A machine as a STEP assembly, read back by the kernel: names, colours, placed parts, volumes, semantic tolerances.

Evidence: the kernel's own reader and its own integral of the volume of each solid; of tolerances also the
text of the file.
"""

import io
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from default_machines import default_report

from ilmek.errors import OutputError
from ilmek.io.colours import colour_of
from ilmek.jobs.workshop import write_workshop
from ilmek.machines.catalogue import find_machine
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.shapes import Prism
from ilmek.part.tolerances import Characteristic, FeatureKind, ToleratedFeature
from ilmek.part.tolerancing import tolerances_of
from ilmek.part.tree import Tree
from ilmek.units import deg, mm

pytest.importorskip("OCP")  # its wheel is not made for every platform

from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.GProp import GProp_GProps
from OCP.OCP.collections import Sequence_TDF_Label
from OCP.Quantity import Quantity_ColorRGBA
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDimTolObjects import XCAFDimTolObjects_GeomToleranceTypeValue
from OCP.XCAFDoc import (
    XCAFDoc_ColorType,
    XCAFDoc_Datum,
    XCAFDoc_DimTolTool,
    XCAFDoc_DocumentTool,
    XCAFDoc_GeomTolerance,
)

from ilmek.io.step import part_solid
from ilmek.io.step_assembly import assembly_bytes
from ilmek.io.step_document import StepDocument


class _Read:
    """The assembly of a file."""

    def __init__(self, content: bytes) -> None:
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("MDTV-XCAF"), self.document)
        reader = STEPCAFControl_Reader()
        reader.SetGDTMode(True)
        reader.ReadStream("assembly", io.BytesIO(content))
        assert reader.Transfer(self.document)
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.tolerances = XCAFDoc_DocumentTool.DimTolTool_s(self.document.Main())
        self._colours = XCAFDoc_DocumentTool.ColorTool_s(self.document.Main())

    def parts(self) -> Iterator[tuple[str, str, np.ndarray, TDF_Label]]:
        """Name of the body, name of the part, its place (4, 4) [mm], and its label."""
        roots = Sequence_TDF_Label()
        self.shapes.GetFreeShapes(roots)
        assert roots.Length() == 1
        for body, at_body in self._components(roots.Value(1)):
            for part, at_part in self._components(body):
                yield _name(body), _name(part), at_body @ at_part, part

    def _components(self, label: TDF_Label) -> Iterator[tuple[TDF_Label, np.ndarray]]:
        components = Sequence_TDF_Label()
        self.shapes.GetComponents_s(label, components)
        for number in range(1, components.Length() + 1):
            placed, part = components.Value(number), TDF_Label()
            self.shapes.GetReferredShape_s(placed, part)
            motion, place = self.shapes.GetLocation_s(placed).Transformation(), np.eye(4)
            place[:3] = [[motion.Value(row, column) for column in range(1, 5)] for row in range(1, 4)]
            yield part, place

    def colours(self, label: TDF_Label) -> Iterator[tuple[float, float, float, float]]:
        """Red, green, blue, opacity of each solid of a part."""
        solids, surface = (
            TopExp_Explorer(self.shapes.GetShape_s(label), TopAbs_ShapeEnum.TopAbs_SOLID),
            Quantity_ColorRGBA(),
        )
        while solids.More():
            assert self._colours.GetColor(solids.Current(), XCAFDoc_ColorType.XCAFDoc_ColorSurf, surface)
            rgb = surface.GetRGB()
            yield rgb.Red(), rgb.Green(), rgb.Blue(), surface.Alpha()
            solids.Next()

    def volume(self, label: TDF_Label) -> float:
        """Volume of a part [m³]."""
        found = GProp_GProps()
        BRepGProp.VolumeProperties_s(self.shapes.GetShape_s(label), found, 1e-7, False, False)
        return float(found.Mass()) * mm**3


def _name(label: TDF_Label) -> str:
    found = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), found)
    return str(found.Get().ToExtString())


def _tree(name: str, settings: dict[str, str]) -> Tree:
    machine = find_machine(name)
    assert machine.tree is not None
    tree: Tree = machine.tree(machine.design(machine.params.read(settings)))
    return tree


@pytest.mark.matrix(light=4)  # without the head, whose file takes as long as all others
@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("tufting", {"bars": "2"}),
        ("weaver", {}),
        ("cam", {"kind": "face"}),
        ("weft", {}),
        ("cam", {"lift": "17mm"}),
        ("knotting-dyad", {}),
    ],
)
def test_a_file_has_every_part_where_it_stands_with_its_name_colour_and_mass(
    name: str, settings: dict[str, str]
) -> None:
    tree, angle = _tree(name, settings), 70 * deg
    content = assembly_bytes(tree, "whole", "turn", angle)
    assert b"AP242" in content
    read = _Read(content)
    found: dict[tuple[str, str], list[np.ndarray]] = {}
    labels: dict[str, TDF_Label] = {}
    for body, part, place, label in read.parts():
        found.setdefault((body, part), []).append(place)
        labels[part] = label
    wanted = dict(_places(tree, angle))
    assert {key: len(places) for key, places in found.items()} == {key: len(places) for key, places in wanted.items()}
    for key, places in wanted.items():
        assert np.array(found[key]) == pytest.approx(np.array(places), abs=1e-6)
    for part, _ in tree.occurrences():
        assert part.shape is not None
        # A list counts the chords between the points of a smooth outline, the file has arcs through them.
        smooth = isinstance(part.shape, Prism) and part.shape.section.smooth
        assert read.volume(labels[part.id]) == pytest.approx(part.shape.volume, rel=5e-6 if smooth else 1e-6)
        if part.material is not None:
            assert part.mass == pytest.approx(part.shape.volume * part.material.density, rel=1e-12)
        colours = list(read.colours(labels[part.id]))
        assert colours
        assert all(colour == pytest.approx(colour_of(part), abs=2e-3) for colour in colours)


def _places(tree: Tree, angle: float) -> Iterator[tuple[tuple[str, str], list[np.ndarray]]]:
    """Places of each part of each body (4, 4) [mm]."""
    for chain in chains(tree):
        here = poses(chain, "turn", np.array([angle]))
        body = Placement(here.origin[0], here.rotation[0])
        for own in chain[-1].body.occurrences:
            yield (chain[-1].name, own.part.id), [_matrix(body.after(place)) for place in own.positions]


def _matrix(place: Placement) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = place.rotation, place.origin / mm
    return matrix


def _labels(listed: Callable[[Sequence_TDF_Label], None]) -> list[TDF_Label]:
    """The labels that a table lists."""
    found = Sequence_TDF_Label()
    listed(found)
    return [found.Value(number) for number in range(1, found.Length() + 1)]


def _faces(read: _Read) -> list[tuple[float, ...]]:
    """Radii of the cylinders [mm] on which each size is, as the kernel reads it: of planes none."""
    found = []
    for label in _labels(read.tolerances.GetDimensionLabels):
        sides = Sequence_TDF_Label(), Sequence_TDF_Label()
        XCAFDoc_DimTolTool.GetRefShapeLabel_s(label, *sides)
        faces = [labels.Value(number) for labels in sides for number in range(1, labels.Length() + 1)]
        assert faces
        surfaces = [BRepAdaptor_Surface(TopoDS.Face(read.shapes.GetShape_s(face))) for face in faces]
        cylinders = [one.Cylinder() for one in surfaces if one.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder]
        found.append(tuple(sorted({round(one.Radius(), 6) for one in cylinders})))
    return sorted(found)


class _Text:
    """The sizes of a file by its text, without the kernel: it reads limits of the same sign as a range of sizes."""

    def __init__(self, content: bytes) -> None:
        text = content.decode().replace("\r", "").replace("\n", "")
        self._all = {int(name): body for name, body in re.findall(r"#(\d+) = (.*?);(?=#|ENDSEC)", text)}

    def sizes(self) -> list[tuple[object, ...]]:
        """Nominal size and limit deviations [mm], class, and radii of the cylinders [mm] on which it is."""
        found = []
        for name, body in self._of("DIMENSIONAL_SIZE", "DIMENSIONAL_LOCATION"):
            (value,) = (refs[1] for refs in self._refs("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION") if refs[0] == name)
            radii = {radius for aspect in _refs(body) for radius in self._radii(aspect)}
            limits, zone = tuple[float, ...](), ""
            for tolerance, _ in (refs for refs in self._refs("PLUS_MINUS_TOLERANCE") if refs[1] == name):
                if self._all[tolerance].startswith("TOLERANCE_VALUE"):
                    limits = tuple(self._number(one) for one in _refs(self._all[tolerance]))
                else:
                    letters, on, grade = re.findall(r"'(\w+)'", self._all[tolerance])
                    assert letters.isupper() == (on == "hole")
                    zone = letters + grade
            found.append((self._number(_refs(self._all[value])[0]), *limits, zone, tuple(sorted(radii))))
        return sorted(found, key=str)

    def _of(self, *kinds: str) -> Iterator[tuple[int, str]]:
        return (
            (name, body) for name, body in self._all.items() if body.startswith(tuple(f"{kind}(" for kind in kinds))
        )

    def _refs(self, kind: str) -> Iterator[list[int]]:
        return (_refs(body) for _, body in self._of(kind))

    def _number(self, name: int) -> float:
        return round(float(re.findall(r"MEASURE(?:_WITH_UNIT)?\((-?[\d.E+-]+)", self._all[name])[-1]), 6) + 0.0

    def _radii(self, aspect: int) -> Iterator[float]:
        for own, *_, face in self._refs("GEOMETRIC_ITEM_SPECIFIC_USAGE"):
            surface = self._all[_refs(self._all[face])[-1]]
            if own == aspect and surface.startswith("CYLINDRICAL_SURFACE"):
                yield round(float(surface.rstrip(")").rpartition(",")[2]), 6)
        for whole, member in self._refs("SHAPE_ASPECT_RELATIONSHIP"):
            if whole == aspect:
                yield from self._radii(member)


def _refs(body: str) -> list[int]:
    return [int(name) for name in re.findall(r"#(\d+)", body)]


def _wanted_sizes(features: Sequence[ToleratedFeature]) -> list[tuple[object, ...]]:
    wanted: list[tuple[object, ...]] = []
    for one in features:
        size, lower, upper = (round(value / mm, 6) + 0.0 for value in (one.nominal, one.lower, one.upper))
        limits = ("",) if one.kind in {FeatureKind.THREAD, FeatureKind.OUTER_THREAD} else (lower, upper, one.tolerance)
        if one.depth:
            (shaft,) = (other for other in features if other.position is not one.position and _about(one, other))
            wanted.append((size, *limits, ()))
            deep = (round(value / mm, 6) + 0.0 for value in (one.depth, one.depth_lower, one.depth_upper))
            wanted.append((*deep, "", (round(shaft.nominal / mm / 2, 6),)))
        elif one.kind is FeatureKind.FACE:
            continue
        elif one.kind in {FeatureKind.SQUARE, FeatureKind.SQUARE_BORE}:
            wanted += [(size, *limits, ())] * 2
        else:
            wanted.append((size, *limits, (round(one.nominal / mm / 2, 6),)))
    return sorted(wanted, key=str)


def _about(keyway: ToleratedFeature, other: ToleratedFeature) -> bool:
    """Whether a keyway lies in a shaft or bore."""
    return not other.depth and bool(np.allclose(keyway.position.origin, other.position.origin))


def _geometric(read: _Read) -> list[tuple[object, ...]]:
    """Kind, value [mm], whether it is a diameter, and datums by their order, of each geometric tolerance."""
    found = []
    for label in _labels(read.tolerances.GetGeomToleranceLabels):
        one = XCAFDoc_GeomTolerance.Set_s(label).GetObject()
        datums = [
            XCAFDoc_Datum.Set_s(datum).GetObject()
            for datum in _labels(partial(read.tolerances.GetDatumWithObjectOfTolerLabels_s, label))
        ]
        lettered = tuple(sorted((datum.GetPosition(), datum.GetName().ToCString()) for datum in datums))
        wide = one.GetTypeOfValue() != XCAFDimTolObjects_GeomToleranceTypeValue(0)
        found.append((one.GetType().name.rpartition("_")[2], round(one.GetValue(), 6), wide, lettered))
    return sorted(found, key=str)


_NAMES = {
    Characteristic.FLATNESS: "Flatness",
    Characteristic.CYLINDRICITY: "Cylindricity",
    Characteristic.POSITION: "Position",
    Characteristic.RUN_OUT: "CircularRunout",
    Characteristic.TOTAL_RUN_OUT: "TotalRunout",
}


def _wanted_geometric(features: Sequence[ToleratedFeature]) -> list[tuple[object, ...]]:
    wanted = (
        (
            _NAMES[own.characteristic],
            round(own.value / mm, 6),
            own.round,
            tuple((k, letter) for k, letters in enumerate(own.datums, 1) for letter in letters.split("-")),
        )
        for one in features
        for own in one.geometric
    )
    return sorted(wanted, key=str)


PARTS = {
    "tufting": ("crank", "frame", "rocker", "main-shaft"),
    "beat-up": ("rocker", "pin"),
    "cam": ("cam",),
    "shedding": ("cam-shaft", "shedding-cam"),
    "warp-tension": ("upper-driven-end",),
    "weaver": ("cam-shaft", "partition", "handler-pinion", "sley-follower", "cam-roller"),
    "hammer": ("bar",),
}
"""Parts whose files are read again: journals, bores, squares, keyways, faces; with and without datums."""

NARROW = {"cloth.warps": "40"}
"""A comb of few leaves: the kernel reads a bar of 600 slots in 30 s."""


@pytest.mark.parametrize("machine", PARTS)
def test_every_tolerance_of_a_part_is_found_again_in_its_file(machine: str) -> None:
    tree = _tree(machine, NARROW if machine == "hammer" else {})
    tolerances, parts = tolerances_of(tree), {part.id: part for part, _ in tree.occurrences()}
    for name in PARTS[machine]:
        features = tolerances[f"{machine}/{name}"]
        content = part_bytes(parts[f"{machine}/{name}"], features)
        read = _Read(content)
        wanted = _wanted_sizes(features)
        assert _Text(content).sizes() == wanted
        assert _faces(read) == sorted(size[-1] for size in wanted)
        assert _geometric(read) == _wanted_geometric(features)


def part_bytes(part: Part, features: Sequence[ToleratedFeature]) -> bytes:
    """The file of one part in its own axes."""
    document = StepDocument(part.title)
    document.solid(part.id, part_solid(part), features)
    return document.content()


def test_an_assembly_has_the_tolerances_of_all_its_parts() -> None:
    tree = _tree("tufting", {})
    features = [one for own in tolerances_of(tree).values() for one in own]
    content = assembly_bytes(tree, "whole")
    read = _Read(content)
    assert len(_faces(read)) == len(_Text(content).sizes()) == len(features) + sum(1 for one in features if one.depth)
    assert _geometric(read) == _wanted_geometric(features)
    assert len(features) > 10


def test_a_feature_that_is_not_on_the_solid_is_refused() -> None:
    tree = _tree("beat-up", {})
    (part,) = (part for part, _ in tree.occurrences() if part.id == "beat-up/pin")
    (journal,) = tolerances_of(tree)[part.id]
    with pytest.raises(OutputError, match=r"journal-1 of beat-up/pin is not on its solid"):
        part_bytes(part, (replace(journal, nominal=2 * journal.nominal),))


def test_the_files_of_a_workshop_have_the_tolerances_of_their_parts(tmp_path: Path) -> None:
    write_workshop(default_report("beat-up"), tmp_path / "parts")
    features = tolerances_of(_tree("beat-up", {}))["beat-up/rocker"]
    assert _Text((tmp_path / "parts" / "rocker.step").read_bytes()).sizes() == _wanted_sizes(features)
    assert [one.tolerance for one in features] == ["G7", "P7"]
