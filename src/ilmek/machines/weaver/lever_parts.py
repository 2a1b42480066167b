"""The levers of a head as bodies, their axles between the side plates, and the drawbars on which they act."""

from collections.abc import Iterator

import numpy as np

from ilmek.cams.loaded_plate_cam import STEEL, LoadedPlateCam
from ilmek.elements.fits import tolerance_zone
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.followers import lever_pin
from ilmek.machines.weaver.head_shape import DRAWBAR
from ilmek.machines.weaver.levers import HALF, LEVER_AXLE, OVER, PIN, FollowerLever
from ilmek.machines.weaver.stations import cheek, lever_thickness, station
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.machines.weaver.widths import stack_width
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, bar, rectangle
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon, strip
from ilmek.report import Contour
from ilmek.sentences import Sentence
from ilmek.units import mm

LEVER_STRESS = (STEEL.fatigue or 0.0) / 2
"""Allowed stress of a lever [Pa]: the fatigue limit over a safety of 2, assumed by this project."""

_SLIDING = 0.02 * mm
"""Room of a pin in its slot, on each side [m]."""


def lever_id(track: str) -> str:
    """Id of the lever between a cam's follower and its tool, and of its body."""
    return part_id(f"{track.replace(' ', '-')}-lever")


def lever_bodies(weaver: Weaver, parent: str) -> Iterator[RigidBody]:
    """The levers at angle 0, in the side view."""
    thick = lever_thickness(weaver)
    for track, lever in weaver.shape.levers.items():
        cam = weaver.cam(track)
        at = placement(station(weaver, track) + thick / 2, lever.pivot.imag, lever.pivot.real).after(IN_SIDE_VIEW)
        angle = float(lever.turned(float(cam.motion.s[0])))
        rest = at.after(placement(about=(0.0, 0.0, 1.0), angle=angle))
        shape = Prism(_section(lever), thick)
        slots = tolerance_zone("H8", PIN + 2 * _SLIDING).stated
        notes = (Sentence("sheet.lever-slots", off=f"{_SLIDING / mm:g}", **slots),)
        part = Part(lever_id(track), f"lever of the {track}", "machined link", shape, STEEL, notes=notes)
        yield RigidBody(lever_id(track), (Occurrence(part),), parent, Joint(JointKind.PIN), (rest,))


def _section(lever: FollowerLever) -> Profile:
    """Two arms about the pivot, each with the slot of a pin."""
    tool = -1 + 0j if lever.straight else 1j
    (near, far), (inner, outer) = lever.slot(lever.arm), lever.slot(lever.ratio * lever.arm)
    outline = strip(np.array([tool * outer, 0j, complex(far)]), HALF)
    slots = _slot(near, far, 1 + 0j), _slot(inner, outer, tool)
    return Profile(outline, (circle(0j, LEVER_AXLE / 2), *slots))


def _slot(near: float, far: float, direction: complex) -> Contour:
    return strip(direction * np.array([near, max(far, near + _SLIDING)]), PIN / 2 + _SLIDING)


def lever_stress(weaver: Weaver, cam: LoadedPlateCam) -> float:
    """Greatest bending stress of a lever at its axle [Pa], by the contact force of its cam on its shorter arm.

    sigma = F a / W,  W = t (w³ - d³) / 6 w     t thickness, w width, d axle
    """
    lever, wide = weaver.shape.levers[cam.name], 2 * HALF
    section = lever_thickness(weaver) * (wide**3 - LEVER_AXLE**3) / (6 * wide)
    return cam.contact_max * lever.arm / section


def axles(weaver: Weaver) -> Iterator[Occurrence]:
    """The bell cranks' axle from side plate to side plate, and that of the sley's lever on the left one alone."""
    inner = stack_width(weaver.params) / 2
    levers = {lever.straight: (track, lever) for track, lever in weaver.shape.levers.items()}
    for straight, (track, lever) in levers.items():
        long = inner + (station(weaver, track) + lever_thickness(weaver) / 2 if straight else inner)
        name, title = (
            ("sley-axle", "axle of the sley's lever") if straight else ("crank-axle", "axle of the bell cranks")
        )
        part = Part(part_id(name), title, "pin or bush", bar(LEVER_AXLE, long), STEEL)
        yield Occurrence(part, (placement(-inner, lever.pivot.imag, lever.pivot.real).after(ALONG_WIDTH),))


def drawbar(weaver: Weaver, track: str, carriage: float) -> tuple[tuple[Placed, ...], Occurrence]:
    """Two cheeks from a carriage's face to the pin of its lever, and the pin, at rest; carriage: of the face [m]."""
    lever, start = weaver.shape.levers[track], float(weaver.cam(track).motion.s[0])
    pin = lever.pin.real - lever.ratio * (start - lever.lift / 2)
    return pinned(weaver, track, complex(pin, lever.pin.imag), carriage - pin)


def pinned(weaver: Weaver, track: str, pin: complex, beyond: float) -> tuple[tuple[Placed, ...], Occurrence]:
    """Two cheeks of a carriage about the pin of a lever, in the head's axes, and the pin.

    pin  z + i y      beyond  how far they reach to the carriage's face, to the front [m]
    """
    thick, plane = cheek(weaver), weaver.params.cam_thickness
    low, high = min(-OVER, beyond), max(OVER, beyond)
    middle = (low + high) / 2
    outline = polygon(rectangle(high - low, 2 * DRAWBAR).points + middle)
    at = placement(station(weaver, track) + plane / 2, pin.imag, pin.real).after(IN_SIDE_VIEW)
    cheeks = Prism(Profile(outline, (circle(0j, PIN / 2),)), thick)
    places = tuple(at.after(placement(z=z)) for z in (0.0, plane - thick))
    return (Placed(cheeks, places),), Occurrence(lever_pin(weaver), (at,))
