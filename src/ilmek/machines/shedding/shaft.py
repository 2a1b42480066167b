"""The square shaft of the shedding cams: its load, its least sides, the bar taken.

    w = safety sqrt(weight^2 + warps^2) / l,   span = l / spans

Supports between the ends are bearings, or steadies: rollers under the round guide cams on the side away from the warps,
which take no warp's place. Each span is reckoned as simply supported, which is on the safe side of a shaft that runs
on over its supports.                                                                [thesis 3.2, eq. 3.4, 3.5]
"""

import math
from dataclasses import dataclass

from ilmek.elements import beams, shafts
from ilmek.elements.materials import GRAVITY
from ilmek.machines.shedding.params import SheddingParams


@dataclass(frozen=True, slots=True)
class Shaft:
    """The square shaft.

    load     along it, with its safety [N/m]        length  of all its cams, from first to last support [m]
    span     from support to support [m]            torque  largest of the warps, with the safety [N m]
    side_*   least side for a limit [m]             bar     side of the bar taken [m]
    slope, deflection, stress   of that bar         twist   of that bar from end to end, without the safety [rad]
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

    @property
    def side(self) -> float:
        """Least side [m] for slope and deflection."""
        return max(self.side_slope, self.side_deflection)


def shaft_for(params: SheddingParams, mass: float, across: float, torque: float) -> Shaft:
    """The shaft under the weight of a mass [kg], the force of the warps across it [N] and their torque [N m].

    Cams are weighed with their bores filled, which is the shaft's own weight.
    """
    length, modulus = params.shaft_length or params.warps * params.warp_pitch, params.modulus
    load, safety = params.shaft_load, params.safety or 1.0
    if load is None:
        load, safety = math.hypot(mass * GRAVITY, across) / length, params.safety or 2.0
    load, span = load * safety, length / params.spans
    moment = float(beams.moment_max(load, span))
    by_slope = shafts.square_side(shafts.inertia_for_slope(load, span, modulus, params.slope_limit))
    by_deflection = shafts.square_side(shafts.inertia_for_deflection(load, span, modulus, params.deflection_limit))
    by_twist = shafts.side_for_twist(torque, length, modulus, params.twist_limit)
    by_strength = shafts.side_for_strength(moment, safety * torque, params.strength)
    bar = params.shaft_bar or _bar(max(by_slope, by_deflection, by_twist, by_strength))
    inertia = beams.square_inertia(bar)
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
        slope=float(beams.slope_max(load, span, modulus, inertia)),
        deflection=float(beams.deflection_max(load, span, modulus, inertia)),
        twist=shafts.square_twist(torque, length, modulus, bar),
        stress=shafts.square_stress(moment, safety * torque, bar),
    )


def _bar(least: float) -> float:
    """The smallest stock bar; beyond the dealers' largest one made to measure, in whole centimetres [m]."""
    return shafts.stock_side(least) or math.ceil(least * 100) / 100
