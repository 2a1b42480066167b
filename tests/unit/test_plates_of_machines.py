"""Plates of machines: areas as designed; links as long as the design's, bored where there is room."""

import pytest
from default_machines import default_report

from ilmek.elements.materials import MATERIALS
from ilmek.io.plate_shape import plate_shape
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.link_tree import LinkSize, link_part
from ilmek.part.shapes import Prism
from ilmek.plane.contours import area, as_hole, bounds
from ilmek.report import Contour, Report


def answer(machine: str) -> Report:
    kind = MACHINES[machine]
    return kind.report(kind.design(kind.params()))


@pytest.mark.parametrize("machine", ["cam", "weaver"])
def test_the_contours_that_are_cut_enclose_the_area_that_is_designed(machine: str) -> None:
    plates = answer(machine).plates
    assert plates
    for plate in plates:
        shape = plate_shape(plate)
        assert area(shape.outline) == pytest.approx(plate.area, rel=2e-6)
        assert len(shape.outline.points) < 400
        assert 0 <= shape.bored < area(shape.outline)
        assert shape.bored > 0 or not plate.paths


def spans(machine: str) -> dict[str, list[float]]:
    plates = answer(machine).plates
    return {plate.name: [abs(hole.at - plate.holes[0].at) for hole in plate.holes[1:]] for plate in plates}


def test_tufting_plates_have_the_lengths_of_the_paper() -> None:
    lengths = {"coupler": 0.138, "rocker": 0.115, "arm": 0.125, "rod": 0.12}
    found = spans("tufting")
    assert {name: found[name] for name in lengths} == {name: pytest.approx([one]) for name, one in lengths.items()}


def test_the_eccentric_is_bored_as_far_from_its_middle_as_the_crank_is_long() -> None:
    crank = next(plate for plate in answer("tufting").plates if plate.name == "crank")
    assert isinstance(crank.outline, Contour)
    low, high = bounds(crank.outline)
    assert (low + high) / 2 == pytest.approx(0.015)
    (bore,) = crank.holes
    assert (bore.at, bore.radius) == (0.0, pytest.approx(0.01))  # on the main shaft


def test_pins_without_room_are_not_bored() -> None:
    size = LinkSize(0.03, 0.01, 0.01, MATERIALS["structural steel"])
    rod = link_part("stub/rod", "rod", {"A": 0j, "B": 0.1 + 0j, "E": 0.104 + 0j}, size)
    assert isinstance(rod.shape, Prism)
    found = sorted(hole.at.real for hole in (as_hole(cut) for cut in rod.shape.section.holes) if hole is not None)
    assert found == pytest.approx([0.0, 0.1])
    assert set(rod.seats) == {"A", "B", "E"}


@pytest.mark.parametrize("machine", ["beat-up", "tufting"])
def test_plates_are_bored_for_the_pins_that_were_checked(machine: str) -> None:
    report = default_report(machine)
    largest = next(one.value for one in report.results if one.name == "pin_diameter")
    holes = [plate.holes[-1].radius for plate in report.plates if plate.holes and plate.name not in {"crank", "frame"}]
    assert max(holes) == pytest.approx(largest / 2)
