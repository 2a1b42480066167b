"""The worksheet of a paper: which of its printed numbers a number follows from, and what a rounding or a slip changes.

A claim's `follows` is the step by which the paper gets the number from numbers that it printed before. A number is
then traced: every number before it is put right in turn, neither rounded nor with its slip, all others as printed, and
the steps behind it are taken again. What that changes is the part of the miss that comes from there.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from typing import NamedTuple

from ilmek.verification.claim import RESIDUAL, Claim, last_digit, near, read_printed

PART = 0.05
"""A change below this share of the largest one is left out."""


class RowOrigin(NamedTuple):
    """A slip, or a rounded number, that another number follows from.

    name         a key of SLIPS, or the item of a printed number; with the slip all numbers that have it are put right
    printed      the rounded number, "" of a slip
    change       of the other number [its printed unit], if this one were right and not rounded
    sensitivity  change of the other number for a unit of the rounded one, both in their printed units; NaN of a slip
    bound        what rounding explains: sensitivity times half a unit of the last digit, a whole one where the number
                 was truncated; 0 of a slip
    si_factor    of the rounded number's printed unit; NaN of a slip
    """

    name: str
    printed: str
    change: float
    sensitivity: float = math.nan
    bound: float = 0.0
    si_factor: float = math.nan


class _Reader(Mapping[str, float]):
    """Numbers by item, which notes what is read."""

    def __init__(self, value: Callable[[str], float]) -> None:
        self.read: list[str] = []
        self._value = value

    def __getitem__(self, item: str) -> float:
        self.read.append(item)
        return self._value(item)

    def __iter__(self) -> Iterator[str]:
        return iter(self.read)

    def __len__(self) -> int:
        return len(self.read)


class Worksheet:
    """The claims of one paper by their items."""

    def __init__(self, claims: Iterable[Claim]) -> None:
        self.claims = {claim.item: claim for claim in claims}
        self._computed = cache(lambda item: self.claims[item].compute())
        self._parents = cache(self._parents_of)
        self._before = cache(self._items_before)

    def printed(self, item: str) -> float:
        """The number as printed, in its printed unit."""
        return float(read_printed(self.claims[item].printed)[1])

    def by_step(self, item: str) -> float:
        """The number by the paper's own step from the numbers as printed; where there is none, as computed."""
        claim = self.claims[item]
        value = self._computed(item) if claim.follows is None else claim.follows(_Reader(self.printed))
        return math.nan if value is None else float(value)

    def put_right(self, item: str, items: Iterable[str]) -> float:
        """The number by the steps, if `items`, itself or before it, were right and not rounded.

        Others keep what their rounding or slip adds to their step.
        """
        return self._value(item, frozenset(items), {})

    def before(self, item: str) -> tuple[str, ...]:
        """The printed numbers that a number follows from, directly or by others; those nearest to it first."""
        return self._before(item)

    def slips(self, item: str) -> tuple[str, ...]:
        """What is wrong in the step of a number itself; the item, where it does not even follow from its step."""
        claim = self.claims[item]
        if claim.unit == RESIDUAL or (claim.slips and claim.follows is None):
            return claim.slips or (item,)
        follows = near(read_printed(claim.printed)[1], self.by_step(item))
        return claim.slips if follows else (*claim.slips, item)

    def origins(self, item: str) -> tuple[RowOrigin, ...]:
        """What a number's miss comes from, the largest part first: its own slips, and no other below a share of it."""
        slipped: dict[str, list[str]] = {}
        for source in (item, *self._before(item)):
            for slip in self.slips(source):
                slipped.setdefault(slip, []).append(source)
        rounded = (source for source in self._before(item) if not self.slips(source))
        sources = (
            *(RowOrigin(slip, "", self._change(item, items)) for slip, items in slipped.items()),
            *(self._rounded(item, source) for source in rounded),
        )
        traced = sorted(sources, key=lambda origin: -abs(origin.change))
        own, least = self.slips(item), PART * abs(traced[0].change) if traced else 0.0
        return tuple(origin for origin in traced if abs(origin.change) > least or origin.name in own)

    def _change(self, item: str, sources: Iterable[str]) -> float:
        return self.put_right(item, sources) - self.printed(item)

    def _rounded(self, item: str, source: str) -> RowOrigin:
        claim, change, error = self.claims[source], self._change(item, (source,)), self._change(source, (source,))
        sensitivity = change / error if error else 0.0
        digit = last_digit(read_printed(claim.printed)[1])
        bound = abs(sensitivity) * digit * (1.0 if abs(error) > 0.5 * digit else 0.5)
        return RowOrigin(source, claim.printed, change, sensitivity, bound, claim.si_factor)

    def _parents_of(self, item: str) -> tuple[str, ...]:
        reader = _Reader(self.printed)
        for step in (self.claims[item].follows, self.claims[item].right):
            if step is not None:
                step(reader)
        return tuple(dict.fromkeys(reader.read))

    def _items_before(self, item: str) -> tuple[str, ...]:
        parents = self._parents(item)
        return tuple(dict.fromkeys((*parents, *(far for parent in parents for far in self._before(parent)))))

    def _value(self, item: str, right: frozenset[str], known: dict[str, float]) -> float:
        if item not in known:
            known[item] = self._new_value(item, right, known)
        return known[item]

    def _new_value(self, item: str, right: frozenset[str], known: dict[str, float]) -> float:
        claim = self.claims[item]
        values = _Reader(lambda name: self._value(name, right, known))
        if item in right:
            step = claim.right or claim.follows
            computed = step(values) if step else self._computed(item)
            return math.nan if computed is None else float(computed)
        if claim.follows is None or not right & set(self._before(item)):
            return self.printed(item)
        return self.printed(item) + claim.follows(values) - self.by_step(item)
