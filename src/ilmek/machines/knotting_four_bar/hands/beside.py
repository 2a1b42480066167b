"""Hands beside the cams and the arms of a loom's head, for the same cloth: knot, time, mass, price.

What cams tie with is what their head has beyond one for arms. The head with hands is that for arms with the time of the
hands in place of theirs: the least, for hands that reach out along the warps have to make way for pile handler and
sley besides, and no such head is designed.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.prices import price_of, read_prices
from ilmek.machines.automated_loom.design import head_for
from ilmek.machines.automated_loom.knotting import ARMS, CAMS, DYAD, WEAVER, KnottingHead
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.knotting_four_bar.hands.task import KNOTS, HandsTask
from ilmek.machines.weaver import WeaverParams
from ilmek.records import record
from ilmek.report import BillLine, Table, columns
from ilmek.units import format_quantity

QUICK = 0.1
"""Time of a knot [s] that no head keeps: it then ties as quickly as its tools' limits allow."""


@record
class KnottingKind:
    """A way of tying: knot, least time of a knot of its head [s], mass of what ties [kg] and its price."""

    name: str
    knot: str
    cycle: float
    mass: float
    price: float


@lru_cache(maxsize=8)
def heads_for(task: HandsTask) -> tuple[KnottingHead, KnottingHead]:
    """Heads on cams and with arms for the task's cloth and kind of knot."""
    kind = KNOTS[task.knot][0]
    cams, arms = (
        head_for(AutomatedLoomParams(knotting=name, knot=kind, warp_pitch=task.cloth.warp_pitch))
        for name in (CAMS, ARMS)
    )
    return cams, arms


@lru_cache(maxsize=8)
def kinds(task: HandsTask, knot_time: float, parts: Sequence[BillLine]) -> tuple[KnottingKind, ...]:
    """Cams, arms and hands of a time of their knot [s] and of parts."""
    cams, arms = heads_for(task)
    assert cams.weaver is not None
    assert arms.weaver is not None
    alike, of_arms = arms.weaver.params, arms.children[DYAD].parts
    (own, price), (rest, rest_price) = (_weighed(head.children[WEAVER].parts) for head in (cams, arms))
    of_hands = replace(alike, arms=replace(alike.arms, time=knot_time))
    return (
        KnottingKind(
            "cams", cams.weaver.knot_tied or "none", _least(cams.weaver.params), own - rest, price - rest_price
        ),
        KnottingKind("arms", KNOTS[task.knot][0], _least(alike), *_weighed(of_arms)),
        KnottingKind("hands", task.knot, _least(of_hands), *_weighed(parts)),
    )


def kinds_table(task: HandsTask, knot_time: float, parts: Sequence[BillLine]) -> Table:
    """Hands of a time of their knot [s] and of parts beside cams and arms."""
    heads = columns("tied by", "knot", "time of a knot [s]", "mass of what ties [kg]", "its price")
    pitch = format_quantity(task.cloth.warp_pitch, "mm")
    title = f"What ties, on warps {pitch} apart; of hands the least time, without making way for handler and sley"
    rows = tuple((one.name, one.knot, one.cycle, one.mass, one.price) for one in kinds(task, knot_time, parts))
    return Table("knotting-kinds", title, heads, rows)


def _least(params: WeaverParams) -> float:
    """Least time of a knot of a head [s]."""
    return float(MACHINES[WEAVER].design(replace(params, cycle=QUICK, optimise=True)).cycle)


def _weighed(parts: Sequence[BillLine]) -> tuple[float, float]:
    """Mass [kg] and price of lines of a parts list, by the usual table of prices."""
    prices = read_prices(None)
    return float(sum(line.mass_all for line in parts)), float(sum(price_of(line, prices) for line in parts))
