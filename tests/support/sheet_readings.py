"""`make campaigns PARTS=sheets`: photographed sheets at random and how they are read; ends with 1 for a finding.

    python -m sheet_readings --seed 7 --number 30

A finding is what nobody would notice: a wrong cell that is not doubtful, or a wrong grid whose checks hold.
"""

import argparse
import sys
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from sheets import Sheet, random_sheet

from ilmek.carpet.paper.sheet import PaperReading, read_sheet
from ilmek.errors import PictureError
from ilmek.jobs.paper import reading_checks


@dataclass(frozen=True)
class Outcome:
    """How a sheet was read: its verdict, its cells, those wrong, those of them not doubtful, and those doubtful.

    holds: none of its checks fails
    """

    verdict: str
    cells: int
    wrong: int = 0
    silent: int = 0
    doubtful: int = 0
    holds: bool = False

    @property
    def is_finding(self) -> bool:
        """Whether something is wrong and nobody is told."""
        return self.silent > 0 or self.verdict == "wrong grid, silent"


def wrong_cells(paper: PaperReading, truth: NDArray[np.int64]) -> NDArray[np.bool_]:
    """The cells whose colour is not the one that most cells of their number have."""
    meant = [np.bincount(truth[paper.numbers == number]).argmax() for number in range(len(paper.palette))]
    return np.asarray(np.array(meant)[paper.numbers] != truth)


def outcome(sheet: Sheet) -> Outcome:
    """Read a sheet and compare it with its truth."""
    cells = int(sheet.truth.size)
    try:
        paper = read_sheet(sheet.picture)
    except PictureError:
        return Outcome("refused", cells)
    holds = all(check.ok for check in reading_checks(paper))
    if paper.grid != sheet.truth.shape:
        return Outcome(f"wrong grid, {'silent' if holds else 'a check fails'}", cells, holds=holds)
    wrong = wrong_cells(paper, sheet.truth)
    silent = int(np.count_nonzero(wrong & ~paper.doubtful))
    return Outcome("read", cells, int(np.count_nonzero(wrong)), silent, paper.doubts, holds)


def main() -> int:
    """Read the sheets, print a line for each and the sums."""
    parser = argparse.ArgumentParser(prog="python -m sheet_readings", description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="of the sheets; default: 1")
    parser.add_argument("--number", type=int, default=30, help="of sheets; default: 30")
    given = parser.parse_args()
    first = 1000 * given.seed
    outcomes: list[Outcome] = []
    for seed in range(first, first + given.number):
        sheet, begin = random_sheet(seed), time.process_time()
        outcomes.append(outcome(sheet))
        _show(seed, sheet, outcomes[-1], time.process_time() - begin)
    read = [one for one in outcomes if one.verdict == "read"]
    cells, wrong = sum(one.cells for one in read), sum(one.wrong for one in read)
    sys.stdout.write(
        f"{len(read)} of {len(outcomes)} sheets have their grid, {sum(not one.holds for one in read)} of these with a "
        f"check that fails; {wrong:,} of their {cells:,} cells wrong, "
        f"{sum(one.silent for one in read)} of these not doubtful; {sum(one.doubtful for one in read)} cells doubtful\n"
    )
    return int(any(one.is_finding for one in outcomes))


def _show(seed: int, sheet: Sheet, found: Outcome, seconds: float) -> None:
    rows, columns = sheet.truth.shape
    sys.stdout.write(
        f"{seed}: {columns} × {rows}, {found.verdict}, {found.wrong} wrong, {found.silent} of these not doubtful, "
        f"{found.doubtful} doubtful, {seconds:.1f} s\n"
    )
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
