"""The pixels of an opened picture as 8-bit sRGB, a strip of rows at a time.

The decoded picture takes 4 bytes a pixel and the result 3; what a conversion needs besides is that of one strip.
"""

import io
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from PIL import Image, ImageCms

from ilmek.arrays import FloatArray, Rgb
from ilmek.carpet.picture_points import Colour, hex_colour
from ilmek.errors import PictureError
from ilmek.io.ground_colour import WHITE, Ground, contrasting_ground
from ilmek.progress import SILENT, Progress

MOST_PROFILE = 4_000_000
"""Largest size of a colour profile that is applied [bytes]; those of printing presses have 2 MB."""

_JUDGED = 640
"""Pixels of the longer side of the picture of which the ground is chosen."""

_STRIP = 1 << 21
"""Pixels of a strip."""

_PROBES, _ROUNDING = 9, 3
"""Codes of each channel of which a profile is judged, and the largest change by the rounding of a profile."""

_RGB_PROFILE = ImageCms.createProfile("sRGB")
_ICC_MODES = {"RGB": "RGB", "GRAY": "L", "CMYK": "CMYK", "Lab": "LAB"}
_ALPHA = ("P", "PA", "RGBa", "La", "LA", "RGBA")
_Convert = Callable[[Image.Image], Image.Image]


def srgb_pixels(
    image: Image.Image, progress: Progress = SILENT, ground: Colour | None = None
) -> tuple[Rgb, Ground | None, tuple[str, ...]]:
    """The pixels of a loaded picture, the ground behind its transparent parts (None: it has none), and notes.

    ground  default: that which contrasts with the outline [`ground_colour`]
    Raises PictureError for a picture that is transparent everywhere.
    """
    to_eight_bits, notes = _eight_bits(image)
    first = to_eight_bits(image.crop((0, 0, image.width, 1)))
    to_rgb, more = _in_srgb(_flat(first).mode, image.info.get("icc_profile"))
    out = np.empty((image.height, image.width, 3), dtype=np.uint8)
    behind: Ground | None = None
    shows = False
    for top, bottom in _strips(image):
        strip = to_eight_bits(image.crop((0, top, image.width, bottom)))
        coloured, hiding = to_rgb(_flat(strip)), cover(strip)
        shows = shows or hiding is None or hiding.getextrema() != (0, 0)
        if hiding is not None:
            behind = behind or _ground(image, to_eight_bits, to_rgb, ground)
            below = Image.new("RGB", strip.size, behind.colour)
            below.paste(coloured, mask=hiding)
            coloured = below
        out[top:bottom] = np.asarray(coloured)
        progress(bottom / image.height)
    if not shows:
        raise PictureError(f"all {image.width} x {image.height} pixels are transparent", do="export it with its layers")
    return out, behind, (*notes, *more, *_about_the_ground(behind, ground))


def _ground(image: Image.Image, to_eight_bits: _Convert, to_rgb: _Convert, given: Colour | None) -> Ground:
    """The ground that is given, which may hide what it hides, or that which contrasts with the outline."""
    scale = max(1.0, max(image.size) / _JUDGED)
    few = to_eight_bits(image.resize([max(1, int(side / scale)) for side in image.size], Image.Resampling.NEAREST))
    art, hiding = to_rgb(_flat(few)), cover(few)
    if hiding is not None:
        art.putalpha(hiding)
    ground = contrasting_ground(art.convert("RGBA"))
    return ground if given is None else ground._replace(colour=given, hidden=0.0)


def _about_the_ground(behind: Ground | None, given: Colour | None) -> tuple[str, ...]:
    """A note on the colour behind transparent parts."""
    if behind is None:
        return ()
    if behind.colour == WHITE:
        return ("transparent parts put on white",)
    why = "" if given else ", because white would hide a part of the outline; --ground gives another colour"
    return (f"transparent parts put on {hex_colour(behind.colour)}{why}",)


def turned(pixels: Rgb, orientation: int) -> Rgb:
    """The pixels of a picture upright, by its EXIF orientation 1 to 8    [EXIF 2.32, 4.6.4]."""
    if orientation == 1:
        return pixels
    if orientation >= 5:
        pixels = pixels.swapaxes(0, 1)
    across = -1 if orientation in (2, 3, 6, 7) else 1
    down = -1 if orientation in (3, 4, 7, 8) else 1
    return np.ascontiguousarray(pixels[::down, ::across])


def _strips(image: Image.Image) -> Iterator[tuple[int, int]]:
    rows = max(1, _STRIP // image.width)
    for top in range(0, image.height, rows):
        yield top, min(top + rows, image.height)


def _eight_bits(image: Image.Image) -> tuple[_Convert, tuple[str, ...]]:
    """Conversion of integer greys of 16 bits and of floating-point greys to 8 bits, by the limits of the whole."""
    if not image.mode.startswith(("I", "F")):
        return lambda strip: strip, ()
    low, high = _limits(image)

    def converted(strip: Image.Image) -> Image.Image:
        grey = np.asarray(strip, dtype=np.float64)
        eight = np.rint(np.nan_to_num((grey - low) * (255 / (high - low)), nan=0.0)).clip(0, 255).astype(np.uint8)
        brought = Image.fromarray(eight, "L")
        brought.info = image.info
        return brought

    whole = (low, high) == (0.0, 65535.0)
    return converted, ("16 bits reduced to 8" if whole else "grey scaled from darkest to lightest",)


_DIM = 65536 / 16


def _limits(image: Image.Image) -> tuple[float, float]:
    """The greys that become 0 and 255: 0 and 65535 if all are integers between, else the least and greatest.

    Integers that use less than a sixteenth of that range, as those of a camera of 12 bits, are scaled too.
    """
    lows, highs = [], []
    for top, bottom in _strips(image):
        grey: FloatArray = np.asarray(image.crop((0, top, image.width, bottom)), dtype=np.float64)
        finite = grey[np.isfinite(grey)]
        if finite.size:
            lows.append(float(finite.min()))
            highs.append(float(finite.max()))
    low, high = (min(lows), max(highs)) if lows else (0.0, 1.0)
    if image.mode != "F" and low >= 0 and _DIM <= high <= 65535:
        return 0.0, 65535.0
    return low, high if high > low else low + 1.0


def _flat(image: Image.Image) -> Image.Image:
    """Without palette and alpha channel."""
    if image.mode == "P" and not image.has_transparency_data:
        return image.convert("RGB")
    return image.convert("RGBA").convert("RGB") if image.mode in _ALPHA else image


def cover(image: Image.Image) -> Image.Image | None:
    """The alpha channel if it hides something, else None."""
    if not image.has_transparency_data:
        return None
    alpha = image.convert("RGBA").getchannel("A")
    return alpha if alpha.getextrema()[0] != 255 else None


def _in_srgb(mode: str, profile: bytes | None) -> tuple[_Convert, tuple[str, ...]]:
    """Conversion of pixels of a mode to sRGB by the embedded profile or by the mode."""
    if profile and len(profile) > MOST_PROFILE:
        return _plain, (f"its colour profile is larger than {MOST_PROFILE // 1_000_000} MB and ignored",)
    if profile:
        try:
            embedded = ImageCms.ImageCmsProfile(io.BytesIO(profile))
            if mode == _ICC_MODES.get(embedded.profile.xcolor_space.strip()):
                convert = _by_profile(embedded, mode)
                if mode == "RGB" and _keeps_colours(convert):
                    return _plain, ()
                name = ImageCms.getProfileDescription(embedded).strip()
                return convert, (f"colours converted from {name!r} to sRGB",)
        except (ImageCms.PyCMSError, OSError, ValueError, TypeError):
            return _plain, ("its colour profile is damaged and ignored",)
    if mode == "LAB":
        return _by_profile(ImageCms.createProfile("LAB"), mode), ("CIELAB converted to sRGB",)
    return _plain, ("CMYK without a colour profile converted to sRGB",) if mode == "CMYK" else ()


def _keeps_colours(convert: _Convert) -> bool:
    """Whether a conversion changes no colour by more than the rounding of profiles: then they are those of sRGB, and
    stay as they are, because a chart's colours are exact.
    """
    codes = np.linspace(0, 255, _PROBES).astype(np.uint8)
    cube = np.stack(np.meshgrid(codes, codes, codes), axis=-1).reshape(_PROBES, _PROBES**2, 3)
    changed = np.asarray(convert(Image.fromarray(cube)), dtype=np.int64)
    return bool(np.abs(changed - cube).max() <= _ROUNDING)


def _plain(strip: Image.Image) -> Image.Image:
    return strip if strip.mode == "RGB" else strip.convert("RGB")


def _by_profile(profile: Any, mode: str) -> _Convert:
    transform = ImageCms.buildTransform(profile, _RGB_PROFILE, mode, "RGB")

    def converted(strip: Image.Image) -> Image.Image:
        brought = ImageCms.applyTransform(strip, transform)
        assert brought is not None
        return brought

    return converted
