"""Conjugate plate cams: two plates on one shaft hold a double follower from both sides, without spring and play.

What one roller goes out the other comes in; the second plate's programme is the rest of the way,

    s2 = top - s1

Two rollers (or two parallel faces) in one slide, the distance D apart with the shaft between them: the second plate is
met half a turn further on, and its prime radius follows from D (both without offset: Rp2 = D - Rp1 - top). Two arms or
two faces on one pivot with a fixed angle gamma between them, one on each side of the line to the axis:
psi2 = gamma - psi1. Both plates share the frame of the shaft.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.flat import FlatCam
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme
from ilmek.cams.sizing import CamLimits, smallest_prime
from ilmek.cams.trace import CamTrace
from ilmek.errors import ParameterError
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class ConjugatePair:
    """Two conjugate plates; the second is met at the cam angle + `lag` [rad] of its own programme."""

    first: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam
    second: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam
    lag: float

    def traces(self, angle: FloatArray) -> tuple[CamTrace, CamTrace]:
        """Both plates' traces at the moments when the shaft stands at the angles [rad], in the shaft's frame."""
        return self.first.trace(angle), self.second.trace(angle + self.lag)

    def between(self, angle: FloatArray) -> ComplexArray:
        """From the first roller's centre to the second's, in the shaft's frame [m]; of one length all round.

        Of faces, from one place of contact to the other.
        """
        first, second = self.traces(angle)
        return np.asarray(second.pitch - first.pitch)


def remaining_rise(programme: CamProgramme) -> CamProgramme:
    """The programme top - s, begun where s is highest between two parts, so that it starts from 0 again."""
    bases = programme.bases
    highest = max(range(len(bases)), key=lambda place: bases[place])
    turned = [
        replace(part, change=-part.change, scale=None if part.scale is None else -part.scale)
        for part in (*programme.segments[highest:], *programme.segments[:highest])
    ]
    return CamProgramme(tuple(turned), start=programme.start + float(programme.edges[highest]))


def conjugate(cam: PlateCam, distance: float, roller_radius: float | None = None) -> ConjugatePair:
    """A plate and the one that holds its slide back: roller centres `distance` [m] apart on the slide's line.

    roller_radius  of the second roller [m]; None: as the first
    Raises ParameterError where the distance leaves the second plate no prime circle.
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


def smallest_conjugate(cam: PlateCam, limits: CamLimits) -> ConjugatePair:
    """The pair whose plates are both as small as the limits allow; the cam's own prime radius does not matter.

    Each plate pushes where its own roller goes out, so that the limit of the rise is the second's on the way back.
    Raises ParameterError where a plate cannot keep the limits.
    """
    first = cam.resized(smallest_prime(cam, limits).prime_radius)
    rest = replace(cam, programme=remaining_rise(cam.programme), offset=-cam.offset)
    second = smallest_prime(rest, limits).prime_radius
    reaches = [math.sqrt(radius**2 - cam.offset**2) for radius in (first.prime_radius, second)]
    return conjugate(first, sum(reaches) + _top(cam.programme))


def conjugate_faces(cam: FlatCam, distance: float) -> ConjugatePair:
    """A plate between two parallel faces `distance` [m] apart, and the second plate that the other face needs.

    Where s1(theta) + s1(theta + pi) = top both are one plate: a cam of constant breadth.
    Raises ParameterError where the distance leaves the second plate no base circle.
    """
    radius = distance - cam.prime_radius - _top(cam.programme)
    if radius <= 0:
        _refuse(distance, cam.prime_radius + _top(cam.programme))
    rest = remaining_rise(cam.programme).shifted(math.pi)
    return ConjugatePair(cam, FlatCam(rest, radius, -cam.offset), math.pi)


def conjugate_arms(
    cam: OscillatingCam, between: float, arm: float | None = None, roller_radius: float | None = None
) -> ConjugatePair:
    """A plate and the one that holds its arm back by a second arm on the same pivot.

    between  angle between the arms, over the shaft [rad]      arm, roller_radius  of the second; None: as the first
    Raises ParameterError where the angle leaves the second arm no way to its plate.
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
    """A plate and the one that holds its face back by a second face on the same pivot.

    between  angle between the faces, over the shaft [rad]
    face_offset  how far the second face lies beyond the pivot, away from its cam [m]
    Raises ParameterError where the angle leaves the second plate no base circle.
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
    """Displacement at the highest end of a part."""
    return max(programme.bases)


def _refuse(distance: float, least: float) -> None:
    shown = format_quantity(distance, "mm")
    raise ParameterError(f"distance={shown} between the followers", allowed=f"above {format_quantity(least, 'mm')}")
