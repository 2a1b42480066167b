"""Parameters of the warp tension cylinders; the defaults are the thesis' loom."""

from dataclasses import dataclass

from ilmek.elements.carpet_yarns import CRIMP, CarpetYarnParams
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.weaver_hands import CRANK, HAND, WeaverHands
from ilmek.params import Params, kind, nested, param
from ilmek.units import MPa, deg, format_quantity, m, mm, ms, s
from ilmek.weaving.cloth import Cloth

STEEL = MATERIALS["structural steel"]

MOTOR = "motor"
"""A motor behind each reducer."""

THESIS_CLOTH = Cloth(yarns=CarpetYarnParams(friction=0.2))
"""The thesis' warps; their friction on the spacer is assumed by this project."""


@dataclass(frozen=True, slots=True)
class WarpTensionParams(Params):
    """Parameters of the three cylinders, their drive and the warps."""

    cloth: Cloth = nested(Cloth, default=THESIS_CLOTH, doc="warps, their tension and yarn, distance of the rows")
    width: float | None = kind.length(
        None, unit="m", at_least=1 * mm, at_most=20.0, doc="between its bearings; default: of the cloth", symbol="l"
    )
    outer_radius: float | None = kind.length(
        None,
        at_least=0.1 * mm,
        at_most=2.0,
        doc="outer radius; default: the least whole millimetre that keeps slope, deflection and wall",
        symbol="Ro",
    )
    inner_radius: float | None = kind.length(
        None,
        at_least=0.0,
        at_most=2.0,
        doc="inner radius, 0: solid; default: 65 mm, or as the limits require of a tube of that wall",
        symbol="Ri",
    )
    wall: float = kind.length(5 * mm, at_least=0.01 * mm, at_most=0.5, doc="wall of the tube where a radius is chosen")
    modulus: float = kind.pressure(
        STEEL.modulus, unit="GPa", at_least=1 * MPa, at_most=1e13, doc="Young's modulus", symbol="E"
    )
    density: float = kind.density(STEEL.density, at_least=1.0, at_most=25e3, doc="density of the tube")
    strength: float = kind.pressure(STEEL.strength, at_least=1 * MPa, at_most=1e10, doc="yield strength of the tube")
    slope_limit: float = kind.angle(0.004, unit="rad", at_least=1e-9, below=0.5, doc="allowed slope at the bearings")
    deflection_limit: float = kind.length(1 * mm, at_least=1e-9, at_most=0.1, doc="allowed deflection")
    winding: str = param(
        MOTOR, choices=(MOTOR, HAND), doc="what winds: a motor behind each reducer, or the weaver's hand at its crank"
    )
    crank: float = kind.length(CRANK, at_least=50 * mm, at_most=0.6, doc="radius of the crank, where a hand winds")
    crank_shaft: float = kind.length(
        60 * mm, at_least=5 * mm, at_most=1.0, doc="from the reducer to the hand wheel, where a hand winds"
    )
    hands: WeaverHands = nested(WeaverHands, doc="forces and speeds of the hands, where a hand winds")
    ratio: float | None = kind.ratio(
        None, at_least=1e-3, at_most=1e5, doc="ratio of the reducer; default: of 100 and more that of the least motor"
    )
    efficiency: float = kind.ratio(0.45, at_least=0.01, at_most=1.0, doc="efficiency of the reducer")
    self_locking: bool = kind.flag(True, doc="the reducer must hold the warps by itself; no: a brake holds them")
    motor_torque: float | None = kind.torque(
        None, unit="Nm", at_least=1e-6, at_most=1e4, doc="torque of the motor; default: of the smallest that is enough"
    )
    take_up_time: float = kind.time(1 * s, at_least=1 * ms, at_most=3600.0, doc="time to take up a row")
    carpet_length: float = kind.length(
        1.8 * m, unit="m", at_least=1 * mm, at_most=1000.0, doc="length of the carpet, woven"
    )
    carpet_thickness: float = kind.length(
        0.0, at_least=0.0, at_most=0.1, doc="thickness of carpet wound on the cylinder; 0: it is not wound"
    )
    tube: str | None = kind.text(
        None,
        doc="stock tube like 140x5; lightest, usual: the lightest of all, or of the usual ones, that keeps the limits; "
        "default: by the radii and wall",
    )
    bearing: str | None = kind.text(
        None, doc="bearing of the cylinders by its designation; default: the thesis' UCF 207, or a larger one if needed"
    )
    static_safety: float = kind.ratio(
        1.5, at_least=0.5, at_most=20.0, doc="static safety C0 / P0 of a bearing at least; ISO 76: 1 to 2"
    )
    stub_safety: float = kind.ratio(
        1.5, at_least=1.0, at_most=20.0, doc="yield over the stress of a shaft end at least"
    )
    stub: float = kind.length(40 * mm, at_least=0.0, at_most=1.0, doc="overhang of the shaft ends, bearing to tube")
    row_time: float = kind.time(150 * s, at_least=1 * ms, at_most=1e6, doc="time of a row, its knots included")
    spacer_tube: str | None = kind.text(None, doc="tube of the spacer; default: the lightest that keeps the limits")
    spacer_wrap: float = kind.angle(90 * deg, at_least=0.0, at_most=180 * deg, doc="wrap of the warps on the spacer")
    slot_width: float | None = kind.length(
        None, above=0.0, at_most=50 * mm, doc="width of a slot; default: 1.1 warps, at most the mean of warp and pitch"
    )
    slot_depth: float | None = kind.length(
        None, at_least=0.0, at_most=20 * mm, doc="depth of a slot; default: one warp"
    )
    free_length: float = kind.length(
        1.5 * m, unit="m", at_least=10 * mm, at_most=100.0, doc="warp between the cylinders"
    )
    crimp: float = kind.ratio(CRIMP, at_least=0.0, at_most=1.0, doc="warp in the carpet over its length, less 1")
    shed_lift: float = kind.length(60 * mm, at_least=0.0, at_most=0.5, doc="lift of a warp for the shed; 0: none")
    shed_span: float = kind.length(
        170 * mm, at_least=1 * mm, at_most=2.0, doc="shedding cam to the holds on both sides"
    )
    tension_shed: float | None = kind.force(
        None,
        at_least=1e-6,
        at_most=1e5,
        doc="tension of a lifted warp in the open shed, after a take-up; default: by its lengthening, not compensated",
    )
    tension_shed_low: float | None = kind.force(
        None, at_least=0.0, at_most=1e5, doc="tension of the other warps in the open shed; default: not changed by it"
    )
    tension_beat: float | None = kind.force(
        None, at_least=1e-6, at_most=1e5, doc="tension of a warp at the beat; default: as the required rows need"
    )
    warps_beaten: int | None = kind.count(
        None, at_least=1, at_most=100_000, doc="warps that are beaten at once; default: all"
    )
    rows_between: int = kind.count(1, at_least=1, at_most=1000, doc="rows between two take-ups")

    @property
    def by_hand(self) -> bool:
        """Whether a hand winds."""
        return self.winding == HAND

    @property
    def span(self) -> float:
        """Distance of the cylinders' bearings [m]: as given, or the width of the cloth."""
        return self.width or self.cloth.width

    def check_together(self) -> None:
        """Raise ParameterError where the tube has no wall, is given twice, or is narrower than the cloth."""
        if self.span < self.cloth.width * (1 - 1e-9):
            raise ParameterError(
                f"width={format_quantity(self.span, 'm')} for a cloth of {format_quantity(self.cloth.width, 'm')}",
                allowed="at least the width of the cloth",
                do="leave width out, or set fewer cloth.warps or a smaller cloth.warp_pitch",
            )
        inner, outer = self.inner_radius, self.outer_radius
        if self.tube is not None and not inner is outer is None:
            raise ParameterError(f"tube={self.tube} and its radii", allowed="one of the two", do="leave the radii out")
        if outer is not None and inner is not None and outer <= inner:
            shown = format_quantity(inner, "mm")
            given = f"outer_radius={format_quantity(outer, 'mm')} is not above inner_radius={shown}"
            raise ParameterError(given, allowed=f"above {shown}", do="give radii, not diameters, or leave it out")
