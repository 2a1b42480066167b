"""What moves the shuttles behind the warps: carriage on a rail, belt round two pulleys, the bar that carries both.

Axes: those of `carriers`, 0 at the axis of the shuttle. From the warps to the back: the carriage with its magnets to
the front, its guide on the bar, which reaches beyond both boxes. The belt runs below the rail; motor and reducer stand
behind the bar, in line with the right pulley. At each end of the bar a slide with a stepper shifts a box.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from ilmek.elements.linear_guides import LINEAR_GUIDES, LinearGuide, guide_of_height
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.elements.motors import STEPPER, smallest_motor
from ilmek.elements.reducers import DIRECT
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.carriers import AXIS, BOX, BOX_MOTOR, CARRIAGE, MOTOR, along, magnet, magnet_positions, part_id
from ilmek.machines.weft.coupling import BOX_WALL, magnet_sides
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.shuttle import BOX_END, Shuttle
from ilmek.part import catalogue, guides
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, box, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import polygon
from ilmek.records import record
from ilmek.units import format_quantity, in_mm, mm

ALUMINIUM, STEEL = MATERIALS["aluminium alloy"], MATERIALS["structural steel"]

COVER = 2 * mm
"""Wall of the carriage beside its magnets [m]: assumed by this project."""

BACK = 5 * mm
"""Wall behind them, in which the heads of the screws of its guide are sunk [m]: assumed by this project."""

BAR = 6 * mm
"""Thickness of the bar that carries the rail [m]."""

PLAY = 2 * mm
"""Between the carriage's guide and the belt, and at the ends of the run [m]."""

SLIDE = 30 * mm
"""Side of the room for the slide of a box [m]: assumed by this project."""

_ON_SLIDE = "on the adapter of its slide, with the screws of that"

SHIFT_SPEED = 0.1
"""Speed of a box from cell to cell [m/s]."""

BELT_THICKNESS = {"AT5": 2.7 * mm, "AT10": 5.0 * mm}
"""By profile [m]; makers' data."""


def guide_for(axis: BeltAxis) -> LinearGuide:
    """The guide under which the belt has room."""
    return LINEAR_GUIDES[-1] if math.isnan(axis.width) else guide_of_height(axis.width)


def carriage_mass(params: WeftParams, made: Shuttle, row: LinearGuide) -> float:
    """Mass of a shuttle's carriage with its magnets and the carriages of its guide [kg]."""
    magnets = magnet(params, made.bobbin).mass * len(magnet_positions(params, made.bobbin)) if params.nose > 0 else 0.0
    return carriage(params, made, row).mass + magnets + 2 * row.block_mass


def carriage(params: WeftParams, made: Shuttle, row: LinearGuide) -> Part:
    """A plate with pockets for the magnets in its front, down to the belt; from z = 0 to the front."""
    long, tall, thick = magnet_sides(params, made.bobbin.diameter)
    low, high = -row.block - PLAY - max(BELT_THICKNESS.values()), made.width / 2
    length, middle = carriage_length(params, made), (low + high) / 2 * 1j
    outline = polygon(rectangle(length, high - low).points + middle)
    pockets = (
        tuple(polygon(rectangle(long, tall).points + x) for x in magnet_positions(params, made.bobbin)) if long else ()
    )
    back, front = Prism(Profile(outline), BACK), Prism(Profile(outline, pockets), thick)
    shape = Sum((Placed(back), Placed(front, (placement(z=BACK),))))
    return Part(CARRIAGE, "carriage of the shuttle", "machined link", shape, ALUMINIUM)


def carriage_length(params: WeftParams, shuttle: Shuttle) -> float:
    """Length of the carriage: over its magnets [m]."""
    return shuttle.bobbin.length + 2 * (params.wall + magnet_sides(params, shuttle.bobbin.diameter)[0] + COVER)


@record
class ShuttleGuide:
    """Places of carriage, guide, belt and boxes of a shuttle with its axis; stroke of it [m]."""

    params: WeftParams
    made: Shuttle
    axis: BeltAxis
    stroke: float

    @property
    def row(self) -> LinearGuide:
        """The guide."""
        return guide_for(self.axis)

    @property
    def back(self) -> float:
        """Back of the carriage [m]."""
        thick = magnet_sides(self.params, self.made.bobbin.diameter)[2]
        return -self.made.depth / 2 - self.made.coupling.gap - thick - BACK

    @property
    def front(self) -> float:
        """Front of the bar, on which the rail lies [m]."""
        return self.back - self.row.height

    @property
    def rear(self) -> float:
        """Back of the bar [m]."""
        return self.front - BAR

    @property
    def run(self) -> float:
        """Half of the length over which the carriage moves [m]."""
        return self.stroke / 2 + carriage_length(self.params, self.made) / 2 + PLAY

    @property
    def pulley(self) -> tuple[float, float]:
        """Middle of the right pulley: x and y [m]."""
        radius, thick = self.axis.pulley_radius, self._thick
        return self.run + radius + thick, -self.row.block - PLAY - thick - radius

    @property
    def drive_inner(self) -> float:
        """Side of the drive towards the middle of the width, from there [m]."""
        row = self.axis.drive.motor if self.axis.drive else None
        return self.pulley[0] - (row.face if row else catalogue.SPECIAL_FACE) / 2

    @property
    def box_end(self) -> float:
        """Outer end of a box from the middle of the width [m]."""
        return self.stroke / 2 + self.made.length / 2 + BOX_END

    @property
    def reach(self) -> float:
        """Half of the length of the bar [m]."""
        return float(max(self.box_end + SLIDE, self.pulley[0] + self.axis.pulley_radius + self._thick + PLAY))

    @property
    def pitch(self) -> float:
        """Distance of the two cells of a box, one above the other [m]."""
        return self.made.width + self.params.play + BOX_WALL

    @property
    def _thick(self) -> float:
        return BELT_THICKNESS[self.axis.belt.belt.name]

    def carried(self) -> Iterator[Occurrence]:
        """What moves with the carriage, its middle at x = 0."""
        params, made, row = self.params, self.made, self.row
        yield Occurrence(carriage(params, made, row), (placement(z=self.back),))
        if params.nose > 0:
            places = (placement(x, z=self.back + BACK) for x in magnet_positions(params, made.bobbin))
            yield Occurrence(magnet(params, made.bobbin), tuple(places))
        block = guides.guide_block(part_id("guide-carriage"), "carriage of the shuttle's guide", row)
        end = carriage_length(params, made) / 2
        yield Occurrence(block, tuple(self._on_rail(x) for x in (-end, end - row.block_length)))

    def _on_rail(self, x: float) -> Placement:
        """A part of the guide along the width from x on, its base on the bar."""
        return placement(x, -self.row.block / 2, self.front).after(ALONG_WIDTH)

    def standing(self) -> Iterator[Occurrence]:
        """Bar, rail, belt with pulleys, and the drive."""
        below = max(self.axis.pulley_radius + self._thick + PLAY, *(catalogue.face_of(one) / 2 for one in self._driven))
        tall = below - self.pulley[1]
        plate = Part(
            part_id("bar"),
            "bar of the shuttle's axis",
            "steel bar",
            box(2 * self.reach, tall, BAR),
            STEEL,
            machined=True,
        )
        yield Occurrence(plate, (placement(y=-tall / 2, z=self.rear),))
        rail = guides.guide_rail(part_id("rail"), "rail of the shuttle's guide", self.row, 2 * self.run)
        yield Occurrence(rail, (self._on_rail(-self.run),))
        yield Occurrence(self._belt(), (placement(y=self.pulley[1], z=self.front),))
        yield from self._drive()

    def _belt(self) -> Part:
        """Both strands and both pulleys, about the middle of the width, from z = 0 to the front."""
        axis, (end, _) = self.axis, self.pulley
        radius, thick = axis.pulley_radius, self._thick
        wide, deep = axis.width, self.row.height
        known = deep if math.isnan(wide) else wide
        strand = Prism(Profile(rectangle(2 * end, thick)), known)
        side = radius + thick / 2
        strands = Placed(strand, (placement(y=side, z=deep - known), placement(y=-side, z=deep - known)))
        pulleys = Placed(bar(2 * radius, deep), (placement(-end), placement(end)))
        text = "wider than any of the table" if math.isnan(wide) else f"{format_quantity(wide, 'mm')} wide"
        mass = axis.belt.length * known * axis.belt.belt.mass + 2 * math.pi * radius**2 * deep * ALUMINIUM.density
        bought = Bought(f"belt {axis.belt.belt.name}", mass, length=axis.belt.length)
        text = f"belt {axis.belt.belt.name}, {text}"
        shape = Sum((strands, pulleys))
        return Part(AXIS, "belt and pulleys of the shuttle", "belt and pulleys", shape, purchase=bought, size=text)

    @property
    def _driven(self) -> tuple[Part, ...]:
        """Reducer, if any, and motor of the axis."""
        axis = self.axis
        row, reducer = (axis.drive.motor, axis.drive.reducer) if axis.drive else (None, DIRECT)
        motor = catalogue.motor(MOTOR, "motor of the shuttle", row, axis.torque, axis.turning)
        if reducer.ratio == 1:
            return (motor,)
        return catalogue.reducer(part_id("reducer"), "reducer of the shuttle", reducer, row), motor

    def _drive(self) -> Iterator[Occurrence]:
        """Reducer and motor behind the bar, in line with the right pulley."""
        *geared, motor = self._driven
        rear = self.rear - sum(catalogue.length_of(one) for one in geared)
        return (Occurrence(one, (placement(*self.pulley, rear),)) for one in (*geared, motor))

    def box(self) -> Part:
        """A box of two cells, one above the other, open at its ends: the part's x up, its y to the front."""
        made, play = self.made, self.params.play
        tall, deep, shift = 2 * self.pitch + BOX_WALL, made.depth + play, self.pitch / 2
        cells = tuple(polygon(rectangle(made.width + play, deep).points + side * shift) for side in (-1, 1))
        section, length = Profile(rectangle(tall, deep + 2 * BOX_WALL), cells), made.length + 2 * BOX_END
        return Part(BOX, "box of the shuttles", "welded frame", Prism(section, length), ALUMINIUM)

    def box_position(self, side: int) -> Placement:
        """Where a box lies with its lower cell in line, its floor under the shuttle: at the right (side 1) or left."""
        middle = side * (self.box_end - self.made.length / 2 - BOX_END)
        return placement(y=(self.pitch + self.params.play) / 2).after(along(middle - self.made.length / 2 - BOX_END))

    def slides(self) -> Iterator[Occurrence]:
        """The slides of the boxes on the bar, beside their outer ends, with their steppers above."""
        low, high = -self.row.block - PLAY, self.pitch * 2
        deep = self.made.depth / 2 - self.front
        data = f"slide {in_mm(SLIDE)} wide, belt drive, {catalogue.stroke_of(self.pitch)}, adapter for its motor"
        shape, bought = box(SLIDE, high - low, deep), Bought("slide", length=self.pitch, data=data)
        slide = bought_part(part_id("box-slide"), "slide of a box", "linear axis", shape, bought)
        x = self.box_end + SLIDE / 2
        yield Occurrence(slide, tuple(placement(side * x, (low + high) / 2, self.front) for side in (-1, 1)))
        force = (self.box().mass + 2 * self.made.full) * GRAVITY
        radius = self.axis.pulley_radius
        torque, turning = force * radius, SHIFT_SPEED / radius
        row = smallest_motor(torque, turning, STEPPER)
        motor = replace(catalogue.motor(BOX_MOTOR, "motor of a box", row, torque, turning), fixing=_ON_SLIDE)
        down = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)
        places = (placement(side * x, high, self.front + deep / 2).after(down) for side in (-1, 1))
        yield Occurrence(motor, tuple(places))
