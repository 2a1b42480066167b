"""The station of the weavers of a loom without heads: bench, buttons that they hold while the loom moves, their reach.

They sit beside each other, their elbows at the height of the fell, and lean forward to tie. The loom moves only while
each of them holds both of her buttons, on either side of her on the bench: these are as far from all that moves as a
hand comes while it still moves [ISO 13851, ISO 13855]. What is before the trunk of a weaver keeps the bench back.

    shoulder   z = hip - h sin(lean),  y = seat + h cos(lean);       reach  sqrt(z² + y²) to the fell   [plane geometry]

The two beams of the bench are simply supported, each with half of the weavers, spread over it. Sizes of bodies are
assumed by this project, for small women where they limit the reach. Not there: anything that keeps a head out of the
path of the beat while its weaver holds her buttons; a stop that hands at the fell themselves cause.

Axes of the scene: x to the right, y up from the fell, z to the front [m].
"""

import math
from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL, HollowSquare, ascending
from ilmek.elements.field_devices import BUTTON, STOP
from ilmek.elements.materials import GRAVITY
from ilmek.elements.safety_distances import approach
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import UPWARDS, device, placed
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.equipment.surroundings import Hazard, surroundings
from ilmek.machines.automated_loom.frame import member, part_id
from ilmek.machines.weft.materials import BEECH
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.records import computed, record
from ilmek.report import Check, at_least, at_most
from ilmek.units import deg, mm

ELBOW, SHOULDER, ARM = 0.22, 0.52, 0.62
"""Elbow and shoulder of a weaver over her seat, and from the shoulder to the fingers that tie [m]."""

HIP, TRUNK = 0.22, 0.12
"""From the front of the seat to the hip's axis, and from there to the front of the trunk [m]."""

LEAN = 20 * deg
"""Inclination of the trunk of a weaver who ties, at most: ISO 11226."""

LEAST_SEAT, FREE_FEET = 0.25, 0.45
"""Lowest seat over the floor, and highest without a foot board [m]."""

WEIGHT = 100.0
"""Of a weaver [kg]."""

BOARD = (0.36, 30 * mm)
"""Depth and thickness of the bench's board [m]."""

ASIDE = 0.25
"""Buttons of a weaver, from her middle [m]."""

_SECTION, _GAP = HollowSquare(40 * mm, 3 * mm), 30 * mm
_SAG = 1 / 300

BENCH = part_id("bench")


@record
class WeaversStation:
    """Where weavers sit: front of the seat [m], its height over the floor, that of the floor, ends of the bench [m].

    middles   of the weavers along the row [m]       hazard  that decides on the distance of their buttons
    distance  that these need from it [m]            section, sag  of the bench's beams, and their deflection [m]
    """

    front: float
    seat: float
    floor: float
    half: float
    middles: tuple[float, ...]
    hazard: Hazard
    distance: float
    section: HollowSquare
    sag: float

    seat_height = computed("mm", "bench of the weavers over the floor", lambda it: it.seat)

    @computed("mm", "from the shoulder of a weaver who leans forward to the fell", name="weaver_reach")
    def reach(self) -> float:
        forward = self.front + HIP - SHOULDER * math.sin(LEAN)
        return math.hypot(forward, self.floor + self.seat + SHOULDER * math.cos(LEAN))

    @property
    def rear(self) -> float:
        """Rear of the bench, z [m]."""
        return self.front + BOARD[0]

    @property
    def buttons(self) -> float:
        """Middles of the buttons, z [m]."""
        return self.rear - BUTTON.size[0] / 2


@lru_cache(maxsize=4)
def station_of(loom: LoomDesign) -> WeaversStation:
    """The station of a loom: as near to the warps as its buttons and what stands before the weavers allow."""
    near, floor = surroundings(loom), loom.side.floor
    seat, cloth = max(loom.side.fell_height - ELBOW, LEAST_SEAT), loom.task.cloth.width
    stops = stopping_time(loom)
    hazard = max(near.hazards, key=lambda one: float(one.high[2]) + approach(stops.of(one.body)))
    distance = approach(stops.of(hazard.body))
    feet = near.of(part_id("front-foot"))
    half = float(feet[-1].high[0]) + _SECTION.side
    top = floor + seat

    def before(low: float, high: float, aside: float) -> float:
        """The foremost z of what is between two heights, up to a distance from the middle [m]."""
        inside = (
            float(one.high[2])
            for one in near.extents
            if one.low[1] < high and one.high[1] > low and one.low[0] < aside and one.high[0] > -aside
        )
        return max(inside, default=0.0)

    front = max(
        before(top - _SECTION.side - BOARD[1], top, half) + _GAP,
        before(top, top + SHOULDER, cloth / 2) + _GAP + TRUNK - HIP,
        float(hazard.high[2]) + distance + BUTTON.size[0] / 2 - BOARD[0],
    )
    number = loom.weavers
    load = number * WEIGHT * GRAVITY / (2 * 2 * half)
    offered = [(one, _sag(one, load, 2 * half)) for one in ascending() if one.side >= _SECTION.side]
    section, sag = next((own for own in offered if own[1] <= _SAG * 2 * half), offered[-1])
    middles = tuple(((k + 0.5) / number - 0.5) * cloth for k in range(number))
    return WeaversStation(front, seat, floor, half, middles, hazard, distance, section, sag)


def _sag(section: HollowSquare, load: float, span: float) -> float:
    every = load + section.line_mass * GRAVITY
    return float(uniform.deflection_max(every, span, STEEL.modulus, section.inertia))


def station_tree(loom: LoomDesign) -> Tree:
    """The bench, fixed to the front feet, with its buttons."""
    station = station_of(loom)
    return Tree((RigidBody(BENCH, (*_stand(loom, station), *_seat(loom, station), *_on_board(station))),))


def _stand(loom: LoomDesign, station: WeaversStation) -> Iterator[Occurrence]:
    """Rails beside the front feet, with feet at their rear ends, and legs."""
    foot, side, floor = surroundings(loom).of(part_id("front-foot"))[-1], _SECTION.side, station.floor
    begin = min(float(foot.high[2]) - 4 * side, station.front)
    y, x = float(foot.low[1] + foot.high[1]) / 2, station.half - side / 2
    rail = member("bench-rail", "rail of the bench at a front foot", _SECTION, station.rear - begin)
    yield Occurrence(rail, (placement(-x, y, begin), placement(x, y, begin)))
    ends = (station.front + side / 2, station.rear - side / 2)
    under = member("bench-foot", "foot of the bench", _SECTION, y - side / 2 - floor)
    yield Occurrence(under, tuple(placement(own, floor, ends[1]).after(UPRIGHT) for own in (-x, x)))
    low, high = y + side / 2, floor + station.seat - BOARD[1] - station.section.side
    leg = member("bench-leg", "leg of the bench", _SECTION, high - low)
    yield Occurrence(leg, tuple(placement(own, low, z).after(UPRIGHT) for own in (-x, x) for z in ends))


def _seat(loom: LoomDesign, station: WeaversStation) -> Iterator[Occurrence]:
    """Beams along the width, the board on them, and a foot board under a high seat."""
    half, section, (deep, thick) = station.half, station.section, BOARD
    under = station.floor + station.seat - thick
    beam = member("bench-beam", "beam of the bench", section, 2 * half)
    ends = (station.front + section.side / 2, station.rear - section.side / 2)
    y = under - section.side / 2
    yield Occurrence(beam, tuple(placement(-half, y, z).after(ALONG_WIDTH) for z in ends))
    board = Part(part_id("bench-board"), "board of the bench", "machined link", "", box(2 * half, thick, deep), BEECH)
    yield Occurrence(board, (placement(0.0, under + thick / 2, station.front),))
    if station.seat > FREE_FEET:
        side = _SECTION.side
        rail = member("foot-board", "foot board of the bench", _SECTION, 2 * half - 2 * side)
        over = float(surroundings(loom).of(part_id("front-foot"))[-1].high[1]) + side / 2
        at = max(station.floor + station.seat - FREE_FEET, over)
        yield Occurrence(rail, (placement(side - half, at, station.front + side / 2).after(ALONG_WIDTH),))


def _on_board(station: WeaversStation) -> Iterator[Occurrence]:
    """Two buttons for each weaver, and an emergency stop at both ends of the bench."""
    top, z = station.floor + station.seat, station.buttons
    button = device(signals.HANDS, "button that a weaver holds", BUTTON)
    xs = (middle + side * ASIDE for middle in station.middles for side in (-1, 1))
    yield Occurrence(button, tuple(placed(x, top, z, UPWARDS) for x in xs))
    stop = device(part_id("bench-stop"), "emergency stop of the weavers", STOP)
    aside = station.half - STOP.size[0] / 2
    yield Occurrence(stop, tuple(placed(x, top, z, UPWARDS) for x in (-aside, aside)))


def station_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """Reach of the weavers, the distance of their buttons, and the beams of the bench."""
    station, nearer = station_of(loom), "set beat=comb, or a shorter shed_stop"
    until = f"ISO 13855, 1.6 m/s: until the {stopping_time(loom).axis_of(station.hazard.body)} stands; shrouded"
    return (
        at_most("weavers: reach to the fell", station.reach, ARM, "mm", "assumed by this project").with_cure(
            nearer, part_id("bench-board")
        ),
        at_least(
            "guards: distance of the buttons that weavers hold",
            station.buttons - float(station.hazard.high[2]),
            station.distance,
            "mm",
            until,
        ).with_cure(nearer, signals.HANDS),
        at_most(
            "bench: deflection of a beam",
            station.sag,
            _SAG * 2 * station.half,
            "mm",
            "length over 300, assumed by this project",
        ).with_cure("set fewer weavers", part_id("bench-beam")),
    )
