"""Yarn lists from TOML and CSV, and what is said of the bad ones."""

from pathlib import Path

import pytest

from ilmek.errors import YarnError
from ilmek.io.yarn_file import default_yarns, read_yarns

TOML = """
[[yarn]]
name = "red"
srgb = "#93272c"
nm = 2.5
ply = 2
price = 20

[[yarn]]
name = "white"
lab = [90, 1, 12]
nm = 4
"""
CSV = {
    "commas": 'name,srgb,lab,nm,ply,price\nred,#93272c,,2.5,2,20\nwhite,,"90, 1, 12",4,,\n',
    "semicolons": "name;srgb;lab;nm;ply;price\nred;#93272c;;2,5;2;20\nwhite;;90 1 12;4;;\n",
    "tabs": "Name\tsRGB\tlab\tNm\tply\tprice\nred\t93272C\t\t2.5\t2\t20\n\nwhite\t\t[90 1 12]\t4\t\t\n",
    "byte order mark": "\ufeffname,srgb,lab,nm,ply,price\r\nred,#93272c,,2.5,2,20\r\nwhite,,90/1/12,4,,\r\n",
    "old line ends": "name,srgb,lab,nm,ply,price\rred,#93272c,,2.5,2,20\rwhite,,90/1/12,4,,",
    "remarks": "\n# my wool\n #\nname,srgb,lab,nm,ply,price\n\nred,#93272c,,2.5,2,20\n,,,\n\nwhite,,90 1 12,4,,\n\n",
}


def write(folder: Path, name: str, text: str) -> Path:
    file = folder / name
    file.write_bytes(text.encode("utf-8"))
    return file


@pytest.mark.parametrize("form", CSV)
def test_csv_says_the_same_as_toml(tmp_path: Path, form: str) -> None:
    assert read_yarns(write(tmp_path, "a.csv", CSV[form])) == read_yarns(write(tmp_path, "a.toml", TOML))


def test_values_as_written(tmp_path: Path) -> None:
    red, white = read_yarns(write(tmp_path, "a.toml", TOML))
    assert (red.name, red.srgb, red.metric_count, red.ply, red.price) == ("red", (0x93, 0x27, 0x2C), 2.5, 2, 20.0)
    assert (white.lab, white.ply, white.price) == ((90.0, 1.0, 12.0), 1, None)


def test_short_colours_double_each_digit(tmp_path: Path) -> None:
    short = write(tmp_path, "short.csv", "name,srgb,nm\nred,#93c,2\nwhite,#FFF,2\n")
    assert [yarn.hex for yarn in read_yarns(short)] == ["#9933cc", "#ffffff"]


def test_default_list_has_sixteen_wools() -> None:
    yarns = default_yarns()
    assert len(yarns) == 16
    assert len({yarn.name for yarn in yarns}) == 16
    assert all(yarn.metric_count is None for yarn in yarns)  # by the quality


BAD = {
    "empty": ("a.toml", "", "is empty"),
    "blank": ("a.csv", " \n\n", "is empty"),
    "not TOML": ("a.toml", "name = red\n", "TOML, line 1"),
    "stranger": ("a.toml", "[[yarns]]\nname='x'\n", "unknown entry 'yarns'"),
    "a table": ("a.toml", "[yarn]\nname='x'\n", "not a list of tables"),
    "a number": ("a.toml", "yarn = 3\n", "not a list of tables"),
    "no yarn": ("a.toml", "yarn = []\n", "no yarn"),
    "one yarn": ("a.csv", "name,srgb,nm\nred,#800000,2\n", "one yarn only"),
    "header only": ("a.csv", "name,srgb,nm\n", "no yarn"),
    "no header": ("a.csv", "red,#800000,2\nblue,#000080,2\n", "line 1: unknown column 'red'"),
    "near column": ("a.csv", "nane,srgb,nm\nred,#800000,2\n", "did you mean 'name'"),
    "column twice": ("a.csv", "name,nm,nm\nred,2,2\n", "'nm' is given twice"),
    "too many cells": ("a.csv", "name,srgb,nm\nred,#800000,2,5\n", "line 2 has 4 cells"),
    "comment below the headings": ("a.csv", "name,srgb\nred,#800000\n# pale\nblue,#000080\n", "line 3 is a comment"),
    "row without a colour": ("a.csv", "name,srgb\nred,#800000\n#3 indigo\n\nblue,\n", "line 3 is a comment"),
    "row without a name": ("a.csv", "srgb,name\n#800000,red\n\n#000080,\n", "line 4: yarn 2 has no name"),
    "row without a code": (
        "a.csv",
        "# wool\nname,srgb\nred,#800000\n#3 indigo,\n",
        r"line 4: yarn 2 \(#3 indigo\) has no col",
    ),
    "same name": ("a.csv", "name,srgb\n\nred,#800000\nred,#000080\n", "lines 3 and 4: yarns 1 and 2 are both named"),
    "not a number": ("a.csv", "name,srgb,nm\nred,#800000,2\nblue,#000080,two\n", "line 3: nm 'two' is not a number"),
    "open quote": ("a.csv", 'name,srgb,nm\n"red,#800000,2\n', "line"),
    "missing nm": ("a.csv", "name,srgb,nm\nred,#800000,2\nblue,#000080,\n", r"yarn 2 \(blue\) has no nm"),
    "duplicate": ("a.csv", "name,srgb,nm\nred,#800000,2\nRed,#000080,3\n", "both named"),
    "bad colour": ("a.csv", "name,srgb,nm\nred,#80000,2\nblue,#000080,3\n", "yarn 1 .*'#80000' is no colour"),
    "bad lab": ("a.toml", TOML.replace("[90, 1, 12]", "[190, 1, 12]"), "white.*no colour"),
    "both colours": ("a.toml", TOML + "srgb = '#ffffff'\n", "both srgb and lab"),
    "too many": ("a.csv", "name,srgb,nm\n" + "".join(f"y{i},#800000,2\n" for i in range(256)), "256 yarns"),
    "other suffix": ("a.xls", "x", "'.xls'; a yarn list is a .toml, .csv or .gpl file"),
    "zero bytes": ("a.csv", "name,srgb,nm\nre\0d,#800000,2\nx,#800000,2,3", "line"),
    "not text": ("a.csv", "", "UTF-8"),
    "huge": ("a.csv", "x" * 1_000_001, "too large"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_lists_are_refused(tmp_path: Path, name: str) -> None:
    file_name, text, said = BAD[name]
    file = write(tmp_path, file_name, text)
    if name == "not text":
        file.write_bytes(b"name,srgb,nm\nk\xfd\xfdl,#800000,2\n")
    with pytest.raises(YarnError, match=said) as caught:
        read_yarns(file)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_file_and_folder(tmp_path: Path) -> None:
    with pytest.raises(YarnError, match="does not exist"):
        read_yarns(tmp_path / "wool.toml")
    with pytest.raises(YarnError, match="is a folder"):
        read_yarns(tmp_path)
    with pytest.raises(YarnError, match="is not a file"):
        read_yarns(Path("/dev/null"))


def test_a_palette_of_gimp_is_a_yarn_list(tmp_path: Path) -> None:
    """The shipped list written as GIMP writes it comes back with its names and colours, without counts."""
    wool = default_yarns()
    lines = [f"{r:3d} {g:3d} {b:3d}\t{yarn.name}" for yarn in wool for r, g, b in [yarn.srgb]]
    path = tmp_path / "wool.gpl"
    path.write_text("\n".join(["GIMP Palette", "Name: wool", "Columns: 4", "#", *lines, ""]))
    found = read_yarns(path)
    assert [(yarn.name, yarn.srgb, yarn.metric_count, yarn.ply) for yarn in found] == [
        (yarn.name, yarn.srgb, None, 1) for yarn in wool
    ]


def test_names_of_a_palette_are_made_unique(tmp_path: Path) -> None:
    path = tmp_path / "a.gpl"
    path.write_text("GIMP Palette\n255 0 0 red\n250 0 0\tRed\n0 0 9 Untitled\n0 0 9\n 0 0 9 red 2\n", encoding="utf-8")
    assert [yarn.name for yarn in read_yarns(path)] == ["red", "Red 2", "#000009", "#000009 2", "red 2 2"]
