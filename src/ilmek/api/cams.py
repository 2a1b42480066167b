"""Cams: motion laws by name, programmes of rises, falls and dwells, plate cams sized by their pressure angle."""

from typing import Any

from ilmek.api.slips import check_angle, check_law, check_lengths
from ilmek.cams import segments
from ilmek.cams.laws import Law, law_of
from ilmek.cams.limits import pressure_angle_max
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme
from ilmek.cams.segments import CamSegment
from ilmek.cams.sizing import CamLimits, smallest_prime
from ilmek.errors import ParameterError
from ilmek.num.piecewise import Extremum
from ilmek.units import deg


def motion_law(name: str, **parameters: Any) -> Law:
    """The motion law of a name, like "modified-sine", with its parameters; those left out have their defaults.

    Raises ParameterError for an unknown name or parameter, with the nearest.
    """
    return law_of(name, parameters)


def rise(span: float, lift: float, law: Law | str = "modified-sine") -> CamSegment:
    """The follower moves outwards by `lift` [m] over `span` [rad] by a law or the law of a name.

    Raises ParameterError for an unknown law, exchanged arguments, and values probably meant in millimetres or degrees.
    """
    _check("rise", span, lift, law)
    return segments.rise(span, lift, law)


def fall(span: float, lift: float, law: Law | str = "modified-sine") -> CamSegment:
    """The follower moves back by `lift` [m] over `span` [rad]; the rest as of `rise`."""
    _check("fall", span, lift, law)
    return segments.fall(span, lift, law)


def dwell(span: float) -> CamSegment:
    """The follower rests over `span` [rad]. Raises ParameterError for a span probably meant in degrees."""
    check_angle(ParameterError, "the span of a dwell", span)
    return segments.dwell(span)


def cam_programme(*parts: CamSegment, start: float = 0.0) -> CamProgramme:
    """The motion of a follower over one turn of the cam, from parts that fill the turn and return to the begin.

    start  cam angle [rad] where the first part begins
    Raises ParameterError where the spans do not add up to a turn, or the lifts not to zero.
    """
    return CamProgramme(tuple(parts), start)


def plate_cam(
    programme: CamProgramme,
    prime_radius: float | None = None,
    *,
    roller_radius: float = 0.0,
    offset: float = 0.0,
    pressure_angle: float | None = None,
) -> PlateCam:
    """A plate cam with a translating roller follower.

    prime_radius    distance of the roller's centre from the axis at displacement 0 [m]; default: the smallest that
                    keeps the pressure angle of rise and return and can guide the roller
    roller_radius   [m]; 0: a knife edge
    offset          of the follower's line from the axis [m]
    pressure_angle  greatest allowed [rad] for the default of `prime_radius`; default: 30 deg

    `PlateCam.surface(angle)`, `.pitch(angle)`, `.pressure_angle(angle)` give the curves. Raises ParameterError where no
    prime radius keeps the limit, for a pressure angle beside a prime radius, and for probable millimetres or degrees.
    """
    check_lengths(
        ParameterError, "the cam", prime_radius=prime_radius or 0.0, roller_radius=roller_radius, offset=offset
    )
    if prime_radius is not None:
        if pressure_angle is not None:
            raise ParameterError("prime_radius and pressure_angle are given", do="leave one of them out")
        return PlateCam(programme, prime_radius, offset, roller_radius)
    limit = 30 * deg if pressure_angle is None else pressure_angle
    check_angle(ParameterError, "pressure_angle of the cam", limit)
    trial = PlateCam(programme, _possible(programme, roller_radius, offset), offset, roller_radius)
    return trial.resized(smallest_prime(trial, CamLimits(rise=limit, fall=limit)).prime_radius)


def largest_pressure_angle(cam: PlateCam) -> Extremum:
    """The largest pressure angle of a cam over the turn: `value` [rad], at the cam angle `at` [rad]."""
    return pressure_angle_max(cam)


def _possible(programme: CamProgramme, roller_radius: float, offset: float) -> float:
    """A prime radius that can be built [m]; the search does not depend on it."""
    lowest, highest = programme.bounds
    return 2 * (abs(offset) + roller_radius + highest - lowest + abs(lowest))


def _check(kind: str, span: object, lift: object, law: object) -> None:
    check_law(kind, law)
    check_lengths(ParameterError, f"a {kind}", **{"the lift": lift})  # type: ignore[arg-type]
    check_angle(ParameterError, f"the span of a {kind}", span)  # type: ignore[arg-type]
