"""Conjugate plate cams: two plates on one shaft guide a double follower from both sides, without spring and backlash.

When one roller moves out the other moves in, so the displacement of the second plate is the remaining lift:

    s2 = top - s1

Two rollers (or two parallel faces) on one slide are the distance D apart, with the shaft between them. The second plate
is touched half a turn further on, and its prime radius follows from D (both without offset: Rp2 = D - Rp1 - top). Two
arms or two faces on one pivot have a fixed angle gamma between them, one on each side of the line to the axis: psi2 =
gamma - psi1. Both plates are described in the frame of the shaft.      [derived from the constant distance or angle]
"""

import math
from dataclasses import replace
from typing import Literal

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.flat import FlatCam
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme
from ilmek.cams.trace import CamTrace
from ilmek.errors import ParameterError
from ilmek.records import value_record
from ilmek.units import format_quantity


@value_record
class ConjugatePair:
    """Two conjugate plates; the second is touched at the cam angle + `lag` [rad] of its own programme."""

    first: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam
    second: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam
    lag: float

    def traces(self, angle: FloatArray) -> tuple[CamTrace, CamTrace]:
        """Traces of both plates at shaft angles [rad], in the shaft's frame."""
        return self.first.trace(angle), self.second.trace(angle + self.lag)

    def between(self, angle: FloatArray) -> ComplexArray:
        """Vector from the first roller's centre to the second's, in the shaft's frame [m], at shaft angles [rad].

        For faces, from one contact point to the other. The length of the vector is constant for rollers.
        """
        first, second = self.traces(angle)
        return np.asarray(second.pitch - first.pitch)


def remaining_rise(programme: CamProgramme) -> CamProgramme:
    """The programme top - s [m; rad].

    It starts where s is highest between two parts, so its displacement starts at 0.
    """
    bases = programme.bases
    highest = max(range(len(bases)), key=lambda number: bases[number])
    turned = [
        replace(part, change=-part.change, scale=None if part.scale is None else -part.scale)
        for part in (*programme.segments[highest:], *programme.segments[:highest])
    ]
    return CamProgramme(tuple(turned), start=programme.start + float(programme.edges[highest]))


def conjugate(cam: PlateCam, distance: float, roller_radius: float | None = None) -> ConjugatePair:
    """The pair of a plate and the second plate that returns its slide.

    distance       of the two rollers' centres along the slide's line [m]
    roller_radius  of the second roller [m]; default: that of the first
    Raises ParameterError for a distance too small for the second plate.
    """
    top = _top(cam.programme)
    own = math.sqrt(cam.prime_radius**2 - cam.offset**2)
    least = max(abs(cam.offset), cam.roller_radius if roller_radius is None else roller_radius)
    reach = distance - own - top
    if reach <= math.sqrt(least**2 - cam.offset**2):
        _refuse(distance, own + top + math.sqrt(least**2 - cam.offset**2))
    second = PlateCam(
        programme=remaining_rise(cam.programme).shifted(math.pi),
        prime_radius=math.hypot(reach, cam.offset),
        offset=-cam.offset,
        roller_radius=cam.roller_radius if roller_radius is None else roller_radius,
    )
    return ConjugatePair(cam, second, math.pi)


def conjugate_faces(cam: FlatCam, distance: float) -> ConjugatePair:
    """The pair of a plate and the second plate for a slide of two parallel faces.

    distance  between the faces [m]

    Where s1(theta) + s1(theta + pi) = top both plates are equal: a constant-breadth cam.
    Raises ParameterError for a distance too small for the second plate.
    """
    radius = distance - cam.prime_radius - _top(cam.programme)
    if radius <= 0:
        _refuse(distance, cam.prime_radius + _top(cam.programme))
    rest = remaining_rise(cam.programme).shifted(math.pi)
    return ConjugatePair(cam, FlatCam(rest, radius, -cam.offset), math.pi)


def conjugate_arms(
    cam: OscillatingCam, between: float, arm: float | None = None, roller_radius: float | None = None
) -> ConjugatePair:
    """The pair of a plate and the second plate that returns its arm by a second arm on the same pivot.

    between             angle between the arms, across the shaft [rad]
    arm, roller_radius  of the second arm [m]; default: those of the first
    Raises ParameterError for an angle at which the second arm does not reach its plate.
    """
    length = cam.arm if arm is None else arm
    radius = cam.roller_radius if roller_radius is None else roller_radius
    top = _top(cam.programme)
    start = between - cam.start_angle - top
    if not 0 < start < math.pi:
        least = cam.start_angle + top
        raise ParameterError(
            f"{format_quantity(between, 'deg')} between the arms",
            allowed=f"above {format_quantity(least, 'deg')}, below {format_quantity(least + math.pi, 'deg')}",
        )
    prime = math.sqrt(cam.pivot**2 + length**2 - 2 * cam.pivot * length * math.cos(start))
    rest = remaining_rise(cam.programme)
    side: Literal[1, -1] = -1 if cam.side == 1 else 1
    return ConjugatePair(cam, OscillatingCam(rest, prime, cam.pivot, length, side, radius), 0.0)


def conjugate_swinging_faces(cam: OscillatingFlatCam, between: float, face_offset: float = 0.0) -> ConjugatePair:
    """The pair of a plate and the second plate that returns its face by a second face on the same pivot.

    between      angle between the faces, across the shaft [rad]
    face_offset  distance of the second face beyond the pivot, away from its cam [m]
    Raises ParameterError for an angle that leaves no base circle for the second plate.
    """
    top = _top(cam.programme)
    start = between - cam.start_angle - top
    prime = cam.pivot * math.sin(start) + face_offset
    if not (prime > 0 and start + top < math.pi / 2):
        first = cam.start_angle + top
        least, most = (
            first + end for end in (-math.asin(max(-1.0, min(face_offset / cam.pivot, 1.0))), math.pi / 2 - top)
        )
        raise ParameterError(
            f"{format_quantity(between, 'deg')} between the faces",
            allowed=f"above {format_quantity(least, 'deg')}, below {format_quantity(most, 'deg')}",
        )
    rest = remaining_rise(cam.programme)
    side: Literal[1, -1] = -1 if cam.side == 1 else 1
    return ConjugatePair(cam, OscillatingFlatCam(rest, prime, cam.pivot, face_offset, side), 0.0)


def _top(programme: CamProgramme) -> float:
    """Largest displacement at the ends of the parts [m or rad]."""
    return max(programme.bases)


def _refuse(distance: float, least: float) -> None:
    shown = format_quantity(distance, "mm")
    raise ParameterError(f"distance={shown} between the followers", allowed=f"above {format_quantity(least, 'mm')}")
