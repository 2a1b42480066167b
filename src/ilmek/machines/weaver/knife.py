"""The knife of a head: the pile's eye in the face, a blade that slides over it, eccentric and motor of the cutter.

The yarn comes through the eye to where the handler grasps it. The blade slides on the face between two guides with lips
and shears the yarn at the eye's edge. It has a slot about the eccentric, which is on the shaft of the motor behind the
face: below the bell cranks, and over the cams.
"""

import cmath
import math
from collections.abc import Iterator

import numpy as np

from ilmek.cams.hertz import line_contact
from ilmek.cams.loaded_plate_cam import MODULUS, PRESSURE_LIMIT, STEEL
from ilmek.elements.duty import MARGIN
from ilmek.elements.fits import tolerance_zone
from ilmek.machines.weaver.cutter import LAP, cut, eccentricity
from ilmek.machines.weaver.cutter_motor import (
    BLADE,
    cutter_drive,
    cutter_motor,
    eccentric,
    eccentric_bore,
    eccentric_diameter,
    motor_length,
)
from ilmek.machines.weaver.cyclogram import TUBE_TURN
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import BELL_CRANKS
from ilmek.machines.weaver.levers import HALF
from ilmek.machines.weaver.stations import sheet
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.turning import home, pivot
from ilmek.machines.weaver.widths import stack_width
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, box, rectangle, tube
from ilmek.part.tree import Closure, Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import polygon
from ilmek.report import Check, at_least, at_most
from ilmek.sentences import Sentence
from ilmek.units import deg, format_quantity, mm, turn

KNIFE, EYE, GUIDE, ECCENTRIC, CUTTER_MOTOR = (
    part_id("knife"),
    part_id("yarn-eye"),
    part_id("knife-guide"),
    part_id("eccentric"),
    part_id("cutter-motor"),
)
BLADE_BODY, ECCENTRIC_BODY = part_id("sliding knife"), part_id("turning eccentric")
"""Ids of parts and bodies."""

EDGE, LAND = 3 * mm, 5 * mm
"""Width of the blade beside its slot, and from that to its edge [m]; assumed by this project, as all sizes here."""

STRIP, LIP = 6 * mm, 1.5 * mm
"""Width of a guide beside the blade; width and thickness of its lip over it [m]."""

WALL, PLAY, APART = 1.5 * mm, 0.03 * mm, 2 * mm
"""Wall of the eye, play of the eccentric in the slot and in the face, room about the motor [m]."""


def eye_at(weaver: Weaver) -> complex:
    """The eye in the face, x + i y [m]: where the handler grasps the yarn."""
    return pivot(weaver) + cmath.rect(weaver.handler_radius, home(weaver) + TUBE_TURN)


def eye_diameter(weaver: Weaver) -> float:
    """Outer diameter of the eye [m], of stock reamers; its bore is as wide as the blade's stroke."""
    return math.ceil((_eye_bore(weaver) + 2 * WALL) / (mm / 2)) * mm / 2


def _eye_bore(weaver: Weaver) -> float:
    return LAP * weaver.params.yarn


def shaft_at(weaver: Weaver) -> complex:
    """Axis of the eccentric, x + i y [m]: the motor below the bell cranks where it is over the cams there."""
    eye, inner, face = eye_at(weaver), stack_width(weaver.params) / 2, _face(weaver)
    pivots = (lever.pivot.imag for track, lever in weaver.shape.levers.items() if track in BELL_CRANKS)
    below = min(pivots) - HALF - APART - face / 2
    above = _edge(weaver) - LAND - eccentric_diameter(weaver.params) / 2 + eccentricity(weaver.params.yarn)
    return complex(min(eye.real, inner - face / 2 - APART / 4), min(max(below, _over_cams(weaver) + face / 2), above))


def _over_cams(weaver: Weaver) -> float:
    """Height over the cams at the end of the motor, with room [m]."""
    shape, largest = weaver.shape, max(cam.radius for cam in weaver.cams)
    end = shape.body.real + _wall(weaver) + motor_length(weaver.params)
    return shape.axis.imag + math.sqrt(max(largest**2 - max(shape.axis.real - end, 0.0) ** 2, 0.0)) + APART


def knife_checks(weaver: Weaver) -> tuple[Check, ...]:
    """The motor's torque, and the pressure of the eccentric on its slot."""
    params, drive = weaver.params, cutter_drive(weaver.params)
    pressed = line_contact(params.strength / BLADE, 2 / eccentric_diameter(params), MODULUS)
    return (
        at_least(
            "torque of the cutter's motor, over what the cut takes",
            drive.duty.reserve if drive else 0.0,
            MARGIN,
            "1",
            f"motors of the table; a cut of {format_quantity(params.strength, 'N', 3)} through all fibres at once",
        ).with_cure("set a longer weaver.cutter_turn, or a lighter pile yarn", CUTTER_MOTOR, KNIFE),
        at_most(
            "Hertz pressure of the cutter's eccentric", float(pressed.pressure), PRESSURE_LIMIT, "MPa", STEEL.name
        ).with_cure("set a lighter pile yarn", ECCENTRIC, KNIFE),
    )


def knife_stands(weaver: Weaver) -> Iterator[Occurrence]:
    """The eye in the face, the guides on it, the motor behind it."""
    eye, front, wall = eye_at(weaver), weaver.shape.body.real, _wall(weaver)
    outer = eye_diameter(weaver)
    sleeve = tube(outer, (outer - _eye_bore(weaver)) / 2, wall)
    bush = Part(EYE, "eye of the pile yarn", "pin or bush", sleeve, STEEL)
    yield Occurrence(bush, (placement(eye.real, eye.imag, front),))
    axis, (half, low, high) = shaft_at(weaver), _outline(weaver)
    strip = Placed(box(STRIP, high - low, BLADE + LIP), (placement(half + STRIP / 2),))
    lip = Placed(box(LIP, high - low, LIP), (placement(half - LIP / 2),))
    guide = Part(GUIDE, "guide of the knife", "machined link", Sum((strip, lip)), STEEL)
    middle = (low + high) / 2
    positions = tuple(
        placement(axis.real, middle, front - BLADE - LIP, about=(0.0, 0.0, 1.0), angle=angle)
        for angle in (0.0, turn / 2)
    )
    yield Occurrence(guide, positions)
    params = weaver.params
    cycle = cut(params.yarn, params.strength, params.cutter_turn, 0.0)
    torque, speed, row = float(cycle.torque.max()), float(cycle.speed.max()), cutter_motor(params)
    shaft = eccentric_bore(params), wall + BLADE
    motor = catalogue.motor(CUTTER_MOTOR, "motor of the cutter", row, torque, speed, shaft=shaft)
    to_the_face = placement(axis.real, axis.imag, front + wall, about=(1.0, 0.0, 0.0), angle=turn / 2)
    yield Occurrence(motor, (to_the_face,))


def knife_bodies(weaver: Weaver, parent: str) -> Iterator[RigidBody]:
    """Eccentric and blade at the blade's lower dead centre."""
    axis = shaft_at(weaver)
    front = weaver.shape.body.real - BLADE
    at = placement(axis.real, axis.imag, front)
    turning = Joint(JointKind.PIN, motor=CUTTER_MOTOR)
    yield RigidBody(ECCENTRIC_BODY, (Occurrence(_eccentric(weaver)),), parent, turning, (at,))
    sliding = Joint(JointKind.SLIDE, (0.0, 1.0, 0.0))
    yield RigidBody(BLADE_BODY, (Occurrence(_blade(weaver)),), parent, sliding, (at,))


KNIFE_CLOSURE = Closure(JointKind.TRANSMISSION, (ECCENTRIC_BODY, BLADE_BODY), kept_by=(ECCENTRIC,))
"""The blade follows its eccentric."""


def _eccentric(weaver: Weaver) -> Part:
    params = weaver.params
    shape = eccentric(params, _wall(weaver), eccentric_bore(params))
    ring = Sentence("sheet.eccentric", **tolerance_zone("h7", eccentric_diameter(params)).stated)
    notes = (Sentence("sheet.bonded"), ring)
    return Part(ECCENTRIC, "eccentric of the cutter", "turned part", shape, STEEL, notes=notes)


def _blade(weaver: Weaver) -> Part:
    """A plate about the axis of the eccentric, with a slot across; its upper edge cuts."""
    axis, (half, low, high) = shaft_at(weaver), _outline(weaver)
    wide, by = eccentric_diameter(weaver.params) + 2 * PLAY, eccentricity(weaver.params.yarn)
    slot = polygon(rectangle(wide + 2 * by, wide).points - 1j * by)
    corners = np.array([-half + 1j * low, half + 1j * low, half + 1j * high, -half + 1j * high]) - 1j * axis.imag
    window = Sentence("sheet.window", **tolerance_zone("H8", wide).stated)
    notes = (Sentence("sheet.cutting-edge", angle=format_quantity(EDGE_ANGLE, "deg")), window)
    shape = Prism(Profile(polygon(corners), (slot,)), BLADE)
    return Part(KNIFE, "knife", "machined link", shape, STEEL, notes=notes)


EDGE_ANGLE = 25 * deg
"""Angle of the edge, ground on the side away from the face, on which the flat side shears; assumed by this project."""


def _outline(weaver: Weaver) -> tuple[float, float, float]:
    """Half the width of the blade about the axis of the eccentric, heights of its lower and upper edge at rest [m]."""
    axis, by, across = shaft_at(weaver), eccentricity(weaver.params.yarn), eccentric_diameter(weaver.params)
    beside = abs(eye_at(weaver).real - axis.real) + by + EDGE
    return max(across / 2 + by + EDGE, beside), axis.imag - by - across / 2 - EDGE, _edge(weaver)


def _edge(weaver: Weaver) -> float:
    """Height of the edge at rest: the lower end of the eye's bore [m]."""
    return eye_at(weaver).imag - eccentricity(weaver.params.yarn)


def _wall(weaver: Weaver) -> float:
    """Thickness of the face, or of what bears the motor where there is none [m]."""
    return max(sheet(weaver), WALL)


def _face(weaver: Weaver) -> float:
    """Side of the motor's flange [m]."""
    row = cutter_motor(weaver.params)
    return row.face if row else catalogue.SPECIAL_FACE
