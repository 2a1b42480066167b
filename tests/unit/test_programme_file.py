"""Programme files: what is written is read, and what is no programme is named."""

import sqlite3
from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pytest
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import LoomProgramme, RowEnd, RowOperations, Stop, TubeChange
from ilmek.machines.weaver import WeaverParams, design
from ilmek.progress import Progress

ROWS, COLUMNS, HEADS = 40, 30, 3


class WithStops:
    """A programme with further changes of packages, and with one row that no compiler writes."""

    def __init__(self, programme: CompiledProgramme) -> None:
        self._programme = programme
        self.setup = replace(programme.setup, cyclograms=(design(WeaverParams()).cyclogram,))
        self.digest = programme.digest
        self.chart_row = programme.chart_row

    def operations(self, number: int) -> RowOperations:
        """Row 7 has no knots for head 1, its wefts twice, and a change between its phases."""
        row = self._programme.operations(number)
        if number != 7:
            return row
        kept = np.r_[: row.starts[1], row.starts[2] : row.starts[3]]
        counts = row.counts.copy()
        counts[1] = 0
        stops = (*row.stops, Stop(7, 1, (0,), (TubeChange(2, 1, 0, 250.5), TubeChange(0, 0, 2, 0.0))))
        return replace(
            row,
            columns=row.columns[kept],
            tubes=row.tubes[kept],
            counts=counts,
            stops=stops,
            ends=(RowEnd.TAKE_UP,) * 2,
        )


def programme() -> WithStops:
    return WithStops(small_programme(ROWS, COLUMNS, HEADS, 3, seed=3))


@pytest.fixture
def written(tmp_path: Path) -> Path:
    path = tmp_path / "programme.ilmek"
    write_programme(path, programme())
    return path


def values(row: RowOperations) -> tuple[object, ...]:
    arrays = tuple(array.tolist() for array in (row.columns, row.tubes, row.counts))
    return (row.number, *arrays, row.ends, tuple(astuple(stop) for stop in row.stops))


def test_everything_comes_back(written: Path) -> None:
    meant = programme()
    with open_programme(written) as file:
        checked: LoomProgramme = file
        for name in ("loom", "size", "quality", "yarns", "rows", "columns", "heads", "tubes", "spacing", "times",
                     "knot_yarn", "wefts", "warp_pitch", "knot"):  # fmt: skip
            assert getattr(checked.setup, name) == getattr(meant.setup, name), name
        assert checked.setup.loading.tolist() == meant.setup.loading.tolist()
        assert checked.setup.packages.tolist() == meant.setup.packages.tolist()
        assert checked.setup.cyclograms[0].tracks == meant.setup.cyclograms[0].tracks
        for number in range(ROWS):
            assert values(checked.operations(number)) == values(meant.operations(number))
            assert checked.chart_row(number).tolist() == meant.chart_row(number).tolist()
        assert [stop.row for stop in file.stops()] == sorted([*range(4, ROWS, 4), 7])
        counts = np.bincount(np.concatenate([meant.chart_row(number) for number in range(ROWS)]))
        assert file.totals.counts == tuple(counts.tolist())


def test_the_digest_and_the_totals_are_those_of_the_programme(tmp_path: Path) -> None:
    meant, path = small_programme(ROWS, COLUMNS, HEADS, 3), tmp_path / "a.ilmek"
    write_programme(path, meant)
    with open_programme(path) as file:
        assert file.digest == meant.digest
        assert file.totals.duration == pytest.approx(file.row_times.sum() + 9 * 90.0 + 4 * 90.0, rel=1e-12)
        assert file.totals.knots == ROWS * COLUMNS


def test_the_same_programme_is_the_same_file(tmp_path: Path) -> None:
    for name in ("a", "b"):
        write_programme(tmp_path / name, programme())
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_progress_ends_at_one_and_nothing_is_left_beside(tmp_path: Path) -> None:
    reported: list[float] = []
    write_programme(tmp_path / "a.ilmek", programme(), progress=Progress(lambda _, share: reported.append(share)))
    assert reported[-1] == 1.0
    assert [path.name for path in tmp_path.iterdir()] == ["a.ilmek"]


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(LoomError, match="cannot be read: No such file"):
        open_programme(tmp_path / "a.ilmek")


def test_a_folder(tmp_path: Path) -> None:
    with pytest.raises(LoomError, match="cannot be read: Is a directory"):
        open_programme(tmp_path)


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n" + bytes(200), b"SQLite format 3\0"])
def test_a_foreign_file(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.ilmek"
    path.write_bytes(content)
    with pytest.raises(LoomError, match="is no loom programme; a file that"):
        open_programme(path)


def test_a_foreign_database(tmp_path: Path) -> None:
    path = tmp_path / "a.ilmek"
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE t (x)")
    connection.close()
    with pytest.raises(LoomError, match="is no loom programme"):
        open_programme(path)


def test_a_newer_format(written: Path) -> None:
    data = bytearray(written.read_bytes())
    data[60:64] = (9).to_bytes(4, "big")
    written.write_bytes(data)
    with pytest.raises(LoomError, match="has format 9; this ilmek reads up to format 3"):
        open_programme(written)


def test_an_older_format(written: Path) -> None:
    data = bytearray(written.read_bytes())
    data[60:64] = (2).to_bytes(4, "big")
    written.write_bytes(data)
    with pytest.raises(LoomError, match="has format 2; this ilmek reads format 3; write the programme again"):
        open_programme(written)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9, 0.999])
def test_a_file_cut_short(written: Path, share: float) -> None:
    data = written.read_bytes()
    written.write_bytes(data[: int(len(data) * share)])
    with pytest.raises(LoomError, match="is truncated"):
        open_programme(written)


def test_any_page_overwritten_is_found_or_harmless(written: Path) -> None:
    data = written.read_bytes()
    sound, found = [values(programme().operations(number)) for number in range(ROWS)], 0
    for first in range(100, len(data), 2048):
        damaged = bytearray(data)
        damaged[first : first + 512] = b"\xa5" * len(damaged[first : first + 512])
        written.write_bytes(damaged)
        try:
            with open_programme(written) as file:
                assert [values(file.operations(number)) for number in range(ROWS)] == sound
        except LoomError:
            found += 1
    assert found > 0


@pytest.mark.matrix(light=6)
@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("DELETE FROM row WHERE number = 5", "row 5 is missing"),
        ("UPDATE row SET data = x'00' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET data = 7 WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET phases = 3 WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET phases = 1.5 WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET ends = x'0009' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET ends = x'0001' WHERE number = 5", "its digest is not that of its rows"),
        ("DELETE FROM chart WHERE number = 5", "row 5 of the chart is missing"),
        ("UPDATE chart SET data = x'00' WHERE number = 5", "row 5 of the chart is damaged"),
        ("UPDATE change SET weft = 2 WHERE row = 4", "change of a package before row 4 is damaged"),
        ("UPDATE change SET head = 3 WHERE row = 7", "change of a package before row 7 is damaged"),
        (
            "UPDATE change SET length = -1.0 WHERE row = 7 AND weft IS NULL",
            "change of a package before row 7 is damaged",
        ),
        ("UPDATE change SET phase = 2 WHERE row = 7", "row 7 is damaged"),
        ("UPDATE change SET row = 40 WHERE row = 4", "more rows than the carpet"),
        ("UPDATE change SET weft = 1 WHERE row = 4", "its digest is not that of its rows"),
        ("DELETE FROM change WHERE row = 4", "its digest is not that of its rows"),
    ],
)
def test_a_damaged_row(written: Path, statement: str, said: str) -> None:
    _alter(written, statement)
    with pytest.raises(LoomError, match=said):
        open_programme(written)


@pytest.mark.parametrize(
    "statement",
    [
        "DELETE FROM meta WHERE key = 'rows'",
        "UPDATE meta SET value = '{' WHERE key = 'times'",
        "UPDATE meta SET value = '[1]' WHERE key = 'times'",
        "UPDATE meta SET value = replace(value, 'modified-sine', 'magic') WHERE key = 'cyclograms'",
        "DROP TABLE meta",
    ],
)
def test_damaged_metadata(written: Path, statement: str) -> None:
    _alter(written, statement)
    with pytest.raises(LoomError, match="is damaged"):
        open_programme(written)


@pytest.mark.parametrize("number", [-1, ROWS])
def test_rows_beyond_the_carpet(written: Path, number: int) -> None:
    with open_programme(written) as file, pytest.raises(LoomError, match="rows 0 to 39"):
        file.operations(number)


def _alter(path: Path, statement: str) -> None:
    connection = sqlite3.connect(path)
    with connection:
        connection.execute(statement)
    connection.close()
