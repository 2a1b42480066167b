"""The woven carpet: how often a knot was tied at each warp pair and in which yarn, and which row ends were carried out.

It is the physical truth of the twin, in any memory of `woven_size` bytes; `io.woven_file` maps it to a file. It also
holds what a loom does not lose when its control fails: its clock, the positions of its heads, its yarn.

    words of 8 bytes
        time; rows left of each bobbin of weft; for each head: column, tube, yarn left in each tube, yarn of each tube
    words of 2 bytes, row by row from the bottom edge, from the left
        times that a knot was tied + 256 * yarn of the last one
    bytes, row by row from the bottom edge
        times that each of the operations after the knots was carried out

A knot is one store of two bytes: a process that is killed leaves it as it was or as it is.
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import UInt8
from ilmek.errors import LoomError
from ilmek.loom.operations import EMPTY, LONGEST_PACKAGE, ROW_ENDS, LoomSetup, RowEnd
from ilmek.loom.twin.model import PlantModel, nanometres
from ilmek.loom.twin.state import NOWHERE, HeadCondition, LoomCondition, PlantHead, PlantState

MOST_TIMES = 255
"""Largest number of times that is counted for a knot and for an operation."""


class Woven:
    """The woven carpet in a memory, which it changes in place. The memory of a new carpet is full of zeros."""

    def __init__(self, setup: LoomSetup, memory: bytearray | memoryview) -> None:
        if len(memory) != woven_size(setup):
            raise LoomError(f"a woven carpet of {len(memory)} bytes", allowed=f"{woven_size(setup)} bytes")
        self.rows, self.columns = setup.rows, setup.columns
        self._tubes, self._first = setup.tubes, _first_head(setup)
        view, words, knots = memoryview(memory), 8 * _words(setup), 2 * setup.cells
        self._words = view[:words].cast("q")
        self._knots = view[words : words + knots].cast("H")
        self._ends = view[words + knots :].cast("B")

    def tie(self, row: int, column: int, yarn: int) -> None:
        """Count a knot, in a yarn."""
        index = row * self.columns + column
        times = (self._knots[index] & 255) + 1
        self._knots[index] = (times if times < MOST_TIMES else MOST_TIMES) | yarn << 8

    def end(self, row: int, operation: RowEnd) -> None:
        """Count an operation after the knots of a row."""
        index = row * len(ROW_ENDS) + operation
        self._ends[index] = min(self._ends[index] + 1, MOST_TIMES)

    def take_out(self, first: int, last: int) -> None:
        """The rows from one to another are taken out."""
        for row in range(first, min(last + 1, self.rows)):
            self._ends[row * len(ROW_ENDS) : (row + 1) * len(ROW_ENDS)] = memoryview(bytes(len(ROW_ENDS)))
            self._row(row)[:] = 0

    def times_tied(self, row: int, column: int) -> int:
        """How often a knot was tied at a warp pair of a row."""
        return self._knots[row * self.columns + column] & 255

    def times_ended(self, row: int, operation: RowEnd) -> int:
        """How often an operation after the knots of a row was carried out."""
        return self._ends[row * len(ROW_ENDS) + operation]

    def counts(self, row: int) -> UInt8[np.ndarray, " columns"]:
        """How often a knot was tied at each warp pair of a row."""
        return (self._row(row) & 255).astype(np.uint8)

    def yarns(self, row: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of the last knot at each warp pair of a row; EMPTY: none."""
        knots = self._row(row)
        return np.where(knots & 255, knots >> 8, EMPTY).astype(np.uint8)

    def ends(self, row: int) -> UInt8[np.ndarray, " operations"]:
        """How often each of `ROW_ENDS` was carried out after a row."""
        return np.frombuffer(self._ends, np.uint8, len(ROW_ENDS), row * len(ROW_ENDS)).copy()

    def _row(self, row: int) -> np.ndarray:
        return np.frombuffer(self._knots, np.uint16, self.columns, 2 * row * self.columns)

    def keep_knot(self, time: int, index: int, head: PlantHead) -> None:
        """Keep the state of the loom behind a knot of a head."""
        at, words = self._first + index * (2 + 2 * self._tubes), self._words
        words[0], words[at], words[at + 1] = time, head.column, head.tube
        words[at + 2 + head.tube] = head.left[head.tube]

    def keep(self, state: PlantState) -> None:
        """Keep the state of the loom."""
        for index, value in enumerate(state_words(state)):
            self._words[index] = value

    def restored(self, plant: PlantModel) -> PlantState:
        """The loom as it was kept, with all axes at rest. Raises LoomError for a state that no loom can be in."""
        return state_of_words(plant, self._words.tolist())

    def release(self) -> None:
        """Release the memory; nothing can be read or written afterwards."""
        for view in (self._words, self._knots, self._ends):
            view.release()


def woven_size(setup: LoomSetup) -> int:
    """Bytes of the memory of a woven carpet."""
    return 8 * _words(setup) + 2 * setup.cells + len(ROW_ENDS) * setup.rows


def state_words(state: PlantState) -> tuple[int, ...]:
    """What a loom keeps without its control, as whole numbers: see the module."""
    state_words = [state.time, *state.condition.wefts]
    for head in state.heads:
        state_words += [head.column, head.tube, *head.left, *head.condition.yarns]
    return tuple(state_words)


def state_of_words(plant: PlantModel, words: Sequence[int]) -> PlantState:
    """The loom of `state_words`, with all axes at rest. Raises LoomError for a state that no loom can be in."""
    setup, tubes = plant.setup, plant.setup.tubes
    if len(words) != _words(setup):
        raise LoomError(f"a state of {len(words)} numbers", allowed=f"{_words(setup)} numbers")
    heads = []
    for index in range(setup.heads):
        at = _first_head(setup) + index * (2 + 2 * tubes)
        left, yarns = tuple(words[at + 2 : at + 2 + tubes]), tuple(words[at + 2 + tubes : at + 2 + 2 * tubes])
        _require_head(setup, words[at], words[at + 1], left, yarns)
        heads.append(PlantHead(words[at], words[at + 1], left, HeadCondition(yarns)))
    wefts = tuple(words[1 : _first_head(setup)])
    if words[0] < 0 or any(not 0 <= rows <= one.rows for rows, one in zip(wefts, setup.wefts, strict=True)):
        raise LoomError(f"a loom at time {words[0]} with weft for {wefts} rows", allowed="a state of this loom")
    return PlantState(words[0], tuple(heads), LoomCondition(wefts))


def _words(setup: LoomSetup) -> int:
    return _first_head(setup) + setup.heads * (2 + 2 * setup.tubes)


def _first_head(setup: LoomSetup) -> int:
    return 1 + len(setup.wefts)


def _require_head(setup: LoomSetup, column: int, tube: int, left: tuple[int, ...], yarns: tuple[int, ...]) -> None:
    sound = NOWHERE <= column < setup.columns and NOWHERE <= tube < setup.tubes
    sound = sound and all(yarn == EMPTY or 0 <= yarn < len(setup.yarns) for yarn in yarns)
    if not sound or not all(0 <= length <= nanometres(LONGEST_PACKAGE) for length in left):
        raise LoomError(f"a head at column {column} with tube {tube}", allowed="a state of this loom")
