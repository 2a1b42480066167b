"""A study of the machine or the mechanism that is open: designs over ranges, from its present state."""

import shlex
from dataclasses import dataclass, field

from ilmek.errors import ParameterError
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.tasks import parameters_of
from ilmek.jobs.studio.words import all_in_page
from ilmek.jobs.study.order import StudyOrder
from ilmek.jobs.study.report import shown_designs, study_report
from ilmek.jobs.study.run import study
from ilmek.jobs.study.targets import MachineTarget, StudyTarget, target_of_data
from ilmek.machines.catalogue import find_machine
from ilmek.params import Parameter, Setting, Value
from ilmek.records import JsonObject
from ilmek.units import format_quantity, parse_unit
from ilmek.viz.plain import ShownFigure, shown_figures

ABOUT = 0.1
"""Share of a value by which its range reaches to both sides, where its bounds allow it."""

MOST_DESIGNS = 4096
"""Designs of a study from a page; the command line has no such limit."""


@dataclass(frozen=True, eq=False, slots=True)
class StudyRequest:
    """Designs over ranges.

    machine, settings   of a machine of the catalogue; "": of the mechanism
    mechanism, over, speed   plain data of a mechanism file, and its motion      path  of its file, for the commands
    vary     parameter, or entry of `values` -> range, `25deg..35deg`
    goals    results, `most` before one that is to be large      record   further results      samples  designs
    """

    machine: str = ""
    settings: dict[str, Setting] = field(default_factory=dict)
    mechanism: JsonObject = field(default_factory=dict)
    path: str = ""
    over: str = ""
    speed: str = ""
    vary: dict[str, str] = field(default_factory=dict)
    goals: tuple[str, ...] = ()
    record: tuple[str, ...] = ()
    samples: int = 64


@dataclass(frozen=True, slots=True)
class VariedNumber:
    """A number that can vary, and a range about its present value; "" without one."""

    name: str
    range: str


@dataclass(frozen=True, slots=True)
class StudyNumbers:
    """What can vary, and the results that can be goals."""

    varied: tuple[VariedNumber, ...]
    results: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class StudyAnswer:
    """What a study found.

    figures   all designs first, then each result over each variable
    designs   what varies, as settings, of each design of the first figure
    feasible  of the designs that were made, those of which every check holds
    command   of the study, with which it goes on at a terminal
    """

    figures: list[ShownFigure]
    designs: list[dict[str, str]]
    samples: int
    made: int
    feasible: int
    warnings: tuple[str, ...]
    command: str


def numbers(request: StudyRequest, context: Context) -> StudyNumbers:
    """What can vary of the machine or the mechanism, and its results. Raises as its design does."""
    target = _target(request)
    given = (
        parameters_of(target.machine)
        if isinstance(target, MachineTarget)
        else dict(request.mechanism).get("values", {})
    )
    known = {name: target.parameter(name) for name in given}
    results = target.numbers({}).results
    varied = (
        VariedNumber(name, _about(one, results.get(name) if target.nominal(name) is None else target.nominal(name)))
        for name, one in known.items()
        if one.kind in (float, int)
    )
    return StudyNumbers(tuple(varied), tuple(results))


def studied(request: StudyRequest, context: Context) -> StudyAnswer:
    """Carry out a study from a page. Raises as `study` does, and Cancelled."""
    if not 1 <= request.samples <= MOST_DESIGNS:
        raise ParameterError(f"{request.samples} designs", allowed=f"1 to {MOST_DESIGNS}", do="use the command line")
    target = _target(request)
    name = request.machine or request.path or "mechanism.toml"
    fixed = target.settings if isinstance(target, MachineTarget) else {}
    sampling = "grid" if len(request.vary) == 1 else "sobol"
    order = StudyOrder(
        name, fixed, request.vary, request.goals, record=request.record, samples=request.samples,
        sampling=sampling, over=request.over, speed=request.speed,
    )  # fmt: skip
    found = study(order, target=target, progress=context.progress)
    report = study_report(found)
    return StudyAnswer(
        shown_figures(report.figures),
        [found.varied(number) for number in shown_designs(found)],
        len(found.rows.points),
        int(found.rows.made.sum()),
        int(found.rows.feasible.sum()),
        all_in_page(report.warnings),
        _command(order),
    )


def _about(parameter: Parameter, value: Value) -> str:
    """A range about a value within its bounds; "" without one."""
    if isinstance(value, bool | str | None):
        return ""
    step = abs(value) * ABOUT or parse_unit(parameter.unit).factor
    step = max(round(step), 1) if parameter.kind is int else step
    ends = []
    for end in (value - step, value + step):
        try:
            parameter.check(parameter.kind(end))
        except ParameterError:
            end = value
        ends.append(f"{end:.0f}" if parameter.kind is int else format_quantity(end, parameter.unit).replace(" ", ""))
    return "..".join(ends)


def _target(request: StudyRequest) -> StudyTarget:
    if request.machine:
        fixed = {name: value for name, value in request.settings.items() if name not in request.vary}
        return MachineTarget(find_machine(request.machine).name, fixed)
    return target_of_data(request.mechanism, MotionRequest({}, request.over, request.speed))


def _command(order: StudyOrder) -> str:
    given = {"set": order.fixed, "vary": order.vary}
    pairs = [f"--{word}={name}={value}" for word, of in given.items() for name, value in of.items()]
    named = {"goal": order.goals, "record": order.record, "over": (order.over,), "speed": (order.speed,)}
    words = [f"--{word}={text}" for word, texts in named.items() for text in texts if text]
    more = (f"--sampling={order.sampling}", f"--samples={order.samples}")
    return shlex.join(("ilmek", "study", order.target, *pairs, *words, *more))
