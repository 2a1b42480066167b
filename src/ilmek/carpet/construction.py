"""How a carpet is made beyond its size and quality: outline, binding, flat weave, heights, fibres, carved lines."""

from collections import defaultdict
from operator import itemgetter

import numpy as np

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.carving import carved_length
from ilmek.carpet.cells import OUTSIDE, Carving
from ilmek.carpet.chart import Chart
from ilmek.carpet.shape import RECTANGLE, ShapeParams
from ilmek.carpet.yarn_plan import OVERCAST, YarnPlanParams
from ilmek.records import JsonObject, record

FREE = "free"
"""The outline of a carpet that is cut away along no shape with an equation."""


@record
class PileOfCarpet:
    """A pile of a carpet: its height [m], loops or cut, and its knots."""

    height: float
    loop: bool
    knots: int


@record
class CarpetConstruction:
    """The construction of a carpet.

    shape    RECTANGLE, a name of `carpet.shape.SHAPES`, or FREE      edge  length that is cut and bound [m]; 0: none
    binding, binding_width, binding_yarn  of the edge: "" and 0 where nothing is bound; a tape has no yarn
    ends     length of flat weave at the lower and the upper end [m]
    flat     area of flat weave elsewhere [m²]          piles  the heights of its pile
    fibres   share of each material in the pile that stays       carving, carved  lines, and their length [m]
    """

    shape: str
    edge: float
    binding: str
    binding_width: float
    binding_yarn: str
    ends: tuple[float, float]
    flat: float
    piles: tuple[PileOfCarpet, ...]
    fibres: tuple[tuple[str, float], ...]
    carving: Carving | None
    carved: float

    def as_json(self) -> JsonObject:
        """As JSON, SI."""
        piles = [{"height": pile.height, "loop": pile.loop, "knots": pile.knots} for pile in self.piles]
        lines = self.carving and {"length": self.carved, "depth": self.carving.depth, "angle": self.carving.angle}
        return {
            "shape": self.shape,
            "edge": self.edge,
            "binding": self.binding,
            "binding_width": self.binding_width,
            "binding_yarn": self.binding_yarn,
            "kilim_ends": list(self.ends),
            "flat_area": self.flat,
            "piles": piles,
            "pile_fibres": [{"material": material, "share": share} for material, share in self.fibres],
            "carving": lines,
        }


def construction_of(chart: Chart, bill: YarnBill, shape: ShapeParams, plan: YarnPlanParams) -> CarpetConstruction:
    """The construction of a carpet by its chart.

    >>> from ilmek import read_yarns
    >>> from ilmek.carpet.shape import with_ends
    >>> chart = with_ends(Chart.of([[0, 0], [0, 0]], read_yarns()[:1], "2x2cm", "10x10/dm"), 1)
    >>> made = construction_of(chart, chart.bill(), ShapeParams(), YarnPlanParams())
    >>> made.shape, made.ends, made.piles[0].knots
    ('rectangle', (0.01, 0.01), 4)
    """
    cut = bill.edge > 0
    bound = cut and any(need.use in ("binding", "tape") for need in bill.ground)
    upper, lower, flat = 0, 0, 0
    if chart.cells is not None:
        bare = ~chart.cells.tied & ~chart.cells.are(OUTSIDE)
        of_pile = np.flatnonzero(chart.cells.tied.any(axis=1))
        top, low = int(of_pile[0]), int(of_pile[-1]) + 1
        upper, lower = (int(np.count_nonzero(rows.any(axis=1))) for rows in (bare[:top], bare[low:]))
        flat = int(np.count_nonzero(bare[top:low]))
    usual = plan.pile(chart.quality).pile_height
    piles = (
        PileOfCarpet(usual if kind.height is None else kind.height, kind.loop, tied.total)
        for kind, tied in chart.tied_by_kind
    )
    fibres: dict[str, float] = defaultdict(float)
    for need in bill.pile:
        fibres[need.material] += need.kept
    mass = sum(fibres.values())
    return CarpetConstruction(
        RECTANGLE if not cut else shape.shape if shape.named and shape.shape else FREE,
        bill.edge,
        plan.binding if bound else "",
        plan.binding_width if bound else 0.0,
        (plan.binding_yarn or bill.field.name) if bound and plan.binding == OVERCAST else "",
        (lower / chart.quality.along, upper / chart.quality.along),
        flat / chart.quality.knots_per_area,
        tuple(piles),
        tuple(sorted(((material, kept / mass) for material, kept in fibres.items()), key=itemgetter(1), reverse=True)),
        None if chart.cells is None else chart.cells.carving,
        carved_length(chart),
    )
