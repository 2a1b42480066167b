"""Chart: one yarn per knot, from a picture, a size, a quality and a yarn list.

The picture is fitted to the carpet (`fitting`) and read as a design with one colour for each knot (`reading`). Each
distinct colour of the design gets the yarn of the least CIEDE2000 difference (`palette`) among those that the rules
leave (`palette_rules`).
"""

from collections.abc import Sequence
from dataclasses import field, fields, replace

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, Indices, Rgb
from ilmek.carpet.codes import eight_bits
from ilmek.carpet.confetti import merge_patches
from ilmek.carpet.design import bands, knot_grid
from ilmek.carpet.differences import YarnDifference, differences
from ilmek.carpet.fitted import fitted_design, unfitted_design
from ilmek.carpet.fitting import Fit, FitParams, prepare_picture
from ilmek.carpet.halftone import draw_halftone
from ilmek.carpet.matches import ColourMatch, colour_matches
from ilmek.carpet.overlay import Overlay, TiedKnots, no_overlay, require_fit, tied_knots
from ilmek.carpet.palette import Colours, distinct_colours, nearest_yarns, paint
from ilmek.carpet.palette_rules import Palette, PaletteParams, choose_yarns
from ilmek.carpet.proposal import ProposedShade, propose_shades
from ilmek.carpet.quality import Quality, carpet_quality
from ilmek.carpet.reading import Design, ReadParams
from ilmek.carpet.recipe.outcome import EditOutcome
from ilmek.carpet.sizes import CarpetSize, carpet_size
from ilmek.carpet.tally import Tally, tally_of
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn, yarn_labs, yarn_list
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, PictureError
from ilmek.progress import SILENT, Progress
from ilmek.records import brief, record
from ilmek.units import counted


@record
class ChartReading:
    """How a picture became a chart.

    kind           exact, flat or photo          reason   of that decision, one sentence
    mean_delta_e   mean CIEDE2000 of the knots' yarns to the design
    least_delta_e  the same if each knot had its nearest yarn of the list: the optimum
    changed        number of knots that were changed because their patch was too small
    foreign        number of knots whose yarn is that of no true colour of their cell; None: no true colours
    fit            how the picture was fitted to the carpet
    differences    of each yarn of the chart to the colours that it is the nearest of; 0 of one that is of none
    edited         number of knots that the edits of a recipe changed
    edits          what became of those that were written on another grid, or have no place on this one
    matches        of each colour of an exact or flat design, most knots first, at most MOST_MATCHES
    palette        how its yarns were chosen from the list; default: they were not
    proposed       shades of the design itself, where they were required
    """

    kind: str
    reason: str
    mean_delta_e: float
    least_delta_e: float
    changed: int = 0
    foreign: int | None = None
    fit: Fit = field(default_factory=Fit)
    differences: tuple[YarnDifference, ...] = ()
    edited: int = 0
    edits: tuple[EditOutcome, ...] = ()
    matches: tuple[ColourMatch, ...] = ()
    palette: Palette = Palette(())
    proposed: tuple[ProposedShade, ...] = ()


@record
class Chart:
    """A knot chart; what is given is checked, and converted where nothing is lost.

    knots    index in `yarns` of each knot's yarn, (rows, columns); row 0 is the top of the picture. Any integers,
             booleans (0 and 1) and whole floats become uint8; an array that is so already is kept, not copied
    yarns    1 to 255
    size, quality  of the carpet, which has length · along rows and width · across columns; also texts: "30x40cm"
    knot     symmetric or asymmetric, also by a trade name (`parse_knot`): senneh is asymmetric
    reading  how the picture was read
    overlay  half knots and jufti knots; default: none
    Raises CarpetError for knots that are no such indices or not those of the size and quality, for an unknown knot, and
    for an overlay that does not fit; YarnError for a list of no or too many yarns.

    >>> from ilmek import read_yarns
    >>> Chart([[0, 1], [1, 1]], read_yarns()[:2], "4x4cm", "5x5/dm", "symmetric").counts
    (1, 3)
    """

    knots: Indices
    yarns: tuple[Yarn, ...]
    size: CarpetSize
    quality: Quality
    knot: str
    reading: ChartReading = field(default_factory=lambda: ChartReading("exact", "drawn knot by knot", 0.0, 0.0))
    overlay: Overlay = field(default_factory=no_overlay)
    _tallies: list[Tally] = field(default_factory=list, init=False)
    """The tally, once it is made: many results need it."""

    def __post_init__(self) -> None:
        yarns, size, quality = yarn_list(self.yarns), carpet_size(self.size), carpet_quality(self.quality)
        meaning = f"the index in a list of {counted(len(yarns), 'yarn')}"
        checked = {
            "yarns": yarns,
            "size": size,
            "quality": quality,
            "knot": parse_knot(self.knot),
            "knots": eight_bits(self.knots, "knots", len(yarns) - 1, meaning, CarpetError),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        _require_grid(self.knots, size, quality)
        require_fit(self.overlay, self.knots, len(yarns))

    def __repr__(self) -> str:
        return brief(self, (part.name for part in fields(self) if part.init))

    @property
    def rows(self) -> int:
        """Rows of knots."""
        return int(self.knots.shape[0])

    @property
    def columns(self) -> int:
        """Knots per row."""
        return int(self.knots.shape[1])

    def tally(self, progress: Progress = SILENT) -> Tally:
        """The counts of the whole chart, made once."""
        if not self._tallies:
            self._tallies.append(tally_of(self.knots, len(self.yarns), progress))
        return self._tallies[0]

    @property
    def counts(self) -> tuple[int, ...]:
        """Cells of each yarn, in the order of `yarns`: its knots where there is no overlay."""
        return self.tally().counts

    @property
    def tied(self) -> TiedKnots:
        """The knots to tie of each yarn: whole, half and jufti."""
        return tied_knots(self.overlay, self.knots, self.counts)

    @property
    def used(self) -> tuple[int, ...]:
        """The yarns that at least one knot has, by index."""
        tied = self.tied
        return tuple(yarn for yarn in range(len(self.yarns)) if tied.of(yarn))

    @property
    def colours(self) -> int:
        """Number of yarns that at least one knot has."""
        return len(self.used)

    @property
    def lone_fraction(self) -> float:
        """Share of lone knots [-]."""
        return self.tally().lone / self.knots.size

    @property
    def small_patches(self) -> int:
        """Number of patches (8-connected knots of one yarn) of at most SMALL_PATCH knots."""
        return self.tally().small_patches

    @property
    def changes_per_knot(self) -> float:
        """Changes of yarn along the rows, per knot [-]."""
        return self.tally().changes / self.knots.size


def _require_grid(knots: Indices, size: CarpetSize, quality: Quality) -> None:
    """Raise CarpetError unless the knots are those of a carpet of this size and quality."""
    grid = knot_grid(size, quality)
    if knots.shape != grid:
        raise CarpetError(
            f"knots of the shape {knots.shape}",
            allowed=f"{grid}, rows and columns of {size} at {quality}",
            do="give the size and quality that these knots have",
        )


def used_first(chart: Chart) -> Chart:
    """The chart with the yarns that it uses first, else in their order; the chart itself where they are.

    A chart is passed on as an indexed picture: its palette then begins with the yarns of the yarn bill, in its order.
    """
    used = chart.used
    order = (*used, *(yarn for yarn in range(len(chart.yarns)) if yarn not in used))
    if order == tuple(range(len(order))):
        return chart
    moved = np.empty(len(order), dtype=np.uint8)
    moved[list(order)] = np.arange(len(order), dtype=np.uint8)
    knots = np.empty_like(chart.knots)
    for band in bands(chart.rows, chart.columns):
        knots[band] = moved[chart.knots[band]]
    tally, differences_of = chart.tally(), chart.reading.differences
    reading = replace(
        chart.reading,
        differences=tuple(differences_of[yarn] for yarn in order) if differences_of else (),
        matches=tuple(match._replace(yarn=int(moved[match.yarn])) for match in chart.reading.matches),
    )
    yarns = tuple(chart.yarns[yarn] for yarn in order)
    ordered = replace(chart, knots=knots, yarns=yarns, reading=reading, overlay=chart.overlay.with_yarns(moved))
    ordered._tallies.append(replace(tally, counts=tuple(tally.counts[yarn] for yarn in order)))
    return ordered


def make_chart(
    rgb: Rgb,
    size: CarpetSize,
    quality: Quality,
    yarns: Sequence[Yarn],
    *,
    knot: str = "symmetric",
    fit: FitParams | None = None,
    reading: ReadParams | None = None,
    palette: PaletteParams | None = None,
    progress: Progress = SILENT,
) -> Chart:
    """The knot chart of a picture.

    rgb   picture, uint8 (height, width, 3)      fit, reading, palette  default: those of the classes
    Raises PictureError for an empty picture, CarpetError for an unknown knot and a grid out of bounds, YarnError for a
    list of less than 2 or more than 255 yarns, and for palette rules that no list of yarns meets.
    """
    if rgb.size == 0:
        raise PictureError("the picture is empty", allowed="at least 1 × 1 pixels")
    yarns = yarn_list(yarns, 2)
    parse_knot(knot)
    fitting, read = fit or FitParams(), reading or ReadParams()
    prepared, fitted = prepare_picture(rgb, fitting, progress.part(0.0, 0.1), size=size)
    exact = unfitted_design(prepared, size, quality, fitting=fitting, reading=read, progress=progress.part(0.1, 0.2))
    if exact is not None:
        design = exact[0]
    else:
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
    progress: Progress = SILENT,
) -> Chart:
    """As `make_chart`, of a design with one colour for each knot, which the caller need not keep.

    Yarns without a count take the usual one of the quality.
    """
    yarns = yarn_list(yarns, 2)
    kind, reading, rules = parse_knot(knot), reading or ReadParams(), palette or PaletteParams()
    distinct = distinct_colours(design.colours, progress.part(0.0, 0.2))
    chosen = choose_yarns(distinct, with_counts(yarns, quality, kind), rules, progress.part(0.2, 0.35))
    proposed = () if rules.propose is None else _proposed(distinct, design, rules.propose, progress.part(0.35, 0.4))
    labs = yarn_labs(chosen.yarns)
    yarn_of, difference = nearest_yarns(distinct, labs, progress.part(0.4, 0.6))
    painted = paint(design.colours, distinct, yarn_of, progress.part(0.6, 0.7))
    knots, drawn = _halftone(painted, design, labs, reading.halftone, progress.part(0.7, 0.8))
    least = reading.least_patch_of(design.kind)
    knots, changed = merge_patches(knots, design.colours, labs, least, kept=drawn, progress=progress.part(0.8, 0.9))
    to_design = differences(
        design.colours, distinct, (yarn_of, difference), (painted, knots), labs, progress.part(0.9, 0.95)
    )
    read = ChartReading(
        design.kind,
        design.reason if drawn is None else f"{design.reason}; patterns on {drawn.mean():.1%} of it",
        to_design.mean,
        to_design.least,
        changed,
        design.foreign,
        fit or Fit(),
        to_design.of_yarns,
        matches=() if design.kind == "photo" else colour_matches(distinct, yarn_of, difference),
        palette=chosen,
        proposed=proposed,
    )
    chart = Chart(knots, chosen.yarns, size, quality, kind, read)
    chart.tally(progress.part(0.95, 1.0))
    return chart


def _halftone(
    knots: Indices, design: Design, labs: FloatArray, strength: float, progress: Progress
) -> tuple[Indices, BoolArray | None]:
    """The chart with its halftone, and the cells that have a pattern; None: no halftone."""
    if strength == 0.0:
        return knots, None
    if design.kind != "photo":
        raise PictureError(
            f"halftone={strength:.0%}, but the picture is read as {design.kind} ({design.reason})",
            allowed="a halftone needs a photo",
            do="read it as a photo (--read photo), or leave the halftone out",
        )
    return draw_halftone(knots, design.colours, labs, strength, progress)


def _proposed(distinct: Colours, design: Design, count: int, progress: Progress) -> tuple[ProposedShade, ...]:
    return propose_shades(distinct, count, drawn=design.kind != "photo", progress=progress)
