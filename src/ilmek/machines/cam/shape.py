"""The cam's programme, its smallest size, and the cam of a size, by the kinds of cam and follower."""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.barrel import BarrelCam
from ilmek.cams.conjugate import ConjugatePair, conjugate, conjugate_arms, conjugate_faces
from ilmek.cams.flat import FlatCam
from ilmek.cams.laws import Law
from ilmek.cams.loaded_cam import CamShape
from ilmek.cams.oscillating import OscillatingCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime, smallest_prime
from ilmek.cams.strip import WedgeCam
from ilmek.cams.trace import CamRole
from ilmek.elements.cam_rollers import ROLLERS
from ilmek.errors import ParameterError
from ilmek.machines.cam.params import NO_DWELL, CamParams
from ilmek.num.piecewise import Extremum
from ilmek.units import format_quantity, mm


def programme_of(params: CamParams, laws: tuple[Law, Law] | None = None) -> CamProgramme:
    """Rise, dwell, fall and rest [m; rad of an arm]; the rise begins at the cam angle 0.

    laws  of rise and fall; None: those of the parameters
    """
    rising, falling = laws or params.laws()
    rest = TURN - params.rise - params.dwell - params.fall_angle
    lift = params.lift / params.per_unit
    segments = [
        rise(params.rise, lift, rising),
        *([dwell(params.dwell)] if params.dwell > NO_DWELL else []),
        fall(params.fall_angle + (rest if rest <= NO_DWELL else 0.0), lift, falling),
        *([dwell(rest)] if rest > NO_DWELL else []),
    ]
    return CamProgramme(tuple(segments))


def part_knots(programme: CamProgramme, name: str) -> FloatArray:
    """Cam angles between which the rise, or the fall, is smooth."""
    index = next(i for i, segment in enumerate(programme.segments) if segment.name == name)
    begin, segment = float(programme.edges[index]), programme.segments[index]
    return np.array([begin + u * segment.span for u in (0.0, *segment.law.breaks, 1.0)])


@dataclass(frozen=True, slots=True)
class CamSize:
    """Prime radius [m], the smallest for the limits, and the cam angle that requires it."""

    prime_radius: float
    smallest: Extremum


def size_of(params: CamParams, programme: CamProgramme) -> CamSize:
    """The prime radius: the given one, or the smallest for the limit; the base circle's of a flat follower.

    Raises ParameterError where none is given and none does.
    """
    smallest = smallest_of(params, programme)
    return CamSize(params.prime_radius or smallest.value, smallest)


def smallest_of(params: CamParams, programme: CamProgramme) -> Extremum:
    """The smallest prime radius for the limit; NaN where none does and one is given.

    For a slide with a roller the pressure angle alone decides; for any other cam a surface must exist too.
    """
    if params.motion == "translating" and params.follower != "flat" and not params.laid_flat:
        extremum = pressure_prime(programme, limits_of(params), params.offset)
        # A nearly flat rise hardly limits the circle: it must still be larger than offset and roller.
        room = max(abs(params.offset), params.roller_radius or 0.0)
        return extremum if extremum.value > room else Extremum(extremum.at, room * (1 + 1e-9))
    try:
        size = smallest_prime(_cam(params, programme, None, params.roller_radius or 0.0), limits_of(params))
    except ParameterError:
        if params.prime_radius is None:
            raise
        return Extremum(0.0, math.nan)
    return Extremum(size.at, size.prime_radius)


def limits_of(params: CamParams) -> CamLimits:
    """The limits that set the size: a cam that leads both ways also pushes on the fall."""
    if params.follower == "flat":
        return CamLimits(convex=params.curvature_least)
    return CamLimits(rise=params.limit, fall=params.fall_limit)


def cams_of(params: CamParams, programme: CamProgramme, size: CamSize, roller_radius: float) -> CamShape:
    """The cam of a size and a roller, and the second of two conjugate ones.

    Raises ParameterError, naming the smallest size, where it cannot exist.
    """
    cam = cam_of(params, programme, size, roller_radius)
    return CamShape(cam, _pair(params, cam) if params.kind == "conjugate" else None)


def _pair(params: CamParams, cam: CamRole) -> ConjugatePair:
    """Both plates; by default they have equal prime circles."""
    lift = params.lift / params.per_unit
    if isinstance(cam, OscillatingCam):
        return conjugate_arms(cam, params.between or 2 * cam.start_angle + lift)
    if isinstance(cam, FlatCam):
        return conjugate_faces(cam, params.distance or 2 * cam.prime_radius + lift)
    if not isinstance(cam, PlateCam):
        raise TypeError(cam)
    own = math.sqrt(cam.prime_radius**2 - cam.offset**2)
    return conjugate(cam, params.distance or 2 * own + lift)


def cam_of(params: CamParams, programme: CamProgramme, size: CamSize, roller_radius: float) -> CamRole:
    """The cam of a size and a roller. Raises ParameterError, naming the smallest size, where it cannot exist."""
    try:
        return _cam(params, programme, size.prime_radius, roller_radius)
    except ParameterError as error:
        least = size.smallest.value
        do = f"the smallest for the limits is {format_quantity(least, 'mm')}" if least > 0 else error.do
        raise ParameterError(error.given, allowed=error.allowed, do=do) from None


def size_without_undercut(params: CamParams, programme: CamProgramme, roller_radius: float) -> float:
    """The least prime radius [m] that keeps the limit and suits a roller; inf where none does."""
    try:
        return smallest_prime(_cam(params, programme, None, roller_radius), limits_of(params)).prime_radius
    except ParameterError:
        return math.inf


def roller_width(params: CamParams, roller_radius: float) -> float:
    """Width of the cam's face [m]: as given, as the roller's of the table, or 10 mm."""
    known = (roller.width for roller in ROLLERS.values() if math.isclose(roller.radius, roller_radius))
    return params.face_width or next(known, 10 * mm)


def _cam(params: CamParams, programme: CamProgramme, prime_radius: float | None, roller_radius: float) -> CamRole:
    """The cam of a prime radius [m]; of any that can be built where none is given."""
    if params.kind == "wedge":
        return WedgeCam(programme, (prime_radius or 1.0) * TURN, roller_radius, used=params.rise + params.dwell)
    if params.laid_flat:
        return BarrelCam(programme, prime_radius or 10.0, roller_radius, roller_width(params, roller_radius))
    flat, pivot, side = params.follower == "flat", params.pivot_distance, params.side_sign
    if params.motion == "translating" and flat:
        return FlatCam(programme, prime_radius or 1.0, params.offset)
    if params.motion == "translating":
        return PlateCam(programme, prime_radius or 10.0, params.offset, roller_radius)
    if flat:
        any_size = 0.5 * (pivot * math.cos(params.lift / params.arm_length) + params.face_offset)
        return OscillatingFlatCam(programme, prime_radius or any_size, pivot, params.face_offset, side)
    arm, swing = params.arm_length, params.lift / params.arm_length
    low = max(abs(pivot - arm), roller_radius)
    any_size = 0.5 * (low + math.sqrt(pivot**2 + arm**2 + 2 * pivot * arm * math.cos(swing)))
    return OscillatingCam(programme, prime_radius or any_size, pivot, arm, side, roller_radius)
