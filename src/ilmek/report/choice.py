"""Choices: what a design chose of what was left open, which check decided, and what the next cheaper one failed."""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.records import JsonObject
from ilmek.report.check import Check, in_words
from ilmek.report.json import plain
from ilmek.report.verdict import weight


@dataclass(frozen=True, slots=True)
class Choice:
    """A choice of a design.

    name          what was chosen, a parameter's name where it is one         chosen  with its unit
    decided_by    the check that the next cheaper fails, or the aim: price, time
    next_cheaper  the next cheaper one; "" where this is the cheapest
    failed        value and limit of the check that it fails; "" where none
    """

    name: str
    chosen: str
    decided_by: str
    next_cheaper: str = ""
    failed: str = ""

    def as_json(self) -> JsonObject:
        """The choice as plain data."""
        return {name: plain(getattr(self, name)) for name in Choice.__slots__}


@dataclass(frozen=True, slots=True)
class Alternative:
    """What could be chosen: its name, with a unit, and its checks."""

    name: str
    checks: tuple[Check, ...]

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks that do not hold."""
        return tuple(check for check in self.checks if not check.ok)


def choose(name: str, candidates: Sequence[Alternative], aim: str = "price") -> tuple[int, Choice]:
    """The first candidate whose checks hold, of candidates in ascending order of what the aim makes least.

    Where none holds, the one whose heaviest failed check weighs least. Returns its index and the choice. Raises
    ValueError without candidates.

    >>> from ilmek.report.check import at_least
    >>> bars = [Alternative(f"{d} mm", (at_least("stress", d, 15, "mm", "limit"),)) for d in (10, 20)]
    >>> choose("bar", bars)[1]
    Choice(name='bar', chosen='20 mm', decided_by='stress', next_cheaper='10 mm', failed='10000 mm, limit >= 15000 mm')
    """
    worst = [max((weight(check) for check in candidate.failed), default=-1.0) for candidate in candidates]
    index = next((at for at, value in enumerate(worst) if value < 0), worst.index(min(worst)))
    if index == 0:
        return 0, Choice(name, candidates[0].name, aim)
    before = candidates[index - 1]
    check = max(before.failed, key=weight, default=None)
    if check is None:
        return index, Choice(name, candidates[index].name, "no candidate keeps every limit", before.name)
    return index, Choice(name, candidates[index].name, check.name, before.name, failing(check))


def failing(check: Check) -> str:
    """Value and limit of a check as a text."""
    value, limit = in_words(check)
    return f"{value}, limit {check.relation} {limit}"
