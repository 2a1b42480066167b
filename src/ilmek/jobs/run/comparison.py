"""A woven carpet beside its chart, knot by knot."""

import hashlib
from collections.abc import Iterator

import numpy as np

from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.woven import Woven
from ilmek.progress import SILENT, Progress
from ilmek.records import record

MOST_LISTED = 1000
"""Largest number of faulty knots that are listed."""


@record
class Comparison:
    """A woven carpet beside its chart, as far as it is woven.

    missing, double, wrong  numbers of knots: not tied, tied more than once, in another yarn
    listed                  (row, warp pair, fault) of the first MOST_LISTED, from 0
    digest                  SHA-256 of all knots, their yarns and the row ends
    """

    missing: int
    double: int
    wrong: int
    listed: tuple[tuple[int, int, str], ...]
    digest: str

    @property
    def faults(self) -> int:
        """Number of faulty knots."""
        return self.missing + self.double + self.wrong


def compared(programme: LoomProgramme, woven: Woven, certain: int, progress: Progress = SILENT) -> Comparison:
    """Compare a carpet of which a number of knots is certainly woven with its chart."""
    setup = programme.setup
    digest = hashlib.sha256(repr((setup.rows, setup.columns, programme.digest)).encode())
    numbers = {"missing": 0, "double": 0, "wrong": 0}
    listed: list[tuple[int, int, str]] = []
    for row in range(setup.rows):
        counts, yarns = woven.counts(row), woven.yarns(row)
        for one in (counts, yarns, woven.ends(row)):
            digest.update(np.ascontiguousarray(one).tobytes())
        for fault, columns in _faulty(counts, yarns, programme.chart_row(row)):
            numbers[fault] += len(columns)
            if certain == setup.knots or fault != "missing":
                listed += [(row, column, fault) for column in columns[: MOST_LISTED - len(listed)].tolist()]
        progress((row + 1) / setup.rows)
    numbers["missing"] = max(0, numbers["missing"] - (setup.knots - certain))
    return Comparison(**numbers, listed=tuple(listed), digest=digest.hexdigest())


def _faulty(counts: np.ndarray, yarns: np.ndarray, chart: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    yield "missing", np.flatnonzero(counts == 0)
    yield "double", np.flatnonzero(counts > 1)
    yield "wrong", np.flatnonzero((counts == 1) & (yarns != chart))
