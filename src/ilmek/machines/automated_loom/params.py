"""Parameters of an automated loom for one carpet. Everything else is derived from them."""

from dataclasses import dataclass, replace

from ilmek.cams.laws import SMOOTH_LAWS
from ilmek.carpet.design import knot_grid
from ilmek.carpet.ground import SELVEDGE_WARPS, WEFT_TURN, GroundParams
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import COARSEST, FINEST, Quality
from ilmek.carpet.sizes import LARGEST, SMALLEST, CarpetSize
from ilmek.carpet.usual_pile import usual_linear_density, usual_pile_height
from ilmek.carpet.washing import WashParams
from ilmek.elements.carpet_yarns import CRIMP, CarpetYarnParams
from ilmek.elements.knot_kinds import WRAPS
from ilmek.errors import LoomError
from ilmek.machines import BEATS, WEFT_CARRIERS, loom_machines
from ilmek.machines.automated_loom.cost_rates import CostRates
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.weaver_hands import HAND, WeaverHands
from ilmek.params import Overrides, Params, kind, nested, overrides, param
from ilmek.units import cm, deg, dm, format_number, format_quantity, mm, rpm, turn
from ilmek.weaving.cloth import Cloth, warp_pitch_of, warp_tension_of
from ilmek.weaving.warping import Warping, WarpingParams

QUALITY = 25 / dm
"""Knots per metre where neither density nor pitch is given: the thesis' loom."""


AUTO = "auto"
"""The choice of what is left open."""

LEAST_TUBES = 4
"""Of a head; assumed by this project."""

PRICE, TIME, COST = AIMS = ("price", "time", "cost")
"""What the choice of a loom makes least."""

CAM_SPEED = 5 * rpm
"""Speed of the shedding cams at most, where none is required. [thesis, 3.3]"""

WIDEST = 12.0
"""The widest loom [m]."""


@dataclass(frozen=True, slots=True)
class AutomatedLoomParams(Params):
    """The carpet, the heads, and the limits of what moves; the defaults are the thesis' loom with four heads."""

    aim: str = param(COST, choices=AIMS, doc="what is least in the choice of all that is left open")
    width: float = kind.length(
        1.2, unit="m", at_least=SMALLEST, at_most=LARGEST, doc="width of the knots of the finished carpet"
    )
    length: float = kind.length(
        1.8, unit="m", at_least=SMALLEST, at_most=LARGEST, doc="length of the finished carpet, shorn and washed"
    )
    knots_across: float | None = kind.knot_density(
        None, at_least=COARSEST, at_most=FINEST, doc="knots along a row; default: what the warp pitch gives"
    )
    knots_along: float | None = kind.knot_density(
        None, at_least=COARSEST, at_most=FINEST, doc="rows along the finished carpet; default: as across"
    )
    warp_pitch: float | None = warp_pitch_of(None, "distance of two warps on the loom; default: two warps a knot")
    knot: str = param("symmetric", choices=tuple(WRAPS), doc="kind of knot")
    selvedge_warps: int = param(SELVEDGE_WARPS, at_least=0, at_most=200, doc="warps without knots, both edges together")
    yarns: CarpetYarnParams = nested(CarpetYarnParams, doc="materials and counts of warp, wefts and pile")
    heads: int | None = param(
        None, at_least=1, at_most=1000, doc="knotting heads that share a row; default: chosen by aim and deadline"
    )
    deadline: float | None = kind.time(
        None, unit="h", at_least=1.0, at_most=1e9, doc="time in which the carpet is to be woven; default: any"
    )
    price_limit: float | None = param(None, at_least=0.0, at_most=1e12, doc="price of the loom at most; default: any")
    weavers: int | None = param(
        None, at_least=1, at_most=100, doc="weavers who tie beside each other, knotting=hand; default: all that fit"
    )
    head_width: float | None = kind.length(
        None, at_least=0.01, at_most=1.0, doc="width of a head, least distance of two; default: what its contents need"
    )
    colours: int = param(16, at_least=1, at_most=255, doc="yarns of the carpet")
    tubes: int | None = param(
        None, at_least=1, at_most=255, doc="yarn tubes of a head; default: one for each of the colours, 4 at least"
    )
    package_mass: float = kind.mass(
        1.0, at_least=1e-3, at_most=100.0, doc="pile yarn of a full package, one for each tube: a cone of the trade"
    )
    tube_change: float = kind.time(
        60.0,
        at_least=0.0,
        at_most=3600.0,
        doc="time in which an operator changes a package and ties its yarn to the old one; assumed by this project",
    )
    knotting: str = param(
        AUTO,
        choices=(AUTO, HAND, "cams", "arms"),
        doc="what ties the knots: weavers by hand, cams and grippers, or arms; auto: cams or arms, by aim",
    )
    knot_cycle: float | None = kind.time(
        None, at_least=1e-3, at_most=3600.0, doc="required time of a knot; default: 2 s, or less by aim"
    )
    knot_yarn: float | None = kind.length(
        None, above=0.0, at_most=0.3, doc="pile yarn of a knot, from the yarn bill; default: by knot, quality and pile"
    )
    pile_height: float | None = kind.length(
        None,
        at_least=0.0,
        at_most=100 * mm,
        doc="pile above the knots, shorn: thickness of the wound carpet; default: by the quality, 10 mm at 25x25/dm",
    )
    knot_law: str = param("modified-sine", choices=SMOOTH_LAWS, doc="law of the heads' cams")
    head_acceleration: float = kind.acceleration(
        20.0, at_least=1e-3, at_most=1e5, doc="allowed acceleration of a head's tools"
    )
    carriage_speed: float = kind.speed(0.25, at_least=1e-3, at_most=100.0, doc="speed of a head along the row")
    changes_per_knot: float = param(
        0.06, at_least=0.0, at_most=1.0, doc="colour changes a knot, to estimate the time before there is a chart"
    )
    knotted_share: float = kind.ratio(
        1.0, above=0.0, at_most=1.0, doc="share of the chart's cells that are knots; 1 without shape and flat weave"
    )
    tension: float | None = warp_tension_of(None)
    clearance: float = kind.length(
        2 * mm, at_least=0.0, at_most=0.1, doc="least distance of what moves from all that it must not touch"
    )
    margin: float = kind.length(50 * mm, at_least=0.0, at_most=1.0, doc="from the carpet's edge to a bearing")
    lift: float = kind.length(60 * mm, at_least=1 * mm, at_most=0.5, doc="lift of the warps for the shed")
    shed_speed: float | None = kind.angular_speed(
        None,
        at_least=0.01 * rpm,
        at_most=60 * rpm,
        doc="required speed of the cams; default: 5 rpm, or less where weft, beat or the heads' retreat need it",
    )
    shaft_span: float = kind.length(
        1.5, unit="m", at_least=0.1, at_most=20.0, doc="largest span of the cam shaft between its supports"
    )
    open_share: float = kind.ratio(
        0.9, at_least=0.05, at_most=1.0, doc="opening of the shed at the cams, over the lift, at which a weft may pass"
    )
    weft: str = param(
        AUTO,
        choices=(AUTO, *WEFT_CARRIERS, HAND),
        doc="what lays the weft: shuttles or a rapier; hand: its bobbin by hand (hand loom); auto: chosen by aim",
    )
    shed: str = param(
        "cams", choices=("cams", HAND), doc="what opens the shed: cams, or rod and string heddles by hand (hand loom)"
    )
    beat: str = param(
        AUTO,
        choices=(AUTO, *BEATS, HAND),
        doc="what beats the rows: a travelling beater, a comb on crank-rockers, on its own axes or on the guide cams; "
        "hand: a comb by hand (hand loom); auto: chosen by aim",
    )
    row_tolerance: float = kind.ratio(
        0.02, unit="%", at_least=0.0, at_most=0.5, doc="share by which rows may be left farther apart than required"
    )
    comb_acceleration: float = kind.acceleration(
        3.0, at_least=1e-3, at_most=1e3, doc="allowed acceleration of the comb, cams and all"
    )
    beat_speed: float = kind.angular_speed(
        15.5, unit="rad/s", at_least=0.1, at_most=1e3, doc="speed of the beat-up's crank"
    )
    shed_stop: float = kind.time(
        0.3,
        at_least=0.0,
        at_most=60.0,
        doc="time in which the shedding cams stop and start where they stand for a beat",
    )
    beat_end: float = kind.angle(158 * deg, above=0.0, below=turn / 2, doc="cam angle at which the beater is back")
    take_up_end: float = kind.angle(
        178 * deg, above=0.0, at_most=turn / 2, doc="cam angle, after half a turn, at which the take-up ends"
    )
    head_mass: float | None = kind.mass(
        None, at_least=0.1, at_most=500.0, doc="mass of a head on its carriage; default: as designed"
    )
    tube_mass: float = kind.mass(
        0.02, at_least=0.0, at_most=10.0, doc="mass of a yarn tube with its share of the slide"
    )
    rail_span: float = kind.length(
        2.0, unit="m", at_least=0.1, at_most=20.0, doc="largest span of the heads' rail between columns and posts"
    )
    rail_sag: float = kind.length(0.2 * mm, at_least=1e-6, at_most=0.05, doc="allowed sag of the heads' rail")
    column_safety: float = kind.ratio(
        2.0, at_least=1.0, at_most=20.0, doc="yield over the stress of a frame's column at least"
    )
    buckling_safety: float = kind.ratio(
        4.0, at_least=1.0, at_most=50.0, doc="Euler's load over the force of a frame's column at least"
    )
    column_bow: float = kind.length(
        1 * mm, at_least=1e-6, at_most=0.1, doc="allowed bow of a frame's column; as the thesis allows the cylinders"
    )
    retreat_speed: float = kind.speed(
        0.35, at_least=1e-3, at_most=10.0, doc="allowed speed of the heads' rail from and to the warps"
    )
    retreat_acceleration: float = kind.acceleration(
        2.0, at_least=1e-3, at_most=100.0, doc="allowed acceleration of the heads' rail from and to the warps"
    )
    hands: WeaverHands = nested(WeaverHands, doc="forces, speeds and times of a weaver's hands, where they work")
    drive_efficiency: float = param(0.7, at_least=0.01, at_most=1.0, doc="efficiency from the mains to a shaft")
    standby_power: float = kind.power(10.0, at_least=0.0, at_most=1e4, doc="power of an axis that stands still")
    cost: CostRates = nested(CostRates, doc="rates from which the cost of a carpet follows")
    finish: WashParams = nested(WashParams, doc="washing of the carpet")
    warping: WarpingParams = nested(WarpingParams, doc="warping frame, and dressing of the loom")
    prices: str | None = param(
        None, doc="prices other than those of the table: `bearing each = 9; servo per W = 1`, or @FILE with such lines"
    )

    machines: Overrides = overrides(
        lambda: {name: MACHINES[name].params for name in loom_machines()},
        without=("cloth", "hands"),
        doc="parameters of the machines in the loom, shedding.law, in place of those that the loom derives",
    )

    @property
    def quality(self) -> Quality:
        """The finished carpet's quality; by default knots across follow the warp pitch, rows follow knots across."""
        across = self.knots_across or self._knots_of_pitch
        return Quality(across, self.knots_along or across)

    @property
    def cam_speed(self) -> float:
        """Speed of the shedding cams at most [rad/s]."""
        return self.shed_speed or CAM_SPEED

    @property
    def knot_grid(self) -> tuple[int, int]:
        """Rows of knots, and knots of a row. Raises CarpetError for too few or too many."""
        return knot_grid(CarpetSize(self.width, self.length), self.quality)

    @property
    def cloth(self) -> Cloth:
        """The cloth that is woven: two warps for each knot of a row, and the selvedges'; the pile as of the knots.

        Raises CarpetError for too few or too many knots.
        """
        pile = self.yarns.pile_density or usual_linear_density(self.quality, self.knot)
        return Cloth(
            warp_pitch=self._pitch,
            warps=2 * self.knot_grid[1] + self.selvedge_warps,
            row_pitch=self.ground.lengthening / self.quality.along,
            tension=self.tension,
            yarns=replace(self.yarns, pile_density=pile),
        )

    @property
    def woven_size(self) -> tuple[float, float]:
        """Width and length of the carpet on the loom [m]."""
        return self.width * self.finish.widening, self.length * self.ground.lengthening

    @property
    def _pitch(self) -> float:
        """Warp pitch [m]: as given, or two warps for each knot."""
        return self.warp_pitch or 0.5 / (self.knots_across or QUALITY) * self.finish.widening

    @property
    def _knots_of_pitch(self) -> float:
        """Knots across the finished carpet that the warp pitch gives [1/m]."""
        return 0.5 / self._pitch * self.finish.widening

    @property
    def pile(self) -> PileParams:
        """The pile: its height as given, or the usual one of the quality."""
        height = usual_pile_height(self.quality) if self.pile_height is None else self.pile_height
        return PileParams(pile_height=height)

    @property
    def knots(self) -> int:
        """Knots of the carpet."""
        rows, columns = self.knot_grid
        return round(rows * columns * self.knotted_share)

    @property
    def head_tubes(self) -> int:
        """Tubes of a head: as given, or one for each colour; a drum of fewer than four is too small for a stepper."""
        return self.tubes or max(self.colours, LEAST_TUBES)

    @property
    def billed(self) -> float:
        """Pile yarn of a knot [m]: as given, or by knot, quality and pile."""
        pile = self.cloth.carpet_yarns.pile
        return self.knot_yarn or knot_length(self.knot, self.quality, pile.linear_density, self.pile)

    @property
    def ground(self) -> GroundParams:
        """Warp and wefts of the carpet for its yarn bill: those of the loom."""
        turn = self.machines.of("weft").get("turn", WEFT_TURN)
        crimp = self.machines.of("warp-tension").get("crimp", CRIMP)
        return GroundParams(
            crimp=float(str(crimp)),
            selvedge_warps=self.selvedge_warps,
            weft_turn=float(str(turn)),
            warp_strain=Cloth(warp_pitch=self._pitch, tension=self.tension, yarns=self.yarns).warp_strain,
            yarns=self.yarns,
            washing=self.finish,
        )

    @property
    def dressing(self) -> Warping:
        """The warps to be wound and drawn in."""
        return Warping(self.warping, self.cloth, self.knot_grid[1], self.ground.warp_length(self.length))

    @property
    def hand_knot(self) -> float:
        """Time of a knot that a weaver ties [s], by the knots of her day."""
        return self.cost.weaver_day / self.cost.weaver_knots

    def check_together(self) -> None:
        """Raise LoomError where the warp pitch does not give the knots across, for a carpet that is too large on the
        loom, and for heads where weavers tie.
        """
        self._check_knotting()
        self._check_hands()
        self._check_size()
        gives = self._knots_of_pitch
        if abs(self.quality.across / gives - 1) > _SAME:
            wanted, pitch = self.quality.across, format_quantity(self._pitch, "mm")
            needed = format_quantity(0.5 / wanted, "mm")
            finer = wanted > gives
            allowed = f"{_per_dm(gives)} knots/dm is {'all' if finer else 'what'} that {pitch} pitch gives"
            do = f"{_per_dm(wanted)}/dm needs {needed}: set warp_pitch so, or leave it out"
            raise LoomError(f"{_per_dm(wanted)} knots/dm on a warp pitch of {pitch}", allowed=allowed, do=do)

    def _check_size(self) -> None:
        """Raise LoomError for a carpet that is wider on the loom than any loom."""
        if self.woven_size[0] > WIDEST:
            finished = CarpetSize(self.width, self.length)
            woven = " × ".join(format_number(side / cm) for side in self.woven_size)
            allowed, do = f"at most {format_quantity(WIDEST, 'm')} wide on the loom", "set a narrower carpet"
            raise LoomError(f"a carpet of {finished} is {woven} cm on the loom", allowed=allowed, do=do)

    def _check_knotting(self) -> None:
        """Raise LoomError for what only heads have where weavers tie, and for weavers where heads do."""
        machines = (name for name in ("weaver", "knotting-dyad") if self.machines.of(name))
        set_for_heads = [name for name in _OF_HEADS if getattr(self, name) is not None]
        if self.knotting == HAND and (contrary := [*set_for_heads, *machines]):
            given, do = ", ".join(contrary), "leave them out, or set knotting=cams or arms"
            raise LoomError(f"{given} with knotting=hand", allowed="a loom without heads has weavers=", do=do)
        if self.knotting != HAND and self.weavers is not None:
            raise LoomError(f"weavers={self.weavers} with knotting={self.knotting}", do="set knotting=hand, or heads=")

    def _check_hands(self) -> None:
        """Raise LoomError where something is by hand that no loom has so beside what is driven."""
        by_hand = self.shed == HAND
        wanted = {"knotting": (HAND,), "beat": BEATS_BY_HAND, "weft": (AUTO, HAND)} if by_hand else {}
        driven = {"beat": (AUTO, *BEATS), "weft": (AUTO, *WEFT_CARRIERS)}
        for name, kinds in (wanted or driven).items():
            given = getattr(self, name)
            if given not in kinds:
                allowed = f"where the shed is {'opened by hand' if by_hand else 'driven'}: {' or '.join(kinds)}"
                do = f"set {name}={kinds[0]}, or shed={'cams' if by_hand else HAND}"
                raise LoomError(f"{name}={given} with shed={self.shed}", allowed=allowed, do=do)


BEATS_BY_HAND = (HAND, "travelling", "comb")
"""Kinds of beat where weavers open the shed: their comb, the paper's crank-rocker, or a comb on its own axes, all below
rod and levers. A comb on crank-rockers would rest over the hands that tie; guide cams are those of the shed.
"""

_OF_HEADS = ("heads", "head_width", "head_mass", "tubes", "knot_cycle")
"""Parameters that only a loom with heads has; all are open by default."""


_SAME = 5e-3
"""A pitch within half a percent is the quality's: dealers allow ten."""


def _per_dm(density: float) -> str:
    return f"{density * dm:.4g}"
