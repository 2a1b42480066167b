"""PSD and PSB files whose layers were saved without the picture that they make, by psd-tools.

A PSD file of 8 or more bits has its layers and, unless its program was told otherwise, also the picture that they make
together. That picture is read by Pillow. Where the file says that it is not there, the layers are put together.

Format: Adobe Photoshop File Formats Specification: image resource 1057, version info.
"""

import io
import struct
from importlib import import_module
from pathlib import Path

import numpy as np

from ilmek.errors import PictureError
from ilmek.io.picture_file import shortened
from ilmek.io.rendered.resolution import LARGEST, png_bytes

_VERSION_INFO = 1057
_HEADER = 26
"""Bytes of the header."""

_LARGE = b"\0\2"
"""Version in the header of a PSB file."""


def merge_layers(path: Path, data: bytes) -> tuple[bytes, tuple[str, ...]] | None:
    """A PNG file of the layers with their transparency, and a note; None: the file has the picture that they make.

    Raises PictureError for layers that cannot be put together, and ImportError without the extra.
    """
    if len(data) < _HEADER or not needs_merging(data):
        return None
    height, width = struct.unpack_from(">II", data, 14)
    if width * height > LARGEST:
        given, allowed = f"{path} is {width} x {height} pixels", f"at most {LARGEST // 1_000_000} megapixels of layers"
        raise PictureError(given, allowed=allowed, do="save it as PNG")
    reader = import_module("psd_tools").PSDImage
    try:
        merged = reader.open(io.BytesIO(data)).composite()
    except ImportError:
        raise
    except Exception as error:
        # A reader may raise any error for a damaged file.
        raise PictureError(f"{path} is damaged ({shortened(error)})", do="save it as PNG") from None
    if merged is None:
        raise PictureError(f"{path} has no visible layer", do="show one, or save it as PNG")
    return png_bytes(np.asarray(merged.convert("RGBA"))), ("its layers are put together: it has no merged picture",)


def is_large(data: bytes) -> bool:
    """Whether a file is a PSB file, by its version."""
    return data[4:6] == _LARGE


def needs_merging(data: bytes) -> bool:
    """Whether the layers of a file must be put together: Pillow reads only PSD files that have their picture."""
    return is_large(data) or not has_merged(data)


def has_merged(data: bytes) -> bool:
    """Whether a PSD file has the picture that its layers make; it has unless it says otherwise."""
    try:
        (colours,) = struct.unpack_from(">I", data, 26)
        at = 30 + colours
        (size,) = struct.unpack_from(">I", data, at)
        at, end = at + 4, at + 4 + size
        while at < end and data[at : at + 4] == b"8BIM":
            (number, name) = struct.unpack_from(">HB", data, at + 4)
            at += 7 + name + (name + 1) % 2
            (size,) = struct.unpack_from(">I", data, at)
            if number == _VERSION_INFO:
                return bool(data[at + 8])
            at += 4 + size + size % 2
    except (struct.error, IndexError):
        pass  # the decoder tells what is wrong
    return True
