"""What is asked of the warp tension cylinders; the defaults are the thesis' loom."""

from dataclasses import dataclass

from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import MPa, N, deg, format_quantity, m, mm, ms, s

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class WarpTensionParams(Params):
    """What is asked of the cylinder; the defaults are the thesis' loom."""

    warps: int = param(600, at_least=1, at_most=100_000, doc="warps on the cylinder", symbol="n")
    tension: float = param(15 * N, unit="N", at_least=1e-6, at_most=1e4, doc="tension of a warp", symbol="T")
    width: float = param(
        1.2 * m, unit="m", at_least=1 * mm, at_most=20.0, doc="cylinder between its bearings", symbol="l"
    )
    outer_radius: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=2.0,
        doc="outer radius; none: the least whole millimetre that keeps slope, deflection and wall",
        symbol="Ro",
    )
    inner_radius: float | None = param(
        None,
        unit="mm",
        at_least=0.0,
        at_most=2.0,
        doc="inner radius, 0: solid; none: 65 mm, or what the limits ask of a tube of that wall",
        symbol="Ri",
    )
    wall: float = param(
        5 * mm, unit="mm", at_least=0.01 * mm, at_most=0.5, doc="wall of the tube where a radius is chosen"
    )
    modulus: float = param(STEEL.modulus, unit="GPa", at_least=1 * MPa, at_most=1e13, doc="Young's modulus", symbol="E")
    density: float = param(STEEL.density, unit="kg/m^3", at_least=1.0, at_most=25e3, doc="density of the tube")
    strength: float = param(
        STEEL.strength, unit="MPa", at_least=1 * MPa, at_most=1e10, doc="yield strength of the tube"
    )
    slope_limit: float = param(0.004, unit="rad", at_least=1e-9, below=0.5, doc="largest slope at the bearings")
    deflection_limit: float = param(1 * mm, unit="mm", at_least=1e-9, at_most=0.1, doc="largest deflection")
    ratio: float | None = param(
        None, at_least=1e-3, at_most=1e5, doc="ratio of the reducer; none: from 100 on, that with the least motor"
    )
    efficiency: float = param(0.45, at_least=0.01, at_most=1.0, doc="efficiency of the reducer")
    self_locking: bool = param(True, doc="the reducer must hold the warps by itself; no: a brake holds them")
    motor_torque: float | None = param(
        None, unit="Nm", at_least=1e-6, at_most=1e4, doc="torque of the motor; none: the smallest that is enough"
    )
    row_pitch: float = param(
        4 * mm, unit="mm", at_least=0.001 * mm, at_most=0.1, doc="carpet taken up for each row of knots"
    )
    take_up_time: float = param(1 * s, unit="s", at_least=1 * ms, at_most=3600.0, doc="time to take up a row")
    carpet_length: float = param(1.8 * m, unit="m", at_least=1 * mm, at_most=1000.0, doc="length of the carpet")
    carpet_thickness: float = param(
        0.0, unit="mm", at_least=0.0, at_most=0.1, doc="thickness of carpet wound on the cylinder; 0: it is led away"
    )

    tube: str | None = param(
        None, doc="stock tube like 140x5, or lightest: the lightest that keeps the limits; none: by the radii and wall"
    )
    bearing: str | None = param(
        None, doc="bearing of the cylinders by its designation; none: the thesis' UCF 207, or a larger one where needed"
    )
    stub: float = param(
        40 * mm,
        unit="mm",
        at_least=0.0,
        at_most=1.0,
        doc="overhang of the shaft ends, a bearing's middle to the tube",
    )
    row_time: float = param(150 * s, unit="s", at_least=1 * ms, at_most=1e6, doc="time of a row, its knots included")
    spacer_tube: str | None = param(None, doc="stock tube of the spacer; none: the lightest that keeps the limits")
    spacer_wrap: float = param(
        90 * deg, unit="deg", at_least=0.0, at_most=180 * deg, doc="angle that the warps go round the spacer"
    )
    warp_pitch: float | None = param(
        None, unit="mm", above=0.0, at_most=50 * mm, doc="pitch of the spacer's slots; none: width over warps"
    )
    warp_diameter: float | None = param(
        None, unit="mm", above=0.0, at_most=10 * mm, doc="diameter of a warp; none: of the usual warp, or 0.6 pitches"
    )
    slot_width: float | None = param(
        None, unit="mm", above=0.0, at_most=50 * mm, doc="width of a slot; none: a tenth more than the warp"
    )
    slot_depth: float | None = param(
        None, unit="mm", at_least=0.0, at_most=20 * mm, doc="depth of a slot; none: the warp's diameter"
    )
    friction: float = param(0.2, at_least=0.0, at_most=1.0, doc="coefficient of friction of a warp on the spacer")
    free_length: float = param(1.5 * m, unit="m", at_least=10 * mm, at_most=100.0, doc="warp between both cylinders")
    warp_stiffness: float | None = param(
        None, unit="N", at_least=1.0, at_most=1e7, doc="force over strain of a warp; none: cotton of the usual mass"
    )
    crimp: float = param(0.03, at_least=0.0, at_most=1.0, doc="warp in the carpet over the carpet's length, less 1")
    shed_lift: float = param(60 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="lift of a warp for the shed; 0: none")
    shed_span: float = param(
        170 * mm, unit="mm", at_least=1 * mm, at_most=2.0, doc="from the shedding cam to the next hold, to both sides"
    )
    rows_between: int = param(1, at_least=1, at_most=1000, doc="rows between two take-ups")

    @property
    def pitch(self) -> float:
        """Distance of two warps [m]."""
        return self.warp_pitch or self.width / self.warps

    def check_together(self) -> None:
        """Raise ParameterError where the tube has no wall, or is said twice."""
        if self.tube is not None and (self.outer_radius is not None or self.inner_radius is not None):
            raise ParameterError(
                f"tube={self.tube} and a radius of it", allowed="one of the two", do="leave the radii out"
            )
        if self.outer_radius is not None and self.inner_radius is not None and self.outer_radius <= self.inner_radius:
            inner = format_quantity(self.inner_radius, "mm")
            given = f"outer_radius={format_quantity(self.outer_radius, 'mm')} is not above inner_radius={inner}"
            raise ParameterError(given, allowed=f"above {inner}", do="give radii, not diameters, or leave it out")
