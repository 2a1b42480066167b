"""Programme files of others: whatever is in them, opening them gives one LoomError, in bounded time and memory."""

import json
import os
import resource
import sqlite3
import zlib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_programme import small_programme

from ilmek.carpet.yarn import Yarn
from ilmek.cli.inspect import show_row
from ilmek.errors import IlmekError, LoomError
from ilmek.io import programme_file, sqlite_readonly
from ilmek.io.json_file import json_text
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.jobs.inspect import inspect_programme
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.programme import make_programme
from ilmek.loom.times import Times
from ilmek.machines.weaver import WeaverParams, design

ROWS, COLUMNS, HEADS, YARNS = 12, 20, 3, 3


def small(**changes: Any) -> CompiledProgramme:
    """A programme with some entries of its setup changed."""
    programme = small_programme(ROWS, COLUMNS, HEADS, YARNS, seed=3)
    yarns = tuple(Yarn(f"wool {k}", (k, 2 * k, 255), (50.5, 1.0, -3.25), 2.5, 2) for k in range(YARNS))
    programme.setup = replace(programme.setup, **{"yarns": yarns, **changes})
    return programme


@pytest.fixture(scope="module")
def content(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("written") / "a.ilmek"
    write_programme(path, small(cyclograms=(design(WeaverParams()).cyclogram,)))
    return path.read_bytes()


@pytest.fixture
def written(tmp_path: Path, content: bytes) -> Path:
    path = tmp_path / "a.ilmek"
    path.write_bytes(content)
    return path


def alter(path: Path, *statements: str, parameters: tuple[object, ...] = ()) -> None:
    connection = sqlite3.connect(path, isolation_level=None)
    for statement in statements:
        connection.execute(statement, parameters)
    connection.close()


def refused(path: Path, match: str) -> None:
    with pytest.raises(LoomError, match=match) as caught:
        open_programme(path)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 700


def set_meta(path: Path, key: str, change: Callable[[Any], Any]) -> None:
    connection = sqlite3.connect(path, isolation_level=None)
    (text,) = connection.execute("SELECT value FROM meta WHERE key = ?", (key,)).fetchone()
    connection.execute("UPDATE meta SET value = ? WHERE key = ?", (json.dumps(change(json.loads(text))), key))
    connection.close()


def put(*path: Any) -> Callable[[Any], Any]:
    """A change that puts the last argument at the path of the others."""
    *keys, last, value = path

    def change(data: Any) -> Any:
        inner = data
        for key in keys:
            inner = inner[key]
        inner[last] = value
        return data

    return change


def set_data(path: Path, table: str, number: int, change: Callable[[bytearray], object]) -> None:
    """Change the data of a row of a table."""
    connection = sqlite3.connect(path, isolation_level=None)
    (data,) = connection.execute(f"SELECT data FROM {table} WHERE number = ?", (number,)).fetchone()
    raw = bytearray(zlib.decompress(data))
    change(raw)
    connection.execute(f"UPDATE {table} SET data = ? WHERE number = ?", (zlib.compress(raw), number))
    connection.close()


RECURSIVE = """CREATE VIEW chart (number, data) AS WITH RECURSIVE n (k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n)
    SELECT k, zeroblob(9) FROM n"""


@pytest.mark.parametrize(
    "statements",
    [
        ("DROP TABLE chart", RECURSIVE),
        ("CREATE VIEW v AS SELECT 1",),
        ("CREATE INDEX i ON row (phases)",),
        ("CREATE TRIGGER t AFTER INSERT ON row BEGIN SELECT 1; END",),
        ("CREATE VIRTUAL TABLE f USING fts5 (x)",),
        ("CREATE TABLE more (x)",),
        ("ALTER TABLE row ADD COLUMN x",),
        ("DROP TABLE row", "CREATE TABLE row (number INTEGER PRIMARY KEY, phases REAL, ends BLOB, data BLOB)"),
    ],
    ids=["recursive view", "view", "index", "trigger", "virtual table", "table", "column", "other types"],
)
def test_a_schema_that_ilmek_does_not_write(written: Path, statements: tuple[str, ...]) -> None:
    alter(written, *statements)
    refused(written, "other tables than meta and chart and row and change|authorized|malformed|too many columns")


def test_a_schema_that_cannot_be_parsed(written: Path) -> None:
    broken = "UPDATE sqlite_master SET sql = 'CREATE TABLE row (\x1b[2J' WHERE name = 'row'"
    alter(written, "PRAGMA writable_schema=ON", broken)
    refused(written, "is damaged")


def test_a_query_has_a_limit_of_steps(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sqlite_readonly, "MOST_STEPS", 10)
    monkeypatch.setattr(sqlite_readonly, "_SLICE", 10)
    refused(written, "interrupted")


def test_a_row_that_unpacks_to_gigabytes(written: Path) -> None:
    packer = zlib.compressobj(9)
    bomb = b"".join(packer.compress(bytes(1 << 20)) for _ in range(300)) + packer.flush()
    alter(written, "UPDATE row SET data = ? WHERE number = 5", parameters=(bomb,))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    refused(written, "row 5 is damaged")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000


@pytest.mark.parametrize("size", [3_000_000, 900_000])
def test_a_value_beyond_the_limit(written: Path, size: int) -> None:
    alter(written, f"UPDATE row SET data = zeroblob({size}) WHERE number = 5")
    refused(written, "too big" if size > sqlite_readonly.LARGEST_VALUE else "row 5 is damaged")


def test_a_file_beyond_the_limit(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(programme_file, "LARGEST_FILE", 10_000)
    refused(written, r"a\.ilmek has \d+ bytes; at most")


@pytest.mark.parametrize(
    ("at", "byte"), [(16, 0x03), (18, 2), (59, 0), (59, 2)], ids=["page size", "write-ahead log", "encoding", "UTF-16"]
)
def test_a_header_that_ilmek_does_not_write(written: Path, at: int, byte: int) -> None:
    data = bytearray(written.read_bytes())
    data[at] = byte
    written.write_bytes(data)
    refused(written, "is damaged|is truncated")


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to(path)], ids=["pipe", "link to itself"])
def test_what_is_no_file_is_not_opened(tmp_path: Path, make: Callable[[Path], object]) -> None:
    path = tmp_path / "a.ilmek"
    make(path)
    refused(path, "cannot be read: ")


def test_a_device_and_a_name_that_is_none() -> None:
    refused(Path("/dev/zero"), "cannot be read: Is a pipe or a device")
    with pytest.raises(LoomError, match="cannot be read: No such file"):
        open_programme(Path("a\0.ilmek"))


def test_a_link_to_a_programme_is_read(written: Path, tmp_path: Path) -> None:
    link = tmp_path / "a #link?.ilmek"
    link.symlink_to(written)
    with open_programme(link) as file:
        assert file.setup.rows == ROWS


DEEP = "[" * 100_000


@pytest.mark.parametrize(
    ("key", "change", "said"),
    [
        ("heads", lambda _: 10**18, "heads is"),
        ("heads", lambda _: True, "heads is true"),
        ("heads", lambda _: 2, "loading is a list"),
        ("tubes", lambda _: 0, "tubes is 0"),
        ("tubes", lambda _: 4, r"loading\[0\] is a list"),
        ("spacing", lambda _: 0, "spacing is 0"),
        ("columns", lambda _: 250_000, "row 0 of the chart is damaged"),
        ("columns", lambda _: 19, "is damaged"),
        ("rows", lambda _: 10**4000, "rows is"),
        ("rows", lambda _: 11, "more rows"),
        ("rows", lambda _: 250_000, "row 12 is missing"),
        ("loom", lambda _: "0" * 63, "loom is"),
        ("digest", lambda _: "0" * 64, "its digest is not that of its rows"),
        ("digest", lambda _: None, "digest is null"),
        ("times", put("knot", float("nan")), r"times\.knot is nan"),
        ("times", put("knot", 0), "time of knot 0 s"),
        ("times", put("tube_change", -1), r"times\.tube_change is -1"),
        ("times", put("row_ends", [3, 2, 4, 5, 6]), "row_ends are not in order"),
        ("times", put("row_ends", [3, 4]), "row_ends is a list of 2"),
        ("times", put("more", 1), "times is a table"),
        ("loading", put(0, 0, 3), "unknown yarn"),
        ("loading", put(0, 0, 256), r"loading\[0\]\[0\] is 256"),
        ("loading", put(0, 0, 1), "its digest"),
        ("packages", put(2, 1, -1), r"packages\[2\]\[1\] is -1"),
        ("packages", put(2, 1, 1e12), r"packages\[2\]\[1\] is"),
        ("knot_yarn", lambda knot_yarn: knot_yarn[1:], "knot_yarn is a list of 2"),
        ("wefts", lambda _: {}, "wefts is a table"),
        ("wefts", lambda wefts: wefts * 9, "a list of 18; a list of 0 to 4"),
        ("wefts", lambda wefts: wefts * 2, "two bobbins"),
        ("wefts", lambda wefts: wefts[:1], "is damaged"),
        ("wefts", put(0, "rows", 0), r"wefts\[0\]\.rows is 0"),
        ("wefts", put(0, "rows", 4.0), r"wefts\[0\]\.rows is 4\.0"),
        ("wefts", put(0, "time", -1), r"wefts\[0\]\.time is -1"),
        ("wefts", put(1, "yarn", ""), r"wefts\[1\]\.yarn"),
        ("wefts", put(1, "more", 1), r"wefts\[1\] is a table"),
        ("quality", put("across", 1e999), r"quality\.across is inf"),
        ("size", put("name", "\x1b]0;x\x07"), "printable"),
        ("size", put("name", "a" * 300_000), "200 characters"),
        ("knot", lambda _: ["symmetric"], "knot is a list"),
        ("warp_pitch", lambda _: 0, "warp_pitch is 0"),
        ("yarns", put(0, "name", "\x1b[31m"), "printable"),
        ("yarns", put(0, "name", "\ud800"), "printable"),
        ("yarns", put(0, "name", "wool 1"), "both named"),
        ("yarns", put(0, "name", " wool"), "spaces round"),
        ("yarns", put(0, "srgb", [0, 0, 256]), r"yarns\[0\]\.srgb\[2\] is 256"),
        ("yarns", put(0, "lab", [0, 0]), r"yarns\[0\]\.lab"),
        ("yarns", put(0, "metric_count", 0), "metric_count 0"),
        ("yarns", lambda yarns: yarns[:1], "yarns is a list"),
        ("yarns", lambda yarns: [*yarns, *yarns], "both named"),
        ("cyclograms", lambda cyclograms: cyclograms * 9, "cyclograms is a list"),
        ("cyclograms", put(0, "period", 0), "period 0 s"),
        ("cyclograms", put(0, "tracks", 0, "unit", "km^400"), "exponent"),
        ("cyclograms", put(0, "tracks", 0, "revolves", 5e-324), "magnitude"),
        ("cyclograms", put(0, "tracks", 0, "segments", 0, "law", "magic"), "no law 'magic'"),
        ("cyclograms", put(0, "tracks", 0, "segments", 0, "start", 7.5), "motion starts before it ends"),
        ("cyclograms", put(0, "tracks", 0, "segments", 0, "parameters", {"x" * 300_000: 1}), "200 characters"),
        ("cyclograms", put(0, "tracks", 0, "segments", 0, "parameters", {"u": [0.1] * 2000}), "a list of 0 to 500"),
    ],
)
def test_a_description_that_ilmek_does_not_write(
    written: Path, key: str, change: Callable[[Any], Any], said: str
) -> None:
    set_meta(written, key, change)
    refused(written, said)


@pytest.mark.parametrize("text", [DEEP, "{" * 9, "1" * 5000, "NaN", '"\ud800"', "\0", "null", "[]", "1" * 999_999])
def test_a_text_that_is_not_the_description(written: Path, text: str) -> None:
    stored = text.encode("utf-8", "surrogatepass")
    alter(written, "UPDATE meta SET value = CAST(? AS TEXT) WHERE key = 'times'", parameters=(stored,))
    refused(written, "is damaged")


def test_a_law_that_overflows(written: Path) -> None:
    for key, value in {"law": "s-curve", "parameters": {"ramp": 5e-324, "cruise": 0}}.items():
        set_meta(written, "cyclograms", put(0, "tracks", 0, "segments", 0, key, value))
    refused(written, "law s-curve cannot be computed")


HEAD = 4 * HEADS * 2
"""Bytes of the counts of a row; behind them the moves, byte by byte, and the tubes."""


@pytest.mark.parametrize(
    ("at", "value"),
    [(0, 9), (3, 255), (HEAD, 200), (HEAD + 3 * COLUMNS, 127), (HEAD + 3 * COLUMNS, 255), (HEAD + 4 * COLUMNS, YARNS)],
    ids=["count", "count below 0", "column", "column far beyond", "column below 0", "tube"],
)
def test_a_row_beyond_its_arrays(written: Path, at: int, value: int) -> None:
    set_data(written, "row", 5, put(at, value))
    refused(written, "row 5 is damaged")


def test_an_unknown_yarn_in_the_chart(written: Path) -> None:
    set_data(written, "chart", 5, put(0, YARNS))
    refused(written, "row 5 of the chart is damaged")


def test_random_bytes_of_a_row_are_refused_or_within_the_arrays(written: Path) -> None:
    random = np.random.default_rng(1)
    for _ in range(25):
        at, value = int(random.integers(HEAD + 5 * COLUMNS)), int(random.integers(256))
        content = written.read_bytes()
        set_data(written, "row", 5, put(at, value))
        if content != written.read_bytes():
            refused(written, "row 5 is damaged|digest")
        written.write_bytes(content)


@pytest.mark.parametrize("change", [lambda raw: raw.append(0), lambda raw: raw.pop(), lambda raw: raw.clear()])
def test_a_row_of_another_length(written: Path, change: Callable[[bytearray], object]) -> None:
    set_data(written, "row", 5, change)
    refused(written, "row 5 is damaged")


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("UPDATE row SET data = data || x'00' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET number = 1000 WHERE number = 11", "more rows"),
        ("UPDATE row SET number = -1 WHERE number = 0", "more rows"),
        ("DELETE FROM row WHERE number = 11", "row 11 is missing"),
        ("INSERT INTO row SELECT 12, phases, ends, data FROM row LIMIT 1", "more rows"),
        ("INSERT INTO chart SELECT 12, data FROM chart LIMIT 1", "more rows"),
        ("INSERT INTO meta VALUES ('more', '1')", "other keys"),
        ("UPDATE meta SET value = CAST(x'ff' AS TEXT) WHERE key = 'knot'", "not UTF-8"),
    ],
)
def test_tables_that_ilmek_does_not_write(written: Path, statement: str, said: str) -> None:
    alter(written, statement)
    refused(written, said)


def test_a_text_that_is_null(written: Path) -> None:
    declared = programme_file.TABLES["meta"]
    for sql in (declared.replace(" NOT NULL", ""), declared):
        alter(written, "PRAGMA writable_schema=ON", f"UPDATE sqlite_master SET sql = '{sql}' WHERE name = 'meta'")
        if sql != declared:
            alter(written, "UPDATE meta SET value = NULL WHERE key = 'knot'")
    refused(written, "knot is not JSON")


def test_tables_that_share_their_pages(written: Path) -> None:
    alter(written, "PRAGMA writable_schema=ON", "UPDATE sqlite_master SET rootpage = 1 WHERE name = 'row'")
    refused(written, "is damaged|is missing")


def test_a_row_that_changes_after_the_file_was_opened(written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with open_programme(written) as file:
        monkeypatch.setattr(programme_file, "unpacked_row", lambda *_: None)
        with pytest.raises(LoomError, match="row 5 is damaged"):
            file.operations(5)


def test_json_of_an_inspection_is_json(written: Path) -> None:
    assert json.loads(json_text(inspect_programme(written, 5).as_json()))["rows"] == ROWS


def test_a_row_of_many_runs_is_printed_in_part(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.ilmek"
    random = np.random.default_rng(1)
    knots = random.integers(0, 2, (4, 10_000)).astype(np.uint8)
    programme = small_programme(4, 10_000, 1, 2)
    again = make_programme(knots, 2, 1, Times(2.0, 0.0, 1.0, 69.8), bobbins=programme.setup.wefts)
    write_programme(path, CompiledProgramme(programme.setup, again))
    show_row(inspect_programme(path, 1))
    assert "more: see --json" in capsys.readouterr().out


@pytest.mark.parametrize(
    "knots",
    [np.zeros((4, 4), np.int64), np.zeros(9, np.uint8), np.zeros((1, 250_001), np.uint8)],
    ids=["not bytes", "one dimension", "too wide"],
)
def test_a_chart_that_no_kernel_may_get(knots: Any) -> None:
    with pytest.raises(LoomError):
        make_programme(knots, 2, 1, Times(2.0, 0.5, 0.02, 12.0))


@pytest.mark.parametrize("name", ["\x1b[31m", "x" * 201, " wool", ""])
def test_a_setup_that_could_not_be_read_is_not_written(tmp_path: Path, name: str) -> None:
    yarns = tuple(Yarn(text, (0, 0, 0), (0.0, 0.0, 0.0), 2.5) for text in ("a", "b", name))
    with pytest.raises(IlmekError):
        write_programme(tmp_path / "a.ilmek", small(yarns=yarns))
    assert not list(tmp_path.iterdir())
