"""One row of a programme, and the knots of each head in it."""

from itertools import pairwise

import numpy as np

from ilmek.arrays import Bool, Indices, IntArray, UInt8
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import LoomError
from ilmek.loom.schedule import PASSES, SWEEP, Layout, Line, replay
from ilmek.loom.sharing import halves, share
from ilmek.records import record

_KINDS = [(np.dtype(np.uint8), 1), (np.dtype(np.uint8), 2), (np.dtype(np.int64), 1)]


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

    Raises LoomError for arrays of another kind or shape, edges that are not those of `heads` heads, and a row that
    cannot be replayed (`invalid_rows`).
    """

    number: int
    colours: Line
    keys: UInt8[np.ndarray, "parts 3"]
    edges: IntArray
    heads: int

    def __post_init__(self) -> None:
        number, colours, keys, edges = self.number, self.colours, self.keys, self.edges
        kinds = [(array.dtype, array.ndim) for array in (colours, keys, edges)]
        if kinds != _KINDS or number < 0:
            raise LoomError(f"row {number} has arrays of another kind", allowed="colours and keys uint8, edges int64")
        if not np.array_equal(edges, share(len(colours), self.heads)) or keys.shape != (len(edges) - 1, 3):
            raise LoomError(f"row {number} has edges or keys of another number of heads", allowed="those of `share`")
        if invalid_rows(number, colours[None], keys[None], edges, MOST_YARNS)[0]:
            raise LoomError(f"row {number} has an order of tying that does not agree with its colours")

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
        colours, keys, edges = (np.ascontiguousarray(array) for array in (self.colours, self.keys, self.edges))
        replay(colours, Layout(MOST_YARNS, int(self.heads), edges), self.forward, keys, order)
        tied, blocks = colours[order], self.edges[:: halves(self.heads)].tolist()
        return tuple(HeadTies(order[low:high], tied[low:high]) for low, high in pairwise(blocks))

    def ties_of(self, head: int) -> HeadTies:
        """The knots of one head, in order. Raises LoomError for an unknown head."""
        if not 0 <= head < self.heads:
            raise LoomError(f"head {head}", allowed=f"heads 0 to {self.heads - 1}")
        return self.ties()[head]


def invalid_rows(
    number: int, colours: Indices, keys: UInt8[np.ndarray, "rows parts 3"], edges: IntArray, yarns: int
) -> Bool[np.ndarray, " rows"]:
    """Whether each of successive rows cannot be replayed: unknown yarns, or keys that no schedule gives.

    number  loom row of the first one      colours  (rows, columns), loom row first
    edges   as `share` gives them          yarns    number of yarns

    A sweep begins with the first knot's colour and ends with the last one's. Passes begin and end with two different
    colours that occur in the part.
    """
    forward = (number + np.arange(len(colours)))[:, None] % 2 == 0
    order, first, last = keys[..., 0], keys[..., 1], keys[..., 2]
    left, right = colours[:, edges[:-1]], colours[:, edges[1:] - 1]
    sweep = (order == SWEEP) & (first == np.where(forward, left, right)) & (last == np.where(forward, right, left))
    passes = (order == PASSES) & (first != last)
    if passes.any():
        widths = np.diff(edges)
        for colour in (first, last):
            same = colours == np.repeat(colour, widths, axis=1)
            passes &= np.logical_or.reduceat(same, edges[:-1], axis=1)
    return np.asarray((colours.max(axis=1) >= yarns) | ~(sweep | passes).all(axis=1))
