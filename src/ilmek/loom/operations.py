"""What a loom does for a carpet, operation by operation: the explicit form of a programme.

Before a row, and between its phases, the loom may stop for changes of packages. In a phase every head ties its knots in
their order, and all heads wait for the slowest. After the last phase come two wefts, two beats and the take-up.

    row:  (stop) phase 0  (stop) phase 1  ...  straight weft, beat, sinuous weft, beat, take-up

Controller, twin and proof work from this form alone. Loom rows count from the carpet's bottom edge.
"""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType
from typing import Protocol

import numpy as np

from ilmek.arrays import Int32, Int64, IntArray, UInt8
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin
from ilmek.records import record, value_record
from ilmek.timing.cyclogram import Cyclogram

EMPTY = 255
"""A tube without yarn: there are at most 255 yarns, numbered from 0."""


class RowEnd(IntEnum):
    """The operations after the knots of a row, in their order."""

    STRAIGHT_WEFT = 0
    FIRST_BEAT = 1
    SINUOUS_WEFT = 2
    SECOND_BEAT = 3
    TAKE_UP = 4


ROW_ENDS = tuple(RowEnd)

WEFT_OF: Mapping[RowEnd, int] = MappingProxyType({RowEnd.STRAIGHT_WEFT: 0, RowEnd.SINUOUS_WEFT: 1})
"""Bobbin of the weft that an operation inserts, an index into `LoomSetup.wefts`; the others insert none."""

LONGEST_PACKAGE = 1e9
"""Largest length of yarn on a package [m]."""


@value_record
class TubeChange:
    """A package of pile yarn put on a tube of a head.

    yarn    index in the carpet's yarn list      length  of yarn on the package [m]
    """

    head: int
    tube: int
    yarn: int
    length: float


@value_record
class Stop:
    """A stop of the loom before a phase of a row, in which an operator changes packages one after the other.

    wefts  indices of the bobbins of weft (`LoomSetup.wefts`) that are changed
    """

    row: int
    phase: int
    wefts: tuple[int, ...] = ()
    tubes: tuple[TubeChange, ...] = ()


@record
class RowOperations:
    """A row: its knots in tying order, head by head, its stops and its end.

    columns  warp pair of each knot, the column of the chart: those of head 0, then those of head 1, ...
    tubes    from which each is tied          counts  knots (heads, phases)
    ends     operations after the knots       stops   before its phases, in order
    """

    number: int
    columns: Int32[np.ndarray, " knots"]
    tubes: UInt8[np.ndarray, " knots"]
    counts: Int64[np.ndarray, "heads phases"]
    ends: tuple[RowEnd, ...] = ROW_ENDS
    stops: tuple[Stop, ...] = ()

    @property
    def heads(self) -> int:
        """Number of heads."""
        return int(self.counts.shape[0])

    @property
    def phases(self) -> int:
        """Number of phases."""
        return int(self.counts.shape[1])

    @property
    def starts(self) -> IntArray:
        """Index of each head's first knot, and behind them the number of knots: (heads + 1,)."""
        return np.concatenate([[0], np.cumsum(self.counts.sum(axis=1))])


@value_record
class OperationTimes:
    """Times of a loom's operations [s].

    knot           a turn of a head's cam shaft, including the step to the next warp pair
    colour_change  standstill of a head while another tube is aligned
    travel         of a head by one knot pitch beyond that step
    row_ends       from the end of the knots to the end of each of `ROW_ENDS`; the last is the whole of it
    tube_change    change of a package of pile yarn in a stop
    """

    knot: float
    colour_change: float
    travel: float
    row_ends: tuple[float, ...]
    tube_change: float


@record
class LoomSetup:
    """The loom, the carpet and the yarns of a programme.

    loom         digest of the loom that it was compiled for
    knot         kind of knot, which every head ties      warp_pitch    distance of two warps [m]
    spacing      least distance of two heads, in knots: of neighbouring heads at any time
    loading      yarn in each tube when the carpet begins, uint8 (heads, tubes); EMPTY: none
    packages     length of yarn in each tube when the carpet begins [m], (heads, tubes)
    knot_yarn    pile yarn of a knot of each yarn [m]
    wefts        bobbins of weft: of the straight and of the sinuous weft
    cyclograms   of a knot and of a row
    row_knots    knots of each row, from the carpet's bottom edge; None: one in every cell
    """

    loom: str
    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]
    warp_pitch: float
    rows: int
    columns: int
    heads: int
    tubes: int
    spacing: int
    times: OperationTimes
    loading: UInt8[np.ndarray, "heads tubes"]
    packages: np.ndarray
    knot_yarn: tuple[float, ...]
    wefts: tuple[Bobbin, ...] = ()
    cyclograms: tuple[Cyclogram, ...] = ()
    row_knots: tuple[int, ...] | None = None

    def require_row(self, number: int) -> None:
        """Raises LoomError for a row beyond the carpet."""
        if not 0 <= number < self.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.rows - 1}")

    @property
    def cells(self) -> int:
        """Cells of the chart, with a knot or without."""
        return self.rows * self.columns

    @property
    def knots(self) -> int:
        """Knots of the carpet."""
        return self.knots_before(self.rows)

    def knots_before(self, row: int) -> int:
        """Knots of the rows before a row."""
        return row * self.columns if self.row_knots is None else sum(self.row_knots[:row])

    def knots_of(self, row: int) -> int:
        """Knots of a row."""
        return self.columns if self.row_knots is None else self.row_knots[row]


class LoomProgramme(Protocol):
    """A programme as controller, twin and proof read it, from a file or from memory."""

    @property
    def setup(self) -> LoomSetup:
        """Loom, carpet and yarns."""

    @property
    def digest(self) -> str:
        """SHA-256 of all operations and the chart, in hexadecimal digits: the identity of the programme."""

    def operations(self, number: int) -> RowOperations:
        """The operations of a loom row. Raises LoomError beyond the carpet, and for a damaged row of a file."""

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of each knot of a loom row, as the chart has it; EMPTY: no knot. Raises LoomError as `operations`."""
