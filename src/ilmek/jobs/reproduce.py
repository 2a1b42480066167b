"""Recompute the verification manual."""

import time
from collections.abc import Sequence

from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.verification import PAPERS, Verdict, reproduce


@record
class ReproductionResult:
    """The verdicts on the claims of each paper, and the computing time [s]."""

    verdicts: dict[str, tuple[Verdict, ...]]
    seconds: float

    def as_json(self) -> list[JsonObject]:
        """Every verdict as plain data, in SI."""
        return [verdict.as_json() for of_paper in self.verdicts.values() for verdict in of_paper]


def reproduce_papers(papers: Sequence[str] = (), *, progress: Progress = SILENT) -> ReproductionResult:
    """Recompute the numbers, equations and statements of the papers, with a verdict on each.

    papers  names of `PAPERS`; default: all
    Raises ParameterError for an unknown paper; Cancelled between two papers.
    """
    unknown = [paper for paper in papers if paper not in PAPERS]
    if unknown:
        raise ParameterError(f"unknown paper {unknown[0]!r}", allowed=f"papers: {', '.join(PAPERS)}")
    chosen = [paper for paper in PAPERS if paper in papers or not papers]
    started = time.perf_counter()
    verdicts = {}
    for number, paper in enumerate(chosen):
        progress.part(number / len(chosen), (number + 1) / len(chosen), paper)
        verdicts[paper] = reproduce([paper])
    progress(1.0)
    return ReproductionResult(verdicts, time.perf_counter() - started)
