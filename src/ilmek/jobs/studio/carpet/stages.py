"""What a worker keeps of the charts that it made: the stages of the last ones, so that a change makes only what follows
from it.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar, cast

import numpy as np

from ilmek.carpet.chart import Chart
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
           other yarns than later. A part of a photo is taken for a photo
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
            is_draft |= stage == "read" and bool(self._assumed)
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
        kept = _KEPT.setdefault("seen", OrderedDict())
        last: Flatness | None = kept.get((picture, False))
        if self.draft and last is not None and not last.is_flat and has_draft("photo", knots):
            self._assumed.append(last)
            return last
        kept.clear()
        kept[picture, False] = look()
        return cast("Flatness", kept[picture, False])

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
