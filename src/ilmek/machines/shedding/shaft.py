"""The square shaft of the shedding cams: its load, its least sides, the bar taken, its bearings.

    w = safety |weight + warps e^(i angle)| / l,   span = l / spans

Weight and the pull of the warps act in their own directions; a square bar is as stiff in all directions, so that slope
and deflection of each add as vectors, and turning with the shaft changes nothing. Supports between the ends are
bearings, or steadies: rollers under the round guide cams on the side away from the warps, which take no warp's place.
Each span is reckoned as simply supported, which is on the safe side of a shaft that runs on over its supports; the
bearings bear w span, at the ends half of it, without the safety.                    [thesis 3.2, eq. 3.4, 3.5; ISO 281]
"""

import cmath
import math
from dataclasses import dataclass

from ilmek.elements import bearings, shafts
from ilmek.elements.beam import uniform
from ilmek.elements.bearing_table import INSERT, RollingBearing
from ilmek.elements.fatigue import Loading, endurance_limit, goodman
from ilmek.elements.materials import GRAVITY
from ilmek.elements.sections import square_section
from ilmek.elements.whirl import uniform_speed
from ilmek.machines.shedding.params import SheddingParams
from ilmek.units import turn


@dataclass(frozen=True, slots=True)
class ShaftLoads:
    """What weight and warps do to the shaft, each in its own direction, with the safety.

    weight, pull  loads [N/m]; the shaft's slope [rad] and deflection [m] are split as they are
    angle         of the resultant from the weight, towards the pull [rad]
    """

    weight: float
    pull: float
    angle: float

    def shares(self) -> tuple[float, float]:
        """Of the resultant's slope and deflection, what the weight alone and the warps alone would give."""
        whole = abs(self.resultant)
        return (self.weight / whole, self.pull / whole) if whole > 0 else (0.0, 0.0)

    @property
    def resultant(self) -> complex:
        """Load [N/m], the weight along the real axis."""
        return self.weight + self.pull * cmath.exp(1j * self.angle)


@dataclass(frozen=True, slots=True)
class ShaftBearings:
    """The bearings of the shaft.

    reaction     on the most loaded one [N]      journal  least diameter of the turned journal [m]
    bearing      the one taken; None: none lives that long      life  of it [s], 90 % of them reach it
    """

    reaction: float
    journal: float
    bearing: RollingBearing | None
    life: float


@dataclass(frozen=True, slots=True)
class Shaft:
    """The square shaft.

    load     along it, with its safety [N/m]        length  of all its cams, from first to last support [m]
    span     from support to support [m]            torque  largest of the warps, with the safety [N m]
    side_*   least side for a limit [m]             bar     side of the bar taken [m]
    slope, deflection, stress   of that bar         twist   of that bar from end to end, without the safety [rad]
    endurance   safety against fatigue without end, the load's own safety in it [Goodman]
    critical    lowest critical speed of a span with its cams [rad/s]
    directions  weight and warps apart; None where the load is given      seat  its bearings
    """

    load: float
    length: float
    span: float
    torque: float
    side_slope: float
    side_deflection: float
    side_twist: float
    side_strength: float
    bar: float
    slope: float
    deflection: float
    twist: float
    stress: float
    endurance: float
    critical: float
    directions: ShaftLoads | None
    seat: ShaftBearings

    @property
    def side(self) -> float:
        """Least side [m] for slope and deflection."""
        return max(self.side_slope, self.side_deflection)


def shaft_for(params: SheddingParams, mass: float, across: float, torque: float) -> Shaft:
    """The shaft under the weight of a mass [kg], the force of the warps across it [N] and their torque [N m].

    Cams are weighed with their bores filled, which is the shaft's own weight. Raises ParameterError for a bearing that
    is not in the table.
    """
    length, modulus = params.shaft_length or params.warps * params.warp_pitch, params.modulus
    load, safety, directions = params.shaft_load, params.safety or 1.0, None
    if load is None:
        safety = params.safety or 2.0
        directions = ShaftLoads(safety * mass * GRAVITY / length, safety * across / length, params.pull_angle)
        load = abs(directions.resultant) / safety
    load, span = load * safety, length / params.spans
    moment = float(uniform.moment_max(load, span))
    by_slope = shafts.square_side(shafts.inertia_for_slope(load, span, modulus, params.slope_limit))
    by_deflection = shafts.square_side(shafts.inertia_for_deflection(load, span, modulus, params.deflection_limit))
    by_twist = shafts.side_for_twist(torque, length, modulus, params.twist_limit)
    by_strength = shafts.side_for_strength(moment, safety * torque, params.strength)
    least = max(by_slope, by_deflection, by_twist, by_strength)
    bar = params.shaft_bar or _bar(least)
    while params.shaft_bar is None and _endurance(params, moment, safety * torque, bar) < 1:
        bar = _bar(bar + _STEP)
    inertia = float(uniform.square_inertia(bar))
    return Shaft(
        load=load,
        length=length,
        span=span,
        torque=safety * torque,
        side_slope=by_slope,
        side_deflection=by_deflection,
        side_twist=by_twist,
        side_strength=by_strength,
        bar=bar,
        slope=float(uniform.slope_max(load, span, modulus, inertia)),
        deflection=float(uniform.deflection_max(load, span, modulus, inertia)),
        twist=shafts.square_twist(torque, length, modulus, bar),
        stress=shafts.square_stress(moment, safety * torque, bar),
        endurance=_endurance(params, moment, safety * torque, bar),
        critical=uniform_speed(1, "hinged", span, modulus * inertia, mass / length),
        directions=directions,
        seat=seat_for(params, load / safety * span, safety * torque, bar),
    )


def _endurance(params: SheddingParams, moment: float, torque: float, bar: float) -> float:
    """Safety of the hot rolled bar against fatigue: the load stands, the bar turns; the torque goes to and fro."""
    section = square_section(bar)
    limit = endurance_limit(params.tensile, section.size, "hot-rolled")
    return goodman(Loading(moment, 0.0, torque_amplitude=torque), section, endurance=limit, tensile=params.tensile)


def seat_for(params: SheddingParams, span_load: float, torque: float, bar: float) -> ShaftBearings:
    """Bearings for the load of a span [N], on journals turned from the bar [m] that bear the torque [N m].

    A journal in torsion alone: d = (16 sqrt(3) T / (pi sigma))^(1/3), von Mises. With supports between the ends one of
    those bears a whole span, an end half of one; a steady's bearing is no larger than the ends' here.
    """
    reaction = span_load if params.spans > 1 else span_load / 2
    journal = float((16 * math.sqrt(3) * torque / (math.pi * params.strength)) ** (1 / 3))
    revolutions = params.bearing_life * params.speed / turn
    if params.bearing is None:
        bearing = bearings.smallest_bearing(reaction, revolutions, kind=INSERT, bore=journal)
        bearing = bearing if bearing is not None and bearing.bore <= bar else None
    else:
        bearing = bearings.find_bearing(params.bearing)
    if bearing is None:
        return ShaftBearings(reaction, journal, None, 0.0)
    lives = bearings.life(bearing.dynamic, bearings.equivalent_load(bearing, reaction), bearing.kind)
    return ShaftBearings(reaction, journal, bearing, lives * turn / params.speed)


_STEP = 1e-3
"""Less than from one stock bar to the next [m]."""


def _bar(least: float) -> float:
    """The smallest stock bar; beyond the dealers' largest one made to measure, in whole centimetres [m]."""
    return shafts.stock_side(least) or math.ceil(least * 100) / 100
