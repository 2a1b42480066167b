"""Checks: every judgement of a design is a value against a limit, with the source of the limit."""

import math
from dataclasses import fields

from ilmek.records import value_record
from ilmek.report.json import Json, plain
from ilmek.report.rounding import without_noise
from ilmek.units import format_quantity, si_unit

ROUNDING = 1e-9
"""Relative difference to a limit that counts as rounding: a part made for exactly its limit keeps it."""


@value_record
class Check:
    """A judgement: `value` against `limit` [SI, shown in `unit`], the source of the limit, and what cures a failure.

    parts  ids of the parts that it concerns
    """

    name: str
    value: float
    limit: float
    unit: str
    ok: bool
    source: str
    relation: str = "<="
    cure: str = ""
    parts: tuple[str, ...] = ()

    def with_cure(self, cure: str, *parts: str) -> "Check":
        """The check with what cures a failure, and the ids of the parts that it concerns."""
        return Check(
            self.name, self.value, self.limit, self.unit, self.ok, self.source, self.relation, cure, parts
        )  # as `replace`, of which a design has ten thousands, in a third of the time

    def as_json(self) -> dict[str, Json]:
        """The check as plain data: name, value and limit [SI], their unit, ok, source, relation, cure, shown."""
        return {field.name: plain(getattr(self, field.name)) for field in fields(self)} | in_si(self)


def in_si(check: Check) -> dict[str, str]:
    """The unit of value and limit as they are, and both in words in the unit for people.

    >>> in_si(at_most("sag", 0.003, 0.002, "mm", "given")), in_si(must("knot tied", False, "its path"))
    ({'unit': 'm', 'shown': '3 mm <= 2 mm'}, {'unit': '', 'shown': 'no'})
    """
    value, limit = in_words(check)
    value, limit = (
        text if math.isfinite(number) else "–" for text, number in ((value, check.value), (limit, check.limit))
    )
    return {"unit": si_unit(check.unit), "shown": value if limit == "yes" else f"{value} {check.relation} {limit}"}


def at_most(name: str, value: float, limit: float, unit: str, source: str) -> Check:
    """The check value <= limit; a value that differs from the limit by rounding keeps it, NaN fails.

    >>> at_most("pressure angle", 0.1 + 0.2, 0.3, "rad", "given").ok
    True
    """
    value = snap_to_limit(value, limit)
    return Check(name, value, float(limit), unit, bool(value <= limit), source)


def at_least(name: str, value: float, limit: float, unit: str, source: str) -> Check:
    """The check value >= limit; a value that differs from the limit by rounding keeps it, NaN fails."""
    value = snap_to_limit(value, limit)
    return Check(name, value, float(limit), unit, bool(value >= limit), source, ">=")


def must(name: str, holds: bool, source: str) -> Check:
    """The check of a plain yes or no, 1 or 0: what the machine must do, or a part that it must have."""
    return Check(name, float(holds), 1.0, "", holds, source, ">=")


def in_words(check: Check) -> tuple[str, str]:
    """Value and limit in the check's unit; of a plain yes or no, these words.

    >>> in_words(at_most("sag", 0.003, 0.002, "mm", "given")), in_words(must("knot tied", False, "its path"))
    (('3 mm', '2 mm'), ('no', 'yes'))
    >>> in_words(at_most("sag", 0.00200004, 0.002, "mm", "given"))
    ('2.00004 mm', '2 mm')
    """
    if not check.unit and check.limit == 1 and check.value in (0, 1):
        return ("yes" if check.value else "no"), "yes"
    value, digits = shown_value(check)
    return format_quantity(value, check.unit, digits), format_quantity(check.limit, check.unit, digits)


def shown_value(check: Check) -> tuple[float, int]:
    """The value of a check as it is shown [SI], without rounding noise, and the digits of value and limit."""
    value = without_noise(check.value, check.limit, check.unit)
    return value, 4 if check.ok else digits_apart(value, check.limit, check.unit)


def digits_apart(value: float, limit: float, unit: str) -> int:
    """Significant digits, 4 to 17, with which two different values [SI] are written differently in a unit."""

    def apart(digits: int) -> bool:
        return format_quantity(value, unit, digits) != format_quantity(limit, unit, digits)

    return 4 if value == limit or math.isnan(value) else next(filter(apart, range(4, 17)), 17)


def snap_to_limit(value: float, limit: float) -> float:
    """The limit where the value equals it but for rounding, else the value."""
    return float(limit if math.isclose(value, limit, rel_tol=ROUNDING) else value)
