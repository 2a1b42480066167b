"""A row of grooves on a sheet: the first from the end, the pitch, and how far each may be beside its position."""

import re
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from ilmek.elements.materials import find_material
from ilmek.jobs.workshop import write_workshop
from ilmek.part.part import Part
from ilmek.part.plates import pieces_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Turned
from ilmek.part.tolerances import groove_tolerance
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.report import Report


@pytest.mark.parametrize(("number", "pitch", "begin"), [(20, 5e-3, 12e-3), (40, 3e-3, 30e-3)])
def test_the_row_of_grooves_is_that_of_the_shape(tmp_path: Path, number: int, pitch: float, begin: float) -> None:
    wide, deep, outer = 1e-3, 2e-3, 20e-3
    starts = begin + pitch * np.arange(number)[::-1]
    edges = [(wide, outer), (wide, outer - deep), (0.0, outer - deep), (0.0, outer)]
    points = [complex(start + along, radius) for start in starts.tolist() for along, radius in edges]
    length = begin + pitch * number + 25e-3
    outline = polygon(np.array([0j, length + 0j, complex(length, outer), *points, complex(0, outer)]))
    part = Part("probe/roller", "roller", "turned part", Turned(Profile(outline)), find_material("structural steel"))
    tree = Tree((RigidBody("body", (Occurrence(part),)),))
    write_workshop(Report("probe", "Probe", {}, (), (), pieces=pieces_of(tree)), tmp_path / "out")
    sheet = ezdxf.readfile(tmp_path / "out" / "roller.sheet.dxf")
    words = " ".join(dimension.dxf.text for dimension in sheet.modelspace().query("DIMENSION"))
    read = re.search(
        r"(\d+)× ⌀\d+.*?([\d.]+) wide, pitch ([\d.]+), first at ([\d.]+) from the left, each ±([\d.]+)", words
    )
    assert read is not None, words
    assert int(read[1]) == number
    sizes = [float(value) / 1e3 for value in read.groups()[1:]]
    assert sizes == pytest.approx([wide, pitch, begin + wide / 2, groove_tolerance(pitch)])
    assert 0 < groove_tolerance(pitch) < pitch - wide  # grooves never meet
