"""The nearest carpets that a loom can weave, where it cannot weave the one that is required.

One wish is relaxed at a time, all others are kept: a coarser quality, a narrower carpet, the other knot, a later
deadline. Quality and width are searched on a ladder of shares of what is required, by bisection: what fits at a share
is taken to fit at every smaller one.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

from ilmek.carpet.quality import COARSEST
from ilmek.carpet.sizes import SMALLEST
from ilmek.elements.knot_kinds import WRAPS
from ilmek.errors import IlmekError
from ilmek.machines.automated_loom.assembly import holds_in_space
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.automated_loom.report import all_checks
from ilmek.machines.automated_loom.selection import design, with_room
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import format_quantity

SHARES = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
"""Shares of the quality, and of the width, that are tried."""


@record
class NearestFit:
    """A carpet that the loom could weave: the wish that is relaxed, and its value as a text with a unit."""

    wish: str
    value: str


def nearest_fits(params: AutomatedLoomParams, progress: Progress = SILENT) -> tuple[NearestFit, ...]:
    """The nearest carpets that a loom for these wishes can weave, one for each wish that helps when it is relaxed."""
    nearest_fits: list[NearestFit] = []
    steps = (_coarser, _narrower, _other_knots)
    for number, step in enumerate(steps):
        progress.part(number / len(steps), (number + 1) / len(steps), "nearest carpet that can be woven")
        nearest_fits += step(params)
    return tuple(nearest_fits)


def weaves(params: AutomatedLoomParams, *, in_space: bool = True) -> bool:
    """Whether every check of the loom for these wishes holds; False where it cannot be designed.

    in_space  False: without its parts against each other
    """
    try:
        loom = design(params)
        if not _holds(loom):
            return False
        if not in_space or holds_in_space(loom):
            return True
        other = with_room(loom, params)
        return other is not loom and _holds(other) and holds_in_space(other)
    except IlmekError:
        return False


def _holds(loom: LoomDesign) -> bool:
    return all(check.ok for check in all_checks(loom))


def _coarser(params: AutomatedLoomParams) -> Iterator[NearestFit]:
    across, along = params.quality.across, params.quality.along

    def scaled(share: float) -> AutomatedLoomParams | None:
        if min(across, along) * share < COARSEST:
            return None
        return replace(params, knots_across=across * share, knots_along=along * share, warp_pitch=None)

    for share in _largest(scaled):
        yield NearestFit("quality", " x ".join(format_quantity(one * share, "1/dm", 3) for one in (across, along)))


def _narrower(params: AutomatedLoomParams) -> Iterator[NearestFit]:
    def scaled(share: float) -> AutomatedLoomParams | None:
        return replace(params, width=params.width * share) if params.width * share >= SMALLEST else None

    for share in _largest(scaled):
        yield NearestFit("width", format_quantity(params.width * share, "m", 3))


def _other_knots(params: AutomatedLoomParams) -> Iterator[NearestFit]:
    for knot in WRAPS:
        if knot != params.knot and weaves(replace(params, knot=knot)):
            yield NearestFit("knot", knot)


def _largest(scaled: Callable[[float], AutomatedLoomParams | None]) -> Iterator[float]:
    """The largest of `SHARES` at which the loom weaves; none where it weaves at no share."""

    def fits(index: int, *, in_space: bool) -> bool:
        tried = scaled(SHARES[index])
        return tried is not None and weaves(tried, in_space=in_space)

    # Without its parts in space a loom is judged ten times as quickly: what does not fit even so is left out first.
    alone = _first(0, lambda index: fits(index, in_space=False))
    index = alone
    if index < len(SHARES) and not fits(index, in_space=True):
        index = _first(alone + 1, lambda index: fits(index, in_space=True))
    if index < len(SHARES):
        yield SHARES[index]


def _first(low: int, fits: Callable[[int], bool]) -> int:
    """The first index from `low` on that fits, where all after it do; else the number of `SHARES`."""
    high = len(SHARES)
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if fits(middle) else (middle + 1, high)
    return low
