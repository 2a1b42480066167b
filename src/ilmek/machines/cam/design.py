"""A cam, designed: motion, size, follower, spring, forces over the turn, roller, hub.

Everything that is "largest" or "least" is an exact bound over the pieces of the programme, not the largest of samples.
"""

import math
from dataclasses import dataclass

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.barrel import Barrel, undercut_in_space
from ilmek.cams.contact import FollowerLoad
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.cams.return_spring import LiftOff, lift_off
from ilmek.cams.trace import CamRole
from ilmek.machines.cam.forces import (
    CamExtremes,
    CamState,
    duty_of,
    extremes_of,
    held_by,
    pressure_limit,
    pressure_of,
    state_of,
)
from ilmek.machines.cam.hub import Hub, bore_for, hub_for
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.rollers import ROLLERS, Roller, RollerDuty, find_roller
from ilmek.machines.cam.shape import CamShape, CamSize, cam_of, cams_of, part_knots, programme_of, roller_width, size_of

ROOM = 0.8
"""Radius of a roller that is chosen, at most, over the least radius of the pitch curve and over the prime radius."""


@dataclass(frozen=True, slots=True)
class CamDesign:
    """A cam, designed. `held` is what the follower carries, with its spring, at the cam's speed."""

    params: CamParams
    programme: CamProgramme
    size: CamSize
    cams: CamShape
    held: FollowerLoad
    roller: Roller | None
    duty: RollerDuty | None
    hub: Hub
    lift_off: LiftOff
    extremes: CamExtremes
    area: float
    face_width: float
    pressure_limit: float

    @property
    def cam(self) -> CamRole:
        """The cam; of conjugate ones that which lifts."""
        return self.cams.cam

    @property
    def rise_knots(self) -> FloatArray:
        """Cam angles of the rise [rad] between which it is smooth."""
        return part_knots(self.programme, "rise")

    @property
    def fall_knots(self) -> FloatArray:
        """Cam angles of the fall [rad] between which it is smooth."""
        return part_knots(self.programme, "fall")

    @property
    def cornered(self) -> bool:
        """Whether a jump of the velocity makes a corner that no roller or face can follow; a knife's edge can."""
        sides = [jump.after - jump.before for jump in jumps(self.programme, 1)]
        wrong = any(step < 0 or self.params.led for step in sides)
        return wrong and (self.cam.flat or self.cam.roller_radius > 0)

    @property
    def undercut(self) -> bool:
        """Whether no surface can guide the follower."""
        if self.cornered:
            return True
        cam, pair = self.cams
        other = pair is not None and limits.undercut(pair.second)
        both = self.params.kind in ("grooved", "barrel")
        round_ = isinstance(cam, Barrel) and undercut_in_space(cam, both_flanks=both) is not None
        return other or round_ or limits.undercut(cam, both_flanks=both)

    def state(self, angle: FloatArray) -> CamState:
        """Geometry and forces at cam angles [rad]."""
        return state_of(self.params, self.cams, self.held, angle)

    def hertz(self, angle: FloatArray) -> FloatArray:
        """Hertz pressure [Pa] at cam angles [rad]; NaN where cam and follower cannot touch so."""
        return pressure_of(self.params, self.state(angle), self.face_width)


def design(params: CamParams) -> CamDesign:
    """The cam for the parameters. Raises ParameterError where it cannot exist."""
    programme = programme_of(params)
    size = size_of(params, programme)
    held = held_by(params, programme)
    bare = cam_of(params, programme, size, params.roller_radius or 0.0)
    roller, cams = _with_roller(params, bare, size, held)
    width = roller_width(params, cams.cam.roller_radius)
    extremes = extremes_of(params, cams, held, width)
    torque = max(abs(extremes.torque.value), abs(extremes.back_torque.value))
    return CamDesign(
        params=params,
        programme=programme,
        size=size,
        cams=cams,
        held=held,
        roller=roller,
        duty=duty_of(params, cams, held) if params.follower == "roller" else None,
        hub=hub_for(params.bore or bore_for(torque if math.isfinite(torque) else 0.0)),
        lift_off=LiftOff(math.inf, 0.0) if params.led else lift_off(programme, held),
        extremes=extremes,
        area=math.nan if params.laid_flat else limits.area(cams.cam),
        face_width=width,
        pressure_limit=pressure_limit(params),
    )


def _with_roller(params: CamParams, bare: CamRole, size: CamSize, held: FollowerLoad) -> tuple[Roller | None, CamShape]:
    """The roller, and the cam for what touches it: as given, from the table, or half of what there is room for.

    The table's smallest roller that lasts is taken; where none does, the largest for which there is room.
    """

    def fitted(radius: float) -> CamShape:
        return cams_of(params, bare.programme, size, radius)

    if params.roller is not None:
        roller = find_roller(params.roller)
        return roller, fitted(roller.radius)
    if params.roller_radius is not None or params.follower in ("knife", "flat"):
        return None, fitted(params.roller_radius or 0.0)
    room = _room(params, bare)
    fitting = [roller for roller in ROLLERS.values() if roller.radius <= ROOM * room]
    if params.follower == "spherical" or not fitting:
        return None, fitted(0.5 * room)
    for roller in fitting:
        duty = duty_of(params, fitted(roller.radius), held)
        if duty.largest <= roller.force_limit and duty.time(roller) >= params.life:
            return roller, fitted(roller.radius)
    return fitting[-1], fitted(fitting[-1].radius)


def _room(params: CamParams, bare: CamRole) -> float:
    """Radius [m] below which a roller is undercut nowhere and leaves something of the prime circle."""
    room = min(limits.convex_radius_min(bare).value, bare.prime_radius)
    hollow = limits.concave_radius_min(bare) if params.kind in ("grooved", "barrel") else None
    return room if hollow is None else min(room, hollow.value)
