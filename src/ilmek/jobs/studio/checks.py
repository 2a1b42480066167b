"""A check as the studio shows it, with its texts."""

import math
from dataclasses import dataclass

from ilmek.jobs.studio.words import in_page
from ilmek.report import Check
from ilmek.viz.number_format import beside, compared


@dataclass(frozen=True, slots=True)
class ShownCheck:
    """A check: `value` against `limit` [SI], both as texts too.

    machine     the machine in it that the check is of, "" for its own
    limit_text  with its relation: "≤ 5 mm"; "" of a plain yes or no
    ratio       value over limit; null of a plain yes or no, where the limit is 0, or one of them is no number
    """

    name: str
    machine: str
    ok: bool
    value: float | None
    limit: float | None
    relation: str
    value_text: str
    limit_text: str
    ratio: float | None
    source: str
    cure: str


def printed(check: Check) -> tuple[str, str]:
    """Value and limit with their unit, the limit with its relation; of a plain yes or no, the limit is left out.

    >>> from ilmek.report import at_most, must
    >>> printed(at_most("angle", 0.1, 0.2, "deg", "")), printed(must("knot tied", False, ""))
    (('5.73°', '≤ 11.46°'), ('no', ''))
    """
    value, limit = compared(check)
    unit = beside(check)
    return value + unit, "" if limit == "yes" else limit + unit


def shown_check(check: Check, machine: str = "") -> ShownCheck:
    """A check as it is shown; machine: in it that the check is of."""
    value, limit = printed(check)
    return ShownCheck(
        name=in_page(check.name),
        machine=machine,
        ok=check.ok,
        value=finite(check.value),
        limit=finite(check.limit),
        relation=check.relation,
        value_text=value,
        limit_text=limit,
        ratio=ratio_of(check) if limit else None,
        source=in_page(check.source),
        cure=in_page(check.cure),
    )


def ratio_of(check: Check) -> float | None:
    """Value over limit of a check; None where that is no number."""
    return finite(check.value / check.limit) if check.limit and math.isfinite(check.limit) else None


def finite(value: float | None) -> float | None:
    """A value as a number of JSON; None where it is none."""
    return None if value is None or not math.isfinite(value) else float(value)
