"""Driven shafts of own mechanisms: their housings in the plate that stands, their lengths and their shapes.

A shaft runs in two bearings in a housing below its link, thin ones in bushes. Its link sits on a key between a spacer
and a ring; where there is no room for both beside a pin, link and shaft are of one piece.
"""

from typing import NamedTuple

from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.linkage.model import GROUND
from ilmek.machines.own_linkage.axes import PinAxis
from ilmek.machines.own_linkage.construction import PLAY, Construction
from ilmek.machines.own_linkage.layers import RingSide
from ilmek.machines.own_linkage.sizes import StudSize, shaft_bearing
from ilmek.part import catalogue
from ilmek.part.placement import placement
from ilmek.part.shapes import Placed, Prism, Shape, stepped
from ilmek.units import mm

HOUSING_SHARE, LEAST_WALL = 0.15, 4 * mm
"""Wall of a bearing housing over the bearing's outer diameter, and at least [m]; assumed by this project."""

APART = 1.5
"""Distance of a shaft's two bearings over its diameter; assumed by this project."""

BUSH_LENGTH, STUB = 1.2, 2.5
"""Length of the bushes of a shaft, and of its end below its housing, over its diameter; assumed by this project."""


class ShaftLengths(NamedTuple):
    """Lengths of a driven shaft [m]: of its stub, from there to its link, in the link, and beyond it for others.

    hub 0  it is of one piece with its link, and ends below it
    """

    stub: float
    plain: float
    hub: float
    beyond: float

    def total(self, stud: StudSize) -> float:
        """Its whole length [m]."""
        return sum(self) + (PLAY + stud.ring.slot + stud.ring.end if self.hub else 0.0)


def shaft_seat(stud: StudSize) -> tuple[float, float, float]:
    """Seat and length of a shaft's bearings or bushes, and outer diameter of their housing [m]."""
    row = shaft_bearing(stud.journal)
    seat, wide = (row.outer, row.width) if row else (stud.outer, BUSH_LENGTH * stud.journal)
    return seat, wide, seat + 2 * max(HOUSING_SHARE * seat, LEAST_WALL)


def shoulder(stud: StudSize) -> float:
    """Height of the shoulder between the seats of a housing [m]: it leaves the shaft free."""
    seat = shaft_seat(stud)[0]
    return (seat - stud.journal) / 4


def housing_length(stud: StudSize) -> float:
    """Length of a housing: both seats, and the distance of its bearings [m]."""
    return 2 * shaft_seat(stud)[1] + APART * stud.journal


def stub_length(stud: StudSize, key: KeyedEnd | None) -> float:
    """Length of a driven shaft below its housing [m]: for a coupling, a pulley or a reducer."""
    return max(STUB * stud.journal, 1.5 * key.length if key is not None else 0.0)


def shaft_lengths(built: Construction, axis: PinAxis) -> ShaftLengths:
    """The lengths of a driven shaft, from the end of its stub below its housing to its highest body."""
    body, stud, low = axis.driven, built.studs[axis.name], built.bottoms[axis.driven]
    stub, plain = stub_length(stud, built.key(axis)), housing_length(stud) + stud.ring.slot + low
    if built.side(axis) is RingSide.NONE:
        return ShaftLengths(stub, plain, 0.0, 0.0)
    highest = max(built.end(axis, one) for one in built.order(axis) if one != GROUND)
    return ShaftLengths(stub, plain, built.thickness(body), highest - low - built.thickness(body))


def key_direction(built: Construction, axis: PinAxis) -> complex:
    """Direction of a driven link's keyway in its frame: away from its next pin, where most material is."""
    own = axis.points[axis.driven]
    others = [one.points[axis.driven] for one in built.axes if axis.driven in one.points and one is not axis]
    nearest = min(others, key=lambda at: abs(at - own), default=own - 1)
    return (own - nearest) / abs(own - nearest)


def shaft_members(stud: StudSize, lengths: ShaftLengths, key: KeyedEnd | None) -> tuple[Placed, ...]:
    """A driven shaft from its stub's end at z = 0; it has a groove below its housing and one above its bodies.

    Its keyways open along x.
    """
    stub, plain, hub, beyond = lengths
    d, ring = stud.journal, stud.ring
    below = (ring.groove, ring.slot), (d, plain - ring.slot)
    above = ((d, beyond + PLAY), *ring.steps) if hub else ()
    if key is None:
        return (Placed(stepped((d, stub), *below, *(((d, hub), *above) if hub else ()))),)
    end = catalogue.keyed_journal(key)
    pieces: list[tuple[Shape, float]] = [(end, 0.0), (stepped((d, stub - key.length), *below), key.length)]
    if hub:
        pieces += [(Prism(end.section, hub), stub + plain), (stepped(*above), stub + plain + hub)]
    return tuple(Placed(piece, (placement(z=z),)) for piece, z in pieces)
