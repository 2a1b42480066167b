"""Cams: motion laws by name, programmes of rises, falls and dwells, plate cams sized by their pressure angle."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Sequence

from ilmek.arguments import Arguments, Quantity
from ilmek.cams import segments
from ilmek.cams.laws import Law, law_of
from ilmek.cams.limits import pressure_angle_max
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme
from ilmek.cams.segments import CamSegment
from ilmek.cams.sizing import CamLimits, smallest_prime
from ilmek.errors import ParameterError
from ilmek.num.piecewise import Extremum
from ilmek.records import shown_value
from ilmek.units import deg


def motion_law(name: str, **parameters: float | Sequence[float]) -> Law:
    """The motion law of a name, like "modified-sine", with its parameters; those left out have their defaults.

    Raises ParameterError for an unknown name or parameter, with the nearest.

    >>> float(motion_law("3-4-5").s(0.5))
    0.5
    >>> motion_law("modified-sine", constant_velocity=0.5).parameters
    {'constant_velocity': 0.5}
    """
    return law_of(Arguments("a motion law").text("name", name), parameters)


def rise(span: Quantity, lift: Quantity, law: Law | str = "modified-sine") -> CamSegment:
    """The follower moves outwards by `lift` [m] over `span` [rad] by a law or the law of a name.

    Raises ParameterError for an unknown law, exchanged arguments, and values probably meant in millimetres or degrees.

    >>> rise("100deg", 0.040, "cycloidal").change
    0.04
    """
    return segments.rise(*_moving("a rise", span, lift, law))


def fall(span: Quantity, lift: Quantity, law: Law | str = "modified-sine") -> CamSegment:
    """The follower moves back by `lift` [m] over `span` [rad]; the rest as of `rise`.

    >>> fall("100deg", 0.040).change
    -0.04
    """
    return segments.fall(*_moving("a fall", span, lift, law))


def dwell(span: Quantity) -> CamSegment:
    """The follower rests over `span` [rad]. Raises ParameterError for a span probably meant in degrees.

    >>> dwell(1.4).span
    1.4
    """
    return segments.dwell(_span("a dwell", span))


def cam_programme(*parts: CamSegment, start: Quantity = 0.0) -> CamProgramme:
    """The motion of a follower over one turn of the cam, from parts that fill the turn and return to the begin.

    start  cam angle [rad] where the first part begins
    Raises ParameterError where the spans do not add up to a turn, or the lifts not to zero.

    >>> shed = cam_programme(rise("90deg", 0.06), fall("90deg", 0.06), dwell("180deg"))
    >>> float(shed.at("90deg").s)
    0.06
    """
    return CamProgramme(parts, Arguments("a cam's programme").angle("start", start))


def plate_cam(
    programme: CamProgramme,
    prime_radius: Quantity | None = None,
    *,
    roller_radius: Quantity = 0.0,
    offset: Quantity = 0.0,
    pressure_angle: Quantity | None = None,
) -> PlateCam:
    """A plate cam with a translating roller follower.

    prime_radius    distance of the roller's centre from the axis at displacement 0 [m]; default: the smallest that
                    keeps the pressure angle of rise and return and can guide the roller
    roller_radius   [m]; 0: a knife edge
    offset          of the follower's line from the axis [m]
    pressure_angle  greatest allowed [rad] for the default of `prime_radius`; default: 30 deg

    `PlateCam.surface(angle)`, `.pitch(angle)`, `.pressure_angle(angle)` give the curves. Raises ParameterError where no
    prime radius keeps the limit, for a pressure angle beside a prime radius, and for probable millimetres or degrees.

    >>> shed = cam_programme(rise("90deg", 0.06), fall("90deg", 0.06), dwell("180deg"))
    >>> cam = plate_cam(shed, roller_radius=0.010, pressure_angle="30deg")
    >>> round(largest_pressure_angle(cam).value / deg, 6)
    30.0
    >>> plate_cam(shed, "150mm").prime_radius
    0.15
    """
    given = Arguments("the cam")
    programme = given.record("programme", programme, CamProgramme)
    roller, line = given.length("roller_radius", roller_radius, least=0.0), given.length("offset", offset)
    if prime_radius is not None:
        if pressure_angle is not None:
            raise ParameterError("prime_radius and pressure_angle are given", do="leave one of them out")
        return PlateCam(programme, given.length("prime_radius", prime_radius), line, roller)
    limit = given.angle("pressure_angle", 30 * deg if pressure_angle is None else pressure_angle)
    trial = PlateCam(programme, _possible(programme, roller, line), line, roller)
    return trial.resized(smallest_prime(trial, CamLimits(rise=limit, fall=limit)).prime_radius)


def largest_pressure_angle(cam: PlateCam) -> Extremum:
    """The largest pressure angle of a cam over the turn: `value` [rad], at the cam angle `at` [rad].

    >>> shed = cam_programme(rise("90deg", 0.06, "harmonic"), fall("90deg", 0.06, "harmonic"), dwell("180deg"))
    >>> greatest = largest_pressure_angle(PlateCam(shed, 0.15))
    >>> bool(abs(PlateCam(shed, 0.15).pressure_angle(greatest.at)) == greatest.value)
    True
    """
    return pressure_angle_max(Arguments("a pressure angle").record("cam", cam, PlateCam))


def _possible(programme: CamProgramme, roller_radius: float, offset: float) -> float:
    """A prime radius that can be built [m]; the search does not depend on it."""
    lowest, highest = programme.bounds
    return 2 * (abs(offset) + roller_radius + highest - lowest + abs(lowest))


def _moving(of: str, span: object, lift: object, law: object) -> tuple[float, float, Law | str]:
    """Span [rad], lift [m] and law of a part that moves."""
    if not isinstance(law, Law | str):
        do = "give the span, the lift and then the law"
        allowed = 'a name like "modified-sine", or a Law'
        raise ParameterError(f"the law of {of} is {shown_value(law)}", allowed=allowed, do=do)
    return _span(of, span), Arguments(of).length("the lift", lift), law


def _span(of: str, span: object) -> float:
    if isinstance(span, Law):
        given = f"the span of {of} is the law {span.name!r}"
        raise ParameterError(given, do="give the arguments in the order of the function")
    return Arguments(of).angle("the span", span)
