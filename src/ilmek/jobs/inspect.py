"""Contents of a loom programme: carpet, colours, statistics, and one row as the heads tie it."""

import itertools
import random
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from ilmek.arrays import Int32, UInt8
from ilmek.errors import LoomError
from ilmek.io.programme_file import ProgrammeFile, open_programme
from ilmek.loom.account import stop_duration
from ilmek.loom.operations import RowOperations, Stop
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report import Json


@record
class HeadTies:
    """The knots of a head in a row, in order: warp pair (column of the chart) and yarn of each, as the chart has it."""

    pairs: Int32[np.ndarray, " knots"]
    yarns: UInt8[np.ndarray, " knots"]


@dataclass(frozen=True, slots=True)
class InspectionResult:
    """A programme (its file is closed), its stops, one of its rows, and the time of that row with its wefts [s]."""

    programme: ProgrammeFile
    stops: tuple[Stop, ...]
    row: RowOperations
    ties: tuple[HeadTies, ...]
    time: float

    @property
    def forward(self) -> bool:
        """Whether the row is woven to the right: its last knot of the first head is right of the first one."""
        first = self.ties[0].pairs
        return len(first) == 0 or bool(first[0] <= first[-1])

    def as_json(self) -> JsonObject:
        """The programme's statistics and the row, SI.

        Rows count from 1 at the bottom and pairs of warps (one knot each) from 1 at the left, as on the printed chart.
        Heads, tubes and phases count from 1. A stop is before a phase of its row. Yarns are indices of the list `yarn`,
        from 0.
        """
        programme, row, setup = self.programme, self.row, self.programme.setup
        totals, work, times = programme.totals, programme.work, setup.times
        return {
            "rows": setup.rows,
            "columns": setup.columns,
            "knots": totals.knots,
            "heads": setup.heads,
            "tubes": setup.tubes,
            "loom": setup.loom,
            "digest": programme.digest,
            "weaving_time": totals.duration,
            "colour_changes": totals.changes,
            "changes_per_knot": totals.changes_per_knot,
            "size": {"width": setup.size.width, "length": setup.size.length, "name": setup.size.name},
            "quality": {"across": setup.quality.across, "along": setup.quality.along},
            "knot": setup.knot,
            "warp_pitch": setup.warp_pitch,
            "times": {
                "knot": times.knot,
                "colour_change": times.colour_change,
                "travel": times.travel,
                "weft": times.row_ends[-1],
                "row_ends": list(times.row_ends),
                "tube_change": times.tube_change,
            },
            "bobbins": [
                {"yarn": weft.yarn, "rows": weft.rows, "changes": weft.changes(setup.rows), "time": weft.time}
                for weft in setup.wefts
            ],
            "stops": [self._stop_json(stop) for stop in self.stops],
            "yarn": [{"name": y.name, "knots": n} for y, n in zip(setup.yarns, totals.counts, strict=True)],
            "work": {field.name: getattr(work, field.name) for field in fields(work)},
            "row": {
                "number": row.number + 1,
                "time": self.time,
                "forward": self.forward,
                "heads": [{"pairs": ties.pairs.astype(np.int64) + 1, "yarns": ties.yarns} for ties in self.ties],
            },
        }

    def _stop_json(self, stop: Stop) -> dict[str, Json]:
        setup = self.programme.setup
        return {
            "row": stop.row + 1,
            "phase": stop.phase + 1,
            "yarns": [setup.wefts[index].yarn for index in stop.wefts],
            "tubes": [
                {"head": tube.head + 1, "tube": tube.tube + 1, "yarn": tube.yarn, "length": tube.length}
                for tube in stop.tubes
            ],
            "time": stop_duration(stop, setup.wefts, setup.times.tube_change),
        }


def inspect_programme(file: Path, number: int | None = None, *, progress: Progress = SILENT) -> InspectionResult:
    """Read a programme's statistics and one of its rows.

    number  of the row, from 1 at the bottom edge; default: a random row
    Raises LoomError for a row beyond the carpet, and as `open_programme`.
    """
    with open_programme(file, progress=progress.part(0.0, 1.0, "programme")) as programme:
        rows = programme.setup.rows
        index = random.randrange(rows) if number is None else _index(number, rows)
        row, colours, stops = programme.operations(index), programme.chart_row(index), tuple(programme.stops())
        heads = itertools.pairwise(row.starts.tolist())
        ties = tuple(HeadTies(row.columns[low:high], colours[row.columns[low:high]]) for low, high in heads)
        return InspectionResult(programme, stops, row, ties, float(programme.row_times[index]))


def _index(number: int, rows: int) -> int:
    """The row's index from 0. Raises LoomError beyond the carpet."""
    if not 1 <= number <= rows:
        raise LoomError(f"there is no row {number}", allowed=f"rows 1 to {rows}, from the bottom")
    return number - 1


def runs(ties: HeadTies) -> list[tuple[int, int, int]]:
    """(first knot, last knot, yarn) of each run of neighbouring knots tied one after the other in one yarn.

    Knots count from 1 at the left, yarns from 0.
    """
    pairs, yarns = ties.pairs.astype(np.int64) + 1, ties.yarns
    if not len(pairs):
        return []
    breaks = (np.abs(np.diff(pairs)) != 1) | (np.diff(yarns.astype(np.int64)) != 0)
    edges = np.concatenate(([0], np.flatnonzero(breaks) + 1, [len(pairs)])).tolist()
    return [(int(pairs[begin]), int(pairs[end - 1]), int(yarns[begin])) for begin, end in itertools.pairwise(edges)]
