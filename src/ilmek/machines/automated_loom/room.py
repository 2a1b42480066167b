"""Whether all that moves in a loom has room: the least clearance of every two bodies over both cyclograms."""

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.arrangement.clearances import BodyDistance, MovingBody, least_clearances, samples
from ilmek.machines.automated_loom.bodies import (
    BACK_REST,
    BAR,
    CARPET,
    CARRIER,
    COMPENSATOR,
    GUIDE_CAMS,
    HEAD,
    LEAVES,
    LOWER,
    MAGAZINE,
    RAIL,
    SPACER,
    UPPER,
    WARPS,
    beat_joints,
    knot_bodies,
    row_bodies,
)
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import part_id as loom_part
from ilmek.machines.automated_loom.parts import built_side, parts_of_loom
from ilmek.machines.beat import GUIDED
from ilmek.machines.shedding.stack import part_id as shedding_part
from ilmek.machines.tension_compensator.members import part_id as compensator_part
from ilmek.machines.warp_tension.cylinders import part_id as cylinder_part
from ilmek.machines.weaver.head_shape import LOWER_PLATE, SLEY_TOOL, UPPER_PLATE
from ilmek.machines.weaver.motions import LEFT_ARM, RIGHT_ARM
from ilmek.machines.weaver.parts import TUBE, case_plates
from ilmek.machines.weaver.tool_parts import CENTRE_GRIPPER, OPENER_PLATE, SIDE_GRIPPER, SLEY_BAR
from ilmek.machines.weft import Shuttle
from ilmek.machines.weft.carriers import RAPIER_TUBE, SHUTTLE_WOOD
from ilmek.records import record
from ilmek.report import Check, Table, at_least, columns
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import joints
from ilmek.units import deg, mm

HORIZON = 50 * mm
"""Bodies that are always farther apart are not reported [m]."""

TOOLS = ("side grippers", LEFT_ARM, RIGHT_ARM, "centre gripper", UPPER_PLATE, LOWER_PLATE, SLEY_TOOL)
SHEETS = (EVEN, ODD, WARPS)

_GROOVES = "warps run in the grooves between the guide cams"
_BETWEEN = "a leaf stands between two warps"
_IN_THE_WARPS = "a tool reaches between the opened warps: plan view of the head"

TOUCHING: Mapping[frozenset[str], str] = {
    **{frozenset((GUIDE_CAMS, sheet)): _GROOVES for sheet in SHEETS},
    **{frozenset((LEAVES, sheet)): _BETWEEN for sheet in SHEETS},
    **{frozenset((BACK_REST, sheet)): "warps run over the back rest" for sheet in SHEETS},
    **{frozenset((CARPET, sheet)): "warps end in the carpet" for sheet in SHEETS},
    frozenset((EVEN, ODD)): "the sheets cross where the shed changes",
    frozenset((LEAVES, BAR)): "one part",
    frozenset((LEAVES, CARPET)): "the comb beats the fell",
    frozenset((CARPET, SPACER)): "the carpet runs down the spacer",
    frozenset((CARPET, LOWER)): "the carpet is wound on the lower cylinder",
    **{frozenset((WARPS, tool)): _IN_THE_WARPS for tool in TOOLS},
    frozenset((SLEY_TOOL, CARPET)): "the sley pushes the knot to the fell",
    **{frozenset(pair): "plan view of the head" for pair in combinations((*TOOLS, HEAD), 2)},
    **{frozenset((COMPENSATOR, sheet)): "warps run through the compensator" for sheet in SHEETS},
    frozenset((COMPENSATOR, BACK_REST)): "warps run from one to the other",
    frozenset((HEAD, RAIL)): "the rail carries the heads",
    **{frozenset((part, RAIL)): "the rail carries the heads" for part in (*TOOLS, MAGAZINE)},
    **{frozenset((part, MAGAZINE)): "the head carries its magazine" for part in (*TOOLS, HEAD)},
}
"""Pairs that may touch, by intention, and why."""

FRAME = frozenset((CARPET, BACK_REST, COMPENSATOR, UPPER, SPACER, LOWER))
"""What stands, and need not clear its like by more than nothing."""

CURES: Mapping[str, str] = {
    "weft's carrier": "set a larger lift, or a smaller weft.bobbin_diameter",
    GUIDE_CAMS: "leave the spans of the shed open, or set a smaller lift",
    HEAD: "set a larger clearance",
}


@record
class RoomFound:
    """The least clearance of two bodies over both cyclograms, and the cyclogram in which it occurs."""

    distance: BodyDistance
    cyclogram: str


def clearances(loom: LoomDesign) -> tuple[RoomFound, ...]:
    """The least clearance of every two bodies that must not touch, the least of both cyclograms."""
    (knot, row), side = loom.cyclograms, built_side(loom)
    found: dict[frozenset[str], RoomFound] = {}
    for cyclogram, bodies in (
        (row, row_bodies(side, row, loom.beat.path, stack=loom.params.beat == GUIDED)),
        (knot, knot_bodies(side, knot)),
    ):
        ends = beat_joints(loom.beat.path, row) if cyclogram is row else np.empty(0)
        for clearance in _of_cyclogram(cyclogram, bodies, ends, loom.params.clearance):
            pair = frozenset((clearance.first, clearance.second))
            if pair not in found or clearance.value < found[pair].distance.value:
                found[pair] = RoomFound(clearance, cyclogram.name)
    return tuple(sorted(found.values(), key=lambda one: one.distance.value))


def _of_cyclogram(
    cyclogram: Cyclogram, bodies: tuple[MovingBody, ...], nodes: FloatArray, limit: float
) -> tuple[BodyDistance, ...]:
    ends = [*nodes.tolist(), *(angle for body in bodies for window in body.windows for angle in window)]
    angles = samples([*ends, *(angle for track in cyclogram.tracks for angle in joints(track).tolist())])
    return least_clearances(bodies, angles, limit, TOUCHING, HORIZON)


def room_checks(loom: LoomDesign, found: tuple[RoomFound, ...], column: float) -> tuple[Check, ...]:
    """The clearances against the least that is allowed; the carrier runs out in front of the columns.

    column  side of the columns' section [m]
    """
    view, limit = loom.side, loom.params.clearance
    gap = view.carrier.corner.real - view.column - column / 2
    columns_clear = at_least(
        f"clearance: {CARRIER} and columns",
        gap,
        limit,
        "mm",
        "parameter clearance, assumed by this project; at both ends of its run",
        cure="set a lower tension, for lighter columns",
        parts=body_parts(loom)[CARRIER],
    )
    parts = body_parts(loom)
    return (*(_check(one, limit, parts) for one in found), columns_clear)


def body_parts(loom: LoomDesign) -> Mapping[str, tuple[str, ...]]:
    """Ids of the parts of the bodies by the bodies' names, of those that the loom has."""
    tied = {} if loom.weaver.params.with_arms else {"side grippers": SIDE_GRIPPER, "centre gripper": CENTRE_GRIPPER}
    carrier = SHUTTLE_WOOD if isinstance(loom.weft.carried, Shuttle) else RAPIER_TUBE
    single = {
        **tied,
        UPPER_PLATE: OPENER_PLATE,
        LOWER_PLATE: OPENER_PLATE,
        SLEY_TOOL: SLEY_BAR,
        MAGAZINE: TUBE,
        CARRIER: carrier,
        RAIL: loom_part("rail"),
        BACK_REST: loom_part("back-rest"),
        UPPER: cylinder_part("cylinder"),
        LOWER: cylinder_part("cylinder"),
        SPACER: cylinder_part("spacer"),
    }
    leaves, *bar = loom.beat.striking
    several = {
        LEAVES: (leaves,),
        BAR: tuple(bar),
        HEAD: case_plates(loom.weaver),
        GUIDE_CAMS: tuple(shedding_part(name) for name in ("guide-cam", "reed-dent", "shedding-cam")),
        COMPENSATOR: tuple(compensator_part(name) for name in ("bar", "lever", "rod", "spring", "beam")),
    }
    listed = {line.part for line in parts_of_loom(loom).parts}
    every = several | {name: (part,) for name, part in single.items()}
    return {name: tuple(part for part in parts if part in listed) for name, parts in every.items()}


def _check(found: RoomFound, limit: float, bodies: Mapping[str, tuple[str, ...]]) -> Check:
    one = found.distance
    where = f"parameter clearance, assumed by this project; least at {one.angle / deg:.1f} deg of a {found.cyclogram}"
    names = (one.first, one.second)
    limit = 0.0 if FRAME.issuperset(names) else limit
    cure = next((CURES[name] for name in CURES if name in names), "leave the spans of the shed open")
    parts = tuple(dict.fromkeys(part for name in names for part in bodies.get(name, ())))
    name = f"clearance: {one.first} and {one.second}"
    return at_least(name, one.value, limit, "mm", where, cure=cure, parts=parts)


def room_tables(found: tuple[RoomFound, ...]) -> tuple[Table, ...]:
    """Least clearances, and the bodies that may touch with the reasons."""
    bodies = ((one.distance, one.cyclogram) for one in found)
    near = tuple((one.first, one.second, one.value, name, one.angle) for one, name in bodies)
    touching = tuple((*sorted(pair), why) for pair, why in TOUCHING.items())
    return (
        Table("loom-room", "Least clearances", columns("body", "and", "least [mm]", "cyclogram", "at [deg]"), near),
        Table("loom-touching", "Bodies that may touch", columns("body", "and", "why"), touching),
    )
