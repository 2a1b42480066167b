"""The warp tension as bodies: each cylinder with its shaft ends, in its bearings, with reducer and motor.

Each cylinder has its own axes: z along it, 0 in the middle of its width, the drive at +z.
"""

import cmath
import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.elements.materials import MATERIALS, Material
from ilmek.elements.reducers import REDUCER_FLANGES
from ilmek.machines.bearing_seats import TURNED
from ilmek.machines.shaft_stand import CarriedShaft, shaft_stand, stand_heights
from ilmek.machines.warp_tension.attachment import on_cylinder
from ilmek.machines.warp_tension.cylinders import SPACER, STUB, UPPER, Cylinder, cylinders, part_id
from ilmek.machines.warp_tension.design import WarpTensionDesign
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.machines.warp_tension.spigot import FLANGE
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, bar, stepped
from ilmek.part.tree import GROUND, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle
from ilmek.report.scene import SceneMotion
from ilmek.units import mm, turn

WHEEL, HANDLE, HANDLE_SIZE, CRANK_SHAFT = 8 * mm, 110 * mm, 25 * mm, 25 * mm
"""Thickness of a hand wheel, length and diameter of its handle, diameter of its shaft [m]; assumed by this project."""


def tree(design: WarpTensionDesign, positions: dict[str, Placement] | None = None) -> Tree:
    """The bodies of the three cylinders.

    positions  of each cylinder's axes by its name; default: one above the other, as on their stand
    """
    shells, drives = _shells(design), _drives(design)
    where = positions or {
        own.name: placement(y=y) for own, y in zip(cylinders(design), stand_heights(_carried(design)), strict=True)
    }
    bodies = (
        body
        for cylinder, shell in zip(cylinders(design), shells, strict=True)
        for body in _bodies(design.params, cylinder, shell, drives[cylinder.name], where[cylinder.name])
    )
    return Tree(tuple(bodies))


def stand(design: WarpTensionDesign) -> Tree:
    """What carries the cylinders of the machine alone."""
    return shaft_stand(part_id, _carried(design))


def _carried(design: WarpTensionDesign) -> tuple[CarriedShaft, ...]:
    """The cylinders, as their stand carries them: with the room of tubes and reducers, or hand wheels."""
    drives, far = _drives(design), design.params.span / 2 + design.params.stub
    wheel = design.params.crank + HANDLE_SIZE if design.params.by_hand else 0.0
    return tuple(
        CarriedShaft(
            f"{own.name} cylinder",
            own.name,
            own.seat,
            far,
            max(own.flange, reach_of(drives[own.name][0]), wheel),
            catalogue.screwed_radius(drives[own.name][0]),
        )
        for own in cylinders(design)
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
    params: WarpTensionParams, cylinder: Cylinder, shell: Part, drive: tuple[Part, ...], position: Placement
) -> tuple[RigidBody, ...]:
    """A cylinder with its ends, its bearings on the frame's brackets, and its drive: reducer, then what turns it.

    A shaft end is a spigot that fits the bored tube, a flange that is welded to the tube's end, and a journal that
    reaches through bearing and bracket; on the driven side it goes on into the reducer, with a key. Where a hand winds,
    the warps turn the spacer.
    """
    name, seat, driven = cylinder.name, cylinder.seat, not (params.by_hand and cylinder.name == SPACER)
    plain = (Occurrence(shell, (placement(z=-params.span / 2),)),)
    shells = plain if name == SPACER else on_cylinder(cylinder, shell, params)
    far, inside = params.span / 2 + params.stub, params.span / 2 - _spigot(cylinder)[1]
    left, right = _side(z=inside, flipped=True), placement(z=inside)
    shape = _end_shape(params, cylinder)
    title = f"shaft end of the {name} cylinder"
    end = replace(_made(f"{name}-end", title, "turned part", shape, STUB), machined=True)  # after it is welded
    ends = (
        (*_driven_end(cylinder, shape, right), Occurrence(end, (left,)))
        if driven
        else (Occurrence(end, (left, right)),)
    )
    seats = tuple(_side(z=far, flipped=flipped) for flipped in (False, True))
    ids = part_id(f"{name}-bearing"), part_id(f"{name}-housing")
    met = (f"{end.id}:journal", f"{ids[0]}:bore")
    turns = _turned_by(params, drive, Joint(JointKind.PIN, seats=met), driven=driven)
    bodies = (
        RigidBody(part_id(f"{name} cylinder"), (*shells, *ends), GROUND, turns, (position,)),
        RigidBody(
            part_id(f"{name} bearings"),
            seat.occurrences(ids, f"bearing of the {name} cylinder", seats),
            positions=(position,),
        ),
    )
    if not driven:
        return bodies
    carried = _on_bracket(params, drive, far + seat.through)
    return (*bodies, RigidBody(part_id(f"{name} drive"), carried, positions=(position,)))


def _turned_by(params: WarpTensionParams, drive: tuple[Part, ...], joint: Joint, *, driven: bool) -> Joint:
    """The joint of a cylinder with what turns it: the last part of its drive."""
    if not driven:
        return replace(joint, passive="the warps turn it")
    return replace(joint, hand=drive[-1].id) if params.by_hand else replace(joint, motor=drive[-1].id)


def _end_shape(params: WarpTensionParams, cylinder: Cylinder) -> Turned:
    """Spigot, flange and journal of a shaft end, about z from z = 0."""
    rim, journal = min(FLANGE, params.stub / 2), cylinder.seat.bearing.bore
    length = params.stub - rim + cylinder.seat.journal
    steps = _spigot(cylinder), (2 * cylinder.flange, rim), (journal, length)
    return stepped(*(step for step in steps if min(step) > 0))


def _spigot(cylinder: Cylinder) -> tuple[float, float]:
    """Diameter and length of the spigot [m]; none in a solid cylinder."""
    return cylinder.spigot if cylinder.inner > 0 else (0.0, 0.0)


def _driven_end(cylinder: Cylinder, shape: Turned, position: Placement) -> tuple[Occurrence, Occurrence]:
    """The shaft end that goes on into the reducer, and its key."""
    name, keyed, outer = cylinder.name, cylinder.driven_end, float(np.max(shape.profile.outline.points.real))
    grooved = Sum((Placed(shape), Placed(catalogue.keyed_journal(keyed), (placement(z=outer),))))
    title = f"driven shaft end of the {name} cylinder"
    driven = replace(_made(f"{name}-driven-end", title, "turned part", grooved, STUB), machined=True)
    own = part_id(f"{name}-key"), f"key of the {name} cylinder"
    return Occurrence(driven, (position,)), catalogue.keys(*own, keyed, position.after(placement(z=outer)))


def _on_bracket(params: WarpTensionParams, drive: tuple[Part, ...], far: float) -> tuple[Occurrence, ...]:
    """Reducer and motor, or reducer, shaft, wheel and handle one after the other, beyond the bracket's outer face [m].

    Reducer and motor meet in their flanges, the reducer towards the cylinder, both turned about its axis.
    """
    turned = placement(about=(0.0, 0.0, 1.0), angle=TURNED)
    flange = turned.after(placement(z=far + catalogue.length_of(drive[0]), about=(1.0, 0.0, 0.0), angle=math.pi))
    if not params.by_hand:
        return tuple(Occurrence(part, (flange,)) for part in drive)
    geared, shaft, wheel, handle = drive
    outside = -params.crank_shaft
    return (
        Occurrence(geared, (flange,)),
        Occurrence(shaft, (flange.after(placement(z=outside)),)),
        Occurrence(wheel, (flange.after(placement(z=outside - WHEEL)),)),
        Occurrence(handle, (flange.after(placement(params.crank, z=outside - WHEEL - HANDLE)),)),
    )


@lru_cache(maxsize=16)
def _shells(design: WarpTensionDesign) -> tuple[Part, Part, Part]:
    """The tubes of upper and lower cylinder, which are alike [thesis 3.1], and of the spacer."""
    steel = replace(MATERIALS["structural steel"], density=design.params.density)
    upper, lower, spacer = cylinders(design)
    plain = _made("cylinder", "cylinder", "steel tube", upper.shape, steel)
    plain = replace(plain, throat=max(upper.throat, lower.throat))
    slotted = _made("spacer", "spacer cylinder", "steel tube", spacer.shape, steel)
    return plain, plain, replace(slotted, throat=spacer.throat)


def reach_of(reducer: Part) -> float:
    """Half of the width across the shaft that a turned reducer takes [m]."""
    return catalogue.face_of(reducer) / 2 * (math.cos(TURNED) + math.sin(TURNED))


def winding_reducer(design: WarpTensionDesign) -> Part:
    """The reducer of the upper cylinder; those of the others are alike but for their bores."""
    return _drives(design)[UPPER][0]


@lru_cache(maxsize=16)
def _drives(design: WarpTensionDesign) -> dict[str, tuple[Part, ...]]:
    """Reducer and motor, one of each for each of the three cylinders [thesis 3.1]; or reducer, shaft, wheel, handle.

    The reducers are alike but for the bores of their hollow shafts, of a class whose screws keep off the seats'.
    """
    own = cylinders(design)
    ends = {cylinder.name: cylinder.driven_end for cylinder in own}
    longest = {end.diameter: end for end in sorted(ends.values(), key=lambda end: end.length)}
    thickest = ends[UPPER].diameter

    def reducers(least: float) -> dict[float, Part]:
        names = {bore: "reducer" if bore == thickest else f"reducer-{bore / mm:g}" for bore in longest}
        drive = "reducer of a cylinder", design.reducer, design.motor
        return {
            bore: catalogue.reducer(part_id(names[bore]), *drive, end, least=least) for bore, end in longest.items()
        }

    classes = map(reducers, (0.0, *(row.face for row in REDUCER_FLANGES)))
    clear = (
        parts for parts in classes if all(one.seat.is_clear(parts[one.driven_end.diameter], TURNED) for one in own)
    )
    geared = next(clear, None) or reducers(0.0)
    if design.params.by_hand:
        last: tuple[Part, ...] = _crank(design.params, catalogue.face_of(geared[thickest]))
    else:
        torque, speed = design.motor_torque, design.motor_speed
        last = (catalogue.motor(part_id("motor"), "motor of a cylinder", design.motor, torque, speed),)
    return {name: (geared[end.diameter], *last) for name, end in ends.items()}


def _crank(params: WarpTensionParams, face: float) -> tuple[Part, Part, Part]:
    """Shaft, wheel and handle by which a hand turns a reducer; face  of the reducer, which the shaft's flange is on."""
    steel, rim = MATERIALS["structural steel"], params.crank + HANDLE_SIZE
    window = (rim - CRANK_SHAFT) / 4
    windows = (circle(cmath.rect((rim + CRANK_SHAFT) / 2, turn * (k + 0.5) / 6), window) for k in range(6))
    wheel = Prism(Profile(circle(0j, rim), tuple(windows)), WHEEL)
    rim_of_shaft = min(FLANGE, params.crank_shaft / 2)
    shaft = stepped((CRANK_SHAFT, params.crank_shaft - rim_of_shaft), (face, rim_of_shaft))
    handle = bar(HANDLE_SIZE, HANDLE)
    turned = _made("crank-shaft", "shaft of a hand wheel", "turned part", shaft, STUB)
    return (
        replace(turned, fixing="on the input shaft of its reducer, with the key of that"),
        _made("hand-wheel", "hand wheel of a cylinder", "laser-cut part", wheel, steel),
        _made("handle", "handle of a hand wheel", "turned part", handle, steel),
    )


def _side(*, z: float, flipped: bool) -> Placement:
    """At a distance from the middle on the side of the drive, or flipped on the other side."""
    own = placement(z=z)
    return placement(about=(1.0, 0.0, 0.0), angle=math.pi).after(own) if flipped else own


def _made(name: str, title: str, process: str, shape: Shape, material: Material) -> Part:
    return Part(part_id(name), title, process, shape, material)
