"""What may be asked of the shedding cams."""

from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.cams.programme import TURN
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import GPa, MPa, N, deg, format_quantity, mm, rpm

NO_DWELL = 1e-9
"""Angles below this are rounding [rad]."""

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class SheddingParams(Params):
    """What is asked of the shedding cams."""

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
    shuttle_height: float = param(
        40 * mm, unit="mm", at_least=0.01 * mm, at_most=1.0, doc="opening that the shuttle needs"
    )
    speed: float = param(5 * rpm, unit="rpm", at_least=1e-6 * rpm, at_most=600 * rpm, doc="speed of the cam shaft")
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
        if (self.tension is None) != (self.half_span is None):
            missing = "half_span" if self.half_span is None else "tension"
            raise ParameterError(f"{missing} is missing", do="give tension and half_span together, or warp_force alone")

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
