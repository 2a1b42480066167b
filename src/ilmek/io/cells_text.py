"""The map of a chart's cells as text, in files that carry the chart's facts: JSON of its kinds, and the index of each
cell, row by row from the top, 8 bits each, as base64 of zlib.
"""

import base64
import binascii
import json
import zlib
from dataclasses import asdict, fields

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.cells import CARVED, TALLEST, Carving, CellKind, CellMap
from ilmek.carpet.codes import CODES
from ilmek.errors import LoomError, shortened
from ilmek.io.meta_entry import MetaEntry

_LONGEST = 150_000_000
"""Largest number of characters of a map."""


def cells_text(cells: CellMap | None) -> str:
    """The map as text; "" for a chart without one."""
    if cells is None:
        return ""
    index = base64.b64encode(zlib.compress(cells.index.tobytes(), 9)).decode("ascii")
    carving = {} if cells.carving is None else {"carving": asdict(cells.carving)}
    kinds = [asdict(kind) for kind in cells.kinds]
    return json.dumps({"kinds": kinds, "index": index, **carving}, ensure_ascii=False)


def read_cells(text: str, knots: Indices) -> CellMap | None:
    """The map of a text that `cells_text` wrote, for these knots. Raises an IlmekError."""
    if not text:
        return None
    if len(text) > _LONGEST:
        raise LoomError(f"its map of cells has {len(text):,} characters", allowed=f"at most {_LONGEST:,}")
    try:
        data = json.loads(text)
        given = MetaEntry("cells", data).table("kinds", "index", optional=("carving",))
        packed = base64.b64decode(str(given["index"].value), validate=True)
        reader = zlib.decompressobj()
        raw = reader.decompress(packed, knots.size + 1)
    except (ValueError, RecursionError, binascii.Error, zlib.error) as error:
        raise LoomError(f"its map of cells is damaged ({shortened(str(error), 100)})") from None
    if len(raw) != knots.size or not reader.eof:
        raise LoomError("its map of cells is damaged", allowed=f"{knots.size:,} cells")
    kinds = tuple(_kind(entry) for entry in given["kinds"].rows(1, CODES - 1))
    return CellMap(np.frombuffer(raw, np.uint8).reshape(knots.shape), kinds, _carving(given["carving"]))


def _carving(entry: MetaEntry) -> Carving | None:
    """The lines carved into the pile, if there are any."""
    if entry.value is None:
        return None
    given = entry.table("depth", "angle", "yarns")
    names = tuple(name.text(least=1) for name in given["yarns"].rows(0, CODES))
    return Carving(given["depth"].number(0.0, TALLEST), given["angle"].number(*CARVED), names)


def _kind(entry: MetaEntry) -> CellKind:
    """A kind of cells."""
    given = entry.table(*(field.name for field in fields(CellKind)))
    height, loop = given["height"], given["loop"]
    if type(loop.value) is not bool:
        loop.refuse("true or false")
    high = None if height.value is None else height.number(0.0, TALLEST)
    return CellKind(given["name"].text(least=1), given["weave"].text(), high, loop.value)
