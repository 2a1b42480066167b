"""Every made part's sheet against its solid: sizes over all, bores and where they are, by readers of another make."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("OCP")

from sheet_judge import faults_of, made_parts

from ilmek.elements.materials import find_material
from ilmek.part.part import Part
from ilmek.part.plates import plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, rounded_hull
from ilmek.units import mm
from ilmek.viz.drawings.drawn_part import drawn_plate

DESIGNS: dict[str, tuple[str, dict[str, str]]] = {
    "tufting machine": ("tufting-machine", {}),
    "hand loom": ("hand-loom", {}),
    "loom": ("automated-loom", {}),
    "linkage": ("automated-loom", {"beat": "linkage"}),
    "arms": ("automated-loom", {"knotting": "arms"}),
}


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("name", DESIGNS)
def test_sheets_have_the_sizes_and_bores_of_their_solids(name: str, tmp_path: Path) -> None:
    machine, values = DESIGNS[name]
    checked, faults = 0, {}
    for drawn, part in made_parts(machine, **values):
        checked += 1
        missing = faults_of(drawn, part, tmp_path)
        if missing:
            faults[part.id] = missing
    assert not faults
    assert checked > 25


def test_a_size_or_a_bore_that_is_left_out_is_found(tmp_path: Path) -> None:
    """A link, and the sheets of one a little longer, thicker, or with other bores."""

    def link(length: float, bore: float, thick: float, aside: float = 0.0) -> Part:
        ends, holes = (0j, complex(length, aside)), (circle(0j, bore / 2), circle(complex(length, aside), 4 * mm))
        shape = Prism(Profile(rounded_hull(np.array(ends), 15 * mm), holes), thick)
        return Part("probe/link", "link", "machined link", "", shape, find_material("structural steel"))

    own = link(200 * mm, 10 * mm, 8 * mm)
    (plate,) = plates_of(Tree((RigidBody("body", (Occurrence(own),)),)))
    drawn = drawn_plate(plate, "probe", "link")
    assert not faults_of(drawn, own, tmp_path)
    assert faults_of(drawn, link(201 * mm, 10 * mm, 8 * mm), tmp_path) == ["size 231.000", "x of bores [0.0, 201.0]"]
    assert faults_of(drawn, link(200 * mm, 11 * mm, 8 * mm), tmp_path) == ["bore 11.0"]
    assert faults_of(drawn, link(200 * mm, 10 * mm, 9 * mm), tmp_path) == ["size 9.000"]
    assert len(faults_of(replace(drawn, shape=Prism(Profile(circle(0j, 15 * mm)), 8 * mm)), own, tmp_path)) == 4
