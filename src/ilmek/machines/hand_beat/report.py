"""Checks of the beat by hand, its tree and its figures."""

import numpy as np

from ilmek.dynamics.animation import frames
from ilmek.elements.materials import GRAVITY
from ilmek.machines.hand_beat.design import STRENGTH, HandBeat
from ilmek.machines.hand_beat.tools import DEEP, SHELF, comb_parts, comb_wide, part_id, shelf_length, tool_bodies
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.tree import Tree
from ilmek.report import (
    Animation,
    Axis,
    Check,
    Dot,
    Drawing,
    Figure,
    MovingStroke,
    Plot,
    Reading,
    Series,
    Stroke,
    at_least,
    at_most,
)
from ilmek.units import format_quantity, turn

ROW_TOLERANCE = 0.02
"""Share by which rows may be left farther apart; as `row_tolerance` of a loom."""


def tree(beat: HandBeat, shelf: Placement = IDENTITY) -> Tree:
    """The shelf with the tools on it; shelf  its axes."""
    comb = comb_parts(beat.params, beat.leaf, beat.warps)
    return Tree(tuple(tool_bodies(shelf, comb, comb_wide(beat.params, beat.warps))))


def checks(beat: HandBeat) -> tuple[Check, ...]:
    """Rows, energy of a blow, mass, leaves between the warps and their strength, the shelf."""
    params, cloth = beat.params, beat.params.cloth
    gap = cloth.warp_pitch - cloth.carpet_yarns.warp.diameter
    comb, leaf = (part_id("comb-head"),), (part_id("comb-leaf"),)
    yields = "yield of S235 over 1.5; assumed"
    most = cloth.row_distance * (1 + ROW_TOLERANCE)
    return (
        at_most(
            "distance of the rows that the blows leave", beat.row_pitch_left, most, "mm", "row pitch, 2 % more"
        ).with_cure("set a narrower comb_width, more most_blows, or a coarser quality along", *comb),
        at_least("blow: force of a warp", beat.blow_force, beat.beat_force_needed, "N", "for the rows").with_cure(
            "set a narrower comb_width, more most_blows, or a lower tension", *comb
        ),
        at_most("mass of the comb", beat.mass, params.mass_limit, "kg", "parameter mass_limit, assumed").with_cure(
            "set a narrower comb_width, or a smaller head", *comb
        ),
        at_most("leaf between two warps", beat.leaf, gap, "mm", "gap of the warps").with_cure(
            "set a thinner leaf", *leaf
        ),
        at_most("stress of a leaf", beat.leaf_stress, STRENGTH, "MPa", yields).with_cure(
            "set a higher leaf_height, or a shorter reach", *leaf
        ),
        at_most(
            "stress of the shelf", shelf_stress(beat), STRENGTH, "MPa", "yield of S235 over 1.5; assumed"
        ).with_cure("set a narrower comb", part_id("shelf")),
    )


def shelf_stress(beat: HandBeat) -> float:
    """Stress of the shelf at its rear edge [Pa]: tools and plate in half of its depth, 6 m g (d / 2) / (l s²)."""
    mass = tree(beat).mass
    return 6 * mass * GRAVITY * DEEP / 2 / (shelf_length(comb_wide(beat.params, beat.warps)) * SHELF**2)


def figures(beat: HandBeat) -> tuple[Figure, ...]:
    """Rows over the energy of a blow of the comb, and the blow."""
    fabric, full = beat.fabric, beat.blow_energy / beat.warps
    energy = np.linspace(full / 50, full, 50)
    left = np.array([float(fabric.spacing(fabric.struck(float(one)))) for one in energy])
    pitch = beat.params.cloth.row_distance
    series = (
        Series("after one blow", energy * beat.warps, left),
        Series("required", np.array([0.0, full * beat.warps]), np.full(2, pitch), dashed=True),
    )
    note = f"comb of {format_quantity(beat.mass, 'kg', 3)} at {format_quantity(beat.params.hands.blow_speed, 'm/s')}"
    axes = Axis("energy of the blow", "J"), Axis("distance of rows", "mm")
    plot = Plot("hand-beat-rows", "Rows by the energy of a blow of the comb", *axes, series, note=note)
    return (_moving(beat), plot)


def _moving(beat: HandBeat) -> Animation:
    """A blow from the side: the comb falls evenly accelerated on the laid row, and packs it, is lifted."""
    params, fabric, at = beat.params, beat.fabric, frames()
    fall = params.hands.blow_speed**2 / (2 * GRAVITY)  # as far as it would fall freely to that speed
    packed = fabric.laid - float(fabric.travel(beat.forces[0]))
    down, lift = np.clip(at / turn / _DOWN, 0.0, 1.0), np.clip((at / turn - _PACKED) / (1 - _PACKED), 0.0, 1.0)
    pressed = np.clip((at / turn - _DOWN) / (_PACKED - _DOWN), 0.0, 1.0)
    tip = fall + (fabric.laid - fall) * down**2 + (packed - fabric.laid) * pressed + (fall - packed) * lift
    corners = np.array([0.0, params.reach, params.reach, 0.0]) + 1j * params.leaf_height * np.array([0, 0, 1, 1])
    head = params.reach + np.array([0.0, params.head_depth, params.head_depth, 0.0])
    head = head + 1j * params.head_height * np.array([0, 0, 1, 1])
    lines = (
        MovingStroke(1j * tip[:, None] + corners, "outline", "leaves", closed=True),
        MovingStroke(1j * tip[:, None] + head, "link", "head", closed=True),
    )
    row = Stroke(np.array([0.0, params.reach]) + 1j * fabric.laid, "construction", "laid row")
    warps = Stroke(np.array([0j, 1j * (fall + params.leaf_height)]), "yarn", "warps")
    note = "from the side; at the end of the fall the comb packs the row"
    still = Drawing("hand-beat-moving", "A blow of the comb", (row, warps), (Dot(0j, "fell", "point"),), note=note)
    return Animation(still, Axis("blow", "deg"), at, lines, (), readings=(Reading("tip over the fell", tip, "mm"),))


_DOWN, _PACKED = 0.5, 0.6
"""Shares of the picture after which the comb is on the laid row, and has packed it."""
