"""Parameters of the weft: the yarns and the cloth, the carrier, its bobbin or rapier, its axis."""

from dataclasses import dataclass

from ilmek.carpet.ground import SELVEDGE_WARPS, WEFT_TURN
from ilmek.elements.materials import BEECH, CARBON
from ilmek.machines import WEFT_CARRIERS
from ilmek.params import Params, kind, nested
from ilmek.timing.s_curve import AxisLimits
from ilmek.units import deg, mm
from ilmek.weaving.cloth import Cloth

AUTO = "auto"
SHUTTLE, RAPIER = WEFT_CARRIERS


@dataclass(frozen=True, slots=True)
class WeftParams(Params):
    """The cloth, and what carries its wefts through the shed; the defaults are for the thesis' loom."""

    carrier: str = kind.choice(AUTO, (AUTO, *WEFT_CARRIERS), doc="what carries the weft; auto: chosen by aim")
    aim: str = kind.choice("price", ("price", "time"), doc="what is least in the choice of what is left open")
    cloth: Cloth = nested(Cloth, default=Cloth(warps=608), doc="warps and yarns")
    rows: int = kind.count(450, at_least=1, at_most=1_000_000, doc="rows of knots, two wefts after each")
    selvedge_warps: int = kind.count(
        SELVEDGE_WARPS, at_least=0, at_most=200, doc="warps without knots, both edges together"
    )
    turn: float = kind.length(
        WEFT_TURN, at_least=0.0, at_most=0.5, doc="weft beyond the cloth for a row: its turn, or both ends tucked in"
    )
    lift: float = kind.length(60 * mm, at_least=0.01 * mm, at_most=1.0, doc="lift of the warps at the cams")
    open_share: float = kind.ratio(
        0.9, at_least=0.05, at_most=1.0, doc="opening of the shed at the cams, over the lift, at which a weft may pass"
    )
    play: float = kind.length(3 * mm, at_least=0.0, at_most=0.1, doc="between the carrier and the warps on each side")
    speed: float = kind.speed(3.0, at_least=0.01, at_most=100.0, doc="allowed speed of the carrier")
    acceleration: float = kind.acceleration(20.0, at_least=0.01, at_most=1e5, doc="allowed acceleration of the carrier")
    jerk: float = kind.jerk(400.0, at_least=0.1, at_most=1e8, doc="allowed jerk of the carrier")
    edge: float = kind.length(30 * mm, at_least=0.0, at_most=1.0, doc="from the cloth's edge to the carrier at rest")
    room: float = kind.length(3.0, unit="m", at_least=0.0, at_most=100.0, doc="free room beside the cloth on each side")
    bobbin_diameter: float | None = kind.length(
        None, at_least=2 * mm, at_most=0.3, doc="diameter of a full bobbin; default: chosen from the table"
    )
    bobbin_length: float | None = kind.length(
        None, at_least=5 * mm, at_most=2.0, doc="length of the winding; default: of the table"
    )
    packing: float = kind.ratio(0.65, at_least=0.05, at_most=0.95, doc="share of the winding that is yarn")
    reserve: float = kind.length(1.0, unit="m", at_least=0.0, at_most=100.0, doc="weft left on a bobbin at its change")
    least_rows: int = kind.count(20, at_least=1, at_most=100_000, doc="rows between two changes of a bobbin, at least")
    change_time: float = kind.time(90.0, at_least=0.0, at_most=1e6, doc="stop of the loom to change a bobbin")
    wall: float = kind.length(3 * mm, at_least=0.1 * mm, at_most=50 * mm, doc="wall of the shuttle about its bobbin")
    nose: float = kind.length(40 * mm, at_least=0.0, at_most=0.5, doc="each pointed end of the shuttle")
    shuttle_density: float = kind.density(BEECH.density, at_least=1.0, at_most=2e4, doc="density of the shuttle: beech")
    fittings: float = kind.mass(0.1, at_least=0.0, at_most=10.0, doc="mass of the shuttle's eyes and brake")
    safety: float = kind.ratio(1.5, at_least=1.0, at_most=20.0, doc="required safety of coupling and grip")
    carriage_mass: float = kind.mass(0.6, at_least=0.0, at_most=50.0, doc="mass of the rapier's carriage on the belt")
    brake: float | None = kind.force(
        None, at_least=0.0, at_most=100.0, doc="tension of a weft behind its brake; default: by brake_share"
    )
    brake_share: float = kind.ratio(
        0.005, at_least=0.0, at_most=1.0, doc="share of its breaking force to which a weft is braked"
    )
    wrap: float = kind.angle(270 * deg, at_least=0.0, at_most=1800 * deg, doc="angle of the weft about eyes and guides")
    tension_share: float = kind.ratio(
        0.2, above=0.0, at_most=1.0, doc="share of its breaking force to which the weft may be tensioned"
    )
    grip_force: float = kind.force(40.0, at_least=0.0, at_most=1e4, doc="force of the rapier's gripper on the weft")
    grip_time: float = kind.time(0.1, at_least=0.0, at_most=10.0, doc="time in which the gripper takes the weft")
    gripper_mass: float = kind.mass(0.12, at_least=0.0, at_most=10.0, doc="mass of the rapier's gripper")
    gripper_size: float = kind.length(20 * mm, at_least=1 * mm, at_most=0.3, doc="height and depth of the gripper")
    rapier_height: float | None = kind.length(
        None, at_least=2 * mm, at_most=0.5, doc="height of the rapier's tube along the warps; default: chosen"
    )
    rapier_modulus: float = kind.pressure(
        CARBON.modulus, unit="GPa", at_least=1e6, at_most=1e13, doc="Young's modulus of the rapier: carbon fibre"
    )
    rapier_density: float = kind.density(CARBON.density, at_least=1.0, at_most=2e4, doc="density of the rapier")
    sag_limit: float = kind.length(8 * mm, at_least=1e-6, at_most=0.5, doc="allowed sag of the rapier's tip")
    belt_efficiency: float = kind.ratio(0.9, at_least=0.05, at_most=1.0, doc="efficiency of belt, pulleys and guide")
    crossed: bool = kind.flag(True, doc="the shuttles' boxes let the wefts cross so that the outermost warps are bound")
    turn_time: float = kind.time(12.0, at_least=1e-3, at_most=1e6, doc="time of a turn of the shedding cams")
    prices: str | None = kind.text(None, doc="prices other than those of the table")

    @property
    def limits(self) -> AxisLimits:
        """Limits of the carrier's axis."""
        return AxisLimits(self.speed, self.acceleration, self.jerk)

    @property
    def edge_warps(self) -> int:
        """Selvedge warps at the edge that has fewer."""
        return self.selvedge_warps // 2
