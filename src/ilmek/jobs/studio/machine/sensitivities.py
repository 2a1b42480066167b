"""What each parameter of a machine does to each of its checks, by small steps from a design."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.checks import ratio_of
from ilmek.jobs.studio.machine.tasks import parameters_of, value_text
from ilmek.jobs.studio.machine.view import judged, report_for
from ilmek.jobs.studio.words import spoken
from ilmek.machines.catalogue import find_machine
from ilmek.params import Parameter, Params, Setting, Value
from ilmek.report import Check, Report
from ilmek.units import format_quantity, parse_unit

STEP = 0.01
"""Step of a parameter, of its value; of one that is 0: one of its unit."""

LEAST = 1e-7
"""Changes of value over limit below this are rounding."""

FARTHEST = 1.0
"""Farthest change of a parameter, of its value, to which an effect is continued in a straight line."""

MOST_EFFECTS = 12
"""Largest number of effects of a parameter that are listed."""


@dataclass(frozen=True, eq=False, slots=True)
class SensitivityRequest:
    """A design of a machine, and the parameters to be moved; default: its own and those of its records."""

    name: str
    settings: dict[str, Setting] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Effect:
    """What a parameter does to a check.

    machine   the machine in it that the check is of, "" for its own
    change    of value over limit, for a rise of the parameter by 1 % (by one of its unit where it is 0); for a choice:
              with the other choice. Of a check against 0: of the value, over the value now
    relative  the same over value over limit now
    ok, after whether the check holds now, and after the change: of a choice only, else the same
    turns_at  value of the parameter [SI] at which the check would fail, or hold, in a straight line; null: none near
    """

    check: str
    machine: str
    change: float
    relative: float
    ok: bool
    after: bool
    turns_at: float | None = None
    turns_text: str = ""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """What a parameter does to the checks.

    step     in words: "±1 %, 0.3 mm", "rapier instead of shuttle"
    unmoved  why the parameter could not be moved; "" where it was
    effects  those that turn a check first, the nearest of them first; then by relative size
    weaker   number of further ones
    """

    parameter: str
    step: str
    unmoved: str = ""
    effects: tuple[Effect, ...] = ()
    weaker: int = 0


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """What each parameter does to the checks of a design."""

    sensitivities: tuple[Sensitivity, ...]


def sensitivities(request: SensitivityRequest, context: Context) -> Sensitivities:
    """Move each parameter by a small step, and compare the checks. Each is shown as soon as it is known.

    Raises as `design_machine` does for the settings themselves, and Cancelled.
    """
    params, report = judged(request.name, request.settings, context.progress.part(0.0, 0.02, "design"))
    known = parameters_of(request.name)
    names = request.parameters or tuple(name for name in known if name in params.as_dict())
    found = []
    for number, name in enumerate(names):
        begin, finish = (0.02 + 0.98 * share / len(names) for share in (number, number + 1))
        context.progress.part(begin, finish, name)
        found.append(one := sensitivity_of(request.name, params, report, known[name]))
        context.show(spoken(one))
    return spoken(Sensitivities(tuple(found)))


def sensitivity_of(name: str, params: Params, report: Report, parameter: Parameter) -> Sensitivity:
    """What one parameter does to the checks of a design. The last ones are kept."""
    key = name, params, parameter.name
    if (sensitivity := _FOUND.get(key)) is None:
        sensitivity = _FOUND[key] = _moved(name, params, report, parameter)
        if len(_FOUND) > _KEPT:
            del _FOUND[next(iter(_FOUND))]
    return sensitivity


_KEPT = 4000
"""Number of sensitivities that a worker keeps."""

_FOUND: dict[tuple[str, Params, str], Sensitivity] = {}
"""The last sensitivities by machine, parameters and the name of the one that was moved."""


def _moved(name: str, params: Params, report: Report, parameter: Parameter) -> Sensitivity:
    if type(params) is not find_machine(name).params:
        return Sensitivity(parameter.name, "", "a variant of the machine: its parameters are others")
    value = report.parameters.get(parameter.name, parameter.default)
    if value is None:
        return Sensitivity(parameter.name, "", "the design chooses it and reports no value: set one to move it")
    if isinstance(value, bool | str):
        return _by_choice(name, params, report, parameter, value)
    assert isinstance(value, int | float)
    return _by_steps(name, params, report, parameter, float(value))


def _by_choice(name: str, params: Params, report: Report, parameter: Parameter, value: bool | str) -> Sensitivity:
    """The effects of the next choice."""
    others: tuple[Value, ...] = parameter.choices if isinstance(value, str) else (False, True)
    if not others or value not in others:
        return Sensitivity(parameter.name, "", "a text: it has no next value")
    other = others[(others.index(value) + 1) % len(others)]
    step = f"{value_text(other, '')} instead of {value_text(value, '')}"
    try:
        then = _checks(report_for(find_machine(name), params.with_values({parameter.name: other})))
    except IlmekError as error:
        return Sensitivity(parameter.name, step, f"no design: {error}")
    now = _checks(report)
    effects = (
        Effect(check.name, key[0], change, change / _size(check), check.ok, then[key].ok)
        for key, check in now.items()
        if key in then and (change := _difference(check, then[key], check)) is not None
    )
    return _ranked(parameter.name, step, effects, 0.0)


def _by_steps(name: str, params: Params, report: Report, parameter: Parameter, value: float) -> Sensitivity:
    """The effects of a step up and a step down, each where it is allowed."""
    step = _step(parameter, value)
    text = f"±{STEP * 100:g} %, {format_quantity(step, parameter.unit, 3)}"
    if parameter.kind is int or value == 0:
        text = f"±{format_quantity(step, parameter.unit, 3)}"
    ends: list[tuple[float, dict[tuple[str, str], Check]]] = []
    refused = ""
    for at in (value - step, value + step):
        if not parameter.within(at):
            continue
        try:
            moved = int(at) if parameter.kind is int else at
            ends.append((at, _checks(report_for(find_machine(name), params.with_values({parameter.name: moved})))))
        except IlmekError as error:
            refused = str(error)
    now = _checks(report)
    if len(ends) == 1:
        ends.append((value, now))
    if len(ends) < 2:
        return Sensitivity(parameter.name, text, f"no design on either side: {refused}" if refused else "at its bounds")
    ends.sort(key=lambda end: end[0])
    return _ranked(parameter.name, text, _effects(parameter, value, now, ends), value)


def _step(parameter: Parameter, value: float) -> float:
    if parameter.kind is int:
        return 1.0
    return STEP * abs(value) or parse_unit(parameter.unit).factor * (1.0 if parameter.unit else STEP)


def _effects(parameter: Parameter, value: float, now: Any, ends: Any) -> Iterator[Effect]:
    """The effects of a step between two ends, each a value of the parameter and the checks with it."""
    (low, before), (high, after) = ends
    unit_step = STEP * abs(value) or _step(parameter, value)
    for key, check in now.items():
        if key not in before or key not in after:
            continue
        change = _difference(before[key], after[key], check)
        if change is None:
            continue
        slope = ((after[key].value - after[key].limit) - (before[key].value - before[key].limit)) / (high - low)
        turns = value - (check.value - check.limit) / slope if slope else None
        if turns is not None and not (abs(turns - value) <= FARTHEST * abs(value) and parameter.within(turns)):
            turns = None
        shown = "" if turns is None else format_quantity(turns, parameter.unit, 4)
        change *= unit_step / (high - low)
        yield Effect(key[1], key[0], change, change / _size(check), check.ok, check.ok, turns, shown)


def _difference(before: Check, after: Check, now: Check) -> float | None:
    """The change of value over limit, of a check against 0 over its value now; None where there is none."""
    first, last = ratio_of(before), ratio_of(after)
    if now.limit == 0 and now.value:
        first, last = before.value / abs(now.value), after.value / abs(now.value)
    if first is None or last is None or not LEAST < abs(last - first) < float("inf"):
        return None
    return last - first


def _size(now: Check) -> float:
    """The magnitude of value over limit now, 1 where that is 0 or no number."""
    return 1.0 if now.limit == 0 else abs(ratio_of(now) or 1.0)


def _ranked(name: str, step: str, effects: Iterator[Effect], value: float) -> Sensitivity:
    """The strongest effects: those that turn a check first, the nearest of them first; the rest by relative size."""

    def rank(effect: Effect) -> tuple[bool, float, float]:
        turns = effect.ok != effect.after or effect.turns_at is not None
        return not turns, abs((effect.turns_at or value) - value), -abs(effect.relative)

    found = sorted(effects, key=rank)
    return Sensitivity(name, step, "", tuple(found[:MOST_EFFECTS]), max(0, len(found) - MOST_EFFECTS))


def _checks(report: Report, machine: str = "") -> dict[tuple[str, str], Check]:
    """The checks of a report and of the machines in it, by machine and name."""
    checks = {(machine, check.name): check for check in report.checks}
    for child in report.children:
        checks |= _checks(child, f"{machine}: {child.machine}" if machine else child.machine)
    return checks
