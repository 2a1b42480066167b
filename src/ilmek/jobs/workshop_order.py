"""An order of workshop files, without the libraries that write them."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from ilmek.io.output import Outputs
from ilmek.progress import SILENT, Progress
from ilmek.report import NO_PAPERS, Papers, Report
from ilmek.report.sheet import Issue

if TYPE_CHECKING:
    from ilmek.jobs.workshop import Workshop


@dataclass(frozen=True, slots=True)
class WorkshopOrder:
    """A folder for the workshop files of a design: drawings (PDF, DXF), plates (DXF, STEP) and cam tables.

    tolerance  of the cam tables, like `1um` or `0.01%` of the stroke; default: see `jobs.workshop.SHARE`
    issue      owner, date and revision on the drawings
    """

    folder: Path
    tolerance: str | None = None
    issue: Issue = Issue()


class WorkshopWriter(Protocol):
    """Writes the workshop files of a report, and papers."""

    def __call__(self, report: Report, papers: Papers = NO_PAPERS, *, progress: Progress = SILENT) -> "Workshop":
        """The files that were written. Raises as `write_workshop`."""


def workshop_writer(order: WorkshopOrder | None, outputs: Outputs) -> WorkshopWriter | None:
    """Writes the workshop files of a report, and its papers; None where none are ordered. Their libraries are imported
    only here.

    Raises OutputError for a folder that cannot be written, ParameterError for a tolerance that cannot be read.
    """
    if order is None:
        return None
    outputs.expect_folder(order.folder, "--workshop")
    from ilmek.jobs.workshop import Tolerance, read_tolerance, write_workshop

    tolerance = Tolerance() if order.tolerance is None else read_tolerance(order.tolerance)
    folder, issue = order.folder, order.issue

    def write(report: Report, papers: Papers = NO_PAPERS, *, progress: Progress = SILENT) -> "Workshop":
        return write_workshop(report, folder, tolerance, papers=papers, outputs=outputs, issue=issue, progress=progress)

    return write
