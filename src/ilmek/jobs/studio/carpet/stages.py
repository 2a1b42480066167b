"""What a worker keeps of the charts that it made: the stages of the last ones, so that a change makes only what follows
from it.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from ilmek.carpet.reading import Design
from ilmek.jobs.stages import Stages

T = TypeVar("T")

MOST = {"charted": 2, "chart": 3, "tile": 12}
"""Results that are kept of a stage; default: 1, since each may have the size of the picture."""

ROUNDED = 8
"""Codes of a channel that a draft takes as one."""

_KEPT: dict[str, OrderedDict[Hashable, Any]] = {}


@dataclass(frozen=True, slots=True)
class KeptStages(Stages):
    """Stages that stay in the memory of this process.

    draft  the colours of a photo are rounded to ROUNDED codes, which leaves few of them: the yarns of a chart of
           1.5 million knots are then chosen within a tenth of the time, and few knots have another yarn than later
    """

    draft: bool = False

    def keep(self, stage: str, key: Hashable, make: Callable[[], T]) -> T:
        """The result of a stage, as `Stages.keep`."""
        kept = _KEPT.setdefault(stage, OrderedDict())
        full_key = (key, self.draft and stage == "chart")
        if full_key not in kept:
            most = MOST.get(stage, 1)
            while len(kept) >= most:
                kept.popitem(last=False)
            kept[full_key] = make()
        kept.move_to_end(full_key)
        result: T = kept[full_key]
        return result

    def shown(self, design: Design) -> Design:
        """The design with the colours of a draft."""
        if not self.draft or design.kind != "photo":
            return design
        colours = (design.colours & np.uint8(256 - ROUNDED)) + np.uint8(ROUNDED // 2)
        return replace(design, colours=colours)


def forget() -> None:
    """Forget all that is kept."""
    _KEPT.clear()
