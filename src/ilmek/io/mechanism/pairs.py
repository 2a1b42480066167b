"""Higher pairs of a mechanism file: the lift of a cam by motion laws or by a table, a Geneva wheel."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from ilmek.arrays import FloatArray, RealField
from ilmek.cams.programme import CamProgramme, FollowerMotion, dwell, rise
from ilmek.errors import MechanismError, ParameterError
from ilmek.io.mechanism.motions import MotionStep, steps_of
from ilmek.io.mechanism.names import value_of
from ilmek.io.schema import Table
from ilmek.linkage.couplings import TransferLaw
from ilmek.linkage.geneva import Geneva
from ilmek.units import turn

_FULL = 1e-9


class _Lift:
    """What every lift of a cam is; `groove`  whether the cam also pulls."""

    __slots__ = ()
    groove: bool

    @property
    def turns(self) -> int:
        """1: the follower returns in every turn."""
        return 1

    @property
    def one_sided(self) -> bool:
        """Whether the cam can only press."""
        return not self.groove


@dataclass(frozen=True, slots=True)
class CamLift(_Lift):
    """The lift of a follower over the cam's angle from `first_at` on, by steps with motion laws that fill one turn.

    slides  whether it is a displacement [m], not an angle [rad]      groove  whether the cam also pulls
    """

    steps: tuple[MotionStep, ...]
    slides: bool
    groove: bool = False

    def motion(self, angle: RealField) -> FollowerMotion:
        """Lift and its first three derivatives at angles [rad]."""
        return programme_of(self.steps).motion(np.asarray(angle, dtype=float))


@lru_cache(maxsize=16)
def programme_of(steps: tuple[MotionStep, ...]) -> CamProgramme:
    """The programme of a cam's steps. Raises ParameterError if they do not fill a turn, or its velocity jumps."""
    levels = itertools.pairwise((0.0, *(step.to for step in steps)))
    segments = (
        rise(step.time, to - level, step.law) if to != level else dwell(step.time)
        for step, (level, to) in zip(steps, levels, strict=True)
    )
    return CamProgramme(tuple(segments)).require_continuity(1)


@dataclass(frozen=True, slots=True)
class LiftTable(_Lift):
    """The same by a cubic spline through lifts at ascending angles [rad] of one turn, periodic."""

    angles: tuple[float, ...]
    lifts: tuple[float, ...]
    slides: bool
    groove: bool = False

    def motion(self, angle: RealField) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Lift and its first three derivatives at angles [rad]."""
        spline = _spline(self.angles, self.lifts)
        at = np.asarray(angle, dtype=float) % turn
        return spline(at), spline(at, 1), spline(at, 2), spline(at, 3)


@lru_cache(maxsize=16)
def _spline(angles: tuple[float, ...], lifts: tuple[float, ...]) -> Callable[..., FloatArray]:
    spline: Callable[..., FloatArray] = scipy.interpolate.CubicSpline(angles, lifts, bc_type="periodic")
    return spline


def law_of_pair(kind: str, table: Table, *, slides: bool) -> TransferLaw | None:
    """The law of a cam or Geneva wheel; None for a fixed ratio. Raises MechanismError."""
    if kind == "geneva":
        return Geneva(table["slots"])
    if kind != "cam":
        return None
    if not slides and "roller" not in table:
        raise MechanismError("the follower of a cam has no roller", do="give its point")
    if ("table" in table) == ("lift" in table):
        raise MechanismError("a cam has one of lift and table", do="give the steps of its lift, or a table")
    unit, groove = "m" if slides else "rad", table.get("groove", False)
    if "table" in table:
        return _table(table, unit, groove=groove)
    lift = CamLift(steps_of(table["lift"], unit, 0.0, "over"), slides, groove)
    try:
        programme_of(lift.steps)
    except ParameterError as error:
        raise MechanismError(str(error)) from error
    return lift


def _table(table: Table, unit: str, *, groove: bool) -> LiftTable:
    rows = table["table"]
    angles = tuple(value_of(row[0], "rad", "the first of a row") for row in rows)
    lifts = tuple(value_of(row[1], unit, "the second of a row") for row in rows)
    if angles[0] != 0 or any(later <= earlier for earlier, later in itertools.pairwise(angles)):
        raise MechanismError("the angles of a table do not ascend from 0", do="write each above the one before")
    if abs(angles[-1] - turn) > _FULL or lifts[-1] != lifts[0]:
        raise MechanismError("the table of a cam ends elsewhere", allowed="360deg, and the lift at 0")
    return LiftTable((*angles[:-1], turn), lifts, unit == "m", groove)
