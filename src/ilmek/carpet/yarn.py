"""Pile yarn: name, colour, count and price."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.picture_points import hex_colour
from ilmek.elements.yarns import MATERIALS
from ilmek.errors import YarnError
from ilmek.records import shown_value
from ilmek.units import counted, real_number

MOST_YARNS = 255

COUNTS, PLIES = (0.05, 500.0), (1, 64)
"""Bounds of the metric count of a strand, and of the number of strands."""


LARGEST_LAB = 1000.0
"""Bound of a number of CIELAB; those of visible colours are below 200."""


@dataclass(frozen=True, slots=True)
class Yarn:
    """A yarn of the list.

    srgb          codes 0 to 255, for display       lab    CIELAB, for matching
    metric_count  Nm of a single strand [m/g]; None: left open, to follow from the quality
    ply           number of strands
    price         per kg; None: unknown
    number        in its list, 1 to MOST_YARNS, to which its symbol on every chart belongs; None: of no list
    material      of MATERIALS, as of silk among wool; None: that of the carpet's pile
    Raises YarnError for a colour that is none, a count or a ply that is not above 0, a price below 0, a number out of
    its range, and an unknown material.
    """

    name: str
    srgb: tuple[int, int, int]
    lab: tuple[float, float, float]
    metric_count: float | None = None
    ply: int = 1
    price: float | None = None
    number: int | None = None
    material: str | None = None

    def __post_init__(self) -> None:
        codes = [code for code in _three(self.srgb) if code == round(code) and 0 <= code <= 255]
        lab = [number for number in _three(self.lab) if abs(number) <= LARGEST_LAB]
        count, ply, price = map(real_number, (self.metric_count, self.ply, self.price))
        faults = {
            f"the name {self.name!r}": not isinstance(self.name, str),
            f"srgb {self.srgb!r}: three codes 0 to 255": len(codes) != 3,
            f"lab {self.lab!r}: three numbers L, a, b": len(lab) != 3,
            f"metric_count {self.metric_count!r}: above 0": self.metric_count is not None and not (count and count > 0),
            f"ply {self.ply!r}: a whole number above 0": ply is None or ply < 1 or ply != round(ply),
            f"number {self.number!r}: 1 to {MOST_YARNS}": self.number is not None
            and (type(self.number) is not int or not 1 <= self.number <= MOST_YARNS),
            f"material {self.material!r}: {', '.join(MATERIALS)}": self.material not in (None, *MATERIALS),
            f"price {self.price!r}: 0 or above": self.price is not None and (price is None or price < 0),
        }
        for fault in (fault for fault, holds in faults.items() if holds):
            raise YarnError(f"a yarn with {fault}")
        values = {"srgb": tuple(map(round, codes)), "lab": tuple(lab), "metric_count": count, "price": price}
        for name, value in {**values, "ply": round(ply or 1)}.items():
            object.__setattr__(self, name, value)

    @property
    def linear_density(self) -> float:
        """Mass per length [kg/m] = ply / (1000 Nm).

        A strand of Nm metres per gram weighs 1/Nm g/m = 1/(1000 Nm) kg/m; the shortening by twist is not included.
        Raises YarnError for a yarn whose count is left open.
        """
        if self.metric_count is None:
            raise YarnError(f"the yarn {self.name!r} has no count", do="give its nm, or a quality: `with_counts`")
        return self.ply / (1000.0 * self.metric_count)

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


def _three(values: object) -> list[float]:
    """The numbers of a sequence of three; none of anything else."""
    listed = list(values) if isinstance(values, Iterable) else []
    numbers_of = [number for number in map(real_number, listed) if number is not None]
    return numbers_of if len(listed) == len(numbers_of) == 3 else []


def yarn_list(yarns: object, least: int = 1) -> tuple[Yarn, ...]:
    """Yarns, `least` to MOST_YARNS of them. Raises YarnError for another number, and for what is no yarn."""
    listed = tuple(yarns) if isinstance(yarns, Iterable) else (yarns,)
    for index, yarn in enumerate(listed):
        if not isinstance(yarn, Yarn):
            raise YarnError(f"yarns[{index}] is {shown_value(yarn)}", allowed="a Yarn, as `read_yarns` gives them")
    if not least <= len(listed) <= MOST_YARNS:
        raise YarnError(f"the yarn list has {counted(len(listed), 'yarn')}", allowed=f"{least} to {MOST_YARNS} yarns")
    return listed


def yarn_labs(yarns: Sequence[Yarn]) -> FloatArray:
    """CIELAB of the yarns, (yarns, 3)."""
    return np.array([yarn.lab for yarn in yarns], dtype=float).reshape(-1, 3)
