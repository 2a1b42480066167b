"""Price of a part of the loom."""

import math
from collections.abc import Mapping

from ilmek.elements.prices import PriceRates
from ilmek.report import Part


def price_of(part: Part, prices: Mapping[str, PriceRates]) -> float:
    """Price of all pieces of a part, in the currency of the table of prices."""
    weighed = 0.0 if math.isnan(part.mass) else part.mass
    return part.number * prices[part.kind].price(weighed, part.length, part.power)
