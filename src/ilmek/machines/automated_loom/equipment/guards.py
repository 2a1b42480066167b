"""The guards round a loom: where its fence stands, how high it is, and why; ISO 13857, ISO 13855, ISO 14120.

A fence of welded mesh stands round all that moves, at least as far away as an arm reaches through its openings
[`elements.safety_distances`], and outside of all that stands. Its front consists of doors with interlocks, as far away
as a body comes while the loom still moves. Where weavers tie, the front is a light grid behind them, and each of them
has two buttons that she holds while the loom moves [`station`]. The rear stands at the ends of the rear feet, to which
its posts are bolted, and ends at the cabinet of the control. It is as low as the table allows for the distances that
are there.

Axes of the scene: x to the right, y up from the fell, z to the front [m].
"""

import math
from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise

from ilmek.elements.field_devices import ENCODER
from ilmek.elements.safety_distances import FENCES, GRID_REACH, approach, least_fence, over_span, through
from ilmek.machines.automated_loom.cabinet import CONTROL
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.sensors import ROW_MOTORS
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.station import station_of
from ilmek.machines.automated_loom.equipment.stopping import StoppingTime
from ilmek.machines.automated_loom.equipment.surroundings import GAP, Hazard, Surroundings
from ilmek.machines.automated_loom.frame import part_id
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import format_quantity, mm

PANEL, DOOR = part_id("guard-panel"), part_id("guard-door")
"""Beginnings of the ids of panels and doors: each width and height is a part of its own."""

GUARDS = part_id("guards"), part_id("doors")
"""Ids of the bodies of fence and doors."""

POST = 40 * mm
"""Side of a fence's posts [m]."""

PLATE = 140 * mm
"""Length of the plate under a post [m]."""

MESH, WIRE = 40 * mm, 3 * mm
"""Pitch and thickness of the wires of the mesh [m]: EN 10223-8, welded mesh panels."""

BOTTOM = 20 * mm
"""Slot below the panels [m]; a hand reaches 120 mm through it: ISO 13857, table 4."""

BESIDE = 20 * mm
"""Least room between fence and loom [m]; assumed by this project."""

LEAST_HEIGHT = 1400 * mm
"""Lowest fence that ISO 13857 allows at a high risk [m]."""

BAY = 1.0
"""Greatest width of a panel or a door [m]; assumed by this project."""

_CURE = "set a shorter shed_stop, a lower beat_speed, or higher accelerations"


@record
class Fence:
    """The fence of a loom: inner faces of its posts [m], its height over the floor [m], what it keeps away from.

    left, right    x of the inner faces at the sides      rear, front  z of them
    height         of the upper edge over the floor       floor  height of the floor over the fell
    """

    left: float
    right: float
    rear: float
    front: float
    height: float
    floor: float
    hazards: tuple[Hazard, ...]
    stopping: StoppingTime

    @property
    def top(self) -> float:
        """Upper edge over the fell [m]."""
        return self.floor + self.height

    def distance(self, hazard: Hazard) -> float:
        """Horizontal distance of a hazard from the nearest side of the fence [m]."""
        return min(_distances(self.left, self.right, self.rear, self.front, hazard))

    def needed(self, hazard: Hazard) -> float:
        """Distance at which a hazard is not reached over the fence [m]."""
        return over_span(*_heights(self.floor, hazard), self.height)


@lru_cache(maxsize=4)
def fence_of(site: LoomSite) -> Fence:
    """The fence of a loom."""
    near, stopping, floor = site.near, site.stops, site.floor
    (stands_low, stands_high), (moves_low, moves_high) = near.standing, near.moving
    (control,) = near.of(CONTROL)
    reach = through(MESH - WIRE)
    # A post stands on each side of the cabinet, beside those of the corners.
    ends = float(control.low[0]) - 2 * POST, float(control.high[0]) + 2 * POST
    inside, beside = (0.0, 0.0) if site.heads else (station_of(site).bench.rear, station_of(site).bench.half + BESIDE)
    left = min(float(stands_low[0]) - BESIDE, -beside, float(moves_low[0]) - reach, ends[0])
    behind = max(
        (float(extent.high[0]) for extent in near.extents if extent.part in ROW_MOTORS), default=0.0
    )  # their encoders
    encoders = behind + ENCODER.size[2] + GAP
    right = max(float(stands_high[0]) + BESIDE, beside, float(moves_high[0]) + reach, ends[1], encoders)
    rear = min(float(stands_low[2]), float(moves_low[2]) - reach)
    front = max(float(stands_high[2]) + BESIDE, inside + BESIDE, float(moves_high[2]) + _approach(site))
    hazards = tuple(
        (*_heights(floor, hazard), min(_distances(left, right, rear, front, hazard))) for hazard in near.hazards
    )
    return Fence(left, right, rear, front, least_fence(hazards, LEAST_HEIGHT), floor, near.hazards, stopping)


def _approach(site: LoomSite) -> float:
    """Least distance of the front, doors or a light grid, from all that moves [m]."""
    return approach(site.stops.whole, 0.0 if site.heads else GRID_REACH)


def _heights(floor: float, hazard: Hazard) -> tuple[float, float]:
    return max(float(hazard.low[1]) - floor, 0.0), float(hazard.high[1]) - floor


def _distances(left: float, right: float, rear: float, front: float, hazard: Hazard) -> Iterator[float]:
    yield float(hazard.low[0]) - left
    yield right - float(hazard.high[0])
    yield float(hazard.low[2]) - rear
    yield front - float(hazard.high[2])


def side_posts(fence: Fence) -> tuple[float, ...]:
    """Middles of the posts of a side, z, from the rear to the front [m]."""
    return bays(fence.rear - POST / 2, fence.front + POST / 2)


def rear_feet(near: Surroundings) -> tuple[float, ...]:
    """Middles of the rear feet at whose ends posts stand, clear of the plates of the posts beside the cabinet [m]."""
    (control,) = near.of(CONTROL)
    begin, end = float(control.low[0]) - PLATE, float(control.high[0]) + PLATE
    middles = (float(foot.low[0] + foot.high[0]) / 2 for foot in near.of(part_id("rear-foot")))
    return tuple(x for x in middles if x + POST / 2 <= begin or x - POST / 2 >= end)


def guard_checks(site: LoomSite) -> tuple[Check, ...]:
    """Reaching through the mesh and over the fence, and the distance of the front; stopping time of the loom."""
    fence = fence_of(site)
    nearest = min(fence.hazards, key=fence.distance)
    worst = min(fence.hazards, key=lambda one: fence.distance(one) - fence.needed(one))
    moved = max(float(hazard.high[2]) for hazard in fence.hazards)
    height, opening = format_quantity(fence.height, "m", 3), format_quantity(MESH - WIRE, "mm")
    stops = format_quantity(fence.stopping.whole, "s", 3)
    title, device = ("doors", signals.INTERLOCK) if site.heads else ("light grid", signals.GRID)
    return (
        at_least(
            f"guards: reaching through, to the {_named(nearest)}",
            fence.distance(nearest),
            through(MESH - WIRE),
            "mm",
            f"ISO 13857, table 4: square openings of {opening}",
        ).with_cure("set a larger margin", PANEL),
        at_least(
            f"guards: reaching over, to the {_named(worst)}",
            fence.distance(worst),
            fence.needed(worst),
            "mm",
            f"ISO 13857, table 2, high risk: fence of {height}",
        ).with_cure("set a narrower lift or a lower tension: the loom is to be lower", PANEL),
        at_least(
            f"guards: distance of the {title}",
            fence.front - moved,
            _approach(site),
            "mm",
            f"ISO 13855, 1.6 m/s: the {fence.stopping.axis} stand {stops} after it opens",
        ).with_cure(_CURE, *((DOOR,) if site.heads else ()), device, signals.GUARD_RELAY),
        at_most("guards: height", fence.height, FENCES[-1], "m", "highest fence of ISO 13857, table 2").with_cure(
            "set a lower tension or a smaller lift", PANEL
        ),
    )


def _named(hazard: Hazard) -> str:
    return hazard.body.rpartition("/")[2]


def bays(begin: float, end: float, stations: tuple[float, ...] = ()) -> tuple[float, ...]:
    """Middles of the posts from one to another [m], at most `BAY` apart, some at given stations between.

    >>> bays(0.0, 1.5), bays(0.0, 1.0, (0.4,))
    ((0.0, 0.75, 1.5), (0.0, 0.4, 1.0))
    """
    ends = (begin, *sorted(station for station in stations if begin + POST < station < end - POST), end)
    posts = [begin]
    for first, then in pairwise(ends):
        number = math.ceil((then - first) / BAY - 1e-9)
        posts += [*(first + k / number * (then - first) for k in range(1, number)), then]
    return tuple(posts)
