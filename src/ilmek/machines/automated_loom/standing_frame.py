"""The frame as one body: columns, beams and feet, brackets, back rest, the cabinet of the control.

Axes of the scene: x along the width, 0 in the middle of the cloth, y up from the fell, z to the front. The columns
stand outside of all bearings; a bracket that ends before a column's face has a spacer of the column's section between.
"""

import cmath
import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

from ilmek.elements.columns import STEEL
from ilmek.elements.tubes import TUBES, Tube
from ilmek.machines.automated_loom.brackets import Bracket, Brackets, CarriedBeam, brackets_of, compensator_beams
from ilmek.machines.automated_loom.cabinet import ControlNeeds, control_parts
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.feet import FOOT, PLATE
from ilmek.machines.automated_loom.frame import END_PLATE, ROOM, LoomFrame, end_plate, member, part_id, welded_to
from ilmek.machines.automated_loom.rail_supports import rail_supports, support_parts
from ilmek.machines.automated_loom.steady_posts import cam_beam, cam_beam_section, steady_posts
from ilmek.machines.automated_loom.supports import base_section, floor_top, post_depth, support_bodies
from ilmek.part.part import LASER_CUT, WELDED, Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, UPRIGHT, Placement, placement
from ilmek.part.shapes import Drilling, Prism, box, tube
from ilmek.part.tree import Occurrence, RigidBody
from ilmek.units import mm

SPINDLE_PLAY = 2 * mm
"""Of the hole in a foot over the spindle that is screwed up into it [m]; assumed by this project."""

LEVELLING_FOOT = part_id("levelling-foot")
"""Id of the feet on the floor."""

_PACKED, _PAST = 30 * mm, 12 * mm
"""Spacers that are shorter are plates: the welds at both ends of a tube have no room beside each other; how far such a
plate stands out past a column where it has room, for the weld between [m].
"""

_LEAST = 0.05 * mm
"""Thinner spacers are left out, and posts that are nearer to each other stand on one beam [m]."""


def back_rest_tube(loom: LoomDesign) -> Tube:
    """The tube of the back rest: the thickest of the stock of its diameter."""
    outer = 2 * loom.side.back_rest.radius
    return max(TUBES.values(), key=lambda row: (-abs(row.outer - outer), row.wall))


def standing_frame(loom: LoomDesign, frame: LoomFrame, needs: ControlNeeds) -> RigidBody:
    """Two columns with their feet and brackets, the beams across between them, posts under a rail of several spans.

    needs  of the control
    """
    brackets = brackets_of(loom)
    parts = (
        *_uprights(loom, frame, brackets),
        *_across(loom, frame, brackets),
        *_feet(loom, frame, brackets),
        *(own for plate in brackets.plates for own in _bracket(loom, frame, brackets, plate)),
        *_carried(loom, brackets),
        *control_parts(
            brackets.face + frame.column.side,
            loom.side.floor,
            loom.side.column - frame.column.side / 2 - frame.task.depth,
            needs,
        ),
        *support_bodies(loom, frame, brackets.face),
        *steady_posts(loom, frame, brackets),
    )
    return RigidBody(part_id("frame"), parts)


def _uprights(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    side, section = loom.side, frame.column
    under = side.floor + FOOT
    yield _placed(
        member("column", "column of the frame", section, side.top - under),
        (placement(x, under, side.column).after(UPRIGHT) for x in _both(frame.beside(made.face))),
    )
    yield from support_parts(loom, frame)


def _front_depths(loom: LoomDesign, frame: LoomFrame) -> tuple[float, ...]:
    """Axes of the beams across before the columns, on which posts of the beat and of the rail stand [m]."""
    own = (support.depth for support in rail_supports(loom, frame) if support.name != "rail-post")
    depths: list[float] = []
    for depth in (post_depth(loom, frame), *own):
        if all(abs(depth - other) > _LEAST for other in depths):
            depths.append(depth)
    return tuple(depths)


def _front(loom: LoomDesign, frame: LoomFrame) -> float:
    """Axis of the last of what stands before the columns, in the side view [m]."""
    heads, posts = loom.side.heads, max(_front_depths(loom, frame))
    if heads is None:
        return posts
    rail: float = (heads.rail.corner + heads.rail.size).real + heads.retreat
    return max(rail + frame.column.side / 2, posts)


def _before_the_roll(loom: LoomDesign, frame: LoomFrame) -> tuple[float, bool]:
    """Axis of the beam at the floor in the side view [m]: between the columns, or behind the full roll of carpet where
    that reaches so low, and behind the columns.
    """
    side, half, column = loom.side, base_section(loom, frame).side / 2, loom.side.column
    behind = side.lower.at.real - side.roll - ROOM - half
    under = floor_top(loom, frame) <= side.lower.at.imag - side.roll - ROOM
    if under or column <= behind:
        return column, True
    return min(behind, column - frame.column.side / 2 - half), False


def _across(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """Beams between the columns: at the floor, behind the cams between the brackets, at the front under the posts."""
    side, section, base = loom.side, frame.column, base_section(loom, frame)
    low = side.floor + FOOT + base.side / 2
    middle, behind_cams = cam_beam(loom, frame, made), cam_beam_section(frame, made)
    front = [(low, depth) for depth in _front_depths(loom, frame)]
    rear, between_columns = _before_the_roll(loom, frame)
    between = 2 * made.face + section.side - base.side  # the feet stand in the middle of the columns' sections
    closed = 2 * made.face - 2 * END_PLATE
    plate = end_plate("beam-plate", "plate of an end of the beam across", behind_cams)  # it may lie beside the columns
    yield _placed(plate, (placement(x, middle.imag, middle.real).after(ALONG_WIDTH) for x in (-made.face, closed / 2)))
    for name, title, chosen, own, long in (
        ("beam", "beam across", behind_cams, [(middle.imag, middle.real)], closed),
        ("floor-beam", "beam across at the floor", base, [(low, rear)], 2 * made.face if between_columns else between),
        ("front-beam", "beam across between the front feet", base, front, between),
    ):
        places = [placement(-long / 2, y, z).after(ALONG_WIDTH) for y, z in own]
        yield _placed(member(name, title, chosen, long), places)


def foot_reach(loom: LoomDesign, frame: LoomFrame) -> tuple[float, float]:
    """Levelling feet behind and before the columns' axis [m]; before it not nearer than behind it."""
    return frame.task.depth, max(_front(loom, frame) - loom.side.column, frame.task.depth)


def _feet(loom: LoomDesign, frame: LoomFrame, made: Brackets) -> Iterator[Occurrence]:
    """Feet to the back and to the front, under what stands before the heads, on levelling feet at their ends."""
    side, section, base = loom.side, frame.column, base_section(loom, frame)
    edge, low = section.side / 2, side.floor + FOOT + base.side / 2
    stations = tuple(_both(frame.beside(made.face)))
    rear, front = foot_reach(loom, frame)
    lengths = (
        ("rear-foot", "rear foot of the frame", rear, side.column - edge - rear, edge),
        ("front-foot", "front foot of the frame", front, side.column + edge, front - edge),
    )
    for name, title, long, start, spindle in lengths:
        foot = member(name, title, base, long)
        mouth = placement(0.0, -base.side / 2, spindle, about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
        hole = Drilling(mouth, ((frame.foot.screw + SPINDLE_PLAY, base.wall),), through=True)
        assert isinstance(foot.shape, Prism)
        foot = replace(foot, shape=replace(foot.shape, drilled=(hole,)))
        yield _placed(foot, (placement(x, low, start) for x in stations))
    ends = (side.column - rear, side.column + front)
    for part, y in (
        (frame.foot.part(LEVELLING_FOOT), side.floor),
        (frame.foot.plate(part_id("foot-plate"), base.side), side.floor + FOOT - PLATE),
    ):
        yield _placed(part, (placement(x, y, z).after(UPRIGHT) for x in stations for z in ends))


def _bracket(loom: LoomDesign, frame: LoomFrame, made: Brackets, one: Bracket) -> Iterator[Occurrence]:
    """A bracket on both sides, and its spacers to the columns."""
    part = Part(part_id(one.name), one.title, "laser-cut part", one.plate, STEEL, machined=True)
    yield _placed(part, (placement(x).after(IN_SIDE_VIEW) for x in (-one.inner, one.outer)))
    gap = made.face - one.outer
    section = welded_to(frame, one.depth)
    if gap > _LEAST:
        name, title = f"{one.name}-spacer", f"spacer of the {one.title}"
        if gap < _PACKED:
            behind, before = loom.side.column_room
            wide = min(frame.column.side + 2 * _PAST, before - behind - 2 * ROOM)
            packing = box(section.side, wide, gap)
            spacer = Part(part_id(name), title, LASER_CUT, shape=packing, material=STEEL, joins=(part.id,))
        else:
            spacer = member(name, title, section, gap)
        height = sum(one.ends) / 2
        yield _placed(
            spacer, (placement(x, height, loom.side.column).after(ALONG_WIDTH) for x in (one.outer, -made.face))
        )


def _carried(loom: LoomDesign, made: Brackets) -> Iterator[Occurrence]:
    """The back rest on its beam, and the ends of the compensator's beams, all between the upper brackets."""
    inner, wide, rest = made.upper.inner, loom.task.width, loom.side.back_rest.at
    section = back_rest_tube(loom)
    shape = tube(section.outer, section.wall, wide)
    roller = Part(part_id("back-rest"), "back rest", WELDED, shape, STEEL)
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


def _both(sides: Iterable[float]) -> Iterator[float]:
    """Distances from the middle to both sides [m]."""
    return (x for side in sides for x in (-side, side))


def _placed(part: Part, positions: Iterable[Placement]) -> Occurrence:
    return Occurrence(part, tuple(positions))
