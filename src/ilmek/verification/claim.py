"""A printed number, equation or statement of a paper, and its computation.

A claim has the printed text, the function that computes the same, the step by which the paper gets the number from
numbers that it printed before, and a note, which is shown only if the computation disagrees. Numbers are in the unit
as printed, so that they can be compared with the paper. `ilmek.verification.judgement` forms the verdict.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.units import parse_unit

REPRODUCED, ROUNDING, ROUNDED_INPUT, MISPRINT, OFF, UNSOUND, NOT_REPRODUCIBLE = VERDICTS = (
    "reproduced",
    "rounding",
    "rounded input",
    "misprint",
    "off",
    "unsound",
    "not reproducible",
)

COUNT = "count"
"""Unit of a count, which must agree exactly."""

RESIDUAL = "residual"
"""Unit of an equation: the size of left side minus right side, relative to the larger."""

NO_RESIDUAL = 1e-9
"""Largest residual of a correct equation."""

Computation: TypeAlias = Callable[[], float | int | None]

Step: TypeAlias = Callable[[Mapping[str, float]], float]
"""A number from other printed numbers of the paper by their items, all in their printed units."""


@dataclass(frozen=True, slots=True)
class Claim:
    """A printed number, equation or statement, and its computation.

    paper    a key of PAPERS
    item     name of the number
    printed  the number as printed, with its digits; or an equation
    unit     of printed and computed; COUNT, RESIDUAL of an equation, "" of a pure number
    compute  the number, or the equation's residual; None if it cannot be computed
    source   section, equation, table
    note     reason of a disagreement, with the correct form of an equation
    follows  the paper's step to the number from numbers that it printed before, with its slips
    slips    keys of SLIPS: what is wrong in this step, or in the equation
    right    the same step without its slips
    mended   residual of the equation in its correct form
    fitted   constants that the paper does not state, chosen to make the row fit
    missed   verdict of a disagreement: MISPRINT, OFF of a reading, UNSOUND of the paper's reasoning
    repeated whether the number was judged before; as written again it is a part of other steps, and no row
    """

    paper: str
    item: str
    printed: str
    unit: str
    compute: Computation
    source: str
    note: str = ""
    follows: Step | None = None
    slips: tuple[str, ...] = ()
    right: Step | None = None
    mended: Computation | None = None
    fitted: str = ""
    missed: str = MISPRINT
    repeated: bool = False

    @property
    def si_factor(self) -> float:
        """The unit as printed, in SI; 1 of counts, residuals and units in which nothing is computed."""
        if self.unit in (COUNT, RESIDUAL):
            return 1.0
        return parse_unit(self.unit.replace(" ", "*")).factor


def equation(  # noqa: PLR0917 - a paper's own rows name them by position
    paper: str,
    section: str,
    item: str,
    printed: str,
    compute: Computation,
    note: str = "",
    mended: Computation | None = None,
    *,
    slips: tuple[str, ...] = (),
) -> Claim:
    """An equation of a paper by its residual; the section of a numbered one is followed by its number.

    section  its name, or its number, after which `{}` stands for the item: `2.1.3, Eq {}`
    """
    name = f"Eq {item}" if "{}" in section else item
    return Claim(paper, name, printed, RESIDUAL, compute, section.format(item), note, mended=mended, slips=slips)


def residual(left: RealField | ComplexField, right: RealField | ComplexField) -> float:
    """Greatest difference of two sides, relative to the larger magnitude; 0 if both vanish, NaN if one is NaN."""
    gap, size = np.max(np.abs(np.subtract(left, right))), np.max(np.maximum(np.abs(left), np.abs(right)))
    return float(gap / size) if size != 0 else 0.0


def read_printed(text: str) -> tuple[str, Decimal]:
    """The relation (">", "<" or "") and the number of a printed text, its digits kept.

    >>> read_printed("> 60"), read_printed("0.2340")
    (('>', Decimal('60')), ('', Decimal('0.2340')))
    """
    matched = re.fullmatch(r"\s*([<>]?)\s*([+-]?\d[\d.]*(?:e[+-]?\d+)?)\s*", text)
    if matched is None:
        raise ValueError(f"no number: {text!r}")
    return matched[1], Decimal(matched[2])


def agrees(number: Decimal, value: float) -> bool:
    """Whether a value rounds or truncates to the printed number.

    >>> agrees(Decimal("7.38"), 7.3870), agrees(Decimal("7.39"), 7.3870), agrees(Decimal("7.37"), 7.3870)
    (True, True, False)
    """
    unit, shown = last_digit(number), float(number)
    if abs(value - shown) <= unit * (0.5 + 1e-6):
        return True
    return 0 <= abs(value) - abs(shown) < unit and (shown == 0 or value * shown > 0)


def near(number: Decimal, value: float) -> bool:
    """Whether a value rounds or truncates to the printed number, or to its neighbour.

    >>> near(Decimal("0.2340"), 0.23393), near(Decimal("0.2340"), 0.23388)
    (True, False)
    """
    return agrees(number, value) or abs(value - float(number)) <= last_digit(number) * (1 + 1e-6)


def last_digit(number: Decimal) -> float:
    """One unit of the last printed digit.

    >>> last_digit(Decimal("4.073e-5"))
    1e-08
    """
    return float(Decimal(1).scaleb(int(number.as_tuple().exponent)))
