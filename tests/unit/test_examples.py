"""Every example that draws a figure can be imported: it uses the package as it is."""

import importlib
from pathlib import Path

import pytest

EXAMPLES = sorted(Path(__file__).parents[2].joinpath("examples").glob("draw_*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_imports_what_exists(path: Path) -> None:
    assert importlib.import_module(f"examples.{path.stem}").__doc__
