"""Detail views, read by ezdxf: what is too small on its paper stands again in a circle, larger, with its size."""

from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing
from ezdxf.path import make_path

from ilmek.elements.materials import find_material
from ilmek.jobs.workshop import write_workshop
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, box, stepped
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, polygon
from ilmek.report import Report
from ilmek.units import mm

pytest.importorskip("OCP")


def written(shape: Shape, folder: Path, process: str) -> Drawing:
    """The sheet of a part of that shape, read back."""
    part = Part("probe/thing", "thing", process, shape, find_material("structural steel"))
    tree = Tree((RigidBody("body", (Occurrence(part),)),))
    report = Report("probe", "Probe", {}, (), (), plates=plates_of(tree), pieces=pieces_of(tree))
    write_workshop(report, folder)
    return ezdxf.readfile(folder / "thing.sheet.dxf")


def words(sheet: Drawing) -> list[str]:
    return [text.dxf.text for text in sheet.modelspace().query("TEXT")]


def scale_of(title: str) -> float:
    """Length on the paper over the true one."""
    paper, true = title.partition("(")[2].rstrip(")").split(":")
    return float(paper) / float(true)


def rings(sheet: Drawing, layer: str) -> list[tuple[complex, float]]:
    """Middle and diameter of what is as wide as high on a layer [mm]."""
    found = []
    for line in sheet.modelspace().query(f"LWPOLYLINE[layer=='{layer}']"):
        points = np.array([complex(at.x, at.y) for at in make_path(line).flattening(0.005)])
        wide, high = np.ptp(points.real), np.ptp(points.imag)
        if len(points) > 12 and abs(wide - high) < 0.05:
            found.append((complex(points.mean()), float(wide)))
    return found


def test_small_holes_of_a_plate_have_a_detail(tmp_path: Path) -> None:
    corners = np.array([0, 1000, 1000 + 600j, 600j]) * mm
    holes = tuple(circle(at * mm, 1.5 * mm) for at in (200 + 200j, 230 + 200j))
    sheet = written(Prism(Profile(polygon(corners), holes), 10 * mm), tmp_path / "out", "machined link")
    (title,) = (text for text in words(sheet) if text.startswith("Z ("))
    assert words(sheet).count("Z") == 1
    circles = sorted(diameter for _, diameter in rings(sheet, "DIMENSION"))
    assert len(circles) == 2
    assert circles[1] / circles[0] > 2
    holes_drawn = [diameter for _, diameter in rings(sheet, "VISIBLE")]
    assert sorted(holes_drawn)[-2:] == pytest.approx([3.0 * scale_of(title)] * 2, abs=0.05)
    assert 3.0 * scale_of(title) >= 5 or circles[1] <= 90
    labels = [e.dxf.text for e in sheet.modelspace().query("DIMENSION") if "⌀" in e.dxf.text]
    assert labels == ["2× ⌀3"]


def test_a_narrow_groove_of_a_long_shaft_has_a_detail_with_its_width_and_depth(tmp_path: Path) -> None:
    shaft = stepped((0.02, 0.3), (0.019, 0.0011), (0.02, 0.02))
    sheet = written(shaft, tmp_path / "out", "turned part")
    (title,) = (text for text in words(sheet) if text.startswith("Z ("))
    lengths = [e.dxf.actual_measurement for e in sheet.modelspace().query("DIMENSION") if e.dimtype == 0]
    assert any(abs(length - 1.1) < 1e-9 for length in lengths)
    assert any(abs(length - 0.5) < 1e-9 for length in lengths)
    assert 0.5 * scale_of(title) >= 5


def test_what_is_large_enough_has_none(tmp_path: Path) -> None:
    sheet = written(stepped((0.02, 0.03), (0.03, 0.05)), tmp_path / "out", "turned part")
    assert not any(text.startswith("Z") for text in words(sheet))


def test_an_item_of_several_has_its_outline_with_every_corner(tmp_path: Path) -> None:
    """A fork with a lug: the numbers beside the outline are the coordinates of its corners, read by ezdxf."""
    corners = np.array([0, 60, 60 + 12j, 20 + 12j, 14.5 + 20j, 14.5 + 41j, 60 + 41j, 60 + 50j, 2 + 52.5j, 49j]) * mm
    fork = Placed(Prism(Profile(polygon(corners)), 5 * mm))
    lug = Placed(box(8 * mm, 8 * mm, 8 * mm), (placement(4 * mm, 4 * mm, 5 * mm),))
    sheet = written(Sum((fork, lug)), tmp_path / "out", "machined link")
    (title,) = (text for text in words(sheet) if text.startswith("Outline of item"))
    assert title.startswith("Outline of item 1 (")
    stated = {e.dxf.text for e in sheet.modelspace().query("DIMENSION")} | {*words(sheet)}
    for value in {*corners.real.tolist(), *corners.imag.tolist()} - {0.0}:
        assert f"{value / mm:.3f}".rstrip("0").rstrip(".") in stated
