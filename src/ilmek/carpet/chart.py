"""Chart: one yarn per knot, from a picture, a size, a quality and a yarn list.

The picture is averaged onto the knot grid (`design`), each distinct colour gets the yarn of the least CIEDE2000
difference (`palette`), and lone knots take the yarn of a neighbour (`isolated_knots`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from ilmek.arrays import Indices, Rgb
from ilmek.carpet.design import bands, knot_grid, resampled
from ilmek.carpet.isolated_knots import count_lone, merge_lone
from ilmek.carpet.palette import best_yarns, distinct_colours, nearest_yarns, paint
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import MOST_YARNS, Yarn, yarn_labs
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import PictureError, YarnError
from ilmek.progress import SILENT, Progress
from ilmek.records import brief, record


@dataclass(frozen=True, slots=True)
class _Tally:
    """Numbers of a chart: knots of each yarn, changes of yarn along the rows, lone knots."""

    counts: tuple[int, ...]
    changes: int
    lone: int


@record
class Chart:
    """A knot chart.

    knots          index in `yarns` of each knot's yarn, (rows, columns); row 0 is the top of the picture
    knot           symmetric or asymmetric
    mean_delta_e   mean CIEDE2000 of the knots' yarns to the averaged picture
    least_delta_e  the same if each knot had its nearest yarn of the list: the optimum
    merged         number of lone knots that were changed
    """

    knots: Indices
    yarns: tuple[Yarn, ...]
    size: CarpetSize
    quality: Quality
    knot: str
    mean_delta_e: float
    least_delta_e: float
    merged: int = 0
    _tallies: list[_Tally] = field(default_factory=list, init=False)
    """The tally, once it is made: many results need it."""

    def __repr__(self) -> str:
        return brief(self, (one.name for one in fields(self) if one.init))

    @property
    def rows(self) -> int:
        """Rows of knots."""
        return int(self.knots.shape[0])

    @property
    def columns(self) -> int:
        """Knots per row."""
        return int(self.knots.shape[1])

    def tally(self, progress: Progress = SILENT) -> _Tally:
        """The counts of the whole chart, made once."""
        if not self._tallies:
            self._tallies.append(_tally(self.knots, len(self.yarns), progress))
        return self._tallies[0]

    @property
    def counts(self) -> tuple[int, ...]:
        """Knots of each yarn, in the order of `yarns`."""
        return self.tally().counts

    @property
    def colours(self) -> int:
        """Number of yarns that at least one knot has."""
        return sum(count > 0 for count in self.counts)

    @property
    def lone_fraction(self) -> float:
        """Share of lone knots [-]."""
        return self.tally().lone / self.knots.size

    @property
    def changes_per_knot(self) -> float:
        """Changes of yarn along the rows, per knot [-]."""
        return self.tally().changes / self.knots.size


def _tally(knots: Indices, yarns: int, progress: Progress) -> _Tally:
    counts = np.zeros(yarns, dtype=np.int64)
    changes = 0
    for band in bands(*knots.shape):
        part = knots[band]
        counts += np.bincount(part.ravel(), minlength=yarns)
        changes += int(np.count_nonzero(part[:, 1:] != part[:, :-1]))
        progress(0.5 * band.stop / len(knots))
    return _Tally(tuple(counts.tolist()), changes, count_lone(knots, progress.part(0.5, 1.0)))


def make_chart(
    rgb: Rgb,
    size: CarpetSize,
    quality: Quality,
    yarns: Sequence[Yarn],
    *,
    knot: str = "symmetric",
    keep_lone: bool = False,
    colours: int | None = None,
    progress: Progress = SILENT,
) -> Chart:
    """The knot chart of a picture.

    rgb        picture, uint8 (height, width, 3)      keep_lone  leave lone knots unchanged
    colours    number of yarns to choose from the list; default: all
    Raises PictureError for an empty picture, CarpetError for an unknown knot and a grid out of bounds, YarnError for a
    list of less than 2 or more than 255 yarns, and for `colours` out of bounds.
    """
    if rgb.size == 0:
        raise PictureError("the picture is empty", allowed="at least 1 × 1 pixels")
    _check_yarns(yarns)
    parse_knot(knot)
    picture = resampled(rgb, *knot_grid(size, quality), progress.part(0.0, 0.4))
    return chart_of_design(
        picture, size, quality, yarns, knot=knot, keep_lone=keep_lone, colours=colours, progress=progress.part(0.4, 1.0)
    )


def chart_of_design(
    picture: Rgb,
    size: CarpetSize,
    quality: Quality,
    yarns: Sequence[Yarn],
    *,
    knot: str = "symmetric",
    keep_lone: bool = False,
    colours: int | None = None,
    progress: Progress = SILENT,
) -> Chart:
    """As `make_chart`, of a picture with one pixel for each knot, which the caller need not keep."""
    _check_yarns(yarns)
    kind = parse_knot(knot)
    distinct = distinct_colours(picture, progress.part(0.0, 0.3))
    chosen = tuple(yarns)
    if colours is not None:
        best = best_yarns(distinct, yarn_labs(yarns), colours, progress.part(0.3, 0.6))
        chosen = tuple(yarns[number] for number in best)
    labs = yarn_labs(chosen)
    yarn_of, difference = nearest_yarns(distinct, labs, progress.part(0.6, 0.8))
    knots = paint(picture, distinct, yarn_of, progress.part(0.8, 0.9))
    lone = progress.part(0.9, 0.95)
    merged, added = (0, 0.0) if keep_lone else merge_lone(knots, picture, distinct, labs, difference, progress=lone)
    least = float(np.sum(distinct.counts * difference))  # not a dot product: its order depends on the threads
    chart = Chart(knots, chosen, size, quality, kind, (least + added) / knots.size, least / knots.size, merged)
    chart.tally(progress.part(0.95, 1.0))
    return chart


def _check_yarns(yarns: Sequence[Yarn]) -> None:
    if not 2 <= len(yarns) <= MOST_YARNS:
        raise YarnError(f"the yarn list has {len(yarns)} yarns", allowed=f"2 to {MOST_YARNS} yarns")
