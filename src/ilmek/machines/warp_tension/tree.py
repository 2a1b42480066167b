"""The warp tension as bodies: each cylinder with its shaft ends, in its bearings, with reducer and motor.

Each cylinder has its own axes: z along it, 0 in the middle of its width, the drive at +z.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.elements.materials import MATERIALS, Material
from ilmek.machines.warp_tension.attachment import on_cylinder
from ilmek.machines.warp_tension.cylinders import STUB, Cylinder, cylinders, part_id
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.machines.warp_tension.slot import slotted
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.shapes import Placed, Shape, Sum, stepped
from ilmek.part.tree import GROUND, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.units import format_quantity, mm

PLUG, PLAY = 20 * mm, 1 * mm
"""Length of a shaft end's plug in its tube, and its play there [m]: the weld of its flange holds it; assumed."""

RIM = 8 * mm
"""Thickness of a shaft end's flange on its tube [m]; assumed by this project."""

UPPER, LOWER, SPACER = "upper", "lower", "spacer"


def tree(design: WarpTensionDesign, positions: dict[str, Placement] | None = None) -> Tree:
    """The bodies of the three cylinders.

    positions  of each cylinder's axes by its name; default: all in one, as the machine has no side view of its own
    """
    where, shells = positions or {}, _shells(design)
    geared = _drive_parts(design)
    return Tree(
        tuple(
            body
            for cylinder, shell in zip(cylinders(design), shells, strict=True)
            for body in _bodies(design.params, cylinder, (shell, *geared), where.get(cylinder.name, IDENTITY))
        )
    )


def turning(bodies: Tree, motions: dict[str, SceneMotion]) -> Tree:
    """The tree with motions of the cylinders by their names."""
    joints = {part_id(f"{name} cylinder"): motion for name, motion in motions.items()}
    return Tree(
        tuple(
            replace(body, joint=replace(body.joint, motion=joints[body.id])) if body.id in joints else body
            for body in bodies.bodies
        )
    )


def _bodies(
    params: WarpTensionParams, cylinder: Cylinder, common: tuple[Part, Part, Part], position: Placement
) -> tuple[RigidBody, ...]:
    """A cylinder with its ends, its bearings on the frame's brackets, and its drive; common: tube, reducer, motor.

    A shaft end is a plug with play in the tube, a flange that is welded to the tube's end, and a journal that reaches
    through bearing and bracket; on the driven side it goes on into the reducer, with a key.
    """
    name, seat = cylinder.name, cylinder.seat
    shell, geared, driving = common
    plain = (Occurrence(shell, (placement(z=-params.span / 2),)),)
    shells = plain if name == SPACER else on_cylinder(cylinder, shell, params)
    far = params.span / 2 + params.stub
    rim, journal = min(RIM, params.stub / 2), seat.bearing.bore
    steps = (2 * (cylinder.inner - PLAY), PLUG), (2 * cylinder.shell.outer_radius, rim)
    shape = stepped(*(step for step in steps if min(step) > 0), (journal, params.stub - rim + seat.through))
    end = _made(f"{name}-end", f"shaft end of the {name} cylinder", "turned part", shape, "", STUB)
    keyed, outer = cylinder.driven_end, float(np.max(shape.profile.outline.points.real))
    grooved = Sum((Placed(shape), Placed(catalogue.keyed_journal(keyed), (placement(z=outer),))))
    driven = _made(f"{name}-driven-end", f"driven shaft end of the {name} cylinder", "turned part", grooved, "", STUB)
    inside = params.span / 2 - PLUG
    own = part_id(f"{name}-key"), f"key of the {name} cylinder"
    keys = catalogue.keys(*own, keyed, placement(z=inside + outer))
    seats = tuple(_side(z=far, flipped=flipped) for flipped in (False, True))
    ids = part_id(f"{name}-bearing"), part_id(f"{name}-housing")
    return (
        RigidBody(
            part_id(f"{name} cylinder"),
            (
                *shells,
                Occurrence(driven, (placement(z=inside),)),
                Occurrence(end, (_side(z=inside, flipped=True),)),
                keys,
            ),
            GROUND,
            Joint(JointKind.PIN, seats=(f"{end.id}:journal", f"{ids[0]}:bore"), motor=driving.id),
            (position,),
        ),
        RigidBody(
            part_id(f"{name} bearings"),
            seat.occurrences(ids, f"bearing of the {name} cylinder", seats),
            positions=(position,),
        ),
        RigidBody(
            part_id(f"{name} drive"),
            tuple(Occurrence(part, (_flange(geared, far + seat.through),)) for part in (geared, driving)),
            positions=(position,),
        ),
    )


def _shells(design: WarpTensionDesign) -> tuple[Part, Part, Part]:
    """The tubes of upper and lower cylinder, which are alike [thesis 3.1], and of the spacer."""
    steel = replace(MATERIALS["structural steel"], density=design.params.density)
    upper, _, spacer = cylinders(design)
    plain = _made("cylinder", "cylinder", "steel tube", slotted(upper, design.params.span), _size(upper), steel)
    return plain, plain, _made("spacer", "spacer cylinder", "steel tube", spacer.shell, _size(spacer), steel)


def _drive_parts(design: WarpTensionDesign) -> tuple[Part, Part]:
    """Reducer and motor: one of each for each of the three cylinders [thesis 3.1]."""
    end = max((cylinder.driven_end for cylinder in cylinders(design)), key=lambda one: (one.diameter, one.length))
    geared = catalogue.reducer(part_id("reducer"), "reducer of a cylinder", design.reducer.ratio, design.motor, end)
    torque, speed = design.motor_torque, design.motor_speed
    return geared, catalogue.motor(part_id("motor"), "motor of a cylinder", design.motor, torque, speed)


def _flange(geared: Part, far: float) -> Placement:
    """Where reducer and motor meet, beyond the bracket's outer face [m]: the reducer towards the cylinder."""
    return placement(z=far + catalogue.length_of(geared), about=(1.0, 0.0, 0.0), angle=math.pi)


def _side(*, z: float, flipped: bool) -> Placement:
    """At a distance from the middle on the side of the drive, or flipped on the other side."""
    own = placement(z=z)
    return placement(about=(1.0, 0.0, 0.0), angle=math.pi).after(own) if flipped else own


def _made(  # noqa: PLR0917
    name: str, title: str, process: str, shape: Shape, size: str, material: Material
) -> Part:
    return Part(part_id(name), title, process, size, shape, material)


def _size(cylinder: Cylinder) -> str:
    """Outer diameter and wall of the tube."""
    outer = cylinder.shell.outer_radius
    return f"tube {format_quantity(2 * outer, 'mm')} x {format_quantity(outer - cylinder.inner, 'mm')}"
