"""Pictures of all formats that Pillow opens safely, as 8-bit sRGB, with a note on every conversion.

Formats that start another program (EPS, WMF) or are no pictures (HDF5, GRIB, BUFR, MPEG) are excluded.
"""

import difflib
import io
import re
import warnings
from pathlib import Path
from typing import TypeAlias

import numpy as np
from PIL import Image, ImageCms, ImageOps, UnidentifiedImageError

from ilmek.arrays import Rgb
from ilmek.errors import PictureError
from ilmek.records import record

FORMATS = (
    "PNG", "JPEG", "MPO", "TIFF", "BMP", "DIB", "GIF", "WEBP", "AVIF", "JPEG2000", "PPM", "TGA", "PCX", "DCX", "ICO",
    "ICNS", "QOI", "PSD", "SGI", "SUN", "XBM", "XPM", "MSP", "IM", "SPIDER", "DDS", "BLP",
)  # fmt: skip
"""Formats that are read, by Pillow's names."""

SMALLEST = 8
"""Smallest width and height [pixels]."""

LARGEST = 150_000_000
"""Largest number of pixels; more is regarded as a decompression bomb."""

_SIXTEEN_BITS = re.compile(r"'(?:RGB[AX]?|LA|CMYK);16[BLN]'")  # in Pillow's description of the file's pixels
_ORIENTATION = 0x0112
_RGB_PROFILE = ImageCms.createProfile("sRGB")
_ICC_MODES = {"RGB": "RGB", "GRAY": "L", "CMYK": "CMYK", "Lab": "LAB"}
_Step: TypeAlias = tuple[Image.Image, tuple[str, ...]]


@record
class Picture:
    """A picture as sRGB with 8 bits per channel, row 0 on top; notes on the conversions."""

    rgb: Rgb
    notes: tuple[str, ...] = ()


def read_picture(path: Path) -> Picture:
    """The picture in a file.

    The first frame is used, EXIF rotation applied, an embedded colour profile converted to sRGB, 16 bits reduced to 8,
    CMYK and grey converted to RGB, transparency put on white; each with a note. Raises PictureError unless the file is
    a picture of at least 8 x 8 pixels and at most 150 megapixels.
    """
    data = _read_bytes(path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the notes and the limit of pixels cover Pillow's warnings
        try:
            with Image.open(io.BytesIO(data)) as opened:
                if opened.format not in FORMATS:
                    raise PictureError(f"{path} has the format {opened.format}, which is not supported", do=_USE)
                _check_size(path, opened.width, opened.height)
                return _decoded(opened)
        except PictureError:
            raise
        except UnidentifiedImageError:
            raise PictureError(f"{path} is not a picture that can be read", do=_USE) from None
        except Image.DecompressionBombError:
            raise PictureError(f"{path} is too large a picture", allowed=_LIMIT, do="scale it down") from None
        except Exception as error:
            # A decoder may raise any error for a damaged file.
            raise PictureError(
                f"{path} is damaged or truncated ({_words(error)})", do="save or copy it again"
            ) from None


_USE = "use a PNG, JPEG, TIFF, WebP, BMP or GIF file"
_LIMIT = f"at most {LARGEST // 1_000_000} megapixels"


def _read_bytes(path: Path) -> bytes:
    try:
        if not path.is_file():
            raise PictureError(_not_a_file(path), do="give the path of a picture")
        data = path.read_bytes()
    except (OSError, ValueError) as error:
        raise PictureError(f"{path} cannot be read ({_words(error)})") from None
    if not data:
        raise PictureError(f"{path} is empty", do=_USE)
    return data


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


def _words(error: Exception) -> str:
    """The message of a library, shortened."""
    message = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return re.sub(r"\s*\(.*\)$", "", message.split("\n")[0])[:120] or "its decoder fails"


def _check_size(path: Path, width: int, height: int) -> None:
    size = f"{path} is {width} x {height} pixels"
    if width < SMALLEST or height < SMALLEST:
        raise PictureError(size, allowed=f"at least {SMALLEST} x {SMALLEST}", do="use a larger picture")
    if width * height > LARGEST:
        raise PictureError(size, allowed=_LIMIT, do="scale it down")


def _decoded(opened: Image.Image) -> Picture:
    image, notes = _first_frame(opened)
    for step in (_upright, _eight_bits, _on_white_in_srgb):
        image, added = step(image)
        notes += added
    return Picture(np.array(image, dtype=np.uint8), notes)


def _first_frame(image: Image.Image) -> _Step:
    frames = getattr(image, "n_frames", 1)
    deep = _SIXTEEN_BITS.search(str(getattr(image, "tile", "")))
    notes = [f"the first of {frames} frames is used"] if frames > 1 else []
    if frames > 1:
        image.seek(0)
    if _is_turned(image):  # before loading, which turns a TIFF and drops its orientation
        notes.append("turned upright according to its EXIF data")
    image.load()
    if deep:
        notes.append("16 bits per channel reduced to 8")
    return image, tuple(notes)


def _upright(image: Image.Image) -> _Step:
    return ImageOps.exif_transpose(image) if _is_turned(image) else image, ()


def _is_turned(image: Image.Image) -> bool:
    return image.getexif().get(_ORIENTATION, 1) in range(2, 9)


def _eight_bits(image: Image.Image) -> _Step:
    """Integer greys of 16 bits and floating-point greys, as 8 bits."""
    if not image.mode.startswith(("I", "F")):
        return image, ()
    grey = np.asarray(image, dtype=np.float64)
    low, high = (0.0, 65535.0) if image.mode != "F" and grey.min() >= 0 and grey.max() <= 65535 else _range(grey)
    eight = np.rint(np.nan_to_num((grey - low) * (255 / (high - low)), nan=0.0)).clip(0, 255).astype(np.uint8)
    brought = Image.fromarray(eight, "L")
    brought.info = image.info
    whole = (low, high) == (0.0, 65535.0)
    return brought, ("16 bits reduced to 8" if whole else "grey scaled from darkest to lightest",)


def _range(grey: np.ndarray) -> tuple[float, float]:
    finite = grey[np.isfinite(grey)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    return low, high if high > low else low + 1.0


def _on_white_in_srgb(image: Image.Image) -> _Step:
    """Colours as sRGB by the embedded profile or by the mode; transparent parts on white."""
    cover = _cover(image)
    flat = image.convert("RGBA").convert("RGB") if image.mode in ("P", "PA", "RGBa", "La", "LA", "RGBA") else image
    flat, notes = _in_srgb(flat, image.info.get("icc_profile"))
    if cover is None:
        return flat, notes
    white = Image.new("RGB", flat.size, "white")
    white.paste(flat, mask=cover)
    return white, (*notes, "transparent parts put on white")


def _cover(image: Image.Image) -> Image.Image | None:
    """The alpha channel if it hides something, else None."""
    if not image.has_transparency_data:
        return None
    alpha = image.convert("RGBA").getchannel("A")
    return alpha if alpha.getextrema()[0] != 255 else None


def _in_srgb(image: Image.Image, profile: bytes | None) -> _Step:
    mode = image.mode
    if profile:
        try:
            embedded = ImageCms.ImageCmsProfile(io.BytesIO(profile))
            if mode == _ICC_MODES.get(embedded.profile.xcolor_space.strip()):
                name = ImageCms.getProfileDescription(embedded).strip()
                converted = ImageCms.profileToProfile(image, embedded, _RGB_PROFILE, outputMode="RGB")
                assert converted is not None
                return converted, () if name.startswith("sRGB") else (f"colours converted from {name!r} to sRGB",)
        except (ImageCms.PyCMSError, OSError, ValueError, TypeError):
            return image.convert("RGB"), ("its colour profile is damaged and ignored",)
    if mode == "LAB":
        lab = ImageCms.createProfile("LAB")
        converted = ImageCms.profileToProfile(image, lab, _RGB_PROFILE, outputMode="RGB")
        assert converted is not None
        return converted, ("CIELAB converted to sRGB",)
    return image.convert("RGB"), ("CMYK without a colour profile converted to sRGB",) if mode == "CMYK" else ()
