"""Bad input through the real command line: exit 2, one line that says what to do, nothing written."""

import os
import re
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from ilmek.cli import main


def png(width: int, height: int, raw: bytes) -> bytes:
    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def yarns(*lines: str) -> bytes:
    return "\n".join(("name,srgb,nm", *lines, "")).encode()


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a good picture and all the bad files."""
    folder = tmp_path_factory.mktemp("bad")
    pixels = np.random.default_rng(3).integers(0, 256, (30, 20, 3), dtype=np.uint8)
    Image.fromarray(pixels).save(folder / "good.png")
    whole = (folder / "good.png").read_bytes()
    indexed = Image.fromarray(pixels[..., 0])
    indexed.save(folder / "grey.bmp")
    Image.fromarray(pixels).save(folder / "deep.bmp")
    grey, deep = (folder / "grey.bmp").read_bytes(), (folder / "deep.bmp").read_bytes()
    (folder / "taken").mkdir()
    (folder / "taken/mine.txt").write_text("mine")
    contents = {
        "empty.png": b"",
        "text.png": b"not a picture",
        "cut.bmp": grey[:-90],
        "cut24.bmp": deep[: len(deep) // 2],
        "head.bmp": grey[:30],
        "cut.oxs": b"<?xml version='1.0'?>\n<chart><properties chartwidth='30' chartheight='20'/><palette>",
        "entities.oxs": b"<!DOCTYPE chart [<!ENTITY a 'aaa'>]><chart>&a;</chart>",
        "pattern.oxs": b"<pattern><stitch/></pattern>",
        "cut.png": whole[: len(whole) // 2],
        "pixel.png": png(1, 1, b"\0\0"),
        "line.png": png(400, 1, b"\0" * 401),
        "bomb.png": png(65_000, 65_000, b"\0"),
        "eps.png": b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 50 50\n%%EndComments\n",
        "duplicate.csv": yarns("red,#800000,2", "red,#000080,2"),
        "colour.csv": yarns("red,#80000g,2", "blue,#000080,2"),
        "nonm.csv": yarns("red,#800000,2", "blue,#000080,"),
        "one.csv": yarns("red,#800000,2"),
        "many.csv": yarns(*(f"y{i},#800000,2" for i in range(300))),
        "minus.csv": yarns("red,#800000,-2", "blue,#000080,2"),
        "word.csv": yarns("red,#800000,two", "blue,#000080,2"),
        "noheader.csv": b"red,#800000,2\nblue,#000080,2\n",
        "broken.toml": b"[[yarn]\nname = 'x'\n",
        "field.toml": b"size = '20x30cm'\n",
        "key.toml": b"plain = 'ivory'\ncolurs = 3\n",
        "lost.toml": b"picture = 'photo.png'\n",
        "outside.toml": b"picture = '/etc/passwd'\n",
        "damaged.toml": b"plain = 'ivory'\n[[border]]\ntile = 'cut.png'\n",
        "edit.toml": b"plain = 'ivory'\nsize = '20x30cm'\n[[edits]]\ngrid = '50x75'\nlines = ['set 900,1 rose']\n",
        "border.toml": b"plain = 'ivory'\nsize = '20x30cm'\n[[border]]\nyarn = 'rose'\nwidth = '10cm'\n",
        "number.toml": b"picture = 3\n",
        "good.toml": b"picture = 'good.png'\nsize = '20x30cm'\n",
        "table.toml": b"[yarn]\nname = 'x'\n",
        "nothing.toml": b"\n",
        "latin.csv": b"name,srgb,nm\nk\xfdrm\xfdz\xfd,#800000,2\n",
        "wool.xlsx": b"PK",
        "utf16.csv": "name,srgb,nm\nred,#800000,2\n".encode("utf-16"),
        "columns.csv": b"name,srgb,nm,nm\nred,#800000,2,2\nblue,#000080,2,3\n",
        "nan.csv": yarns("red,#800000,nan", "blue,#000080,2"),
        "escape.csv": yarns("re\x1b[31md,#800000,2", "blue,#000080,2"),
        "lines.csv": yarns('"re\nd",#800000,2', "blue,#000080,2"),
        "quote.csv": yarns('"red,#800000,2', "blue,#000080,2"),
        "cells.csv": yarns("red,#800000,2,5", "blue,#000080,2"),
        "heading.gpl": b"200 0 0 red\n0 0 200 blue\n",
        "range.gpl": b"GIMP Palette\n0 0 200 blue\n300 0 0 red\n",
        "one.gpl": b"GIMP Palette\n#\n0 0 200 blue\n",
        "many.gpl": b"GIMP Palette\n" + b"0 0 200\n" * 300,
        "void.csv": b"\n\n# nothing\n",
        "limit.csv": yarns(*(f"y{i},#800000,2" for i in range(256))),
        "deep.toml": b"yarn = " + b"[" * 5000 + b"]" * 5000,
        "digits.toml": b"[[yarn]]\nname = 'x'\nsrgb = '#800000'\nnm = " + b"9" * 5000,
        "long.toml": b"#" * 1_000_001,
        "programme.ilmek": b"SQLite format 3\0" + b"\0" * 200,
        "notes.ilmek": b"a note",
        "void.ilmek": b"",
    }
    for name, data in contents.items():
        (folder / name).write_bytes(data)
    (folder / "loop.png").symlink_to("loop.png")
    (folder / "lost.png").symlink_to("nowhere.png")
    os.mkfifo(folder / "pipe.png")
    os.mkfifo(folder / "pipe.csv")
    os.mkfifo(folder / "pipe.ilmek")
    return folder


SMALL = "--size 20x30cm --quality 20x20/dm"

PICTURE = {
    "missing picture": ("gone.png", "gone.png does not exist"),
    "misspelt picture": ("godo.png", r"did you mean good\.png"),
    "empty picture": ("empty.png", "is empty"),
    "text as picture": ("text.png", "is not a picture that can be read"),
    "truncated picture": ("cut.png", "damaged or truncated"),
    "one pixel": ("pixel.png", "1 x 1 pixels; at least 8 x 8"),
    "a line of pixels": ("line.png", "400 x 1 pixels"),
    "decompression bomb": ("bomb.png", "at most 150 megapixels"),
    "postscript": ("eps.png", "format EPS"),
    "folder as picture": ("taken", "is a folder"),
    "links in a circle as picture": ("loop.png", "is a broken link"),
    "link to no picture": ("lost.png", "is a broken link"),
    "pipe as picture": ("pipe.png", "is not a file"),
    "device as picture": ("/dev/null", "is not a file"),
    "name too long": ("x" * 400, "cannot be read"),
    "truncated BMP": ("cut.bmp", "damaged or truncated"),
    "truncated BMP of 24 bits": ("cut24.bmp", "damaged or truncated"),
    "BMP without pixels": ("head.bmp", "damaged or truncated|is not a picture"),
    "truncated OXS": ("cut.oxs", r"cut\.oxs, line \d+: no element found"),
    "OXS with entities": ("entities.oxs", "has a document type"),
    "OXS of another program's XML": ("pattern.oxs", "it is no OXS chart: it begins with 'pattern'"),
    "missing OXS": ("gone.oxs", "cannot be read|does not exist"),
}

CARPET = {
    "exact reading of another grid": (
        f"--read exact {SMALL}",
        "the picture has 20 × 30 pixels, and .* has 40 × 60 knots",
    ),
    "unknown reading": ("--read exakt", "did you mean exact"),
    "white that is no colour": ("--white ivory", "white='ivory' is no colour.*#"),
    "black for white": ("--white #000011", "nearly black"),
    "halftone of a drawing": ("--read flat --halftone 50%", "--read photo"),
    "halftone above all": ("--halftone 120%", "at most 100%"),
    "contrast below none": ("--contrast -120%", "at least -100%"),
    "least patch without end": ("--least-patch 5000", "at most 100"),
    "unknown size": ("--size sejade", "unknown size 'sejade'.*did you mean 'seccade'"),
    "size without unit": ("--size 120x180", "has no unit"),
    "one side": ("--size 120cm", "has one side; .*120cmxauto"),
    "a side that may be metres": ("--size 1.2xauto", "has no unit"),
    "a side beside a size": ("--size 120x180cm --width 1m", "width given beside the size"),
    "a side without a unit": ("--width 120", "did you mean 120cm?"),
    "a side too long": ("--length 60m", "at most 5000 cm"),
    "zero size": ("--size 0x180cm", "above zero"),
    "negative size": ("--size -120x180cm", "above zero"),
    "mixed units": ("--size 120cmx2m", "mixes cm and m"),
    "unknown unit of size": ("--size 120x180px", "unknown unit 'px'"),
    "endless size": ("--size 1e9x1e9m", "unknown size|cannot be woven"),
    "too large a carpet": ("--size 40x50m --quality 400x400/dm", "million knots"),
    "runner without size": ("--size yolluk", "yolluk"),
    "quality zero": ("--quality 0x25/dm", "no carpet|at least 1 knot"),
    "quality negative": ("--quality -25x25/dm", "no carpet|at least 1 knot|unknown quality"),
    "quality too fine": ("--quality 9000x9000/dm", "needs a warp every"),
    "quality without unit": ("--quality fine", "unknown quality 'fine'"),
    "quality in a wrong unit": ("--quality 25x25/kg", "unknown quality"),
    "unknown knot": ("--knot symetric", "did you mean symmetric"),
    "negative pile": ("--pile-height -8mm", "pile_height=-8 mm is out of bounds"),
    "pile in metres": ("--pile-height 8", "did you mean 8mm"),
    "pile in kilograms": ("--pile-height 8kg", "wrong unit"),
    "gereh of a yard": ("--quality 40raj/90cm", "a gereh of 90 cm is out of bounds"),
    "count without a number": ("--yarn-count thick", "yarn count 'thick' cannot be used; .* like 5/2"),
    "count of no strand": ("--yarn-count 5/0", "yarn count '5/0' cannot be used"),
    "hank without a unit": ("--hank 100", "hank '100' cannot be used; .* like 100g or 200m"),
    "hank in seconds": ("--hank 100s", "hank '100s' cannot be used"),
    "hank of nothing": ("--hank 0g", "hank '0g' cannot be used"),
    "reserve below nothing": ("--reserve -5%", "reserve=-5% is out of bounds"),
    "lot of nothing": ("--lot 0kg", "lot=0 kg is out of bounds"),
    "calibration of nothing": ("--calibration 0", "calibration=0 is out of bounds"),
    "currency in figures": ("--currency 100", "currency '100' cannot be used"),
    "end beyond the warp": ("--end-length 50cm", "flat-woven end is longer than the warp"),
    "negative price": ("--warp-price -1", "warp_price=-1 is out of bounds"),
    "one colour": ("--colours 1", "colours=1 is out of bounds"),
    "more colours than yarns": ("--colours 40 --yarns wool", "2 to 16"),
    "colours in words": ("--colours many", "'many' is not a quantity"),
    "an unknown yarn to keep": ("--keep ivori", "did you mean 'ivory'"),
    "an unknown yarn to leave out": ("--never purple", "no yarn 'purple'; the list has madder red"),
    "a yarn kept and never used": ("--keep gold --never gold", "both in keep and in never"),
    "more yarns kept than taken": ("--keep gold;rose;ivory --colours 2", "more than colours=2"),
    "more colours than are left": ("--colours 16 --never gold --yarns wool", "2 to 15"),
    "a share without per cent": ("--least-share 0.5", "did you mean 0.5%"),
    "one shade": ("--propose 1", "propose=1 is out of bounds"),
    "unknown fit": ("--fit strech", "did you mean stretch"),
    "crop of one corner": ("--crop 10,10", "1 point; 2 points"),
    "crop in words": ("--crop left", "no list of points"),
    "crop outside the picture": ("--crop 0,0;21,30", "reaches outside the picture"),
    "empty crop": ("--crop 5,5;5,30", "leaves no pixel"),
    "ground in words": ("--ground red", "'red' is no colour"),
    "three corners": ("--corners 1,1;2,2;3,3", "3 points; 4 points"),
    "corners that cross": ("--corners 1,1;19,29;19,1;1,29", "cross"),
    "corners outside the picture": ("--corners 1,1;25,1;25,29;1,29", "reaches outside the picture"),
    "corners on one line": ("--corners 1,1;9,1;18,1;1,29", "lie on one line"),
    "an outline that is not clear": ("--corners auto", "outline of the carpet is not clear"),
    "unknown rows": ("--rows colors", "did you mean colours|colours"),
    "unknown direction of rows": ("--rows-direction up", "right"),
    "wall of too many knots": ("--wall --size 5x5m --quality 50x50/dm", "6,250,000 knots; at most 4,000,000"),
    "turned without a unit": ("--turn 90", "did you mean 90deg"),
}

YARNS = {
    "missing yarn list": ("gone.toml", "does not exist"),
    "duplicate yarns": ("duplicate.csv", "both named 'red'"),
    "bad colour": ("colour.csv", "'#80000g' is no colour"),
    "missing Nm": ("nonm.csv", r"yarn 2 \(blue\) has no nm"),
    "one yarn only": ("one.csv", "one yarn only"),
    "300 yarns": ("many.csv", "300 yarns; 2 to 255"),
    "negative Nm": ("minus.csv", "nm -2.0 cannot be used"),
    "Nm in words": ("word.csv", "line 2: nm 'two' is not a number"),
    "no header": ("noheader.csv", "unknown column 'red'"),
    "broken TOML": ("broken.toml", "TOML, line 1"),
    "table for a list": ("table.toml", "not a list of tables"),
    "empty yarn list": ("nothing.toml", "is empty"),
    "yarn list in another encoding": ("latin.csv", "line 2 is not UTF-8"),
    "spreadsheet": ("wool.xlsx", "'.xlsx'; a yarn list is a .toml, .csv or .gpl file"),
    "no palette": ("heading.gpl", "line 1 is not that of a GIMP palette"),
    "palette with a colour out of range": ("range.gpl", "line 3 '300 0 0 red' is no colour"),
    "palette of one colour": ("one.gpl", "one yarn only"),
    "palette of 300 colours": ("many.gpl", "line 257: the palette has more than 255 colours"),
    "folder as yarn list": ("taken", "is a folder"),
    "pipe as yarn list": ("pipe.csv", "is not a file"),
    "endless yarn list": ("/dev/zero", "is not a file"),
    "yarn list in 16 bits": ("utf16.csv", "line 1 is not UTF-8"),
    "column twice": ("columns.csv", "column 'nm' is given twice"),
    "Nm that is no number": ("nan.csv", "nm nan cannot be used"),
    "escape sequence in a name": ("escape.csv", "line 2 has the control character 0x1b"),
    "line end in a name": ("lines.csv", "letters, digits and signs on one line"),
    "quote without end": ("quote.csv", "line 3: unexpected end"),
    "more cells than columns": ("cells.csv", "line 2 has 4 cells; 3 columns"),
    "nothing but comments": ("void.csv", "no yarn"),
    "256 yarns": ("limit.csv", "256 yarns; 2 to 255"),
    "brackets in brackets": ("deep.toml", "line 1: is nested too deeply; at most 12 levels"),
    "thousands of digits": ("digits.toml", "is too long; at most 1000 characters"),
    "yarn list of a megabyte": ("long.toml", "at most 250 kB"),
}

OTHER = {
    "call of no chart": ("call good.png", "is no knot chart"),
    "call of nothing": ("call gone.png", "gone.png"),
    "call of a direction that is none": ("call good.png --direction both", "right, left, alternate"),
    "unknown command": ("weav good.png", "did you mean 'weave'"),
    "strange command": ("qqq", "commands: weave, chart"),
    "unknown option": ("chart good.png --siez kelle", "No such option.*--size"),
    "option without value": ("chart good.png --size", "requires an argument"),
    "no picture": ("chart", "Missing argument 'PICTURE'"),
    "two pictures": ("chart good.png text.png", "unexpected extra argument"),
    "folder taken": ("chart good.png --out taken", "taken exists.*--force"),
    "foreign folder with force": ("chart good.png --out taken --force", "did not write: mine.txt"),
    "file for a folder": ("chart good.png --out good.png", "is not a folder"),
    "folder below a file": ("chart good.png --out good.png/out", "is not a folder"),
    "folder below a device": ("chart good.png --out /dev/null/out", "is not a folder"),
    "folder in no file system": ("chart good.png --out /proc/ilmek/out", "cannot be (written|made)"),
    "recipe without a field": ("chart field.toml", "field.toml, line 1: the recipe has no field"),
    "recipe with an unknown key": ("weave key.toml", "key.toml, line 2, colurs: unknown key .*'colours'"),
    "recipe of a lost picture": ("weave lost.toml", "lost.toml, line 1, picture: 'photo.png' is not there"),
    "recipe that reaches outside": ("chart outside.toml", "outside.toml, line 1, picture: '/etc/passwd' reaches out"),
    "recipe of a damaged picture": ("chart damaged.toml", "damaged.toml, line 2, border.0: .*cut.png is damaged"),
    "recipe with an edit outside": ("chart edit.toml", "edit.toml, line 5, edits.0.lines.0: knot 900,1 lies outside"),
    "recipe with a border too wide": ("chart border.toml", "border.toml, line 3, border.0: .* make them narrower"),
    "recipe of a number": ("chart number.toml", "number.toml, line 1, picture: 3 is not text in quotes"),
    "recipe that is not there": ("chart nothere.toml", "recipe file nothere.toml does not exist"),
    "recipe that replaces its picture": ("chart good.toml --out new --save-recipe good.png", "would replace the input"),
    "saved recipe and JSON in one": ("chart good.toml --save-recipe x.toml --json x.toml", "are the same"),
    "folder of links in a circle": ("chart good.png --out loop.png", "links are circular|is not a folder"),
    "JSON to links in a circle": ("chart good.png --out new --json loop.png", "links are circular|cannot be written"),
    "the folder one is in": ("chart good.png --out . --force", "is the folder you are in"),
    "the root with force": ("chart good.png --out / --force", "is the folder you are in"),
    "name of an output too long": (f"chart good.png --out {'x' * 300}", "File name too long"),
    "JSON on a full device": ("design beat-up --json /dev/full", "No space left"),
    "page on a full device": ("design beat-up --report /dev/full", "No space left"),
    "pipe as programme": ("inspect pipe.ilmek", "Is a pipe"),
    "folder as programme": ("inspect taken", "Is a directory"),
    "row in words": ("inspect notes.ilmek --row first", "not a valid integer"),
    "unknown machine": ("design beat-pu", "did you mean beat-up"),
    "unknown machine to list": ("machines hamer", "machines: automated-loom, weaver, beat-up"),
    "unknown parameter": ("design beat-up --set swimg=30deg", "did you mean swing"),
    "setting without value": ("design beat-up --set swing", "write NAME=VALUE"),
    "setting without name": ("design beat-up --set =3", "write NAME=VALUE"),
    "set twice": ("design beat-up --set swing=30deg --set swing=40deg", "set twice"),
    "degrees taken for radians": ("design beat-up --set swing=30", "did you mean 30deg"),
    "out of bounds": ("design beat-up --set swing=-30deg", "swing=-30 deg is out of bounds; allowed: above 0 deg"),
    "wrong unit": ("design beat-up --set swing=30mm", "wrong unit"),
    "unknown unit": ("design beat-up --set swing=30degs", "unknown unit"),
    "no number": ("design beat-up --set swing=wide", "is not a quantity"),
    "not finite": ("design beat-up --set swing=1e999deg", "too large"),
    "no such law": ("design shedding --set law=harmonik", "did you mean harmonic"),
    "negative lift": ("design shedding --set lift=-60mm", "out of bounds"),
    "half a warp": ("design warp-tension --set cloth.warps=600.5", "not a whole number"),
    "shaft without wall": ("design warp-tension --set inner_radius=80mm --set outer_radius=50mm", "radius"),
    "mechanism that cannot close": (
        "design beat-up --set crank=59.7mm --set coupler=100mm --set rocker=100mm --set beater=300mm",
        "cannot close for crank .* mm",
    ),
    "needle out of reach": ("design tufting --set x2=400mm", "cannot close"),
    "rocker out of reach": ("design tufting --set l3=400mm", "cannot close"),
    "a length and its symbol": ("design tufting --set l1=15mm --set crank=15mm", "set twice, as l1 and as crank"),
    "massless negative": ("design tufting --set crank_mass=-1kg", "out of bounds"),
    "no ground closes": ("design knotting-four-bar --set r0=200mm", "no ground closes the stated pose"),
    "past the dead point": ("design knotting-four-bar --set crank_angle=140deg", "cannot close"),
    "no side": ("design knotting-four-bar --set branch=0", "branch=0 is no side"),
    "force in millimetres": ("design knotting-four-bar --set grip_force=15mm", "wrong unit"),
    "steps of a head out of order": ("design weaver --set open_end=90deg", "no room"),
    "next to nothing": ("design shedding --set dwell=1e-320", "is too small"),
    "JSON into a folder": ("design beat-up --json taken", "taken is a folder"),
    "JSON into no folder": ("chart good.png --out new --json gone/a.json", "there is no folder"),
    "page good, JSON not": ("design beat-up --report new.html --json gone/a.json", "there is no folder"),
    "JSON of a weave into a folder": ("weave good.png --out new --json taken", "taken is a folder"),
    "report into no folder": ("design beat-up --report gone/beat-up.html", "cannot be written"),
    "missing programme": ("inspect gone.ilmek", "cannot be read"),
    "no programme": ("inspect notes.ilmek", "is no loom programme"),
    "empty programme": ("inspect void.ilmek", "is no loom programme"),
    "other database": ("inspect programme.ilmek", "is no loom programme"),
    "check of nothing": ("check gone.ilmek", "cannot be read"),
    "check of no text": ("check gone.txt", "gone.txt cannot be read: No such file"),
    "check of a pipe": ("check pipe.ilmek", "Is a pipe"),
    "check of a folder": ("check taken", "Is a directory"),
    "check of no programme": ("check notes.ilmek", "is no loom programme"),
    "check for no loom": ("check notes.ilmek --loom gone.json", "loom file gone.json does not exist"),
    "conversion to another form": ("convert notes.ilmek notes.csv", r"ends in '.csv'; .ilmek or .txt"),
    "conversion of no programme": ("convert notes.ilmek notes.txt", "is no loom programme"),
    "conversion onto itself": ("convert notes.ilmek notes.ilmek", "would replace the input"),
}

SETTLED = "--loom knotting=cams --loom weft=rapier --loom beat=comb --loom knot_cycle=1.8s"
"""Leaves nothing open but the heads: a choice among all looms is `tests/reference/test_carpet_cost.py`'s."""

WEAVE = {
    "deadline without unit": ("--deadline 72", "did you mean 72h"),
    "deadline of nothing": ("--deadline 0h", "deadline"),
    "negative deadline": ("--deadline -5h", "deadline"),
    "deadline in metres": ("--deadline 5m", "wrong unit"),
    "deadline too soon": (f"--deadline 1min {SETTLED}", "deadline of .* cannot be met"),
    "no heads": ("--heads 0", "heads"),
    "more heads than fit": ("--heads 5000", "heads"),
    "heads and deadline": (
        f"--heads 2 --deadline 1min {SETTLED}",
        "the wishes contradict each other: 2 heads.*; the deadline of .*; at most",
    ),
    "quality beyond the pitch": ("--quality 40x40/dm --warp-pitch 2mm", r"1\.25 ?mm"),
    "pitch of nothing": ("--warp-pitch 0mm", "pitch"),
}

CASES = {
    **{name: (f"chart {file} {SMALL} --out new", said) for name, (file, said) in PICTURE.items()},
    **{f"weave {name}": (f"weave {file} {SMALL} --out new", said) for name, (file, said) in PICTURE.items()},
    **{name: (f"chart good.png {options} --out new", said) for name, (options, said) in CARPET.items()},
    **{name: (f"weave good.png {SMALL} --yarns {file} --out new", said) for name, (file, said) in YARNS.items()},
    **{name: (f"weave good.png {SMALL} {options} --out new", said) for name, (options, said) in WEAVE.items()},
    **OTHER,
}


@pytest.mark.parametrize("name", CASES)
def test_bad_input_is_one_line(place: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    command, said = CASES[name]
    monkeypatch.chdir(place)
    before = sorted(place.rglob("*"))
    result = CliRunner().invoke(main, command.split())
    assert isinstance(result.exception, SystemExit), result.exception
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("ilmek: ")
    assert result.stderr.count("\n") == 1
    assert result.stderr.endswith("\n")
    assert re.search(said, result.stderr), result.stderr
    assert sorted(place.rglob("*")) == before


def test_there_are_enough_of_them() -> None:
    assert len(CASES) >= 60
