"""Two settings of a machine side by side: what differs of their parameters, results and checks."""

from dataclasses import dataclass, field

from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.checks import ShownCheck
from ilmek.jobs.studio.machine.view import DesignView, shown, whole
from ilmek.params import Setting

ROUNDING = 1e-9
"""Relative difference of two values that counts as rounding."""


@dataclass(frozen=True, eq=False, slots=True)
class ComparisonRequest:
    """Two settings of a machine."""

    name: str
    a: dict[str, Setting] = field(default_factory=dict)
    b: dict[str, Setting] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Difference:
    """A parameter or a result that differs: its texts, and the change from B to A over B; null where there is none."""

    name: str
    machine: str
    a: str
    b: str
    change: float | None = None


@dataclass(frozen=True, slots=True)
class CheckDifference:
    """A check that differs: values with limits as texts, and whether it holds; null where one has no such check."""

    name: str
    machine: str
    a: str
    b: str
    a_holds: bool | None
    b_holds: bool | None
    change: float | None = None


@dataclass(frozen=True, slots=True)
class Comparison:
    """What differs between two settings A and B of a machine."""

    a_failed: int
    b_failed: int
    parameters: tuple[Difference, ...]
    results: tuple[Difference, ...]
    checks: tuple[CheckDifference, ...]


def comparison(request: ComparisonRequest, context: Context) -> Comparison:
    """Compare two settings of a machine. Raises as `design_machine` does, for either."""
    a, b = (
        shown(report, params, 0.0)
        for params, report in (whole(request.name, one, context.progress) for one in (request.a, request.b))
    )
    return Comparison(a.failed, b.failed, _parameters(a, b), _results(a, b), _checks(a, b))


def _parameters(a: DesignView, b: DesignView) -> tuple[Difference, ...]:
    return tuple(
        Difference(name, "", parameter.text, other.text, _change(parameter.value, other.value))
        for name, parameter in a.parameters.items()
        if (other := b.parameters[name]).value != parameter.value
    )


def _results(a: DesignView, b: DesignView) -> tuple[Difference, ...]:
    known = {(result.machine, result.name): result for result in b.results}
    return tuple(
        Difference(result.name, result.machine, result.text, other.text, _change(result.value, other.value))
        for result in a.results
        if (other := known.get((result.machine, result.name))) is not None and other.text != result.text
    )


def _checks(a: DesignView, b: DesignView) -> tuple[CheckDifference, ...]:
    """The checks that differ, those that turn first."""
    of_a, of_b = ({(check.machine, check.name): check for check in view.checks} for view in (a, b))
    found = []
    for machine, name in {**of_a, **of_b}:
        one, other = of_a.get((machine, name)), of_b.get((machine, name))
        if _text(one) == _text(other) and one is not None and other is not None:
            continue
        change = None if one is None or other is None else _change(one.ratio, other.ratio)
        found.append(CheckDifference(name, machine, _text(one), _text(other), _holds(one), _holds(other), change))
    return tuple(sorted(found, key=lambda each: each.a_holds == each.b_holds))


def _holds(check: ShownCheck | None) -> bool | None:
    return None if check is None else check.ok


def _text(check: ShownCheck | None) -> str:
    return "" if check is None else f"{check.value_text} {check.limit_text}".strip()


def _change(one: object, other: object) -> float | None:
    """The relative change from the other to the one; None where they are no two numbers, or the other is 0."""
    numbers = [each for each in (one, other) if isinstance(each, int | float) and not isinstance(each, bool)]
    if len(numbers) < 2 or numbers[1] == 0:
        return None
    change = numbers[0] / numbers[1] - 1
    return 0.0 if abs(change) < ROUNDING else change
