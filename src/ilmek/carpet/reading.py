"""Reading: from the pixels of a fitted picture to a design, one colour for each knot.

exact  every pixel is a knot
flat   a drawing: each knot has a true colour of its cell [`flat`]
photo  box averages in linear light [`design`]
"""

from dataclasses import dataclass
from types import MappingProxyType

from ilmek.arrays import Rgb
from ilmek.carpet.design import resampled
from ilmek.carpet.flat import flat_design, looks_flat
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


def read_design(
    rgb: Rgb, grid: tuple[int, int], params: ReadParams | None = None, progress: Progress = SILENT
) -> Design:
    """The design of a fitted picture on a grid of rows and columns."""
    params = params or ReadParams()
    if params.reading == "exact" or (params.reading == "auto" and rgb.shape[:2] == grid):
        return Design(rgb, "exact", f"the picture has the grid of the knots, {grid[1]} × {grid[0]}", 0)
    if params.reading == "photo":
        return Design(resampled(rgb, *grid, progress), "photo", "read as a photo, as required")
    seen = looks_flat(rgb)
    if params.reading == "auto" and not seen.is_flat:
        return Design(resampled(rgb, *grid, progress), "photo", seen.sentence)
    flat = flat_design(rgb, grid, progress, seen.true)
    axes = f"; symmetric about the {' and the '.join(flat.symmetric)} axis" if flat.symmetric else ""
    return Design(flat.colours, "flat", seen.sentence + axes, flat.foreign)
