"""Pictures that move, as files: GIF, which every program shows, and MP4 (H.264), by the extra `video`."""

import importlib
import io
import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageColor

COLOURS = 64
"""Colours of a GIF, the same for all its pictures."""

_PAPER = 250
"""Least channel of a colour that becomes white."""

_QUALITY = "20"
"""Constant rate factor of H.264: 18 to 23 is the usual range, 0 is without loss."""


def gif(pictures: Iterator[Image.Image], rate: int, colours: Sequence[str] = ()) -> bytes:
    """A GIF that repeats without end, in given colours and those of its first picture.

    The same pictures give the same bytes.
    rate     pictures per second, a divisor of 100
    colours  that are kept exactly, like #1f2933, fewer than `COLOURS`
    """
    first = next(pictures)
    palette = _palette(first, colours)
    flat = (one.quantize(palette=palette, dither=Image.Dither.NONE) for one in itertools.chain((first,), pictures))
    file = io.BytesIO()
    next(flat).save(
        file, format="GIF", save_all=True, append_images=flat, duration=1000 // rate, loop=0, optimize=False, disposal=1
    )
    return file.getvalue()


def _palette(picture: Image.Image, kept: Sequence[str]) -> Image.Image:
    """A picture with the colours kept and those of another; the lightest are white, the colour of paper."""
    shared = picture.quantize(colors=COLOURS - len(kept), method=Image.Quantize.MEDIANCUT)
    found = np.array(shared.getpalette(), np.uint8).reshape(-1, 3)
    found[found.min(axis=1) >= _PAPER] = 255
    exact = np.array([ImageColor.getrgb(colour) for colour in kept], np.uint8).reshape(-1, 3)
    shared.putpalette(np.concatenate([exact, found]).ravel().tolist())
    return shared


def write_mp4(path: Path, pictures: Iterator[Image.Image], rate: int) -> None:
    """Write pictures of one size, with even sides, as MP4: H.264, 4:2:0, which every browser plays.

    Raises ImportError where the extra `video` is not installed.
    """
    av = importlib.import_module("av")
    with av.open(str(path), "w", format="mp4", options={"movflags": "+faststart"}) as container:
        stream = container.add_stream("libx264", rate=rate)
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": _QUALITY, "threads": "1"}
        first = next(pictures)
        stream.width, stream.height = first.size
        for picture in itertools.chain((first,), pictures):
            for packet in stream.encode(av.VideoFrame.from_image(picture)):
                container.mux(packet)
        for packet in stream.encode():
            container.mux(packet)
