"""Every made part's sheet against its solid: sizes over all, bores and where they are, by readers of another make."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pypdfium2 as pdfium
import pytest
from default_machines import SETTLED
from effort import share_of
from sheet_judge import ReadSheet, drawn_sheet, faults_of, made_parts, read
from tests.unit.test_drawing_sheets import points_of

from ilmek.elements.materials import find_material
from ilmek.io.drawings.pdf import write_sheets_pdf
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.plates import plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, rounded_hull
from ilmek.report.sheet import DrawingSheet
from ilmek.units import mm
from ilmek.viz.drawings.drawn_part import drawn_plate

DESIGNS: dict[str, tuple[str, dict[str, str]]] = {
    "tufting machine": ("tufting-machine", {}),
    "hand loom": ("hand-loom", {}),
    "loom": ("automated-loom", {}),
    "linkage": ("automated-loom", {"beat": "linkage"}),
    "arms": ("automated-loom", {**SETTLED, "knotting": "arms"}),
}

STEEL = find_material("structural steel")


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("name", DESIGNS)
def test_sheets_have_the_sizes_and_bores_of_their_solids(name: str, tmp_path: Path) -> None:
    """Sizes over all, bores, and a toolmaker's points, of which one may be missing."""
    machine, values = DESIGNS[name]
    parts = list(made_parts(machine, **values))
    assert len(parts) > 25
    sheets, read_sheets, faults = list[DrawingSheet](), list[ReadSheet](), {}
    for drawn, part in share_of(parts, 3, name):
        sheets.append(drawn_sheet(drawn))
        read_sheets.append(read(sheets[-1], tmp_path / f"{len(sheets)}.dxf"))
        missing = faults_of(drawn, part, read_sheets[-1])
        if missing:
            faults[part.id] = missing
    write_sheets_pdf(tmp_path / "book.pdf", tuple(sheets), name)
    book = pdfium.PdfDocument(tmp_path / "book.pdf")
    for number, (sheet, found) in enumerate(zip(sheets, read_sheets, strict=True)):
        points = points_of(found.document, book[number].get_textpage().get_text_range().replace("\r", ""))
        missing = [point for point, there in points.items() if not there]
        if len(missing) > 1:
            faults[sheet.number] = missing
    assert not faults


def test_a_size_or_a_bore_that_is_left_out_is_found(tmp_path: Path) -> None:
    """A link, and the sheets of one a little longer, thicker, or with other bores."""

    def link(length: float, bore: float, thick: float, aside: float = 0.0) -> Part:
        ends, holes = (0j, complex(length, aside)), (circle(0j, bore / 2), circle(complex(length, aside), 4 * mm))
        shape = Prism(Profile(rounded_hull(np.array(ends), 15 * mm), holes), thick)
        return Part("probe/link", "link", "machined link", shape, find_material("structural steel"))

    own = link(200 * mm, 10 * mm, 8 * mm)
    (plate,) = plates_of(Tree((RigidBody("body", (Occurrence(own),)),)))
    drawn = drawn_plate(plate, "probe", "link")
    sheet = read(drawn_sheet(drawn), tmp_path / "link.dxf")
    assert not faults_of(drawn, own, sheet)
    assert faults_of(drawn, link(201 * mm, 10 * mm, 8 * mm), sheet) == ["size 231.000", "x of bores [0.0, 201.0]"]
    assert faults_of(drawn, link(200 * mm, 11 * mm, 8 * mm), sheet) == ["bore 11.0"]
    assert faults_of(drawn, link(200 * mm, 10 * mm, 9 * mm), sheet) == ["size 9.000"]
    disc = drawn_sheet(replace(drawn, shape=Prism(Profile(circle(0j, 15 * mm)), 8 * mm)))
    assert len(faults_of(drawn, own, read(disc, tmp_path / "disc.dxf"))) >= 4


@pytest.mark.parametrize(("shift", "stated"), [(0.0, True), (0.05 * mm, False)])
def test_a_part_in_an_even_row_states_its_pitch_and_tolerance(shift: float, stated: bool) -> None:
    """Twelve leaves at 4 mm, and with one beside its place."""
    leaf = Part("probe/leaf", "leaf", "laser-cut part", box(60 * mm, 20 * mm, 1 * mm), STEEL)
    places = tuple(placement(z=4 * mm * k + shift * (k == 5)) for k in range(12))
    tree = Tree((RigidBody("comb", (Occurrence(leaf, places),)),))
    (plate,) = plates_of(tree)
    words = [str(note) for note in drawn_plate(plate, "probe", "leaf").notes]
    assert ("Row of 12: pitch 4, each ±0.2 from the first" in words) is stated
