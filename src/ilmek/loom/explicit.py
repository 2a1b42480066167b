"""The explicit form of a compiled programme, in memory: `LoomProgramme` of a chart and its tying order."""

import hashlib
from collections.abc import Iterable
from dataclasses import astuple, is_dataclass
from functools import cached_property

import numpy as np

from ilmek.arrays import UInt8
from ilmek.errors import LoomError
from ilmek.loom.bobbins import change_stops
from ilmek.loom.operations import LoomProgramme, LoomSetup, RowOperations, Stop
from ilmek.loom.programme import Programme
from ilmek.loom.sharing import halves
from ilmek.progress import SILENT, Progress


class CompiledProgramme:
    """A programme in memory. Its tubes are its yarns: every head has a tube for each."""

    def __init__(self, setup: LoomSetup, programme: Programme) -> None:
        self.setup, self._programme = setup, programme
        self._stops = {stop.row: stop for stop in change_stops(programme.bobbins, programme.rows)}
        self._wefts = {bobbin.yarn: index for index, bobbin in enumerate(setup.wefts)}

    @cached_property
    def digest(self) -> str:
        """SHA-256 of all operations and the chart."""
        return programme_digest(self)

    def operations(self, number: int) -> RowOperations:
        """The operations of a loom row. Raises LoomError beyond the carpet."""
        row, programme = self._programme.row(number), self._programme
        ties, parts = row.ties(), halves(programme.heads)
        widths = np.diff(programme.edges).reshape(programme.heads, parts)
        counts = np.ascontiguousarray(widths if row.forward else widths[:, ::-1], np.int64)
        columns = np.concatenate([one.pairs for one in ties]).astype(np.int32)
        tubes = np.concatenate([one.colours for one in ties])
        return RowOperations(number, columns, tubes, counts, stops=self._stops_of(number))

    def chart_row(self, number: int) -> UInt8[np.ndarray, " columns"]:
        """Yarn of each knot of a loom row. Raises LoomError beyond the carpet."""
        if not 0 <= number < self.setup.rows:
            raise LoomError(f"row {number}", allowed=f"rows 0 to {self.setup.rows - 1}")
        line: UInt8[np.ndarray, " columns"] = self._programme.knots[self.setup.rows - 1 - number]
        return line

    def _stops_of(self, number: int) -> tuple[Stop, ...]:
        stop = self._stops.get(number)
        return () if stop is None else (Stop(number, 0, wefts=tuple(self._wefts[name] for name in stop.yarns)),)


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
