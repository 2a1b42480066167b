"""Design one machine; write its workshop files."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ilmek.io.output import Outputs, joined
from ilmek.jobs.workshop_order import WorkshopOrder, workshop_writer
from ilmek.machines.catalogue import find_machine
from ilmek.params import Params, Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import Report

if TYPE_CHECKING:
    from ilmek.jobs.workshop import Workshop


LOOM = "automated-loom"
"""The machine whose report names the nearest carpets, where it cannot weave what is required."""


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
    name: str,
    settings: Mapping[str, Setting],
    workshop: WorkshopOrder | None = None,
    *,
    outputs: Outputs | None = None,
    progress: Progress = SILENT,
) -> DesignResult:
    """Design a machine of the catalogue, report it, and write its workshop files if they are ordered.

    settings  values of parameters by name: texts with units, or numbers in SI
    outputs   of the caller, who commits them; default: committed here
    Raises ParameterError for an unknown machine, parameter or tolerance and for a value out of bounds; OutputError,
    before any work, where a file cannot be written; errors of the machine; Cancelled.
    """
    with joined(outputs, progress=progress) as made:
        write = workshop_writer(workshop, made)
        machine = find_machine(name)
        params = machine.params.read(settings)
        designed = machine.designed(params, progress.part(0.0, 0.6, "design"))
        progress.part(0.6, 0.8, "report")
        report = machine.report(designed)
        if report.machine == LOOM:
            report = _with_nearest(report, params, progress.part(0.7, 0.8))
        progress.part(0.8, 1.0, "files")
        return DesignResult(report, write(report) if write is not None else None)


def _with_nearest(report: Report, params: Params, progress: Progress) -> Report:
    """A loom's report with the nearest carpets that it could weave; the loom is imported only for one."""
    from ilmek.jobs.nearest import with_nearest

    return with_nearest(report, params, progress)
