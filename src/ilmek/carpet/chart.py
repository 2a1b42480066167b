"""Chart: one yarn per knot."""

from collections.abc import Sequence
from dataclasses import field, fields, replace
from typing import Any

import numpy as np

from ilmek.arrays import Indices, Rgb
from ilmek.carpet.bill import YarnBill, yarn_bill
from ilmek.carpet.cells import GROUND_COLOUR, GROUND_YARN, PILE, CellKind, CellMap, require_knots
from ilmek.carpet.chart_reading import ChartReading
from ilmek.carpet.codes import CODES, NO_KNOT, recoded
from ilmek.carpet.design import require_grid
from ilmek.carpet.overlay import Overlay, TiedKnots, no_overlay, require_fit, tied_knots
from ilmek.carpet.quality import Quality, carpet_quality
from ilmek.carpet.sizes import CarpetSize, carpet_size
from ilmek.carpet.statistics import ChartStatistics, chart_statistics
from ilmek.carpet.tally import Tally, tally_of
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn, yarn_list
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress
from ilmek.records import brief, record, shown_value
from ilmek.report.shown import Shown


@record
class Chart(Shown):
    """A knot chart; what is given is checked, and converted where nothing is lost.

    knots    index in `yarns` of each knot's yarn, (rows, columns), NO_KNOT where `cells` have none; row 0 is the top of
             the picture. Any integers, booleans and whole floats become uint8; an array that is so already is kept
    yarns    1 to 255
    size, quality  of the carpet, which has length · along rows and width · across columns; also texts: "30x40cm"
    knot     symmetric or asymmetric, also by a trade name (`parse_knot`): senneh is asymmetric
    reading  how the picture was read
    overlay  half knots and jufti knots; default: none
    creel    the position in the creel of each yarn, 0 to 255: its index in the indexed picture that gave it, and in
             chart.bmp; None: their order
    cells    which cells have no knot, and which a pile of their own; None: every cell is a knot of the carpet's pile
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
    creel: tuple[int, ...] | None = None
    cells: CellMap | None = None
    _tallies: list[Tally] = field(default_factory=list, init=False)
    """The tally, once it is made: many results need it."""

    def __post_init__(self) -> None:
        yarns, size, quality = yarn_list(self.yarns), carpet_size(self.size), carpet_quality(self.quality)
        checked = {
            "yarns": yarns,
            "size": size,
            "quality": quality,
            "knot": parse_knot(self.knot),
            "knots": require_knots(self.knots, self.cells, yarns),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        require_grid(self.knots, size, quality)
        require_fit(self.overlay, self.knots, len(yarns))
        if not len(yarns) == len(set(self.positions)) == len(set(self.positions) & set(range(CODES))):
            given = f"the creel {shown_value(self.creel)}"
            raise CarpetError(given, allowed=f"a position of its own, 0 to {CODES - 1}, for each of {len(yarns)} yarns")

    def __repr__(self) -> str:
        return brief(self, (part.name for part in fields(self) if part.init))

    @classmethod
    def of(
        cls,
        knots: Any,
        yarns: Sequence[Yarn],
        size: str | CarpetSize,
        quality: str | Quality,
        knot: str = "symmetric",
    ) -> "Chart":
        """The chart of an array of indices in `yarns`, row 0 the top; size and quality as texts: "30x40cm", "10x10/dm".

        Yarns without a count have the usual one of the quality. Raises as the class.
        """
        knotted, kind = carpet_quality(quality), parse_knot(knot)
        return cls(knots, with_counts(yarn_list(yarns), knotted, kind), carpet_size(size), knotted, kind)

    @property
    def statistics(self) -> ChartStatistics:
        """Changes of yarn by row, the hardest rows, small patches."""
        return chart_statistics(self)

    def bill(self) -> YarnBill:
        """The yarns to buy, by the usual allowances; `yarn_bill` takes others."""
        return yarn_bill(self)

    @property
    def rows(self) -> int:
        """Rows of knots."""
        return int(self.knots.shape[0])

    @property
    def columns(self) -> int:
        """Knots per row."""
        return int(self.knots.shape[1])

    @property
    def positions(self) -> tuple[int, ...]:
        """The position in the creel of each yarn."""
        return tuple(range(len(self.yarns))) if self.creel is None else self.creel

    def tally(self, progress: Progress = SILENT) -> Tally:
        """The counts of the whole chart, made once."""
        if not self._tallies:
            self._tallies.append(tally_of(self.knots, len(self.yarns), progress))
        return self._tallies[0]

    def read_as(self, reading: ChartReading) -> "Chart":
        """The chart with another record of how it was read; its tally stays."""
        chart = replace(self, reading=reading)
        chart._tallies.extend(self._tallies)
        return chart

    @property
    def counts(self) -> tuple[int, ...]:
        """Cells of each yarn, in the order of `yarns`: its knots where there is no overlay."""
        return self.tally().counts

    @property
    def tied(self) -> TiedKnots:
        """The knots to tie of each yarn: whole, half and jufti."""
        return tied_knots(self.overlay, self.knots, self.counts)

    @property
    def tied_by_kind(self) -> tuple[tuple[CellKind, TiedKnots], ...]:
        """The knots to tie of each yarn, by the kinds of cells that are knots."""
        cells = self.cells
        if cells is None:
            return ((PILE, self.tied),)
        kinds = [index for index, kind in enumerate(cells.kinds) if kind.knotted]
        if len(kinds) == 1:
            return ((cells.kinds[kinds[0]], self.tied),)
        marked, found = cells.index[self.overlay.rows, self.overlay.columns], []
        for index in kinds:
            own = np.bincount(self.knots[cells.index == index], minlength=len(self.yarns)).tolist()
            found.append((cells.kinds[index], tied_knots(self.overlay.only(marked == index), self.knots, tuple(own))))
        return tuple(found)

    @property
    def used(self) -> tuple[int, ...]:
        """The yarns that at least one knot has, by index."""
        tied = self.tied
        return tuple(yarn for yarn in range(len(self.yarns)) if tied.of(yarn))

    @property
    def shades(self) -> tuple[Yarn, ...]:
        """What is seen in a picture of the chart: its yarns, and the ground's where some cells have no knot."""
        bare = self.cells is not None and not self.cells.tied.all()
        return (*self.yarns, GROUND_YARN) if bare else self.yarns

    @property
    def shaded(self) -> Indices:
        """The index in `shades` of each cell."""
        most = np.uint8(len(self.shades) - 1)
        return self.knots if self.cells is None else np.minimum(self.knots, most)

    def yarn(self, code: int) -> Yarn:
        """The yarn of a code of `knots`; of a cell without a knot that of the ground."""
        return GROUND_YARN if code == NO_KNOT else self.yarns[code]

    @property
    def colour_table(self) -> Rgb:
        """The colour of each code of `knots`, (CODES, 3): of its yarn, and of the ground where there is no knot."""
        colours: Rgb = np.full((CODES, 3), GROUND_COLOUR, dtype=np.uint8)
        colours[: len(self.yarns)] = [yarn.srgb for yarn in self.yarns]
        return colours

    @property
    def colours(self) -> int:
        """Number of yarns that at least one knot has."""
        return len(self.used)

    @property
    def dyed(self) -> int:
        """Number of those yarns that are dyed for it."""
        return sum(self.yarns[yarn].name in self.reading.dyed for yarn in self.used)

    @property
    def lone_fraction(self) -> float:
        """Share of lone knots [-]."""
        return self.tally().lone / self.tally().knots

    @property
    def small_patches(self) -> int:
        """Number of patches (8-connected knots of one yarn) of at most SMALL_PATCH knots."""
        return self.tally().small_patches

    @property
    def changes_per_knot(self) -> float:
        """Changes of yarn along the rows, per knot [-]."""
        return self.tally().changes / self.tally().knots


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
    creel = chart.creel and tuple(chart.creel[yarn] for yarn in order)
    knots, overlay = recoded(chart.knots, moved), chart.overlay.with_yarns(moved)
    ordered = rearranged(chart, order, knots, overlay=overlay, creel=creel)
    tally = chart.tally()
    ordered._tallies.append(replace(tally, counts=tuple(tally.counts[yarn] for yarn in order)))
    return ordered


def rearranged(chart: Chart, order: Sequence[int], knots: Indices, **changes: Any) -> Chart:
    """The chart with its yarns in another order, which has the old number of each; several may have the same one.

    knots  by the new numbers      changes  of other fields
    """
    reading, differences_of = chart.reading, chart.reading.differences
    reading = replace(
        reading,
        differences=tuple(differences_of[yarn] for yarn in order) if differences_of else (),
        matches=tuple(match._replace(yarn=order.index(match.yarn)) for match in reading.matches),
        lost=tuple(lost._replace(yarn=order.index(lost.yarn)) for lost in reading.lost),
    )
    yarns = tuple(chart.yarns[yarn] for yarn in order)
    return replace(chart, **{"knots": knots, "yarns": yarns, "reading": reading, **changes})
