"""The verdict on a machine: whether it does its work, and if not, the reasons in order of weight.

A machine does its work if every check of it and of the machines in it holds. The weight of a failed check is how far
the value misses its limit, |ln(value / limit)|; a value that is no number, or has another sign, weighs most.
"""

import math
from collections.abc import Iterable
from dataclasses import replace

from ilmek.report.check import Check, in_si
from ilmek.report.json import Json, plain


def reasons(checks: Iterable[Check]) -> tuple[Check, ...]:
    """The failed checks, the heaviest first; equal ones in their order. A check without a cure refers to its limit."""
    failed = sorted((check for check in checks if not check.ok), key=weight, reverse=True)
    return tuple(check if check.cure else replace(check, cure=_usual_cure(check)) for check in failed)


def reason_json(reason: Check) -> dict[str, Json]:
    """A reason as plain data: name, value and limit [SI], their unit, cure, shown."""
    return {name: plain(getattr(reason, name)) for name in ("name", "value", "limit", "unit", "cure")} | in_si(reason)


def _usual_cure(check: Check) -> str:
    return f"change what sets its value, or its limit: {check.source}" if check.source else "change what sets its value"


def verdict_json(checks: Iterable[Check]) -> dict[str, Json]:
    """The verdict as plain data: whether all checks hold, and the reasons where they do not."""
    failed = reasons(checks)
    return {"holds": not failed, "reasons": [reason_json(reason) for reason in failed]}


def weight(check: Check) -> float:
    """How far a failed check misses its limit: |ln(value / limit)|; inf where that is no number."""
    ratio = check.value / check.limit if check.limit else math.inf
    return abs(math.log(ratio)) if math.isfinite(ratio) and ratio > 0 else math.inf
