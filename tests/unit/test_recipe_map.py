"""The table [map] of a recipe: colours of the picture and their yarns, as by --map, at every size and when saved."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.cli import main
from ilmek.errors import IlmekError
from ilmek.io.chart.formats import read_chart
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe, saved_recipe

GREEN, RED, WHITE = (108, 145, 54), (200, 30, 40), (250, 250, 250)
COLOURS = np.array([GREEN, RED, WHITE], dtype=np.uint8)
HEAD = 'picture = "drawing.png"\nsize = "{}"\nquality = "20x20/dm"\nyarns = "wool"\n'
PAIRS = {"#6c9136": "near-black", "#c81e28": "ivory", "#fafafa": "dark green"}
"""No yarn is the nearest one to its colour, nor second nearest."""


def drawing(folder: Path) -> np.ndarray:
    """A drawing of 6 × 9 squares, one of three colours each; returns the numbers of the colours."""
    numbers = np.random.default_rng(8).integers(0, 3, (9, 6))
    Image.fromarray(np.kron(COLOURS[numbers], np.ones((40, 40, 1), dtype=np.uint8))).save(folder / "drawing.png")
    return numbers


def table(pairs: dict[str, str]) -> str:
    return "[map]\n" + "".join(f'"{colour}" = "{yarn}"\n' for colour, yarn in pairs.items())


def names(folder: Path, text: str) -> np.ndarray:
    (folder / "carpet.toml").write_text(text)
    chart = make_charted(read_order(folder / "carpet.toml")).chart
    return np.array([yarn.name for yarn in chart.yarns])[chart.knots]


@pytest.mark.parametrize("size", ["60x90cm", "30x45cm", "120x180cm"])
def test_every_knot_of_a_colour_has_its_yarn(tmp_path: Path, size: str) -> None:
    """The judge is the drawing: each square, knot by knot."""
    numbers = drawing(tmp_path)
    made = names(tmp_path, HEAD.format(size) + table(PAIRS))
    square = made.shape[0] // 9
    expected = np.kron(numbers, np.ones((square, square), dtype=int))
    assert np.array_equal(made, np.array(list(PAIRS.values()))[expected])


def test_the_table_is_the_option(tmp_path: Path) -> None:
    drawing(tmp_path)
    given = [word for colour, yarn in PAIRS.items() for word in ("--map", f"{colour}={yarn}")]
    options = ["--size", "60x90cm", "--quality", "20x20/dm", "--yarns", "wool", "--no-pdf", "--rows", "none"]
    picture, out = str(tmp_path / "drawing.png"), str(tmp_path / "out")
    done = CliRunner().invoke(main, ["chart", picture, *options, *given, "--out", out])
    assert done.exit_code in (0, 3), done.output
    chart = read_chart(tmp_path / "out" / "chart.png")[0]
    of_option = np.array([yarn.name for yarn in chart.yarns])[chart.knots]
    assert np.array_equal(names(tmp_path, HEAD.format("60x90cm") + table(PAIRS)), of_option)


def test_what_is_fixed_stays_and_the_rest_is_assigned(tmp_path: Path) -> None:
    numbers = drawing(tmp_path)
    made = names(tmp_path, HEAD.format("60x90cm") + table({"#6c9136": "ivory"}))
    tied = [set(made[::20, ::20][numbers == number].tolist()) for number in range(3)]
    assert tied[0] == {"ivory"}
    assert all(len(yarns) == 1 for yarns in tied)
    assert tied[1] != tied[2]


def test_a_saved_recipe_has_the_table(tmp_path: Path) -> None:
    drawing(tmp_path)
    (tmp_path / "carpet.toml").write_text(HEAD.format("60x90cm") + table(PAIRS))
    made = chart_of_recipe(read_order(tmp_path / "carpet.toml"))
    (tmp_path / "saved.toml").write_text(saved_recipe(made.order, made.chart, tmp_path))
    again = chart_of_recipe(read_order(tmp_path / "saved.toml"))
    assert np.array_equal(again.chart.knots, made.chart.knots)
    assert again.order.order.palette.mapped == made.order.order.palette.mapped


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ('"green" = "ivory"', r"line 6, map.green: map='green' is no colour"),
        ('"#6c9136" = "ivry"', r"map #6c9136: the list has no yarn 'ivry'; did you mean 'ivory'"),
        ('"#6c9136" = 3', r"line 6, map.#6c9136: 3 is no name of a yarn"),
        ('"#6c9136" = ""', r"line 6, map.*is no pair"),
        ('"#6c9136" = "ivory"\n"#6C9136" = "rose"', r"line 5, map: map gives #6c9136 two yarns"),
        ("", r"line 5, map: .*has no pair"),
    ],
)
def test_a_wrong_row_is_one_clear_error(tmp_path: Path, rows: str, said: str) -> None:
    drawing(tmp_path)
    with pytest.raises(IlmekError, match=said) as error:
        names(tmp_path, HEAD.format("60x90cm") + f"[map]\n{rows}\n")
    assert "\n" not in str(error.value)
