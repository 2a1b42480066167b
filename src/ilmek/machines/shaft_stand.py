"""The stand of a machine alone whose shafts a loom's frame carries: a column on each side, a bracket for each shaft.

The shafts lie one above the other along z, 0 in the middle of their width. Behind them, at -x, stands a square hollow
column on each side, on a foot along x; members across join both. A bracket is a plate whose edge is welded to the front
of its column, with the bearing on its inner face and the reducer on its outer one. It is as high as the moment of the
shaft's force needs [`bearing_seats.least_height`].
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.machines.bearing_seats import BRACKET, CLEAR, BearingSeat, least_height
from ilmek.part.catalogue import face_of
from ilmek.part.part import LASER_CUT, WELDED, Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle, square_tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, polygon
from ilmek.records import record
from ilmek.units import mm, turn

GAP, EDGE, SAFETY = 20 * mm, 5 * mm, 1.5
"""Room beside the shafts, from a bearing to the edges of its bracket [m], yield over stress of a bracket; assumed."""


@record
class CarriedShaft:
    """A shaft between two bearings.

    name   of the shaft, for people       key   last part of the ids of what carries it
    seat   of its bearings                inner  sides of these from the middle of the width [m]
    beside  room that it takes about its axis, its drive included [m]
    flange  radius about its axis of the room for the screws of its reducer [m]
    """

    name: str
    key: str
    seat: BearingSeat
    inner: float
    beside: float
    flange: float = 0.0

    @property
    def edge(self) -> float:
        """From its axis to the edges of its brackets, at least [m]."""
        return max(self.seat.side / 2 + EDGE, self.flange)

    @property
    def face(self) -> float:
        """Inner face of its brackets from the middle of the width [m]."""
        return self.inner + self.seat.bearing.width


def column_face(shafts: Sequence[CarriedShaft]) -> float:
    """Front of the columns behind the axes of the shafts [m]."""
    return GAP + max(max(shaft.beside, shaft.edge) for shaft in shafts)


def stand_heights(shafts: Sequence[CarriedShaft]) -> tuple[float, ...]:
    """Heights of the axes of shafts one below the other, the first at 0 [m]."""
    behind = column_face(shafts)
    halves = [max(shaft.beside, _height(shaft, behind) / 2) + GAP / 2 for shaft in shafts]
    return tuple((halves[0] - np.cumsum(2 * np.array(halves)) + halves).tolist())


def shaft_stand(name: Callable[[str], str], shafts: Sequence[CarriedShaft]) -> Tree:
    """What carries shafts one below the other, at `stand_heights`; name  makes the ids of its parts."""
    return Tree((RigidBody(name("side-frame"), tuple(_members(name, shafts))),))


def _members(name: Callable[[str], str], shafts: Sequence[CarriedShaft]) -> Iterator[Occurrence]:
    behind, heights = column_face(shafts), stand_heights(shafts)
    inner, outer = min(shaft.face for shaft in shafts), max(shaft.face for shaft in shafts) + BRACKET
    section = next((own for own in ascending() if own.side >= max(outer - inner, 3 * BRACKET)), ascending()[-1])
    half, axis = section.side / 2, -behind - section.side / 2
    low, high = heights[-1] - shafts[-1].beside - GAP, heights[0] + shafts[0].beside
    for shaft, height in zip(shafts, heights, strict=True):
        own, title = _bracket(shaft, behind), f"bracket of the {shaft.name}"
        part = Part(name(f"{shaft.key}-bracket"), title, LASER_CUT, own, STEEL, machined=True)
        yield Occurrence(part, (placement(0.0, height, shaft.face), placement(0.0, height, -shaft.face - BRACKET)))
    upright = placement(about=(1.0, 0.0, 0.0), angle=-turn / 4)
    column = stock(name("side-column"), "column of the stand", section, high - low)
    yield Occurrence(column, tuple(placement(axis, low, z).after(upright) for z in (-inner - half, inner + half)))
    along = placement(about=(0.0, 1.0, 0.0), angle=turn / 4)
    foot, start = stock(name("side-foot"), "foot of the stand", section, 2 * behind + section.side), axis - behind
    yield Occurrence(foot, tuple(placement(start, low - half, z).after(along) for z in (-inner - half, inner + half)))
    across = stock(name("side-member"), "member across the stand", section, 2 * inner)
    yield Occurrence(across, tuple(placement(axis, y, -inner) for y in (low + half, high - half)))


def stock(name: str, title: str, section: HollowSquare, length: float) -> Part:
    """A member of a welded stand: a square tube along z [m]."""
    return Part(name, title, WELDED, square_tube(section.side, section.wall, length), STEEL)


def _height(shaft: CarriedShaft, behind: float) -> float:
    """Height of a bracket [m]."""
    seat = shaft.seat
    moment = seat.force * behind, seat.force * (seat.bearing.width + BRACKET) / 2
    return max(least_height(moment, STEEL.strength / SAFETY), 2 * shaft.edge)


def _bracket(shaft: CarriedShaft, behind: float) -> Prism:
    """The plate about the axis of a shaft, from the column's front."""
    seat, high = shaft.seat, _height(shaft, behind) / 2
    front = shaft.edge
    corners = np.array([-behind - 1j * high, front - 1j * high, front + 1j * high, -behind + 1j * high])
    screws = [circle(complex(corner), seat.screws.screw.diameter / 2) for corner in seat.corners()]
    return Prism(Profile(polygon(corners), (circle(0j, seat.bore / 2), *screws)), BRACKET)


def lantern(name: str, of: str, drive: Part, shaft: float, length: float) -> Part:
    """The block between a plate with the bearing of a shaft and the drive in line with it, from z = 0; of  the shaft.

    drive  with the face that it is screwed to      shaft  its diameter [m]      length  from the plate to the drive [m]
    """
    bore = shaft + 2 * CLEAR
    face = max(face_of(drive), 1.5 * bore)
    shape = Prism(Profile(rectangle(face, face), (circle(0j, bore / 2),)), length)
    return Part(name, f"lantern of the {of}", "steel bar", shape, STEEL, machined=True)
