"""Design one machine; write its report page and its workshop files."""

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
    """Requested output files of a design.

    page       HTML report; default: none
    workshop   folder for plates (DXF, STEP) and cam tables; default: none
    tolerance  of the cam tables, like `1um` or `0.01%` of the stroke; default: see `jobs.workshop.SHARE`
    force      replace a workshop folder that ilmek wrote
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
    """Design a machine of the catalogue, report it, and write the requested files.

    settings  values of parameters by name: texts with units, or numbers in SI
    Raises ParameterError for an unknown machine, parameter or tolerance and for a value out of bounds; OutputError,
    before any work, where a file cannot be written; errors of the machine; Cancelled.
    """
    requested = outputs or Outputs()
    if requested.page is not None:
        check_file(requested.page)
    write = _workshop_writer(requested)
    machine = find_machine(name)
    params = machine.params.read(settings)
    progress.part(0.0, 0.6, "design")
    made = machine.design(params)
    progress.part(0.6, 0.8, "report")
    report = machine.report(made)
    progress.part(0.8, 1.0, "files")
    workshop = write(report) if write is not None else None
    write_page(requested.page, report)
    progress(1.0)
    return DesignResult(report, workshop)


def _workshop_writer(requested: Outputs) -> "Callable[[Report], Workshop] | None":
    """Writes the workshop files of a report; None where none are requested. Their libraries are imported only here."""
    if requested.workshop is None:
        return None
    check_free(requested.workshop, force=requested.force)
    from ilmek.jobs.workshop import Tolerance, read_tolerance, write_workshop

    tolerance = Tolerance() if requested.tolerance is None else read_tolerance(requested.tolerance)
    return partial(write_workshop, folder=requested.workshop, tolerance=tolerance, force=requested.force)
