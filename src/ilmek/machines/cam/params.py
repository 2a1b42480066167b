"""What may be asked of a cam: its motion, its size or the limit that sets it, its follower, what it carries."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ilmek.cams.laws import LAWS, Law, law_of
from ilmek.cams.programme import TURN
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.cam.rollers import find_roller
from ilmek.params import Params, param
from ilmek.units import N, deg, format_quantity, kg, mm, rpm

NO_DWELL = 1e-9
"""Angles below this are rounding [rad]."""

LIMIT = 30 * deg
"""Largest pressure angle of a slide on the rise where nothing is said [Norton, Cam Design and Manufacturing, 7.2]."""

FOLLOWERS = ("roller", "knife", "flat", "spherical")
"""What touches the cam."""


@dataclass(frozen=True, slots=True)
class CamParams(Params):
    """The parameters of a cam: motion, size and follower, loads and material."""

    law: str = param("modified-sine", choices=tuple(LAWS), doc="motion law of the rise, and of the fall")
    motion: str = param(
        "translating", choices=("translating", "oscillating"), doc="how the follower moves: on a slide, or on an arm"
    )
    law_parameters: str = param(
        "", doc="parameters of the law, like `b=0.25 c=0.5 d=0.25` or `u=0.3,0.7 s=0.2,0.9`; none: its defaults"
    )
    lift: float = param(
        20 * mm,
        unit="mm",
        at_least=0.01 * mm,
        at_most=1.0,
        doc="lift of the follower; of an arm along its arc",
        symbol="L",
    )
    rise: float = param(
        90 * deg, unit="deg", at_least=0.1 * deg, below=TURN, doc="cam angle of the rise", symbol="beta"
    )
    dwell: float = param(0.0, unit="deg", at_least=0.0, below=TURN, doc="cam angle for which it stays lifted")
    fall: float | None = param(
        None,
        unit="deg",
        at_least=0.1 * deg,
        below=TURN,
        doc="cam angle of the fall; none: as the rise, or the rest of the turn where that is less",
    )
    fall_law: str | None = param(None, choices=tuple(LAWS), doc="motion law of the fall; none: as the rise")
    fall_law_parameters: str = param("", doc="parameters of the law of the fall, where it has one of its own")
    speed: float = param(60 * rpm, unit="rpm", at_least=0.0, at_most=1e4, doc="speed of the cam", symbol="w")
    angle: float | None = param(
        None, unit="deg", at_least=0.0, at_most=TURN, doc="cam angle from the start of the rise to look at, as `at`"
    )
    kind: str = param(
        "plate",
        choices=("plate", "grooved", "conjugate", "barrel", "face", "wedge"),
        doc="a plate with a spring, a groove, two plates on a shaft, a barrel's groove, a barrel's end, a wedge",
    )
    follower: str = param("roller", choices=FOLLOWERS, doc="what touches the cam")
    pressure_angle_limit: float | None = param(
        None,
        unit="deg",
        at_least=1 * deg,
        below=90 * deg,
        doc="largest pressure angle on the rise; none: 30 deg, where no prime radius is given either",
        symbol="mu",
    )
    prime_radius: float | None = param(
        None,
        unit="mm",
        at_least=1e-3 * mm,
        at_most=10.0,
        doc="prime radius; base radius of a flat follower, mean radius of a barrel, travel for a radian of a wedge; "
        "none: the smallest for the limit",
        symbol="Rp",
    )
    roller_radius: float | None = param(
        None, unit="mm", at_least=0.0, at_most=1.0, doc="radius of roller or ball; none: chosen", symbol="Rr"
    )
    roller: str | None = param(None, doc="cam follower from the table, like `CF 10`; none: the smallest that lasts")
    offset: float = param(
        0.0,
        unit="mm",
        at_least=-1.0,
        at_most=1.0,
        doc="distance of the follower's line from the axis; positive lowers the pressure angle of the rise",
        symbol="e",
    )
    arm: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=10.0,
        doc="length of the arm to roller, or to where mass, load and spring act; none: three times the lift",
    )
    pivot: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=10.0,
        doc="distance of the arm's pivot from the cam's axis; none: 4/3 of the arm, 5/2 of a flat one",
    )
    side: str = param(
        "trailing",
        choices=("trailing", "leading"),
        doc="whether the cam's surface drags the arm away from its pivot, or pushes it towards it",
    )
    distance: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=10.0,
        doc="between the followers of conjugate cams on a slide; none: so that both have one prime circle",
    )
    between: float | None = param(
        None,
        unit="deg",
        at_least=1 * deg,
        below=TURN,
        doc="angle between the arms of conjugate cams; none: so that both have one prime circle",
    )
    face_offset: float = param(
        0.0, unit="mm", at_least=-1.0, at_most=1.0, doc="how far an arm's flat face lies beyond its pivot"
    )
    curvature_least: float = param(
        1 * mm,
        unit="mm",
        at_least=0.0,
        at_most=1.0,
        doc="least radius of curvature of a cam for a flat follower, where its base circle is to be found",
    )
    mass: float = param(
        0.5 * kg, unit="kg", at_least=0.0, at_most=1e5, doc="mass that the follower moves, with its own"
    )
    load: float = param(
        100 * N,
        unit="N",
        at_least=0.0,
        at_most=1e7,
        doc="force that always presses the follower to the cam, weight too",
    )
    spring_rate: float | None = param(
        None, unit="N/mm", at_least=0.0, at_most=1e9, doc="rate of the return spring; none: chosen"
    )
    preload: float | None = param(
        None, unit="N", at_least=0.0, at_most=1e7, doc="force of the return spring at the lowest place; none: chosen"
    )
    hold_speed: float | None = param(
        None,
        unit="rpm",
        at_least=0.0,
        at_most=1e4,
        doc="speed up to which the spring is to hold; none: 1.2 times speed",
    )
    sliding_friction: float = param(
        0.0, at_least=0.0, below=1.0, doc="coefficient of friction between cam and a follower that slides on it"
    )
    guide_friction: float = param(0.0, at_least=0.0, below=1.0, doc="coefficient of friction in the follower's guide")
    linkage_stiffness: float | None = param(
        None, unit="N/mm", above=0.0, at_most=1e12, doc="stiffness between the cam and the mass; none: rigid"
    )
    linkage_damping: float = param(0.05, at_least=0.0, at_most=10.0, doc="damping of that linkage, of the critical")
    material: str = param("heat-treatable steel", choices=tuple(MATERIALS), doc="material of the cam")
    follower_material: str = param("heat-treatable steel", choices=tuple(MATERIALS), doc="material of the follower")
    pressure_limit: float | None = param(
        None, unit="MPa", above=0.0, at_most=1e11, doc="largest Hertz pressure; none: where the weaker material yields"
    )
    face_width: float | None = param(
        None, unit="mm", at_least=0.1 * mm, at_most=1.0, doc="thickness of the cam; none: the roller's width, or 10 mm"
    )
    crown_radius: float | None = param(
        None, unit="mm", at_least=1 * mm, at_most=100.0, doc="crown of the roller across its way; none: a cylinder"
    )
    life: float = param(
        10_000 * 3600.0, unit="h", at_least=0.0, at_most=1e12, doc="running time that the roller must last"
    )
    bore: float | None = param(
        None, unit="mm", at_least=1 * mm, at_most=1.0, doc="bore; none: the smallest whose shaft bears the torque"
    )
    wall: float = param(4 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="least wall between keyway and surface")
    rim: float = param(
        5 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="rim of a grooved cam outside the groove, and web under it"
    )
    cutter_radius: float | None = param(
        None, unit="mm", at_least=0.1 * mm, at_most=0.5, doc="radius of the cutter; none: as the roller's"
    )
    jump_limit: float = param(
        9.81, unit="m/s^2", at_least=0.0, at_most=1e6, doc="largest jump of the acceleration; a judgement of ours: 1 g"
    )

    def check_together(self) -> None:
        """Raise ParameterError where parameters contradict each other."""
        self._check_motion()
        self._check_follower()
        if self.led and (self.spring_rate or self.preload):
            raise ParameterError(f"a spring with kind={self.kind}", do="leave it out: the cam leads both ways")
        if self.crown_radius is not None and self.follower != "roller":
            raise ParameterError(
                f"crown_radius with follower={self.follower}", do="leave it out, or set follower=roller"
            )
        if self.laid_flat and self.sliding_friction:
            raise ParameterError(f"sliding_friction with kind={self.kind}", allowed="0", do="leave it out")
        if self.motion == "oscillating" and self.guide_friction:
            raise ParameterError("guide_friction with motion=oscillating", allowed="an arm has no guide")

    def _check_motion(self) -> None:
        taken = self.rise + self.dwell + (self.fall or 0.0)
        if taken > TURN + NO_DWELL or self.fall_angle <= NO_DWELL:
            said = "rise + dwell + fall" if self.fall else "rise + dwell"
            allowed = "they must fit one turn, 360 deg" if self.fall else "below 360 deg, so that a fall is left"
            raise ParameterError(f"{said} = {format_quantity(taken, 'deg')}", allowed=allowed, do="shorten one of them")
        self.laws()

    @property
    def fall_angle(self) -> float:
        """Cam angle of the fall [rad]."""
        return min(self.rise, TURN - self.rise - self.dwell) if self.fall is None else self.fall

    def laws(self) -> tuple[Law, Law]:
        """The laws of rise and fall. Raises ParameterError where one cannot be made."""
        rising = law_of(self.law, read_law_parameters(self.law_parameters))
        if self.fall_law is None and not self.fall_law_parameters:
            return rising, rising
        return rising, law_of(self.fall_law or self.law, read_law_parameters(self.fall_law_parameters))

    def _check_follower(self) -> None:
        if self.roller is not None:
            find_roller(self.roller)
            if self.follower != "roller":
                raise ParameterError(f"roller={self.roller!r} with follower={self.follower}", do="set follower=roller")
            if self.roller_radius is not None:
                raise ParameterError("roller and roller_radius are both given", do="give one of them")
        if self.roller_radius == 0 and self.follower in ("roller", "spherical"):
            raise ParameterError(f"roller_radius=0 mm with follower={self.follower}", do="set follower=knife")
        if self.follower == "knife" and self.roller_radius:
            shown = format_quantity(self.roller_radius, "mm")
            raise ParameterError(f"roller_radius={shown} with follower=knife", do="set follower=roller or spherical")
        if self.laid_flat:
            self._check_strip()
        else:
            self._check_plate()

    def _check_plate(self) -> None:
        if self.kind == "grooved" and self.follower != "roller":
            raise ParameterError(f"kind=grooved with follower={self.follower}", allowed="a groove leads a roller")
        if self.kind == "conjugate" and self.motion == "oscillating" and self.follower == "flat":
            raise ParameterError("conjugate cams of an arm with flat faces", do="take rollers, or a slide")
        if self.motion == "translating" and not (self.arm is self.pivot is None and self.face_offset == 0):
            raise ParameterError("an arm, pivot or face_offset with motion=translating", do="set motion=oscillating")
        if self.motion == "oscillating" and self.offset:
            raise ParameterError("an offset with motion=oscillating", do="place the arm by arm and pivot")

    def _check_strip(self) -> None:
        allowed = ("roller", "knife", "spherical") if self.kind == "wedge" else ("roller",)
        if self.follower not in allowed:
            raise ParameterError(f"kind={self.kind} with follower={self.follower}", allowed=f"{', '.join(allowed)}")
        for name, wrong in (("motion=oscillating", self.motion == "oscillating"), ("an offset", self.offset != 0)):
            if wrong:
                raise ParameterError(f"{name} with kind={self.kind}", allowed="a slide in line with the cam")

    @property
    def led(self) -> bool:
        """Whether the cam leads the follower both ways, without a spring."""
        return self.kind in ("grooved", "conjugate", "barrel")

    @property
    def laid_flat(self) -> bool:
        """Whether the cam is reckoned as a strip that passes under its follower."""
        return self.kind in ("barrel", "face", "wedge")

    @property
    def arm_length(self) -> float:
        """Length of the arm [m]."""
        return self.arm or 3 * self.lift

    @property
    def pivot_distance(self) -> float:
        """Distance of the arm's pivot from the cam's axis [m]."""
        return self.pivot or (2.5 if self.follower == "flat" else 4 / 3) * self.arm_length

    @property
    def per_unit(self) -> float:
        """Length of arc by the follower's coordinate: 1 of a slide, whose coordinate is in m; the arm's [m], in rad."""
        return self.arm_length if self.motion == "oscillating" else 1.0

    @property
    def limit(self) -> float | None:
        """The pressure angle that must not be exceeded on the rise [rad]; None where the prime radius alone rules."""
        if self.pressure_angle_limit is None and self.prime_radius is None:
            return LIMIT
        return self.pressure_angle_limit


def read_law_parameters(text: str) -> Mapping[str, float | tuple[float, ...]]:
    """Parameters of a law from a text: names, equals signs, numbers; rows of numbers with commas.

    >>> read_law_parameters("b=0.25 u=0.3,0.7 end=()")
    {'b': 0.25, 'u': (0.3, 0.7), 'end': ()}
    """
    read: dict[str, float | tuple[float, ...]] = {}
    for part in text.replace(";", " ").split():
        name, equals, said = part.partition("=")
        if not equals or not name or name in read:
            raise ParameterError(f"law_parameters={text!r}: {part!r}", allowed="NAME=NUMBER or NAME=NUMBER,NUMBER,...")
        read[name] = _numbers(name, said)
    return read


def _numbers(name: str, said: str) -> float | tuple[float, ...]:
    row = said.startswith("(") or "," in said
    try:
        numbers = tuple(float(item) for item in said.strip("()").split(",") if item)
    except ValueError:
        raise ParameterError(f"{name}={said!r} is not a number", allowed="numbers, with commas between") from None
    if not all(math.isfinite(number) for number in numbers) or (not row and len(numbers) != 1):
        raise ParameterError(f"{name}={said!r} is not a number", allowed="numbers, with commas between")
    return numbers if row else numbers[0]
