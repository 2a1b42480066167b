"""Texts of verdicts."""

from collections import Counter
from collections.abc import Iterable

from ilmek.verification.claim import COUNT, MISPRINT, RESIDUAL, VERDICTS, read_printed
from ilmek.verification.judgement import Verdict
from ilmek.verification.slips import SLIPS

MORE_DIGITS = 2


def computed_text(verdict: Verdict) -> str:
    """The computed number in the notation of the printed one, with two more digits; of an equation its residual."""
    value, claim = verdict.computed, verdict.claim
    if value is None:
        return "–"
    if claim.unit == RESIDUAL:
        return f"{value:.1e}"
    if claim.unit == COUNT:
        return f"{value:g}"
    exponent = int(read_printed(claim.printed)[1].as_tuple().exponent)
    mantissa, power, ten = claim.printed.partition("e")
    if power:
        return f"{value / float(f'1e{ten}'):.{len(mantissa.partition('.')[2]) + MORE_DIGITS}f}e{ten}"
    return f"{value:.{max(0, -exponent) + MORE_DIGITS}f}"


def printed_text(verdict: Verdict) -> str:
    """The printed number with its unit; "" for an equation, which is part of `item_text`."""
    unit, printed = verdict.claim.unit, verdict.claim.printed
    if unit == RESIDUAL:
        return ""
    if not any(sign.isdigit() for sign in printed):
        return printed
    return f"{printed}°" if unit == "deg" else f"{printed} {'' if unit == COUNT else unit}".strip()


def item_text(verdict: Verdict) -> str:
    """The name of the number, or the equation."""
    claim = verdict.claim
    return f"{claim.item}: {claim.printed}" if claim.unit == RESIDUAL else claim.item


def source_text(verdict: Verdict) -> str:
    """The source, the fitted constants, the roots by name and the note, as far as there are any."""
    claim = verdict.claim
    fitted = f"fitted: {claim.fitted}" if claim.fitted else ""
    if verdict.verdict != MISPRINT:
        return "; ".join(filter(None, (claim.source, fitted, verdict.note)))
    others = [root for root in verdict.roots if root != claim.item]
    root = f"root: {', '.join(others)}" if others else ""
    return "; ".join(filter(None, (claim.source, fitted, root, claim.note)))


ROOT_HEADINGS = ("root", "rows", "what is wrong", "first row")


def root_rows(verdicts: Iterable[Verdict]) -> list[tuple[str, str, str, str]]:
    """A row with `ROOT_HEADINGS` for each slip from which misprints follow, in the order of the pages.

    A misprint stands under the root that changes it most. One that follows from no other row and has no slip in common
    with another is its own root, and its note says what is wrong.
    """
    groups: dict[str, list[Verdict]] = {}
    for verdict in verdicts:
        for root in verdict.roots[:1]:
            groups.setdefault(root, []).append(verdict)
    return [
        (root, str(len(group)), SLIPS.get(root) or group[0].claim.note, item_text(group[0]))
        for root, group in groups.items()
    ]


HEADINGS = ("item", "printed", "computed", "verdict", "source; fitted; note")


def row(verdict: Verdict) -> tuple[str, str, str, str, str]:
    """A row of a table with `HEADINGS`."""
    texts = item_text(verdict), printed_text(verdict), computed_text(verdict)
    return (*texts, verdict.verdict, source_text(verdict))


def summary(verdicts: Iterable[Verdict]) -> str:
    """The number of claims, in total and by verdict, of the roots of the misprints, and of fitted constants.

    >>> summary(())
    '0 claims'
    """
    listed = tuple(verdicts)
    counted = Counter(verdict.verdict for verdict in listed)
    fitted = sum(bool(verdict.claim.fitted) for verdict in listed)
    roots = f" from {len(root_rows(listed))} slips"
    parts = [f"{counted[name]} {name}{roots if name == MISPRINT else ''}" for name in VERDICTS if counted[name]]
    total = f"{counted.total()} claim{'' if counted.total() == 1 else 's'}"
    kinds = f"{total}: {', '.join(parts)}" if parts else total
    return f"{kinds}; {fitted} with fitted constants" if fitted else kinds
