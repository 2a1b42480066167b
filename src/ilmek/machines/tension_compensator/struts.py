"""The struts of a lever: springs that stand on eyes, and a telescope in each that holds it straight.

A rod in the eye at the anchor slides in a sleeve of the eye at the lever: a spring between turning ends would buckle
beyond 2.6 of its mean diameter, one on a guide does not.                            [EN 13906-1; `elements.springs`]
Along the strut, z from the anchor: shank in the eye, collar as wide as the coil allows, tail in the sleeve.
"""

import cmath
import math

import numpy as np

from ilmek.machines.tension_compensator.members import part_id
from ilmek.machines.tension_compensator.params import STEEL
from ilmek.machines.tension_compensator.supports import BarSupports
from ilmek.machines.tension_compensator.synthesis import PLAY
from ilmek.part.part import Bought, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Drilling, Placed, Prism, Sum, Turned, stepped, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.records import record
from ilmek.report import Check, at_least
from ilmek.report.scene import SceneMotion
from ilmek.units import mm

ENGAGED = 1.5
"""Least length of a rod in its sleeve over its diameter, and most of its shank in the eye; assumed by this project."""

_SAMPLES = 49
"""Of the swing of a strut over the turn of a drive, at least."""

_WALL = 3 * mm
"""From the socket of a rod to the bore of its eye [m]; assumed by this project."""

_ROD, _COLLAR = 0.4, 0.1
"""Diameter of a rod over that of its collar, and the collar's share of a compressed spring; assumed by this project."""


@record
class Strut:
    """A spring with its eyes and its telescope.

    seat     from a pin to the spring's end [m]            wide     of an eye, as its coil [m]
    length   of the spring in the open shed [m]            travel   from there to rest [m]
    guide    diameter of collar and sleeve [m]             rod      of shank and tail [m]
    socket   its depth in an eye [m]
    """

    seat: float
    wide: float
    length: float
    travel: float
    guide: float
    rod: float
    socket: float

    @property
    def collar(self) -> float:
        """Length of the collar [m]."""
        return self.length * _COLLAR

    @property
    def sleeve(self) -> float:
        """Length of the sleeve beside its eye [m]."""
        return self.length - self.collar - PLAY

    @property
    def engaged(self) -> float:
        """Length of the rod in its sleeve at rest [m], up to a play before its floor in the open shed."""
        return self.sleeve - self.travel - PLAY


def strut_of(at: BarSupports) -> Strut | None:
    """The strut for a lever's springs; None where none of the table is enough."""
    sprung, wound, pin = at.sprung, at.sprung.spring, at.members.spring_pin
    if wound is None:
        return None
    rest, opened = (float(sprung.lever.spring_length(angle)) for angle in (0.0, sprung.angle))
    seat = max((rest - wound.free_length + sprung.preload / sprung.rate) / 2, 0.75 * pin)
    guide = max(math.floor((wound.diameter - wound.wire_diameter - 2 * PLAY) / mm), 3) * mm
    rod = math.ceil(_ROD * guide / mm) * mm
    return Strut(
        seat,
        wide=sprung.pitch - PLAY,
        length=max(opened - 2 * seat, wound.wire_diameter),
        travel=rest - opened,
        guide=guide,
        rod=rod,
        socket=min(seat - pin / 2 - _WALL, ENGAGED * rod),
    )


def strut_checks(at: BarSupports) -> tuple[Check, ...]:
    """The telescope's length at rest."""
    strut = strut_of(at)
    if strut is None:
        return ()
    source = "1.5 of its diameter, assumed by this project"
    engaged = at_least("length of a spring's guide rod in its sleeve", strut.engaged, ENGAGED * strut.rod, "mm", source)
    return (engaged.with_cure("set a thinner wire, or more springs", part_id("guide-rod"), part_id("guide-sleeve")),)


@record
class StrutParts:
    """The parts of a strut; eye, rod and sleeve are none where no spring of the table is enough."""

    strut: Strut | None
    spring: Part
    eye: Part | None
    rod: Part | None
    sleeve: Part | None


def strut_parts(at: BarSupports) -> StrutParts:
    """The parts of the struts of a lever."""
    strut = strut_of(at)
    if strut is None:
        none = Bought("none of the table is enough")
        return StrutParts(None, Part(part_id("spring"), _SPRING, "spring", purchase=none), None, None, None)
    turned = "pin or bush"
    return StrutParts(
        strut,
        _spring(at, strut),
        Part(part_id("eye"), "eye of a spring", "machined link", _eye(at, strut), STEEL),
        Part(part_id("guide-rod"), "guide rod of a spring", turned, _rod(strut), STEEL),
        Part(part_id("guide-sleeve"), "guide sleeve of a spring", turned, _sleeve(strut), STEEL),
    )


_SPRING = "spring of the compensator"


def _eye(at: BarSupports, strut: Strut) -> Sum:
    """A block on a pin along z, from behind it to the end of its spring at x: bore of the pin, socket of a rod."""
    pin, wide, far = at.members.spring_pin, strut.wide, strut.seat
    high = 0.5j * max(wide, 2 * pin)
    corners = np.array([-pin - high, far - high, far + high, -pin + high])
    socket = Drilling(
        placement(far, z=wide / 2, about=(0.0, 1.0, 0.0), angle=-math.pi / 2), ((strut.rod, strut.socket),)
    )
    block = Prism(Profile(polygon(corners), (circle(0j, pin / 2),)), wide, (socket,))
    return Sum((Placed(block, (placement(z=-wide / 2),)),))


def _rod(strut: Strut) -> Turned:
    """Shank, collar and tail from z = 0, the end in the eye."""
    tail = PLAY + strut.travel + strut.engaged
    return stepped((strut.rod, strut.socket), (strut.guide, strut.collar), (strut.rod, tail))


def _sleeve(strut: Strut) -> Turned:
    """Shank and bored sleeve from z = 0, the end in the eye."""
    floor, end = strut.socket, strut.socket + strut.sleeve
    rod, wide = 0.5j * strut.rod, 0.5j * strut.guide
    inside = [end + rod, floor + PLAY + rod, complex(floor + PLAY)]
    return Turned(Profile(polygon(np.array([0j, rod, floor + rod, floor + wide, end + wide, *inside]))))


def _spring(at: BarSupports, strut: Strut) -> Part:
    """The spring: its room is that of the coil in the open shed, on the eye at its anchor, about z."""
    wound = at.sprung.spring
    assert wound is not None
    coil = tube(wound.diameter + wound.wire_diameter, wound.wire_diameter, strut.length)
    room = Sum((Placed(coil, (placement(z=strut.seat),)),))
    bought = Bought(wound.designation, wound.mass)
    return Part(part_id("spring"), _SPRING, "spring", room, purchase=bought, envelope=True)


def strut_bodies(
    at: BarSupports, parts: StrutParts, name: str, carrier: str, motion: SceneMotion | None
) -> tuple[RigidBody, ...]:
    """The halves of a parity's struts: one turns on its pin, one slides on it; none without springs.

    carrier  id of the body of the pin      motion  of the lever; None: it stands at rest
    """
    strut, anchor, along = parts.strut, complex(at.sprung.lever.anchor), at.along
    if strut is None:
        return ()
    assert parts.eye is not None
    assert parts.rod is not None
    assert parts.sleeve is not None
    rest = at.sprung.lever.pivot + at.reach - anchor
    swing, slide = motion, motion
    if motion is not None:
        angle = np.union1d(motion.angle, np.linspace(motion.angle[0], motion.angle[-1], _SAMPLES))
        turned = np.interp(angle, motion.angle, motion.rotation)
        reached = at.sprung.lever.pivot + at.reach * np.exp(1j * turned) - anchor
        still, drawn = 0 * angle, (np.abs(reached) - abs(rest)) * along
        swing = SceneMotion(motion.drive, angle, np.stack([still, still, still], 1), np.angle(reached / along))
        slide = SceneMotion(motion.drive, angle, np.stack([drawn.real, drawn.imag, still], 1), still)
    rod, sleeve = (
        (Occurrence(parts.eye, (_across(cmath.phase(towards)),)), Occurrence(guide, (_lying(towards, shift),)))
        for towards, guide, shift in zip(
            (along, -along), (parts.rod, parts.sleeve), 2 * (strut.seat - strut.socket,), strict=True
        )
    )
    anchors = RigidBody(
        part_id(f"{name} spring anchors"),
        (*rod, Occurrence(parts.spring, (_lying(along),))),
        carrier,
        Joint(JointKind.PIN, motion=swing),
        tuple(placement(anchor.real, anchor.imag, z) for z in at.spring_stations),
    )
    sliding = Joint(JointKind.SLIDE, (along.real, along.imag, 0.0), slide)
    ends = RigidBody(part_id(f"{name} spring ends"), sleeve, anchors.id, sliding, (placement(rest.real, rest.imag),))
    return anchors, ends


def _across(angle: float) -> Placement:
    return placement(about=(0.0, 0.0, 1.0), angle=angle)


def _lying(towards: complex, shift: float = 0.0) -> Placement:
    """What is made along z, along a direction from its pin, further by a shift [m]."""
    upwards = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    return _across(cmath.phase(towards) - math.pi / 2).after(upwards).after(placement(z=shift))
