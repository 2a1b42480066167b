"""Contents of a loom programme: carpet, colours, statistics, and one row as the heads tie it."""

import itertools
import random
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from ilmek.errors import LoomError
from ilmek.io.programme_file import ProgrammeFile, open_programme
from ilmek.loom.row import HeadTies, KnotRow
from ilmek.progress import SILENT, Progress


@dataclass(frozen=True, slots=True)
class InspectionResult:
    """A programme (its file is closed), one of its rows, and the time of that row with its wefts [s]."""

    programme: ProgrammeFile
    row: KnotRow
    time: float

    def as_json(self) -> dict[str, Any]:
        """The programme's statistics and the row, SI.

        Rows count from 1 at the bottom and pairs of warps (one knot each) from 1 at the left, as on the printed chart.
        A stop is before its row.
        Yarns are indices of the list `yarn`, from 0.
        """
        programme, row = self.programme, self.row
        label, totals, work = programme.label, programme.totals, programme.work
        return {
            "rows": programme.rows,
            "columns": programme.columns,
            "knots": totals.knots,
            "heads": programme.heads,
            "weaving_time": totals.duration,
            "colour_changes": totals.changes,
            "changes_per_knot": totals.changes_per_knot,
            "size": {"width": label.size.width, "length": label.size.length, "name": label.size.name},
            "quality": {"across": label.quality.across, "along": label.quality.along},
            "knot": label.knot,
            "warp_pitch": label.warp_pitch,
            "times": {name: getattr(programme.times, name) for name in programme.times.__slots__},
            "bobbins": [
                {"yarn": one.yarn, "rows": one.rows, "changes": one.changes(programme.rows), "time": one.time}
                for one in programme.bobbins
            ],
            "stops": [{"row": one.row + 1, "yarns": list(one.yarns), "time": one.time} for one in programme.stops],
            "yarn": [{"name": y.name, "knots": n} for y, n in zip(label.yarns, totals.counts, strict=True)],
            "work": {one.name: getattr(work, one.name) for one in fields(work)},
            "row": {
                "number": row.number + 1,
                "time": self.time,
                "forward": row.forward,
                "heads": [{"pairs": ties.pairs.astype(np.int64) + 1, "yarns": ties.colours} for ties in row.ties()],
            },
        }


def inspect_programme(file: Path, number: int | None = None, *, progress: Progress = SILENT) -> InspectionResult:
    """Read a programme's statistics and one of its rows.

    number  of the row, from 1 at the bottom edge; default: a random row
    Raises LoomError for a row beyond the carpet, and as `open_programme`.
    """
    with open_programme(file, progress=progress.part(0.0, 1.0, "programme")) as programme:
        index = random.randrange(programme.rows) if number is None else _index(number, programme.rows)
        return InspectionResult(programme, programme.row(index), programme.row_time(index))


def _index(number: int, rows: int) -> int:
    """The row's index from 0. Raises LoomError beyond the carpet."""
    if not 1 <= number <= rows:
        raise LoomError(f"there is no row {number}", allowed=f"rows 1 to {rows}, from the bottom")
    return number - 1


def runs(ties: HeadTies) -> list[tuple[int, int, int]]:
    """(first knot, last knot, yarn) of each run of neighbouring knots tied one after the other in one yarn.

    Knots count from 1 at the left, yarns from 0.
    """
    pairs, colours = ties.pairs.astype(np.int64) + 1, ties.colours
    breaks = (np.abs(np.diff(pairs)) != 1) | (np.diff(colours.astype(np.int64)) != 0)
    edges = np.concatenate(([0], np.flatnonzero(breaks) + 1, [len(pairs)])).tolist()
    return [(int(pairs[begin]), int(pairs[end - 1]), int(colours[begin])) for begin, end in itertools.pairwise(edges)]
