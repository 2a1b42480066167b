"""The recipes in the guide are charted as they stand."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from executed_pages import page_blocks

from ilmek.io.recipe_file import CARPET_KEYS, LAYOUT_KEYS, LOOM_KEYS
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs/how-to/write-a-recipe.md").read_text(encoding="utf-8")
RECIPES = {
    block.file: block.text
    for block in page_blocks(GUIDE)
    if block.language == "toml" and block.file != "whole.toml"  # which shows an error
}


@pytest.mark.parametrize("name", RECIPES)
def test_a_recipe_of_the_guide_is_charted(name: str, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "examples/recipes/tiles", tmp_path / "tiles")
    (tmp_path / "carpet.toml").write_text(RECIPES[name], encoding="utf-8")
    order = read_order(tmp_path / "carpet.toml")
    read_loom_order(order)
    made = chart_of_recipe(order)
    assert made.notes == ()
    assert made.chart.reading.kind == "exact"
    assert (made.chart.reading.edited > 0) == bool(order.recipe and order.recipe.edits)
    if order.recipe is not None and order.recipe.mirror == "both":
        assert np.array_equal(made.chart.knots, made.chart.knots[::-1, ::-1])


def test_the_reference_has_every_key() -> None:
    page = (
        (ROOT / "docs/reference/files.md").read_text(encoding="utf-8").partition("## Recipes")[2].partition("\n## ")[0]
    )
    keys = {key for row in re.findall(r"^\| ([a-z_, ]+) \|", page, re.MULTILINE) for key in row.split(", ")}
    assert {*LAYOUT_KEYS, *CARPET_KEYS, *LOOM_KEYS} <= keys
