"""Parameters of a tufting machine: carpet and yarn, needle drives and bar, looper, shafts, feed."""

from dataclasses import dataclass, replace

from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.strength_params import StrengthParams
from ilmek.machines.tufting.params import TuftingParams
from ilmek.params import Params, kind, nested
from ilmek.units import MPa, deg, format_quantity, g, inch, m, mm, turn
from ilmek.weaving.tufting.programme import TuftGrid

PILES = ("loop", "cut")
ATTACHMENTS = ROLLERS, GROUPS, SCROLLS = ("rollers", "groups", "scrolls")
SELECTIONS = BY_YARN, BY_NEEDLE = ("yarn", "needles")

FOLLOWING = ("bars", "needle_mass", "friction", "friction_force", "entry", "exit", "stroke")
"""Parameters of the needle drive that follow from the machine's."""


@dataclass(frozen=True, slots=True)
class TuftingPatternParams(Params):
    """What makes a pattern: feed of each yarn, colours of the creel, selection; values assumed by this project."""

    attachment: str = kind.choice(
        ROLLERS,
        ATTACHMENTS,
        doc="feed of the yarn: rollers for all needles, for groups of them, or a scroll with its motor for each needle",
    )
    groups: int = kind.count(2, at_least=2, at_most=64, doc="groups of needles, needle by needle in turn")
    colours: int = kind.count(1, at_least=1, at_most=16, doc="colours of the creel, in turn from needle to needle")
    creel: int = kind.count(8, at_least=1, at_most=16, doc="colours that the creel may have in turn")
    selection: str = kind.choice(
        BY_YARN,
        SELECTIONS,
        doc="yarn: all needles tuft at each stroke, what is not to be seen is fed low (overtufting); needles: over "
        "each tuft the one of its colour alone",
    )
    hidden: float = kind.length(0.0, at_least=0.0, at_most=30 * mm, doc="height of loops that are not to be seen")
    module: int = kind.count(20, at_least=1, at_most=400, doc="scrolls or latches of a module, wired as one axis")
    threading: float = kind.time(20.0, at_least=0.0, at_most=3600.0, doc="threading of a needle from its cone")


@dataclass(frozen=True, slots=True)
class TuftedCarpetParams(Params):
    """The carpet and its yarn."""

    width: float = kind.length(4.0, unit="m", at_least=0.2, at_most=5.0, doc="width that is tufted")
    gauge: float = kind.length(inch / 8, at_least=0.5 * mm, at_most=50 * mm, doc="distance of the needles", symbol="g")
    stitch_rate: float = kind.knot_density(320.0, at_least=50.0, at_most=2000.0, doc="stitches over the length")
    pile: str = kind.choice("loop", PILES, doc="loops left whole, or cut by a knife on each looper")
    pile_height: float = kind.length(
        10 * mm, at_least=1 * mm, at_most=60 * mm, doc="height of the loops over the backing", symbol="h"
    )
    low_height: float | None = kind.length(
        None, at_least=0.5 * mm, at_most=60 * mm, doc="height of the low loops of a pattern; default: all are alike"
    )
    low_share: float = kind.ratio(0.5, at_least=0.0, at_most=1.0, doc="share of low loops where low_height is given")
    backing_thickness: float = kind.length(
        0.5 * mm, at_least=0.0, at_most=5 * mm, doc="thickness of the primary backing", symbol="t"
    )
    back_stitch: float = kind.ratio(
        1.0, at_least=0.0, at_most=2.0, doc="yarn from stitch to stitch on the back, over their distance", symbol="k"
    )
    shift: float = kind.ratio(
        0.0, at_least=0.0, at_most=8.0, doc="gauges, whole or half ones, by which the needle bar shifts at each stroke"
    )
    pattern: TuftingPatternParams = nested(TuftingPatternParams, doc="feed of each yarn, colours, selection")
    yarn_density: float = kind.line_density(
        3400 / 9000 * g / m, unit="g/m", above=0.0, at_most=0.05, doc="mass per length of the yarn: 3400 den"
    )
    fibre_density: float = kind.density(1140.0, at_least=500.0, at_most=3000.0, doc="density of the fibre: polyamide 6")
    packing: float = kind.ratio(0.5, at_least=0.1, at_most=0.95, doc="share of fibre in the section of the yarn")
    running: float = kind.ratio(
        0.8, above=0.0, at_most=1.0, doc="share of the time for which the machine runs: creel, breaks of yarn; assumed"
    )

    @property
    def stitch(self) -> float:
        """Distance of the stitches along the carpet [m]."""
        return 1 / self.stitch_rate

    @property
    def advance(self) -> float:
        """Travel of the backing at a stroke [m]: each colour of the creel has its stroke at each place."""
        return self.stitch / self.pattern.colours

    @property
    def bar_step(self) -> float:
        """Step of the needle bar between strokes [m]: with several colours the next is a gauge away."""
        return self.gauge * (self.shift if self.pattern.colours == 1 else 1)

    @property
    def looper_gauge(self) -> float:
        """Distance of the loopers, which do not shift [m]."""
        return self.gauge if self.shift == int(self.shift) else self.gauge / 2

    @property
    def grid(self) -> TuftGrid:
        """Distances, heights and backing of its tufts."""
        pattern, low = self.pattern, self.pile_height if self.low_height is None else self.low_height
        return TuftGrid(
            self.gauge, self.stitch, self.pile_height, low, pattern.hidden, self.backing_thickness, self.back_stitch
        )

    def check_together(self) -> None:
        """Raise ParameterError for low loops that are higher than the others, and for a shift that cannot be."""
        if 2 * self.shift != int(2 * self.shift):
            raise ParameterError(f"shift={self.shift:g}", allowed="whole and half gauges", do="set 0, 0.5, 1, ...")
        if self.shift and self.pattern.colours > 1:
            given = f"shift={self.shift:g} with pattern.colours={self.pattern.colours}"
            raise ParameterError(
                given, allowed="the bar goes from colour to colour, a gauge a stroke", do="leave it out"
            )
        if self.pattern.hidden > self.pile_height:
            given = f"pattern.hidden={format_quantity(self.pattern.hidden, 'mm')}"
            allowed = f"at most pile_height={format_quantity(self.pile_height, 'mm')}"
            raise ParameterError(given, allowed=allowed, do="set a lower one")
        if self.low_height is not None and self.low_height > self.pile_height:
            given = f"low_height={format_quantity(self.low_height, 'mm')}"
            allowed = f"at most pile_height={format_quantity(self.pile_height, 'mm')}"
            raise ParameterError(given, allowed=allowed, do="set a lower one")


@dataclass(frozen=True, slots=True)
class LooperParams(Params):
    """Looper and needle beside each other, and the crank-rocker that moves the loopers; sizes assumed by this project.

    The hook swings on an arm about the looper shaft, across the shafts: forward past the needle's line, and back.
    """

    arm: float = kind.length(120 * mm, at_least=10 * mm, at_most=1.0, doc="from the looper shaft to the hook's point")
    reach: float = kind.length(8 * mm, above=0.0, at_most=0.2, doc="hook's point past the needle's line, forward")
    retreat: float = kind.length(12 * mm, above=0.0, at_most=0.2, doc="hook's point before the needle's line, back")
    height: float = kind.length(3 * mm, at_least=0.2 * mm, at_most=20 * mm, doc="height of the hook near its point")
    thickness: float = kind.length(
        1 * mm, at_least=0.1 * mm, at_most=10 * mm, doc="thickness of the hook along the shafts"
    )
    gap: float = kind.length(0.2 * mm, at_least=0.0, at_most=5 * mm, doc="between the needle and the hook beside it")
    needle: float = kind.length(0.9 * mm, at_least=0.1 * mm, at_most=10 * mm, doc="thickness of a needle there")
    eye: float = kind.length(5 * mm, at_least=0.5 * mm, at_most=40 * mm, doc="needle's point to the top of its eye")
    below: float = kind.length(
        4 * mm, at_least=0.1 * mm, at_most=40 * mm, doc="eye below the hook where the needle is lowest"
    )
    clear: float = kind.length(0.5 * mm, at_least=0.0, at_most=10 * mm, doc="clearance of hook and needle in height")
    late: float = kind.angle(0.0, at_least=-turn, at_most=turn, doc="delay of the looper behind its timing by design")
    crank_rotation: float | None = kind.angle(
        None, above=90 * deg, below=270 * deg, doc="crank between the ends of the swing; default: best timing"
    )
    ground: float = kind.length(150 * mm, at_least=20 * mm, at_most=2.0, doc="looper shaft to its crank shaft")
    transmission: float = kind.angle(
        40 * deg, at_least=0.0, at_most=90 * deg, doc="least transmission angle of the crank-rocker"
    )
    link_width: float = kind.length(40 * mm, at_least=5 * mm, at_most=0.5, doc="width of coupler and rocker")
    link_thickness: float = kind.length(12 * mm, at_least=2 * mm, at_most=0.2, doc="thickness of coupler and rocker")
    shaft: float = kind.length(30 * mm, at_least=5 * mm, at_most=0.2, doc="diameter of both looper shafts")
    pin: float = kind.length(12 * mm, at_least=2 * mm, at_most=0.1, doc="diameter of the pin of coupler and rocker")
    bar: float = kind.length(25 * mm, at_least=2 * mm, at_most=0.2, doc="side of the square bar that carries loopers")
    stem: float = kind.length(35 * mm, at_least=2 * mm, at_most=0.3, doc="hook's point over the bar")
    coupling: float = kind.ratio(
        0.1, above=0.0, below=1.0, doc="crank over coupler, where the crank's rotation allows it"
    )
    loop_tension: float = kind.force(
        0.3, at_least=0.0, at_most=100.0, doc="tension of the yarn in each leg of a held loop"
    )
    strength: StrengthParams = nested(StrengthParams, doc="what the links and pins of loopers and knives bear")

    @property
    def pin_diameter(self) -> float:
        """Diameter of the pin of coupler and rocker [m]."""
        return self.strength.pin_diameter or self.pin

    @property
    def limits(self) -> StrengthParams:
        """What links and that pin bear."""
        return replace(self.strength, pin_diameter=self.pin_diameter)


@dataclass(frozen=True, slots=True)
class KnifeParams(Params):
    """Knives of cut pile, one on each hook; links, pins and shafts are as the looper's.

    Sizes assumed by this project.
    """

    width: float = kind.length(5 * mm, at_least=0.5 * mm, at_most=50 * mm, doc="width of the edge, along the hook")
    thickness: float = kind.length(0.8 * mm, at_least=0.1 * mm, at_most=10 * mm, doc="thickness, along the shafts")
    gap: float = kind.length(0.05 * mm, at_least=0.0, at_most=1 * mm, doc="between the knife and its hook")
    overlap: float = kind.length(
        1.5 * mm, above=0.0, at_most=20 * mm, doc="edge over the hook's under edge where it is highest"
    )
    under: float = kind.length(2 * mm, above=0.0, at_most=50 * mm, doc="edge under the loops where it is lowest")
    beside: float = kind.length(
        2 * mm, at_least=0.0, at_most=20 * mm, doc="knife behind the hook's point and before its stem, at least"
    )
    distance: float = kind.length(
        110 * mm, at_least=20 * mm, at_most=1.0, doc="knife shaft before the needles' line, forward"
    )
    depth: float = kind.length(50 * mm, at_least=5 * mm, at_most=0.5, doc="knife shaft under the hook's upper edge")
    bar: float = kind.length(16 * mm, at_least=2 * mm, at_most=0.2, doc="side of the square bar that carries knives")
    force: float = kind.force(2.0, at_least=0.0, at_most=1e3, doc="force of a knife against the loop that it cuts")


@dataclass(frozen=True, slots=True)
class NeedleBarParams(Params):
    """The bar that carries the needles; sizes assumed by this project."""

    material: str = kind.choice("aluminium alloy", tuple(MATERIALS), doc="material of the needle bar")
    thickness: float = kind.length(30 * mm, at_least=5 * mm, at_most=0.3, doc="thickness of the needle bar")
    height: float = kind.length(40 * mm, at_least=5 * mm, at_most=0.3, doc="height of the needle bar")
    needle_length: float = kind.length(50 * mm, at_least=5 * mm, at_most=0.5, doc="needle out of the bar")
    rod: float = kind.length(20 * mm, at_least=3 * mm, at_most=0.2, doc="diameter of a push rod")
    joint: float = kind.length(0.5 * mm, at_least=0.0, at_most=0.1, doc="gap of its pieces, with a phase of the drives")
    bow: float = kind.length(0.1 * mm, at_least=1e-6, at_most=0.1, doc="allowed deflection of the needle bar")
    bolt: float = kind.length(
        1.5 * mm, at_least=0.1 * mm, at_most=10 * mm, doc="way of a latch into its needle, where needles are selected"
    )
    notch: float = kind.length(0.3 * mm, above=0.0, at_most=5 * mm, doc="play of a latch in the notch of its needle")
    latch_shear: float = kind.pressure(60 * MPa, at_least=0.1 * MPa, at_most=1e10, doc="allowed shear of a latch")


@dataclass(frozen=True, slots=True)
class TuftingShaftParams(Params):
    """Main and looper shaft along the width, motor and flywheel; values assumed by this project."""

    diameter: float | None = kind.length(
        None, at_least=5 * mm, at_most=0.5, doc="diameter of the main shaft; default: least of stock"
    )
    damping: float = kind.ratio(
        0.03, above=0.0, at_most=1.0, doc="damping of the first torsional mode over the critical"
    )
    twist: float = kind.ratio(
        0.25, above=0.0, at_most=1.0, doc="share of the looper's timing margin that torsion may use"
    )
    resonance: float = kind.ratio(
        5.0, at_least=1.0, at_most=1e3, doc="required ratio of the first torsional frequency to that of the shaft"
    )
    fluctuation: float = kind.ratio(0.1, above=0.0, below=2.0, doc="allowed fluctuation of the main shaft's speed")
    flywheel: float = kind.length(60 * mm, at_least=5 * mm, at_most=0.5, doc="width of the flywheel")


@dataclass(frozen=True, slots=True)
class TuftingFeedParams(Params):
    """Rollers of yarn and backing; values assumed by this project."""

    yarn_roller: float = kind.length(80 * mm, at_least=10 * mm, at_most=1.0, doc="diameter of the yarn feed rollers")
    yarn_tension: float = kind.force(0.5, at_least=0.0, at_most=100.0, doc="tension of a yarn behind the feed rollers")
    spiked_roller: float = kind.length(120 * mm, at_least=10 * mm, at_most=1.0, doc="diameter of the spiked rollers")
    backing_tension: float = kind.line_load(300.0, at_least=0.0, at_most=1e5, doc="tension of the backing over width")
    shift_acceleration: float = kind.acceleration(
        100.0, above=0.0, at_most=1e5, doc="allowed acceleration of the needle bar in its shift"
    )
    give: float = kind.length(
        2.5 * mm, at_least=0.0, at_most=50 * mm, doc="allowed travel of the backing while needles are in it: they bend"
    )


@dataclass(frozen=True, slots=True)
class TuftingMachineParams(TuftedCarpetParams):
    """A tufting machine for a carpet; the needle drives are those of the published six-bar."""

    needle: TuftingParams = nested(TuftingParams, doc="a needle drive; what follows from the machine is not set here")
    looper: LooperParams = nested(LooperParams, doc="looper, its place beside the needle, its linkage")
    knife: KnifeParams = nested(KnifeParams, doc="knives of cut pile")
    needle_bar: NeedleBarParams = nested(NeedleBarParams, doc="the bar that carries the needles")
    shafts: TuftingShaftParams = nested(TuftingShaftParams, doc="shafts along the width")
    feed: TuftingFeedParams = nested(TuftingFeedParams, doc="rollers of yarn and backing")
    prices: str | None = kind.text(None, doc="prices other than those of the table")
    cost: CostRates = nested(CostRates, doc="wage, hours, capital, assembly")
    drives: int = kind.count(10, at_least=2, at_most=64, doc="needle drives along the width")
    lift: float = kind.length(
        8 * mm, at_least=1 * mm, at_most=0.2, doc="needle's point over the backing where it is highest, at least"
    )

    def check_together(self) -> None:
        """Raise ParameterError for what follows from the machine and is given for a needle drive, and as above."""
        TuftedCarpetParams.check_together(self)
        usual = TuftingParams()
        given = [name for name in FOLLOWING if getattr(self.needle, name) != getattr(usual, name)]
        if given:
            names = " and ".join(f"needle.{name}" for name in given)
            raise ParameterError(f"{names} given", allowed="it follows from carpet and drives", do="leave it out")
