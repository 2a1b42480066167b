"""The frame as one body: columns, beams and feet, brackets, back rest, the cabinet of the control.

Axes of the scene: x along the width, 0 in the middle of the cloth, y up from the fell, z to the front. The columns
stand outside of all bearings; a bracket that ends before a column's face has a spacer of the column's section between.
"""

import cmath
from collections.abc import Iterable, Iterator

from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.tubes import TUBES, Tube
from ilmek.machines.automated_loom.brackets import ROOM, Bracket, Brackets, CarriedBeam, brackets_of, compensator_beams
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import FOOT, LEVELLING, PAD, LoomFrame, member, part_id
from ilmek.machines.automated_loom.supports import base_section, post_depth, support_bodies, within
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.part.part import Bought, Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, box, rectangle, stepped, tube
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.units import format_quantity, mm

CABINET, WALL = (0.8, 1.0, 0.3), 2 * mm
"""Least width, height and depth of the control's cabinet, and its wall [m]; assumed by this project."""

_MODULE, _MODULE_PITCH, _MODULE_ROWS = (40 * mm, 170 * mm, 160 * mm), (50 * mm, 230 * mm), 4
"""Width, height and depth of an axis' amplifier in the cabinet [m], distances of neighbours, rows; assumed."""

_MASS = 1.1
"""Mass of a levelling foot [kg]: that of its shape in steel, rounded up."""

_LEAST = 0.05 * mm
"""Thinner spacers are left out [m]."""


def back_rest_tube(loom: LoomDesign) -> Tube:
    """The tube of the back rest: the thickest of the stock of its diameter."""
    outer = 2 * loom.side.back_rest.radius
    return max(TUBES.values(), key=lambda row: (-abs(row.outer - outer), row.wall))


def standing_frame(loom: LoomDesign, frame: LoomFrame, axes: int) -> RigidBody:
    """Two columns with their feet and brackets, the beams across between them, posts under a rail of several spans.

    axes  of the control
    """
    made = brackets_of(loom)
    return RigidBody(
        part_id("frame"),
        (
            *_uprights(loom, frame, made),
            *_across(loom, frame, made),
            *_feet(loom, frame, made),
            *(own for one in made.plates for own in _bracket(loom, frame, made, one)),
            *_carried(loom, made),
            *_control(loom, frame, made, axes),
            *support_bodies(loom, frame, made.face),
        ),
    )


def _uprights(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    side, section = loom.side, frame.column
    beside, under = made.face + section.side / 2, side.floor + FOOT
    yield _placed(
        member("column", "column of the frame", section, side.top - under),
        (placement(x, under, side.column).after(UPRIGHT) for x in (-beside, beside)),
    )
    yield from _rail_posts(loom, frame, made)
    spans, wide = frame.task.rail_spans, frame.task.width
    if spans > 1:
        middles = ((k / spans - 0.5) * wide for k in range(1, spans))
        yield _placed(
            member("post", "post of the rail", section, frame.task.height / 2),
            (
                placement(x, under + base_section(loom, frame).side, _front(loom, section)).after(UPRIGHT)
                for x in middles
            ),
        )


def _rail_posts(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """Posts on the front feet, and the arms by which they carry the axes of the rail's retreat."""
    side, section = loom.side, frame.column
    bottom, axis = side.floor + FOOT + base_section(loom, frame).side, side.rail.corner + side.rail.size / 2
    beside, depth = made.face + section.side / 2, axis.real + RAIL_AXIS / 2 - section.side / 2
    post = member("rail-post", "post of the rail's axes", section, axis.imag - bottom)
    yield _placed(post, (placement(x, bottom, depth).after(UPRIGHT) for x in (-beside, beside)))
    near = loom.task.width / 2 + RAIL_AXIS
    arm = member("rail-arm", "arm of the rail's axes", HollowSquare(RAIL_AXIS, 3 * mm), made.face - near)
    yield _placed(arm, (placement(x, axis.imag, axis.real).after(ALONG_WIDTH) for x in (near, -made.face)))


def _front(loom: LoomDesign, section: HollowSquare) -> float:
    """Axis of what stands before the retreated rail and under the beat's beam, in the side view [m]."""
    rail = (loom.side.rail.corner + loom.side.rail.size).real + loom.side.retreat
    return max(rail + section.side / 2, post_depth(loom))


def _across(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """Beams between the columns: at the floor, behind the cams between the brackets, at the front under the posts."""
    side, section, base = loom.side, frame.column, base_section(loom, frame)
    low = side.floor + FOOT + base.side / 2
    spacer, _, *of_cams = made.shafts
    lowest = min(float(one.nodes.imag.min()) - one.radius for one in of_cams)
    highest = float(spacer.nodes.imag.max()) + spacer.radius
    between_brackets = within(section, lowest - highest - 2 * ROOM)
    behind = min(cam.at.real - cam.guide_radius for cam in side.cams) - ROOM - between_brackets.side / 2
    front = [(low, post_depth(loom))]
    if frame.task.rail_spans > 1:
        front.append((low, _front(loom, section)))
    between = 2 * made.face + section.side - base.side  # the feet stand in the middle of the columns' sections
    for name, title, chosen, own, long in (
        (
            *("beam", "beam across", between_brackets),
            [((highest + lowest) / 2, min(side.column, behind))],
            2 * made.face,
        ),
        ("floor-beam", "beam across at the floor", base, [(low, side.column)], 2 * made.face),
        ("front-beam", "beam across between the front feet", base, front, between),
    ):
        places = [placement(-long / 2, y, z).after(ALONG_WIDTH) for y, z in own]
        yield _placed(member(name, title, chosen, long), places)


def _feet(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """Feet to the back and to the front, under what stands before the heads, on levelling feet at their ends."""
    side, section, base = loom.side, frame.column, base_section(loom, frame)
    edge, beside, low = section.side / 2, made.face + section.side / 2, side.floor + FOOT + base.side / 2
    rear, front = frame.task.depth, _front(loom, section) + edge - side.column - edge
    lengths = (
        ("rear-foot", "rear foot of the frame", rear, side.column - edge - rear),
        ("front-foot", "front foot of the frame", front, side.column + edge),
    )
    for name, title, long, start in lengths:
        yield _placed(member(name, title, base, long), (placement(x, low, start) for x in (-beside, beside)))
    shape, bought = stepped(PAD, LEVELLING), Bought("M20", _MASS)
    foot = Part(part_id("levelling-foot"), "levelling foot", "pin or bush", shape=shape, purchase=bought, envelope=True)
    ends = (side.column - rear, side.column + front)
    yield _placed(foot, (placement(x, side.floor, z).after(UPRIGHT) for x in (-beside, beside) for z in ends))


def _bracket(loom: LoomDesign, frame: LoomFrame, made: Brackets, one: Bracket) -> Iterator[Occurrence]:
    """A bracket on both sides, and its spacers to the columns."""
    size = f"plate {format_quantity(one.outer - one.inner, 'mm')}, {format_quantity(one.depth, 'mm')} high"
    part = Part(part_id(one.name), one.title, "laser-cut part", size, one.plate, STEEL)
    yield _placed(part, (placement(x).after(IN_SIDE_VIEW) for x in (-one.inner, one.outer)))
    gap, section = made.face - one.outer, frame.column
    if gap > _LEAST:
        spacer = member(f"{one.name}-spacer", f"spacer of the {one.title}", section, gap)
        height = float(one.nodes.imag.mean())
        yield _placed(
            spacer,
            (placement(x, height, loom.side.column).after(ALONG_WIDTH) for x in (one.outer, -made.face)),
        )


def _carried(loom: LoomDesign, made: Brackets) -> Iterator[Occurrence]:
    """The back rest on its beam, and the ends of the compensator's beams, all between the upper brackets."""
    inner, wide, rest = made.upper.inner, loom.task.width, loom.side.back_rest.at
    section = back_rest_tube(loom)
    shape = tube(section.outer, section.wall, wide)
    roller = Part(part_id("back-rest"), "back rest", "steel tube", f"tube {section.name} mm", shape, STEEL)
    yield _placed(roller, (placement(-wide / 2, rest.imag, rest.real).after(ALONG_WIDTH),))
    beam = member("back-rest-beam", "beam of the back rest", made.beam, 2 * inner)
    yield _placed(beam, (placement(-inner, made.rest.imag, made.rest.real).after(ALONG_WIDTH),))
    carried = compensator_beams(loom)
    if carried:
        half = loom.task.cloth.width / 2
        end = member("beam-end", "end of a compensator's beam", carried[0].section, inner - half)
        yield _placed(end, (own for one in carried for own in _ends(one, half, inner)))


def _ends(beam: CarriedBeam, half: float, inner: float) -> Iterator[Placement]:
    """Both ends of a beam from the middle machine's width to the brackets, turned as the beam."""
    turned = placement(about=(0.0, 0.0, 1.0), angle=cmath.phase(beam.side))
    for x in (half, -inner):
        yield placement(x, beam.axis.imag, beam.axis.real).after(ALONG_WIDTH).after(turned)


def _control(loom: LoomDesign, frame: LoomFrame, made: Brackets, axes: int) -> Iterator[Occurrence]:
    """The cabinet on the floor behind a rear foot, bolted to it, with the amplifiers row by row on its wall there."""
    columns, (across, upwards), (least, high, deep) = -(-axes // _MODULE_ROWS), _MODULE_PITCH, CABINET
    wide = max(least, columns * across + 2 * WALL)
    inside = rectangle(wide - 2 * WALL, high - 2 * WALL)
    sides = Prism(Profile(rectangle(wide, high), (inside,)), deep)
    shape = Sum((Placed(sides), Placed(Prism(Profile(inside), WALL), (placement(z=deep - WALL),))))
    control = Part(part_id("control"), "control", "control", shape=shape, purchase=Bought("cabinet"), envelope=True)
    module = Part(
        part_id("control-axis"),
        "axis of the control",
        "axis of the control",
        "amplifier, cable, switch",
        box(*_MODULE),
        purchase=Bought("amplifier"),
        envelope=True,
    )
    rear = loom.side.column - frame.column.side / 2 - frame.task.depth
    x, y = made.face + frame.column.side - wide / 2, loom.side.floor + high / 2
    yield Occurrence(control, (placement(x, y, rear - deep),))
    if axes:
        yield Occurrence(
            module,
            tuple(
                placement(
                    x + (number % columns - (columns - 1) / 2) * across,
                    y + (number // columns - (_MODULE_ROWS - 1) / 2) * upwards,
                    rear - WALL - _MODULE[2],
                )
                for number in range(axes)
            ),
        )


def _placed(part: Part, positions: Iterable[Placement]) -> Occurrence:
    return Occurrence(part, tuple(positions))
