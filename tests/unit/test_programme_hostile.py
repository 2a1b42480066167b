"""Programme files of others: whatever is in them, opening them gives one LoomError, in bounded time and memory."""

import json
import os
import resource
import sqlite3
import zlib
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.cli.inspect import show_row
from ilmek.errors import IlmekError, LoomError
from ilmek.io import programme_file, sqlite_readonly
from ilmek.io.json_file import json_text
from ilmek.io.programme_file import ProgrammeFile, open_programme, write_programme
from ilmek.io.programme_meta import Label
from ilmek.jobs.inspect import inspect_programme
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.programme import Times, make_programme
from ilmek.loom.row import KnotRow
from ilmek.loom.schedule import PASSES
from ilmek.loom.sharing import halves, share
from ilmek.machines.weaver import WeaverParams, design

ROWS, COLUMNS, HEADS, YARNS = 12, 20, 3, 3
PARTS = 2 * HEADS
TIMES = Times(2.0, 0.5, 0.02, 12.0)
BOBBINS = (Bobbin("straight weft", 4, 60.0), Bobbin("sinuous weft", 5, 60.0))


@pytest.fixture(scope="module")
def content(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("written") / "a.ilmek"
    knots = np.random.default_rng(3).integers(0, YARNS, (ROWS, COLUMNS)).astype(np.uint8)
    yarns = tuple(Yarn(f"wool {k}", (k, 2 * k, 255), (50.5, 1.0, -3.25), 2.5, 2) for k in range(YARNS))
    cyclograms = (design(WeaverParams()).cyclogram,)
    label = Label(CarpetSize(0.08, 0.048), Quality(250.0, 250.0), "symmetric", yarns, 0.002, cyclograms)
    write_programme(path, make_programme(knots, YARNS, HEADS, TIMES, bobbins=BOBBINS), label)
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


def set_row(path: Path, number: int, change: Callable[[bytearray], object]) -> None:
    """Change the colours and keys of a row."""
    connection = sqlite3.connect(path, isolation_level=None)
    (data,) = connection.execute("SELECT data FROM row WHERE number = ?", (number,)).fetchone()
    raw = bytearray(zlib.decompress(data))
    change(raw)
    connection.execute("UPDATE row SET data = ? WHERE number = ?", (zlib.compress(raw), number))
    connection.close()


RECURSIVE = """CREATE VIEW row (number, time, data) AS WITH RECURSIVE n (k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n)
    SELECT k, 1.0, zeroblob(9) FROM n"""


@pytest.mark.parametrize(
    "statements",
    [
        ("DROP TABLE row", RECURSIVE),
        ("CREATE VIEW v AS SELECT 1",),
        ("CREATE INDEX i ON row (time)",),
        ("CREATE TRIGGER t AFTER INSERT ON row BEGIN SELECT 1; END",),
        ("CREATE VIRTUAL TABLE f USING fts5 (x)",),
        ("CREATE TABLE more (x)",),
        ("ALTER TABLE row ADD COLUMN x",),
        ("DROP TABLE row", "CREATE TABLE row (number INTEGER PRIMARY KEY, time REAL, data BLOB)"),
    ],
    ids=["recursive view", "view", "index", "trigger", "virtual table", "table", "column", "other types"],
)
def test_a_schema_that_ilmek_does_not_write(written: Path, statements: tuple[str, ...]) -> None:
    alter(written, *statements)
    refused(written, "other tables than meta and row|authorized|malformed|too many columns")


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


@pytest.mark.parametrize("size", [2_000_000, 900_000])
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
        assert file.rows == ROWS


DEEP = "[" * 100_000


@pytest.mark.parametrize(
    ("key", "change", "said"),
    [
        ("edges", put(1, 10**12), r"edges\[1\] is"),
        ("edges", put(1, 4), "edges are not those"),
        ("edges", lambda _: [0, 20], "edges is a list"),
        ("heads", lambda _: 10**18, "heads is"),
        ("heads", lambda _: True, "heads is true"),
        ("heads", lambda _: 2, "edges is a list"),
        ("columns", lambda _: 250_000, "edges"),
        ("rows", lambda _: 10**4000, "rows is"),
        ("rows", lambda _: 250_000, "totals"),
        ("times", put("knot", float("nan")), r"times\.knot is nan"),
        ("times", put("knot", 0), "time of knot 0 s"),
        ("times", put("weft", -1), r"times\.weft is -1"),
        ("times", put("more", 1), "times is a table"),
        ("bobbins", lambda _: {}, "bobbins is a table"),
        ("bobbins", lambda bobbins: bobbins * 9, "a list of 18; a list of 0 to 4"),
        ("bobbins", lambda bobbins: bobbins * 2, "two bobbins"),
        ("bobbins", lambda bobbins: bobbins[:1], "weaving time is not the sum of its rows and stops"),
        ("bobbins", put(0, "rows", 0), r"bobbins\[0\]\.rows is 0"),
        ("bobbins", put(0, "rows", 4.0), r"bobbins\[0\]\.rows is 4\.0"),
        ("bobbins", put(0, "time", -1), r"bobbins\[0\]\.time is -1"),
        ("bobbins", put(1, "yarn", ""), r"bobbins\[1\]\.yarn"),
        ("bobbins", put(1, "more", 1), r"bobbins\[1\] is a table"),
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
        ("yarns", put(0, "metric_count", 0), "nm 0"),
        ("yarns", lambda yarns: yarns[:1], "yarns is a list"),
        ("yarns", lambda yarns: [*yarns, *yarns], "both named|counts"),
        ("totals", put("duration", 1e300), "weaving time is not that"),
        ("totals", put("changes", 7), "totals are not those"),
        ("totals", lambda totals: totals | {"counts": totals["counts"][::-1]}, "knots of its yarns"),
        ("work", put("busy", 0, 1e300), "working times"),
        ("work", put("passes", 0, 35), "passes of its heads"),
        ("work", put("knots", 0, -1), r"work\.knots\[0\] is -1"),
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


@pytest.mark.parametrize(
    ("at", "value"),
    [(0, 255), (0, YARNS), (COLUMNS, 2), (COLUMNS + 1, 255), (COLUMNS + 1, YARNS), (COLUMNS + 2, 254)],
    ids=["colour 255", "unknown yarn", "order", "first colour 255", "first colour", "last colour"],
)
def test_a_row_that_no_schedule_gives(written: Path, at: int, value: int) -> None:
    set_row(written, 5, put(at, value))
    refused(written, "row 5 is damaged")


@pytest.mark.parametrize("change", [lambda raw: raw.append(0), lambda raw: raw.pop(), lambda raw: raw.clear()])
def test_a_row_of_another_length(written: Path, change: Callable[[bytearray], object]) -> None:
    set_row(written, 5, change)
    refused(written, "row 5 is damaged")


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("UPDATE row SET data = data || x'00' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET time = 9e999 WHERE number = 5", "row 5 has an impossible time"),
        ("UPDATE row SET time = -1 WHERE number = 5", "row 5 has an impossible time"),
        ("UPDATE row SET time = 'x' WHERE number = 5", "row 5 is damaged"),
        ("UPDATE row SET time = time + 1 WHERE number = 5", "sum of its rows"),
        ("UPDATE row SET number = 1000 WHERE number = 11", "row 11 is missing"),
        ("UPDATE row SET number = -1 WHERE number = 0", "row 0 is missing"),
        ("INSERT INTO row SELECT 12, time, data FROM row LIMIT 1", "more rows"),
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
    changed = zlib.compress(b"\xfe" * (COLUMNS + 3 * PARTS))
    with open_programme(written) as file:
        monkeypatch.setattr(ProgrammeFile, "_stored", lambda *_: (0.0, changed))
        with pytest.raises(LoomError, match="order of tying"):
            file.row(5)


def test_json_of_an_inspection_is_json(written: Path) -> None:
    assert json.loads(json_text(inspect_programme(written, 5).as_json()))["rows"] == ROWS


def test_a_row_of_many_runs_is_printed_in_part(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.ilmek"
    yarns = tuple(Yarn(f"wool {k}", (k, k, k), (0.0, 0.0, 0.0), 2.5) for k in range(2))
    label = Label(CarpetSize(1.0, 0.01), Quality(5000.0, 5000.0), "symmetric", yarns, 0.0001)
    chart = np.tile(np.array([0, 1], np.uint8), (2, 2500))
    quick_changes = Times(2.0, 0.0, 1.0, 12.0)
    write_programme(path, make_programme(chart, 2, 1, quick_changes), label)
    show_row(inspect_programme(path, 1))
    assert "… 1,000 more: see --json" in capsys.readouterr().out


def test_what_is_accepted_is_replayed_within_the_row() -> None:
    random = np.random.default_rng(1)
    accepted = 0
    for _ in range(400):
        heads, columns = int(random.integers(1, 4)), int(random.integers(6, 20))
        edges = share(columns, heads)
        colours = random.choice(np.array([0, 1, 254], np.uint8), columns)
        parts = [colours[low:high] for low, high in pairwise(edges)]
        keys = np.array([(PASSES, *random.permutation(np.resize(np.unique(part), 4))[:2]) for part in parts], np.uint8)
        try:
            row = KnotRow(0, colours, keys, edges, heads)
        except LoomError:
            continue
        accepted += 1
        for block, ties in zip(
            np.split(np.arange(columns), edges[halves(heads) : -1 : halves(heads)]), row.ties(), strict=True
        ):
            assert sorted(ties.pairs.tolist()) == block.tolist()
    assert accepted > 20


CHART = np.arange(2 * COLUMNS, dtype=np.uint8).reshape(2, COLUMNS) % 3
GOOD = make_programme(CHART, YARNS, HEADS, Times(2.0, 0.5, 0.02, 12.0)).row(0)


@pytest.mark.parametrize(
    "change",
    [
        {"colours": GOOD.colours.astype(np.int64)},
        {"colours": GOOD.colours[:-1]},
        {"colours": np.full(COLUMNS, 255, np.uint8)},
        {"keys": GOOD.keys[:-1]},
        {"keys": np.full((PARTS, 3), 7, np.uint8)},
        {"edges": GOOD.edges[::-1]},
        {"edges": GOOD.edges * 1000},
        {"edges": GOOD.edges.astype(np.int32)},
        {"heads": 0},
        {"heads": 10**9},
        {"number": -1},
    ],
)
def test_a_row_made_of_other_arrays(change: dict[str, Any]) -> None:
    given = {name: getattr(GOOD, name) for name in ("number", "colours", "keys", "edges", "heads")}
    with pytest.raises(LoomError):
        KnotRow(**(given | change))


@pytest.mark.parametrize(
    "knots",
    [np.zeros((4, 4), np.int64), np.zeros(9, np.uint8), np.zeros((1, 250_001), np.uint8)],
    ids=["not bytes", "one dimension", "too wide"],
)
def test_a_chart_that_no_kernel_may_get(knots: Any) -> None:
    with pytest.raises(LoomError):
        make_programme(knots, 2, 1, Times(2.0, 0.5, 0.02, 12.0))


@pytest.mark.parametrize("name", ["\x1b[31m", "x" * 201, " wool", ""])
def test_a_label_that_could_not_be_read_is_not_written(tmp_path: Path, name: str) -> None:
    yarns = tuple(Yarn(text, (0, 0, 0), (0.0, 0.0, 0.0), 2.5) for text in ("a", name))
    label = Label(CarpetSize(0.08, 0.048), Quality(250.0, 250.0), "symmetric", yarns, 0.002)
    programme = make_programme(np.zeros((4, 4), np.uint8), 2, 1, Times(2.0, 0.5, 0.02, 12.0))
    with pytest.raises(IlmekError):
        write_programme(tmp_path / "a.ilmek", programme, label)
    assert not list(tmp_path.iterdir())
