"""The results of records, collected for a report."""

from collections.abc import Iterator
from typing import Any

from ilmek.records import layout, record
from ilmek.report.json import Json


@record
class Result:
    """A number (or text, or group of them) that a design reports; `name` is stable and documented."""

    name: str
    value: Json
    unit: str
    meaning: str
    shown: bool = True


def results_of(*records: object) -> tuple[Result, ...]:
    """The results declared by records, in order, groups included; a record that is None has none.

    Raises TypeError where two results have the same name.
    """
    found = tuple(made for one in records if one is not None for made in _results(one, ""))
    names = [made.name for made in found]
    if len(set(names)) < len(names):
        twice = sorted({name for name in names if names.count(name) > 1})
        raise TypeError(f"results declared twice: {', '.join(twice)}")
    return found


def _results(record: object, prefix: str) -> Iterator[Result]:
    kind: Any = type(record)  # a checker takes a class for an object that cannot be hashed
    for attribute, declaration, inner in layout(kind):
        value = getattr(record, attribute)
        if inner is not None:
            if value is not None:
                yield from _results(value, prefix + inner)
        elif declaration is not None and not (declaration.optional and value is None):
            yield Result(prefix + declaration.name, value, declaration.unit, declaration.meaning, declaration.shown)
