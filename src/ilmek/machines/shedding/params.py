"""Parameters of the shedding cams, their shaft and its drive."""

from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.cams.programme import TURN
from ilmek.elements.materials import MATERIALS
from ilmek.elements.sheet_tolerances import CLASSES, SPECIAL
from ilmek.errors import ParameterError
from ilmek.params import Params, kind, nested
from ilmek.units import GPa, MPa, N, deg, format_quantity, hour, mm, rpm
from ilmek.weaving.cloth import Cloth

PHASES = ("together", "staggered", "flattest")
"""How the cams of a parity stand on the shaft."""

AUTO, DISCS, REED = "auto", "cams", "reed"
"""What keeps the warps on their cams: round guide cams between them, or the dents of a fixed reed round the noses."""

MOST_SHAFTS = 4
"""Most cam shafts one above the other."""

NO_DWELL = 1e-9
"""Angles below this are rounding [rad]."""

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class SheddingParams(Params):
    """Parameters of the cams and the warps on them, of the shafts and of their drives."""

    lift: float = kind.length(
        60 * mm, at_least=0.01 * mm, at_most=1.0, doc="lift of a warp on the first shaft: the height of the shed"
    )
    rise: float = kind.angle(90 * deg, at_least=1 * deg, below=TURN, doc="cam angle of the rise", symbol="beta")
    fall: float | None = kind.angle(None, at_least=1 * deg, below=TURN, doc="cam angle of the return; default: rise")
    dwell: float = kind.angle(0.0, at_least=0.0, below=TURN, doc="cam angle for which the warp stays lifted")
    law: str = kind.choice("harmonic", SMOOTH_LAWS, doc="motion law of rise and return")
    pressure_angle_limit: float = kind.angle(
        30 * deg, at_least=1 * deg, below=90 * deg, doc="allowed pressure angle", symbol="mu"
    )
    prime_radius: float | None = kind.length(
        None,
        at_least=0.1 * mm,
        at_most=2.0,
        doc="prime radius on the first shaft; default: the smallest for pressure angle and bore",
        symbol="Rp",
    )
    roller_radius: float = kind.length(0.0, at_least=0.0, at_most=0.5, doc="radius of the warp or roller on the cam")
    cloth: Cloth = nested(Cloth, doc="warps, one cam each, their tension and yarn")
    shafts: int | None = kind.count(
        None,
        at_least=1,
        at_most=MOST_SHAFTS,
        doc="cam shafts one above the other, to which the warps are dealt in turn; default: the least number that does",
    )
    guides: str = kind.choice(
        AUTO, (AUTO, DISCS, REED), doc="what keeps the warps on their cams: guide cams, or a fixed reed round the noses"
    )
    warp_clearance: float = kind.length(
        0.025 * mm, at_least=0.0, at_most=10 * mm, doc="room of a warp to each side between plates or dents"
    )
    cam_thickness: float | None = kind.length(
        None,
        at_least=0.001 * mm,
        at_most=50 * mm,
        doc="thickness of a cam; default: half the pitch, or what the pitch of the shaft leaves",
    )
    least_plate: float = kind.length(
        0.3 * mm,
        at_least=0.001 * mm,
        at_most=10 * mm,
        doc="least thickness of a cam or guide cam that can be cut and stays plane; assumed by this project",
    )
    sheet_tolerance: str = kind.choice(SPECIAL, CLASSES, doc="class of the sheets' thickness tolerance, EN 10131")
    shim_interval: int | None = kind.count(
        None,
        at_least=1,
        at_most=1000,
        doc="pitches of a shaft from one pile of shims to the next; default: the most that keeps cams at their warps",
    )
    offset_limit: float = kind.ratio(
        0.25,
        at_least=1e-3,
        at_most=1.0,
        doc="allowed distance of a cam from its warp, over the pitch; assumed by this project",
    )
    least_dent: float = kind.length(
        0.1 * mm,
        at_least=0.001 * mm,
        at_most=10 * mm,
        doc="least thickness of a dent of a reed; assumed by this project",
    )
    play_limit: float = kind.ratio(
        0.2, at_least=1e-3, at_most=1.0, doc="allowed lateral play of a warp over the pitch; assumed by this project"
    )
    buckling_safety: float = kind.ratio(
        2.0, at_least=1.0, at_most=20.0, doc="factor on the warp's force for buckling; assumed by this project"
    )
    guide_height: float = kind.length(10 * mm, at_least=0.0, at_most=0.5, doc="height of the guides above the nose")
    shaft_gap: float = kind.length(
        10 * mm, at_least=0.0, at_most=1.0, doc="gap between the guides of two shafts, and from guides to a hold"
    )
    density: float = kind.density(STEEL.density, at_least=1.0, at_most=25e3, doc="density of cams and shaft")
    warp_force: float = kind.force(
        10 * N, at_least=0.0, at_most=1e4, doc="force of a lifted warp across the cam, where no span is given"
    )
    half_span: float | None = kind.length(
        None, at_least=0.1 * mm, at_most=10.0, doc="cam to the next hold of the warp: force from tension and lift"
    )
    shafts_height: float = kind.length(
        1.5, unit="m", at_least=1 * mm, at_most=20.0, doc="room for the shafts, first to last; assumed by this project"
    )
    front_span: float | None = kind.length(
        None, at_least=0.1 * mm, at_most=10.0, doc="first shaft to the fell, with back_span instead of half_span"
    )
    back_span: float | None = kind.length(
        None, at_least=0.1 * mm, at_most=10.0, doc="last shaft to the hold of the warp behind it, with front_span"
    )
    warp_length: float | None = kind.length(
        None,
        unit="m",
        at_least=0.1 * mm,
        at_most=100.0,
        doc="warp that stretches, fell to beam, with the spans; default: its tension does not change",
    )
    compensation: float = kind.ratio(0.0, at_least=0.0, at_most=1.0, doc="share of elongation that the back rest gives")
    strain_limit: float = kind.ratio(
        3.5e-2, unit="%", at_least=1e-6, at_most=1.0, doc="allowed strain of a warp; half of what breaks cotton"
    )
    breaking_safety: float = kind.ratio(
        2.0, at_least=1.0, at_most=20.0, doc="breaking force over the tension of a lifted warp; assumed by this project"
    )
    shuttle_height: float = kind.length(40 * mm, at_least=0.01 * mm, at_most=1.0, doc="opening that the shuttle needs")
    shuttle_angle: float | None = kind.angle(
        None,
        at_least=0.1 * deg,
        below=TURN,
        doc="cam angle for which the shed must be open for the shuttle; "
        "default: half of that of cams in phase for flattest, else not checked",
    )
    guideway: bool = kind.flag(True, doc="whether the shuttle runs on the tips of the lifted cams (thesis, Fig. 3.18)")
    guideway_tolerance: float = kind.length(
        2 * mm, at_least=1e-6, at_most=0.1, doc="allowed step of the cams' tips over the width; assumed by this project"
    )
    phase: str = kind.choice("together", PHASES, doc="cams of a parity in phase, staggered, or in the flattest phases")
    stagger: float = kind.angle(20 * deg, at_least=0.0, at_most=TURN / 2, doc="angle of spread of staggered cams")
    stagger_groups: int = kind.count(
        2, at_least=1, at_most=12, doc="groups of a parity's cams, evenly spread; flattest: the most of them"
    )
    speed: float = kind.angular_speed(5 * rpm, at_least=1e-6 * rpm, at_most=600 * rpm, doc="speed of the cam shaft")
    stop_time: float | None = kind.time(
        None, unit="s", at_least=1e-3, at_most=60.0, doc="time in which the shaft stops or starts; default: it turns on"
    )
    shaft_length: float | None = kind.length(
        None, unit="m", at_least=1 * mm, at_most=20.0, doc="between its bearings; default: warps x pitch", symbol="l"
    )
    spans: int = kind.count(1, at_least=1, at_most=1000, doc="equal spans of the shaft between bearings and steadies")
    shaft_bar: float | None = kind.length(
        None, at_least=1 * mm, at_most=2.0, doc="side of the square bar; default: the smallest of stock that does"
    )
    shaft_load: float | None = kind.line_load(
        None, unit="kN/m", at_least=1e-3, at_most=1e7, doc="load of the shaft; default: from cams and warps", symbol="w"
    )
    pull_angle: float = kind.angle(90 * deg, at_least=0.0, at_most=TURN / 2, doc="between weight and pull of the warps")
    safety: float | None = kind.ratio(
        None, at_least=1.0, at_most=20.0, doc="factor on the load; default: 1 on a given load, 2 on a computed one"
    )
    modulus: float = kind.pressure(
        200 * GPa, unit="GPa", at_least=1 * MPa, at_most=1e13, doc="Young's modulus", symbol="E"
    )
    slope_limit: float = kind.angle(0.004, unit="rad", at_least=1e-9, below=0.5, doc="allowed slope at the bearings")
    deflection_limit: float = kind.length(1 * mm, at_least=1e-9, at_most=0.1, doc="allowed deflection of the shaft")
    twist_limit: float = kind.angle(2 * deg, at_least=1e-6, below=TURN / 4, doc="allowed twist from end to end")
    strength: float = kind.pressure(195 * MPa, at_least=1 * MPa, at_most=1e10, doc="yield strength; S235 to 150 mm")
    tensile: float = kind.pressure(360 * MPa, at_least=1 * MPa, at_most=1e10, doc="tensile strength, for fatigue; S235")
    bearing: str | None = kind.text(None, doc="bearing by designation; default: the lightest with the required life")
    bearing_life: float = kind.time(
        20_000 * hour, unit="h", at_least=1 * hour, at_most=1e6 * hour, doc="required life of the bearings"
    )
    bore_wall: float = kind.length(5 * mm, at_least=0.0, at_most=0.5, doc="required wall outside the square bore")
    ratio: float = kind.ratio(100.0, at_least=1e-3, at_most=1e5, doc="ratio of the reducer on the shaft")
    efficiency: float = kind.ratio(0.85, at_least=0.01, at_most=1.0, doc="efficiency of the reducer")
    motor_torque: float | None = kind.torque(
        None, unit="Nm", at_least=1e-6, at_most=1e4, doc="torque of the motor; default: of the smallest that is enough"
    )

    def check_together(self) -> None:
        """Raise ParameterError where angles do not fit the turn, cams the pitch, or half of a pair is missing."""
        if self.lifted_angle > TURN + NO_DWELL:
            given = f"rise + dwell + fall = {format_quantity(self.lifted_angle, 'deg')}"
            raise ParameterError(given, allowed="they must fit one turn, 360 deg", do="shorten one of them")
        self._check_thickness()
        self._check_spans()
        if self.phase != "together" and self.stagger_groups > self.cloth.warps // 2:
            given = f"stagger_groups={self.stagger_groups} of {self.cloth.warps} warps"
            allowed = f"at most {self.cloth.warps // 2}: half of the warps are of a parity"
            raise ParameterError(given, allowed=allowed, do="set fewer groups")

    def _check_thickness(self) -> None:
        """Raise ParameterError where a given cam does not fit the pitch of its shaft, the warps of all shafts on it."""
        room = self.cloth.warp_pitch * (self.shafts or 1)
        if self.cam_thickness is not None and self.cam_thickness >= room:
            pitch, most = format_quantity(self.cloth.warp_pitch, "mm"), format_quantity(room, "mm")
            given = f"cam_thickness={format_quantity(self.cam_thickness, 'mm')} does not fit cloth.warp_pitch={pitch}"
            raise ParameterError(
                given, allowed=f"below {most}", do="leave it out for half the pitch, or set more shafts"
            )
        if self.shafts is not None and self.cloth.warps < 2 * self.shafts:
            raise ParameterError(
                f"{self.cloth.warps} warps on {self.shafts} shafts", allowed="two warps a shaft", do="set fewer shafts"
            )

    def _check_spans(self) -> None:
        """Raise ParameterError unless both spans are given, and a tension or a length that stretches only with them."""
        front, back = self.front_span, self.back_span
        if (front is None) != (back is None):
            missing = "front_span" if front is None else "back_span"
            raise ParameterError(f"{missing} is missing", do="give front_span and back_span, or half_span for both")
        if front is not None and self.half_span is not None:
            raise ParameterError("half_span beside front_span and back_span", do="leave out half_span")
        for name, value in (("cloth.tension", self.cloth.tension), ("warp_length", self.warp_length)):
            if value is not None and self.spans_of_warp is None:
                raise ParameterError(f"{name} without half_span", do="give half_span too, or warp_force alone")
        if self.warp_length is not None and self.warp_length < sum(self.spans_of_warp or ()) * (1 - 1e-9):
            given = f"warp_length={format_quantity(self.warp_length, 'm')} is shorter than the spans"
            allowed = f"at least {format_quantity(sum(self.spans_of_warp or ()), 'm')}"
            raise ParameterError(given, allowed=allowed, do="give the whole length from fell to beam")

    @property
    def spans_of_warp(self) -> tuple[float, float] | None:
        """From the cam to the warp's holds in front and behind [m]; None where only a force is known."""
        if self.front_span is not None and self.back_span is not None:
            return self.front_span, self.back_span
        return None if self.half_span is None else (self.half_span, self.half_span)

    @property
    def diameter(self) -> float:
        """Diameter of a warp [m]."""
        return self.cloth.carpet_yarns.warp.diameter

    @property
    def strongest_tension(self) -> float:
        """Allowed tension of a lifted warp [N]: its breaking force over the safety."""
        return self.cloth.carpet_yarns.warp.breaking_force / self.breaking_safety

    @property
    def fall_angle(self) -> float:
        """Cam angle of the return [rad]."""
        return self.rise if self.fall is None else self.fall

    @property
    def lifted_angle(self) -> float:
        """Cam angle for which a warp is off its line [rad]."""
        return self.rise + self.dwell + self.fall_angle
