"""Reading: from the pixels of a fitted picture to a design, one colour for each knot.

exact  every pixel is a knot [`exact`]
flat   a drawing: each knot has a true colour of its cell [`flat`]
photo  box averages in linear light [`design`]
"""

from dataclasses import dataclass
from types import MappingProxyType

from ilmek.arrays import Rgb
from ilmek.carpet.design import resampled
from ilmek.carpet.exact import find_drawing
from ilmek.carpet.flat import flat_design, looks_flat
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.params import Params, kind, param
from ilmek.progress import SILENT, Progress
from ilmek.records import record

READINGS = ("auto", "exact", "flat", "photo")

LEAST_PATCHES = MappingProxyType({"exact": 0, "flat": 2, "photo": 4})
"""Default of the least patch by the kind of reading."""


@dataclass(frozen=True, slots=True)
class ReadParams(Params):
    """How a picture is read."""

    reading: str = param(
        "auto", choices=READINGS, doc="how the picture is read; auto: decided by its pixels", alias="read"
    )
    least_patch: int | None = kind.count(
        None,
        at_least=0,
        at_most=100,
        doc="patches of fewer knots are merged where they hardly show; default: exact 0, flat 2, photo 4",
    )

    def least_patch_of(self, kind: str) -> int:
        """The least patch of a design that was read as this kind."""
        return LEAST_PATCHES[kind] if self.least_patch is None else self.least_patch


@record
class Design:
    """A picture read onto the grid of knots.

    colours  sRGB of each knot (rows, columns, 3)
    kind     exact, flat or photo
    reason   of the decision, one sentence for the user
    foreign  number of knots whose colour is that of no true colour of their cell; None: no true colours
    """

    colours: Rgb
    kind: str
    reason: str
    foreign: int | None = None


def exact_design(
    rgb: Rgb,
    size: CarpetSize | None,
    quality: Quality | None,
    params: ReadParams | None = None,
    *,
    drawn: bool = False,
    progress: Progress = SILENT,
) -> tuple[Design, CarpetSize, Quality] | None:
    """The design of a picture whose pixels are the knots, and the size and quality of its carpet; None: they are not.

    size, quality  as far as they are given      drawn  it is known that the picture is drawn knot by knot
    Raises CarpetError where the reading is to be exact and the pixels are not the knots of size and quality.
    """
    params = params or ReadParams()
    if params.reading not in ("auto", "exact"):
        return None
    found = find_drawing(rgb, size, quality, drawn=drawn or params.reading == "exact", progress=progress)
    if found is None:
        return None
    return Design(found.rgb, "exact", found.reason, 0), found.size, found.quality


def read_design(
    rgb: Rgb, grid: tuple[int, int], params: ReadParams | None = None, progress: Progress = SILENT
) -> Design:
    """The design of a fitted picture that is not exact, on a grid of rows and columns."""
    params = params or ReadParams()
    if params.reading == "photo":
        return Design(resampled(rgb, *grid, progress), "photo", "read as a photo, as required")
    seen = looks_flat(rgb)
    if params.reading == "auto" and not seen.is_flat:
        return Design(resampled(rgb, *grid, progress), "photo", seen.sentence)
    flat = flat_design(rgb, grid, progress, seen.true)
    axes = f"; symmetric about the {' and the '.join(flat.symmetric)} axis" if flat.symmetric else ""
    return Design(flat.colours, "flat", seen.sentence + axes, flat.foreign)
