"""Pictures of all formats that Pillow opens safely, as 8-bit sRGB, with a note on every conversion; drawings (SVG, PDF)
are rendered first [`rendered`].

Formats that start another program (EPS, WMF) or are no pictures (HDF5, GRIB, BUFR, MPEG) are excluded. A file is
untrusted: its size, structure, width, height and number of entries are checked before anything is decoded.

Memory while a picture is read: the file, 7 bytes a pixel (8 for a turned TIFF, 10 for a progressive JPEG, 20 for the
formats `WHOLE`), and some 50 MB. The result has 3 bytes a pixel.
"""

import contextlib
import re
import threading
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, UnidentifiedImageError

from ilmek.arrays import Indices, Rgb
from ilmek.carpet.codes import eight_bits
from ilmek.carpet.picture_points import Colour, read_colour
from ilmek.errors import PictureError
from ilmek.io.jpeg_quality import jpeg_loss
from ilmek.io.native_messages import native_messages
from ilmek.io.picture_file import (
    MOST_EXIF,
    DamagedError,
    MeteredBytes,
    check_structure,
    pillow_settings,
    read_bytes,
    shortened,
)
from ilmek.io.picture_pixels import srgb_pixels, turned
from ilmek.io.rendered.kind import rendered
from ilmek.io.rendered.resolution import Rendering
from ilmek.io.round_picture import share_outside
from ilmek.progress import SILENT, Cancelled, Progress
from ilmek.records import record
from ilmek.sentences import Sentence

FORMATS = (
    "PNG", "JPEG", "MPO", "TIFF", "BMP", "DIB", "GIF", "WEBP", "AVIF", "JPEG2000", "PPM", "TGA", "PCX", "DCX", "ICO",
    "ICNS", "QOI", "PSD", "SGI", "SUN", "XBM", "XPM", "MSP", "IM", "SPIDER", "DDS", "BLP",
)  # fmt: skip
"""Formats that are read, by Pillow's names. An MPO file is opened as the JPEG file that it begins with."""

SMALLEST = 8
"""Smallest width and height [pixels]."""

LARGEST = 150_000_000
"""Largest number of pixels: the memory for a chart then stays below 2 GB."""

WHOLE = ("WEBP", "AVIF", "JPEG2000", "ICNS")
"""Formats that their libraries decode in one call, with up to 20 bytes a pixel."""

LARGEST_WHOLE = 40_000_000
"""Largest number of pixels of the formats `WHOLE`."""

LARGEST_JPEG_2000 = 2_000_000
"""Largest number of pixels of JPEG 2000: its decoder holds Python's lock, 0.26 s a megapixel, while Ctrl-C waits."""

LARGEST_INTERPRETED = 4_000_000
"""Largest number of pixels where Pillow's decoder is written in Python: up to 3 s a megapixel (QOI, PPM of 16 bits)."""

MOST_INDEXED = 25_000_000
"""Largest number of pixels of an indexed picture whose indices are kept: 5,000 x 5,000 knots."""

_OPENED = [name for name in FORMATS if name != "MPO"]
_ORIENTATION = 0x0112
_ENTRIES = 20_000
"""Reads allowed for a header; each entry of a directory and each chunk takes one to four."""

_READS = 8
"""Reads a pixel of a decoder that is written in Python."""

_HEADER = 64_000_000
"""Bytes of a header that may be read, besides a file that is read whole: text, profiles, preview pictures."""

METRE = 0.0254
"""Metres per inch: Pillow gives and takes dots per inch."""

_REPORT = 0.1
"""Time between reports while a picture is decoded [s]."""

_OF_A_CODEC = re.compile(
    r"(?:tempfile\.tif|(?:Fax|CCITT|LZW|ZIP|PackBits|JPEG|OJPEG|Thunder|NeXT|LERC|LZMA|ZSTD|WebP|PixarLog|SGILog|LogLuv|Dump)\w*)"
    r": [^\x1b\r\n]+"
)
"""A message of a codec of libtiff: the others concern tags that are not used."""


@record
class Picture:
    """A picture as sRGB with 8 bits per channel, row 0 on top; notes on the conversions.

    rgb      rows x columns x 3, whole numbers 0 to 255; other integers become uint8. Raises PictureError for others
    density  pixels per metre across and along, as the file states them; None: it does not
    ground   colour behind its transparent parts; None: it has none
    outside  share of it outside of its round outline, where no ground is given for that [-]
    hidden   share of its outline that is hidden on the ground, where none is given [-]
    rim      the most frequent colour beside its outline; None: it has no transparent parts, or a ground is given
    indices  of an opaque indexed picture of at most MOST_INDEXED pixels, rows x columns; None: it is none
    """

    rgb: Rgb
    notes: tuple[str, ...] = ()
    density: tuple[float, float] | None = None
    ground: Colour | None = None
    outside: float = 0.0
    hidden: float = 0.0
    rim: Colour | None = None
    indices: Indices | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "rgb", pixels_of(self.rgb))


def pixels_of(rgb: object) -> Rgb:
    """The pixels of a picture as uint8. Raises PictureError for an array that is none, and for floats, 0 to 1 or 255.

    >>> pixels_of(np.zeros((8, 8, 3), dtype=int)).dtype
    dtype('uint8')
    """
    if not isinstance(rgb, np.ndarray | Sequence) or isinstance(rgb, str):
        given = f"a {type(rgb).__name__} given for a picture"
        raise PictureError(given, allowed="a path, a picture, or rows x columns x 3 bytes")
    if isinstance(rgb, np.ndarray) and rgb.dtype.kind == "f":
        scaled = "(255 * rgb).round()" if rgb.size and np.nanmax(rgb) <= 1.0 else "rgb.round()"
        raise PictureError(f"pixels of type {rgb.dtype}", allowed="uint8, 0 to 255", do=f"{scaled}.astype('uint8')")
    pixels = eight_bits(rgb, "rgb", 255, "a code of red, green or blue", PictureError, kinds="iu")
    if pixels.ndim != 3 or pixels.shape[2] != 3:
        raise PictureError(f"pixels of the shape {pixels.shape}", allowed="rows x columns x 3")
    return pixels


def read_picture(
    path: Path,
    progress: Progress = SILENT,
    *,
    smallest: int = SMALLEST,
    ground: str | None = None,
    rendering: Rendering | None = None,
) -> Picture:
    """The picture in a file.

    ground     colour behind transparent parts, `#rrggbb`; default: white, or one on which more of the outline is seen
    rendering  of an SVG drawing or a PDF page; default: the first page, for a carpet of usual size

    The first frame is used, EXIF rotation applied, an embedded colour profile converted to sRGB, 16 bits reduced to 8,
    CMYK and grey converted to RGB, transparency put on a ground; each with a note. Raises PictureError unless the file
    is a picture of at least 8 x 8 pixels, at most 150 megapixels (`LARGEST`; some formats less) and at most 500 MB
    (`picture_file.MOST_BYTES`); Cancelled.
    """
    behind = None if ground is None else read_colour("ground", ground)
    data = read_bytes(path, progress.part(0.0, 0.1))
    drawn = rendered(path, data, rendering or Rendering())
    data, about = drawn or (data, ())
    with pillow_settings(LARGEST):
        try:
            check_structure(data, progress.part(0.1, 0.2))
            stream = MeteredBytes(data)
            stream.allow(_ENTRIES, _HEADER + len(data) * (data[:4] == b"RIFF" or data[4:8] == b"ftyp"))
            with contextlib.closing(Image.open(stream, formats=_OPENED)) as opened:
                _check_size(path, opened, smallest)
                picture = _decoded(opened, stream, behind, progress)
                about = (*about, *picture.notes)
                return picture if drawn is None else replace(picture, notes=about, density=None, indices=None)
        except (PictureError, Cancelled, MemoryError):
            raise
        except UnidentifiedImageError:
            given = next(
                (
                    f"has the format {name}, which is not supported"
                    for begin, name in _OTHER.items()
                    if data.startswith(begin)
                ),
                "",
            )
            unread = f"{path} {given}" if given else Sentence("picture.not-read", path=path)
            raise PictureError(unread, do=_USE) from None
        except (Image.DecompressionBombError, Image.DecompressionBombWarning):
            raise PictureError(
                f"{path} is too large a picture", allowed=_at_most(LARGEST), do="scale it down"
            ) from None
        except Exception as error:
            # A decoder may raise any error for a damaged file.
            raise PictureError(
                Sentence("picture.damaged", path=path, reason=shortened(error)), do=Sentence("picture.copy-again")
            ) from None


_OTHER = {b"%!PS": "EPS", b"\xc5\xd0\xd3\xc6": "EPS", b"\xd7\xcd\xc6\x9a": "WMF"}
"""Begins of files in formats that a user may take for pictures that can be read."""

_USE = Sentence("picture.formats")


def _at_most(pixels: int, name: str = "") -> str:
    return f"at most {pixels // 1_000_000} megapixels" + (f" of {name}" if name else "")


def _check_size(path: Path, opened: Image.Image, smallest: int) -> None:
    width, height = opened.size
    size = Sentence("picture.small", path=path, width=width, height=height)
    if width < smallest or height < smallest:
        least = Sentence("picture.small-least", count=smallest)
        raise PictureError(size, allowed=least, do=Sentence("picture.larger"))
    limit, name, do = LARGEST, "", "scale it down"
    if opened.format == "JPEG2000":
        limit, name, do = LARGEST_JPEG_2000, "JPEG 2000", "save it as PNG"
    elif opened.format in WHOLE:
        limit, name, do = LARGEST_WHOLE, str(opened.format), "scale it down, or save it as PNG"
    elif any(tile[0] in Image.DECODERS for tile in getattr(opened, "tile", ())[:1]):
        limit, name, do = LARGEST_INTERPRETED, str(opened.format), "save it as PNG"
    if width * height > limit:
        raise PictureError(size, allowed=_at_most(limit, name), do=do)


def _decoded(opened: Image.Image, stream: MeteredBytes, ground: Colour | None, progress: Progress) -> Picture:
    notes = _several_frames(opened)
    deep = ("16 bits per channel reduced to 8",) if _is_deep(opened) else ()
    notes += jpeg_loss(opened)
    singly = _READS * min(opened.width * opened.height, LARGEST_INTERPRETED)
    stream.allow(_ENTRIES + singly + stream.size // 64, _HEADER + 2 * stream.size)
    by_pillow = opened.format == "TIFF"  # turned when it is loaded
    orientation, about_exif = _orientation(opened) if by_pillow else (1, ())
    _load(opened, stream, progress.part(0.2, 0.7))
    if not by_pillow:
        orientation, about_exif = _orientation(opened)
    pixels, behind, converted = srgb_pixels(opened, progress.part(0.7, 1.0), ground)
    density, indices = _density(opened), _indices(opened)
    outside = share_outside(opened) if behind is not None and ground is None else 0.0
    opened.close()  # before the pixels are copied
    upright = pixels if by_pillow else turned(pixels, orientation)
    across, along = density or (0.0, 0.0)
    if orientation >= 5 and not by_pillow:
        across, along = along, across
    stated = (across, along) if density else None
    indices = None if indices is None or orientation != 1 else indices
    about = (*notes, *about_exif, *deep, *converted)
    if behind is None:
        return Picture(upright, about, stated, indices=indices)
    if orientation == 1 and behind.crop:
        about += (f'most of the picture is a transparent margin: --crop "{behind.crop}" takes the art alone',)
    rim = behind.rim if ground is None else None
    return Picture(upright, about, stated, behind.colour, outside, behind.hidden, rim, indices)


def _density(opened: Image.Image) -> tuple[float, float] | None:
    """Whole pixels per metre across and along, from the dots per inch that the file states."""
    dots: Any = opened.info.get("dpi")
    try:
        across, along = (float(round(float(dot) / METRE)) for dot in dots)
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        return None
    return (across, along) if min(across, along) > 0 else None


def _indices(opened: Image.Image) -> Indices | None:
    """The indices of a loaded picture with a palette whose colours are opaque."""
    few = opened.width * opened.height <= MOST_INDEXED
    return np.array(opened) if few and opened.mode == "P" and not opened.has_transparency_data else None


def _several_frames(opened: Image.Image) -> tuple[str, ...]:
    """A note if there is a second frame; the others are not looked for, and the layers of a PSD file are no frames."""
    if opened.format == "PSD" or not getattr(opened, "is_animated", False):
        return ()
    return ("the first of several frames is used",)


def _orientation(opened: Image.Image) -> tuple[int, tuple[str, ...]]:
    """The EXIF orientation, 1 to 8, and a note on it; of a TIFF before it is loaded, of a PNG after."""
    raw = opened.info.get("exif", b"") or opened.info.get("Raw profile type exif", "")
    if len(raw) > (MOST_EXIF if isinstance(raw, bytes) else 3 * MOST_EXIF):
        return 1, ("its EXIF data are too large and ignored",)
    orientation = opened.getexif().get(_ORIENTATION, 1)
    if orientation not in range(2, 9):
        return 1, ()
    return orientation, ("turned upright according to its EXIF data",)


def _is_deep(opened: Image.Image) -> bool:
    """Whether a channel has 16 bits in the file, by the description of its first tile."""
    tiles = str(getattr(opened, "tile", ())[:1])
    return any(f"'{mode};16{order}'" in tiles for mode in _DEEP for order in "BLN")


_DEEP = ("RGB", "RGBA", "RGBX", "LA", "CMYK")


def _load(opened: Image.Image, stream: MeteredBytes, progress: Progress) -> None:
    """Decode in a thread of its own, because one call of a decoder may take seconds; this one reports and is stopped.

    What a codec of libtiff writes to the error stream is an error, also where it goes on. A bar of the progress that is
    drawn in that time is lost.
    """
    failed: list[BaseException] = []

    def decode() -> None:
        try:
            opened.load()
        except BaseException as error:  # raised again by the caller's thread
            failed.append(error)

    by_libtiff = any(tile[0] == "libtiff" for tile in getattr(opened, "tile", ())[:1])
    messages: list[str] = []
    with contextlib.ExitStack() as caught:
        if by_libtiff:
            messages = caught.enter_context(native_messages())
        decoder = threading.Thread(target=decode, daemon=True)
        decoder.start()
        try:
            while decoder.is_alive():
                decoder.join(_REPORT)
                progress(min(1.0, stream.furthest / stream.size))
        except BaseException:
            stream.allow(0, 0)  # ends the thread at its next read
            raise
    if failed:
        raise failed[0]
    if found := _OF_A_CODEC.search("\n".join(messages)):
        raise DamagedError(found.group())
