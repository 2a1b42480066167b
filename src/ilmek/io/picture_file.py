"""The bytes of a picture's file, and what can be checked of them before a decoder sees them.

A decoder reads from a `MeteredBytes`, which limits the number of reads: a header with millions of entries ends in an
error, not in hours of work.
"""

import contextlib
import difflib
import io
import logging
import re
import struct
import threading
import warnings
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np
from PIL import Image, ImageFile

from ilmek.errors import PictureError
from ilmek.io.regular_file import open_regular
from ilmek.progress import SILENT, Progress

MOST_BYTES = 500_000_000
"""Largest size of a picture's file [bytes]: more than 150 megapixels of 24 bits without compression."""

MOST_EXIF = 65_536
"""Largest size of the EXIF data that are read [bytes]: one segment of a JPEG file, the most that cameras write."""

_BLOCK = 1 << 24
_MOST_CHUNKS = 200_000
"""Largest number of chunks of a PNG file; at 8 kB each they are more than three times MOST_BYTES."""

_MOST_STRIPS = 200_000
"""Largest number of strips or tiles of a TIFF file."""

_STRIPS, _TILES = 273, 324


_LOCK = threading.RLock()

logging.getLogger("PIL").addHandler(logging.NullHandler())  # else Pillow's messages go to the error stream


class DamagedError(Exception):
    """The structure of a picture's file is damaged; the message completes "... is damaged or truncated"."""


class MeteredBytes(io.BytesIO):
    """The bytes of a file with a limit on the work of reading them: `read` raises DamagedError when the reads or the
    bytes allowed by `allow` are used up.

    size      of the file [bytes]
    furthest  the end of what was read
    """

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self.size, self.furthest = len(data), 0
        self._reads = self._bytes = 0

    def allow(self, reads: int, size: int) -> None:
        """Allow this many reads and bytes from now on."""
        self._reads, self._bytes = reads, size

    def read(self, size: int | None = -1, /) -> bytes:
        """As `io.BytesIO.read`."""
        found = super().read(size)
        self._reads -= 1
        self._bytes -= len(found)
        if self._reads < 0 or self._bytes < 0:
            raise DamagedError("its header has too many entries")
        self.furthest = max(self.furthest, self.tell())
        return found


@contextlib.contextmanager
def pillow_settings(largest: int) -> Iterator[None]:
    """Pillow refuses pictures above `largest` pixels, also those inside others (ICO, DCX), and cut files. It warns of
    nothing.

    The settings are global; they are put back at the end.
    """
    with _LOCK, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the notes of `read_picture` cover Pillow's warnings
        warnings.simplefilter("error", Image.DecompressionBombWarning)
        before = Image.MAX_IMAGE_PIXELS, ImageFile.LOAD_TRUNCATED_IMAGES
        Image.MAX_IMAGE_PIXELS, ImageFile.LOAD_TRUNCATED_IMAGES = largest, False
        try:
            yield
        finally:
            Image.MAX_IMAGE_PIXELS, ImageFile.LOAD_TRUNCATED_IMAGES = before


def read_bytes(path: Path, progress: Progress = SILENT) -> bytes:
    """The bytes of a picture's file, which is opened once and checked before it is read.

    Raises PictureError unless it is a regular file of 1 to MOST_BYTES bytes; a pipe or a device is not waited for.
    """
    try:
        if not path.is_file():
            raise PictureError(_not_a_file(path), do="give the path of a picture")
        file, size = open_regular(path)
        with file:
            if size > MOST_BYTES:
                given, allowed = f"{path} has {size / 1e6:,.0f} MB", f"at most {MOST_BYTES // 1_000_000} MB"
                raise PictureError(given, allowed=allowed, do="scale the picture down, or save it as PNG or JPEG")
            data = _read_up_to(file, size, progress)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise PictureError(f"{path} cannot be read ({reason})") from None
    if not data:
        raise PictureError(f"{path} is empty", do="use a PNG, JPEG, TIFF, WebP, BMP or GIF file")
    return data


def _read_up_to(file: BinaryIO, size: int, progress: Progress) -> bytes:
    """The first `size` bytes; what is appended to the file in the meantime is not read."""
    data = bytearray()
    while len(data) < size and (block := file.read(min(_BLOCK, size - len(data)))):
        data += block
        progress(len(data) / size)
    return bytes(data)


def _not_a_file(path: Path) -> str:
    if path.is_dir():
        return f"{path} is a folder, not a picture"
    if path.exists():
        return f"{path} is not a file"
    if path.is_symlink():
        return f"{path} is a broken link"
    folder = path.parent
    near = difflib.get_close_matches(path.name, [p.name for p in folder.iterdir()], 1) if folder.is_dir() else []
    return f"{path} does not exist" + (f" (did you mean {folder / near[0]}?)" if near else "")


def check_structure(data: bytes, progress: Progress = SILENT) -> None:
    """Check what decoders do not: checksums of a PNG, segments of a JPEG, sizes of a TIFF directory.

    Raises DamagedError, and Cancelled. Of other formats nothing is checked.
    """
    if data.startswith(b"\x89PNG\r\n\x1a\n"):
        _check_png(data, progress)
    elif data.startswith(b"\xff\xd8\xff"):
        _check_jpeg(data)
    elif data[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
        _check_tiff(data)


def _check_png(data: bytes, progress: Progress) -> None:
    """Raise DamagedError for a chunk whose checksum is wrong, and for more than _MOST_CHUNKS."""
    view, at = memoryview(data), 8
    for _ in range(_MOST_CHUNKS):
        if at + 12 > len(data):
            return  # the decoder notices what is missing
        (length,) = struct.unpack_from(">I", data, at)
        end = at + 8 + length
        if end + 4 > len(data):
            return
        if zlib.crc32(view[at + 4 : end]) != struct.unpack_from(">I", data, end)[0]:
            raise DamagedError(f"checksum of the chunk at byte {at}")
        if data[at + 4 : at + 8] == b"IEND":
            return
        at = end + 4
        progress(at / len(data))
    raise DamagedError(f"more than {_MOST_CHUNKS:,} chunks")


_AFTER_A_SCAN = frozenset((0xC4, 0xD9, 0xDA, 0xDB, 0xDC, 0xDD, 0xFE, *range(0xE0, 0xF0)))
"""JPEG markers that may end a scan: tables, end, next scan, number of lines, restart interval, comment, application."""


def _check_jpeg(data: bytes) -> None:
    """Raise DamagedError for a JPEG without end or with markers inside a scan that cannot be there, or whose restart
    markers are out of order; and for EXIF data above MOST_EXIF, which Pillow reads unasked.    [ITU-T T.81, B.1.1]
    """
    at, exif = 2, 0
    while True:
        while data[at : at + 2] == b"\xff\xff":
            at += 1
        if at + 4 > len(data) and data[at : at + 2] != b"\xff\xd9":
            raise DamagedError("it has no end")
        if data[at] != 0xFF:
            raise DamagedError(f"no marker at byte {at}")
        marker = data[at + 1]
        if marker == 0xD9:
            return
        (length,) = struct.unpack_from(">H", data, at + 2)
        exif += length if marker == 0xE1 and data[at + 4 : at + 8] == b"Exif" else 0
        if exif > MOST_EXIF + 2:
            raise DamagedError(f"more than {MOST_EXIF} bytes of EXIF data")
        at += 2 + length
        if marker == 0xDA:
            at = _end_of_scan(data, at)


def _end_of_scan(data: bytes, start: int) -> int:
    """Position of the marker after the coded bytes of a scan. Raises DamagedError for one that cannot be there."""
    restarts = 0
    for first in range(start, len(data) - 1, _BLOCK):
        block = np.frombuffer(data, np.uint8, min(_BLOCK + 1, len(data) - first), first)
        second = block[1:]
        for at in np.flatnonzero((block[:-1] == 0xFF) & (second != 0) & (second != 0xFF)).tolist():
            marker = int(second[at])
            if not 0xD0 <= marker <= 0xD7:
                if marker not in _AFTER_A_SCAN:
                    raise DamagedError(f"marker {marker:02X} at byte {first + at}")
                return first + at
            if marker != 0xD0 + restarts % 8:
                raise DamagedError(f"restart marker at byte {first + at}")
            restarts += 1
    raise DamagedError("it has no end")


def _check_tiff(data: bytes) -> None:
    """Raise DamagedError where the first directory has more strips or tiles than _MOST_STRIPS."""
    order, big = "<" if data[:1] == b"I" else ">", 43 in data[2:4]
    offset, count, entry, step = ("Q", "Q", "HHQ", 20) if big else ("I", "H", "HHI", 12)
    try:
        (at,) = struct.unpack_from(order + offset, data, 8 if big else 4)
        (entries,) = struct.unpack_from(order + count, data, at)
        at += 8 if big else 2
        for number in range(min(entries, 65_535)):
            tag, _, values = struct.unpack_from(order + entry, data, at + step * number)
            if tag in (_STRIPS, _TILES) and values > _MOST_STRIPS:
                raise DamagedError(f"more than {_MOST_STRIPS:,} strips")
    except (struct.error, OverflowError):
        raise DamagedError("its directory is incomplete") from None


def shortened(error: Exception) -> str:
    """The message of a library's error, without what follows in brackets, at most 120 characters."""
    message = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return re.sub(r"\s*\(.*\)$", "", message.split("\n")[0])[:120] or "its decoder fails"
