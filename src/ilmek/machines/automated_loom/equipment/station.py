"""The station of the weavers of a loom without heads: bench, buttons that they hold while the loom moves, their reach.

They sit beside each other, their elbows at the height of the fell, and lean forward to tie. The loom moves only while
each of them holds both of her buttons, on either side of her on the bench: these are as far from all that moves as a
hand comes while it still moves [ISO 13851, ISO 13855]. What is before the trunk of a weaver keeps the bench back.

Not there: anything that keeps a head out of the
path of the beat while its weaver holds her buttons; a stop that hands at the fell themselves cause.

Axes of the scene: x to the right, y up from the fell, z to the front [m].
"""

from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.field_devices import BUTTON, STOP
from ilmek.elements.safety_distances import approach
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.bench import (
    BOARD,
    ELBOW,
    HIP,
    LEAST_SEAT,
    SECTION,
    SHOULDER,
    TRUNK,
    Bench,
    bench_for,
    bench_parts,
)
from ilmek.machines.automated_loom.equipment.devices import UPWARDS, device, placed
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.surroundings import Hazard
from ilmek.machines.automated_loom.frame import member, part_id
from ilmek.part.placement import UPRIGHT, placement
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.records import group, record
from ilmek.report import Check, at_least
from ilmek.units import mm

ASIDE = 0.25
"""Buttons of a weaver, from her middle [m]."""

_GAP = 30 * mm

BENCH = part_id("bench")


@record
class WeaversStation:
    """Where weavers sit.

    middles   of the weavers along the row [m]       hazard  that decides on the distance of their buttons
    distance  that these need from it [m]
    """

    bench: Bench = group()
    middles: tuple[float, ...]
    hazard: Hazard
    distance: float

    @property
    def buttons(self) -> float:
        """Middles of the buttons, z [m]."""
        return self.bench.rear - BUTTON.size[0] / 2


@lru_cache(maxsize=4)
def station_of(site: LoomSite) -> WeaversStation:
    """The station of a loom: as near to the warps as its buttons and what stands before the weavers allow."""
    near, floor, cloth, stops = site.near, site.floor, site.width, site.stops
    seat = max(-floor - ELBOW, LEAST_SEAT)
    hazard = max(near.hazards, key=lambda one: float(one.high[2]) + approach(stops.of(one.body)))
    distance = approach(stops.of(hazard.body))
    feet = near.of(part_id("front-foot"))
    half = float(feet[-1].high[0]) + SECTION.side
    top = floor + seat

    def before(low: float, high: float, aside: float) -> float:
        """The foremost z of what is between two heights, up to a distance from the middle [m]."""
        inside = (
            float(extent.high[2])
            for extent in near.extents
            if extent.low[1] < high and extent.high[1] > low and extent.low[0] < aside and extent.high[0] > -aside
        )
        return max(inside, default=0.0)

    front = max(
        before(top - SECTION.side - BOARD[1], top, half) + _GAP,
        before(top, top + SHOULDER, cloth / 2) + _GAP + TRUNK - HIP,
        float(hazard.high[2]) + distance + BUTTON.size[0] / 2 - BOARD[0],
    )
    number = site.weavers
    middles = tuple(((k + 0.5) / number - 0.5) * cloth for k in range(number))
    return WeaversStation(bench_for(front, seat, floor, half, number), middles, hazard, distance)


def station_tree(site: LoomSite) -> Tree:
    """The bench, fixed to the front feet, with its buttons."""
    station = station_of(site)
    return Tree((RigidBody(BENCH, (*_stand(site, station.bench), *_on_board(station))),))


def _stand(site: LoomSite, bench: Bench) -> Iterator[Occurrence]:
    """Rails beside the front feet, with feet at their rear ends, and the bench on them."""
    foot, side, floor = site.near.of(part_id("front-foot"))[-1], SECTION.side, bench.floor
    begin = min(float(foot.high[2]) - 4 * side, bench.front)
    y, x = float(foot.low[1] + foot.high[1]) / 2, bench.half - side / 2
    rail = member("bench-rail", "rail of the bench at a front foot", SECTION, bench.rear - begin)
    yield Occurrence(rail, (placement(-x, y, begin), placement(x, y, begin)))
    under = member("bench-foot", "foot of the bench", SECTION, y - side / 2 - floor)
    yield Occurrence(under, tuple(placement(own, floor, bench.legs[1]).after(UPRIGHT) for own in (-x, x)))
    yield from bench_parts(bench, y + side / 2, float(foot.high[1]))


def _on_board(station: WeaversStation) -> Iterator[Occurrence]:
    """Two buttons for each weaver, and an emergency stop at both ends of the bench."""
    bench = station.bench
    top, z = bench.floor + bench.seat, station.buttons
    button = device(signals.HANDS, "button that a weaver holds", BUTTON)
    xs = (middle + side * ASIDE for middle in station.middles for side in (-1, 1))
    yield Occurrence(button, tuple(placed(x, top, z, UPWARDS) for x in xs))
    stop = device(signals.BENCH_STOP, "emergency stop of the weavers", STOP)
    aside = bench.half - STOP.size[0] / 2
    yield Occurrence(stop, tuple(placed(x, top, z, UPWARDS) for x in (-aside, aside)))


def station_checks(site: LoomSite) -> tuple[Check, ...]:
    """Reach of the weavers, the distance of their buttons, and the beams of the bench."""
    station, nearer = station_of(site), "set beat=comb, or a shorter shed_stop"
    until = f"ISO 13855, 1.6 m/s: until the {site.stops.axis_of(station.hazard.body)} stands; shrouded"
    return (
        *station.bench.checks(nearer),
        at_least(
            "guards: distance of the buttons that weavers hold",
            station.buttons - float(station.hazard.high[2]),
            station.distance,
            "mm",
            until,
        ).with_cure(nearer, signals.HANDS),
    )
