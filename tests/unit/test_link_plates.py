"""The plates of linkages: as long as the design's links, and none where there is no room for two pins."""

import pytest

from ilmek.machines import MACHINES
from ilmek.machines.plates import link_plates


def spans(machine: str) -> dict[str, list[float]]:
    kind = MACHINES[machine]
    report = kind.report(kind.design(kind.params()))
    return {plate.name: [abs(hole.at - plate.holes[0].at) for hole in plate.holes[1:]] for plate in report.plates}


def test_beat_up_plates_have_the_lengths_of_the_paper_within_its_rounding() -> None:
    made = spans("beat-up")
    assert made["rocker"] == pytest.approx([0.2308, 0.3001], rel=5e-3)
    assert set(made) == {"crank", "coupler", "rocker"}


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
