"""Designs that are evaluated into a results file; those that it has already are read from it."""

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError
from ilmek.progress import SILENT, Progress
from ilmek.studies.store import COMMIT, StudyFile, StudyRows
from ilmek.studies.variable import Variable, settings_of
from ilmek.studies.workers import Workers


class DesignRecorder:
    """Evaluates designs one batch after another; a method that is deterministic goes on where it was interrupted.

    total  number of designs that are expected, for the progress
    """

    def __init__(
        self,
        file: StudyFile,
        variables: tuple[Variable, ...],
        workers: Workers,
        total: int,
        progress: Progress = SILENT,
    ) -> None:
        self.file, self.variables, self.workers = file, variables, workers
        self._total, self._progress = total, progress
        self.evaluations = 0

    def __call__(self, points: Float[np.ndarray, "n variables"]) -> StudyRows:
        """The designs with these values [SI], in order. Raises ParameterError where the file has others; Cancelled."""
        first, known = self.evaluations, len(self.file)
        self.evaluations += len(points)
        stored = self.file.designs(first, min(first + len(points), known)).points
        if not np.array_equal(stored, points[: len(stored)]):
            raise ParameterError(
                f"{self.file.path} has other designs from number {first} on",
                allowed="those of this study",
                do="it is of another version; give another file, or --force to begin anew",
            )
        for start in range(len(stored), len(points), COMMIT):
            block = points[start : start + COMMIT]
            outcomes = []
            for outcome in self.workers.outcomes([settings_of(self.variables, point) for point in block]):
                outcomes.append(outcome)
                self._progress(min((first + start + len(outcomes)) / max(self._total, 1), 1.0))
            self.file.append(block, outcomes)
        return self.file.designs(first, first + len(points))
