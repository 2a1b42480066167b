"""The results of records, collected for a report."""

import math
from collections.abc import Collection, Iterator
from functools import cache
from typing import Any

from ilmek.records import DeclaredResult, group_names, layout, record
from ilmek.report.json import Json
from ilmek.report.rounding import rounded
from ilmek.units import format_quantity, parse_unit

_NEVER_NEGATIVE = {parse_unit(unit).dimension for unit in ("kg", "m^2", "m^3", "m^4", "kg*m^2", "kg/m", "kg/m^3", "s")}
"""Dimensions of masses, areas, volumes, moments of inertia, densities and times."""


@record
class Result:
    """A number (or text, or group of them) that a design reports; `name` is stable and documented.

    least   that no value of a design is below [SI]      absent  when the value is None; "": never
    """

    name: str
    value: Json
    unit: str
    meaning: str
    shown: bool = True
    least: float = -math.inf
    absent: str = ""


@cache
def least_of_unit(unit: str) -> float:
    """0 for masses, areas, volumes, moments of inertia, densities and times; no bound for others.

    >>> least_of_unit("kg"), least_of_unit("1/h")
    (0.0, -inf)
    """
    return 0.0 if unit and parse_unit(unit).dimension in _NEVER_NEGATIVE else -math.inf


def results_of(*records: object, only: Collection[str] | None = None) -> tuple[Result, ...]:
    """The results declared by records, in order, groups included; a record that is None has none.

    only  names of those that are made; default: all. Raises TypeError where two results have the same name.
    """
    results = tuple(made for one in records if one is not None for made in _results(one, "", only))
    names = [made.name for made in results]
    if len(set(names)) < len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        raise TypeError(f"results declared twice: {', '.join(twice)}")
    return results


def _results(record: object, prefix: str, only: Collection[str] | None) -> Iterator[Result]:
    kind: Any = type(record)  # a checker takes a class for an object that cannot be hashed
    for attribute, declaration, inner in layout(kind):
        if only is not None:
            names = {declaration.name} if declaration is not None else group_names(kind, attribute)
            if not any(f"{prefix}{inner or ''}{name}" in only for name in names):
                continue
        value = getattr(record, attribute)
        if inner is not None:
            if value is not None:
                yield from _results(value, prefix + inner, only)
        elif declaration is not None and not (declaration.optional and value is None):
            yield _result(prefix + declaration.name, value, declaration)


def _result(name: str, value: Json, declared: DeclaredResult) -> Result:
    least = least_of_unit(declared.unit) if declared.least is None else declared.least
    return Result(name, value, declared.unit, declared.meaning, declared.shown, least, declared.absent)


def result_text(value: object, unit: str) -> str:  # noqa: PLR0911 - one line for each kind
    """The value of a result in its unit, without rounding noise; a group name by name, a line each.

    >>> result_text(0.06, "mm"), result_text(True, ""), result_text([0.5, None], "m")
    ('60 mm', 'yes', '0.5 m, –')
    """
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return format_quantity(rounded(value, unit), unit)
    if isinstance(value, list | tuple | dict) and not value:
        return "none"
    if isinstance(value, dict):
        return "\n".join(f"{name} {result_text(item, unit)}" for name, item in value.items())
    if isinstance(value, list | tuple):
        records = isinstance(value[0], dict)
        return f"{len(value)} entries, with --json" if records else ", ".join(result_text(one, unit) for one in value)
    return str(value)
