"""The verification manual, computed anew."""

import time
from collections.abc import Sequence
from typing import Any

from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.verification import PAPERS, Verdict, reproduce


@record
class ReproductionResult:
    """The verdicts on the claims of each paper, and the time that they took [s]."""

    verdicts: dict[str, tuple[Verdict, ...]]
    seconds: float

    def as_json(self) -> list[dict[str, Any]]:
        """Every verdict as plain data, in the unit as printed."""
        return [verdict.as_json() for of_paper in self.verdicts.values() for verdict in of_paper]


def reproduce_papers(papers: Sequence[str] = (), *, progress: Progress = SILENT) -> ReproductionResult:
    """Compute every number that the papers print, and judge it.

    papers  names of `PAPERS`; default: all
    Raises ParameterError for an unknown paper; Cancelled between two papers.
    """
    unknown = [paper for paper in papers if paper not in PAPERS]
    if unknown:
        raise ParameterError(f"unknown paper {unknown[0]!r}", allowed=f"papers: {', '.join(PAPERS)}")
    wanted = [paper for paper in PAPERS if paper in papers or not papers]
    begun = time.perf_counter()
    verdicts = {}
    for number, paper in enumerate(wanted):
        progress.part(number / len(wanted), (number + 1) / len(wanted), paper)
        verdicts[paper] = reproduce([paper])
    progress(1.0)
    return ReproductionResult(verdicts, time.perf_counter() - begun)
