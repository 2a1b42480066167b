"""One design of a study: its numbers and margins, or why there are none; evaluated in any process."""

import math
import signal
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Protocol

from ilmek.errors import IlmekError, ParameterError, did_you_mean
from ilmek.params import Value
from ilmek.records import record
from ilmek.report import Check, at_least, at_most

DONE, REFUSED, FAULT, TIMEOUT, DIED = "done", "refused", "fault", "timeout", "died"
"""Designed; no such design, as where a mechanism cannot close; a fault of ours; too slow; its process ended."""


@record
class Numbers:
    """What a design reports: numbers by name [SI], their units, and its checks."""

    results: Mapping[str, float]
    units: Mapping[str, str]
    checks: tuple[Check, ...]


class StudySubject(Protocol):
    """What a study evaluates; it is sent to other processes."""

    @property
    def identity(self) -> Mapping[str, object]:
        """What distinguishes it from others, as plain data: its name or file, and what is fixed."""

    @property
    def together(self) -> int:
        """How many designs are evaluated at once; 1: each alone."""

    def numbers(self, values: Mapping[str, Value], only: Sequence[str] | None = None) -> Numbers:
        """These results, or all, and the checks of the design with these values.

        Raises IlmekError where there is no such design.
        """

    def numbers_together(self, designs: Sequence[Mapping[str, Value]], results: Sequence[str]) -> Mapping[int, Numbers]:
        """These results, and the checks, of those of some designs, by their places, that are evaluated at once."""


@record
class Hold:
    """A limit that a study gives to a result: `relation` is <= or >=; the limit is SI."""

    result: str
    relation: str
    limit: float
    unit: str

    @property
    def name(self) -> str:
        """Name of its check."""
        return f"{self.result} {self.relation} limit"

    def check(self, value: float) -> Check:
        """The limit as a check of a design."""
        judge = at_most if self.relation == "<=" else at_least
        return judge(self.name, value, self.limit, self.unit, "limit of the study")


@record
class Question:
    """What is computed of each design: chosen results, limits, and the longest time [s]; 0: any."""

    target: StudySubject
    results: tuple[str, ...]
    holds: tuple[Hold, ...] = ()
    time_limit: float = 0.0

    @property
    def needed(self) -> tuple[str, ...]:
        """The results and those that have a limit."""
        return tuple(dict.fromkeys((*self.results, *(hold.result for hold in self.holds))))


@record
class Outcome:
    """One design.

    status   DONE, REFUSED, FAULT, TIMEOUT or DIED; the others than DONE have a reason and no numbers
    results  in the order of the question; NaN where the design has no such result
    margins  check -> its margin
    failed   number of checks that do not hold
    """

    status: str
    reason: str = ""
    results: tuple[float, ...] = ()
    margins: Mapping[str, float] | None = None
    failed: int = 0

    @property
    def worst(self) -> float:
        """The least margin; NaN without checks that have a distance to their limit."""
        return min((one for one in (self.margins or {}).values() if one < math.inf), default=math.nan)


def margin(check: Check) -> float:
    """How far a check is from failing, relative to its limit, or absolute where that is 0; negative: it fails.

    A plain yes, and a count of 0, has no distance: infinity.

    >>> margin(at_most("sag", 0.003, 0.002, "mm", "given")), margin(at_least("angle", 0.8, 0.4, "rad", "given"))
    (-0.5, 1.0)
    """
    if not math.isfinite(check.value) and not check.ok:
        return -math.inf
    if check.unit in ("", "1") and check.limit in (0, 1) and check.ok and check.value == check.limit:
        return math.inf  # a plain yes, or a count of 0
    distance = check.limit - check.value if check.relation == "<=" else check.value - check.limit
    return distance / abs(check.limit) if check.limit else distance


def evaluated(question: Question, designs: Sequence[Mapping[str, Value]]) -> list[Outcome]:
    """The outcomes of some designs. A design that is refused, that fails or takes too long has a reason instead."""
    target, found = question.target, dict[int, Numbers]()
    if target.together > 1 and not question.time_limit:
        with suppress(Exception):  # then each of them is evaluated alone, and its fault is its reason
            found = dict(target.numbers_together(designs, question.needed))
    return [
        _outcome(question, found[place]) if place in found else _evaluated(question, values)
        for place, values in enumerate(designs)
    ]


def _evaluated(question: Question, values: Mapping[str, Value]) -> Outcome:
    try:
        with _at_most(question.time_limit):
            numbers = question.target.numbers(values, question.needed)
    except IlmekError as error:
        return Outcome(REFUSED, str(error))
    except _TooSlow:
        return Outcome(TIMEOUT, f"longer than {question.time_limit:g} s")
    except Exception as error:  # a study goes on: the design is a row, and its fault is the reason
        return Outcome(FAULT, f"{type(error).__name__}: {error}")
    return _outcome(question, numbers)


def _outcome(question: Question, numbers: Numbers) -> Outcome:
    results = tuple(numbers.results.get(name, math.nan) for name in question.results)
    limits = tuple(hold.check(numbers.results.get(hold.result, math.nan)) for hold in question.holds)
    checks = (*numbers.checks, *limits)
    margins: dict[str, float] = {}
    for check in checks:
        margins[check.name] = min(margin(check), margins.get(check.name, math.inf))
    return Outcome(DONE, "", results, margins, sum(not check.ok for check in checks))


class _TooSlow(BaseException):
    """A design takes longer than its limit; no `except Exception` of the design itself must catch it."""


@contextmanager
def _at_most(limit: float) -> Iterator[None]:
    """Interrupt what takes longer than a limit [s]; needs the timer of a POSIX system, elsewhere nothing is."""
    if not limit or not hasattr(signal, "setitimer"):
        yield
        return

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise _TooSlow

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, limit)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def result_named(name: str, units: Mapping[str, str]) -> str:
    """The result of a name. Raises ParameterError, naming the nearest."""
    if name not in units:
        near = did_you_mean(name, units, otherwise=f"it has {', '.join(sorted(units)[:20])}")
        raise ParameterError(f"no result {name!r} that is a number", do=near)
    return name
