"""The rows of a programme as CSV, for the host that writes them into `RowData`."""

from collections.abc import Iterator

import numpy as np

from ilmek.loom.operations import LoomProgramme
from ilmek.progress import SILENT, Progress

ROWS_HEADER = ("row", "head", "number", "phase", "column", "tube", "stop_before")


def rows_csv(programme: LoomProgramme, progress: Progress = SILENT) -> Iterator[str]:
    """Lines of a CSV file: a line for each knot, by row, head and order of tying; all numbers from 0.

    stop_before is 1 for the first knot of a phase before which packages are changed.
    """
    yield ",".join(ROWS_HEADER) + "\n"
    rows = programme.setup.rows
    for number in range(rows):
        row = programme.operations(number)
        stops = {stop.phase for stop in row.stops}
        phases = np.concatenate([np.repeat(np.arange(row.phases), counts) for counts in row.counts])
        heads = np.repeat(np.arange(row.heads), row.counts.sum(axis=1))
        numbers = np.arange(len(heads)) - row.starts[heads]
        first = np.append(True, (np.diff(phases) != 0) | (np.diff(heads) != 0))
        before = first & np.isin(phases, list(stops))
        table = np.stack([np.full_like(heads, number), heads, numbers, phases, row.columns, row.tubes, before], axis=1)
        yield "".join(",".join(map(str, line)) + "\n" for line in table.tolist())
        progress((number + 1) / rows)
