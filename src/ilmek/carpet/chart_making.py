"""Making of charts: one yarn per knot, from a picture, a size, a quality and a yarn list.

The picture is fitted to the carpet (`fitting`) and read as a design with one colour for each knot (`reading`). Each
distinct colour of the design gets its yarn (`yarns_of_design`). What the chart keeps of the design is measured
(`edges_kept`).
"""

from collections.abc import Sequence
from dataclasses import replace

from ilmek.arrays import BoolArray, FloatArray, Indices, Rgb
from ilmek.carpet.averages import reading_loss
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_reading import ChartReading
from ilmek.carpet.confetti import merge_patches
from ilmek.carpet.detail import detail_kept
from ilmek.carpet.differences import differences
from ilmek.carpet.edges_kept import edges_kept, edges_of
from ilmek.carpet.fitted import fitted_design, shaped_size, unfitted_design
from ilmek.carpet.fitting import Fit, FitParams, prepare_picture
from ilmek.carpet.halftone import draw_halftone
from ilmek.carpet.matches import colour_matches
from ilmek.carpet.palette import distinct_colours, paint
from ilmek.carpet.palette_rules import PaletteParams
from ilmek.carpet.proposal import propose_shades
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import Design, ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn, yarn_labs, yarn_list
from ilmek.carpet.yarns_of_design import YarnsOfDesign, yarns_of_design
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import PictureError
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence


def make_chart(
    rgb: Rgb,
    size: CarpetSize | None,
    quality: Quality,
    yarns: Sequence[Yarn],
    *,
    knot: str = "symmetric",
    fit: FitParams | None = None,
    reading: ReadParams | None = None,
    palette: PaletteParams | None = None,
    dyed: bool = False,
    progress: Progress = SILENT,
) -> Chart:
    """The knot chart of a picture.

    rgb   picture, uint8 (height, width, 3)      size  None: in the shape of the picture, of which `fit` may give a side
    dyed  the yarns are the picture's own shades, dyed to order, and those of the list that one of them is
    fit, reading, palette  default: those of the classes
    Raises PictureError for an empty picture, CarpetError for an unknown knot and a grid out of bounds, YarnError for a
    list of less than 2 or more than 255 yarns, and for palette rules that no list of yarns meets.
    """
    if rgb.size == 0:
        raise PictureError("the picture is empty", allowed="at least 1 × 1 pixels")
    yarns = yarn_list(yarns, 2)
    parse_knot(knot)
    fitting, read = fit or FitParams(), reading or ReadParams()
    size = size or fitting.size
    prepared, fitted = prepare_picture(rgb, fitting, progress.part(0.0, 0.1), size=size)
    exact = unfitted_design(prepared, size, quality, fitting=fitting, reading=read, progress=progress.part(0.1, 0.2))
    if exact is not None:
        design, size, quality = exact
    else:
        size = size or shaped_size(prepared, quality, fitting)
        design, _, fitted = fitted_design(
            prepared, fitted, size, quality, fitting=fitting, reading=read, progress=progress.part(0.2, 0.4)
        )
    return chart_of_design(
        design,
        size,
        quality,
        yarns,
        knot=knot,
        fit=fitted,
        reading=reading,
        palette=palette,
        dyed=dyed,
        progress=progress.part(0.4, 1.0),
    )


def chart_of_design(
    design: Design,
    size: CarpetSize,
    quality: Quality,
    yarns: Sequence[Yarn],
    *,
    knot: str = "symmetric",
    fit: Fit | None = None,
    reading: ReadParams | None = None,
    palette: PaletteParams | None = None,
    dyed: bool = False,
    chosen: bool = False,
    exact: Rgb | None = None,
    progress: Progress = SILENT,
) -> Chart:
    """As `make_chart`, of a design with one colour for each knot, which the caller need not keep.

    chosen  the yarns are shades that were chosen for this picture: its tones are not stretched onto them
    exact  the colours of the design where it has them rounded: the patterns of a halftone are drawn to them
    Yarns without a count take the usual one of the quality.
    """
    yarns = yarn_list(yarns, 2)
    kind, reading, rules = parse_knot(knot), reading or ReadParams(), palette or PaletteParams()
    distinct = design.distinct or distinct_colours(design.colours, progress.part(0.0, 0.2))
    counted_yarns, choosing = with_counts(yarns, quality, kind), progress.part(0.2, 0.6)
    own = yarns_of_design(distinct, design, counted_yarns, rules, dyed=dyed, chosen=chosen, progress=choosing)
    labs = yarn_labs(own.palette.yarns)
    painted = paint(design.colours, distinct, own.yarn_of, progress.part(0.6, 0.7))
    tones = design if exact is None else replace(design, colours=exact)
    knots, changed, drawn = _without_patches(painted, tones, own, reading, progress.part(0.7, 0.9))
    taken, charts = (own.yarn_of, own.difference), (painted, knots)
    to_design = differences(design.colours, distinct, taken, charts, labs, progress.part(0.9, 0.95))
    lost_by_reading = reading_loss(design.colours, design.averages, knots, labs)
    read = ChartReading(
        design.kind,
        _reason(design, drawn, stretched=own.stretched),
        to_design.mean + lost_by_reading,
        own.least + lost_by_reading,
        changed,
        design.foreign,
        fit or Fit(),
        to_design.of_yarns,
        matches=() if own.groups is None else colour_matches(distinct, own.yarn_of, own.difference, own.groups),
        palette=own.palette,
        proposed=own.proposed
        if rules.propose is None
        else propose_shades(distinct, rules.propose, drawn=own.groups is not None, progress=progress),
        dyed=tuple(shade.name for shade in own.proposed),
        lost=own.lost(distinct),
        edges_kept=edges_kept(own.edges or edges_of(design.colours, distinct, design.averages), knots, labs),
        detail_kept=detail_kept(design.detail, knots, labs, photo=design.kind == "photo"),
        paper=design.paper,
    )
    chart = Chart(knots, own.palette.yarns, size, quality, kind, read)
    chart.tally(progress.part(0.95, 1.0))
    return chart


def _without_patches(
    painted: Indices, tones: Design, own: YarnsOfDesign, reading: ReadParams, progress: Progress
) -> tuple[Indices, int, BoolArray | None]:
    """The chart with its halftone and without small patches, the knots that these changed, and the dots as below."""
    labs = yarn_labs(own.palette.yarns)
    knots, dots = _halftone(painted, tones, labs, own.least, reading.halftone, progress.part(0.0, 0.5))
    least, merging = reading.least_patch_of(tones.kind), progress.part(0.5, 1.0)
    return *merge_patches(knots, tones.colours, labs, least, kept=dots, progress=merging), dots


def _halftone(  # noqa: PLR0917
    knots: Indices, design: Design, labs: FloatArray, off: float, share: float | None, progress: Progress
) -> tuple[Indices, BoolArray | None]:
    """The chart with its halftone, and the cells that are dots; None: no halftone."""
    photo = design.kind == "photo"
    strength = float(photo) if share is None else share
    if strength == 0.0:
        return knots, None
    if not photo:
        raise PictureError(
            Sentence("picture.halftone", share=f"{strength:.0%}", kind=design.kind, reason=design.reason),
            allowed=Sentence("picture.halftone-allowed"),
            do=Sentence("picture.halftone-do"),
        )
    return draw_halftone(knots, design.colours, labs, strength, off=off, progress=progress)


def _reason(design: Design, dots: BoolArray | None, *, stretched: bool) -> str:
    """Why the design was read so, what was done to the tones of a photo, and how to have the other."""
    reason = f"{design.reason}; tones stretched onto the yarns" if stretched else design.reason
    if design.kind != "photo":
        return reason
    if dots is None:
        return f"{reason}; no patterns between the yarns (with: --halftone 100%)"
    return f"{reason}; patterns on {dots.mean():.1%} of it (without: --halftone 0%)"
