"""The hammer as a tree of bodies: the comb, on vertical axes or on crank-rockers, with its ballast.

Axes: on vertical axes those of the side view, x from the fell to the front, y up, z across; on crank-rockers those of
the linkage (`beat_up.tree`). The middle of the width is at z = 0; bodies lie at rest as at the beat.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.beat_up.beater import across, rectangle
from ilmek.machines.beat_up.parts import depth_of
from ilmek.machines.beat_up.tree import CARRIAGE, crank_frame, crank_rockers, moving, on_rocker, rocker_position
from ilmek.machines.hammer.comb import BAR_ID, BEHIND, LEAF_ID
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.linkage import bracket
from ilmek.machines.hammer.params import STEEL, HammerParams
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.units import mm

COMB = "hammer/comb"
"""Body of the comb."""

AXIS_SIDE = 80 * mm
"""Side of the section of a vertical axis [m]; assumed by this project."""


def tree(hammer: Hammer, motions: Mapping[str, SceneMotion] | None = None) -> Tree:
    """The bodies of a hammer; motions  of them by their ids."""
    bodies = _on_crank_rockers(hammer) if hammer.linkage is not None else _on_axes(hammer)
    return moving(bodies, motions or {})


def outline(params: HammerParams) -> tuple[ComplexArray, ...]:
    """The comb in the side view [m]: its leaves through the warps, the bar in front of their roots, ballast on it."""
    front, deep = params.reach, params.comb_thickness
    comb = rectangle(-BEHIND, front, 0.0, params.leaf_height), rectangle(front, front + deep, 0.0, params.depth)
    ballast = params.ballast or 0.0
    if params.drive != "linkage" or not ballast:
        return comb
    high = ballast / (STEEL.density * params.width * deep)
    return (*comb, rectangle(front, front + deep, params.depth, params.depth + high))


def _comb(hammer: Hammer) -> tuple[Occurrence, ...]:
    """Bar and leaves, the bar's ballast on it; the axes of the side view, 0 where the leaves strike."""
    params, steel = hammer.params, replace(STEEL, density=hammer.params.density)
    leaf, bar, *ballast = outline(params)
    number, wide, middle = params.warps - 1, params.width, (placement(z=-params.width / 2),)
    stations = (np.arange(number) - (number - 1) / 2) * params.warp_pitch - params.leaf / 2
    leaves = across(LEAF_ID, "leaf of the comb", "laser-cut part", leaf, params.leaf, steel)
    comb = (
        Occurrence(across(BAR_ID, "comb of the hammer", "steel bar", bar, wide, steel), middle),
        Occurrence(leaves, tuple(placement(z=float(z)) for z in stations)),
    )
    return (
        *comb,
        *(
            Occurrence(across("hammer/ballast", "ballast of the comb", "steel bar", section, wide), middle)
            for section in ballast
        ),
    )


def _brackets(hammer: Hammer, stations: Sequence[float]) -> Occurrence:
    """Plates beside the rockers, in the axes of the side view: each joins the comb's bar to its rocker."""
    assert hammer.linkage is not None
    one = hammer.linkage.one
    plate = bracket(one.params, hammer.params)
    beside = 0.5 * one.params.thickness
    return Occurrence(plate, tuple(placement(z=beside - z) for z in stations))


@lru_cache(maxsize=4)
def _on_crank_rockers(hammer: Hammer) -> Tree:
    linkage, wide = hammer.linkage, hammer.params.width
    assert linkage is not None
    one, number = linkage.one, linkage.number
    stations = tuple(wide * ((k + 0.5) / number - 0.5) for k in range(number))
    parts = (*_comb(hammer), _brackets(hammer, stations))
    comb = RigidBody(
        COMB,
        tuple(on_rocker(occurrence, one.lengths["beater"]) for occurrence in parts),
        CARRIAGE,
        Joint(JointKind.PIN),
        (rocker_position(one),),
    )
    return Tree(
        (
            crank_frame(one, linkage.beam, linkage.start, stations),
            *crank_rockers(one, CARRIAGE, stations),
            comb,
        )
    )


@lru_cache(maxsize=4)
def _on_axes(hammer: Hammer) -> Tree:
    params, found = hammer.params, hammer.axis
    assert found is not None
    number, drive, load = params.axis_count, found.drive, found.cycle
    torque, speed = float(np.max(np.abs(load.torque))), float(np.max(np.abs(load.speed)))
    row, front = drive.motor if drive else None, params.reach + params.comb_thickness + AXIS_SIDE / 2
    axis = Part(
        "hammer/axis",
        "vertical axis",
        "linear axis",
        params.axis,
        box(AXIS_SIDE, AXIS_SIDE, params.stroke),
        purchase=Bought(params.axis, length=params.stroke),
        envelope=True,
    )
    geared = (
        (catalogue.reducer("hammer/reducer", "reducer of a vertical axis", drive.reducer.ratio, row),) if drive else ()
    )
    motor = catalogue.motor("hammer/motor", "motor of a vertical axis", row, torque, speed)
    edge = params.width / 2 - params.inset
    stations = np.linspace(-edge, edge, number) if number > 1 else np.zeros(1)
    upright = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    top = params.stroke + (depth_of(geared[0]) if geared else 0.0)
    flipped = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)

    def standing(height: float) -> tuple[Placement, ...]:
        return tuple(placement(front, height, float(z)).after(upright) for z in stations)

    axes = RigidBody(
        "hammer/axes",
        (
            Occurrence(axis, standing(0.0)),
            *(Occurrence(part, standing(params.stroke)) for part in geared),
            Occurrence(motor, tuple(placement(front, top, float(z)).after(flipped) for z in stations)),
        ),
        joint=Joint(JointKind.MISSING),
    )
    return Tree((axes, RigidBody(COMB, _comb(hammer), axes.id, Joint(JointKind.SLIDE, (0.0, 1.0, 0.0)))))
