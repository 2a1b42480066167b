"""Numbers and elements of files of other programs; what each reader returns."""

import math
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError, shortened
from ilmek.records import JsonObject

GREATEST = 1e9
"""Greatest magnitude of a number."""


class Foreign(NamedTuple):
    """The data of a mechanism file, in SI, and what of the other file is not in it."""

    data: JsonObject
    left_out: tuple[str, ...]


def number(value: object, what: str) -> float:
    """A finite number, of JSON or of a text. Raises MechanismError."""
    try:
        found = float(value) if isinstance(value, int | float | str) and not isinstance(value, bool) else math.nan
    except ValueError:
        found = math.nan
    if not abs(found) <= GREATEST:
        raise MechanismError(f"{what} is {shortened(repr(value))}", allowed=f"a number, at most {GREATEST:g}")
    return found


def numbers(element: Element, key: str, default: str) -> FloatArray:
    """The numbers of an attribute, as many as its default has. Raises MechanismError."""
    what = f"{key} of <{shortened(element.tag)}>"
    parts, count = element.get(key, default).split(), len(default.split())
    if len(parts) != count:
        raise MechanismError(f"{what} has {len(parts)} numbers", allowed=f"{count}")
    return np.array([number(part, what) for part in parts])


def name_of(element: Element, key: str = "name") -> str:
    """A name that must be given. Raises MechanismError."""
    name = element.get(key, "")
    if not name:
        raise MechanismError(f"<{shortened(element.tag)}> has no {key}", do="give it one")
    return name
