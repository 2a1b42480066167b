"""Reading: from the pixels of a fitted picture to a design, one colour for each knot.

exact  every pixel is a knot [`exact`], or every cell of a sheet of squared paper [`paper`]
flat   a drawing: each knot has a true colour of its cell [`flat`]
photo  box averages in linear light [`design`]

The tone of the design is changed after it is read, whatever the reading [`tone`].
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from types import MappingProxyType

from ilmek.arrays import Rgb
from ilmek.carpet.averages import Averages, averages_of
from ilmek.carpet.design import resampled
from ilmek.carpet.detail import Detail, detail_of
from ilmek.carpet.exact import find_drawing, has_grid, of_grid
from ilmek.carpet.flat import Flatness, flat_design, looks_flat, looks_like_itself
from ilmek.carpet.palette import Colours
from ilmek.carpet.paper.sheet import PaperReading, read_sheet, squared_paper
from ilmek.carpet.picture_points import read_colour
from ilmek.carpet.projection import MadeRgb
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.tone import AUTO, Tone, toned
from ilmek.errors import CarpetError, ParameterError
from ilmek.params import Params, kind, param
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import counted

READINGS = ("auto", "exact", "flat", "photo")

LEAST_PATCHES = MappingProxyType({"exact": 0, "flat": 2, "photo": 3})
"""Default of the least patch by the kind of reading."""

DARKEST_WHITE = 64
"""Least code of the brightest channel of a colour that becomes white."""


@dataclass(frozen=True, slots=True)
class ReadParams(Params):
    """How a picture is read."""

    reading: str = param(
        "auto", choices=READINGS, doc="how the picture is read; auto: decided by its pixels", alias="read"
    )
    paper: bool = kind.flag(
        False, doc="read the picture as a scan or photograph of squared paper: one knot for each cell of its grid"
    )
    least_patch: int | None = kind.count(
        None,
        at_least=0,
        at_most=100,
        doc="patches of fewer knots are merged where they hardly show; default: exact 0, flat 2, photo 3",
    )

    halftone: float | None = kind.ratio(
        None,
        unit="%",
        at_least=0.0,
        at_most=1.0,
        doc="share of the tones between the yarns that patterns render in a photo; default: photo 100 %, others 0 %",
    )
    brightness: float = kind.ratio(
        0.0, unit="%", at_least=-0.9, at_most=0.9, doc="share by which the mid tone gets lighter; black and white stay"
    )
    contrast: float = kind.ratio(
        0.0, unit="%", at_least=-1.0, at_most=4.0, doc="share by which lightness moves away from the mid tone"
    )
    saturation: float = kind.ratio(0.0, unit="%", at_least=-1.0, at_most=4.0, doc="share by which chroma grows")
    white: str | None = kind.text(
        None, doc="colour of the picture that becomes white, like #f5efe0; auto: that of its brightest hundredth"
    )

    def check_together(self) -> None:
        """Raise ParameterError for a white that is no colour, or black, and for paper that is to be read otherwise."""
        if self.paper and self.reading not in ("auto", "exact"):
            raise ParameterError(f"paper is given, and reading={self.reading!r}", do="leave one of them out")
        if self.white not in (None, AUTO) and max(read_colour("white", self.white)) < DARKEST_WHITE:
            raise ParameterError(
                f"white={self.white!r} is nearly black", allowed="a code of at least 64", do="give a light colour"
            )

    @property
    def tone(self) -> Tone:
        """The changes of the colours."""
        white = self.white if self.white in (None, AUTO) else read_colour("white", self.white)
        return Tone(self.brightness, self.contrast, self.saturation, white)

    @property
    def of_picture(self) -> "ReadParams":
        """What acts on the design of a picture: the same without tone, patches and halftone, which act on a design."""
        toneless = replace(self, brightness=0.0, contrast=0.0, saturation=0.0, white=None)
        return replace(toneless, least_patch=None, halftone=None)

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
    paper    the sheet of squared paper that it was read from
    distinct  the distinct colours, where they are known; None: they are to be counted
    averages  of the picture on the grid; None: they are the colours, or there is no picture
    detail    of the picture on the grid; None: too little
    """

    colours: Rgb
    kind: str
    reason: str
    foreign: int | None = None
    paper: PaperReading | None = None
    distinct: Colours | None = None
    averages: Averages | None = None
    detail: Detail | None = None


def toned_design(design: Design, tone: Tone, progress: Progress = SILENT) -> Design:
    """A design with its tone changed."""
    colours, distinct, words = toned(design.colours, tone, progress, design.distinct)
    averages = design.averages and replace(design.averages, colours=toned(design.averages.colours, tone)[0])
    return replace(design, colours=colours, reason=design.reason + words, distinct=distinct, averages=averages)


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
    if params.paper:
        return _of_sheet(read_sheet(rgb, progress), size, quality, params)
    drawn = drawn or params.reading == "exact"
    sheet = squared_paper(rgb) if size is None and not drawn else None
    if sheet is not None:
        return _of_sheet(sheet, size, quality, params)
    found = find_drawing(rgb, size, quality, drawn=drawn, progress=progress)
    if found is None:
        return None
    return toned_design(Design(found.rgb, "exact", found.reason, 0), params.tone), found.size, found.quality


def _of_sheet(
    sheet: PaperReading, size: CarpetSize | None, quality: Quality | None, params: ReadParams
) -> tuple[Design, CarpetSize, Quality]:
    """The design on a sheet of squared paper. Raises CarpetError where size and quality have another grid."""
    sheet = replace(sheet, stated=size is not None and quality is not None)
    if size is None or quality is None:
        size, quality = of_grid(sheet.grid, size, quality)
    elif not has_grid(sheet.grid, size, quality):
        columns, rows = quality.across * size.width, quality.along * size.length
        raise CarpetError(
            f"the picture is {sheet.words}, and {size} at {quality} has {columns:.0f} × {rows:.0f} knots",
            do="leave out --size or --quality, which then follows from the cells; where lines of the grid were missed, "
            "crop the picture to the grid",
        )
    return toned_design(Design(sheet.rgb, "exact", sheet.words, 0, sheet), params.tone), size, quality


def read_design(
    rgb: Rgb,
    grid: tuple[int, int],
    params: ReadParams | None = None,
    progress: Progress = SILENT,
    *,
    judged: MadeRgb | None = None,
    look: Callable[[Rgb], Flatness] = looks_flat,
) -> Design:
    """The design of a fitted picture that is not exact, on a grid of rows and columns.

    judged  the picture before it is fitted, which tells a drawing from a photo: so the size of the carpet changes
            nothing, and an even border makes no drawing of a photo; default: the fitted picture
    look    tells whether that picture is a drawing
    """
    params = params or ReadParams()
    if params.reading == "photo":
        return _photo(rgb, grid, params, "as required", progress)
    picture = rgb if judged is None else judged
    seen = look(picture)
    if params.reading == "auto" and not seen.is_flat:
        return _photo(rgb, grid, params, seen.sentence, progress)
    if params.reading == "auto" and not looks_like_itself(picture, seen.true):
        return _photo(rgb, grid, params, f"{seen.sentence}, but they do not show what the picture shows", progress)
    padded = judged is not None and rgb.size > judged.size
    flat = flat_design(rgb, grid, progress, None if padded else seen.true)
    required = "as required; " if params.reading == "flat" and not seen.is_flat else ""
    axes = f"; symmetric about the {' and the '.join(flat.symmetric)} axis" if flat.symmetric else ""
    axes += f"; its halved chroma (JPEG) follows its luma: {counted(len(flat.true), 'colour')}" if flat.restored else ""
    reason, averages, detail = required + seen.sentence + axes, averages_of(rgb, grid), detail_of(rgb, grid)
    read = Design(flat.colours, "flat", reason, flat.foreign, averages=averages, detail=detail)
    return toned_design(read, params.tone)


def _photo(rgb: Rgb, grid: tuple[int, int], params: ReadParams, reason: str, progress: Progress) -> Design:
    averages = resampled(rgb, *grid, progress.part(0.0, 0.8))
    read = Design(averages, "photo", reason, detail=detail_of(rgb, grid))
    return toned_design(read, params.tone, progress.part(0.8, 1.0))
