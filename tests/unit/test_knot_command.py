"""`ilmek knot`: files of places in, the knot that they tie out; bad files are one line."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from ilmek.cli import main
from ilmek.io.path_file import read_path
from ilmek.units import mm
from ilmek.weaving.knots.path import KnotDimensions, knot_path
from ilmek.weaving.knots.word import SINGLE, knot

EXAMPLE = Path(__file__).parents[2] / "examples" / "gripper_path.csv"
KNOTS = (
    knot("symmetric", 2),
    knot("asymmetric", 3, opens="left"),
    knot("asymmetric", 2, opens="right"),
    knot("symmetric", 2, each=2),
    knot("asymmetric", 1, opens="left", each=2),
    knot(SINGLE, 4),
)


def ilmek(*words: object) -> Result:
    return CliRunner().invoke(main, ["knot", *(str(word) for word in words)])


def told(*words: object) -> dict:
    result = ilmek(*words, "--json", "-")
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)["results"]


def written(path: Path, places: np.ndarray, heading: str = "x [mm],y [mm]", unit: float = mm) -> Path:
    lines = [f"{place.real / unit!r},{place.imag / unit!r}" for place in places.tolist()]
    path.write_text("\n".join([heading, *lines]), encoding="utf-8")
    return path


@pytest.mark.parametrize("wanted", KNOTS, ids=lambda one: one.name)
def test_the_curve_of_every_knot_is_told_as_that_knot(wanted, tmp_path) -> None:
    curve = knot_path(wanted, KnotDimensions(4 * mm, 1.2 * mm, 0.8 * mm))
    places = curve.point(curve.distances(0.05 * mm))
    file = written(tmp_path / "knot.csv", places, "x [m],y [m]", 1.0)
    found = told(file, "--pitch", "4mm", "--keep-out", "0.9mm", "--smooth")
    assert (found["knot"], found["opens"] or "", found["warps"]) == (wanted.kind, wanted.opens, list(wanted.warps))
    assert tuple(found["word"]) == wanted.word
    assert found["length"] == pytest.approx(curve.length, rel=1e-3)
    back = told(written(tmp_path / "back.csv", places[::-1]), "--pitch", "4mm")
    assert (back["knot"], back["warps"]) == (found["knot"], found["warps"])
    assert back["word"] == [-letter for letter in found["word"][::-1]]


def test_two_ends_led_from_one_place_are_one_yarn(tmp_path) -> None:
    left = np.array([6 + 4j, 2 + 2j, 2 - 2j, 5.6 - 2j, 5.6 + 6j]) * mm
    files = [written(tmp_path / "l.csv", left), written(tmp_path / "r.csv", 12 * mm - np.conj(left))]
    assert told(*files, "--pitch", "4mm")["verdict"] == "symmetric knot over warps 2 and 3"
    assert told(files[0], "--pitch", "4mm")["knot"] is None


def test_the_row_stands_where_it_is_put() -> None:
    assert told(EXAMPLE, "--first", "(0mm,0mm)")["warps"] == [3, 4]
    assert told(EXAMPLE, "--first", "(2mm,-1mm)")["warps"] == [2, 3]
    assert told(EXAMPLE, "--first", "(0mm,40mm)")["verdict"].startswith("no knot: the path begins")


def test_other_columns_delimiters_and_decimal_commas_are_read(tmp_path) -> None:
    file = tmp_path / "motion.csv"
    file.write_text("# of a machine\nt [s];P x [cm];P y (mm)\n0,5;1,25;-3\n1;2;4,5\n", encoding="utf-8")
    np.testing.assert_allclose(read_path(file, ("P x", "P y (mm)")), [0.0125 - 0.003j, 0.02 + 0.0045j], rtol=1e-15)


def test_a_motion_of_a_mechanism_is_read_as_it_was_written(tmp_path) -> None:
    examples, motion = EXAMPLE.parent, tmp_path / "motion.csv"
    runner = CliRunner()
    moved = runner.invoke(main, ["mechanism", str(examples / "jansen_leg.toml"), "--csv", str(motion)])
    assert moved.exit_code == 0
    found = told(motion, "--columns", "leg.F x", "leg.F y", "--pitch", "1m", "--first", "(-3m,-9m)")
    assert found["verdict"].startswith("no knot")


def test_the_page_shows_path_and_verdict(tmp_path) -> None:
    page = tmp_path / "knot.html"
    shown = ilmek(EXAMPLE, "--report", page)
    assert "symmetric knot over warps 3 and 4" in shown.stdout
    assert "begins" in page.read_text(encoding="utf-8")


GOOD = b"x [mm],y [mm]\n1,9\n1,-9\n"
BAD = {
    "missing": (None, (), "does not exist; check its name"),
    "empty": (b"\n", (), "is empty"),
    "one place": (b"x [mm],y [mm]\n1,9\n", (), "has 1 point; two or more"),
    "no unit": (b"x,y\n1,9\n1,-9\n", (), "column 'x' has no unit; write x [mm] in the first line"),
    "an angle": (b"x [deg],y [mm]\n1,9\n1,-9\n", (), "deg"),
    "no such column": (b"a [mm],b [mm],c [mm]\n1,9,0\n1,-9,0\n", (), "choose two with --columns X Y"),
    "column of a typo": (GOOD, ("--columns", "x", "z"), "no column 'z'; columns: x [mm], y [mm]"),
    "a word": (b"x [mm],y [mm]\n1,9\n1,down\n", (), "line 3: 'down' is not a number"),
    "not finite": (b"x [mm],y [mm]\n1,9\n1,nan\n", (), "line 3: 'nan' is not a number"),
    "a short line": (b"x [mm],y [mm]\n1,9\n1\n", (), "line 3"),
    "quotes": (b'x [mm],y [mm]\n"1,9\n', (), "line"),
    "through a warp": (b"x [mm],y [mm]\n2,9\n2,-9\n", (), "warp 2"),
    "no pitch": (GOOD, ("--pitch", "0mm"), "a pitch of 0 mm; more than 0"),
    "no passage between": (GOOD, ("--keep-out", "1mm"), "leaves no passage between them"),
    "pitch of an angle": (GOOD, ("--pitch", "2deg"), "2deg"),
    "two first warps": (GOOD, ("--first", "(0mm,0mm) (1mm,1mm)"), "--first gives 2 points"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_line(case, tmp_path) -> None:
    content, options, said = BAD[case]
    file = tmp_path / "path.csv"
    if content is not None:
        file.write_bytes(content)
    result = ilmek(file, *options)
    assert result.exit_code == 2
    assert said in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert not result.stdout


def test_ends_that_start_apart_are_refused(tmp_path) -> None:
    files = [written(tmp_path / name, np.array([start, start - 9j]) * mm) for name, start in (("a", 1 + 5j), ("b", 3j))]
    assert "the two motions start" in ilmek(*files).stderr
