"""The yarn of a tuft, and the cone that it comes from.

l = 2 (h + t) + k d        two legs through the backing, and the back stitch over the distance d to the next tuft
[geometry; the trade's calculators leave out t, or take k = 0.1 for the stitch in full]
"""

from ilmek.arrays import RealField
from ilmek.records import record


@record
class Cone:
    """A colour of the creel: name, colour as #rrggbb, price of a kilogram [EUR]; None: not known."""

    name: str
    colour: str
    price: float | None

    def price_of(self, mass: float) -> float | None:
        """Price of a mass [kg]; None: not known."""
        return None if self.price is None else self.price * mass


def tuft_yarn(height: RealField, backing: RealField, distance: RealField, back: RealField = 1.0) -> RealField:
    """Length of yarn of a tuft [m]: height of the pile, thickness of the backing, distance of the tufts [m].

    back  yarn on the back, over the distance
    >>> round(float(tuft_yarn(0.010, 0.0005, 0.003)), 6)
    0.024
    """
    return 2 * (height + backing) + back * distance
