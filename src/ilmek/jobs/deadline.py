"""A deadline given as text."""

import re

from ilmek.errors import ParameterError, UnitError
from ilmek.units import format_quantity, parse_quantity


def read_deadline(text: str) -> float:
    """A deadline [s], like 72h. Raises UnitError without a unit, ParameterError for one that is not above 0."""
    if re.fullmatch(r"\s*[\d.]+\s*", text):
        raise UnitError(f"deadline {text!r} has no unit", allowed="h, min or d", do=f"did you mean {text.strip()}h?")
    seconds = parse_quantity(text, "h")
    if seconds <= 0:
        raise ParameterError(f"a deadline of {format_quantity(seconds, 'h')}", allowed="above 0 h", do="like 72h")
    return seconds
