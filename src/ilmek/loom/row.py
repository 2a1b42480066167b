"""One row of a programme, and the knots of each head in it."""

from itertools import pairwise

import numpy as np

from ilmek.arrays import IntArray, UInt8
from ilmek.errors import LoomError
from ilmek.loom.schedule import PASSES, Layout, Line, replay
from ilmek.loom.sharing import halves
from ilmek.records import record

_ALL_COLOURS = 255


@record
class HeadTies:
    """The knots of a head in a row, in order: warp pair (column of the chart) and yarn of each."""

    pairs: IntArray
    colours: Line


@record
class KnotRow:
    """A row of knots of a programme.

    number   loom row, 0 at the carpet's bottom edge: even rows run from column 0, odd rows back
    colours  yarn of each knot, by column        keys  uint8 (parts, 3), see `loom.schedule`
    edges    of the parts, see `loom.sharing`
    """

    number: int
    colours: Line
    keys: UInt8[np.ndarray, "parts 3"]
    edges: IntArray
    heads: int

    @property
    def forward(self) -> bool:
        """Whether the row runs from column 0."""
        return self.number % 2 == 0

    def passes(self, head: int) -> tuple[bool, ...]:
        """For each part of a head, from left to right: whether it is tied colour by colour."""
        parts = halves(self.heads)
        return tuple(bool(key == PASSES) for key in self.keys[head * parts : (head + 1) * parts, 0])

    def ties(self) -> tuple[HeadTies, ...]:
        """The knots of each head, in order."""
        order = np.empty(len(self.colours), np.int64)
        colours = np.ascontiguousarray(self.colours)
        replay(colours, Layout(_ALL_COLOURS, self.heads, self.edges), self.forward, self.keys, order)
        tied, blocks = colours[order], self.edges[:: halves(self.heads)].tolist()
        return tuple(HeadTies(order[low:high], tied[low:high]) for low, high in pairwise(blocks))

    def ties_of(self, head: int) -> HeadTies:
        """The knots of one head, in order. Raises LoomError for an unknown head."""
        if not 0 <= head < self.heads:
            raise LoomError(f"head {head}", allowed=f"heads 0 to {self.heads - 1}")
        return self.ties()[head]
