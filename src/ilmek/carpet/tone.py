"""Tone: white, brightness, contrast and saturation of a design, applied in this order to each distinct colour.

white       Chromatic adaptation and exposure: in the cone space of Bradford each channel is divided by that of the
            white, so that the white becomes #ffffff; `auto` takes the mean light of the brightest hundredth of knots
brightness  L' = 100 (L/100)^g with g = ln((1 + b)/2)/ln(1/2): black and white stay, the mid tone 50 becomes 50 (1 + b)
contrast    L' = 50 + (1 + c)(L - 50), within 0 to 100
saturation  a' = (1 + s) a, b' = (1 + s) b

L, a, b are CIELAB. A colour that leaves sRGB is clipped channel by channel. The tone acts on the averages of a photo,
and as well on the true colours of a drawing.

Source of the cone space: K. M. Lam, Metamerism and colour constancy, thesis, University of Bradford (1985); ICC.1:2010,
annex E.
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray, Int32, Rgb, UInt8
from ilmek.carpet.colour import WHITE, lab_to_srgb, lab_to_xyz, srgb_to_lab, xyz_to_lab
from ilmek.carpet.design import bands
from ilmek.carpet.palette import Colours, distinct_colours, recoloured
from ilmek.carpet.picture_points import hex_colour
from ilmek.num.compiled import uncounted
from ilmek.progress import SILENT, Progress
from ilmek.records import record

AUTO = "auto"
"""Text of a white that is found in the design."""

BRIGHTEST = 0.01
"""Share of the knots whose mean light is the white, where it is to be found."""

_BATCH = 65536

BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
"""Cone responses of XYZ."""


@record
class Tone:
    """Changes of the colours of a design.

    brightness, contrast, saturation  shares, 0: unchanged      white  CIELAB of what becomes white, AUTO or None
    """

    brightness: float = 0.0
    contrast: float = 0.0
    saturation: float = 0.0
    white: str | tuple[int, int, int] | None = None

    @property
    def changes(self) -> bool:
        """Whether any colour changes."""
        return bool(self.brightness or self.contrast or self.saturation or self.white)


def toned_labs(labs: Float[np.ndarray, "*batch 3"], tone: Tone, white: FloatArray | None) -> FloatArray:
    """CIELAB after the changes of a tone; `white`: XYZ of what becomes white, None: no change of the white.

    >>> toned_labs(np.array([[50.0, 10.0, -20.0]]), Tone(brightness=0.2, saturation=-0.5), None).round(9).tolist()
    [[60.0, 5.0, -10.0]]
    """
    if white is not None:
        gains = (BRADFORD @ WHITE) / (BRADFORD @ white)
        adapted = np.linalg.inv(BRADFORD) @ np.diag(gains) @ BRADFORD
        labs = xyz_to_lab(lab_to_xyz(labs) @ adapted.T)
    out = np.array(labs, dtype=float)
    lightness = np.clip(out[..., 0], 0.0, 100.0)
    exponent = math.log((1.0 + tone.brightness) / 2.0) / math.log(0.5)
    lightness = 100.0 * (lightness / 100.0) ** exponent
    out[..., 0] = np.clip(50.0 + (1.0 + tone.contrast) * (lightness - 50.0), 0.0, 100.0)
    out[..., 1:] *= 1.0 + tone.saturation
    return out


def found_white(colours: Colours) -> FloatArray:
    """XYZ of the mean light of the brightest hundredth of the knots, of at least one colour."""
    order = np.argsort(-colours.labs[:, 0], kind="stable")
    knots = np.cumsum(colours.counts[order])
    last = int(np.searchsorted(knots, BRIGHTEST * knots[-1])) + 1
    chosen = order[:last]
    weights = colours.counts[chosen][:, None]
    return np.asarray(np.sum(weights * lab_to_xyz(colours.labs[chosen]), axis=0) / weights.sum())


@uncounted
def _paint(rgb: Rgb, index: Int32[np.ndarray, " codes"], codes: UInt8[np.ndarray, "colours 3"], out: Rgb) -> None:
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            code = np.int32(rgb[row, column, 0]) << 16 | np.int32(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
            for channel in range(3):
                out[row, column, channel] = codes[index[code] - 1, channel]


def toned(
    rgb: Rgb, tone: Tone, progress: Progress = SILENT, colours: Colours | None = None
) -> tuple[Rgb, Colours | None, str]:
    """A design after the changes of a tone, its distinct colours, and what was done, as the end of a sentence.

    colours  the distinct colours of the design, where they are known
    """
    if not tone.changes:
        return rgb, colours, ""
    rgb = np.ascontiguousarray(rgb)
    colours = colours or distinct_colours(rgb, progress.part(0.0, 0.5))
    white = None
    if isinstance(tone.white, str):
        white = found_white(colours)
    elif tone.white is not None:
        white = lab_to_xyz(srgb_to_lab(np.array(tone.white, dtype=np.uint8)))
    codes = np.empty((len(colours.labs), 3), dtype=np.uint8)
    for part in bands(len(codes), 1, _BATCH):
        codes[part] = lab_to_srgb(toned_labs(colours.labs[part], tone, white))
        progress(0.5 + 0.3 * part.stop / len(codes))
    out = np.empty_like(rgb)
    for band in bands(*rgb.shape[:2]):
        _paint(rgb[band], colours.index, codes, out[band])
        progress(0.8 + 0.2 * band.stop / len(rgb))
    return out, recoloured(colours, codes), f"; {_in_words(tone, white)}"


def _in_words(tone: Tone, white: FloatArray | None) -> str:
    """The changes, like `#f5efe0 becomes white, brightness -20 %`."""
    words = []
    if white is not None:
        red, green, blue = lab_to_srgb(xyz_to_lab(white)).tolist()
        words.append(f"{hex_colour((red, green, blue))} becomes white")
    shares = {"brightness": tone.brightness, "contrast": tone.contrast, "saturation": tone.saturation}
    return ", ".join(words + [f"{name} {100 * share:+.4g} %" for name, share in shares.items() if share])
