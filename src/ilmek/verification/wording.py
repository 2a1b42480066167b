"""How verdicts are written for people."""

from collections import Counter
from collections.abc import Iterable

from ilmek.verification.claim import COUNT, RESIDUAL, VERDICTS, Verdict, read_printed

MORE_DIGITS = 2


def computed_text(verdict: Verdict) -> str:
    """The computed number, as the printed one is written and with two digits more; of an equation its residual."""
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
    """The printed number with its unit; nothing of an equation, which stands in its `item_text`."""
    unit, printed = verdict.claim.unit, verdict.claim.printed
    if unit == RESIDUAL:
        return ""
    if not any(sign.isdigit() for sign in printed):
        return printed
    return f"{printed}°" if unit == "deg" else f"{printed} {'' if unit == COUNT else unit}".strip()


def item_text(verdict: Verdict) -> str:
    """What the number is, or the equation."""
    said = verdict.claim
    return f"{said.item}: {said.printed}" if said.unit == RESIDUAL else said.item


def source_text(verdict: Verdict) -> str:
    """Where it is printed, and what there is to explain."""
    return f"{verdict.claim.source}; {verdict.note}" if verdict.note else verdict.claim.source


HEADINGS = ("item", "printed", "computed", "verdict", "source; note")


def row(verdict: Verdict) -> tuple[str, str, str, str, str]:
    """A line of a table under `HEADINGS`."""
    texts = item_text(verdict), printed_text(verdict), computed_text(verdict)
    return (*texts, verdict.verdict, source_text(verdict))


def summary(verdicts: Iterable[Verdict]) -> str:
    """How many claims there are, and how many of each verdict.

    >>> summary(())
    '0 claims'
    """
    counted = Counter(verdict.verdict for verdict in verdicts)
    parts = [f"{counted[name]} {name}" for name in VERDICTS if counted[name]]
    total = f"{counted.total()} claim{'' if counted.total() == 1 else 's'}"
    return f"{total}: {', '.join(parts)}" if parts else total
