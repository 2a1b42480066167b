"""Everything out: what the command line writes of a file of the project, written into out/ by the same functions.

Each product has its command line; run in the project's folder it writes the same files.
"""

import contextlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ilmek.errors import OutputError, ParameterError
from ilmek.io.json_file import json_text
from ilmek.io.mechanism_file import read_mechanism
from ilmek.io.output import Outputs
from ilmek.io.table_csv import csv_text
from ilmek.jobs import cyclogram as cyclograms
from ilmek.jobs.animation import write_animation
from ilmek.jobs.chart import chart_order
from ilmek.jobs.design import design_machine, mechanism_text
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.loom_space import loom_glb
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.data import as_json, columns
from ilmek.jobs.mechanism.making import made_mechanism
from ilmek.jobs.mechanism.report import report as mechanism_report
from ilmek.jobs.mechanism.request import STEPS, MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.jobs.order import read_order
from ilmek.jobs.page import page_text
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.folder import OUT, ProjectFolder, kind_of, make_folder
from ilmek.jobs.studio.project.origins import digests_of, note_origin
from ilmek.jobs.studio.project.out import last_change
from ilmek.jobs.studio.project.products import OPTIONS, product, product_names
from ilmek.jobs.studio.words import all_in_page
from ilmek.jobs.weave import weave
from ilmek.jobs.workshop_order import WorkshopOrder, workshop_writer
from ilmek.progress import Progress
from ilmek.report import Check, Report, reasons


@dataclass(frozen=True, slots=True)
class OutputRequest:
    """A product of a text file of the project: its name in `products.PRODUCTS`."""

    path: str
    product: str


@dataclass(frozen=True, slots=True)
class WrittenProduct:
    """What was written.

    target  the file or folder      failed  names of the checks that do not hold      notes  warnings
    """

    target: str
    failed: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


Result = tuple[tuple[Check, ...], tuple[str, ...]]
"""Checks and notes."""


def write_product(request: OutputRequest, context: Context) -> WrittenProduct:
    """Write a product into out/; what ilmek wrote there before is replaced.

    Raises ParameterError for an unknown product, errors of the file, OutputError; then nothing is written; Cancelled.
    """
    folder = ProjectFolder(context.folder.resolve())
    folder.text_path(request.path)
    known = product_names(folder, request.path)
    if request.product not in known:
        raise ParameterError(f"{request.path} has no product {request.product!r}", allowed=", ".join(known))
    made = product(request.path, request.product)
    write = _WRITERS[kind_of(request.path) or ""]
    final = folder.path(made.target)
    digests = digests_of(folder, request.path)
    make_folder(folder.base / OUT)
    with contextlib.chdir(folder.base):  # as the command: files name each other by relative paths
        path, target = Path(request.path), Path(made.target)
        with Outputs(force=True, inputs={request.path: path}, progress=context.progress) as outputs:
            checks, notes = write(path, target, made.name, outputs, context.progress)
    with contextlib.suppress(OutputError):  # a disc that is full now: without a note times are compared
        note_origin(folder, made.target, digests, last_change(final))
    return WrittenProduct(made.target, tuple(reason.name for reason in reasons(checks)), all_in_page(notes))


def _carpet(path: Path, target: Path, name: str, outputs: Outputs, progress: Progress) -> Result:
    order = read_order(path)
    if name == "chart":
        charted, _ = chart_order(order, target, outputs=outputs, progress=progress)
        return charted.checks, (*charted.notes, *charted.warnings)
    woven = weave(order, read_loom_order(order), target, outputs=outputs, progress=progress)
    return woven.checks, (*woven.charted.notes, *woven.warnings)


def _machine(path: Path, target: Path, name: str, outputs: Outputs, progress: Progress) -> Result:
    order = read_machine_order(str(path), {})
    _expect(target, name, outputs)
    workshop = WorkshopOrder(target) if name == "parts" else None
    design_result = design_machine(
        order.machine, order.settings, workshop, outputs=outputs, progress=progress.part(0.0, 0.8)
    )
    if name == "mechanism":
        if design_result.mechanism is None:
            raise ParameterError(f"{path} has no solution, so that there is no linkage to write")
        outputs.write(target, mechanism_text(design_result.mechanism, target))
    elif name == "space" and design_result.loom is not None:
        outputs.write(target, loom_glb(design_result.loom, design_result.report))
    elif name == "parts" and design_result.workshop is None:
        raise ParameterError(f"{path} has no solution, so that there are no links to make")
    more = _write_report(
        design_result.report, design_result.as_json, target, name, outputs=outputs, progress=progress.part(0.8, 1.0)
    )
    return design_result.report.all_checks, (*design_result.warnings, *more)


def _linkage(path: Path, target: Path, name: str, outputs: Outputs, progress: Progress) -> Result:
    _expect(target, name, outputs)
    write = workshop_writer(WorkshopOrder(target) if name == "parts" else None, outputs)
    moved = run(read_mechanism(path), MotionRequest({}, "", "", STEPS), progress.part(0.0, 0.6, "motion"))
    reporting = progress.part(0.6, 0.8, "report")
    if write is not None:
        parts = made_mechanism(moved, reporting)
        workshop = write(parts.report, parts.papers)
        return workshop.judged(parts.report).all_checks, (*parts.report.warnings, *workshop.notes)
    found = analysis(moved, reporting)
    made = mechanism_report(found, drawn=name in ("page", "animation"))
    notes = list(made.warnings)
    if name == "table":
        outputs.write(target, csv_text(columns(found), progress.part(0.8, 1.0, "table")))
    part = progress.part(0.8, 1.0)
    notes += _write_report(made, lambda: as_json(found, made), target, name, outputs=outputs, progress=part)
    return made.all_checks, tuple(notes)


def _cyclogram(path: Path, target: Path, name: str, outputs: Outputs, progress: Progress) -> Result:
    _expect(target, name, outputs)
    found = cyclograms.find(str(path), {})
    made = cyclograms.report(found)
    if name == "table":
        outputs.write(target, csv_text(cyclograms.columns(found, 360), progress.part(0.0, 1.0, "table")))
    notes = _write_report(made, made.as_json, target, name, outputs=outputs, progress=progress)
    return made.checks, tuple(notes)


def _expect(target: Path, name: str, outputs: Outputs) -> None:
    """Check, before any work, that a file can be written."""
    if name != "parts":
        outputs.expect_file(target, OPTIONS[name])


def _write_report(
    report: Report, data: Callable[[], object], target: Path, name: str, *, outputs: Outputs, progress: Progress
) -> list[str]:
    """Write the page, the animation or the data of a report, if that is the product; warnings of the page."""
    notes: list[str] = []
    if name == "page":
        page = page_text(report, notes)
        if page is None:
            raise ParameterError("the report page could not be made", do="; ".join(notes))
        outputs.write(target, page)
    elif name == "animation":
        write_animation(report, target, outputs, progress)
    elif name == "data":
        outputs.write(target, json_text(data(), progress))
    return notes


_WRITERS: Mapping[str, Callable[[Path, Path, str, Outputs, Progress], Result]] = {
    "carpet": _carpet,
    "machine": _machine,
    "synthesis": _machine,
    "linkage": _linkage,
    "cyclogram": _cyclogram,
}
