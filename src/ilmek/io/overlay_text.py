"""The overlay of a chart as text, in files that carry the chart's facts.

Base64 of zlib of three arrays, one after the other: the distance of each mark's cell from that before it, cells counted
row by row (32 bits, little-endian), the kinds, and the second yarns (8 bits each).
"""

import base64
import binascii
import zlib

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.overlay import MOST_MARKS, Overlay, no_overlay, require_fit
from ilmek.errors import LoomError

LONGEST_OVERLAY = 30_000_000
"""Largest number of characters of an overlay: more than MOST_MARKS marks take without compression."""

_BYTES = 6
"""Bytes of a mark."""


def overlay_text(overlay: Overlay, columns: int) -> str:
    """The overlay of a chart with so many knots a row as text; "" for an overlay without a mark."""
    if not len(overlay):
        return ""
    cells = overlay.rows.astype(np.int64) * columns + overlay.columns
    steps = np.diff(cells, prepend=0).astype("<i4")
    data = steps.tobytes() + overlay.kinds.tobytes() + overlay.seconds.tobytes()
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")


def read_overlay(text: str, knots: Indices, yarns: int) -> Overlay:
    """The overlay of a text that `overlay_text` wrote, for these knots. Raises an IlmekError."""
    if not text:
        return no_overlay()
    if len(text) > LONGEST_OVERLAY:
        raise LoomError("its overlay is too long", allowed=f"at most {LONGEST_OVERLAY:,} characters")
    try:
        reader = zlib.decompressobj()
        data = reader.decompress(base64.b64decode(text, validate=True), _BYTES * MOST_MARKS + 1)
    except (ValueError, binascii.Error, zlib.error):
        raise LoomError("its overlay is damaged") from None
    count, left = divmod(len(data), _BYTES)
    if left or not 0 < count <= MOST_MARKS or not reader.eof:
        raise LoomError("its overlay is damaged", allowed=f"1 to {MOST_MARKS:,} marks")
    steps = np.frombuffer(data, "<i4", count)
    cells = np.cumsum(steps, dtype=np.int64)
    kinds, seconds = (np.frombuffer(data, np.uint8, count, start * count).copy() for start in (4, 5))
    if (steps[1:] <= 0).any() or steps[0] < 0 or cells[-1] >= knots.size or not np.isin(kinds, (1, 2)).all():
        raise LoomError("its overlay has marks outside of the chart")
    rows, columns = np.divmod(cells, knots.shape[1])
    overlay = Overlay(rows.astype(np.int32), columns.astype(np.int32), kinds, seconds)
    require_fit(overlay, knots, yarns)
    return overlay
