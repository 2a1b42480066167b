"""Yarn bill: the yarn to buy for a chart.

    metres = knots × length per knot,   kilograms = metres × linear density,   linear density = ply / (1000 Nm)

for each colour of the pile, whole, half and jufti knots with their own lengths; the ground needs warp and two wefts.
"""

from dataclasses import dataclass

from ilmek.carpet.chart import Chart
from ilmek.carpet.ground import GroundParams, ground_yarns
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.yarn import Yarn
from ilmek.elements.knot_kinds import FORMS


@dataclass(frozen=True, slots=True)
class YarnNeed:
    """A line of the bill: yarn and use (pile, warp, weft), knots (0 for the ground), length [m], mass [kg], price.

    price  None where no price per kg is known
    """

    name: str
    use: str
    knots: int
    length: float
    mass: float
    price: float | None = None


@dataclass(frozen=True, slots=True)
class YarnBill:
    """The bill: pile yarns in the order of the list (those with knots), then warp and wefts."""

    pile: tuple[YarnNeed, ...]
    ground: tuple[YarnNeed, ...]

    @property
    def needs(self) -> tuple[YarnNeed, ...]:
        """All lines, pile first."""
        return self.pile + self.ground

    @property
    def knots(self) -> int:
        """Number of knots."""
        return sum(need.knots for need in self.pile)

    @property
    def pile_mass(self) -> float:
        """Mass of the pile yarns [kg]."""
        return sum(need.mass for need in self.pile)

    @property
    def mass(self) -> float:
        """Mass of all yarns [kg]."""
        return sum(need.mass for need in self.needs)

    @property
    def price(self) -> float | None:
        """Price of the pile yarns; None unless every one has a price."""
        prices = [need.price for need in self.pile if need.price is not None]
        return sum(prices) if len(prices) == len(self.pile) else None


def pile_need(yarn: Yarn, knots: int, length: float) -> YarnNeed:
    """The line of a pile yarn, for its number of knots and the length of them all [m]."""
    mass = length * yarn.linear_density
    return YarnNeed(yarn.name, "pile", knots, length, mass, None if yarn.price is None else mass * yarn.price)


def yarn_bill(chart: Chart, pile: PileParams | None = None, ground: GroundParams | None = None) -> YarnBill:
    """The yarn bill of a chart.

    pile, ground  parameters; default: those of `PileParams` and `GroundParams`
    """
    tied = chart.tied
    needs = tuple(pile_need(chart.yarns[yarn], tied.of(yarn), pile_length(chart, yarn, pile)) for yarn in chart.used)
    uses = ("warp", "weft", "weft")
    threads = ground_yarns(chart.size, chart.quality, chart.rows, chart.columns, ground)
    return YarnBill(
        needs,
        tuple(YarnNeed(need.name, use, 0, need.length, need.mass) for need, use in zip(threads, uses, strict=True)),
    )


def pile_length(chart: Chart, yarn: int, pile: PileParams | None = None) -> float:
    """Length of a yarn of the list in all knots of a chart [m]: whole, half and jufti knots, each with its length."""
    density = chart.yarns[yarn].linear_density
    numbers = {form: knots for form, knots in zip(FORMS, (of[yarn] for of in chart.tied), strict=True) if knots}
    return sum(
        (knots * knot_length(chart.knot, chart.quality, density, pile, form) for form, knots in numbers.items()), 0.0
    )
