"""What may be asked of the shedding cams."""

from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.cams.programme import TURN
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import GPa, MPa, N, deg, format_quantity, hour, mm, rpm

PHASES = ("together", "staggered", "flattest")
"""How the cams of a parity stand on the shaft."""

NO_DWELL = 1e-9
"""Angles below this are rounding [rad]."""

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class WarpParams(Params):
    """What is asked of the cams and the warps on them."""

    lift: float = param(
        60 * mm, unit="mm", at_least=0.01 * mm, at_most=1.0, doc="lift of a warp: the height of the shed"
    )
    rise: float = param(90 * deg, unit="deg", at_least=1 * deg, below=TURN, doc="cam angle of the rise", symbol="beta")
    fall: float | None = param(
        None, unit="deg", at_least=1 * deg, below=TURN, doc="cam angle of the return; none: as the rise"
    )
    dwell: float = param(0.0, unit="deg", at_least=0.0, below=TURN, doc="cam angle for which the warp stays lifted")
    law: str = param("harmonic", choices=SMOOTH_LAWS, doc="motion law of rise and return")
    pressure_angle_limit: float = param(
        30 * deg, unit="deg", at_least=1 * deg, below=90 * deg, doc="largest pressure angle", symbol="mu"
    )
    prime_radius: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=2.0,
        doc="prime radius; none: the smallest for the pressure angle",
        symbol="Rp",
    )
    roller_radius: float = param(
        0.0, unit="mm", at_least=0.0, at_most=0.5, doc="radius of the warp or roller on the cam"
    )
    warps: int = param(600, at_least=2, at_most=100_000, doc="warps, one cam each")
    warp_pitch: float = param(2 * mm, unit="mm", at_least=0.01 * mm, at_most=50 * mm, doc="distance between two warps")
    cam_thickness: float | None = param(
        None, unit="mm", at_least=0.001 * mm, at_most=50 * mm, doc="thickness of a cam; none: half the pitch"
    )
    guide_height: float = param(
        10 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="height of the guide cams over the nose"
    )
    density: float = param(STEEL.density, unit="kg/m^3", at_least=1.0, at_most=25e3, doc="density of cams and shaft")
    warp_force: float = param(10 * N, unit="N", at_least=0.0, at_most=1e4, doc="force of a lifted warp across the cam")
    tension: float | None = param(None, unit="N", at_least=1e-6, at_most=1e4, doc="tension of a warp, with half_span")
    half_span: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=10.0,
        doc="cam to the next hold of the warp: force from tension and lift",
    )
    front_span: float | None = param(
        None, unit="mm", at_least=0.1 * mm, at_most=10.0, doc="cam to the fell, with back_span instead of half_span"
    )
    back_span: float | None = param(
        None, unit="mm", at_least=0.1 * mm, at_most=10.0, doc="cam to the hold of the warp behind it, with front_span"
    )
    warp_stiffness: float | None = param(
        None,
        unit="N",
        at_least=1.0,
        at_most=1e7,
        doc="force over strain of a warp, EA; cotton: about 2.1 N/tex; none: its tension does not change",
        symbol="EA",
    )
    warp_length: float | None = param(
        None, unit="m", at_least=0.1 * mm, at_most=100.0, doc="warp that stretches, fell to beam; none: both spans"
    )
    compensation: float = param(
        0.0, at_least=0.0, at_most=1.0, doc="share of a warp's lengthening that its cylinder gives way by"
    )
    strain_limit: float = param(
        3.5e-2, unit="%", at_least=1e-6, at_most=1.0, doc="strain of a warp that is borne; half of what breaks cotton"
    )
    friction: float = param(0.25, at_least=0.0, at_most=2.0, doc="coefficient of friction, warp on cam", symbol="f")
    shuttle_height: float = param(
        40 * mm, unit="mm", at_least=0.01 * mm, at_most=1.0, doc="opening that the shuttle needs"
    )
    shuttle_angle: float | None = param(
        None,
        unit="deg",
        at_least=0.1 * deg,
        below=TURN,
        doc="cam angle for which the shed must stay open enough; none: half of what cams in phase give, for flattest",
    )
    phase: str = param("together", choices=PHASES, doc="cams of a parity all at once, spread by `stagger`, or as flat")
    stagger: float = param(
        20 * deg, unit="deg", at_least=0.0, at_most=TURN / 2, doc="angle over which staggered cams are spread"
    )
    stagger_groups: int = param(
        2, at_least=1, at_most=12, doc="groups of a parity's cams, evenly spread; flattest: at most so many"
    )
    speed: float = param(5 * rpm, unit="rpm", at_least=1e-6 * rpm, at_most=600 * rpm, doc="speed of the cam shaft")

    @property
    def spans_of_warp(self) -> tuple[float, float] | None:
        """From the cam to the warp's holds in front and behind [m]; None where only a force is known."""
        if self.front_span is not None and self.back_span is not None:
            return self.front_span, self.back_span
        return None if self.half_span is None else (self.half_span, self.half_span)


@dataclass(frozen=True, slots=True)
class SheddingParams(WarpParams):
    """What is asked of the shedding cams, their shaft and its drive."""

    shaft_length: float | None = param(
        None, unit="m", at_least=1 * mm, at_most=20.0, doc="shaft between its bearings; none: warps x pitch", symbol="l"
    )
    spans: int = param(
        1, at_least=1, at_most=1000, doc="equal spans of the shaft between its supports: bearings, steadies"
    )
    shaft_bar: float | None = param(
        None, unit="mm", at_least=1 * mm, at_most=2.0, doc="side of the square bar; none: the smallest of stock"
    )
    shaft_load: float | None = param(
        None, unit="kN/m", at_least=1e-3, at_most=1e7, doc="load of the shaft; none: from cams and warps", symbol="w"
    )
    pull_angle: float = param(
        90 * deg,
        unit="deg",
        at_least=0.0,
        at_most=TURN / 2,
        doc="between weight and pull of the warps; upright: 90 deg",
    )
    safety: float | None = param(
        None, at_least=1.0, at_most=20.0, doc="factor on the load; none: 1 on a given load, 2 on one computed here"
    )
    modulus: float = param(
        200 * GPa, unit="GPa", at_least=1 * MPa, at_most=1e13, doc="Young's modulus of the shaft", symbol="E"
    )
    slope_limit: float = param(0.004, unit="rad", at_least=1e-9, below=0.5, doc="largest slope at the bearings")
    deflection_limit: float = param(
        1 * mm, unit="mm", at_least=1e-9, at_most=0.1, doc="largest deflection of the shaft"
    )
    twist_limit: float = param(
        2 * deg, unit="deg", at_least=1e-6, below=TURN / 4, doc="largest twist of the shaft from end to end"
    )
    strength: float = param(
        195 * MPa, unit="MPa", at_least=1 * MPa, at_most=1e10, doc="yield strength of the shaft; S235 to 150 mm"
    )
    tensile: float = param(
        360 * MPa,
        unit="MPa",
        at_least=1 * MPa,
        at_most=1e10,
        doc="tensile strength of the shaft, for its fatigue; S235",
    )
    bearing: str | None = param(None, doc="bearing of the shaft, by designation; none: the lightest that lives")
    bearing_life: float = param(
        20_000 * hour, unit="h", at_least=1 * hour, at_most=1e6 * hour, doc="life that is asked of the bearings"
    )
    bore_wall: float = param(
        5 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="least wall between square bore and surface"
    )
    ratio: float = param(100.0, at_least=1e-3, at_most=1e5, doc="ratio of the reducer on the shaft")
    efficiency: float = param(0.85, at_least=0.01, at_most=1.0, doc="efficiency of the reducer")
    motor_torque: float | None = param(
        None, unit="Nm", at_least=1e-6, at_most=1e4, doc="torque of the motor; none: the smallest that is enough"
    )

    def check_together(self) -> None:
        """Raise ParameterError where angles do not fit the turn, cams the pitch, or half of a pair is missing."""
        if self.lifted_angle > TURN + NO_DWELL:
            given = f"rise + dwell + fall = {format_quantity(self.lifted_angle, 'deg')}"
            raise ParameterError(given, allowed="they must fit one turn, 360 deg", do="shorten one of them")
        if self.cam_thickness is not None and self.cam_thickness >= self.warp_pitch:
            pitch = format_quantity(self.warp_pitch, "mm")
            given = f"cam_thickness={format_quantity(self.cam_thickness, 'mm')} does not fit warp_pitch={pitch}"
            raise ParameterError(given, allowed=f"below {pitch}", do="leave it out for half the pitch")
        self._check_spans()
        if self.phase != "together" and self.stagger_groups > self.warps // 2:
            raise ParameterError(
                f"stagger_groups={self.stagger_groups} of {self.warps} warps",
                allowed=f"at most {self.warps // 2}: half of the warps are of a parity",
                do="set fewer groups",
            )

    def _check_spans(self) -> None:
        """Raise ParameterError unless tension and spans are given together, and stretching only with them."""
        both = (self.front_span, self.back_span)
        if (both[0] is None) != (both[1] is None):
            missing = "front_span" if both[0] is None else "back_span"
            raise ParameterError(f"{missing} is missing", do="give front_span and back_span, or half_span for both")
        if both[0] is not None and self.half_span is not None:
            raise ParameterError("half_span beside front_span and back_span", do="leave out half_span")
        if (self.tension is None) != (self.spans_of_warp is None):
            missing = "half_span" if self.spans_of_warp is None else "tension"
            raise ParameterError(f"{missing} is missing", do="give tension and half_span together, or warp_force alone")
        if self.warp_stiffness is not None and self.tension is None:
            raise ParameterError("warp_stiffness without tension", do="give tension, front_span and back_span too")
        if self.warp_length is not None and self.warp_length < sum(self.spans_of_warp or ()) * (1 - 1e-9):
            raise ParameterError(
                f"warp_length={format_quantity(self.warp_length, 'm')} is shorter than the spans",
                allowed=f"at least {format_quantity(sum(self.spans_of_warp or ()), 'm')}",
                do="give the whole length from fell to beam",
            )

    @property
    def fall_angle(self) -> float:
        """Cam angle of the return [rad]."""
        return self.rise if self.fall is None else self.fall

    @property
    def lifted_angle(self) -> float:
        """Cam angle for which a warp is off its line [rad]."""
        return self.rise + self.dwell + self.fall_angle

    @property
    def opposed(self) -> bool:
        """Whether one parity is down whenever the other is up."""
        return self.lifted_angle <= TURN / 2 + NO_DWELL
