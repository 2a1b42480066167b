"""Parameters of a cam: its motion, its size or the limit that sets it, its follower and its load."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ilmek.cams.laws import LAWS, Law, law_of
from ilmek.cams.programme import TURN
from ilmek.elements.cam_rollers import find_roller
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.params import Params
from ilmek.params import kind as declare
from ilmek.units import N, deg, format_quantity, kg, mm, rpm

LEAST_ANGLE = 0.1 * deg
"""Least cam angle of a rise and of a fall [rad]."""

NO_DWELL = 1e-9
"""Angles below this are rounding [rad]."""

LIMIT = 30 * deg
"""Usual limit of the pressure angle of a slide on the rise [Norton, Cam Design and Manufacturing, 7.2]."""

FALL_LIMIT = 60 * deg
"""Limit of the pressure angle on a fall that a spring drives; assumed by this project: textbooks allow up to 70 deg."""

FOLLOWERS = ("roller", "knife", "flat", "spherical")
"""Followers by the part that touches the cam."""


@dataclass(frozen=True, slots=True)
class CamParams(Params):
    """The parameters of a cam: motion, size and follower, loads and material."""

    law: str = declare.choice("modified-sine", tuple(LAWS), doc="motion law of the rise, and of the fall")
    motion: str = declare.choice("translating", ("translating", "oscillating"), doc="follower on a slide, or on an arm")
    law_parameters: str = declare.text(
        "", doc="parameters of the law, like `b=0.25 c=0.5 d=0.25` or `u=0.3,0.7 s=0.2,0.9`; default: its defaults"
    )
    lift: float = declare.length(
        20 * mm, at_least=0.01 * mm, at_most=1.0, doc="lift of the follower; of an arm along its arc", symbol="L"
    )
    rise: float = declare.angle(90 * deg, at_least=LEAST_ANGLE, below=TURN, doc="cam angle of the rise", symbol="beta")
    dwell: float = declare.angle(0.0, at_least=0.0, below=TURN, doc="cam angle for which the follower stays lifted")
    fall: float | None = declare.angle(
        None,
        at_least=LEAST_ANGLE,
        below=TURN,
        doc="cam angle of the fall; default: that of the rise, or the rest of the turn",
    )
    fall_law: str | None = declare.choice(None, tuple(LAWS), doc="motion law of the fall; default: that of the rise")
    fall_law_parameters: str = declare.text("", doc="parameters of the law of the fall, where it has one of its own")
    speed: float = declare.angular_speed(60 * rpm, at_least=0.0, at_most=1e4, doc="speed of the cam", symbol="w")
    angle: float | None = declare.angle(
        None, at_least=0.0, at_most=TURN, doc="cam angle from the start of the rise that is reported as `at`"
    )
    kind: str = declare.choice(
        "plate",
        ("plate", "grooved", "conjugate", "barrel", "face", "wedge"),
        doc="a plate with a spring, a groove, two plates on a shaft, a barrel's groove, a barrel's end, a wedge",
    )
    follower: str = declare.choice("roller", FOLLOWERS, doc="part of the follower that touches the cam")
    pressure_angle_limit: float | None = declare.angle(
        None,
        at_least=1 * deg,
        below=90 * deg,
        doc="allowed pressure angle on the rise, and on the fall where the cam drives it; default: 30 deg",
        symbol="mu",
    )
    prime_radius: float | None = declare.length(
        None,
        at_least=1e-3 * mm,
        at_most=10.0,
        doc="prime radius; base radius of a flat follower, mean radius of a barrel, travel per radian of a wedge; "
        "default: the smallest for the limit",
        symbol="Rp",
    )
    roller_radius: float | None = declare.length(
        None, at_least=0.0, at_most=1.0, doc="radius of roller or ball; default: chosen", symbol="Rr"
    )
    roller: str | None = declare.text(None, doc="roller of the table, like `CF 10`; default: the smallest of that life")
    offset: float = declare.length(
        0.0,
        at_least=-1.0,
        at_most=1.0,
        doc="follower's line to the axis; positive: smaller pressure angle on the rise",
        symbol="e",
    )
    arm: float | None = declare.length(
        None,
        at_least=0.1 * mm,
        at_most=10.0,
        doc="arm to the roller, or to the point of mass, load and spring; default: 3 times the lift",
    )
    pivot: float | None = declare.length(
        None,
        at_least=0.1 * mm,
        at_most=10.0,
        doc="arm's pivot to the cam's axis; default: 4/3 of the arm, 5/2 of a flat one",
    )
    side: str = declare.choice(
        "trailing",
        ("trailing", "leading"),
        doc="trailing: the cam's surface moves away from the arm's pivot; leading: towards it",
    )
    distance: float | None = declare.length(
        None,
        at_least=0.1 * mm,
        at_most=10.0,
        doc="between followers of conjugate cams on a slide; default: equal prime circles",
    )
    between: float | None = declare.angle(
        None, at_least=1 * deg, below=TURN, doc="angle between the arms of conjugate cams; default: equal prime circles"
    )
    face_offset: float = declare.length(0.0, at_least=-1.0, at_most=1.0, doc="arm's flat face beyond its pivot")
    curvature_least: float = declare.length(
        1 * mm,
        at_least=0.0,
        at_most=1.0,
        doc="least radius of curvature for a flat follower, which sets its base circle",
    )
    mass: float = declare.mass(0.5 * kg, at_least=0.0, at_most=1e5, doc="moving mass, the follower's own included")
    load: float = declare.force(100 * N, at_least=0.0, at_most=1e7, doc="constant force on the cam, weight included")
    spring_rate: float | None = declare.stiffness(
        None, at_least=0.0, at_most=1e9, doc="rate of the spring; default: chosen"
    )
    preload: float | None = declare.force(
        None, at_least=0.0, at_most=1e7, doc="spring force at the lowest position; default: chosen"
    )
    hold_speed: float | None = declare.angular_speed(
        None, at_least=0.0, at_most=1e4, doc="speed up to which the spring holds the follower; default: 1.2 times speed"
    )
    sliding_friction: float = declare.ratio(0.0, at_least=0.0, below=1.0, doc="friction coefficient, sliding follower")
    guide_friction: float = declare.ratio(0.0, at_least=0.0, below=1.0, doc="friction coefficient of the guide")
    linkage_stiffness: float | None = declare.stiffness(
        None, above=0.0, at_most=1e12, doc="stiffness between the cam and the mass; default: rigid"
    )
    linkage_damping: float = declare.ratio(0.05, at_least=0.0, at_most=10.0, doc="damping ratio of that linkage")
    material: str = declare.choice("heat-treatable steel", tuple(MATERIALS), doc="material of the cam")
    follower_material: str = declare.choice("heat-treatable steel", tuple(MATERIALS), doc="material of the follower")
    pressure_limit: float | None = declare.pressure(
        None, above=0.0, at_most=1e11, doc="allowed Hertz pressure; default: at which the weaker material yields"
    )
    face_width: float | None = declare.length(
        None, at_least=0.1 * mm, at_most=1.0, doc="thickness of the cam; default: the roller's width, or 10 mm"
    )
    crown_radius: float | None = declare.length(
        None, at_least=1 * mm, at_most=100.0, doc="crown of the roller across its path; default: a cylinder"
    )
    life: float = declare.time(10_000 * 3600.0, unit="h", at_least=0.0, at_most=1e12, doc="required life of the roller")
    bore: float | None = declare.length(
        None, at_least=1 * mm, at_most=1.0, doc="bore; default: the smallest whose shaft transmits the torque"
    )
    wall: float = declare.length(4 * mm, at_least=0.0, at_most=0.5, doc="required wall between keyway and surface")
    rim: float = declare.length(5 * mm, at_least=0.0, at_most=0.5, doc="rim outside a groove, and web under it")
    cutter_radius: float | None = declare.length(
        None, at_least=0.1 * mm, at_most=0.5, doc="radius of the cutter; default: that of the roller"
    )
    jump_limit: float = declare.acceleration(
        9.81, at_least=0.0, at_most=1e6, doc="allowed jump of the acceleration; 1 g is assumed by this project"
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
        if taken > TURN + NO_DWELL or self.fall_angle < LEAST_ANGLE * (1 - NO_DWELL):
            taken_by = "rise + dwell + fall" if self.fall else "rise + dwell"
            allowed = (
                "they must fit one turn, 360 deg" if self.fall else "a fall of 0.1 deg or more must be left of 360 deg"
            )
            raise ParameterError(
                f"{taken_by} = {format_quantity(taken, 'deg')}", allowed=allowed, do="shorten one of them"
            )
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
        """Whether the cam is treated as a strip that passes under its follower."""
        return self.kind in ("barrel", "face", "wedge")

    @property
    def side_sign(self) -> Literal[1, -1]:
        """1 of a trailing arm, -1 of a leading one."""
        return 1 if self.side == "trailing" else -1

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
    def limit(self) -> float:
        """The pressure angle that must not be exceeded on the rise [rad]."""
        return self.pressure_angle_limit or LIMIT

    @property
    def fall_limit(self) -> float:
        """That of the fall: the same where the cam drives the fall too; a spring's may be larger."""
        return self.limit if self.led else max(self.limit, FALL_LIMIT)


def read_law_parameters(text: str) -> Mapping[str, float | tuple[float, ...]]:
    """Parameters of a law from a text: names, equals signs, numbers; rows of numbers with commas.

    >>> read_law_parameters("b=0.25 u=0.3,0.7 end=()")
    {'b': 0.25, 'u': (0.3, 0.7), 'end': ()}
    """
    read: dict[str, float | tuple[float, ...]] = {}
    for part in text.replace(";", " ").split():
        name, equals, value = part.partition("=")
        if not equals or not name or name in read:
            raise ParameterError(f"law_parameters={text!r}: {part!r}", allowed="NAME=NUMBER or NAME=NUMBER,NUMBER,...")
        read[name] = _numbers(name, value)
    return read


def _numbers(name: str, value: str) -> float | tuple[float, ...]:
    row = value.startswith("(") or "," in value
    try:
        numbers = tuple(float(item) for item in value.strip("()").split(",") if item)
    except ValueError:
        raise ParameterError(f"{name}={value!r} is not a number", allowed="numbers, with commas between") from None
    if not all(math.isfinite(number) for number in numbers) or (not row and len(numbers) != 1):
        raise ParameterError(f"{name}={value!r} is not a number", allowed="numbers, with commas between")
    return numbers if row else numbers[0]
