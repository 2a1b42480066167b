"""The looms of the shipped factory pass every check, those of space among them."""

from pathlib import Path

import pytest

from ilmek.io.looms_file import read_looms
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.automated_loom.assembly import holds_in_space

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("loom", read_looms(EXAMPLES / "looms.toml").looms, ids=lambda loom: loom.name)
def test_a_loom_of_the_example_passes_its_checks(loom):
    made = design(AutomatedLoomParams.read(dict(loom.design)))
    assert [check.name for check in MACHINE.report(made, illustrated=False).all_checks if not check.ok] == []


@pytest.mark.parametrize("knots", [12, 35])
def test_arms_have_room_at_a_coarse_and_at_a_fine_quality(knots: int) -> None:
    """Their elbows pass the opener's plates, their solenoids the handler's shaft; by meshes, not by the sizes alone."""
    quality = {"knots_across": f"{knots}/dm", "knots_along": f"{knots}/dm"}
    settings = {
        "width": "0.4 m",
        "knot": "asymmetric",
        "knotting": "arms",
        "weft": "rapier",
        "beat": "linkage",
        **quality,
    }
    assert holds_in_space(design(AutomatedLoomParams.read(settings)))
