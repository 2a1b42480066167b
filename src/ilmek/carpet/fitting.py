"""Fit: the picture's part that the carpet shows, and its proportions."""

from dataclasses import dataclass

from ilmek.arrays import Rgb
from ilmek.carpet.design import distortion
from ilmek.carpet.sizes import CarpetSize
from ilmek.params import Params, kind
from ilmek.progress import SILENT, Progress
from ilmek.records import record

FITS = ("auto", "stretch")


@dataclass(frozen=True, slots=True)
class FitParams(Params):
    """How a picture is fitted to the carpet."""

    fit: str = kind.choice("auto", FITS, doc="what is done where the proportions of picture and carpet differ")


@record
class Fit:
    """What was done to fit the picture.

    kind     stretch
    stretch  of the picture's width against its height [-]; negative where it is compressed
    cropped  share of the picture's area that the carpet does not show [-]
    """

    kind: str = "stretch"
    stretch: float = 0.0
    cropped: float = 0.0


def fit_picture(
    rgb: Rgb, size: CarpetSize, params: FitParams | None = None, progress: Progress = SILENT
) -> tuple[Rgb, Fit]:
    """The picture as the carpet shows it, pixels (height, width, 3), and what was done to it.

    The result has the carpet's proportions up to `Fit.stretch`; it is a view of the picture where nothing but its edges
    changes.
    """
    del params
    progress(1.0)
    return rgb, Fit("stretch", distortion(rgb, size))
