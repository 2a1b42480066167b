"""Programme files: what is written is read, and what is no programme is named."""

import sqlite3
from pathlib import Path

import numpy as np
import pytest

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import LoomError
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.io.programme_meta import Label
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.programme import Programme, Times, make_programme
from ilmek.machines.weaver import WeaverParams, design
from ilmek.progress import Progress

ROWS, COLUMNS = 40, 30


def programme() -> Programme:
    knots = np.random.default_rng(3).integers(0, 3, (ROWS, COLUMNS)).astype(np.uint8)
    bobbins = (Bobbin("straight weft", 7, 90.0), Bobbin("sinuous weft", 14, 60.0))
    return make_programme(knots, 3, 3, Times(2.0, 0.5, 0.02, 12.0), bobbins=bobbins)


def label() -> Label:
    yarns = tuple(Yarn(f"wool {k}", (k, 2 * k, 255), (50.5, 1.0, -3.25), 2.5, 2, 30.0 if k else None) for k in range(3))
    return Label(
        CarpetSize(0.12, 0.16), Quality(250.0, 250.0), "symmetric", yarns, 0.002, (design(WeaverParams()).cyclogram,)
    )


@pytest.fixture
def written(tmp_path: Path) -> Path:
    path = tmp_path / "programme.ilmek"
    write_programme(path, programme(), label())
    return path


def test_everything_comes_back(written: Path) -> None:
    meant = programme()
    with open_programme(written) as file:
        assert (file.rows, file.columns, file.heads, file.times) == (ROWS, COLUMNS, 3, meant.times)
        assert file.label == label()
        assert file.totals.duration == meant.duration
        assert (file.bobbins, file.stops) == (meant.bobbins, meant.stops)
        assert file.totals.duration == pytest.approx(meant.row_times.sum() + 5 * 90.0 + 2 * 60.0)
        assert file.totals.counts == tuple(np.bincount(meant.knots.ravel()).tolist())
        assert file.totals.changes_per_knot == meant.work.changes.sum() / (ROWS * COLUMNS)
        assert file.work.busy.tolist() == meant.work.busy.tolist()
        for number in range(ROWS):
            row, kept = meant.row(number), file.row(number)
            assert kept.colours.tolist() == row.colours.tolist()
            assert file.row_time(number) == meant.row_times[number]
            for ties, same in zip(row.ties(), kept.ties(), strict=True):
                assert ties.pairs.tolist() == same.pairs.tolist()
                assert ties.colours.tolist() == same.colours.tolist()


def test_progress_ends_at_one_and_nothing_is_left_beside(tmp_path: Path) -> None:
    told: list[float] = []
    write_programme(tmp_path / "a.ilmek", programme(), label(), progress=Progress(lambda _, share: told.append(share)))
    assert told[-1] == 1.0
    assert [path.name for path in tmp_path.iterdir()] == ["a.ilmek"]


def test_yarns_must_be_those_of_the_chart(tmp_path: Path) -> None:
    few = Label(CarpetSize(0.12, 0.16), Quality(250.0, 250.0), "symmetric", label().yarns[:2], 0.002)
    with pytest.raises(LoomError, match="2 yarns for a programme of 3"):
        write_programme(tmp_path / "a.ilmek", programme(), few)


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
    with pytest.raises(LoomError, match="has format 9; this ilmek reads up to format 2"):
        open_programme(written)


def test_an_older_format(written: Path) -> None:
    data = bytearray(written.read_bytes())
    data[60:64] = (1).to_bytes(4, "big")
    written.write_bytes(data)
    with pytest.raises(LoomError, match="has format 1; this ilmek reads format 2; write the programme again"):
        open_programme(written)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.9, 0.999])
def test_a_file_cut_short(written: Path, share: float) -> None:
    data = written.read_bytes()
    written.write_bytes(data[: int(len(data) * share)])
    with pytest.raises(LoomError, match="is truncated"):
        open_programme(written)


def test_any_page_overwritten_is_found_or_harmless(written: Path) -> None:
    data = written.read_bytes()
    sound, found = programme(), 0
    for first in range(100, len(data), 1024):
        damaged = bytearray(data)
        damaged[first : first + 512] = b"\xa5" * len(damaged[first : first + 512])
        written.write_bytes(damaged)
        try:
            with open_programme(written) as file:
                for number in range(ROWS):
                    assert file.row(number).colours.tolist() == sound.row(number).colours.tolist()
        except LoomError:
            found += 1
    assert found > 0


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("DELETE FROM row WHERE number = 5", "row 5 is missing"),
        ("UPDATE row SET data = x'00' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET data = 7 WHERE number = 5", "row 5 is damaged"),
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
        file.row(number)


def _alter(path: Path, statement: str) -> None:
    connection = sqlite3.connect(path)
    with connection:
        connection.execute(statement)
    connection.close()
