"""Parameters of the hammer."""

import math
from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.beat_up.beam import POST
from ilmek.machines.beat_up.use_params import CrankStartParams
from ilmek.machines.strength_params import StrengthParams
from ilmek.params import Params, kind, nested
from ilmek.units import MPa, deg, format_quantity, hour, mm, rpm, turn
from ilmek.weaving.cloth import Cloth
from ilmek.weaving.fell import CLOTH_LENGTH, JAMMED, LAID, PACKING, Fabric

DRIVES = ("comb", "linkage")
AXES = ("screw", "belt")

STACK = 550.0 / 1.2
"""Mass of the shedding cams over the width [kg/m], which the thesis' comb takes down with it [thesis 3.2, 3.3]."""

STEEL = MATERIALS["structural steel"]

DEPTHS = tuple(depth * 10 * mm for depth in range(2, 51))
"""Heights of a comb's bar to choose from [m]."""

LEADS = (10 * mm, 20 * mm, 40 * mm)
"""Leads of screws to choose from [m]."""

MOST_HOLDS = 200
"""Most supports, and most vertical axes, of a comb."""

MOST_BEATERS = 100
"""Most crank-rockers of a comb."""

MOST_BALLAST = 1e5
"""Largest ballast of a comb [kg]."""

BEATER_WIDTH = 1.5
"""Width of the comb for each crank-rocker, and for each vertical axis beyond the first [m]."""


@dataclass(frozen=True, slots=True)
class HammerParams(Params):
    """Fabric, comb and drive of the hammer; the defaults are the thesis' loom."""

    cloth: Cloth = nested(Cloth, doc="warps, their tension and yarn, and the required distance of rows")
    laid_pitch: float | None = kind.length(
        None,
        at_least=0.01 * mm,
        at_most=0.5,
        doc="distance of a row from the fell before the beat; default: 1.5 times the required one",
    )
    jammed_pitch: float | None = kind.length(
        None,
        at_least=1e-3 * mm,
        at_most=0.2,
        doc="distance of jammed rows; default: 0.75 times the required one",
        symbol="D",
    )
    packing: float | None = kind.length(
        None,
        at_least=1e-6 * mm,
        at_most=1.0,
        doc="packing length, how hard rows pack: to be measured; default: 1/4 of the rows' pitch, 10 N on 15 N",
        symbol="K",
    )
    warp_length: float = kind.length(1.5, unit="m", at_least=0.01, at_most=100.0, doc="warp from fell to beam")
    cloth_length: float = kind.length(
        CLOTH_LENGTH, unit="m", at_least=0.01, at_most=100.0, doc="cloth from fell to beam"
    )
    drive: str = kind.choice("comb", DRIVES, doc="comb on the guide cams with its vertical stroke, or crank-rockers")
    force: float | None = kind.force(
        None,
        at_least=1e-6,
        at_most=1e4,
        doc="force on the fell for each warp; default: what the rows need, or what the linkage gives",
    )
    comb_depth: float | None = kind.length(
        None,
        at_least=1 * mm,
        at_most=1.0,
        doc="height of the comb's bar, along the beat; default: the least whole centimetre that is even enough",
    )
    comb_thickness: float = kind.length(20 * mm, at_least=0.5 * mm, at_most=1.0, doc="thickness of the comb's bar")
    supports: int | None = kind.count(
        None,
        at_least=1,
        at_most=MOST_HOLDS,
        doc="points that hold the comb; default: both ends and every 1.5 m, or the crank-rockers",
    )
    support_inset: float | None = kind.length(
        None,
        at_least=0.0,
        at_most=6.0,
        doc="from the comb's ends to the first support; default: 0, or half of a crank-rocker's share",
    )
    modulus: float = kind.pressure(
        STEEL.modulus, unit="GPa", at_least=1 * MPa, at_most=2e12, doc="Young's modulus of the comb"
    )
    density: float = kind.density(STEEL.density, at_least=1.0, at_most=25e3, doc="density of the comb")
    strength: float = kind.pressure(235 * MPa, at_least=1 * MPa, at_most=1e10, doc="yield strength of the comb")
    beam_length: float | None = kind.length(
        None,
        at_least=10 * mm,
        at_most=50.0,
        doc="length of the beam that carries axes or crank-rockers; default: the width, and posts beside it",
    )
    axes_height: float | None = kind.length(
        None, at_least=10 * mm, at_most=2.0, doc="lower end of vertical axes over the fell; default: above heads"
    )
    leaf_reach: float | None = kind.length(
        None,
        at_least=1 * mm,
        at_most=1.0,
        doc="leaf from its root to the fell; default: 80 mm, before the guide cams; 14 mm on crank-rockers",
    )
    leaf_height: float = kind.length(20 * mm, at_least=0.5 * mm, at_most=0.5, doc="height of a leaf, along the beat")
    leaf_thickness: float | None = kind.length(
        None, at_least=1e-3 * mm, at_most=50 * mm, doc="thickness of a leaf; default: 0.4 of the warp pitch"
    )
    uniformity_limit: float = kind.ratio(
        0.9, at_least=0.0, below=1.0, doc="allowed ratio of the least to the largest force across the width"
    )
    stroke: float = kind.length(100 * mm, at_least=1 * mm, at_most=2.0, doc="vertical stroke of the comb")
    law: str = kind.choice("modified-sine", SMOOTH_LAWS, doc="motion law of the stroke")
    shed_speed: float = kind.angular_speed(
        5 * rpm, at_least=0.01 * rpm, at_most=120 * rpm, doc="speed of the shed cams"
    )
    step: float = kind.angle(
        90 * deg, at_least=1e-3 * deg, at_most=180 * deg, doc="cam angle of a beat: down, press, up"
    )
    press_share: float = kind.ratio(0.15, at_least=0.0, at_most=0.9, doc="share of it for which the comb presses")
    stack_mass: float | None = kind.mass(
        None, at_least=0.0, at_most=1e5, doc="cams that go down with the comb; default: 550 kg on 1.2 m"
    )
    counterbalance: float = kind.ratio(0.0, at_least=0.0, at_most=1.0, doc="share of the weight that is balanced")
    axes: int | None = kind.count(
        None,
        at_least=1,
        at_most=MOST_HOLDS,
        doc="vertical axes of the comb; default: one a support, or more where these fail",
    )
    axis: str = kind.choice("screw", AXES, doc="ball screws or toothed belts")
    lead: float | None = kind.length(
        None, at_least=0.5 * mm, at_most=0.2, doc="lead of the screws; default: the least of stock that is enough"
    )
    screw_diameter: float | None = kind.length(
        None, at_least=5 * mm, at_most=0.5, doc="diameter of a screw; default: the least of stock that is enough"
    )
    pulley_radius: float = kind.length(25 * mm, at_least=5 * mm, at_most=0.5, doc="pitch radius of the belts' pulleys")
    axis_efficiency: float = kind.ratio(0.9, at_least=0.05, at_most=1.0, doc="efficiency of screw or belt")
    axis_life: float = kind.time(
        10_000 * hour, unit="h", at_least=1.0, at_most=1e10, doc="required life of the screws' nuts"
    )
    axis_speed_value: float = kind.speed(
        100_000 * mm * rpm, at_least=1e-3, at_most=1e3, doc="allowed product of a screw's diameter and angular speed"
    )
    beat_speed: float | None = kind.angular_speed(
        None,
        unit="rad/s",
        at_least=0.1,
        at_most=1e3,
        doc="speed of the crank; default: the cheapest that gives the force",
    )
    ballast: float | None = kind.mass(
        None,
        at_least=0.0,
        at_most=MOST_BALLAST,
        doc="mass added to the comb on crank-rockers; default: what the force needs",
    )
    beaters: int | None = kind.count(
        None,
        at_least=1,
        at_most=MOST_BEATERS,
        doc="crank-rockers; default: one per 1.5 m of width, or more if that is cheaper",
    )
    ground: float = kind.length(0.3, at_least=1 * mm, at_most=10.0, doc="distance of the pivots of crank and rocker")
    swing: float | None = kind.angle(
        None, at_least=5 * deg, at_most=60 * deg, doc="swing of the rocker; default: 30 deg, less where a reed needs it"
    )
    link_width: float | None = kind.length(
        None, at_least=1 * mm, at_most=1.0, doc="width of the links, in their plane; default: the least of stock"
    )
    link_thickness: float | None = kind.length(
        None, at_least=1 * mm, at_most=1.0, doc="thickness of the links; default: of the stock section"
    )
    links: StrengthParams = nested(StrengthParams, doc="what links and pins of the crank-rockers bear")
    start: CrankStartParams = nested(CrankStartParams, doc="start and stop of the crank")

    def check_together(self) -> None:
        """Raise ParameterError where rows, leaves or supports do not fit."""
        fabric, rows = self.fabric, self.cloth.row_distance
        if not fabric.jammed < rows < fabric.laid:
            given, least, most = (format_quantity(value, "mm") for value in (rows, fabric.jammed, fabric.laid))
            allowed = f"between jammed_pitch={least} and laid_pitch={most}"
            do = "set jammed_pitch below and laid_pitch above cloth.row_pitch"
            raise ParameterError(f"rows {given} apart", allowed=allowed, do=do)
        if self.leaf >= self.cloth.warp_pitch:
            leaf, pitch = format_quantity(self.leaf, "mm"), format_quantity(self.cloth.warp_pitch, "mm")
            given, do = f"leaf_thickness={leaf} on a warp pitch of {pitch}", "leave it out for 0.4 of the pitch"
            raise ParameterError(given, allowed=f"below {pitch}, less the warp's own thickness", do=do)
        if self.inset * 2 > self.cloth.width * (1 + 1e-9):
            given = f"support_inset={format_quantity(self.inset, 'mm')} on both sides"
            allowed = f"at most half of the width, {format_quantity(self.cloth.width / 2, 'mm')}"
            raise ParameterError(given, allowed=allowed, do="set a smaller one")

    @property
    def fabric(self) -> Fabric:
        """The fabric at the fell, for one warp."""
        pitch, stiffness = self.cloth.row_distance, self.cloth.carpet_yarns.warp.stiffness
        return Fabric(
            tension=self.cloth.warp_tension,
            laid=self.laid_pitch or LAID * pitch,
            jammed=self.jammed_pitch or JAMMED * pitch,
            packing=self.packing or PACKING * pitch,
            warp_rate=stiffness / self.warp_length,
            cloth_rate=stiffness / self.cloth_length,
        )

    @property
    def leaf(self) -> float:
        """Thickness of a leaf [m]."""
        return self.leaf_thickness or 0.4 * self.cloth.warp_pitch

    @property
    def beam_reach(self) -> float:
        """Length of the beam that carries the axes or the crank-rockers [m]."""
        return self.beam_length or self.cloth.width + 2 * POST

    @property
    def reach(self) -> float:
        """Leaf from its root to the fell [m]: as given, or as usual of the drive."""
        return self.leaf_reach or (14 * mm if self.drive == "linkage" else 80 * mm)

    @property
    def rockers(self) -> int:
        """Crank-rockers of the linkage."""
        return self.beaters or min(math.ceil(self.cloth.width / BEATER_WIDTH - 1e-9), MOST_BEATERS)

    @property
    def support_count(self) -> int:
        """Points that hold the comb."""
        return self.supports or min(self.rockers + 1 if self.drive == "comb" else self.rockers, MOST_HOLDS)

    @property
    def axis_count(self) -> int:
        """Vertical axes that share the comb."""
        return self.axes or self.support_count

    @property
    def screw_lead(self) -> float:
        """Lead of the screws [m]; where none is set, the least of `LEADS`."""
        return self.lead or LEADS[0]

    @property
    def depth(self) -> float:
        """Height of the comb's bar [m]; where none is set, the least of `DEPTHS`."""
        return self.comb_depth or DEPTHS[0]

    @property
    def inset(self) -> float:
        """From the comb's ends to the first support [m]: 0, or half of a crank-rocker's share."""
        if self.support_inset is not None:
            return self.support_inset
        return 0.0 if self.drive == "comb" and self.support_count > 1 else self.cloth.width / self.support_count / 2

    @property
    def turn_time(self) -> float:
        """Time of a turn of the shed's cams [s]: two beats."""
        return turn / self.shed_speed
