"""Valid files of every format, from which inputs are made: the examples, and small files of ilmek and Pillow."""

import io
import json
import sqlite3
import tempfile
import tomllib
import warnings
import zlib
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from PIL import Image, UnidentifiedImageError, features

from fuzz.case import MINE, OLD
from fuzz.mutations import changed_bytes, changed_text, changed_tree, scalar
from ilmek.io.cyclogram_file import cyclogram_toml
from ilmek.io.programme_file import write_programme
from ilmek.io.programme_text import programme_text_parts
from ilmek.jobs.chart import make_charted
from ilmek.jobs.cyclogram import find
from ilmek.jobs.loom import params_for, read_loom_order
from ilmek.jobs.loom_setup import CarpetPile, loom_setup
from ilmek.jobs.order import read_order
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.programme import make_programme
from ilmek.machines.automated_loom import MACHINE, design

ROOT = Path(__file__).parents[3]
CYCLOGRAMS = ("weaver", "automated-loom:row", "automated-loom:knot")
SIZE, QUALITY = "40x20cm", "5x10/dm"

YARNS_CSV = (
    b"name,srgb,nm,price\nmadder,#8a2b1d,2.4,30\nindigo,#1d2f5a,2.4,32\nivory,#efe6d2,2.4,28\nblack,#1a1715,2.4,28\n"
)
PATH_CSV = b"x [mm],y [mm]\n5.0,9.0\n5.0,-3.0\n2.6,-3.0\n2.6,3.0\n9.0,3.0\n9.0,-4.0\n6.8,-4.0\n6.8,9.0\n"
VALUES = (
    b"30deg\n",
    b"12 mm",
    b"(12mm,4mm) (18.5mm,9.5mm) (25mm,4mm)\n",
    b"bearing each = 9\nservo per W = 1\n",
    b"2\n",
)

_FORMATS: dict[str, tuple[str, dict[str, Any]]] = {
    "rgb.png": ("RGB", {}),
    "palette.png": ("P", {}),
    "grey16.png": ("I;16", {}),
    "clear.png": ("RGBA", {"dpi": (300, 300)}),
    "bits.png": ("1", {}),
    "rgb.jpg": ("RGB", {"quality": 70}),
    "cmyk.jpg": ("CMYK", {}),
    "grey.jpg": ("L", {"progressive": True}),
    "raw.tif": ("RGB", {}),
    "lzw.tif": ("RGB", {"compression": "tiff_lzw"}),
    "fax.tif": ("1", {"compression": "group4"}),
    "deflate.tif": ("CMYK", {"compression": "tiff_adobe_deflate"}),
    "jpeg.tif": ("RGB", {"compression": "jpeg"}),
    "rgb.bmp": ("RGB", {}),
    "rgb.dib": ("RGB", {}),
    "few.gif": ("P", {}),
    "rgb.webp": ("RGB", {"lossless": True}),
    "rgb.avif": ("RGB", {}),
    "rgb.jp2": ("RGB", {}),
    "rgb.ppm": ("RGB", {}),
    "grey.pgm": ("L", {}),
    "rgb.tga": ("RGB", {"compression": "tga_rle"}),
    "rgb.pcx": ("RGB", {}),
    "rgb.ico": ("RGBA", {}),
    "rgb.icns": ("RGBA", {}),
    "rgb.qoi": ("RGB", {}),
    "rgb.sgi": ("RGB", {}),
    "bits.xbm": ("1", {}),
    "bits.msp": ("1", {}),
    "rgb.im": ("RGB", {}),
    "float.spider": ("F", {"format": "SPIDER"}),
    "rgb.dds": ("RGB", {}),
    "few.blp": ("P", {}),
}


def old_result(draw: Random) -> dict[str, bytes]:
    """The files of a folder that ilmek wrote, mostly with a file that is foreign or changed, or a wrong manifest."""
    files = {"chart.json": b"{}", "yarn.csv": b"yarn\n"}
    listed = {name: {"size": len(data), "sha256": sha256(data).hexdigest()} for name, data in files.items()}
    manifest = json.dumps({"ilmek": 1, "files": listed}).encode()
    kind = draw.randrange(5)
    if kind == 1:
        files[MINE] = b"mine"
    elif kind == 2:
        files["yarn.csv"] = b"mine"
    elif kind == 3:
        manifest = changed_text(draw, manifest.decode()).encode("utf-8", "replace")
    elif kind == 4:
        manifest = changed_bytes(draw, manifest)
    return {f"{OLD}/{name}": data for name, data in {**files, ".ilmek": manifest}.items()}


@dataclass(frozen=True)
class Corpus:
    """Contents of valid files by name, and of the trees of those that hold one."""

    pictures: dict[str, bytes]
    mechanisms: dict[str, Any]
    cyclograms: dict[str, Any]
    texts: dict[str, bytes]
    yarns: dict[str, Any]
    programme: bytes
    programme_text: str
    loom: dict[str, Any]


def make_corpus() -> Corpus:
    """The same in every process."""
    pictures = dict(_pictures())
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder) / "rgb.png"
        picture.write_bytes(pictures["rgb.png"])
        order = read_order(picture, size=SIZE, quality=QUALITY, colours=5)
        charted = make_charted(order)
        chart, made = charted.chart, design(params_for(read_loom_order(order), charted))
        carpet = CarpetPile(chart, charted.knot_yarns)
        by_two = make_programme(
            chart.knots, len(chart.yarns), 2, made.times, bobbins=made.bobbins, supply=carpet.supply(made.params)
        )
        setup = loom_setup(made, carpet, by_two)
        compiled = CompiledProgramme(setup, by_two)
        write_programme(Path(folder) / "programme.ilmek", compiled)
        text = b"".join(programme_text_parts(compiled)).decode()
        programme = (Path(folder) / "programme.ilmek").read_bytes()
    loom = json.loads(json.dumps(MACHINE.report(made, illustrated=False, assembled=False).as_json()))
    examples = {path.name: path.read_bytes() for path in sorted((ROOT / "examples").glob("*.toml"))}
    examples |= {f"{name.replace(':', '-')}.toml": cyclogram_toml(find(name, {})).encode() for name in CYCLOGRAMS}
    trees = {name: tomllib.loads(text.decode()) for name, text in examples.items()}
    return Corpus(
        pictures,
        {name: tree for name, tree in trees.items() if "joints" in tree},
        {name: tree for name, tree in trees.items() if "tracks" in tree},
        examples,
        trees["wool.toml"],
        programme,
        text,
        {name: loom[name] for name in ("machine", "parameters", "results", "machines")},
    )


def _pictures() -> Iterator[tuple[str, bytes]]:
    noise = np.random.default_rng(5).integers(0, 256, (3, 4, 3), dtype=np.uint8)
    whole = Image.fromarray(noise).resize((32, 24), Image.Resampling.BICUBIC)
    Image.init()
    for name, (mode, options) in _FORMATS.items():
        written = io.BytesIO()
        kind = {"jpg": "JPEG", "tif": "TIFF", "jp2": "JPEG2000", "pgm": "PPM"}.get(name[-3:], name.rpartition(".")[2])
        options = {"format": kind.upper(), **options}
        if options["format"] not in Image.SAVE or (options["format"] == "AVIF" and not features.check("avif")):
            continue
        made = Image.fromarray(np.asarray(whole.convert("L")).astype(np.uint16) * 257) if mode == "I;16" else whole
        try:
            with warnings.catch_warnings(action="ignore"):  # formats that Pillow will drop
                (made if made.mode == mode else made.convert(mode)).save(written, **options)
        except (OSError, ValueError, UnidentifiedImageError):  # this Pillow was built without the format
            continue
        yield name, written.getvalue()


def changed_png(draw: Random, content: bytes) -> bytes:
    """A PNG with changed chunks whose checksums hold."""
    chunks, at = [], 8
    while at + 8 <= len(content):
        length = int.from_bytes(content[at : at + 4], "big")
        chunks.append((content[at + 4 : at + 8], content[at + 8 : at + 8 + length]))
        at += 12 + length
    index = draw.randrange(len(chunks))
    name, data = chunks[index]
    change = draw.randrange(5)
    if change == 0 and name == b"IDAT":
        data = zlib.compress(changed_bytes(draw, zlib.decompress(data)))
    elif change == 1:
        name = draw.choice((b"iCCP", b"eXIf", b"tRNS", b"gAMA", b"zTXt", b"acTL", b"fdAT", b"PLTE", b"sRGB"))
        chunks.insert(index, (name, data))
    elif change == 2:
        chunks.insert(draw.randrange(len(chunks)), (name, data))
    elif change == 3:
        del chunks[index]
    else:
        chunks[index] = name, changed_bytes(draw, data)
    body = [
        len(data).to_bytes(4, "big") + name + data + zlib.crc32(name + data).to_bytes(4, "big") for name, data in chunks
    ]
    return content[:8] + b"".join(body)


_ENDLESS = "WITH RECURSIVE n(number) AS (SELECT 0 UNION ALL SELECT number + 1 FROM n)"
_STATEMENTS = (
    "CREATE VIEW row2 AS SELECT * FROM row",
    "DROP TABLE row",
    "DROP TABLE meta",
    "DELETE FROM row WHERE number = 3",
    "UPDATE row SET number = number + 1000000",
    "UPDATE row SET time = 'soon'",
    "UPDATE row SET time = 9e999",
    "UPDATE row SET data = NULL WHERE number = 2",
    "UPDATE row SET data = 'text'",
    "UPDATE row SET data = zeroblob(1000000)",
    "INSERT INTO meta VALUES ('more', '[[[[[[[[')",
    "DELETE FROM meta",
    "UPDATE meta SET value = x'ff00'",
    "PRAGMA user_version = 99",
    "PRAGMA application_id = 7",
    "CREATE TRIGGER t AFTER INSERT ON row BEGIN SELECT 1; END",
    f"ALTER TABLE row RENAME TO old; CREATE VIEW row AS {_ENDLESS} SELECT number, 0.0 AS time, x'00' AS data FROM n",
    "ALTER TABLE meta RENAME TO old; CREATE VIEW meta AS SELECT key, value FROM old",
    "INSERT INTO row SELECT number + 100000, time, data FROM row",
    "CREATE INDEX i ON row (abs(time))",
    "ALTER TABLE row ADD COLUMN more TEXT DEFAULT 'x'",
)


def changed_programme(draw: Random, content: bytes) -> bytes:
    """A programme with changed entries, rows or tables; or its bytes changed."""
    if draw.random() < 0.15:
        return changed_bytes(draw, content)
    with closing(sqlite3.connect(":memory:")) as base:
        base.deserialize(content)
        base.row_factory = None
        for _ in range(draw.choice((1, 1, 2))):
            try:
                tables = base.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
                if not {("meta",), ("row",)} <= set(tables):
                    break
                if not all(base.execute(f"SELECT 1 FROM {table} LIMIT 1").fetchone() for (table,) in tables):
                    break
                (_change_meta if draw.random() < 0.55 else _change_row)(draw, base)
                if draw.random() < 0.25:
                    base.executescript(draw.choice(_STATEMENTS))
            except (sqlite3.Error, zlib.error, ValueError, RecursionError):  # an earlier change took it away
                break
        base.commit()
        return bytes(base.serialize())


def _change_meta(draw: Random, base: sqlite3.Connection) -> None:
    key, value = draw.choice(base.execute("SELECT key, value FROM meta ORDER BY key").fetchall())
    changed = json.dumps(changed_tree(draw, [json.loads(value)])[:1])[1:-1]
    value = scalar(draw) if draw.random() < 0.1 else changed
    base.execute("UPDATE meta SET value = ? WHERE key = ?", (value.encode("utf-8", "replace").decode(), key))


def _change_row(draw: Random, base: sqlite3.Connection) -> None:
    number, data = draw.choice(base.execute("SELECT number, data FROM row ORDER BY number LIMIT 6").fetchall())
    kind = draw.random()
    if not isinstance(data, bytes):  # an earlier change
        data = b""
    elif kind < 0.6:
        plain = zlib.decompress(data)
        some = bytes(draw.choice((0, 1, 2, 15, 16, 127, 128, 255)) if draw.random() < 0.1 else one for one in plain)
        data = zlib.compress(some if draw.random() < 0.5 else changed_bytes(draw, plain))
    elif kind < 0.65:
        data = zlib.compress(bytes(30_000_000))
    else:
        data = changed_bytes(draw, data)
    base.execute("UPDATE row SET data = ? WHERE number = ?", (data, number))
