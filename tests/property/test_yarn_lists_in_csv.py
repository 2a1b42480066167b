"""Yarn lists in CSV: every row below the headings is a yarn, whatever it begins with, in any order of the columns."""

import csv
import io
import random
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.errors import CarpetError, YarnError
from ilmek.io.path_file import read_path
from ilmek.io.yarn_file import read_yarns

NAMES = st.lists(
    st.tuples(
        st.sampled_from(["", "#", "#12 ", "# ", '"', "a;", "b,", "\t", "-", "="]), st.text("ab,;#\"' é", max_size=6)
    ).map(lambda parts: f"{parts[0]}wool{parts[1]}".strip()),
    min_size=2,
    max_size=12,
    unique_by=str.casefold,
)
CODES = st.tuples(*[st.integers(0, 255)] * 3)


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("lists") / "list.csv"


def written(file: Path, text: str) -> Path:
    file.write_bytes(text.encode())
    return file


@given(NAMES, st.randoms(use_true_random=False), st.sampled_from(",;\t"), st.data())
def test_every_row_is_a_yarn(
    file: Path, names: list[str], chance: random.Random, delimiter: str, data: st.DataObject
) -> None:
    names = [name for name in names if name.isprintable()] or ["red", "#blue"]
    names += ["#one more"] * (len(names) < 2)
    colours = [data.draw(CODES) for _ in names]
    columns = chance.sample(["name", "srgb", "nm", "price"], 4)
    text = io.StringIO()
    text.write(chance.choice(["", "\ufeff"]) + chance.choice(["", "# wool, of; 2026\n", "\n \n#\n"]))
    quoting = chance.choice([csv.QUOTE_MINIMAL, csv.QUOTE_ALL])
    lines = csv.writer(text, delimiter=delimiter, quoting=quoting, lineterminator=chance.choice(["\n", "\r\n"]))
    lines.writerow(columns)
    for name, code in zip(names, colours, strict=True):
        cells = {"name": name, "srgb": "#{:02x}{:02x}{:02x}".format(*code), "nm": "2.5", "price": ""}
        lines.writerow([cells[column] for column in columns])
        text.write(chance.choice(["", "\n", f"{3 * delimiter}\n"]))
    yarns = read_yarns(written(file, text.getvalue()))
    assert [(yarn.name, yarn.srgb) for yarn in yarns] == list(zip(names, colours, strict=True))


@given(st.integers(1, 20), st.randoms(use_true_random=False))
def test_a_row_that_is_no_yarn_is_an_error_with_its_line(file: Path, rows: int, chance: random.Random) -> None:
    lines = [f"#yarn {row},#{row:02x}8040" for row in range(rows + 1)]
    wrong = chance.randrange(rows + 1)
    lines[wrong] = chance.choice(["#808080", f"{lines[wrong]},more", "wool,", ",#808080", "wool,red", '"wool'])
    with pytest.raises(YarnError, match=rf"line {wrong + 2}\b" if lines[wrong] != '"wool' else r"line \d+"):
        read_yarns(written(file, "\n".join(["name,srgb", *lines])))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("x [mm],y [mm]\n1,2\n#3,4\n5,6\n", "line 3: '#3' is not a number"),
        ("x [mm],y [mm]\n1,2\n# the hook\n5,6\n", "line 3 is a comment"),
        ("x [mm],y [mm]\n1,5,2,5\n3,0,4,0\n", "line 2 has 4 cells"),  # decimal commas between commas
        ("x [mm];y [mm]\n1;2\n3\n", "line 3: '' is not a number"),
    ],
)
def test_rows_of_a_path_are_read_or_an_error(file: Path, text: str, reason: str) -> None:
    with pytest.raises(CarpetError, match=reason):
        read_path(written(file, text))


def test_the_comment_of_a_path_stands_above_its_headings(file: Path) -> None:
    points = read_path(written(file, "# from the loom\n\nx [mm]\ty [mm]\n1,5\t2\n\n3\t4,25\n"))
    assert points.tolist() == pytest.approx([0.0015 + 0.002j, 0.003 + 0.00425j])
