"""The return spring of a follower: no lift-off up to a speed.

The follower stays on the cam at the speed w if and only if, over the whole turn,

    m w^2 s'' + k s + P + load >= 0

The functions below solve this condition for the speed, the preload or the rate, as an exact supremum over the pieces of
the programme. Where the velocity jumps down, no spring keeps the follower on the cam. [derived: contact force >= 0]
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.contact import FollowerLoad
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.errors import ParameterError
from ilmek.num.piecewise import Extremum, infimum, supremum
from ilmek.units import format_quantity

_NOTHING = 1e-12
"""Displacement over the lift below which the spring counts as not compressed."""


@dataclass(frozen=True, slots=True)
class LiftOff:
    """Cam speed [rad/s] at which the follower lifts off (inf: never), and the cam angle [rad] of lift-off."""

    speed: float
    at: float


def lift_off(programme: CamProgramme, follower: FollowerLoad) -> LiftOff:
    """Speed [rad/s] from which the follower leaves the cam, and the cam angle [rad].

        1 / w^2 = sup( -m s'' / (k s + P + load) )

    The speed is 0 where the velocity jumps down, or where no force acts towards the cam while s'' < 0.
    The speed of `follower` is not used.
    """
    falls = velocity_drop(programme)
    if falls is not None:
        return LiftOff(0.0, falls)

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        pull, push = -follower.mass * at.dds, follower.rate * at.s + follower.preload + follower.load
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(pull <= 0, 0.0, np.where(push > 0, pull / push, np.inf))

    worst = supremum(demand, programme.knots)
    if worst.value <= 0:
        return LiftOff(math.inf, worst.at)
    return LiftOff(0.0 if math.isinf(worst.value) else 1 / math.sqrt(worst.value), worst.at)


def least_force(programme: CamProgramme, follower: FollowerLoad) -> Extremum:
    """Least force along the motion over the turn [N] and its cam angle [rad]; below 0 the follower lifts off."""

    def force(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return follower.force(at.s, at.dds)

    return infimum(force, programme.knots)


def least_preload(programme: CamProgramme, follower: FollowerLoad) -> float:
    """Least preload [N] of a spring of the given rate that keeps the follower on the cam at the speed.

    Raises ParameterError where the velocity jumps down.
    """
    _refuse_drop(programme)
    return max(0.0, -least_force(programme, replace(follower, preload=0.0)).value)


def least_rate(programme: CamProgramme, follower: FollowerLoad) -> float:
    """Least rate [N/m] of a spring of the given preload that keeps the follower on the cam at the speed.

    Raises ParameterError where the velocity jumps down, and where the preload at displacement 0 is too small.
    """
    _refuse_drop(programme)
    lift = supremum(lambda angle: programme.at(angle).s, programme.knots).value

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        lack = -replace(follower, rate=0.0).force(at.s, at.dds)
        low = at.s <= _NOTHING * lift
        slack = _NOTHING * (follower.mass * follower.speed**2 * np.abs(at.dds) + follower.preload + follower.load)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(lack <= slack, 0.0, np.where(low, np.inf, lack / at.s))

    needed = supremum(demand, programme.knots).value
    if math.isinf(needed):
        shown = format_quantity(follower.preload, "N")
        raise ParameterError(
            f"preload={shown} is too small at displacement 0: the follower lifts off there",
            do="give a larger preload, or omit it",
        )
    return needed


def doubling_spring(programme: CamProgramme, follower: FollowerLoad) -> FollowerLoad:
    """The weakest spring without lift-off at the speed whose force doubles over the lift: k = P / lift [N/m].

        P = sup( -(m w^2 s'' + load) / (1 + s / lift) )

    The factor 2 is a compromise between a long spring and a slack one.
    Raises ParameterError where the velocity jumps down.
    """
    _refuse_drop(programme)
    lift = supremum(lambda angle: programme.at(angle).s, programme.knots).value
    bare = replace(follower, rate=0.0, preload=0.0)

    def demand(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.asarray(-bare.force(at.s, at.dds) / (1 + at.s / lift))

    preload = max(0.0, supremum(demand, programme.knots).value)
    return replace(follower, preload=preload, rate=preload / lift)


def velocity_drop(programme: CamProgramme) -> float | None:
    """The cam angle [rad] where the velocity jumps down; None where it does not."""
    return next((jump.angle for jump in jumps(programme, 1) if jump.after < jump.before), None)


def _refuse_drop(programme: CamProgramme) -> None:
    at = velocity_drop(programme)
    if at is not None:
        where = format_quantity(at, "deg")
        raise ParameterError(
            f"the velocity jumps down at {where}: no spring keeps the follower on the cam",
            do="use a law that starts and ends at rest, or a grooved cam",
        )
