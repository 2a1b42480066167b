"""Design one machine; write its workshop files."""

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from ilmek.errors import ParameterError
from ilmek.io.output import Outputs, joined
from ilmek.jobs.workshop_order import WorkshopOrder, workshop_writer
from ilmek.machines.catalogue import MACHINES, find_machine
from ilmek.params import Params, Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import Json, Papers, Report

if TYPE_CHECKING:
    from ilmek.dynamics.own_machine import OwnMachine
    from ilmek.jobs.workshop import Workshop
    from ilmek.machines.automated_loom.design import LoomDesign
    from ilmek.machines.component import AnyComponent
    from ilmek.part.tree import Tree


WRITERS = {".toml": "mechanism_toml", ".json": "mechanism_json"}
"""Functions of `io.mechanism_file` that write a mechanism, by the suffix of the file."""

IN_SPACE = {"--glb": (".glb",), "--step": (".step", ".stp"), "--mjcf": (".xml", ".mjcf")}
"""Suffixes of the files with the parts in space, by option."""

LOOM = "automated-loom"
"""The machine whose report names the nearest carpets, where it cannot weave what is required."""


@dataclass(frozen=True, slots=True)
class DesignResult:
    """The report of a design, the workshop files that were written, if any, and its linkage where it has one.

    loom, tree  for the picture in space: the design of a loom, the parts of any other machine that has them
    """

    report: Report
    workshop: "Workshop | None" = None
    mechanism: "OwnMachine | None" = None
    loom: "LoomDesign | None" = None
    tree: "Tree | None" = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of the design and of its workshop files."""
        return (*self.report.all_warnings, *(self.workshop.notes if self.workshop else ()))

    def as_json(self) -> dict[str, Json]:
        """The report as plain data, SI; with workshop files also their paths."""
        return {**self.report.as_json(), **({"files": self.workshop.files} if self.workshop else {})}


def require_mechanism(name: str, file: Path) -> None:
    """Raise ParameterError where a machine has no linkage to write, or a file does not end in .toml or .json."""
    if find_machine(name).mechanism is None:
        able = ", ".join(other for other, machine in MACHINES.items() if machine.mechanism is not None)
        raise ParameterError(f"{name} has no linkage that --to could write", allowed=able)
    if file.suffix.lower() not in WRITERS:
        raise ParameterError(f"mechanism file {file} ends in {file.suffix!r}", allowed=" or ".join(WRITERS))


def require_space(name: str, files: Mapping[str, Path | None]) -> None:
    """Raise ParameterError unless the machine has parts in space, if a file by its option is given, and each file ends
    as it must; for a STEP file without the extra `step` too.
    """
    for option, file in files.items():
        if file is None:
            continue
        if find_machine(name).name != LOOM and find_machine(name).tree is None:
            able = ", ".join(other for other, machine in MACHINES.items() if other == LOOM or machine.tree is not None)
            raise ParameterError(f"{name} has no picture in space that {option} could write", allowed=able)
        if file.suffix.lower() not in IN_SPACE[option]:
            raise ParameterError(f"{option} {file} ends in {file.suffix!r}", allowed=" or ".join(IN_SPACE[option]))
        if option == "--step" and find_spec("OCP") is None:
            raise ParameterError(f"--step {file} without the extra step", do="pip install 'ilmek[step]'")


def mechanism_text(machine: "OwnMachine", file: Path) -> str:
    """The text of a mechanism file, TOML or JSON by its suffix."""
    mechanism_file = import_module("ilmek.io.mechanism_file")
    text: str = getattr(mechanism_file, WRITERS[file.suffix.lower()])(machine)
    return text


def design_machine(
    name: str,
    settings: Mapping[str, Setting],
    workshop: WorkshopOrder | None = None,
    *,
    outputs: Outputs | None = None,
    progress: Progress = SILENT,
    illustrated: bool = True,
    drawn: bool = True,
) -> DesignResult:
    """Design a machine of the catalogue, report it, and write its workshop files if they are ordered.

    settings  values of parameters by name: texts with units, or numbers in SI
    outputs   of the caller, who commits them; default: committed here
    illustrated, drawn  False: the report has no tables and figures, which take longer than all the rest; no figures
    Of a synthesis without a solution no workshop files are written.
    Raises ParameterError for an unknown machine, parameter or tolerance and for a value out of bounds; OutputError,
    before any work, where a file cannot be written; errors of the machine; Cancelled.
    """
    with joined(outputs, progress=progress) as made:
        write = workshop_writer(workshop, made)
        machine, params = find_machine(name).ordered(settings)
        designed = machine.with_room(machine.designed(params, progress.part(0.0, 0.6, "design")), params)
        progress.part(0.6, 0.8, "report")
        report = machine.report(designed, illustrated=illustrated, drawn=drawn)
        if report.machine == LOOM:
            report = _with_nearest(report, params, progress.part(0.7, 0.8))
        files_progress = progress.part(0.8, 1.0, "files")
        linkage = None if machine.mechanism is None else machine.mechanism(designed)
        made_of_links = machine.mechanism is None or linkage is not None  # without a solution there is nothing to make
        loom = designed if machine.name == LOOM else None
        files, tree = None, None if machine.tree is None else machine.tree(designed)
        if write is not None and made_of_links:
            files = write(report, _papers(machine, designed, report), progress=files_progress)
        return DesignResult(report if files is None else files.judged(report), files, linkage, loom, tree)


def _papers(machine: "AnyComponent", design: object, report: Report) -> Papers:
    """The papers of a design; the lists of parts are imported only for them."""
    from ilmek.jobs.workshop_papers import papers_of

    return papers_of(machine, design, report)


def _with_nearest(report: Report, params: Params, progress: Progress) -> Report:
    """A loom's report with the nearest carpets that it could weave; the loom is imported only for one."""
    from ilmek.jobs.nearest import with_nearest

    return with_nearest(report, params, progress)
