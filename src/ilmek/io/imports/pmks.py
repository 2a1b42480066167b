"""The share address of PMKS+: a mechanism in the characters after its `?`.

Fields end with a dot, their parts with commas; numbers are thousandths to base 64, with a leading 0 for a minus. The
last character is a check on the length.
"""

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign
from ilmek.io.imports.sketch import Drive, Sketch
from ilmek.linkage.model import GROUND
from ilmek.units import inch, minute, turn

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
"""Digits to base 64; the first 62 are the check characters."""

LENGTHS = {"0": inch, "1": 0.01, "2": 1.0}
"""Unit of length [m] by its digit: inch, cm, m."""

PRISMATIC, INPUT, GROUNDED = 1, 2, 4
"""Flags of a joint."""


def pmks_data(address: str) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for an address that is damaged or of another version."""
    content = address.strip().rpartition("?")[2]
    body, check = content[:-1], content[-1:]
    if len(content) < 2 or check != DIGITS[len(body) % 62]:
        raise MechanismError("is a damaged address of PMKS+: its check character does not fit", do="copy it whole")
    flags, _, settings, units, *rest = [*body.split("."), "", "", "", ""]
    speed = _whole(settings.partition(",")[0]) * turn / minute * (-1 if _whole(flags) & 1 else 1)
    if units[:1] not in LENGTHS:
        raise MechanismError(f"has the unit of length {shortened(units[:1])!r}", allowed="0 inch, 1 cm, 2 m")
    joints, links, forces = (_list(rest) for _ in range(3))
    sketch = Sketch("mechanism")
    kinds = {}
    for entry in joints:
        head, _, x, y, angle = _parts(entry, 5)
        point, kinds[head[1:]] = head[1:], (_whole(head[:1]), _decimal(angle))
        sketch.points[point] = complex(_decimal(x), _decimal(y)) * LENGTHS[units[0]]
        if kinds[point][0] & GROUNDED:
            sketch.bodies[GROUND].append(point)
    pistons = {_link(sketch, entry) for entry in links} - {""}
    for point, (kind, along) in kinds.items():
        if kind & PRISMATIC:
            carriers = sorted(sketch.carriers(point), key=lambda body: (body == GROUND, body not in pistons))
            if len(carriers) != 2:
                raise MechanismError(f"the slide {point} joins {len(carriers)} links", allowed="2")
            sketch.slides[point] = carriers[0], carriers[1], along
        if kind & INPUT:
            sketch.inputs[point] = Drive("", None if kind & PRISMATIC or not speed else {"speed": speed})
    sketch.left_out += ["masses: the address has 1 where none was given"] if links else []
    sketch.left_out += ["forces"] if forces else []
    return sketch.foreign()


def _link(sketch: Sketch, entry: str) -> str:
    """Add a link; its name if it is a piston. Links inside a welded one are skipped."""
    head, name, *rest = _parts(entry, 8)
    points = rest[5:]
    points = points[: points.index("")] if "" in points else points
    if head[:1] != "Y":
        return ""
    body = sketch.body(name or head[2:], points)
    return body if head[1:2] == "P" else ""


def _list(fields: list[str]) -> list[str]:
    """The entries up to the empty one that ends a list, taken from the fields."""
    end = fields.index("") if "" in fields else len(fields)
    entries = fields[:end]
    del fields[: end + 1]
    return entries


def _parts(entry: str, count: int) -> list[str]:
    parts = entry.split(",")
    if len(parts) < count:
        raise MechanismError(f"entry {shortened(entry)!r} of the address has {len(parts)} parts", allowed=f"{count}")
    return parts


def _whole(text: str) -> int:
    whole = 0
    for digit in text:
        if digit not in DIGITS or len(text) > 8:
            raise MechanismError(f"number {shortened(text)!r} of the address", allowed="up to 8 of 0-9 A-Z a-z _ -")
        whole = whole * 64 + DIGITS.index(digit)
    return whole


def _decimal(text: str) -> float:
    return (-1 if text.startswith("0") else 1) * _whole(text) / 1000
