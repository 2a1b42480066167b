"""The recipes of examples/recipes: their charts, and the tiles that they are made of."""

from pathlib import Path

import numpy as np
import pytest
from examples.recipes.draw_tiles import TILES, main
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.jobs.charting import OrderedChart
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe, saved_recipe

FOLDER = Path(__file__).parents[2] / "examples/recipes"
FACTS = {
    "kazak": ((470, 288), 10, "both"),
    "prayer-rug": ((398, 258), 13, "across"),
    "tabriz": ((500, 350), 13, "both"),
    "tekke": ((476, 332), 6, ""),
}
"""Rows and columns, colours, and the directions in which the carpet is its own mirror image."""


@pytest.fixture(scope="module")
def charts() -> dict[str, OrderedChart]:
    return {name: chart_of_recipe(read_order(FOLDER / f"{name}.toml")) for name in FACTS}


def colours(chart: Chart) -> np.ndarray:
    return np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)[chart.knots]


def test_every_recipe_is_here_and_short() -> None:
    assert {path.stem for path in FOLDER.glob("*.toml")} == set(FACTS)
    assert all(len(path.read_text(encoding="utf-8").splitlines()) < 40 for path in FOLDER.glob("*.toml"))


@pytest.mark.parametrize("name", FACTS)
def test_the_chart_has_its_knots_colours_and_symmetry(charts: dict[str, OrderedChart], name: str) -> None:
    chart = charts[name].chart
    grid, count, mirror = FACTS[name]
    assert chart.knots.shape == grid
    assert chart.colours == count
    assert (chart.reading.kind, chart.reading.changed, chart.reading.foreign) == ("exact", 0, 0)
    assert chart.reading.mean_delta_e < 1e-9
    assert charts[name].notes == ()
    assert mirror not in ("across", "both") or (chart.knots == chart.knots[:, ::-1]).all()
    assert mirror not in ("along", "both") or (chart.knots == chart.knots[::-1]).all()


@pytest.mark.parametrize(("name", "edge", "breadth"), [("tekke", 10, 24), ("tabriz", 13, 34), ("kazak", 13, 24)])
def test_the_main_border_turns_its_corners(charts: dict[str, OrderedChart], name: str, edge: int, breadth: int) -> None:
    corner = charts[name].chart.knots[edge : edge + breadth, edge : edge + breadth]
    assert (corner == corner.T).all()
    assert len(np.unique(corner)) > 2


def test_the_border_of_whole_repeats_is_its_tile(charts: dict[str, OrderedChart]) -> None:
    tile = np.asarray(Image.open(FOLDER / "tiles/tekke-border.png").convert("RGB"))
    drawn = colours(charts["tekke"].chart)[10:34]
    for first in range(34, 34 + 5 * 48, 48):
        assert (drawn[:, first : first + 48] == tile).all()


@pytest.mark.parametrize("name", FACTS)
def test_a_saved_recipe_gives_the_same_chart(charts: dict[str, OrderedChart], name: str, tmp_path: Path) -> None:
    made = charts[name]
    text = saved_recipe(made.order, made.chart, FOLDER)
    (tmp_path / "again").mkdir()
    for path in (FOLDER / "tiles").glob("*.png"):
        (tmp_path / "again/tiles").mkdir(exist_ok=True)
        (tmp_path / "again/tiles" / path.name).write_bytes(path.read_bytes())
    (tmp_path / "again/carpet.toml").write_text(text, encoding="utf-8")
    again = chart_of_recipe(read_order(tmp_path / "again/carpet.toml")).chart
    assert (again.knots == made.chart.knots).all()
    assert again.yarns == made.chart.yarns
    assert (again.size.width, again.quality, again.knot) == (
        made.chart.size.width,
        made.chart.quality,
        made.chart.knot,
    )


def test_the_tiles_are_those_of_the_script(tmp_path: Path) -> None:
    main(tmp_path)
    for name in TILES:
        drawn, shipped = (Image.open(folder / f"{name}.png").convert("RGB") for folder in (tmp_path, FOLDER / "tiles"))
        assert np.array_equal(np.asarray(drawn), np.asarray(shipped)), name
