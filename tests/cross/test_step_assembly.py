"""A machine as a STEP assembly, read back by the kernel: names, colours, placed parts, volumes.

Evidence: the kernel's own reader and its own integral of the volume of each solid.
"""

import io
from collections.abc import Iterator

import numpy as np
import pytest

from ilmek.io.colours import colour_of
from ilmek.machines.catalogue import find_machine
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.shapes import Prism
from ilmek.part.tree import Tree
from ilmek.units import deg, mm

pytest.importorskip("OCP")  # its wheel is not made for every platform

from OCP.BRepGProp import BRepGProp
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
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

from ilmek.io.step_assembly import assembly_bytes


class _Read:
    """The assembly of a file."""

    def __init__(self, content: bytes) -> None:
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("MDTV-XCAF"), self.document)
        reader = STEPCAFControl_Reader()
        reader.ReadStream("assembly", io.BytesIO(content))
        assert reader.Transfer(self.document)
        self.shapes = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
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
