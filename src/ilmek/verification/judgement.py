"""The verdict on a claim, formed when it is computed.

reproduced        agrees to the last printed digit, by rounding or by truncation; a relation (> 60) holds; a count
is the same; an equation as printed leaves no residual
rounding          off by at most one unit of the last printed digit
rounded input     off by more: it follows by the paper's own step from numbers that the paper rounded before; the
rounding of these explains it
misprint          the computed value is correct: the row has a slip, or follows from one (its roots); the corrected
form of an equation leaves no residual
off               a reading of a curve or of the running machine misses by more than its last digit
unsound           the paper's reasoning does not hold, whatever its arithmetic
not reproducible  nothing can be computed (a curve without numbers, data, a definition), or the printed equation
cannot be corrected; the note has the reason
"""

import math
from dataclasses import dataclass, replace
from decimal import Decimal

from ilmek.report.json import plain
from ilmek.units import si_unit
from ilmek.verification.claim import (
    COUNT,
    MISPRINT,
    NO_RESIDUAL,
    NOT_REPRODUCIBLE,
    REPRODUCED,
    RESIDUAL,
    ROUNDED_INPUT,
    ROUNDING,
    UNSOUND,
    Claim,
    agrees,
    near,
    read_printed,
)
from ilmek.verification.slips import SLIPS
from ilmek.verification.worksheet import RowOrigin, Worksheet

KINDS = {COUNT: "count", RESIDUAL: "equation"}
"""What a row is, by its unit; else a number."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """A computed claim; `difference` is computed minus printed, of an equation its residual.

    roots    of a misprint: keys of SLIPS, or items whose own step is wrong; the one that changes most first
    origins  the printed numbers from which a rounded input or a misprint comes, the largest part first
    """

    claim: Claim
    computed: float | int | None
    difference: float | None
    verdict: str
    roots: tuple[str, ...] = ()
    origins: tuple[RowOrigin, ...] = ()

    @property
    def note(self) -> str:
        """What the row follows from, and the claim's note, if the computation disagrees; else ""."""
        if self.verdict == REPRODUCED:
            return ""
        return "; ".join(filter(None, (*self.reasons[:1], self.claim.note)))

    @property
    def reasons(self) -> tuple[str, ...]:
        """What the row follows from, in words, the largest part first: roots of a misprint, else rounded numbers."""
        if self.verdict == ROUNDED_INPUT:
            return tuple(map(rounding_text, self.origins))
        return tuple(root_text(root) for root in self.roots if root != self.claim.item)

    def as_json(self) -> dict[str, object]:
        """Plain data: computed and difference in SI with their unit, the printed text with its own, verdict, roots."""
        claim = self.claim
        factor = 1.0 if self.computed is None else claim.si_factor
        return {
            "paper": claim.paper,
            "item": claim.item,
            "kind": KINDS.get(claim.unit, "number"),
            "printed": claim.printed,
            "printed_unit": "" if claim.unit in KINDS else claim.unit,
            "computed": None if self.computed is None else self.computed * factor,
            "difference": None if self.difference is None else self.difference * factor,
            "unit": "" if claim.unit in KINDS or self.computed is None else si_unit(claim.unit.replace(" ", "*")),
            "verdict": self.verdict,
            "roots": list(self.roots),
            "origins": [self._origin(origin) for origin in self.origins],
            "fitted": claim.fitted,
            "note": self.note,
            "source": claim.source,
        }

    def _origin(self, origin: RowOrigin) -> dict[str, object]:
        """An origin as plain data, in SI."""
        factor = self.claim.si_factor
        return {
            "name": origin.name,
            "printed": origin.printed,
            "change": origin.change * factor,
            "sensitivity": plain(origin.sensitivity * factor / origin.si_factor),
            "bound": origin.bound * factor,
        }


def rounding_text(origin: RowOrigin) -> str:
    """A rounded number, the sensitivity to it and what its rounding explains, in the units as printed.

    >>> rounding_text(RowOrigin("θs", "125", 0.563, 9.04, 4.52))
    'from the rounded θs 125: sensitivity 9.04, its rounding explains up to 4.52'
    """
    return (
        f"from the rounded {origin.name} {origin.printed}: sensitivity {origin.sensitivity:.3g}, "
        f"its rounding explains up to {origin.bound:.3g}"
    )


def root_text(root: str) -> str:
    """A root of a misprint, with what is wrong there where it has a text of its own."""
    return f"root: {root}" if root not in SLIPS else f"root: {root} ({SLIPS[root]})"


def judge(claim: Claim, sheet: Worksheet | None = None) -> Verdict:
    """Compute a claim and its verdict; `sheet` has the other numbers of its paper."""
    value = claim.compute()
    if value is None or not math.isfinite(value):
        return Verdict(claim, None, None, UNSOUND if claim.missed == UNSOUND else NOT_REPRODUCIBLE)
    sheet = sheet or Worksheet((claim,))
    if claim.unit == RESIDUAL:
        verdict = _of_equation(claim, value)
        return Verdict(claim, value, value, verdict, sheet.slips(claim.item) if verdict == MISPRINT else ())
    relation, number = read_printed(claim.printed)
    difference = value - float(number)
    if relation:
        holds = difference > 0 if relation == ">" else difference < 0
        return Verdict(claim, value, difference, REPRODUCED if holds else claim.missed)
    return _of_number(Verdict(claim, value, difference, REPRODUCED), number, sheet)


def _of_equation(claim: Claim, residual: float) -> str:
    if residual <= NO_RESIDUAL:
        return REPRODUCED
    if claim.missed != MISPRINT:
        return claim.missed
    mended = claim.mended() if claim.mended else None
    return MISPRINT if mended is not None and mended <= NO_RESIDUAL else NOT_REPRODUCIBLE


def _of_number(computed: Verdict, number: Decimal, sheet: Worksheet) -> Verdict:
    claim, value = computed.claim, computed.computed or 0
    is_count = claim.unit == COUNT
    if value == number if is_count else agrees(number, value):
        return computed
    if claim.missed != MISPRINT:
        return replace(computed, verdict=claim.missed)
    if not is_count and near(number, value):
        return replace(computed, verdict=ROUNDING)
    origins = sheet.origins(claim.item)
    roots = tuple(origin.name for origin in origins if not origin.printed)
    if not roots and origins:
        return replace(computed, verdict=ROUNDED_INPUT, origins=origins)
    return replace(computed, verdict=MISPRINT, roots=roots or (claim.item,), origins=origins)
