"""One machine, designed from its parameters; its page and its workshop files."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ilmek.io.output import check_file, check_free
from ilmek.jobs.page import write_page
from ilmek.machines.catalogue import find_machine
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import Report

if TYPE_CHECKING:
    from ilmek.jobs.workshop import Workshop


@dataclass(frozen=True, slots=True)
class Outputs:
    """The files of a design that are wanted.

    page       of the report, HTML; default: none
    workshop   folder for plates (DXF, STEP) and cam tables; default: none
    tolerance  of the cam tables, like `1um` or `0.01%` of the stroke; default: see `jobs.workshop.SHARE`
    force      replace a workshop folder whose files ilmek made
    """

    page: Path | None = None
    workshop: Path | None = None
    tolerance: str | None = None
    force: bool = False


@dataclass(frozen=True, slots=True)
class DesignResult:
    """The report of a design, and the workshop files that were written, if any."""

    report: Report
    workshop: "Workshop | None" = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of the design and of its workshop files."""
        return (*self.report.all_warnings, *(self.workshop.notes if self.workshop else ()))

    def as_json(self) -> dict[str, Any]:
        """The report as plain data, SI; with workshop files also their paths."""
        return {**self.report.as_json(), **({"files": self.workshop.files} if self.workshop else {})}


def design_machine(
    name: str, settings: Mapping[str, Setting], outputs: Outputs | None = None, *, progress: Progress = SILENT
) -> DesignResult:
    """Design a machine of the catalogue, report it, and write the files that are wanted.

    settings  values of parameters by name: texts with units, or numbers in SI
    Raises ParameterError for an unknown machine, parameter or tolerance and for a value out of bounds; OutputError,
    before any work, where a file cannot be written; errors of the machine; Cancelled.
    """
    wanted = outputs or Outputs()
    if wanted.page is not None:
        check_file(wanted.page)
    write = _workshop_writer(wanted)
    machine = find_machine(name)
    params = machine.params.read(settings)
    progress.part(0.0, 0.6, "design")
    made = machine.design(params)
    progress.part(0.6, 0.8, "report")
    report = machine.report(made)
    progress.part(0.8, 1.0, "files")
    workshop = write(report) if write is not None else None
    write_page(wanted.page, report)
    progress(1.0)
    return DesignResult(report, workshop)


def _workshop_writer(wanted: Outputs) -> "Callable[[Report], Workshop] | None":
    """Writes the workshop files of a report; None where none are wanted. Their libraries are imported only here."""
    if wanted.workshop is None:
        return None
    check_free(wanted.workshop, force=wanted.force)
    from ilmek.jobs.workshop import Tolerance, read_tolerance, write_workshop

    tolerance = Tolerance() if wanted.tolerance is None else read_tolerance(wanted.tolerance)
    return partial(write_workshop, folder=wanted.workshop, tolerance=tolerance, force=wanted.force)
