"""A design of a machine as the studio shows it: verdict, checks, results, choices and warnings, with their texts.

The numbers are those of `design_machine`; tables and figures are left out, so that it follows a slider that moves.
"""

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from ilmek.jobs.nearest import with_nearest
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.checks import ShownCheck, finite, shown_check
from ilmek.jobs.studio.machine.tasks import DesignRequest, parameters_of, value_text
from ilmek.jobs.studio.words import all_in_page, spoken
from ilmek.machines.catalogue import find_machine
from ilmek.machines.component import AnyComponent
from ilmek.params import Params, Setting, Value
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import BUILDABLE, Choice, Report, result_text
from ilmek.units import si_unit
from ilmek.viz.number_format import quantity


@dataclass(frozen=True, slots=True)
class ShownResult:
    """A result; `value` where it is one number, in the SI unit `unit`. `machine` as of a check."""

    name: str
    machine: str
    text: str
    unit: str
    meaning: str
    value: float | None = None


@dataclass(frozen=True, slots=True)
class ForceValue:
    """The value in force of a parameter [SI], and its text; set: whether it differs from the default."""

    value: Value
    text: str
    set: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class DesignView:
    """A design of a machine as the studio shows it.

    parameters  in force by name, those that the design chose too
    pending     whether its parts are still to be compared with each other in space: `in_space` does
    failed      number of checks that do not hold          seconds  that the design and its report took [s]
    """

    machine: str
    title: str
    holds: bool
    failed: int
    reasons: tuple[ShownCheck, ...]
    checks: tuple[ShownCheck, ...]
    results: tuple[ShownResult, ...]
    choices: tuple[Choice, ...]
    warnings: tuple[str, ...]
    parameters: dict[str, ForceValue]
    seconds: float
    pending: bool


@dataclass(frozen=True, eq=False, slots=True)
class NearestTasks:
    """The nearest tasks that a machine could do, where it cannot do what is required; "" where there are none."""

    text: str = ""
    wishes: tuple[JsonObject, ...] = field(default=())


def view(request: DesignRequest, context: Context) -> DesignView:
    """Design a machine and show it without tables and figures, and without its parts against each other in space.

    Raises as `design_machine` does.
    """
    began = time.perf_counter()
    params, report = judged(request.name, request.settings, context.progress)
    return shown(report, params, time.perf_counter() - began)


def in_space(request: DesignRequest, context: Context) -> DesignView:
    """The same with its parts against each other in space: some seconds of work."""
    began = time.perf_counter()
    params, report = whole(request.name, request.settings, context.progress)
    return shown(report, params, time.perf_counter() - began)


def nearest(request: DesignRequest, context: Context) -> NearestTasks:
    """The nearest carpets that a loom could weave, where it cannot weave what is required: some seconds of work."""
    params, report = whole(request.name, request.settings, context.progress)
    found = with_nearest(report, params, context.progress)
    wishes: Any = found.results[-1].value if found is not report else ()
    return NearestTasks(found.nearest, tuple(wishes))


def judged(name: str, settings: Mapping[str, Setting], progress: Progress = SILENT) -> tuple[Params, Report]:
    """The parameters of a machine for settings, and the report of its design as of `report_for`."""
    machine, params = find_machine(name).ordered(settings)
    return params, report_for(machine, params, progress)


def whole(name: str, settings: Mapping[str, Setting], progress: Progress = SILENT) -> tuple[Params, Report]:
    """The same with its parts against each other in space."""
    machine, params = find_machine(name).ordered(settings)
    return params, machine.report(designed(machine, params, progress), illustrated=False)


def report_for(machine: AnyComponent, params: Params, progress: Progress = SILENT) -> Report:
    """The report of a design without tables, figures and its parts against each other. The last ones are kept."""
    return _kept(machine, params, progress)[1]


def designed(machine: AnyComponent, params: Params, progress: Progress = SILENT) -> Any:
    """A design of a machine. The last ones are kept."""
    return _kept(machine, params, progress)[0]


def _kept(machine: AnyComponent, params: Params, progress: Progress) -> tuple[Any, Report]:
    key = machine.name, params
    if (found := _DESIGNS.get(key)) is None:
        design = machine.designed(params, progress)
        found = _DESIGNS[key] = design, machine.report(design, illustrated=False, assembled=False)
        if len(_DESIGNS) > _MOST:
            del _DESIGNS[next(iter(_DESIGNS))]
    return found


_MOST = 24
"""Number of designs that a worker keeps."""

_DESIGNS: dict[tuple[str, Params], tuple[Any, Report]] = {}
"""The last designs and their reports by machine and parameters."""


def shown(report: Report, params: Params, seconds: float) -> DesignView:
    """A report as the studio shows it."""
    checks = tuple(_checks(report, ""))
    view = DesignView(
        machine=report.machine,
        title=report.title,
        holds=not report.failed,
        failed=sum(not check.ok for check in checks),
        reasons=tuple(map(shown_check, report.reasons)),
        checks=checks,
        results=tuple(_results(report, "")),
        choices=report.all_choices,
        warnings=all_in_page(report.all_warnings),
        parameters=in_force(report, params),
        seconds=seconds,
        pending=find_machine(report.machine).assembly is not None and BUILDABLE not in report.names(),
    )
    return spoken(view)


def in_force(report: Report, params: Params) -> dict[str, ForceValue]:
    """The parameters in force by name: as given, as the design chose them, and those of the machines in it."""
    known, given = parameters_of(report.machine), params.as_dict()
    values = {**_of_machines(report), **report.parameters}
    return {
        name: ForceValue(
            value := values.get(name, one.default),
            value_text(value, one.unit),
            name in given and given[name] != one.default,
        )
        for name, one in known.items()
    }


def _of_machines(report: Report) -> JsonObject:
    return {f"{child.machine}.{name}": value for child in report.children for name, value in child.parameters.items()}


def _checks(report: Report, machine: str) -> Iterator[ShownCheck]:
    yield from (shown_check(check, machine) for check in report.checks)
    for child in report.children:
        yield from _checks(child, f"{machine}: {child.machine}" if machine else child.machine)


def _results(report: Report, machine: str) -> Iterator[ShownResult]:
    for result in report.results:
        if result.shown:
            number = (
                result.value if isinstance(result.value, int | float) and not isinstance(result.value, bool) else None
            )
            text = quantity(number, result.unit) if number is not None else result_text(result.value, result.unit)
            yield ShownResult(result.name, machine, text, si_unit(result.unit), result.meaning, finite(number))
    for child in report.children:
        yield from _results(child, f"{machine}: {child.machine}" if machine else child.machine)
