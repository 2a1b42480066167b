"""Parameters of the tension compensator; the defaults are the thesis' loom."""

from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.elements.materials import MATERIALS
from ilmek.elements.springs import WIRES
from ilmek.errors import ParameterError
from ilmek.params import Params, kind, nested
from ilmek.units import MPa, deg, m, mm, rpm, turn
from ilmek.weaving.cloth import Cloth
from ilmek.weaving.shed import shed_lengthening
from ilmek.weaving.tension import RATE_SHARE, TENSION_LEAST, TENSION_MOST

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class TensionCompensatorParams(Params):
    """Warps and shed, limits of the tension, and the linkage."""

    cloth: Cloth = nested(Cloth, doc="warps, their tension and yarn; the bars are as wide")
    warp_length: float = kind.length(
        1.5 * m, unit="m", at_least=10 * mm, at_most=100.0, doc="warp that stretches, fell to cylinder"
    )
    lift: float = kind.length(60 * mm, at_least=0.01 * mm, at_most=0.5, doc="lift of a warp for the shed")
    front_span: float = kind.length(170 * mm, at_least=1 * mm, at_most=10.0, doc="shedding cam to the hold in front")
    back_span: float = kind.length(170 * mm, at_least=1 * mm, at_most=10.0, doc="shedding cam to the hold behind")
    lengthening: float | None = kind.length(
        None, above=0.0, at_most=1.0, doc="mean lengthening of the lifted warps in the open shed; default: by the spans"
    )
    rise: float = kind.angle(90 * deg, at_least=1 * deg, below=turn, doc="cam angle of the rise")
    dwell: float = kind.angle(0.0, at_least=0.0, below=turn, doc="cam angle for which the warp stays lifted")
    fall: float = kind.angle(90 * deg, at_least=1 * deg, below=turn, doc="cam angle of the return")
    law: str = kind.choice("harmonic", SMOOTH_LAWS, doc="motion law of rise and return")
    speed: float = kind.angular_speed(5 * rpm, at_least=1e-6 * rpm, at_most=600 * rpm, doc="speed of the cam shaft")
    tension_most: float = kind.ratio(
        TENSION_MOST, at_least=1.0, at_most=100.0, doc="greatest tension in the open shed over that at rest"
    )
    tension_least: float = kind.ratio(TENSION_LEAST, at_least=0.0, at_most=1.0, doc="least tension over that at rest")
    bars: int | None = kind.count(
        None, at_least=1, at_most=2, doc="sprung bars: 1 for all warps, 2 one for each parity; default: as required"
    )
    rate_share: float = kind.ratio(
        RATE_SHARE,
        at_least=1e-3,
        at_most=100.0,
        doc="rate of the compensator over that of its warps: the less, the less swing",
    )
    strand_angle: float = kind.angle(40 * deg, at_least=10 * deg, at_most=75 * deg, doc="deflection of a warp at rest")
    guide_span: float | None = kind.length(
        None,
        above=0.0,
        at_most=2.0,
        doc="bar to the height of the rods on both sides; default: 4 radii, or more",
    )
    bar_arm: float = kind.length(200 * mm, at_least=10 * mm, at_most=2.0, doc="pivot of the lever to the bar")
    arm_angle: float = kind.angle(50 * deg, at_least=0.0, below=90 * deg, doc="of that arm at rest from the warps")
    spring_arm: float = kind.length(250 * mm, at_least=10 * mm, at_most=2.0, doc="pivot of the lever to the springs")
    strut: float = kind.length(200 * mm, at_least=20 * mm, at_most=2.0, doc="springs at rest, from pin to pin")
    springs: int | None = kind.count(None, at_least=1, at_most=100, doc="springs on a lever; default: the fewest")
    wire: str | None = kind.choice(
        None, tuple(WIRES), doc="wire of the springs; default: music wire, chrome-silicon wire where that is not enough"
    )
    spring_fatigue: float = kind.ratio(1.2, at_least=0.0, at_most=20.0, doc="required safety of the springs' fatigue")
    support_span: float = kind.length(0.65 * m, unit="m", at_least=50 * mm, at_most=20.0, doc="largest span of levers")
    bar_tube: str | None = kind.text(None, doc="tube of bars and rods; default: the lightest that keeps the limits")
    bar_deflection: float = kind.length(1 * mm, at_least=1e-6, at_most=0.1, doc="allowed deflection of a bar")
    beam_sag: float = kind.ratio(
        2e-3, at_least=1e-6, at_most=0.1, doc="allowed deflection over its width of the beam that carries the levers"
    )
    lever_thickness: float = kind.length(15 * mm, at_least=1 * mm, at_most=0.2, doc="thickness of a lever")
    safety: float = kind.ratio(2.0, at_least=1.0, at_most=20.0, doc="against yield of bars, levers and beam")
    strength: float = kind.pressure(STEEL.strength, at_least=1 * MPa, at_most=1e10, doc="yield strength of the steel")
    frequency_ratio: float = kind.ratio(
        10.0, at_least=1.0, at_most=1e4, doc="required natural frequency over that of the shed"
    )

    @property
    def rate(self) -> float:
        """Gain of a warp's tension over its lengthening, EA / L [N/m]."""
        return self.cloth.carpet_yarns.warp.stiffness / self.warp_length

    @property
    def longer(self) -> float:
        """Lengthening of a lifted warp in the open shed [m]."""
        return self.lengthening or float(shed_lengthening(self.lift, self.front_span, self.back_span))

    @property
    def levers(self) -> int:
        """Levers of a bar, in the middle of equal parts of the width."""
        return max(2, -int(-self.cloth.width / self.support_span * (1 - 1e-9) // 1))

    @property
    def lifted_angle(self) -> float:
        """Cam angle for which a warp is off its line [rad]."""
        return self.rise + self.dwell + self.fall

    def check_together(self) -> None:
        """Raise ParameterError where the motion of a warp takes more than a turn."""
        if self.lifted_angle > turn * (1 + 1e-9):
            raise ParameterError("rise, dwell and fall take more than a turn", allowed="360 deg together")
