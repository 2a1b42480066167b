"""The looms of the shipped factory pass every check, those of space among them."""

from pathlib import Path

import pytest

from ilmek.io.looms_file import read_looms
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("loom", read_looms(EXAMPLES / "looms.toml").looms, ids=lambda loom: loom.name)
def test_a_loom_of_the_example_passes_its_checks(loom):
    made = design(AutomatedLoomParams.read(dict(loom.design)))
    assert [check.name for check in MACHINE.report(made, illustrated=False).all_checks if not check.ok] == []
