"""The cam's programme, its smallest size, and the cam of a size: what depends on what the cam and its follower are."""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.flat import FlatCam
from ilmek.cams.limits import convex_radius_min
from ilmek.cams.pieces import Extremum, supremum
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, Programme, dwell, fall, rise
from ilmek.cams.trace import Cam
from ilmek.errors import ParameterError
from ilmek.machines.cam.params import LIMIT, NO_DWELL, CamParams
from ilmek.units import format_quantity

LARGEST = 1e3
"""Prime radius [m] beyond which no roller's undercut is sought to be avoided."""


def programme_of(params: CamParams) -> Programme:
    """Rise, dwell, fall and rest; the rise begins at the cam angle 0."""
    rising, falling = params.laws()
    rest = TURN - params.rise - params.dwell - params.fall_angle
    segments = [
        rise(params.rise, params.lift, rising),
        *([dwell(params.dwell)] if params.dwell > NO_DWELL else []),
        fall(params.fall_angle + (rest if rest <= NO_DWELL else 0.0), params.lift, falling),
        *([dwell(rest)] if rest > NO_DWELL else []),
    ]
    return Programme(tuple(segments))


def part_knots(programme: Programme, name: str) -> FloatArray:
    """Cam angles between which the rise, or the fall, is smooth."""
    place = next(i for i, segment in enumerate(programme.segments) if segment.name == name)
    begin, segment = float(programme.edges[place]), programme.segments[place]
    return np.array([begin + u * segment.span for u in (0.0, *segment.law.breaks, 1.0)])


@dataclass(frozen=True, slots=True)
class Size:
    """Prime radius [m] taken, the smallest that would do, and the cam angle that asks for it."""

    prime_radius: float
    smallest: Extremum


def size_of(params: CamParams, programme: Programme) -> Size:
    """The prime radius: the given one, or the smallest for the limit; the base circle's of a flat follower."""
    smallest = _for_convex(params, programme) if params.follower == "flat" else _for_pressure(params, programme)
    return Size(params.prime_radius or max(smallest.value, params.roller_radius or 0.0), smallest)


def cam_of(params: CamParams, programme: Programme, size: Size, roller_radius: float) -> Cam:
    """The cam of a size and a roller. Raises ParameterError, naming the smallest size, where it cannot exist."""
    prime, offset = size.prime_radius, params.offset
    if params.follower == "flat":
        return FlatCam(programme, prime, offset)
    if prime <= max(abs(offset), roller_radius):
        shown, asked = (format_quantity(value, "mm") for value in (prime, max(abs(offset), roller_radius)))
        word = "the offset" if abs(offset) >= roller_radius else "the roller's radius"
        do = f"the smallest for the pressure angle is {format_quantity(size.smallest.value, 'mm')}"
        raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above {word}, {asked}", do=do)
    return PlateCam(programme, prime, offset, roller_radius)


def size_without_undercut(params: CamParams, programme: Programme, roller_radius: float) -> float:
    """The least prime radius [m], from the pressure angle's on, at which the pitch curve suits a roller; inf: none."""
    low = max(size_of(params, programme).smallest.value, abs(params.offset), roller_radius) * (1 + 1e-9)

    def suits(prime: float) -> bool:
        return convex_radius_min(PlateCam(programme, prime, params.offset)).value > roller_radius

    high = low
    while not suits(high):
        low, high = high, 2 * high
        if high > LARGEST:
            return math.inf
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if suits(middle) else (middle, high)
    return high


def _for_pressure(params: CamParams, programme: Programme) -> Extremum:
    """Rp = sqrt(d^2 + e^2), d = sup(|s' - e| / tan(limit) - s) over the rise."""
    slope = math.tan(params.limit or LIMIT)

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.asarray(np.abs(at.ds - params.offset) / slope - at.s)

    worst = supremum(demand, part_knots(programme, "rise"))
    return Extremum(worst.at, math.hypot(max(worst.value, 0.0), params.offset))


def _for_convex(params: CamParams, programme: Programme) -> Extremum:
    """Rb = sup(-(s + s'')) + least radius of curvature, over the turn."""

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.asarray(-(at.s + at.dds))

    worst = supremum(demand, programme.knots)
    return Extremum(worst.at, max(worst.value, 0.0) + params.curvature_least)
