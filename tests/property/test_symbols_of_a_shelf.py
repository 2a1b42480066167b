"""A yarn of one list has one symbol and one number on every chart, in every file of it."""

import itertools
import re
from pathlib import Path

import numpy as np
import pypdf
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from ilmek.carpet.chart import Chart, used_first
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.errors import YarnError
from ilmek.io.chart.formats import FORMATS, read_chart
from ilmek.io.chart.rows_text import header
from ilmek.io.chart.symbols import SYMBOLS, symbols
from ilmek.io.yarn_file import default_yarns, read_yarns
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import CarpetOrder


def yarn(number: int | None) -> Yarn:
    return Yarn(f"yarn {number}", (0, 0, 0), (0.0, 0.0, 0.0), number=number)


@given(st.lists(st.integers(1, MOST_YARNS) | st.none(), min_size=1, max_size=MOST_YARNS))
@settings(max_examples=100, deadline=None)
def test_every_yarn_has_a_symbol_of_its_own(numbers: list[int | None]) -> None:
    signs = symbols([yarn(number) for number in numbers])
    assert len(set(signs)) == len(numbers)
    for place, number in enumerate(numbers):
        if number is not None and numbers.index(number) == place:
            assert signs[place] == SYMBOLS[number - 1]


def test_order_and_choice_of_the_yarns_do_not_matter() -> None:
    shelf = default_yarns()
    expected = dict(zip([one.name for one in shelf], symbols(shelf), strict=True))
    for chosen in itertools.islice(itertools.permutations(shelf, 5), 0, 20_000, 997):
        assert symbols(chosen) == "".join(expected[one.name] for one in chosen)


def test_charts_of_one_shelf(tmp_path: Path) -> None:
    """Two pictures with other colours of the shelf; the symbols are those of the list in all files."""
    shelf, rng = default_yarns(), np.random.default_rng(7)
    expected = dict(zip([one.name for one in shelf], symbols(shelf), strict=True))
    picks = rng.permutation(len(shelf))[:6]
    for number, yarns in enumerate((picks[:4], picks[2:])):
        colours = np.array([shelf[index].srgb for index in yarns], dtype=np.uint8)
        picture = tmp_path / f"{number}.png"
        Image.fromarray(colours[rng.integers(0, 4, (40, 40))]).save(picture)
        made = make_charted(CarpetOrder(picture, yarns=shelf)).chart
        found = re.findall(r"^yarn (\S) \S+ [1-9]\d* (.+)$", header(made, "runs", "both"), re.MULTILINE)
        assert {name: sign for sign, name in found} == {
            made.yarns[index].name: expected[made.yarns[index].name] for index in made.used
        }
        for row in (FORMATS["png"], FORMATS["oxs"]):
            row.save(tmp_path / row.file, made)
            again = read_chart(tmp_path / row.file)[0]
            assert symbols(again.yarns) == symbols(made.yarns)
        FORMATS["pdf"].save(tmp_path / "chart.pdf", made)
        legend = pypdf.PdfReader(tmp_path / "chart.pdf").pages[1].extract_text().split("\n")
        for index in made.used:
            at = legend.index(
                made.yarns[index].name
            )  # after its symbol on the swatch, its symbol alone, share and knots
            assert legend[at - 4 : at - 2] == 2 * [expected[made.yarns[index].name]]


def test_used_first_keeps_the_symbols() -> None:
    shelf = default_yarns()[:5]
    chart = Chart([[4, 4], [2, 4]], shelf, "4x4cm", "5x5/dm", "symmetric")
    moved = used_first(chart)
    assert [one.number for one in moved.yarns] == [3, 5, 1, 2, 4]
    assert symbols(moved.yarns) == "CEABD"


def test_a_list_gives_numbers(tmp_path: Path) -> None:
    path = tmp_path / "shelf.csv"
    path.write_text("name,srgb,number\nmadder,#93272c,31\nivory,#ebdcc3,7\n", encoding="utf-8")
    assert [one.number for one in read_yarns(path)] == [31, 7]
    path.write_text("number,name,srgb\n2,madder,#93272c\n,ivory,#ebdcc3\n", encoding="utf-8")
    with pytest.raises(YarnError, match="number 2"):
        read_yarns(path)
    for wrong in ("0", "256", "1.5", "x"):
        path.write_text(f"number,name,srgb\n{wrong},madder,#93272c\n2,ivory,#ebdcc3\n", encoding="utf-8")
        with pytest.raises(YarnError):
            read_yarns(path)
