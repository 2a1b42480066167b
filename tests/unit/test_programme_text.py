"""The text form of a programme: lossless in both directions, and whatever is wrong in it is named with its line."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from edited_programme import EditedProgramme, edited, swept, with_knot
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.io.any_programme import open_any_programme, require_form, row_texts, write_any_programme
from ilmek.io.programme_text import open_programme_text, programme_text_parts
from ilmek.loom.operations import EMPTY, RowEnd, RowOperations, Stop, TubeChange


def text_of(programme: EditedProgramme) -> str:
    return b"".join(programme_text_parts(programme)).decode()


def with_everything() -> EditedProgramme:
    """Stops between phases, packages, an empty tube, knots in any order, other ends, a row with a phase more."""
    programme = swept(small_programme(5, 24, 2, 3))
    loading, packages = programme.setup.loading.copy(), programme.setup.packages.copy()
    loading[1, 2], packages[1, 2] = EMPTY, 0.1 + 0.2

    def shuffled(row: RowOperations) -> RowOperations:
        order = np.random.default_rng(4).permutation(len(row.columns))
        counts = np.array([[3, 0, 7], [0, 14, 0]])
        stops = (Stop(1, 0, (1, 0)), Stop(1, 2, (0,), (TubeChange(1, 2, 0, 1 / 3), TubeChange(0, 1, 2, 1e-7))))
        columns, tubes = row.columns[order], row.tubes[order]
        return RowOperations(1, columns, tubes, counts, (RowEnd.TAKE_UP, RowEnd.SECOND_BEAT, RowEnd.TAKE_UP), stops)

    return edited(programme, 1, shuffled, loading=loading, packages=packages)


@pytest.mark.parametrize(
    "make", [small_programme, with_everything, lambda: small_programme(9, 40, 5, 4, tubes=2, package=0.9)]
)
def test_text_and_programme_are_the_same_both_ways(tmp_path: Path, make: Callable[[], EditedProgramme]) -> None:
    programme = make()
    files = [tmp_path / name for name in ("a.txt", "b.ilmek", "c.txt", "d.ilmek")]
    write_any_programme(files[0], ".txt", programme)
    for source, target in pairwise(files):
        with open_any_programme(source) as opened:
            assert opened.digest == programme.digest
            write_any_programme(target, target.suffix, opened)
    assert files[0].read_bytes() == files[2].read_bytes()
    assert files[1].read_bytes() == files[3].read_bytes()
    with open_programme_text(files[0]) as text:
        assert np.array_equal(text.setup.packages, programme.setup.packages)
        assert repr(text.operations(1).stops) == repr(programme.operations(1).stops)
        assert np.array_equal(text.operations(0).columns, programme.operations(0).columns)


def test_the_text_is_as_in_the_grammar() -> None:
    lines = text_of(swept(small_programme())).splitlines()
    assert lines[0] == "ilmek programme 1"
    assert lines[lines.index("row 2") :][:14] == [
        "row 2", "chart 6*1 9*3 3*2 3*3 3*1", "phase 1", "head 1", "tie 12..7 tube 3", "head 2", "tie 24..22 tube 1",
        "tube 3", "tie 21..19 tube 3", "phase 2", "head 1", "tube 1", "tie 6..1 tube 1", "head 2",
    ]  # fmt: skip
    assert lines[-6:] == ["straight weft", "first beat", "sinuous weft", "second beat", "take-up", "end"]
    everything = text_of(with_everything())
    for line in ("stop", "bobbin 2", "package head 2 tube 3 yarn 1 of 0.3333333333333333 m", "loading [1, 2, 0]"):
        assert f"\n{line}\n" in everything


def test_lines_of_a_file_are_those_of_its_text(tmp_path: Path) -> None:
    programme = with_everything()
    write_any_programme(tmp_path / "a.ilmek", ".ilmek", programme)
    lines = ["", *text_of(programme).splitlines()]
    with open_any_programme(tmp_path / "a.ilmek") as opened:
        (row,) = row_texts(opened, [1])
    assert lines[row.line] == "row 2"
    assert [lines[line] for line in row.ends] == ["take-up", "second beat", "take-up"]
    assert [lines[line].split()[0] for line in row.changes] == ["bobbin", "bobbin", "bobbin", "package", "package"]
    firsts = row.row.columns[row.ties[:, 0]] + 1
    assert all(lines[line].startswith(f"tie {first}") for first, line in zip(firsts, row.ties[:, 1], strict=True))


CHART = "chart 6*1 9*3 3*2 3*3 3*1\n"
FIRST = "phase 1\nhead 1\ntie 1..6"
PACKAGE = "package head 1 tube 1 yarn 1 of"
EDITS: dict[str, tuple[str, str, str]] = {
    "another version": ("ilmek programme 1", "ilmek programme 2", "line 1: no text of a programme"),
    "no key": ("warp_pitch 0.002\n", "", "line 1: the description has no warp_pitch"),
    "a key twice": ("rows 6\n", "rows 6\nrows 6\n", "line 11: rows is given again"),
    "a list apart": ("rows 6\n", "rows 6\nloading [1]\nheads 2\nloading [1]\n", "is not with its other"),
    "an unknown key": ("rows 6\n", "rows 6\ncolour 7\n", "line 11: `colour 7` is no line of the description"),
    "no JSON": ("rows 6\n", "rows six\n", "line 10 is not JSON"),
    "deep brackets": ("rows 6\n", f"rows {'[' * 100_000}\n", "line 10 is not JSON"),
    "a huge number": ("rows 6\n", f"rows {'9' * 5000}\n", "line 10 is not JSON"),
    "another number": ("rows 6\n", "rows 6.5\n", "line 10: rows is 6.5"),
    "too many knots": ("rows 6\n", "rows 250001\n", "line 10: rows is 250001"),
    "yarn of no list": ("loading [1, 2, 3]", "loading [1, 2, 9]", "line 16: loading has an unknown yarn"),
    "no list": ("loading [1, 2, 3]", "loading {}", "line 16: loading"),
    "word": ("tie 1..6 tube 1", "knot 1..6 tube 1", "line 27: `knot 1..6 tube 1` is no line of a row"),
    "blanks": ("tie 1..6 tube 1", "tie  1..6 tube 1", "line 27: "),
    "trailing blank": ("tie 1..6 tube 1", "tie 1..6 tube 1 ", "line 27: "),
    "carriage return": ("tie 1..6 tube 1", "tie 1..6 tube 1\r", "line 27: "),
    "knot zero": ("tie 1..6 tube 1", "tie 0..6 tube 1", "line 27: "),
    "leading zero": ("tie 1..6 tube 1", "tie 01..6 tube 1", "line 27: "),
    "huge knot": ("tie 1..6 tube 1", "tie 1..99999999999 tube 1", "line 27: "),
    "many knots": ("tie 1..6 tube 1", "tie 1..999999999 tube 1", "cannot be here; at most 48"),
    "knot beyond the row": ("tie 19..21 tube 3", "tie 19..25 tube 3", "has a knot beyond the row"),
    "tube that there is not": ("tie 1..6 tube 1", "tie 1..6 tube 4", "has a tube that the head does not have"),
    "control characters": ("tie 1..6 tube 1", "tie 1..6 tube 1\x00", "line 27: "),
    "not ASCII": ("tie 1..6 tube 1", "tie 1..6 tübe 1", "line 27: "),
    "empty line": ("tie 1..6 tube 1\n", "\ntie 1..6 tube 1\n", "line 27: `` is no line"),
    "long line": ("chart 6*1 9*3", f"chart {'1*1 ' * 150}", "line 24: "),
    "short chart": (CHART + FIRST, f"chart 6*1\n{FIRST}", "24 knots"),
    "long chart": (CHART + FIRST, f"chart 25*1\n{FIRST}", "line 24: "),
    "yarn of the chart": ("chart 6*1 9*3", "chart 6*4 9*3", "line 24: "),
    "no chart": ("row 1\nchart 6*1 9*3 3*2 3*3 3*1\n", "row 1\n", "line 24: "),
    "row twice": ("row 2\n", "row 1\n", "`row 1`; `row 2`"),
    "row left out": ("row 6\n", "row 7\n", "`row 7`; `row 6`"),
    "phase left out": ("phase 1\n", "phase 2\n", "line 25: `phase 2` cannot be here"),
    "head beyond the loom": ("head 2\n", "head 3\n", "cannot be here"),
    "head twice": ("head 2\n", "head 1\n", "cannot be here"),
    "knot before a head": ("head 1\ntie 1..6 tube 1\n", "tie 1..6 tube 1\nhead 1\n", "line 26: "),
    "stop after the last phase": ("straight weft\n", "stop\nstraight weft\n", "cannot be here"),
    "bobbin without a stop": ("phase 1\n", "bobbin 1\nphase 1\n", "line 25: "),
    "package before a bobbin": ("bobbin 1\n", f"{PACKAGE} 9.0 m\nbobbin 1\n", "`bobbin 1` cannot be here"),
    "package of no length": ("bobbin 1\n", f"{PACKAGE} nan m\n", "a package of `nan m`"),
    "package without unit": ("bobbin 1\n", f"{PACKAGE} 9.0\n", "a length like 250.0 m"),
    "package in another unit": ("bobbin 1\n", f"{PACKAGE} 9.0 km\n", "a length like 250.0 m"),
    "negative package": ("bobbin 1\n", f"{PACKAGE} -9.0 m\n", "a length like 250.0 m"),
    "bobbin that there is not": ("bobbin 1\n", "bobbin 3\n", "`bobbin 3` names a part that the loom does not have"),
    "tube line too many": ("tie 1..6 tube 1\n", "tube 2\ntie 1..6 tube 1\n", "line 27: `tube 2` is not the change"),
    "tube line missing": ("tube 2\ntie 16..18", "tie 16..18", "line 30: `tie 16..18 tube 2` needs a line `tube`"),
    "move line missing": ("move 19..15\n", "", "needs a line `move`"),
    "another move": ("move 19..15\n", "move 19..14\n", "is not the move from the knot before"),
    "no end": ("\nend\n", "\n", "the text ends without `end`"),
    "more behind the end": ("\nend\n", "\nend\nmore\n", "then nothing more"),
    "within a line": ("\nend\n", "\nend", "the text ends within a line"),
    "end too early": ("row 6\n", "end\nrow 6\n", "line "),
}  # fmt: skip


@pytest.mark.parametrize("name", EDITS)
def test_a_wrong_text_is_refused_with_its_line(tmp_path: Path, name: str) -> None:
    old, new, message = EDITS[name]
    text, file = text_of(swept(small_programme())), tmp_path / "p.txt"
    assert old in text
    file.write_bytes(text.replace(old, new, 1).encode())
    with pytest.raises(LoomError) as caught:
        open_programme_text(file)
    assert message in str(caught.value)
    assert str(caught.value).startswith(f"{file}, ")


def test_each_cut_text_is_refused(tmp_path: Path) -> None:
    text, file = text_of(swept(small_programme(3, 12, 2, 2))).encode(), tmp_path / "p.txt"
    for length in [0, 1, 17, 18, 400, *range(len(text) - 300, len(text), 7)]:
        file.write_bytes(text[:length])
        with pytest.raises(LoomError, match=r"line \d+|the description"):
            open_programme_text(file)


def test_a_row_of_another_file_is_not_read(tmp_path: Path) -> None:
    file = tmp_path / "p.txt"
    file.write_text(text_of(swept(small_programme())))
    with open_programme_text(file) as text:
        file.write_text("short")
        with pytest.raises(LoomError, match="has changed while it was read"):
            text.operations(4)
        with pytest.raises(LoomError, match="rows 0 to 5"):
            text.operations(6)


def test_missing_and_large_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(LoomError, match="No such file"):
        open_programme_text(tmp_path / "gone.txt")
    with pytest.raises(LoomError, match="Is a directory"):
        open_programme_text(tmp_path)
    file = tmp_path / "p.txt"
    file.write_text(text_of(swept(small_programme())))
    monkeypatch.setattr("ilmek.io.programme_text.LARGEST_FILE", 100)
    with pytest.raises(LoomError, match="at most"):
        open_programme_text(file)


def test_a_row_without_end_is_refused_before_it_is_read_whole(tmp_path: Path) -> None:
    file = tmp_path / "p.txt"
    text = text_of(swept(small_programme()))
    at = text.index("row 2\n")
    file.write_text(text[:at] + "row 2\n" + "tie 1 tube 1\n" * 400_000)
    with pytest.raises(LoomError, match=rf"line {text[:at].count(chr(10)) + 1}: the row has more than"):
        open_programme_text(file)


def test_other_endings_are_refused() -> None:
    with pytest.raises(Exception, match=r"\.ilmek or \.txt"):
        require_form(Path("a.csv"))


def test_stops_out_of_order_have_no_text() -> None:
    def twisted(row: RowOperations) -> RowOperations:
        return replace(row, stops=(Stop(0, 1), Stop(0, 0)))

    with pytest.raises(LoomError, match="not in the order of its phases"):
        text_of(edited(swept(small_programme()), 0, twisted))


def test_a_lenient_reader_keeps_remarks(tmp_path: Path) -> None:
    file = tmp_path / "p.txt"
    programme = edited(swept(small_programme()), 1, lambda row: with_knot(row, 2, tube=1))
    file.write_text(text_of(programme).replace("tube 2\n", "", 1))
    with open_programme_text(file, lenient=True) as text:
        assert [remark.line for remark in text.remarks] == [30]
