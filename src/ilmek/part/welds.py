"""Where the stock of a frame is welded: fillet welds between parts that touch, move together and share no screw.

A weld belongs to the part whose end meets the other one, and runs all round that end; where no end meets, to both
edges of the other part. Throats: that of the part where strength sets it, else 0.7 of the thinner wall, which is as
strong as the wall [`elements.fillet_welds`].
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.fillet_welds import throat_for
from ilmek.part.contacts import Touch, joined_by, touches
from ilmek.part.making import seams
from ilmek.part.part import Part
from ilmek.part.shapes import Prism, Sum, Turned, shape_box
from ilmek.part.tree import Tree
from ilmek.plane.contours import bounds
from ilmek.records import record
from ilmek.units import mm

WELDED = "welded frame"
"""Process of stock that is welded to others."""

PLATE = "laser-cut part"
_WITH = frozenset({WELDED, PLATE})
"""Processes of the parts that it is welded to."""

_AT_END = 1 * mm
"""Distance from the end of a part within which a contact is one of its end."""


@record
class Weld:
    """A fillet weld of a part.

    other   id of the part that it is welded to; "": its own plates to each other          throat  a [m]
    middle  of the contact, in the part's own axes [m]   all_round  along the whole end of the part; else on both edges
    """

    other: str
    throat: float
    middle: Float[np.ndarray, " 3"]
    all_round: bool


def welded_together(one: Part, other: Part) -> bool:
    """Whether two parts are welded where they touch."""
    processes = {one.process, other.process}
    return WELDED in processes and processes <= _WITH


@lru_cache(maxsize=8)
def welds_of(tree: Tree) -> Mapping[str, tuple[Weld, ...]]:
    """The welds of a tree by the ids of the parts whose sheets have them, like ones once."""
    parts = {part.id: part for part, _ in tree.occurrences()}
    stock = frozenset(name for name, part in parts.items() if part.process == WELDED)
    screws = frozenset(name for name, part in parts.items() if part.process == "fastener")
    screwed = [frozenset(pair) for pair in joined_by(tree, screws).values()] if screws else []
    welds: dict[str, dict[object, Weld]] = defaultdict(dict)
    for part in parts.values():
        if part.process == PLATE and isinstance(part.shape, Sum):
            welds[part.id].update(enumerate(_of_plates(part, part.shape)))
    for touch in touches(tree, frozenset(name for name, part in parts.items() if part.process in _WITH)):
        pair = {touch.part, touch.other}
        if pair & stock and not any(pair <= joined for joined in screwed):
            name, weld = _weld(touch, parts)
            welds[name].setdefault((weld.other, weld.all_round, tuple(np.round(weld.middle, 4))), weld)
    return {name: tuple(own.values()) for name, own in welds.items()}


def _of_plates(part: Part, shape: Sum) -> Iterator[Weld]:
    """The welds of plates that are one part, all round what they share."""
    wall = min(min(_walls(member.shape)) for member in shape.members)
    for low, high in seams(shape):
        yield Weld("", part.throat or throat_for(np.inf, wall), (low + high) / 2, all_round=True)


def _weld(touch: Touch, parts: Mapping[str, Part]) -> tuple[str, Weld]:
    """The weld of a contact with the id of its part: that whose end it is, or the thinner one."""
    sides = [(touch.part, touch.other, touch.middle), (touch.other, touch.part, touch.other_middle)]
    ends = [side for side in sides if _is_end(parts[side[0]], side[2])]
    name, other, middle = (ends or sorted(sides, key=lambda side: wall_of(parts[side[0]])))[0]
    wall = min(wall_of(parts[name]), wall_of(parts[other]))
    strength = parts[name].throat or (0.0 if ends else parts[other].throat)
    throat = strength or throat_for(np.inf, wall)
    return name, Weld(other, throat, middle, bool(ends))


def _is_end(part: Part, middle: Float[np.ndarray, " 3"]) -> bool:
    """Whether a contact is at an end of stock."""
    if part.process != WELDED or part.shape is None:
        return False
    low, high = shape_box(part.shape)
    return bool(min(abs(middle[2] - low[2]), abs(middle[2] - high[2])) < _AT_END)


def wall_of(part: Part) -> float:
    """Wall of a tube or hollow section, or thickness of a plate [m]."""
    return min(_walls(part.shape))


def _walls(shape: object) -> Iterator[float]:
    if isinstance(shape, Prism):
        low, high = bounds(shape.section.outline)
        yield from (shape.length, (high - low).real, (high - low).imag)
        for hole in shape.section.holes[:1]:
            begin, _ = bounds(hole)
            yield from ((begin - low).real, (begin - low).imag)
    elif isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        yield (high - low).imag
    else:
        yield float(np.ptp(np.array(shape_box(shape)), axis=0).min())  # type: ignore[arg-type]
