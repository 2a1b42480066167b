"""The loom's parts list: the parts of its machines, its own, and the frame that carries them."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache, partial
from itertools import chain

from ilmek.elements.materials import GRAVITY
from ilmek.elements.prices import PriceRates, price_of, read_prices
from ilmek.machines.arrangement.side_view import RETREAT, SideBox, SideView, below
from ilmek.machines.automated_loom.cabinet import ControlNeeds, control_needs
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.signals import signals_of
from ilmek.machines.automated_loom.feet import foot_for
from ilmek.machines.automated_loom.frame import ROOM, FrameTask, LoomFrame, RailTask, frame_for
from ilmek.machines.automated_loom.frame_modes import sway_checks, sways_slowly
from ilmek.machines.automated_loom.joints import TIPPING, tipping
from ilmek.machines.automated_loom.on_rail import rail_cargo
from ilmek.machines.automated_loom.own_parts import carried_tree, frame_tree
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.shaking import least_frequency
from ilmek.machines.automated_loom.standing_frame import LEVELLING_FOOT, foot_reach
from ilmek.machines.weaver import head_mass
from ilmek.machines.weaver.head_shape import RAIL_AXIS
from ilmek.machines.weaver.tree import least_rail
from ilmek.part.bill import bill, line_of
from ilmek.part.tree import Tree
from ilmek.records import computed, group, record
from ilmek.report import BillLine

_OF_FRAME = ("welded frame", "laser-cut part")
"""Kinds of part whose mass is the frame's."""

_DEPTH = 0.3
"""Feet of the frame to the front and to the back, over its height."""


@record
class PartsList:
    """The parts of a loom, its frame among them, and the prices used."""

    parts: tuple[BillLine, ...]
    prices: Mapping[str, PriceRates]
    frame: LoomFrame = group()

    @computed("1", "axes that motors drive; several on one body drive one axis", name="driven_axes")
    def axes(self) -> int:
        return sum(part.number // part.drives for part in self.parts if part.drives)

    mass = computed("kg", "mass of all parts", lambda it: sum(part.mass_all for part in it.parts))

    @computed("", "price of all parts by the table of prices, in euros unless the prices are others")
    def price(self) -> float:
        return sum(price_of(part, self.prices) for part in self.parts)


def needs_of(loom: LoomDesign, parts: Iterable[BillLine]) -> ControlNeeds:
    """What the cabinet has room for, by the motors of a parts list, each with an amplifier."""
    motors = ((part.kind, part.power, part.number) for part in parts if part.drives)
    return control_needs(motors, len(signals_of(loom.heads, loom.weavers)))


@lru_cache(maxsize=16)
def parts_of_loom(loom: LoomDesign) -> PartsList:
    """The parts list; the feet are so long that the loom does not tip. Raises ParameterError for unreadable prices."""
    prices = read_prices(loom.params.prices)
    machines, on_posts = tuple(_of_machines(loom)), sum(part.mass_all for part in loom.beat.parts)
    task = frame_task(loom, sum(part.mass_all for part in machines) - on_posts)
    listed = _listed(loom, machines, _frame(loom, task), prices)
    tips = tipping(loom, listed.frame)
    if tips is None or tips.value >= TIPPING:
        return listed
    reach = TIPPING / tips.value * min(foot_reach(loom, listed.frame))
    return _listed(loom, machines, _frame(loom, replace(task, depth=reach)), prices)


def _listed(
    loom: LoomDesign, machines: tuple[BillLine, ...], frame: LoomFrame, prices: Mapping[str, PriceRates]
) -> PartsList:
    """The parts list with a frame, and this with its mass and its feet."""
    carried = (*machines, *bill(carried_tree(loom, frame)))
    own = bill(frame_tree(loom, frame, needs_of(loom, carried)))
    load = sum(line.mass_all for line in (*carried, *own)) * GRAVITY / (2 * frame.number)
    mass = sum(line.mass_all for line in own if line.kind in _OF_FRAME)
    frame = replace(frame, mass=mass, foot=foot_for(load), foot_load=load)
    foot = frame.foot.part(LEVELLING_FOOT)
    standing = (line_of(foot, line.number) if line.part == foot.id else line for line in own)
    return PartsList((*carried, *standing), prices, frame)


def _frame(loom: LoomDesign, task: FrameTask) -> LoomFrame:
    """The frame, with more spans of the rail where the supports of those that its parameter sets do not hold."""
    rail = task.rail
    spans = range(rail.spans, 2 * rail.spans + 1) if rail else ()
    offered = [replace(task, rail=rail and replace(rail, spans=number)) for number in spans] or [task]
    frames = (frame_for(task, partial(sway_checks, loom), partial(sways_slowly, loom)) for task in offered)
    first = next(frames)
    return next((frame for frame in chain((first,), frames) if _rail_holds(loom, frame)), first)


def _rail_holds(loom: LoomDesign, frame: LoomFrame) -> bool:
    return all(check.ok for support in rail_supports(loom, frame) for check in support.checks)


def own_lines(loom: LoomDesign, listed: PartsList) -> tuple[BillLine, ...]:
    """The lines of the loom's own parts, of those with the parts of its machines."""
    machines = {
        line.part
        for line in (*chain.from_iterable(machine.parts for machine in loom.machines.values()), *loom.beat.parts)
    }
    return tuple(line for line in listed.parts if line.part not in machines)


def own_tree(loom: LoomDesign) -> Tree:
    """The loom's own bodies that are in none of its machines."""
    listed = parts_of_loom(loom)
    return Tree(
        (*carried_tree(loom, listed.frame).bodies, *frame_tree(loom, listed.frame, needs_of(loom, listed.parts)).bodies)
    )


def built_side(loom: LoomDesign) -> SideView:
    """The side view with the heads' rail as it is built: its section about the axis that the arrangement gives it."""
    heads = loom.side.heads
    if heads is None:
        return loom.side
    rail, side = heads.rail, parts_of_loom(loom).frame.guide[0].side
    size = complex(side, side)
    return replace(loom.side, heads=replace(heads, rail=SideBox(rail.corner + (rail.size - size) / 2, size)))


def frame_task(loom: LoomDesign, carried: float) -> FrameTask:
    """The load of this loom's frame, with the mass that its columns carry [kg]; posts bear crank-rockers."""
    params, cylinder = loom.params, loom.warp_tension
    behind, before = loom.side.column_room
    return FrameTask(
        height=loom.side.loom_height,
        depth=_DEPTH * loom.side.loom_height,
        pull=cylinder.loads.worst,
        lever=abs(loom.side.column),
        carried=carried,
        stress_safety=params.column_safety,
        buckling_safety=params.buckling_safety,
        bow_limit=params.column_bow,
        room=before - behind - 2 * ROOM,
        rail=_rail_task(loom, loom.side.heads.rail) if loom.side.heads else None,
    )


def _rail_task(loom: LoomDesign, rail: SideBox) -> RailTask:
    """The load of the rail of a loom's heads, for which the arrangement keeps a room."""
    params, wide = loom.params, loom.task.rail_length
    return RailTask(
        width=wide,
        spans=math.ceil(wide / params.rail_span - 1e-9),
        heads=loom.heads,
        head_mass=head_mass(loom.weaver),
        head_width=loom.head_width,
        sag_limit=params.rail_sag,
        drop=_rail_drop(loom, rail),
        frequency=least_frequency(loom),
        least=least_rail(loom.weaver, params.clearance),
        cargo=partial(rail_cargo, loom),
    )


def _rail_drop(loom: LoomDesign, rail: SideBox) -> float:
    """How far axes of the retreat before the rail lie below it, so that what beats passes above their ends [m]."""
    end = (rail.corner + rail.size / 2).imag - rail.size.real / 2 * RETREAT.imag + RAIL_AXIS / 2 * RETREAT.real
    return max(0.0, end + below(loom.beat.path) + loom.params.clearance)


def _of_machines(loom: LoomDesign) -> Iterator[BillLine]:
    """The parts of the machines, as many as there are, and those of the beat."""
    for child in loom.machines.values():
        for part in child.parts:
            yield part if child.number == 1 else replace(part, number=child.number * part.number)
    yield from loom.beat.parts
