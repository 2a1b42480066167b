"""The hammer as a tree of bodies: the comb, on vertical axes or on crank-rockers, with its ballast.

Axes: on vertical axes those of the side view, x from the fell to the front, y up, z across; on crank-rockers those of
the linkage (`beat_up.tree`). The middle of the width is at z = 0; bodies lie at rest as at the beat.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.beat_up.crank_start import start_parts
from ilmek.machines.beat_up.parts import depth_of
from ilmek.machines.beat_up.tree import CARRIAGE, crank_frame, crank_rockers, moving, on_rocker, rocker_position
from ilmek.machines.hammer.comb import BAR_ID, BEHIND, LEAF_ID
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.params import STEEL, HammerParams
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import polygon
from ilmek.report.scene import SceneMotion
from ilmek.units import format_quantity, mm

COMB = "hammer/comb"
"""Body of the comb."""

AXIS_SIDE = 80 * mm
"""Side of the section of a vertical axis [m]; assumed by this project."""


def tree(hammer: Hammer, motions: Mapping[str, SceneMotion] | None = None) -> Tree:
    """The bodies of a hammer; motions  of them by their ids."""
    bodies = _on_crank_rockers(hammer) if hammer.linkage is not None else _on_axes(hammer)
    return moving(bodies, motions or {})


def outline(params: HammerParams) -> tuple[ComplexArray, ...]:
    """The comb in the side view [m]: its leaves through the warps, and the bar in front of their roots."""
    front, deep = params.leaf_reach, params.comb_thickness
    return _rectangle(-BEHIND, front, params.leaf_height), _rectangle(front, front + deep, params.depth)


def _comb(hammer: Hammer) -> tuple[Occurrence, ...]:
    """Bar and leaves, the bar's ballast in front of it; the axes of the side view, 0 where the leaves strike."""
    params, steel = hammer.params, replace(STEEL, density=hammer.params.density)
    leaf, bar = outline(params)
    number, pitch, thick, wide = params.warps - 1, params.warp_pitch, params.leaf, params.width
    leaves = Part(
        *(LEAF_ID, "leaf of the comb", "laser-cut part", _size(leaf, thick)),
        Prism(Profile(polygon(leaf)), thick),
        steel,
    )
    whole = Part(
        *(BAR_ID, "comb of the hammer", "laser-cut part", f"bar {_size(bar, wide)}"),
        Prism(Profile(polygon(bar)), wide),
        steel,
    )
    comb = (
        Occurrence(whole, (placement(z=-wide / 2),)),
        Occurrence(
            leaves, tuple(placement(z=float(z)) for z in (np.arange(number) - (number - 1) / 2) * pitch - thick / 2)
        ),
    )
    ballast = hammer.linkage.ballast if hammer.linkage else 0.0
    if not ballast:
        return comb
    side = math.sqrt(ballast / (STEEL.density * wide))
    section = _rectangle(0.0, side, side) + params.leaf_reach + params.comb_thickness
    weight = Part(
        *("hammer/ballast", "ballast of the comb", "steel bar", _size(section, wide)),
        Prism(Profile(polygon(section)), wide),
        STEEL,
    )
    return (*comb, Occurrence(weight, (placement(z=-wide / 2),)))


@lru_cache(maxsize=4)
def _on_crank_rockers(hammer: Hammer) -> Tree:
    linkage, wide = hammer.linkage, hammer.params.width
    assert linkage is not None
    one, number = linkage.one, linkage.number
    stations = tuple(wide * ((k + 0.5) / number - 0.5) for k in range(number))
    comb = RigidBody(
        COMB,
        tuple(on_rocker(occurrence, one.lengths["beater"]) for occurrence in _comb(hammer)),
        CARRIAGE,
        Joint(JointKind.PIN),
        (rocker_position(one),),
    )
    return Tree(
        (
            crank_frame(one, start_parts(linkage.start), stations),
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
    row, front = drive.motor if drive else None, params.leaf_reach + params.comb_thickness + AXIS_SIDE / 2
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
    across = np.linspace(-edge, edge, number) if number > 1 else np.zeros(1)
    upright = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    top = params.stroke + (depth_of(geared[0]) if geared else 0.0)
    flipped = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)

    def standing(height: float) -> tuple[Placement, ...]:
        return tuple(placement(front, height, float(z)).after(upright) for z in across)

    axes = RigidBody(
        "hammer/axes",
        (
            Occurrence(axis, standing(0.0)),
            *(Occurrence(part, standing(params.stroke)) for part in geared),
            Occurrence(motor, tuple(placement(front, top, float(z)).after(flipped) for z in across)),
        ),
        joint=Joint(JointKind.MISSING),
    )
    return Tree((axes, RigidBody(COMB, _comb(hammer), axes.id, Joint(JointKind.SLIDE, (0.0, 1.0, 0.0)))))


def _rectangle(left: float, right: float, high: float) -> ComplexArray:
    return np.array([left, right, right, left]) + high * np.array([0, 0, 1j, 1j])


def _size(section: ComplexArray, length: float) -> str:
    wide, high = (format_quantity(float(np.ptp(side)) / mm, "", 4) for side in (section.real, section.imag))
    return f"{wide} x {high} x {format_quantity(length, 'mm', 4)}"
