"""What the papers of an order say: the offer, and each of its carpets with its pictures, costs and price."""

from decimal import Decimal

from PIL import Image

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.construction import CarpetConstruction
from ilmek.carpet.price_rules import PriceRules, QuotedPrice
from ilmek.carpet.strike_off import SampleWindow
from ilmek.records import record
from ilmek.sentences import Sentence


@record
class ShownCarpet:
    """Pictures of a carpet.

    whole   upright on white, with its fringes       room    on a floor
    detail  a part at true size, and its width and length [m]        sample  where the strike-off is cut
    pile    left, top, width and height of the pile in `whole`, as shares
    """

    whole: Image.Image
    pile: tuple[float, float, float, float]
    room: Image.Image
    detail: Image.Image
    detail_size: tuple[float, float]
    sample: SampleWindow


@record
class OfferedCarpet:
    """A carpet of an order: one design in a size and a colourway.

    design    that it is of, and its size: what stands side by side is of one of both
    costs     its cost by cause, of one carpet; together the price's cost
    delivery  day on which the last one is finished, ISO; "": no loom weaves it
    """

    name: str
    design: str
    chart: Chart
    bill: YarnBill
    made: CarpetConstruction
    costs: tuple[tuple[Sentence, Decimal], ...]
    price: QuotedPrice
    delivery: str
    shown: ShownCarpet


@record
class Offer:
    """An offer of carpets; date, until: days, ISO."""

    reference: str
    date: str
    until: str
    currency: str
    rules: PriceRules
    carpets: tuple[OfferedCarpet, ...]

    @property
    def net(self) -> Decimal:
        """Of all carpets, without tax."""
        return sum((carpet.price.net for carpet in self.carpets), Decimal(0))

    @property
    def tax(self) -> Decimal:
        """Of all carpets."""
        return self.rules.taxed(self.net)

    @property
    def designs(self) -> list[list[OfferedCarpet]]:
        """The carpets that differ by their colourway alone."""
        groups: dict[tuple[str, str], list[OfferedCarpet]] = {}
        for carpet in self.carpets:
            groups.setdefault((carpet.design, str(carpet.chart.size)), []).append(carpet)
        return list(groups.values())
