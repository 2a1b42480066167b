"""Front and back span of the cam shafts: what must have room between the fell, the guide cams and the back rest.

The warps stand on x = 0. A cam shaft stands behind them at -Rp + i a, so that a cam at rest touches the warps; its
guide cams, of radius Rg, reach through the warps between a - c and a + c,

    c(x) = sqrt(Rg² - (Rp + x)²)

Below them, between the warps, stands the comb at rest, its leaves h high, and below the comb the carrier of the weft
runs across the width. The shed is a wedge from the fell to the cams: where it is o wide at the cams, it is o y/a wide
at the height y. A carrier of depth d, with the clearance e to both sheets of warps of diameter D, has room from

    y/a = (d + 2 e + D) / o = r       upwards, so that      a (1 - r) = c + h + w + 2 e

with the carrier's width w along the warps. Above the guide cams stand the back rest, and behind it the tension
compensator and the upper cylinder; all clear the guide cams. The back span is never shorter than the front span: it
would strain the warps more.
[derived from the geometry; clearances and sizes before they are designed are assumed by this project]
"""

import math
from typing import TYPE_CHECKING

from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.records import value_record
from ilmek.units import mm

if TYPE_CHECKING:
    from ilmek.machines.loom_task import LoomTask

BACK_REST = 30 * mm
"""Radius kept for the back rest [m]."""

COMPENSATOR, COMPENSATOR_DEPTH = 0.28, 0.35
"""Room kept for the tension compensator: along the warps, and to either side of them [m]."""

TUBE_SHARE = 0.06
"""Radius of a cylinder over the width of the loom, before it is designed."""

LEAST_TUBE = 70 * mm
"""Radius of the thesis' cylinders [m]: no thinner ones are used."""

HIGHEST_SHARE = 0.8
"""Share of the front span above which no carrier runs: a shed too narrow for it there fails its clearance."""

USUAL_HEAD = 80 * mm
"""Height of a head's tools above the fell before it is designed [m]."""

USUAL_PRIME = 80 * mm
"""Prime radius of the shedding cams before they are designed [m]."""

USUAL_GUIDE = 10 * mm
"""Height of the guide cams above the noses before they are designed [m]."""

LEAF_HEIGHT, LEAF_REACH, BAR = 20 * mm, 80 * mm, 20 * mm
"""Of a comb before it is designed: its leaves along the warps, to the front; its bar [m]."""

SPARE = 1.5
"""Clearance in the arrangement over the least that is allowed."""

LEAF_BEHIND = 5 * mm
"""A comb's leaves behind the warps [m]."""


@value_record
class ShedRoom:
    """What must have room between the fell and the upper cylinder [m].

    carrier_depth, carrier_width  of the weft's carrier, across the shed and along the warps
    opening      of the shed at the cams from which on the carrier moves
    leaf_height  of the comb                              head      height of the head's tools above the fell
    back_rest    its radius                               swing     length of the tension compensator behind it
    half_depth   of the compensator, to either side of the warps
    tube         radius of the upper cylinder             warp      diameter of a warp
    clearance    least distance of what moves
    rear         from the compensator's middle to the cylinder's axis: its beams, and the cylinder or its bearings
    """

    carrier_depth: float
    carrier_width: float
    opening: float
    leaf_height: float
    head: float
    back_rest: float
    swing: float
    half_depth: float
    tube: float
    warp: float
    clearance: float
    rear: float = 0.0

    @property
    def share(self) -> float:
        """Share of the front span, from the fell, at which the shed is wide enough for the carrier."""
        return min((self.carrier_depth + 2 * self.clearance + self.warp) / self.opening, HIGHEST_SHARE)


@value_record
class ShedSpans:
    """Heights over the fell [m], and spans of each cam shaft, the lowest first.

    front   from the fell to each cam shaft       back    from each cam shaft to the back rest
    carrier lower edge of the carrier             comb    lower edge of the comb at rest
    """

    front: tuple[float, ...]
    back: tuple[float, ...]
    carrier: float
    comb: float

    @property
    def back_rest(self) -> float:
        """Height of the back rest over the fell [m]."""
        return self.front[0] + self.back[0]


def shed_room(task: "LoomTask") -> ShedRoom:
    """What must have room in the shed of a loom; parts that are not yet designed have their usual size."""
    params, weft = task.params, task.weft
    spare, made = SPARE * params.clearance, task.compensator
    return ShedRoom(
        carrier_depth=weft.carrier_depth,
        carrier_width=weft.carrier_width,
        opening=params.open_share * params.lift,
        leaf_height=float(task.params.machines.of("hammer").get("leaf_height") or LEAF_HEIGHT),
        head=USUAL_HEAD,
        back_rest=max(made.roller_radius, BACK_REST) if made else BACK_REST,
        swing=max(made.swing, COMPENSATOR) if made else COMPENSATOR,
        half_depth=max(made.half_depth, COMPENSATOR_DEPTH) if made else COMPENSATOR_DEPTH,
        tube=max(TUBE_SHARE * task.width, LEAST_TUBE),
        warp=task.yarns.warp.diameter,
        clearance=spare,
        rear=_rear(task),
    )


def _rear(task: "LoomTask") -> float:
    """From the middle of the compensator to the upper cylinder's axis [m]; 0 before both are designed."""
    if task.compensator is None or task.warp_tension is None:
        return 0.0
    upper = cylinders(task.warp_tension)[0]
    return task.compensator.rear + max(upper.outer, upper.flange, upper.seat.side / 2)


def shed_spans(room: ShedRoom, prime_radius: float, guide_radius: float, shafts: int = 1) -> ShedSpans:
    """Spans of the cam shafts, one above the other, that leave all its room.

    prime_radius, guide_radius  of cams and guide cams [m]      shafts  number of cam shafts

    >>> room = ShedRoom(0.024, 0.036, 0.054, 0.02, 0.05, 0.03, 0.28, 0.35, 0.07, 0.001, 0.003)
    >>> spans = shed_spans(room, 0.078, 0.148)
    >>> round(spans.front[0], 3), round(spans.comb - spans.carrier, 3)
    (0.448, 0.039)
    """
    above = _above_carrier(room, prime_radius, guide_radius)
    first = max(above / (1 - room.share), above + room.head + room.clearance)
    step = 2 * guide_radius + room.clearance
    front = tuple(first + step * number for number in range(shafts))
    back = max(_back_span(room, prime_radius, guide_radius), first)
    return spans_at(room, prime_radius, guide_radius, front, tuple(back + front[-1] - one for one in front))


def expected_spans(room: ShedRoom, lift: float) -> ShedSpans:
    """The spans before the cams are designed, with cams of the usual size for a lift [m]."""
    return shed_spans(room, USUAL_PRIME, USUAL_PRIME + lift + USUAL_GUIDE)


def spans_at(
    room: ShedRoom, prime_radius: float, guide_radius: float, front: tuple[float, ...], back: tuple[float, ...]
) -> ShedSpans:
    """Given spans [m], with carrier and comb as near below the lowest guide cams as their clearances allow.

    Where the spans are too short for that, the carrier runs just above the fell, and their clearances fail.
    """
    carrier = max(front[0] - _above_carrier(room, prime_radius, guide_radius), room.clearance)
    return ShedSpans(front, back, carrier, carrier + room.carrier_width + room.clearance)


def warp_length(room: ShedRoom, spans: ShedSpans) -> float:
    """Length of a warp at rest, from the fell over a quarter of the back rest to the upper cylinder [m]."""
    return spans.back_rest + math.pi / 2 * room.back_rest + cylinder_offset(room)


def _above_carrier(room: ShedRoom, prime_radius: float, guide_radius: float) -> float:
    """From the carrier's lower edge to the axis of the lowest cams [m]: the carrier, the comb, and the guide cams."""
    chord = _chord(guide_radius, prime_radius - LEAF_BEHIND)
    return chord + room.leaf_height + room.carrier_width + 2 * room.clearance


def cylinder_offset(room: ShedRoom) -> float:
    """Distance of the upper cylinder's axis behind that of the back rest [m]."""
    return room.back_rest + max(room.swing + room.tube, room.swing / 2 + room.rear) + room.clearance


def _back_span(room: ShedRoom, prime_radius: float, guide_radius: float) -> float:
    """The least distance of the back rest above the cam shaft [m].

    It, the compensator on the level run behind it and the upper cylinder clear the guide cams.
    """
    roller, axis = room.back_rest, -prime_radius
    rest = _chord(guide_radius + roller + room.clearance, -roller - axis)
    cylinder = _chord(guide_radius + room.tube + room.clearance, -roller - cylinder_offset(room) - axis)
    compensator = guide_radius + room.clearance + room.half_depth
    return max(rest, cylinder - roller + room.tube, compensator - roller)


def _chord(radius: float, offset: float) -> float:
    """Half the chord of a circle at a distance from its centre [m]; 0 outside."""
    return math.sqrt(max(radius**2 - offset**2, 0.0))
