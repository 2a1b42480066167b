"""Cells of a chart that have no knot, and knots of a pile of their own.

A chart has one map of cells, or none: then every cell is a knot of the carpet's pile. The map has for each cell the
index of its kind. A kind is a knot, with the height of its pile, cut or loop; plain weave, which stays in the carpet
(kilim ends, bands); or outside: plain ground that is cut away when the carpet is off the loom.

A cell without a knot has the code NO_KNOT among a chart's knots, where the others have the index of their yarn.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import BoolArray, Indices
from ilmek.carpet.codes import CODES, NO_KNOT, eight_bits, recoded
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError
from ilmek.records import record, value_record
from ilmek.sentences import Sentence
from ilmek.units import counted, deg, format_quantity, mm

KNOT, PLAIN, OUTSIDE = "knot", "plain", "outside"
"""What a cell is woven as."""

GROUND_COLOUR = (221, 207, 182)
"""sRGB of a cell without a knot: undyed cotton."""

GROUND_YARN = Yarn(Sentence("cell.no-knot"), GROUND_COLOUR, (83.7, 1.9, 14.2))
"""What a list of the colours of a chart has for cells without a knot."""

TALLEST = 100 * mm
"""Bound of the height of a pile."""

CARVED = (10 * deg, 150 * deg)
"""Bounds of the angle between the sides of a carved line: of scissors held steep and flat; assumed by this project."""


@value_record
class CellKind:
    """A kind of cell.

    name  unique in its map      weave  KNOT, PLAIN or OUTSIDE
    height  of a knot's pile above the knots, after shearing [m]; None: that of the carpet
    loop  the pile is left as a loop, uncut
    Raises CarpetError for an unknown weave, and for a pile of no knot or beyond TALLEST.
    """

    name: str
    weave: str = KNOT
    height: float | None = None
    loop: bool = False

    def __post_init__(self) -> None:
        if self.weave not in (KNOT, PLAIN, OUTSIDE):
            raise CarpetError(f"a cell of the weave {self.weave!r}", allowed=f"{KNOT}, {PLAIN} or {OUTSIDE}")
        if not self.knotted and (self.height is not None or self.loop):
            raise CarpetError(f"{self.name} has a pile", allowed=f"a height and loops for a {KNOT} only")
        if self.height is not None and not 0.0 < self.height <= TALLEST:
            allowed = f"above 0 mm, up to {format_quantity(TALLEST, 'mm')}"
            raise CarpetError(f"the pile of {self.name} is {format_quantity(self.height, 'mm')}", allowed=allowed)

    @property
    def knotted(self) -> bool:
        """Whether its cells are knots."""
        return self.weave == KNOT

    def __str__(self) -> str:
        height = "" if self.height is None else f", {format_quantity(self.height, 'mm')}"
        return f"{self.name}{height}{', loop' if self.loop else ''}"


PILE, PLAIN_GROUND, CUT_AWAY = CellKind(KNOT), CellKind(PLAIN, PLAIN), CellKind(OUTSIDE, OUTSIDE)
"""The kinds of a carpet without a pile map."""


@value_record
class Carving:
    """Lines that are cut into the pile where two colours meet: a groove with the section of a V.

    depth  from the tips of the pile [m]      angle  between the sides [rad]
    yarns  names of those whose borders are carved; (): all
    Raises CarpetError for a depth that no pile has, and for an angle out of CARVED.
    """

    depth: float
    angle: float
    yarns: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "yarns", tuple(self.yarns))
        if not 0.0 < self.depth < TALLEST:
            allowed = f"above 0 mm, below {format_quantity(TALLEST, 'mm')}"
            raise CarpetError(f"lines carved {format_quantity(self.depth, 'mm')} deep", allowed=allowed)
        least, most = CARVED
        if not least <= self.angle <= most:
            allowed = f"{format_quantity(least, 'deg')} to {format_quantity(most, 'deg')}"
            raise CarpetError(f"lines carved at {format_quantity(self.angle, 'deg')}", allowed=allowed)

    @property
    def half_width(self) -> float:
        """Of the groove at the tips of the pile [m]:  depth tan(angle/2)."""
        return self.depth * math.tan(self.angle / 2)

    @property
    def side(self) -> float:
        """Section of what is cut on each side of a line [m²]:  depth half_width / 2."""
        return self.depth * self.half_width / 2


@record
class CellMap:
    """The map of a chart's cells; what is given is checked, and converted where nothing is lost.

    index    in `kinds` of each cell, (rows, columns); row 0 is the top, as in `Chart.knots`
    carving  lines in the pile of the knots; None: none
    Raises CarpetError for an index of no kind, two kinds of one name, and for a map without a knot.

    >>> CellMap([[1, 0], [0, 0]], (PILE, CUT_AWAY)).number(OUTSIDE)
    1
    """

    index: Indices
    kinds: tuple[CellKind, ...]
    carving: Carving | None = None

    def __post_init__(self) -> None:
        kinds = tuple(self.kinds)
        if len({kind.name for kind in kinds}) < len(kinds) or not 0 < len(kinds) < CODES:
            raise CarpetError(f"{len(kinds)} kinds of cells", allowed=f"1 to {CODES - 1}, each with its own name")
        index = eight_bits(self.index, "cells", len(kinds) - 1, f"an index in {len(kinds)} kinds", CarpetError)
        object.__setattr__(self, "kinds", kinds)
        object.__setattr__(self, "index", index)
        if index.ndim != 2 or not self.tied.any():
            raise CarpetError("a map of cells without a knot", allowed="(rows, columns), with at least one knot")

    @property
    def counts(self) -> tuple[int, ...]:
        """Cells of each kind."""
        return tuple(np.bincount(self.index.reshape(-1), minlength=len(self.kinds)).tolist())

    def number(self, weave: str) -> int:
        """Cells of a weave."""
        return sum(count for count, kind in zip(self.counts, self.kinds, strict=True) if kind.weave == weave)

    def are(self, weave: str) -> BoolArray:
        """Which cells have a weave, (rows, columns)."""
        woven: BoolArray = np.array([kind.weave == weave for kind in self.kinds])[self.index]
        return woven

    @property
    def tied(self) -> BoolArray:
        """Which cells are knots, (rows, columns)."""
        return self.are(KNOT)

    def knots(self, knots: Indices) -> Indices:
        """The knots of a chart with NO_KNOT where these cells have none. Raises CarpetError for another grid."""
        if self.index.shape != knots.shape:
            raise CarpetError(f"cells of the shape {self.index.shape}", allowed=f"{knots.shape}, that of the knots")
        if not self.number(PLAIN) + self.number(OUTSIDE):
            return knots
        return np.where(self.tied, knots, np.uint8(NO_KNOT))

    def woven(self, where: BoolArray, kind: CellKind) -> "CellMap":
        """The map with another kind in some cells, (rows, columns)."""
        kinds = self.kinds if kind in self.kinds else (*self.kinds, kind)
        return replace(self, index=np.where(where, np.uint8(kinds.index(kind)), self.index), kinds=kinds)

    def on_grid(
        self, rows: int, columns: int, shown: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)
    ) -> "CellMap":
        """The map on another grid: each cell is of the kind of the cell in which its middle is.

        shown  left, top, right and bottom of the part that the grid covers, as shares of the map, 0 to 1

        >>> CellMap([[1, 0]], (PILE, CUT_AWAY)).on_grid(1, 4).index.tolist()
        [[1, 1, 0, 0]]
        """
        left, top, right, bottom = shown
        height, width = self.index.shape
        row = (height * (top + (bottom - top) * (np.arange(rows) + 0.5) / rows)).astype(int)
        column = (width * (left + (right - left) * (np.arange(columns) + 0.5) / columns)).astype(int)
        return replace(self, index=self.index[np.ix_(row.clip(0, height - 1), column.clip(0, width - 1))])

    def merged(self) -> "CellMap | None":
        """The map with the kinds that a cell has, in their order; None where all cells are knots of the usual
        pile, without carved lines.
        """
        used = [kind for kind, count in zip(self.kinds, self.counts, strict=True) if count]
        if used == [PILE] and self.carving is None:
            return None
        moved = np.array([used.index(kind) if kind in used else 0 for kind in self.kinds], dtype=np.uint8)
        return replace(self, index=recoded(self.index, moved), kinds=tuple(used))


def all_knots(rows: int, columns: int) -> CellMap:
    """The map of a carpet whose cells are all knots of the usual pile."""
    return CellMap(np.zeros((rows, columns), dtype=np.uint8), (PILE,))


def require_knots(knots: Indices, cells: CellMap | None, yarns: Sequence[object]) -> Indices:
    """The knots of a chart as uint8, NO_KNOT where its cells have none. Raises CarpetError for an index of no yarn."""
    meaning = f"the index in a list of {counted(len(yarns), 'yarn')}"
    if cells is None:
        return eight_bits(knots, "knots", len(yarns) - 1, meaning, CarpetError)
    given = cells.knots(eight_bits(knots, "knots", NO_KNOT, meaning, CarpetError))
    eight_bits(np.where(cells.tied, given, np.uint8(0)), "knots", len(yarns) - 1, meaning, CarpetError)
    return given
