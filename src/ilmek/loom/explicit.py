"""The explicit form of a compiled programme, in memory: `LoomProgramme` of a chart and its tying order."""

import hashlib
from collections.abc import Iterable
from dataclasses import astuple, is_dataclass
from functools import cached_property

import numpy as np

from ilmek.arrays import UInt8
from ilmek.loom.operations import LoomProgramme, LoomSetup, RowOperations, Stop
from ilmek.loom.planner import divided
from ilmek.loom.programme import Programme
from ilmek.loom.replay import Layout, expand
from ilmek.progress import SILENT, Progress


class CompiledProgramme:
    """A programme in memory; its rows are made from the compiler's keys when they are read, quickest in their order."""

    def __init__(self, setup: LoomSetup, programme: Programme) -> None:
        self.setup, self._programme = setup, programme
        self._stops: dict[int, tuple[Stop, ...]] = {}
        for stop in programme.stops:
            self._stops[stop.row] = (*self._stops.get(stop.row, ()), stop)
        self._layout = Layout(programme.heads, divided(programme.edges, programme.blocks))
        self._next, self._loaded = 0, programme.tubes.loading.copy()

    @cached_property
    def digest(self) -> str:
        """SHA-256 of all operations and the chart."""
        return programme_digest(self)

    def operations(self, number: int) -> RowOperations:
        """The operations of a loom row. Raises LoomError beyond the carpet."""
        self.setup.require_row(number)
        made, tubes = self._programme, self._programme.tubes
        loaded = self._loaded if number == self._next else tubes.loaded(number * tubes.phases - 1)
        line = tubes.lines(made.knots, number, number + 1, loaded)[0]
        self._next, self._loaded = number + 1, loaded
        columns = np.empty(made.columns, np.int32)
        counts = np.zeros((made.heads, tubes.phases), np.int64)
        columns = columns[: expand(line, self._layout, number % 2 == 0, made.keys[number], columns, counts)]
        return RowOperations(number, columns, line[columns], counts, stops=self._stops.get(number, ()))

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of each knot of a loom row. Raises LoomError beyond the carpet."""
        self.setup.require_row(number)
        line: UInt8[np.ndarray, " columns"] = self._programme.knots[self.setup.rows - 1 - number]
        return line


def programme_digest(programme: LoomProgramme, progress: Progress = SILENT) -> str:
    """SHA-256 of a programme: its loom, sizes and loading, and of each row the operations and the chart's knots."""
    setup = programme.setup
    found = hashlib.sha256()
    for text in _setup_texts(setup):
        found.update(text.encode() + b"\n")
    found.update(np.ascontiguousarray(setup.loading).tobytes())
    found.update(np.ascontiguousarray(setup.packages, np.float64).tobytes())
    for number in range(setup.rows):
        row = programme.operations(number)
        found.update(repr((row.number, tuple(map(int, row.ends)), [astuple(stop) for stop in row.stops])).encode())
        for array in (row.columns, row.tubes, row.counts, programme.chart_row(number)):
            found.update(np.ascontiguousarray(array).tobytes())
        progress((number + 1) / setup.rows)
    return found.hexdigest()


def _setup_texts(setup: LoomSetup) -> Iterable[str]:
    names = ("loom", "size", "quality", "knot", "yarns", "warp_pitch", "rows", "columns", "heads", "tubes", "spacing",
             "times", "knot_yarn", "wefts")  # fmt: skip
    for name in names:
        value = getattr(setup, name)
        many = value if isinstance(value, tuple) else (value,)
        yield f"{name}={[astuple(one) if is_dataclass(one) and not isinstance(one, type) else one for one in many]!r}"
