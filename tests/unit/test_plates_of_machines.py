"""Plates of machines: areas as designed; links as long as the design's, none where there is no room for two pins."""

import pytest
from default_machines import default_report

from ilmek.elements.plates import link_plates
from ilmek.io.plate_shape import plate_shape
from ilmek.machines.catalogue import MACHINES
from ilmek.plane.contours import area
from ilmek.report import Report


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
    lengths = {"crank": 0.015, "coupler": 0.138, "rocker": 0.115, "arm": 0.125, "rod": 0.12}
    assert spans("tufting") == {name: pytest.approx([length]) for name, length in lengths.items()}


def test_pins_without_room_are_left_out() -> None:
    made = link_plates(
        {"stub": (("A", 0j), ("B", 0.004 + 0j)), "rod": (("A", 0j), ("B", 0.1 + 0j), ("E", 0.104 + 0j))},
        width=0.03,
        thickness=0.01,
        material="steel",
    )
    assert [(plate.name, [hole.label for hole in plate.holes]) for plate in made] == [("rod", ["A", "B"])]


@pytest.mark.parametrize("machine", ["beat-up", "tufting"])
def test_plates_are_bored_for_the_pins_that_were_checked(machine: str) -> None:
    report = default_report(machine)
    largest = next(one.value for one in report.results if one.name == "pin_diameter")
    holes = [hole.radius for plate in report.plates if plate.name != "crank" for hole in plate.holes]
    assert max(holes) == pytest.approx(largest / 2)
