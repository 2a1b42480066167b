"""Texts of others: whatever they hold, only errors of ilmek come out, soon, and nothing reaches a spreadsheet."""

import csv
import io
import os
import random
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from ilmek.carpet.quality import parse_quality
from ilmek.carpet.sizes import parse_size
from ilmek.elements.tubes import find_tube
from ilmek.errors import CarpetError, IlmekError, ParameterError, UnitError
from ilmek.io.csv_cells import csv_rows, read_cell, write_cell
from ilmek.io.cyclogram_file import parse_cyclogram
from ilmek.io.data_text import parse_data
from ilmek.io.path_file import MOST_POINTS, read_path
from ilmek.io.table_csv import csv_text
from ilmek.io.text_file import read_text
from ilmek.jobs.knot import KnotRequest, judged
from ilmek.machines.function_four_bar.params import FunctionFourBarParams, named
from ilmek.params.text_lists import read_angles, read_bounds, read_pairs, read_points, read_poses
from ilmek.units import LONGEST, parse_quantity, parse_unit, read_number

PATIENCE = 20.0
"""Far above the time on any processor [s]: what this guards against takes minutes."""


WORDS = (
    *(
        "mm",
        "km",
        "deg",
        "/dm",
        "^",
        "^400",
        "^-9",
        "*",
        "/",
        "²",
        "٣",
        "1e400",
        "-0",
        "inf",
        "nan",
        "1e-320",
        "9" * 90,
    ),
    *(
        " ",
        "\t",
        "\n",
        "\x00",
        "\x1b[31m",
        "\ud800",
        "\u202e",
        "(",
        ")",
        ",",
        "..",
        ";",
        "x",
        "+",
        "-",
        ".",
        "e",
        "1",
        "7",
        "%",
    ),
    *("0x1F", "1_000", "_", "é", "1" + " " * 40, "kg/m^3", "×", "=", "@", "cm", "raj", "/m2"),
)
"""Pieces of texts."""

READERS = {
    "unit": parse_unit,
    "quantity": lambda text: parse_quantity(text, "mm"),
    "size": parse_size,
    "quality": parse_quality,
    "tube": find_tube,
    "function": named,
    "points": lambda text: read_points("points", text),
    "poses": lambda text: read_poses("poses", text),
    "pairs": lambda text: read_pairs("pairs", text),
    "angles": lambda text: read_angles("angles", text),
    "bounds": lambda text: read_bounds("bounds", text),
}


@pytest.mark.parametrize("name", READERS)
def test_random_texts_give_errors_of_ilmek_only(name: str) -> None:
    read, seeded = READERS[name], random.Random(11)
    for _ in range(1500):
        text = "".join(seeded.choices(WORDS, k=seeded.randint(0, 9)))
        with suppress(IlmekError):
            read(text)


@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("piece", ["1", " ", "x ", "(", "(1,", "mm*", "1 ", "²", "^"])
def test_long_texts_are_refused_soon(name: str, piece: str) -> None:
    begin = time.process_time()
    with pytest.raises(IlmekError):
        READERS[name](f"x^{piece * 20_000}!")
    assert time.process_time() - begin < PATIENCE


@pytest.mark.parametrize("text", ["km^400", "km^13", "GPa^12*GPa^12", "mm^-12*mm^-12", "m" * 200, "m²²²"])
def test_units_out_of_bounds_are_refused(text: str) -> None:
    with pytest.raises(UnitError):
        parse_unit(text)


@pytest.mark.parametrize("text", ["1km^400", "1e400mm", "٣mm", "²", "inf", "nan", "", " ", "1_0mm", "1" * 500])
def test_quantities_out_of_bounds_are_refused(text: str) -> None:
    with pytest.raises(UnitError):
        parse_quantity(text, "m")


def test_minus_zero_is_zero() -> None:
    assert str(parse_quantity("-0mm", "m")) == "0.0"


def test_numbers_are_plain_decimal_numbers() -> None:
    assert read_number(" -1.5e3 ") == -1500.0
    assert [read_number(text) for text in ("1_0", "٣", "inf", "nan", "1e31", "1mm", "", "1" * (LONGEST + 1))] == [
        None
    ] * 8


def test_a_text_parameter_is_bounded_and_printable() -> None:
    for text, said in (
        ("x" * 20_001, "is too long"),
        ("a\x1b[0m", "cannot be printed"),
        ("\ud800", "cannot be printed"),
    ):
        with pytest.raises(ParameterError, match=said):
            FunctionFourBarParams.read({"samples": text})
    with pytest.raises(ParameterError, match="is not a text"):
        FunctionFourBarParams.read({"samples": 5.0})


def test_a_file_that_grows_after_the_check_is_not_read_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "grows.txt"
    path.write_bytes(b"a" * 100)

    fstat = os.fstat

    def growing(number: int) -> os.stat_result:
        status = fstat(number)
        path.write_bytes(b"a" * 5000)
        return status

    monkeypatch.setattr(os, "fstat", growing)
    with pytest.raises(CarpetError, match="too large"):
        read_text(path, noun="text", largest=1000, error=CarpetError, do="")


@pytest.mark.parametrize("control", ["\x00", "\x07", "\x1b", "\x7f"])
def test_control_characters_of_a_file_are_refused(tmp_path: Path, control: str) -> None:
    path = tmp_path / "control.txt"
    path.write_text(f"one\ntwo {control}", encoding="utf-8")
    with pytest.raises(CarpetError, match="line 2 has the control character"):
        read_text(path, noun="text", largest=1000, error=CarpetError, do="")


@pytest.mark.parametrize(
    "heading", ["x [mm],(" + " " * 20_000, "x [mm]," + "(" * 20_000 + "]", "x [mm],y" + "[ " * 9_000 + "]"]
)
def test_headings_of_a_path_are_read_in_linear_time(tmp_path: Path, heading: str) -> None:
    path = tmp_path / "path.csv"
    path.write_text(f"{heading}\n1,2\n3,4\n")
    begin = time.process_time()
    with pytest.raises(CarpetError):
        read_path(path)
    assert time.process_time() - begin < PATIENCE


@pytest.mark.parametrize("cell", ["1_0", "٣", "inf", "1e400", "9" * 100_000, "1 " * 9_000])
def test_cells_of_a_path_are_plain_numbers(tmp_path: Path, cell: str) -> None:
    path = tmp_path / "path.csv"
    path.write_text(f"x [mm],y [mm]\n1,2\n3,{cell}\n")
    with pytest.raises(CarpetError, match="line 3") as caught:
        read_path(path)
    assert len(str(caught.value)) < 400


def test_a_path_has_at_most_so_many_points_and_columns(tmp_path: Path) -> None:
    path = tmp_path / "path.csv"
    path.write_text("x [mm],y [mm]\n" + "1,2\n" * (MOST_POINTS + 1))
    with pytest.raises(CarpetError, match=f"more than {MOST_POINTS} points"):
        read_path(path)
    path.write_text("x [mm]" + "," * 20_000 + "\n1,2\n")
    with pytest.raises(CarpetError, match="20001 cells"):
        read_path(path)
    path.write_text("x" * 600_000 + "\n1,2\n")
    with pytest.raises(CarpetError, match="line 1 is too long"):
        read_path(path)


FORMULAS = (
    '=HYPERLINK("http://x","y")',
    "+1+1",
    "-2+3",
    "@SUM(A1)",
    "\t=1",
    " =1",
    "'=1",
    "＝1",
    "a;=1",
)


@pytest.mark.parametrize("text", FORMULAS)
def test_no_cell_is_run_by_a_spreadsheet(text: str) -> None:
    for delimiter in ",;":
        for cells in csv.reader(io.StringIO(csv_rows([["name", text, 1.5]])), delimiter=delimiter):
            assert not any(cell.strip().startswith(("=", "+", "-", "@", "＝")) for cell in cells)


@pytest.mark.parametrize("text", [*FORMULAS[:-1], "''", "'", "'a'", "x", "-1.5", "1e5", ""])
def test_a_cell_is_read_as_it_was_written(text: str) -> None:
    assert read_cell(write_cell(text)) == text


def test_a_column_of_a_formula_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "motion.csv"
    path.write_text(
        csv_text({"=A.P x [m]": np.array([1.0, 2.0]), "-P y [m]": np.array([-3.0, 4e-7])}), encoding="utf-8"
    )
    assert read_path(path, ("=A.P x", "-P y")).tolist() == [1 - 3j, 2 + 4e-7j]


DATA = {
    "dotted keys": ("a" + ".a" * 3000 + " = 1", "nested too deeply"),
    "quoted dotted keys": ("'a'" + ". 'a'" * 3000 + " = 1", "nested too deeply"),
    "heading": ("[a" + ".a" * 3000 + "]", "nested too deeply"),
    "lists": ("a = " + "[" * 50_000, "nested too deeply"),
    "tables": ("a = " + "{a = " * 20_000, "nested too deeply"),
    "digits": ("a = " + "9" * 5000, "too long"),
    "hexadecimal": ("a = 0x" + "f" * 5000, "too long"),
    "text": ('a = "' + "x" * 1001 + '"', "too long"),
    "name": ("x" * 101 + " = 1", "the name 'xxx"),
    "escape": ('a = "\\u001b[31m"', "line 1, a: .* cannot be printed"),
    "escaped name": ('\n"\\u202e" = 1', "line 2: the name"),
    "nan": ("a = nan", "not a finite number"),
    "infinity": ("a = [1, -inf]", "not a finite number"),
    "no such date": ("a = 2026-99-99", "line 1|not TOML"),
    "open quote": ("a = '''" + "x" * 5000, "expected"),
    "many quotes": ("a = '" + "'''\\" * 20_000, "line|expected"),
}
JSON = {
    "lists": ("[" * 100_000, "nested too deeply"),
    "tables": ('{"a":' * 40_000, "nested too deeply"),
    "digits": ('{"a": ' + "9" * 5000 + "}", "too long"),
    "surrogate": ('{"a": "\\ud800"}', "cannot be printed"),
    "surrogate name": ('{"\\ud800": 1}', "the name"),
    "null": ('{"a": "\\u0000"}', "cannot be printed"),
    "nan": ('{"a": NaN}', "not a finite number"),
    "infinity": ('{"a": -Infinity}', "not a finite number"),
    "overflow": ('{"a": 1e999}', "not a finite number"),
    "twice": ('{"a": 1, "a": 2}', "given twice"),
    "open quote": ('{"a": "' + "x" * 5000, "line 1"),
}
CASES = [*((text, True, said) for text, said in DATA.values()), *((text, False, said) for text, said in JSON.values())]


@pytest.mark.parametrize(("text", "toml", "said"), CASES)
def test_data_of_others_is_bounded(text: str, toml: bool, said: str) -> None:
    begin = time.process_time()
    with pytest.raises(ParameterError, match=said) as caught:
        parse_data(text, name="a file", toml=toml, error=ParameterError)
    assert time.process_time() - begin < PATIENCE
    assert len(str(caught.value)) < 300
    assert str(caught.value).isascii()


@pytest.mark.parametrize("toml", [True, False])
def test_random_data_give_errors_of_ilmek_only(toml: bool) -> None:
    pieces = (
        *(
            "[",
            "]",
            "{",
            "}",
            "=",
            ":",
            ",",
            ".",
            "\n",
            "#",
            '"',
            "'",
            '"""',
            "'''",
            "\\",
            "a",
            "b",
            "1",
            "-",
            "1979-05-27",
        ),
        *(
            "true",
            "null",
            "1.5e3",
            '"a"',
            "'b'",
            "[[a]]\n",
            "[a.b]\n",
            "a = 1\n",
            '"k": ',
            "{}",
            "[]",
            " ",
            "\\u0041",
            "é",
        ),
    )
    seeded = random.Random(5)
    for _ in range(8000):
        text = "".join(seeded.choices(pieces, k=seeded.randint(1, 14)))
        with suppress(IlmekError):
            parse_data(text, name="a file", toml=toml, error=ParameterError)


def test_blanks_of_a_printed_page_are_read() -> None:
    assert parse_data('a = "60\u00a0mm"', name="", toml=True, error=ParameterError).data == {"a": "60\u00a0mm"}


def cyclogram(tracks: int, motions: int, relations: int, exclusions: int) -> str:
    lines = ['period = "1s"']
    for track in range(tracks):
        lines.append(f"[tracks.t{track}.motions]")
        for number in range(motions):
            start, ends = 6.28 / motions * number, (0, 0.1) if number % 2 == 0 else (0.1, 0)
            lines.append(
                f"m{number} = {{ start = {start}, end = {start + 4 / motions}, from = {ends[0]}, to = {ends[1]}, "
                'law = "harmonic" }'
            )
    moments = 'then = { track = "t0", starts = "m0" }\nfirst = { track = "t0", ends = "m0" }\ngap = -6'
    zones = 'first = { track = "t0", above = 0.099 }\nsecond = { track = "t1", below = 0.001 }\ngap = 0'
    lines += [f"[[relations]]\n{moments}"] * relations + [f"[[exclusions]]\n{zones}"] * exclusions
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("counts", "said"),
    [
        ((51, 2, 0, 0), "51 tracks; at most 50"),
        ((2, 60, 0, 0), "120 motions; at most 100"),
        ((2, 2, 201, 0), "201 relations; at most 200"),
        ((2, 50, 0, 4), "400 motions through zones of exclusions; at most 300"),
    ],
)
def test_a_cyclogram_is_bounded(counts: tuple[int, int, int, int], said: str) -> None:
    begin = time.process_time()
    with pytest.raises(ParameterError, match=said):
        parse_cyclogram(cyclogram(*counts))
    assert time.process_time() - begin < PATIENCE


def test_a_law_is_bounded() -> None:
    text = cyclogram(1, 2, 0, 0).replace('"harmonic"', '{ name = "harmonic", points = [' + "1, " * 200 + "] }")
    with pytest.raises(ParameterError, match="has 201 numbers; at most 100"):
        parse_cyclogram(text)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"pitch": 1e-20}, "a pitch of 1e-06 m"),
        ({"first": 1e20 + 0j}, "from the origin"),
        ({"keep_out": -1e-3}, "0 mm or more"),
    ],
)
def test_a_row_of_warps_is_bounded(settings: dict, said: str) -> None:
    with pytest.raises(CarpetError, match=said):
        KnotRequest(**{"count": 12, "pitch": 0.002, "first": 0j, "keep_out": 0.0, **settings})


def test_a_path_passes_at_most_so_many_warps() -> None:
    request = KnotRequest(10_000, 0.002, 0j, 0.0)
    with pytest.raises(CarpetError, match="passes 1e\\+07 warps; at most 1000000"):
        judged([np.tile([-1.0 + 1j, 21.0 + 1j, 21.0 - 1j, -1.0 - 1j], 500)], request)
    with pytest.raises(CarpetError, match="check the unit"):
        judged([np.array([1e20 + 1j, 0j])], request)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('period = "1s"', "period = 5e-324", "line 1, period: 4.94066e-324 s is too short"),
        ("start = 0.0, end = 2.0", "start = 0.0, end = 5e-324", "is too short; 1e-09 rad"),
        ("[tracks.t0.motions]", "[tracks.t0]\nlimits = { speed = 5e-324 }\n[tracks.t0.motions]", "is too small"),
    ],
)
def test_tiny_numbers_of_a_cyclogram_are_refused(old: str, new: str, said: str) -> None:
    text = cyclogram(1, 2, 0, 0)
    assert old in text
    with pytest.raises(ParameterError, match=said):
        parse_cyclogram(text.replace(old, new))
