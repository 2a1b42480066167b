"""A printed number, equation or statement, and the verdict of a computation on it.

A claim has the printed text, the function that computes the same, and a note, which is shown only if the computation
disagrees. The verdict is formed on request:

    reproduced        agrees to the last printed digit, by rounding or by truncation; a relation (> 60) holds; a count
                      is the same; an equation as printed leaves no residual
    rounding          off by at most 1.5 units of the last printed digit, or follows from the paper's rounded numbers
    misprint          neither: the computed value is correct; the corrected form of an equation leaves no residual
    off               a reading of a curve or of the running machine misses by more than its last digit
    unsound           the paper's reasoning does not hold, whatever its arithmetic
    not reproducible  nothing can be computed (a curve without numbers, data, a definition), or the printed equation
                      cannot be corrected; the note has the reason

A constant that the paper does not state, and that is chosen so that a number fits, is named in `fitted`. Claims and
verdicts hold numbers in the unit as printed, so that they can be compared with the paper; `as_json` gives them in SI.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.units import parse_unit

REPRODUCED, ROUNDING, MISPRINT, OFF, UNSOUND, NOT_REPRODUCIBLE = VERDICTS = (
    "reproduced",
    "rounding",
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

UNITS_OF_ROUNDING = 1.5
"""Units of the last printed digit that rounding of intermediate results explains."""

Computation: TypeAlias = Callable[[], float | int | None]


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
    follows  the number from the paper's rounded numbers, if they decide
    mended   residual of the equation in its correct form
    fitted   constants that the paper does not state, chosen to make the row fit
    missed   verdict of a disagreement: MISPRINT, OFF of a reading, UNSOUND of the paper's reasoning
    """

    paper: str
    item: str
    printed: str
    unit: str
    compute: Computation
    source: str
    note: str = ""
    follows: Computation | None = None
    mended: Computation | None = None
    fitted: str = ""
    missed: str = MISPRINT

    @property
    def si_factor(self) -> float:
        """The unit as printed, in SI; 1 of counts, residuals and units in which nothing is computed."""
        if self.unit in (COUNT, RESIDUAL):
            return 1.0
        return parse_unit(self.unit.replace(" ", "*")).factor


@dataclass(frozen=True, slots=True)
class Verdict:
    """A computed claim; `difference` is computed minus printed, of an equation its residual."""

    claim: Claim
    computed: float | int | None
    difference: float | None
    verdict: str

    @property
    def note(self) -> str:
        """The claim's note if the computation disagrees, else ""."""
        return "" if self.verdict == REPRODUCED else self.claim.note

    def as_json(self) -> dict[str, object]:
        """Plain data: paper, item, printed (text), computed and difference (SI), unit (of the printed text), ..."""
        claim = self.claim
        factor = 1.0 if self.computed is None else claim.si_factor
        return {
            "paper": claim.paper,
            "item": claim.item,
            "printed": claim.printed,
            "computed": None if self.computed is None else self.computed * factor,
            "unit": claim.unit,
            "difference": None if self.difference is None else self.difference * factor,
            "verdict": self.verdict,
            "fitted": claim.fitted,
            "note": self.note,
            "source": claim.source,
        }


def residual(left: RealField | ComplexField, right: RealField | ComplexField) -> float:
    """Greatest difference of two sides, relative to the larger magnitude; 0 if both vanish, NaN if one is NaN."""
    gap, size = np.max(np.abs(np.subtract(left, right))), np.max(np.maximum(np.abs(left), np.abs(right)))
    return float(gap / size) if size != 0 else 0.0


def judge(claim: Claim) -> Verdict:
    """Compute a claim and its verdict."""
    value = claim.compute()
    if value is None or not math.isfinite(value):
        return Verdict(claim, None, None, UNSOUND if claim.missed == UNSOUND else NOT_REPRODUCIBLE)
    if claim.unit == RESIDUAL:
        return Verdict(claim, value, value, _of_equation(claim, value))
    relation, number = read_printed(claim.printed)
    difference = value - float(number)
    if relation:
        holds = difference > 0 if relation == ">" else difference < 0
        return Verdict(claim, value, difference, REPRODUCED if holds else claim.missed)
    return Verdict(claim, value, difference, _of_number(claim, number, value))


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


def last_digit(number: Decimal) -> float:
    """One unit of the last printed digit.

    >>> last_digit(Decimal("4.073e-5"))
    1e-08
    """
    return float(Decimal(1).scaleb(int(number.as_tuple().exponent)))


def _of_equation(claim: Claim, residual: float) -> str:
    if residual <= NO_RESIDUAL:
        return REPRODUCED
    if claim.missed != MISPRINT:
        return claim.missed
    mended = claim.mended() if claim.mended else None
    return MISPRINT if mended is not None and mended <= NO_RESIDUAL else NOT_REPRODUCIBLE


def _of_number(claim: Claim, number: Decimal, value: float) -> str:
    if claim.unit == COUNT:
        return REPRODUCED if value == number else claim.missed
    if agrees(number, value):
        return REPRODUCED
    if claim.missed != MISPRINT:
        return claim.missed
    if abs(value - float(number)) <= UNITS_OF_ROUNDING * last_digit(number):
        return ROUNDING
    carried = claim.follows() if claim.follows else None
    return ROUNDING if carried is not None and agrees(number, carried) else MISPRINT
