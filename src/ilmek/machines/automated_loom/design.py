"""The automated loom for one carpet: its machines, sized by the carpet and timed together."""

import math
from dataclasses import dataclass, replace

from ilmek.carpet.design import knot_grid
from ilmek.carpet.sizes import CarpetSize
from ilmek.elements.tubes import find_tube
from ilmek.errors import LoomError
from ilmek.loom.programme import Times, least_time
from ilmek.loom.sharing import heads_that_fit, least_distance, share
from ilmek.machines import beat_up, hammer, shedding, warp_tension, weaver
from ilmek.machines.automated_loom.beating import (
    Beat,
    BeatResult,
    beat_of_comb,
    beat_of_linkage,
    hammer_for,
    left_by,
    stiffness_of_warp,
)
from ilmek.machines.automated_loom.cyclogram import RowTiming, cyclogram, knot_cyclogram, shortest_row, take_up_time
from ilmek.machines.automated_loom.params import AutomatedLoomParams
from ilmek.machines.warp_tension.design import WarpTensionDesign, keeps_limits
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import format_quantity, mm, turn
from ilmek.weaving.tension import usual_tension

USUAL_HEADS = 4
"""Heads of a loom for which no number is given, where so many fit."""

STOCK_TUBES = (
    *((tube.outer, tube.wall) for tube in map(find_tube, ("140x5", "139.7x10", "168.3x6.3", "168.3x10", "193.7x8"))),
    *((tube.outer, tube.wall) for tube in map(find_tube, ("219.1x8", "219.1x12.5", "244.5x10", "273x10", "273x16"))),
    *((tube.outer, tube.wall) for tube in map(find_tube, ("323.9x12.5", "355.6x16", "406.4x16", "457x20"))),
    (508 * mm, 25 * mm),
    (610 * mm, 30 * mm),
    (711 * mm, 40 * mm),
)
"""Outer diameter and wall of tubes to choose from [m]: the thesis' 140 x 5 and others of `elements.tubes`, and three
large ones of EN 10210-2 for the widest looms."""


@dataclass(frozen=True, slots=True)
class LoomDesign:
    """A loom for one carpet.

    rows, columns   of knots            warps  two for each knot of a row
    heads           that share a row          heads_max  the most that can share a row without meeting
    row_timing, row_cyclogram           of the wefts and beats of a row, one turn of the shedding cams
    beat_up         one of `beaters` like crank-rockers on one crank shaft, which drive one comb across all warps
    hammer          the comb on the guide cams; the loom has the one or the other, None is what it does not have
    tube            outer diameter and wall of the warp cylinder [m]
    times           what the acts of weaving take, as the programme counts them
    """

    params: AutomatedLoomParams
    rows: int
    columns: int
    heads: int
    heads_max: int
    weaver: weaver.Weaver
    shedding: shedding.SheddingDesign
    beat_up: beat_up.BeatUp | None
    hammer: hammer.Hammer | None
    warp_tension: WarpTensionDesign
    tube: tuple[float, float]
    row_timing: RowTiming
    row_cyclogram: Cyclogram
    times: Times

    @property
    def warps(self) -> int:
        """Warps: two for each knot of a row."""
        return 2 * self.columns

    @property
    def knot_pitch(self) -> float:
        """Distance of two neighbouring knots [m]."""
        return 2 * self.params.pitch

    @property
    def head_mass(self) -> float:
        """Mass of a head on its carriage, with tubes and motors [kg]: as given, or as designed."""
        return self.params.head_mass or sum(weaver.mass_of(self.weaver).values())

    @property
    def beaters(self) -> int:
        """Crank-rockers that drive the beater; 0 where the comb on the guide cams beats."""
        return beaters(self.params) if self.beat_up is not None else 0

    @property
    def beat_force(self) -> float:
        """Greatest force of the beat on the whole width [N]."""
        if self.beat_up is not None:
            return self.beaters * self.beat_up.peaks["beater_force"].value
        return self.warps * self.hammer.force if self.hammer is not None else 0.0

    @property
    def left(self) -> BeatResult:
        """Where the beat leaves the rows."""
        return left_by(self.params, self.warps, warp_tension_of(self.params), self.beat_force / self.warps)

    @property
    def head_distance(self) -> float:
        """The least distance that two heads ever have [m]; inf for one head."""
        return least_distance(share(self.columns, self.heads), self.heads, self.knot_pitch)

    @property
    def cyclograms(self) -> tuple[Cyclogram, Cyclogram]:
        """The cyclograms of a knot and of a row."""
        return knot_cyclogram(self.weaver, self.times.knot), self.row_cyclogram


def times_at(head: weaver.Weaver, knot_pitch: float, weft: float) -> Times:
    """What the acts of weaving take [s] with a head at a pitch of the knots [m], and wefts and beats of a row [s].

    A step to the next knot that is longer than the head leaves for it lengthens the knot.
    """
    moved = replace(head.params, knot_pitch=knot_pitch)
    late = max(0.0, weaver.step_time(moved) - head.carriage_window)
    travel = weaver.travel_time(moved, head.carriage_window)
    return Times(head.cycle + late, head.colour_change, travel, weft)


def design(params: AutomatedLoomParams) -> LoomDesign:
    """The loom for a carpet.

    Raises LoomError where the heads do not fit, no stock tube carries the warps, or the shed leaves no time for shuttle
    and beat; CarpetError for a carpet without knots; the errors of the machines where those cannot be.
    """
    quality = params.quality
    rows, columns = knot_grid(CarpetSize(params.width, params.length), quality)
    most = heads_that_fit(columns, 2 * params.pitch, params.head_width)
    heads = _heads(params, most)
    head = weaver.design(_weaver_params(params))
    linkage = beat_up.design(_beat_up_params(params)) if params.hammer == "linkage" else None
    beat = beat_of_comb(params) if linkage is None else beat_of_linkage(params, linkage)
    cams = _shedding(params, 2 * columns)
    timing = _row_timing(params, cams, beat, 1 / quality.along)
    period = _row_period(params, timing)
    if period > turn / params.shed_speed:
        cams = shedding.design(replace(cams.params, speed=turn / period))
    times = times_at(head, 2 * params.pitch, period)
    tube, cylinder = _cylinder(params, 2 * columns, take_up_time(timing, period), least_time(1, columns, heads, times))
    row = cyclogram(timing, period)
    warps, stack = 2 * columns, cams.stack.mass
    tension = warp_tension_of(params)
    comb = None if linkage else hammer_for(params, warps, tension, stack=stack, period=row.period, beat=beat)
    return LoomDesign(params, rows, columns, heads, most, head, cams, linkage, comb, cylinder, tube, timing, row, times)


def frame_width(params: AutomatedLoomParams) -> float:
    """Distance of the bearings of cylinders and cam shaft [m]."""
    return params.width + 2 * params.margin


def beaters(params: AutomatedLoomParams) -> int:
    """Crank-rockers that drive the beater, for none to have more than its width of it.

    The paper's beat-up rides along the carpet on a slide, and its beater's width is not printed; here one comb strikes
    the whole width at once [thesis 3.3], and its mass and force are shared by crank-rockers on one crank shaft.
    """
    return math.ceil(params.width / params.beater_width - 1e-9)


def warp_tension_of(params: AutomatedLoomParams) -> float:
    """Tension of a warp [N]: as given, or the thesis' for the warp's mass."""
    return params.tension or usual_tension(params.pitch)


def _heads(params: AutomatedLoomParams, most: int) -> int:
    """The number of heads: as asked for, or the usual, if so many fit."""
    if params.heads is not None and params.heads > most:
        width, head = format_quantity(params.width, "m"), format_quantity(params.head_width, "mm")
        raise LoomError(
            f"{params.heads} heads of {head} do not fit a carpet {width} wide",
            allowed=f"at most {most}: neighbours keep half a head's share of the row between them",
            do=f"set heads={most}, or narrower heads",
        )
    return params.heads or min(USUAL_HEADS, most)


def _weaver_params(params: AutomatedLoomParams) -> weaver.WeaverParams:
    return weaver.WeaverParams(
        cycle=params.knot_cycle,
        law=params.knot_law,
        knot_yarn=params.knot_yarn,
        acceleration_limit=params.head_acceleration,
        head_width=params.head_width,
        knot_pitch=2 * params.pitch,
        row_pitch=1 / params.quality.along,
        carriage_speed=params.carriage_speed,
        tubes=params.colours,
        tube_mass=params.tube_mass,
    )


def _beat_up_params(params: AutomatedLoomParams) -> beat_up.BeatUpParams:
    share_of_width = params.width / beaters(params)
    return beat_up.BeatUpParams(
        speed=params.beat_speed,
        beater_mass=params.beater_density * share_of_width,
        beat_force=params.beat_force * share_of_width,
    )


def _shedding(params: AutomatedLoomParams, warps: int) -> shedding.SheddingDesign:
    """The cams, with a prime circle that leaves room for the shaft's bore: a larger cam is heavier, so by turns."""
    asked = shedding.SheddingParams(
        lift=params.lift,
        warps=warps,
        warp_pitch=params.pitch,
        tension=warp_tension_of(params),
        half_span=params.half_span,
        warp_stiffness=stiffness_of_warp(params),
        warp_length=max(params.warp_length, 2 * params.half_span),
        shuttle_height=params.shuttle_height,
        speed=params.shed_speed,
        shaft_length=frame_width(params),
        spans=math.ceil(frame_width(params) / params.shaft_span - 1e-9),
    )
    made = shedding.design(asked)
    for _ in range(_TURNS):
        least = made.prime_radius_for_bore
        if made.cam.prime_radius >= least or least > _LARGEST_PRIME:
            break
        made = shedding.design(replace(asked, prime_radius=math.ceil(least / mm) * mm))
    return made


_TURNS = 20
_LARGEST_PRIME = 1.0


def _row_timing(params: AutomatedLoomParams, cams: shedding.SheddingDesign, beat: Beat, row_pitch: float) -> RowTiming:
    return RowTiming(
        lift=params.lift,
        law=cams.params.law,
        window=cams.shuttle_window,
        shuttle_stroke=params.width + 2 * params.shuttle_run,
        beat=beat,
        beat_end=params.beat_end,
        row_pitch=row_pitch,
        take_up_end=params.take_up_end,
    )


def _row_period(params: AutomatedLoomParams, timing: RowTiming) -> float:
    """Time of a turn of the shedding cams [s]: as asked for, or the shortest that shuttle and beat allow."""
    shed, window = format_quantity(params.lift, "mm"), timing.window
    if window[1] - window[0] < 1e-6:
        raise LoomError(
            f"a shed of {shed} has no room for a shuttle of {format_quantity(params.shuttle_height, 'mm')}",
            allowed="the lift must exceed the shuttle's height",
            do="set a larger lift or a lower shuttle_height",
        )
    shortest = shortest_row(timing, params.shuttle_speed, params.shuttle_acceleration)
    if not math.isfinite(shortest):
        raise LoomError(
            f"the beater is to be back at {format_quantity(params.beat_end, 'deg')}",
            allowed=f"the shed is free of the shuttle from {format_quantity(window[1], 'deg')} on",
            do="set a later beat_end, or a higher shuttle_height for a shorter passage",
        )
    if params.take_up_end <= params.beat_end:
        raise LoomError("the take-up ends before the beat", do="set take_up_end after beat_end")
    return max(turn / params.shed_speed, shortest)


def _cylinder(
    params: AutomatedLoomParams, warps: int, take_up: float, row_time: float
) -> tuple[tuple[float, float], WarpTensionDesign]:
    """The lightest stock tube that keeps slope and deflection under the warps and itself, and the cylinder of it."""
    asked = warp_tension.WarpTensionParams(
        warps=warps,
        tension=warp_tension_of(params),
        width=frame_width(params),
        row_pitch=1 / params.quality.along,
        take_up_time=take_up,
        row_time=row_time,
        carpet_length=params.length,
        warp_pitch=params.pitch,
        free_length=params.warp_length,
        warp_stiffness=stiffness_of_warp(params),
        shed_lift=params.lift,
        shed_span=params.half_span,
    )
    for diameter, wall in sorted(STOCK_TUBES, key=lambda tube: tube[1] * (tube[0] - tube[1])):
        outer, inner = diameter / 2, diameter / 2 - wall
        if keeps_limits(asked, inner, outer):
            return (diameter, wall), warp_tension.design(replace(asked, outer_radius=outer, inner_radius=inner))
    load = warps * asked.tension / asked.width
    pull, across = format_quantity(load, "kN/m"), format_quantity(asked.width, "m")
    raise LoomError(
        f"no stock tube carries {pull} of warps over {across}",
        allowed=f"slope {asked.slope_limit:g} rad, deflection {format_quantity(asked.deflection_limit, 'mm')}",
        do="set a lower tension or a narrower carpet",
    )
