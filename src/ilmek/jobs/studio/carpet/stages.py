"""What a worker keeps of the charts that it made: the stages of the last ones, so that a change makes only what follows
from it.
"""

import math
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar, cast

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import resampled
from ilmek.carpet.flat import Flatness
from ilmek.carpet.palette import distinct_colours
from ilmek.carpet.reading import Design
from ilmek.jobs.chart import ChartResult
from ilmek.jobs.stages import Stages

T = TypeVar("T")

MOST = {"charted": 2, "chart": 3, "tile": 12}
"""Results that are kept of a stage; default: 1, since each may have the size of the picture."""

ROUNDED = 8
"""Codes of a channel that a draft of a large photo takes as one."""

LARGE = 400_000
"""Knots of a photo above which a draft differs from its chart: of a smaller one, the chart is as quick."""

TURNED = 1.5
"""Pixels a knot of which a draft turns a photo by an angle."""

_KEPT: dict[str, OrderedDict[tuple[Hashable, bool], Any]] = {}


def has_draft(kind: str, knots: int) -> bool:
    """Whether the draft of a design, read as `kind`, is another chart than its own."""
    return kind == "photo" and knots > LARGE


@dataclass(frozen=True, slots=True)
class KeptStages(Stages):
    """Stages that stay in the memory of this process.

    draft  the colours of a photo of more than LARGE knots are rounded to ROUNDED codes before they get their yarns,
           which leaves few of them. Patterns follow the true colours while no tone is changed, and the shades are those
           of the last chart while it has the same recipe, palette and fit, but for crop and turn; else some knots have
           other yarns than later. A part of a photo is taken for a photo, and one that is turned by an angle is made
           smaller before
    """

    draft: bool = False
    in_shades: bool = False
    with_whole: bool = False
    _assumed: list[Flatness] = field(default_factory=list, compare=False)
    """The readings that this draft took from another part of its picture: a chart must not take them."""

    def keep(self, stage: str, key: Hashable, make: Callable[[], T]) -> T:
        """The result of a stage, as `Stages.keep`; where the chart itself is kept, it is its draft too."""
        kept = _KEPT.setdefault(stage, OrderedDict())
        own, draft = (key, False), (key, True)
        name = draft if self.draft and own not in kept else own
        if name not in kept:
            result: T = make()
            chart = result.chart if isinstance(result, ChartResult) else result
            is_draft = isinstance(chart, Chart) and has_draft(chart.reading.kind, chart.knots.size)
            is_draft |= stage in ("prepared", "read") and bool(self._assumed)
            name = draft if self.draft and is_draft else own
            while len(kept) >= MOST.get(stage, 1):
                del kept[next((old for old in kept if old[1]), next(iter(kept)))]  # drafts first
            kept[name] = result
        kept.move_to_end(name)
        return cast("T", kept[name])

    def last(self, stage: str) -> object:
        """The result of a stage that was taken last, drafts left out; None: there is none."""
        return next((result for (_, is_draft), result in reversed(_KEPT.get(stage, {}).items()) if not is_draft), None)

    def seen(self, picture: Hashable, knots: int, look: Callable[[], Flatness]) -> Flatness:
        """As `Stages.seen`; a draft takes a part of a photo for a photo."""
        if self._is_of_photo(picture, knots):
            return self._assumed[-1]
        kept = _KEPT.setdefault("seen", OrderedDict())
        kept.clear()
        kept[picture, False] = look()
        return cast("Flatness", kept[picture, False])

    def to_turn(self, picture: Hashable, rgb: Rgb, knots: int) -> Rgb:
        """As `Stages.to_turn`; a draft takes TURNED pixels a knot of a photo."""
        height, width = rgb.shape[:2]
        scale = math.sqrt(TURNED * knots / (height * width))
        if scale > 1 or not self._is_of_photo(picture, knots):
            return rgb
        grid = round(scale * height), round(scale * width)
        return self.keep("to turn", (picture, grid), lambda: resampled(rgb, *grid))

    def _is_of_photo(self, picture: Hashable, knots: int) -> bool:
        """Whether a draft takes a part of a picture for a photo, because the last part was one; it is noted then."""
        last: Flatness | None = _KEPT.setdefault("seen", OrderedDict()).get((picture, False))
        if not self.draft or last is None or last.is_flat or not has_draft("photo", knots):
            return False
        self._assumed.append(last)
        return True

    def shown(self, key: Hashable, design: Design) -> Design:
        """The design with the colours of a draft, counted once."""
        if not self.draft or not has_draft(design.kind, design.colours.size // 3):
            return design

        def rounded() -> Design:
            colours = (design.colours & np.uint8(256 - ROUNDED)) + np.uint8(ROUNDED // 2)
            return replace(design, colours=colours, distinct=distinct_colours(colours))

        return self.keep("rounded", key, rounded)


def forget() -> None:
    """Forget all that is kept."""
    _KEPT.clear()
