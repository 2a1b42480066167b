"""All four-bars for nine points, or for poses and points together: known defects removed, the others judged."""

from collections import Counter
from dataclasses import replace

import numpy as np

from ilmek.progress import Progress
from ilmek.records import record
from ilmek.synthesis.alt_burmester.defects import best_drive
from ilmek.synthesis.alt_burmester.four_bars import CompleteFourBar, CompleteFourBars, complete_four_bars
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.filters import REASONS, Filters
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.selection import FourBarSelection, SearchedFamily, single_cures
from ilmek.synthesis.task import PrecisionTask


@record
class CompleteSearch:
    """The four-bars of a task: all, those judged, and why others were not.

    answer   every real four-bar, with and without defects
    judged   those without the defects that the filters remove: of each its answer and its check
    removed  number of those with a defect, by the name of the filter
    """

    answer: CompleteFourBars
    judged: tuple[tuple[CompleteFourBar, Candidate], ...]
    removed: Counter[str]

    def family(self, choice: FourBarSelection) -> SearchedFamily:
        """How many four-bars there are, how many are within all limits, and how many miss each."""
        return SearchedFamily(
            len(self.answer.found), len(choice.kept) + choice.more, self.removed + Counter(choice.counts)
        )

    def cures(self, choice: FourBarSelection) -> tuple[str, ...]:
        """Single limits without which there is a four-bar."""
        defects = sorted(self.removed.items())
        return (
            *(f"{name}=no gives {count} with the defect: {REASONS[name]}" for name, count in defects),
            *single_cures(choice.removed),
        )

    @property
    def words(self) -> tuple[str, ...]:
        """What was found and is no four-bar, as phrases."""
        answer = self.answer
        parts = [f"{count} of {answer.paths} solutions: {reason}" for reason, count in answer.left_out.items()]
        if not answer.complete:
            parts.append("some paths did not end at a solution that stands alone: there may be more four-bars")
        return tuple(parts)


def search(task: PosesAndPoints, filters: Filters, progress: Progress) -> CompleteSearch:
    """All four-bars of a task, those without defects judged. Raises Cancelled."""
    answer = complete_four_bars(task, progress)
    judged, removed = [], Counter[str]()
    for one in answer.found:
        four_bar, defect = best_drive(one, task.points)
        if defect is not None and getattr(filters, defect):
            removed[defect] += 1
        else:
            judged.append((one, _checked(four_bar, one, task)))
    return CompleteSearch(answer, tuple(judged), removed)


def _checked(four_bar: FourBar, bar: CompleteFourBar, task: PosesAndPoints) -> Candidate:
    """The four-bar judged at its known configurations."""
    seen = judge(four_bar, PrecisionTask(points=task.points, coupler=bar.angles))
    # All angles are known, which singles the configurations out; at nine points none of them is required.
    return replace(seen, task=PrecisionTask(points=task.points)) if np.isnan(task.angles).all() else seen
