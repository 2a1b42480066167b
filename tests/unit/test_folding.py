"""Bent sheet against closed forms, the CAD kernel's own faces, and what readers of another make find in its files."""

import json
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from ilmek.elements.materials import find_material
from ilmek.jobs.workshop import write_workshop
from ilmek.part.folding import folded_section, folded_sheet, neutral_share
from ilmek.part.part import Part
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, square_tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.report import Report
from ilmek.units import mm

SHAPES = {
    "trough": ((20 + 154j, 154j, 0, 99, 99 + 28j), 2.0, 2.0),
    "Z": ((0, 40, 40 + 30j, 90 + 30j), 3.0, 4.5),
    "obtuse": ((0, 60, 100 + 25j), 1.5, 1.0),
}


def sheet_of(name: str) -> Prism:
    line, thickness, radius = SHAPES[name]
    return Prism(Profile(folded_section(np.array(line) * mm, thickness * mm, radius * mm)), 0.3)


@pytest.mark.parametrize("name", SHAPES)
def test_bends_and_flat_width_follow_from_the_line(name: str) -> None:
    line, thickness, radius = SHAPES[name]
    shape, nodes = sheet_of(name), np.array(line)
    sheet = folded_sheet(shape)
    assert sheet is not None
    turns = np.angle(np.diff(nodes)[1:] / np.diff(nodes)[:-1])
    angles = np.array([bend.angle for bend in sheet.bends])
    assert any(np.allclose(angles, other) for other in (turns, -turns[::-1]))
    assert all(math.isclose(bend.radius, radius * mm) for bend in sheet.bends)
    # set-backs: a face loses the tangent lengths of its bends, and gains their arcs at K t
    outer = np.where(turns > 0, radius + thickness, radius)
    arcs = np.abs(turns) * (radius + neutral_share(radius, thickness) * thickness)
    flat = np.abs(np.diff(nodes)).sum() - 2 * np.sum(outer * np.tan(np.abs(turns) / 2)) + arcs.sum()
    assert sheet.width == pytest.approx(flat * mm, rel=1e-12)
    middle = sheet.width + np.abs(angles).sum() * (0.5 - neutral_share(radius, thickness)) * thickness * mm
    assert shape.volume == pytest.approx(middle * thickness * mm * 0.3, rel=1e-12)


def test_what_is_not_bent_has_no_flat_pattern() -> None:
    assert folded_sheet(box(0.1, 0.02, 0.3)) is None
    assert folded_sheet(square_tube(0.05, 0.003, 0.4)) is None
    assert folded_sheet(None) is None


def test_the_factor_of_the_neutral_line_is_that_of_the_standard() -> None:
    assert [round(2 * neutral_share(r, 1.0), 2) for r in (1.0, 2.0, 3.0, 5.0, 9.0)] == [0.65, 0.80, 0.89, 1.0, 1.0]


def test_its_files_are_the_flat_pattern_and_the_bent_solid(tmp_path: Path) -> None:
    pytest.importorskip("OCP")
    from OCP.BRepAdaptor import BRepAdaptor_Surface  # noqa: PLC0415
    from OCP.GeomAbs import GeomAbs_SurfaceType  # noqa: PLC0415
    from OCP.STEPControl import STEPControl_Reader  # noqa: PLC0415
    from OCP.TopAbs import TopAbs_ShapeEnum  # noqa: PLC0415
    from OCP.TopExp import TopExp_Explorer  # noqa: PLC0415
    from OCP.TopoDS import TopoDS  # noqa: PLC0415

    part = Part("probe/trough", "trough", "laser-cut part", sheet_of("trough"), find_material("structural steel"))
    tree = Tree((RigidBody("body", (Occurrence(part),)),))
    write_workshop(
        Report("probe", "Probe", {}, (), (), plates=plates_of(tree), pieces=pieces_of(tree)), tmp_path / "out"
    )
    flat = ezdxf.readfile(tmp_path / "out" / "trough.dxf").modelspace()
    points = np.array([point for line in flat.query("LWPOLYLINE") for point in line.get_points("xy")])
    width = 20 + 154 + 99 + 28 - 3 * 2 * 4 + 3 * math.pi / 2 * (2 + 0.325 * 2)
    assert np.ptp(points, axis=0).tolist() == pytest.approx([300.0, width], abs=1e-6)
    sheet = ezdxf.readfile(tmp_path / "out" / "trough.sheet.dxf").modelspace()
    measured = {round(own.dxf.actual_measurement, 3) for own in sheet.query("DIMENSION")}
    arc = math.pi / 2 * (2 + 0.325 * 2)
    middles = [16 + arc / 2, 16 + arc + 146 + arc / 2, 16 + arc + 146 + arc + 91 + arc / 2]
    texts = [text.dxf.text for text in sheet.query("TEXT")]
    turned = [width - middle for middle in middles[::-1]]
    assert any({round(m, 3) for m in own} <= measured for own in (middles, turned))
    assert {round(size, 3) for size in (width, 300.0, 99.0, 154.0, 20.0, 28.0, 2.0)} <= measured
    assert texts.count("90°") == 3
    assert any("DIN 6935" in text and "0.325" in text for text in texts)
    reader = STEPControl_Reader()
    reader.ReadFile(str(tmp_path / "out" / "trough.step"))
    reader.TransferRoots()
    explorer, radii = TopExp_Explorer(reader.OneShape(), TopAbs_ShapeEnum.TopAbs_FACE), []
    while explorer.More():
        face = BRepAdaptor_Surface(TopoDS.Face(explorer.Current()))
        if face.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            radii.append(face.Cylinder().Radius())
        explorer.Next()
    assert sorted(radii) == pytest.approx([2.0] * 3 + [4.0] * 3)
    (entry,) = (e for e in json.loads((tmp_path / "out" / "workshop.json").read_text())["files"] if e["kind"] == "step")
    assert entry["volume_error"] < 1e-9
