"""How much a test tries.

In `make test` a little, the same in every run, so that a change breaks it and not chance. In a campaign much more, and
other cases for each seed: `make campaigns SEED=7` sets ILMEK_CAMPAIGN=7.
"""

import os
import zlib
from collections.abc import Iterable, Sequence
from typing import TypeVar

from hypothesis import settings

Amount = TypeVar("Amount")
Case = TypeVar("Case")
_GIVEN = os.environ.get("ILMEK_CAMPAIGN")
SEED = None if _GIVEN is None else int(_GIVEN)
"""Seed of the campaign; None: `make test`."""


def number(light: Amount, whole: Amount) -> Amount:
    """So many cases, or these: `light` in `make test`, `whole` in a campaign."""
    return light if SEED is None else whole


def first(light: int = 0) -> int:
    """A seed to begin with: `light` in `make test`, another one in every campaign."""
    return light if SEED is None else light + 1000 * (SEED + 1)


def seeds(light: int, whole: int) -> range:
    """Seeds of cases: 0, 1 ... in `make test`, others and more in a campaign."""
    return range(first(), first() + number(light, whole))


def some(cases: Iterable[Case], light: int) -> list[Case]:
    """So many of the cases in `make test`, spread over them, the first and the last among them; all in a campaign."""
    every = list(cases)
    if SEED is not None or light >= len(every):
        return every
    return [every[round(index * (len(every) - 1) / max(light - 1, 1))] for index in range(light)]


def share_of(cases: Sequence[Case], count: int, name: str) -> Sequence[Case]:
    """One case in `count` in `make test`, others for each name, so that tests of one matrix share it out; all in a
    campaign.
    """
    return cases if SEED is not None else cases[zlib.crc32(name.encode()) % min(count, len(cases)) :: count]


def examples(whole: int, light: int | None = None) -> settings:
    """Settings of a property: so many examples in a campaign, and `light`, a third of them, in `make test`."""
    return settings(max_examples=number(light or -(-whole // 3), whole), deadline=None)
