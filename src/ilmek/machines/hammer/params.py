"""What may be asked of the hammer."""

import math
from dataclasses import dataclass

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.elements.materials import MATERIALS
from ilmek.elements.yarns import warp_stiffness
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import MPa, deg, format_quantity, mm, rpm, turn
from ilmek.weaving.tension import usual_tension

DRIVES = ("comb", "linkage")
AXES = ("screw", "belt")

STACK = 550.0 / 1.2
"""Mass of the shedding cams over the width [kg/m], which the thesis' comb takes down with it [thesis 3.2, 3.3]."""

STEEL = MATERIALS["structural steel"]


@dataclass(frozen=True, slots=True)
class FabricParams(Params):
    """What is woven: warps, rows, and how they pack."""

    warps: int = param(600, at_least=2, at_most=100_000, doc="warps across")
    warp_pitch: float = param(2 * mm, unit="mm", at_least=0.01 * mm, at_most=50 * mm, doc="distance of two warps")
    row_pitch: float | None = param(
        None, unit="mm", at_least=0.01 * mm, at_most=0.2, doc="distance of two rows wanted; none: of two knots across"
    )
    tension: float | None = param(
        None, unit="N", at_least=1e-3, at_most=1e3, doc="of a warp; none: 15 N at 2 mm, as its mass", symbol="T"
    )
    laid_pitch: float | None = param(
        None, unit="mm", at_least=0.01 * mm, at_most=0.5, doc="of a row before the beat; none: 1.5 times the one wanted"
    )
    jammed_pitch: float | None = param(
        None,
        unit="mm",
        at_least=1e-3 * mm,
        at_most=0.2,
        doc="of a jammed row; none: 0.75 of the one wanted",
        symbol="D",
    )
    packing: float | None = param(
        None,
        unit="mm",
        at_least=1e-6 * mm,
        at_most=1.0,
        doc="how hard rows pack, to be measured; none: a quarter of row_pitch, 10 N on 15 N of tension",
        symbol="K",
    )
    warp_stiffness: float | None = param(
        None,
        unit="N",
        at_least=1.0,
        at_most=1e7,
        doc="force over strain of a warp; none: cotton of its mass",
        symbol="EA",
    )
    warp_length: float = param(1.5, unit="m", at_least=0.01, at_most=100.0, doc="warp from the fell to its beam")
    cloth_length: float = param(0.5, unit="m", at_least=0.01, at_most=100.0, doc="cloth from the fell to its beam")

    @property
    def rows(self) -> float:
        """Distance of two rows wanted [m]."""
        return self.row_pitch or 2 * self.warp_pitch

    @property
    def width(self) -> float:
        """Width of the warps [m]."""
        return self.warps * self.warp_pitch

    @property
    def warp_tension(self) -> float:
        """Tension of a warp [N]."""
        return self.tension or usual_tension(self.warp_pitch)

    @property
    def stiffness(self) -> float:
        """Force over strain of a warp [N]."""
        return self.warp_stiffness or warp_stiffness(self.warp_pitch)


@dataclass(frozen=True, slots=True)
class HammerParams(FabricParams):
    """What is asked of the hammer; the defaults are the thesis' loom."""

    drive: str = param("comb", choices=DRIVES, doc="comb on the guide cams with its vertical stroke, or crank-rockers")
    force: float | None = param(
        None,
        unit="N",
        at_least=1e-6,
        at_most=1e4,
        doc="on the fell for each warp; none: what row_pitch or linkage give",
    )
    comb_depth: float | None = param(
        None,
        unit="mm",
        at_least=1 * mm,
        at_most=1.0,
        doc="height of the comb's bar, along the beat; none: the least whole centimetre that is even enough",
    )
    comb_thickness: float = param(20 * mm, unit="mm", at_least=0.5 * mm, at_most=1.0, doc="thickness of the comb's bar")
    supports: int | None = param(
        None,
        at_least=1,
        at_most=200,
        doc="places where the comb is held; none: both ends and every 1.5 m, or the crank-rockers",
    )
    support_inset: float | None = param(
        None, unit="mm", at_least=0.0, at_most=6.0, doc="from the comb's ends to the first; none: 0, or half a share"
    )
    modulus: float = param(STEEL.modulus, unit="GPa", at_least=1 * MPa, at_most=2e12, doc="Young's modulus of the comb")
    density: float = param(STEEL.density, unit="kg/m^3", at_least=1.0, at_most=25e3, doc="density of the comb")
    strength: float = param(235 * MPa, unit="MPa", at_least=1 * MPa, at_most=1e10, doc="yield strength of the comb")
    leaf_reach: float = param(80 * mm, unit="mm", at_least=1 * mm, at_most=1.0, doc="leaf from its root to the fell")
    leaf_height: float = param(
        20 * mm, unit="mm", at_least=0.5 * mm, at_most=0.5, doc="height of a leaf, along the beat"
    )
    leaf_thickness: float | None = param(
        None, unit="mm", at_least=1e-3 * mm, at_most=50 * mm, doc="of a leaf; none: 0.4 of the warp pitch"
    )
    uniformity_limit: float = param(0.9, at_least=0.0, below=1.0, doc="least force over the largest, across the width")
    stroke: float = param(100 * mm, unit="mm", at_least=1 * mm, at_most=2.0, doc="vertical stroke of the comb")
    law: str = param("modified-sine", choices=SMOOTH_LAWS, doc="motion law of the stroke")
    shed_speed: float = param(
        5 * rpm, unit="rpm", at_least=0.01 * rpm, at_most=120 * rpm, doc="speed of the shed's cams"
    )
    step: float = param(
        90 * deg, unit="deg", at_least=1 * deg, at_most=180 * deg, doc="cam angle for a beat, down, press and up"
    )
    press_share: float = param(0.15, at_least=0.0, at_most=0.9, doc="share of it for which the comb presses")
    stack_mass: float | None = param(
        None, unit="kg", at_least=0.0, at_most=1e5, doc="cams that go down with the comb; none: 550 kg on 1.2 m"
    )
    counterbalance: float = param(0.0, at_least=0.0, at_most=1.0, doc="share of the weight that is balanced")
    axes: int | None = param(
        None, at_least=1, at_most=200, doc="vertical axes that share the comb; none: one where it is held"
    )
    axis: str = param("screw", choices=AXES, doc="ball screws or toothed belts")
    lead: float = param(10 * mm, unit="mm", at_least=0.5 * mm, at_most=0.2, doc="lead of the screws")
    screw_diameter: float | None = param(
        None, unit="mm", at_least=5 * mm, at_most=0.5, doc="of a screw; none: the least of stock that does not buckle"
    )
    pulley_radius: float = param(
        25 * mm, unit="mm", at_least=5 * mm, at_most=0.5, doc="pitch radius of the belts' pulleys"
    )
    axis_efficiency: float = param(0.9, at_least=0.05, at_most=1.0, doc="efficiency of screw or belt")
    beat_speed: float = param(15.5, unit="rad/s", at_least=0.1, at_most=1e3, doc="speed of the linkage's crank")
    beaters: int | None = param(None, at_least=1, at_most=100, doc="crank-rockers; none: one for 1.5 m of width")
    ground: float = param(0.3, unit="mm", at_least=1 * mm, at_most=10.0, doc="pivots of crank and rocker apart")

    def check_together(self) -> None:
        """Raise ParameterError where rows, leaves or supports do not fit."""
        laid, jammed = self.laid, self.jammed
        if not jammed < self.rows < laid:
            asked, least, most = (format_quantity(value, "mm") for value in (self.rows, jammed, laid))
            raise ParameterError(
                f"rows {asked} apart",
                allowed=f"between jammed_pitch={least} and laid_pitch={most}",
                do="set jammed_pitch below and laid_pitch above row_pitch",
            )
        if self.leaf >= self.warp_pitch:
            leaf, pitch = format_quantity(self.leaf, "mm"), format_quantity(self.warp_pitch, "mm")
            raise ParameterError(
                f"leaf_thickness={leaf} on a warp pitch of {pitch}",
                allowed=f"below {pitch}, less the warp's own thickness",
                do="leave it out for 0.4 of the pitch",
            )
        if self.inset * 2 > self.width * (1 + 1e-9):
            raise ParameterError(
                f"support_inset={format_quantity(self.inset, 'mm')} on both sides",
                allowed=f"at most half of the width, {format_quantity(self.width / 2, 'mm')}",
                do="set a smaller one",
            )

    @property
    def laid(self) -> float:
        """Distance of a row that is laid from the fell [m]."""
        return self.laid_pitch or 1.5 * self.rows

    @property
    def jammed(self) -> float:
        """Distance of jammed rows [m]."""
        return self.jammed_pitch or 0.75 * self.rows

    @property
    def leaf(self) -> float:
        """Thickness of a leaf [m]."""
        return self.leaf_thickness or 0.4 * self.warp_pitch

    @property
    def rockers(self) -> int:
        """Crank-rockers of the linkage."""
        return self.beaters or math.ceil(self.width / BEATER_WIDTH - 1e-9)

    @property
    def places(self) -> int:
        """Places where the comb is held."""
        return self.supports or (self.rockers + 1 if self.drive == "comb" else self.rockers)

    @property
    def shared(self) -> int:
        """Vertical axes that share the comb."""
        return self.axes or self.places

    @property
    def depth(self) -> float:
        """Height of the comb's bar [m]; where none is set, the least that there is."""
        return self.comb_depth or DEPTHS[0]

    @property
    def inset(self) -> float:
        """From the comb's ends to the first place where it is held [m]: 0, or half of a crank-rocker's share."""
        if self.support_inset is not None:
            return self.support_inset
        return 0.0 if self.drive == "comb" and self.places > 1 else self.width / self.places / 2

    @property
    def turn_time(self) -> float:
        """Time of a turn of the shed's cams [s]: two beats."""
        return turn / self.shed_speed


DEPTHS = tuple(depth * 10 * mm for depth in range(2, 51))
"""Heights of a comb's bar to choose from [m]."""

BEATER_WIDTH = 1.5
"""Width of the comb for each crank-rocker [m]."""
