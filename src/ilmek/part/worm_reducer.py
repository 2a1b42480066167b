"""Worm reducers: housing with covers, hollow shaft across the worm, torque arm.

Axes: z along the worm, from the motor's flange at z = 0; the hollow shaft along x, its middle below the worm, at -y.
The torque arm lies on the cover at +x, along -y; a shaft comes in from -x. The reducer hangs on this shaft, and its arm
keeps it from turning: a screw in its eye, so that the shaft's run-out forces nothing. Of two worms the first is at the
end of the second, its own across: the motor is then along the hollow shaft, at +x.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.elements.motors import Motor
from ilmek.elements.parallel_keys import KeyedEnd
from ilmek.elements.reducers import Reducer, WormSize
from ilmek.part import catalogue
from ilmek.part.part import Bought, HolePattern, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, box, disc
from ilmek.plane.contours import circle, polygon
from ilmek.plane.curves import hull
from ilmek.report import Contour
from ilmek.units import format_quantity, in_mm, mm, turn

BEFORE = 5 * mm
"""From the bracket to the hollow shaft, along the shaft in it [m]; assumed by this project."""

ARM, _COVER, _EYE, _EDGE = 10 * mm, 8 * mm, 1.25, 1.3
"""Thickness of the torque arm and of a cover [m], length of the arm's eye over its screw's diameter, and from a screw's
axis to the edge about it; assumed by this project."""

_AFTER = 15 * mm
"""From the end of the shaft to that of the hollow shaft, for the disc that holds it [m]; assumed by this project."""

_ROUND = 36
"""Corners of a circle of the arm's outline."""


def eye_radius(row: WormSize) -> float:
    """Of the eye of a torque arm [m]: as far about its screw as the thread below needs."""
    return 1.5 * SOCKET_SCREWS[row.screw].diameter


def eye_face(row: WormSize) -> float:
    """Face of the eye from the middle of the hollow shaft, along it [m]: what holds the arm stands before it."""
    return row.cover + ARM / 2 - _EYE * SOCKET_SCREWS[row.screw].diameter / 2


def journal(row: WormSize) -> float:
    """Length of the shaft in the hollow shaft [m]."""
    return row.length - _AFTER


def worm_reducer(  # noqa: PLR0917
    name: str, title: str, by: Reducer, row: WormSize, motor: Motor | None, end: KeyedEnd
) -> Part:
    """A worm reducer of a size, priced by its motor; end  of the shaft in it: the room of both is open."""
    corner = complex(end.diameter / 2 + end.keyway.in_hub, end.keyway.width / 2)  # the key's
    bore, about = (
        circle(0j, abs(corner) + catalogue.HOLLOW),
        row.circle / 2 + _EDGE * SOCKET_SCREWS[row.thread].diameter,
    )
    face, first, flange = _face(motor), row.first(by.ratio), inlet(row, by.ratio, motor)
    inside, across = row.cover - _COVER, placement(0.0, -row.centre, flange, about=(0.0, 1.0, 0.0), angle=turn / 4)

    def beside(x: float, profile: Profile, length: float, y: float = 0.0) -> Placed:
        return Placed(Prism(profile, length), (placement(x, y).after(across),))

    below, above = complex(-row.half, -row.half), complex(row.half, row.top)
    corners = np.array([below, complex(above.real, below.imag), above, complex(below.real, above.imag)])
    eye = circle(-1j * row.arm, eye_radius(row))
    long = _EYE * SOCKET_SCREWS[row.screw].diameter
    pilots = disc(row.pilot / 2, bore)
    room = Sum(
        (
            beside(-inside, Profile(polygon(corners), (bore,)), 2 * inside),
            *(beside(x, disc(about, bore), _COVER) for x in (-row.cover, inside)),
            *(beside(x, pilots, row.length / 2 - row.cover) for x in (-row.length / 2, row.cover)),
            *(_first_stage(first, face, flange - row.half) if first else (Placed(box(face, face, flange - row.half)),)),
            beside(row.cover, Profile(_arm(row, about), (circle(0j, row.pilot / 2), eye)), ARM),
            beside(eye_face(row), disc(eye_radius(row)), long, -row.arm),
        )
    )
    given = max(by.output_torque(motor.torque) if motor else 0.0, end.torque)
    request = "" if math.isclose(end.diameter, row.bore) else f", on request, not {in_mm(row.bore)}"
    data = (
        f"{row.name}, hollow shaft {in_mm(end.diameter)} H7{request}, keyway DIN 6885-1",
        "disc and screw for the end of the shaft",
        f"torque arm {in_mm(row.arm)} on a cover, its eye for {row.screw}",
        f"output {format_quantity(given, 'Nm', 3)}",
        *((f"for a motor with {catalogue.flange_text(motor)}",) if motor else ()),
    )
    holes = (
        HolePattern(0.0, 0.0, row.screw, faces=(0,)),
        replace(*catalogue.flange_holes(motor), tapped=True, faces=(0,) if first else (-1,)),
    )
    power, kind = motor.power if motor else 0.0, f"worm reducer {by.ratio:g}:1"
    bought = Bought(kind, row.mass, power=power, data=", ".join(data), holes=holes)
    return bought_part(name, title, "reducer", room, bought)


def _first_stage(first: WormSize, face: float, end: float) -> tuple[Placed, ...]:
    """Housing of a first worm, about z from z = 0, what joins it to the second, which begins at `end`, its neck."""
    long, across = max(first.length, face), first.half + first.top
    middle = placement(0.0, (first.half - first.top) / 2)
    neck = placement(first.half, -first.centre, long / 2, about=(0.0, 1.0, 0.0), angle=turn / 4)
    return (
        Placed(box(2 * first.half, across, long), (middle,)),
        Placed(box(first.half, first.half, end - long), (placement(z=long),)),
        Placed(box(face, face, first.motor - first.half), (neck,)),
    )


def _face(motor: Motor | None) -> float:
    return motor.face if motor else catalogue.SPECIAL_FACE


def inlet(row: WormSize, ratio: float, motor: Motor | None) -> float:
    """From the axis of the hollow shaft to the end of the housing along the worm [m]: to the motor's flange of one."""
    first = row.first(ratio)
    return row.motor + (max(first.length, _face(motor)) if first else 0.0)


def motor_in(row: WormSize, ratio: float, motor: Motor | None) -> Placement:
    """Position of the motor in the reducer's axes."""
    first = row.first(ratio)
    if first is None:
        return placement()
    middle = max(first.length, _face(motor)) / 2
    return placement(first.motor, -first.centre, middle, about=(0.0, 1.0, 0.0), angle=-turn / 4)


def _arm(row: WormSize, about: float) -> Contour:
    """Outline of the torque arm: about the cover's screws, and its eye."""
    ring, edge = np.exp(1j * turn * np.arange(_ROUND) / _ROUND), eye_radius(row) + ARM / 2
    return polygon(hull(np.concatenate([about * ring, -1j * row.arm + edge * ring])))


def reducer_position(row: WormSize, long: float, middle: float, arm: complex) -> Placement:
    """Position of a worm reducer on a shaft along z.

    long  to its end along the worm, `inlet`      middle  of the hollow shaft on it [m]
    arm   direction of the torque arm across the shaft, x + i y
    """
    along, motor = -1j * arm, (1j * long - row.centre) * arm
    axes = np.array([[0.0, -arm.real, along.real], [0.0, -arm.imag, along.imag], [1.0, 0.0, 0.0]])
    return Placement(np.array([motor.real, motor.imag, middle]), axes)


def eye(row: WormSize, middle: float, arm: complex) -> Placement:
    """Middle of the face of its eye, z along the shaft, before what holds it [m]."""
    return placement(row.arm * arm.real, row.arm * arm.imag, middle + eye_face(row))
