"""Indices of an indexed drawing are the positions of the creel: in the chart, in the JSON, and in chart.bmp."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from ilmek.cli import main
from ilmek.errors import CarpetError
from ilmek.io.chart.formats import FORMATS, read_chart
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import chart_results, make_charted
from ilmek.jobs.order import read_order

CASE = Path(__file__).parents[1] / "data" / "two-indices.bmp"


def drawn(path: Path, indices: np.ndarray, palette: np.ndarray, scale: int = 1) -> None:
    """An indexed picture; its resolution is that of knots, 250 a metre, where they are not enlarged."""
    picture = Image.fromarray(np.kron(indices, np.ones((scale, scale), dtype=np.uint8)), "P")
    picture.putpalette(palette.astype(np.uint8).ravel().tolist())
    picture.save(path, dpi=(6.35, 6.35) if scale == 1 else (72, 72))


def indices_of(path: Path) -> np.ndarray:
    with Image.open(path) as picture:
        assert picture.mode == "P"
        return np.array(picture)


def test_two_indices_of_one_red() -> None:
    made = make_charted(read_order(CASE))
    chart, results = made.chart, chart_results(made)
    assert np.array_equal(np.array(chart.positions)[chart.knots], indices_of(CASE))
    assert results["yarn_index"] == [0, 1, 2, 3]
    assert [need["name"] for need in results["yarn"]] == ["madder red", "ivory", "madder red (creel 2)", "indigo navy"]
    assert [need["knots"] for need in results["yarn"]] == np.bincount(indices_of(CASE).ravel()).tolist()
    assert chart.yarns[0].number == chart.yarns[2].number
    assert not any("near twins" in warning for warning in made.warnings)


def test_the_command_writes_the_same_indices(tmp_path: Path) -> None:
    arguments = [
        "chart",
        str(CASE),
        "--bmp",
        "--no-pdf",
        "--rows",
        "none",
        "--out",
        str(tmp_path / "out"),
        "--json",
        "-",
    ]
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["yarn_index"] == [0, 1, 2, 3]
    assert np.array_equal(indices_of(tmp_path / "out/chart.bmp"), indices_of(CASE))


@pytest.mark.parametrize(("name", "scale"), [("drawing.bmp", 1), ("drawing.png", 1), ("drawing.gif", 3)])
def test_indices_that_are_not_in_order(name: str, scale: int, tmp_path: Path) -> None:
    """Positions 9, 3 and 200 of one blue and two reds, in BMP, PNG, and a GIF enlarged three times."""
    rng = np.random.default_rng(5)
    indices = np.array([9, 3, 200], dtype=np.uint8)[rng.integers(0, 3, (40, 30))]
    palette = np.zeros((256, 3))
    palette[[9, 3, 200]] = (28, 40, 92), (150, 30, 40), (150, 30, 40)
    drawn(tmp_path / name, indices, palette, scale)
    indices = indices_of(tmp_path / name)[::scale, ::scale]  # a GIF has other ones than those given
    size, quality = ("12x16cm", "25x25/dm") if scale > 1 else (None, None)
    made = make_charted(read_order(tmp_path / name, size=size, quality=quality))
    assert chart_results(made)["yarn_index"] == np.unique(indices).tolist()
    for row in (FORMATS["bmp"], FORMATS["png"], FORMATS["oxs"]):
        row.save(tmp_path / row.file, made.chart)
    assert np.array_equal(indices_of(tmp_path / "chart.bmp"), indices)
    for file in ("chart.png", "chart.oxs"):
        again = read_chart(tmp_path / file)[0]
        assert again.positions == made.chart.positions
        FORMATS["bmp"].save(tmp_path / "again.bmp", again)
        assert np.array_equal(indices_of(tmp_path / "again.bmp"), indices)


@given(st.lists(st.integers(0, 255), min_size=2, max_size=12, unique=True), st.integers(0, 2**32 - 1))
@settings(max_examples=8, deadline=None)
def test_any_indices_of_the_shelf_come_back(
    tmp_path_factory: pytest.TempPathFactory, used: list[int], seed: int
) -> None:
    folder, rng, shelf = tmp_path_factory.mktemp("creel"), np.random.default_rng(seed), default_yarns()
    picks = rng.integers(0, len(shelf), len(used))
    palette = np.zeros((256, 3))
    palette[used] = [shelf[pick].srgb for pick in picks]
    indices = np.array(used, dtype=np.uint8)[rng.integers(0, len(used), (20, 24))]
    drawn(folder / "a.bmp", indices, palette)
    if len(set(picks[np.searchsorted(np.sort(used), np.unique(indices))].tolist())) < 2:
        return
    chart = make_charted(read_order(folder / "a.bmp")).chart
    FORMATS["bmp"].save(folder / "chart.bmp", chart)
    assert np.array_equal(indices_of(folder / "chart.bmp"), indices)
    by_index = {chart.positions[yarn]: chart.yarns[yarn] for yarn in chart.used}
    assert {index: yarn.srgb for index, yarn in by_index.items()} == {
        index: shelf[picks[used.index(index)]].srgb for index in np.unique(indices).tolist()
    }


def test_a_creel_has_a_place_for_each_yarn() -> None:
    chart = make_charted(read_order(CASE)).chart
    for creel in ((0,), (0,) * len(chart.yarns), (*range(1, len(chart.yarns)), 256)):
        with pytest.raises(CarpetError, match="creel"):
            replace(chart, creel=creel)


@pytest.mark.parametrize(
    ("settings", "recipe", "said"),
    [
        ({"size": "12x16cm", "read": "flat"}, "", "the picture is read as flat, not knot by knot"),
        ({"size": "12x16cm", "quality": "20x20/dm"}, "", "the picture is read as flat, not knot by knot"),
        ({"crop": "0,0 20,30", "size": "8x12cm"}, "", "it is turned, cropped or stretched"),
        ({"turn": "90deg"}, "", "it is turned, cropped or stretched"),
        ({}, 'picture = "drawing.png"\nedits = ["set 1,1 ivory"]\n', "edits name the yarns of the list"),
        ({}, "", ""),
    ],
)
def test_indices_that_cannot_be_kept_are_told_in_the_reading(
    tmp_path: Path, settings: dict[str, str], recipe: str, said: str
) -> None:
    rng = np.random.default_rng(5)
    indices = np.array([9, 3, 200], dtype=np.uint8)[np.kron(rng.integers(0, 3, (8, 6)), np.ones((5, 5), dtype=int))]
    palette = np.zeros((256, 3))
    palette[[9, 3, 200]] = (28, 40, 92), (150, 30, 40), (150, 30, 40)
    drawn(tmp_path / "drawing.png", indices, palette)
    (tmp_path / "carpet.toml").write_text(recipe)
    made = make_charted(read_order(tmp_path / ("carpet.toml" if recipe else "drawing.png"), **settings))
    assert (made.chart.creel is None) == bool(said)
    told = made.chart.reading.reason.partition("its indices are not kept as positions of the creel: ")[2]
    assert told.removesuffix(" (picture of carpet.toml)") == said


@pytest.mark.parametrize("count", [64, 65])
def test_a_photo_with_a_palette_has_no_creel(tmp_path: Path, count: int) -> None:
    """Of pictures with more indices than a creel nothing is told: their palettes were made by a program."""
    indices = (np.arange(100 * 100).reshape(100, 100) * 7 // 3 % count).astype(np.uint8)
    palette = np.random.default_rng(1).integers(0, 256, (256, 3))
    drawn(tmp_path / "photo.png", indices, palette, 2)
    reason = make_charted(read_order(tmp_path / "photo.png", size="20x20cm", read="photo")).chart.reading.reason
    assert ("positions of the creel" in reason) == (count == 64)
