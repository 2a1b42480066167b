"""What the host writes into `RowData` for a row, and all rows as CSV for hosts without ilmek."""

from collections.abc import Iterator

import numpy as np

from ilmek.io.plc.sequence_variables import PlcSize
from ilmek.loom.operations import LoomProgramme, RowOperations
from ilmek.progress import SILENT, Progress

ROWS_HEADER = ("row", "head", "number", "phase", "column", "tube", "stop_before")


def row_values(row: RowOperations, size: PlcSize) -> dict[str, list[int] | list[bool]]:
    """The values of the structure's arrays by name; phases that a row lacks repeat its last one."""
    limits = np.cumsum(row.counts, axis=1)
    missing = size.phases - row.phases
    limits = np.concatenate([limits, np.repeat(limits[:, -1:], missing, axis=1)], axis=1)
    stops = {stop.phase for stop in row.stops}
    return {
        "Columns": row.columns.tolist(),
        "Tubes": row.tubes.tolist(),
        "First": row.starts[:-1].tolist(),
        "Limits": limits.ravel().tolist(),
        "StopBefore": [phase in stops for phase in range(size.phases)],
    }


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
