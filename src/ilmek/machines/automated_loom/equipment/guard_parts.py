"""The guards as bodies: posts, panels of mesh, doors with hinges and interlocks, emergency stops and the reset.

Posts stand in the lines of the fence, at most `BAY` apart; panels fill the bays between them, above the cabinet of the
control too, which is a part of the fence. The doors are the bays of the front; they are closed while the loom weaves.
"""

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.field_devices import ACTUATOR, BUTTON, ENABLING, GRID, INTERLOCK, STOP
from ilmek.machines.automated_loom.anchors import anchored
from ilmek.machines.automated_loom.cabinet import CONTROL
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import (
    DEVICE_PLATE,
    TO_THE_BACK,
    TO_THE_LEFT,
    TO_THE_RIGHT,
    UPWARDS,
    device,
    device_plate,
    placed,
)
from ilmek.machines.automated_loom.equipment.guards import (
    BOTTOM,
    DOOR,
    GUARDS,
    MESH,
    PANEL,
    PLATE,
    POST,
    WIRE,
    Fence,
    bays,
    fence_of,
    rear_feet,
    side_posts,
)
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.surroundings import GAP, Surroundings
from ilmek.machines.automated_loom.frame import member, part_id
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, UPRIGHT, Placement, placement
from ilmek.part.shapes import Placed, Sum, bar, box, square_tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.units import format_quantity, mm

_HINGE, _GAP = (14 * mm, 80 * mm), 5 * mm
"""Diameter and height of the barrel of a hinge, in the gap of a door at its post; gap at its latch [m]."""

_FRAME = HollowSquare(20 * mm, 2 * mm)
"""Section of the frame of a door: EN 10219-2."""

_CLAMP = (5 * mm, 30 * mm)
"""Width and height of the clamps of a panel [m]: the width is the gap of the panel between its posts."""

_PLATE, _FAR = (PLATE, POST, 8 * mm), 45 * mm
"""Sides and thickness of the plate under a post, and its second anchor from the middle, where the first is [m]."""

_BEFORE_LATCH = 15 * mm
"""From the edge of a door to its actuator [m]: the interlock sees it 15 mm away, and open doors not."""

_ABOVE_CABINET = 5 * mm
"""Between the cabinet and the panel above it [m]: no finger passes."""

_STOP_HEIGHT, _RESET_HEIGHT = 1.1, 1.3
"""Of emergency stops and reset over the floor [m]: ISO 13850, 0.6 to 1.7 m."""

_GRID_LOW = 0.25
"""Lower end of the light grid over the floor [m]: its beams at 0.3, 0.6, 0.9 and 1.2 m, ISO 13855, table E.1."""

_STOPS_APART = 3.0
"""Greatest distance of two emergency stops along the doors [m]; assumed by this project."""

_LEAST_PANEL = 12 * mm
"""Narrower gaps between posts stay open: a finger, 80 mm at most, does not reach the loom [m]."""

_SECTION = HollowSquare(POST, 3 * mm)


def guards(site: LoomSite) -> Tree:
    """The fence, its doors, and what is on its posts."""
    fence = fence_of(site)
    lines = _Lines(fence, site.near, doors=site.heads > 0)
    front = (lines.lintel(), *_latches(fence, lines.front)) if site.heads else (_grid(fence),)
    parts = (*lines.posts(), *front, *lines.panels(), *lines.ties(), *_on_posts(fence, lines.front))
    doors = (_doors(fence, lines.front),) if site.heads else ()
    return Tree((RigidBody(GUARDS[0], parts), *doors))


class _Lines:
    """The posts of the four sides, and the bays between them; middles of the posts [m]."""

    def __init__(self, fence: Fence, near: Surroundings, *, doors: bool) -> None:
        half = POST / 2
        self._fence, self._near = fence, near
        self.left, self.right, self.back = fence.left - half, fence.right + half, fence.rear - half
        self.forward = fence.front + half
        self.front = bays(self.left, self.right) if doors else (self.left, self.right)
        self.side = side_posts(fence)
        (self._control,) = near.of(CONTROL)
        # The cabinet is in the fence's line, or stands inside of it.
        self._cabinet = self._control.low[2] < self.back < self._control.high[2]
        ends = float(self._control.low[0]) - half, float(self._control.high[0]) + half
        feet = rear_feet(near)
        beside = (bays(self.left, ends[0], feet), bays(ends[1], self.right, feet))
        self._rear = beside if self._cabinet else (bays(self.left, self.right, feet),)

    def posts(self) -> Iterator[Occurrence]:
        """All posts, each once."""
        fence = self._fence
        corners = {(x, z) for x in (self.left, self.right) for z in self.side}
        corners |= {(x, self.forward) for x in self.front} | {(x, self.back) for line in self._rear for x in line}
        part = member("guard-post", "post of the guards", _SECTION, fence.height - _PLATE[2])
        feet = [placement(x, fence.floor, z) for x, z in sorted(corners)]
        up = placement(y=_PLATE[2]).after(UPRIGHT)
        yield Occurrence(part, tuple(foot.after(up) for foot in feet))
        plates = (turned.after(UPRIGHT) for turned in self._plates(feet))
        aside = placement((_PLATE[0] - POST) / 2)
        places = (plate.after(aside) for plate in plates)
        yield from anchored("guard-plate", "plate of a post of the guards", _PLATE, (0j, _FAR + 0j), places)

    def _plates(self, feet: Sequence[Placement]) -> Iterator[Placement]:
        """The feet of posts turned to where their plates have room: inwards, along the fence, or outwards."""
        middle = complex(self.left + self.right, self.back + self.forward) / 2
        half, (long, _, thick) = POST / 2, _PLATE
        post, plate = (
            np.array([[-half, 0.0, low], [half, 3 * thick, high]]) for low, high in ((-half, half), (half, long - half))
        )
        taken = [np.sort(foot.points(post), axis=0) for foot in feet]
        for foot in feet:
            inwards = middle - complex(foot.origin[0], foot.origin[2])
            turns = sorted((1, 1j, -1, -1j), key=lambda turned: -(inwards * np.conj(turned)).real)
            # An upright part has its x to the front.
            angles = [cmath.phase(complex(turned.imag, turned.real)) for turned in map(complex, turns)]
            places = [foot.after(placement(about=(0.0, 1.0, 0.0), angle=angle)) for angle in angles]
            boxes = [np.sort(place.points(plate), axis=0) for place in places]
            free = (
                number
                for number, box in enumerate(boxes)
                if self._near.free(*box) and not any(_meet(box, own) for own in taken)
            )
            chosen = next(free, len(turns) - 1)
            taken.append(boxes[chosen])
            yield places[chosen]

    def lintel(self) -> Occurrence:
        """Above each door, from post to post."""
        spacing = self.front[1] - self.front[0]
        part = member("guard-lintel", "lintel of a door", _SECTION, spacing - POST)
        y = self._fence.top - POST / 2
        places = (placement(x + POST / 2, y, self.forward).after(ALONG_WIDTH) for x in self.front[:-1])
        return Occurrence(part, tuple(places))

    def ties(self) -> Iterator[Occurrence]:
        """Between rear feet and posts, where the fence stands behind their ends."""
        feet, beside = self._near.of(part_id("rear-foot")), rear_feet(self._near)
        gap = float(feet[0].low[2]) - self._fence.rear
        if gap > _LEAST_PANEL and beside:
            part = member("guard-tie", "tie of the guards to a rear foot", _SECTION, gap)
            height = float(feet[0].low[1] + feet[0].high[1]) / 2
            yield Occurrence(part, tuple(placement(x, height, self._fence.rear) for x in beside))

    def panels(self) -> Iterator[Occurrence]:
        """Panels of both sides and of the rear, a part for each size."""
        low, high = self._fence.floor + BOTTOM, self._fence.top
        places: dict[tuple[float, float], list[Placement]] = {}
        for first, then in pairwise(self.side):
            for x in (self.left, self.right):
                _add(places, then - first, high - low, placed(x - WIRE, low, (first + then) / 2, TO_THE_RIGHT))
        for line in self._rear:
            for first, then in pairwise(line):
                _add(places, then - first, high - low, placement((first + then) / 2, low, self.back - WIRE))
        if self._cabinet:
            first, begin = self._rear[0][-1], self._rear[-1][0]
            over = float(self._control.high[1]) + _ABOVE_CABINET
            if high - over > _LEAST_PANEL:
                _add(places, begin - first, high - over, placement((first + begin) / 2, over, self.back - WIRE))
        for number, ((wide, tall), positions) in enumerate(places.items(), start=1):
            name = PANEL if number == 1 else f"{PANEL}-{number}"
            yield Occurrence(mesh_panel(name, "panel of the guards", wide, tall), tuple(positions))


def _meet(first: FloatArray, second: FloatArray) -> bool:
    """Whether two boxes share room [m]."""
    return bool((first[0] < second[1] - mm).all() and (second[0] < first[1] - mm).all())


def _add(places: dict[tuple[float, float], list[Placement]], spacing: float, tall: float, own: Placement) -> None:
    wide = spacing - POST
    if wide > _LEAST_PANEL:
        places.setdefault((round(wide, 9), round(tall, 9)), []).append(own)


@lru_cache(maxsize=64)
def mesh_panel(name: str, title: str, between: float, tall: float) -> Part:
    """A panel of welded wire with its clamps between posts: x across, 0 in its middle, y up, z through it from 0."""
    wide = between - 2 * _CLAMP[0]
    ends = (placement(side * (between - _CLAMP[0]) / 2, y * tall) for side in (-1, 1) for y in (0.15, 0.85))
    shape = Sum((*_mesh(wide, tall), Placed(box(*_CLAMP, 2 * WIRE), tuple(ends))))
    fixing = "its clamps, each with a screw M8, on the posts"
    return _panel(name, title, (wide, tall), shape, "with 4 clamps and screws", fixing)


def _door(wide: float, tall: float) -> Part:
    """A door of mesh in its frame, in the axes of a panel."""
    side, inner = _FRAME.side, wide - 2 * _FRAME.side
    upright, level = (square_tube(side, _FRAME.wall, long) for long in (tall, inner))
    ups = (placement(x, 0.0, side / 2).after(UPRIGHT) for x in ((side - wide) / 2, (wide - side) / 2))
    levels = (placement(-inner / 2, y, side / 2).after(ALONG_WIDTH) for y in (side / 2, tall - side / 2))
    mesh = (
        Placed(own.shape, tuple(placement(y=side).after(at) for at in own.positions))
        for own in _mesh(inner, tall - 2 * side)
    )
    shape = Sum((Placed(upright, tuple(ups)), Placed(level, tuple(levels)), *mesh))
    frame = f"welded in a frame, tube {_FRAME.name}, its hinges welded on"
    return _panel(DOOR, "door of the guards", (wide, tall), shape, frame, "halves of its hinges, welded to its post")


def _panel(  # noqa: PLR0917
    name: str, title: str, sides: tuple[float, float], shape: Sum, how: str, fixing: str
) -> Part:
    wide, tall = (format_quantity(side, "mm", 4) for side in sides)
    bought = Bought(f"welded mesh {WIRE / mm:g} mm, {how}", shape.volume * STEEL.density)
    size = f"{wide} x {tall}, mesh {format_quantity(MESH, 'mm')}"
    return Part(name, title, "guard mesh", shape, purchase=bought, fixing=fixing, size=size)


def _mesh(wide: float, tall: float) -> tuple[Placed, Placed]:
    """Upright wires before level ones, those at the edges among them, at most `MESH` apart."""
    upright, level = (math.ceil((size - WIRE) / MESH - 1e-9) for size in (wide, tall))
    columns = np.linspace(-(wide - WIRE) / 2, (wide - WIRE) / 2, upright + 1).tolist()
    rows = np.linspace(WIRE / 2, tall - WIRE / 2, level + 1).tolist()
    return (
        Placed(box(WIRE, tall, WIRE), tuple(placement(x, tall / 2) for x in columns)),
        Placed(box(wide, WIRE, WIRE), tuple(placement(0.0, y, WIRE) for y in rows)),
    )


def _doors(fence: Fence, front: tuple[float, ...]) -> RigidBody:
    """The doors, hinged at their left posts, each with the actuator of its interlock at its right edge."""
    barrel, tall = _HINGE
    wide, high = front[1] - front[0] - POST - barrel - _GAP, fence.height - BOTTOM - POST - _GAP
    leaf, row = _door(wide, high), f"weld-on hinge, barrel {barrel / mm:.0f} x {tall / mm:.0f} mm, with its pin"
    rod = bar(barrel, tall)
    hinge = bought_part(
        part_id("guard-hinge"), "hinge of a door", "hinge", rod, Bought(row, rod.volume * STEEL.density),
        fixing="its halves welded to the post and to the frame of the door",
    )  # fmt: skip
    actuator = device(signals.ACTUATOR, "actuator of an interlock", ACTUATOR)
    height = fence.floor + _STOP_HEIGHT
    upright = placement(-(wide + barrel) / 2, -tall / 2, _FRAME.side / 2).after(UPRIGHT)
    hinges = (placement(y=y * high).after(upright) for y in (0.15, 0.85))
    inwards = wide / 2 - ACTUATOR.size[0] / 2 - _BEFORE_LATCH, height - fence.floor - BOTTOM, -ACTUATOR.size[1] / 2
    middles = ((first + then + barrel - _GAP) / 2 for first, then in pairwise(front))
    parts = (Occurrence(leaf), Occurrence(hinge, tuple(hinges)), Occurrence(actuator, (placed(*inwards, UPWARDS),)))
    positions = tuple(placement(x, fence.floor + BOTTOM, fence.front + POST / 2 - WIRE) for x in middles)
    return RigidBody(GUARDS[1], parts, positions=positions)


def _grid(fence: Fence) -> Occurrence:
    """Sender and receiver of the light grid at the inner sides of the front's posts, from ankle to chest."""
    grid, height = device(signals.GRID, "light grid of the front", GRID), fence.floor + _GRID_LOW
    wide, high, _ = GRID.size
    z, y = fence.front + wide / 2, height + high / 2
    ends = (fence.left, TO_THE_RIGHT), (fence.right, TO_THE_LEFT)
    return Occurrence(grid, tuple(placed(x, y, z, turned) for x, turned in ends))


def _latches(fence: Fence, front: tuple[float, ...]) -> Iterator[Occurrence]:
    """Interlocks at the latches of the doors, each on its plate."""
    wide, thick, tall = INTERLOCK.size
    latch = device(signals.INTERLOCK, "interlock of a door", INTERLOCK)
    height, inner = fence.floor + _STOP_HEIGHT, fence.front - DEVICE_PLATE
    # Beside the last post's middle, to which the panel of the side reaches.
    beside = wide / 2 + 2 * WIRE
    plate = device_plate(part_id("latch-plate"), "plate of an interlock on a post", INTERLOCK)
    yield Occurrence(plate, tuple(placement(x - beside, height + tall / 2, inner) for x in front[1:]))
    yield Occurrence(latch, tuple(placed(x - beside, height, inner - thick / 2, UPWARDS) for x in front[1:]))


def _on_posts(fence: Fence, front: tuple[float, ...]) -> Iterator[Occurrence]:
    """Emergency stops at front and rear, the reset at the last post of the front, each on its plate."""
    height = fence.floor + _STOP_HEIGHT
    stop, outer = device(signals.STOP, "emergency stop", STOP), fence.front + POST
    # Beside the creel's rails, which may reach past the corner.
    left, right = fence.left - POST + STOP.size[0] / 2, fence.right + POST - STOP.size[0] / 2
    back = placed(left, height, fence.rear - POST, TO_THE_BACK)
    before = (placement(min(max(x, left), right), height, outer) for x in _stations(front))
    on_posts = (*before, back)
    under_reset = placement(right, fence.floor + _RESET_HEIGHT, outer)
    plate = device_plate(part_id("device-plate"), "plate of a device on a post", STOP)
    yield Occurrence(plate, (*on_posts, under_reset))
    on_plate = placement(z=DEVICE_PLATE)
    yield Occurrence(stop, tuple(own.after(on_plate) for own in on_posts))
    reset = device(signals.RESET, "reset of the safety circuit", BUTTON)
    yield Occurrence(reset, (under_reset.after(on_plate),))
    enabling = device(signals.ENABLING, "enabling switch for setting up", ENABLING)
    under = height - (STOP.size[1] + ENABLING.size[1]) / 2 - GAP
    yield Occurrence(enabling, (placement(right, under, outer),))


def _stations(front: tuple[float, ...]) -> Iterable[float]:
    """Posts of the front that carry an emergency stop: both ends, and between them so many that none is far."""
    number = math.ceil((front[-1] - front[0]) / _STOPS_APART)
    return sorted({front[round(share * (len(front) - 1))] for share in np.linspace(0.0, 1.0, number + 1).tolist()})
