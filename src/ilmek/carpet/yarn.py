"""Pile yarn: name, colour, count and price; and the reading of a yarn list, already parsed into records.

A record has the fields `name`, `srgb` ("#8b1a1a") or `lab` ([L, a, b]), `nm` (metric count of the single strand, metres
per gram), `ply` (strands twisted together, 1 if not said) and `price` (per kg, in any currency; may be missing).
"""

import difflib
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.errors import YarnError

FIELDS = ("name", "srgb", "lab", "nm", "ply", "price")
MOST_YARNS = 255


@dataclass(frozen=True, slots=True)
class Yarn:
    """A yarn of the list.

    srgb  codes 0 to 255 to show it by          lab  its CIELAB, by which it is matched
    metric_count  Nm, m/g of the single strand  ply  strands             price  per kg, or None
    """

    name: str
    srgb: tuple[int, int, int]
    lab: tuple[float, float, float]
    metric_count: float
    ply: int = 1
    price: float | None = None

    @property
    def linear_density(self) -> float:
        """Mass per length [kg/m] = ply / (1000 Nm).

        A strand of Nm metres per gram weighs 1/Nm g/m = 1/(1000 Nm) kg/m; the shortening by twist is not counted.
        """
        return self.ply / (1000.0 * self.metric_count)

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return "#{:02x}{:02x}{:02x}".format(*self.srgb)


def yarn_labs(yarns: Sequence[Yarn]) -> FloatArray:
    """CIELAB of the yarns, one a row."""
    return np.array([yarn.lab for yarn in yarns], dtype=float).reshape(-1, 3)


def yarns_from_records(records: Sequence[Mapping[str, object]]) -> tuple[Yarn, ...]:
    """The yarns of a list, checked. Raises YarnError, naming the yarn and the field."""
    if not 2 <= len(records) <= MOST_YARNS:
        count = "no yarn" if not records else "one yarn only" if len(records) == 1 else f"{len(records)} yarns"
        raise YarnError(
            f"the yarn list has {count}", allowed=f"2 to {MOST_YARNS} yarns", do="a design needs two colours"
        )
    yarns = tuple(_yarn(record, place) for place, record in enumerate(records, start=1))
    seen: dict[str, int] = {}
    for place, yarn in enumerate(yarns, start=1):
        first = seen.setdefault(yarn.name.casefold(), place)
        if first != place:
            raise YarnError(
                f"yarns {first} and {place} are both named {yarn.name!r}", do="give each yarn a name of its own"
            )
    return yarns


def _yarn(record: Mapping[str, object], place: int) -> Yarn:
    """The yarn of one record; `place` counts from 1."""
    name = str(record.get("name") or "").strip()
    called = f"yarn {place} ({name})" if name else f"yarn {place}"
    for field in record:
        if field not in FIELDS:
            near = difflib.get_close_matches(str(field), FIELDS, n=1)
            hint = f"did you mean {near[0]}?" if near else ""
            raise YarnError(
                f"{called} has the unknown field {field!r}", allowed=f"fields: {', '.join(FIELDS)}", do=hint
            )
    if not name:
        raise YarnError(f"{called} has no name", do='give it one, like name = "madder red"')
    if not name.isprintable():
        raise YarnError(f"yarn {place} has the name {name!r}", allowed="letters, digits and signs on one line")
    srgb, lab = _colour(record, called)
    count = _number(record, "nm", called)
    if count is None:
        raise YarnError(f"{called} has no nm", allowed="the metric count, m/g of one strand", do="like nm = 2.5")
    ply = _number(record, "ply", called)
    if ply is not None and ply != round(ply):
        raise YarnError(f"{called}: ply {ply:g} is not a whole number", allowed="strands twisted together: 1 to 64")
    return Yarn(name, srgb, lab, count, 1 if ply is None else round(ply), _number(record, "price", called))


_BOUNDS = {"nm": (0.05, 500.0), "ply": (1.0, 64.0), "price": (0.0, 1e6)}


def _number(record: Mapping[str, object], field: str, called: str) -> float | None:
    """A number of the record within its bounds; None where it is missing or empty."""
    given = record.get(field)
    if given is None or (isinstance(given, str) and not given.strip()):
        return None
    low, high = _BOUNDS[field]
    value = _as_float(given)
    if value is None or not low <= value <= high:
        raise YarnError(f"{called}: {field} {given!r} cannot be used", allowed=f"a number, {low:g} to {high:g}")
    return value


def _as_float(given: object) -> float | None:
    """The finite number of a number or a text, else None."""
    if isinstance(given, bool) or not isinstance(given, int | float | str):
        return None
    try:
        value = float(given)
    except (ValueError, OverflowError):
        return None
    return value if math.isfinite(value) else None


_Srgb = tuple[int, int, int]
_Lab = tuple[float, float, float]


def _colour(record: Mapping[str, object], called: str) -> tuple[_Srgb, _Lab]:
    """The colour of a record as sRGB codes and as CIELAB, whichever of the two it gives."""
    coded, measured = record.get("srgb") or None, record.get("lab") or None
    if (coded is None) == (measured is None):
        said = "no colour" if coded is None else "both srgb and lab"
        raise YarnError(f"{called} has {said}", allowed="one of srgb and lab", do='like srgb = "#8b1a1a"')
    if coded is not None:
        srgb = _srgb(coded, called)
        lightness, a, b = srgb_to_lab(np.array(srgb, dtype=np.uint8)).tolist()
        return srgb, (lightness, a, b)
    lab = _lab(measured, called)
    red, green, blue = lab_to_srgb(np.array(lab)).tolist()
    return (red, green, blue), lab


def _srgb(given: object, called: str) -> _Srgb:
    """`#8b1a1a`, also without its #, or short, `#811`: each digit twice."""
    written = re.sub(r"^#(.)(.)(.)$", r"#\1\1\2\2\3\3", str(given).strip())
    matched = re.fullmatch(r"#?([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})", written)
    if matched is None:
        raise YarnError(f"{called}: srgb {given!r} is no colour", allowed="six hexadecimal digits", do='like "#8b1a1a"')
    return int(matched[1], 16), int(matched[2], 16), int(matched[3], 16)


def _lab(given: object, called: str) -> _Lab:
    parts = re.split(r"[\s,;]+", given.strip(" ()[]")) if isinstance(given, str) else given
    read = [_as_float(part) for part in parts] if isinstance(parts, list | tuple) else []
    numbers = [number for number in read if number is not None]
    if len(read) == len(numbers) == 3:
        lightness, a, b = numbers
        if 0 <= lightness <= 100 and max(abs(a), abs(b)) <= 160:
            return lightness, a, b
    raise YarnError(
        f"{called}: lab {given!r} is no colour", allowed="L 0 to 100, a and b -160 to 160", do="like lab = [35, 50, 30]"
    )
