"""Warping: the warps of a carpet are wound between bars, drawn in one by one, and tied to the cylinders in bundles.

    legs = ⌈l / d⌉        bars  first, two lease bars, legs - 1 turning bars, last
    T_w = share T         load of a turning bar  2 n T_w,   without turning bars of an end bar  n T_w
    time = set-up + n l / v + n t_drawn + 2 ⌈n / bundle⌉ t_tied

n warps of the length l, d longest distance of two bars, T tension on the loom. The yarn goes from the first bar to the
last and back: a warp each way. Warps that go pass over the first lease bar and under the second, those that come back
under and over: the cross keeps their order until they are drawn in. Every end of a turn is an end of the loom's warp:
the first and the last bar lie at its cylinders. Rates are assumed by this project, each with what is usual.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from ilmek.params import Params, kind
from ilmek.records import computed, record
from ilmek.report import Table, columns
from ilmek.weaving.cloth import Cloth

DRAWN_IN = ("warp", "knot", "warp of the knot", "shed", "lifted by", "slot of the spacer")
"""Heading of the drawing-in list: warps and slots from the left, knots of a row."""


@dataclass(frozen=True, slots=True)
class WarpingParams(Params):
    """The warping frame, and the times of its hands."""

    bar_distance: float = kind.length(
        3.0, unit="m", at_least=0.1, at_most=100.0, doc="longest distance of two bars; usual: 1 to 5 m"
    )
    tension_share: float = kind.ratio(
        0.05, unit="%", at_least=0.0, at_most=1.0, doc="tension while winding, over that on the loom; usual: 2 to 20 %"
    )
    set_up: float = kind.time(
        1800.0, unit="h", at_least=0.0, at_most=1e6, doc="setting of bars, packages and cylinders; usual: 0.25 to 2 h"
    )
    speed: float = kind.speed(1.0, at_least=1e-3, at_most=100.0, doc="winding of a warp; usual: 0.5 to 5 m/s")
    drawing_in: float = kind.time(12.0, at_least=0.0, at_most=3600.0, doc="drawing-in of a warp; usual: 5 to 20 s")
    bundle: int = kind.count(20, at_least=1, at_most=1000, doc="warps that are tied together; usual: 10 to 40")
    tying: float = kind.time(
        30.0, at_least=0.0, at_most=3600.0, doc="tensioning and tying of a bundle at one end; usual: 15 to 60 s"
    )


@record
class WarpEnd:
    """A warp from the left: its knot in the row, None in a selvedge; first or second of the knot; odd or even."""

    number: int
    knot: int | None
    of_knot: int | None
    odd: bool


@record
class Warping:
    """Warps of a cloth, each of a length [m] to be wound, for a number of knots of a row; the rest are selvedges."""

    params: WarpingParams
    cloth: Cloth
    knots: int
    length: float

    warp_cut = computed(
        "m",
        "length of a warp to be wound: carpet, take-up by its crimp, fringes, what is lost in the loom",
        lambda it: it.length,
    )
    warp_mass = computed(
        "kg", "all warps, wound", lambda it: it.cloth.warps * it.length * it.cloth.carpet_yarns.warp.linear_density
    )
    winding_tension = computed(
        "N", "tension of a warp while it is wound", lambda it: it.params.tension_share * it.cloth.warp_tension
    )
    warping_bars = computed("", "bars in the order in which the warp passes them", lambda it: list(it.bars))
    bar_load = computed(
        "N",
        "load of the bar with the most of it, all warps wound",
        lambda it: it.cloth.warps * it.winding_tension * (2 if it.legs > 1 else 1),
    )

    @computed("s", "acts of dressing the loom")
    def dressing_acts(self) -> dict[str, float]:
        params, warps = self.params, self.cloth.warps
        return {
            "setting up": params.set_up,
            "winding": warps * self.length / params.speed,
            "drawing in": warps * params.drawing_in,
            "tying": 2 * math.ceil(warps / params.bundle) * params.tying,
        }

    @computed("h", "preparing, winding, drawing in and tying of all warps")
    def dressing_time(self) -> float:
        acts: dict[str, float] = self.dressing_acts
        return sum(acts.values())

    @property
    def legs(self) -> int:
        """Legs of a warp between the bars."""
        return max(1, math.ceil(self.length / self.params.bar_distance * (1 - 1e-12)))

    @property
    def bars(self) -> tuple[str, ...]:
        """Bars in the order in which the warp passes them."""
        turning = (f"turning bar {number}" for number in range(1, self.legs))
        return ("first bar", "lease bar 1", "lease bar 2", *turning, "last bar")

    def ends(self) -> Iterator[WarpEnd]:
        """Every warp from the left: two for each knot between the selvedges; the first one is odd."""
        before = (self.cloth.warps - 2 * self.knots) // 2
        for index in range(self.cloth.warps):
            own = index - before
            tied = 0 <= own < 2 * self.knots
            knot, of_knot = (own // 2 + 1, own % 2 + 1) if tied else (None, None)
            yield WarpEnd(index + 1, knot, of_knot, index % 2 == 0)

    def drawn(self, guide: Callable[[WarpEnd], str]) -> Iterator[tuple[int | str, ...]]:
        """Lines of the drawing-in list, as DRAWN_IN; guide: what lifts a warp."""
        for end in self.ends():
            of_knot = (end.knot, end.of_knot) if end.knot and end.of_knot else ("", "")
            yield end.number, *of_knot, "odd" if end.odd else "even", guide(end), end.number

    def tables(self, guide: Callable[[WarpEnd], str]) -> tuple[Table, ...]:
        """Acts of dressing with their times, and the first and last warps of selvedges and knots, drawn in."""
        lines, acts = list(self.drawn(guide)), self.dressing_acts
        before = (self.cloth.warps - 2 * self.knots) // 2
        edges = (0, before, before + 2 * self.knots, len(lines))
        kept = sorted({at for first, last in pairwise(edges) if last > first for at in (first, last - 1)})
        title = f"Drawing-in: first and last warps of selvedges and knots; bars in order: {', '.join(self.bars)}"
        return (
            Table("dressing", "Dressing of the loom", columns("act", "time [min]"), tuple(acts.items())),
            Table("drawing-in", title, columns(*DRAWN_IN), tuple(lines[at] for at in kept)),
        )
