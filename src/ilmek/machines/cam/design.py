"""A cam, designed: motion, size, follower, spring, forces over the turn, roller, hub.

Everything that is "largest" or "least" is an exact bound over the pieces of the programme, not the largest of samples.
"""

import math
from dataclasses import dataclass

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.contact import Held
from ilmek.cams.programme import Programme
from ilmek.cams.return_spring import LiftOff, lift_off
from ilmek.cams.trace import Cam
from ilmek.machines.cam.forces import (
    Extremes,
    State,
    duty_of,
    extremes_of,
    held_by,
    pressure_limit,
    pressure_of,
    state_of,
)
from ilmek.machines.cam.hub import Hub, bore_for, hub_for
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.rollers import ROLLERS, Duty, Roller, find_roller
from ilmek.machines.cam.shape import Size, cam_of, part_knots, programme_of, size_of
from ilmek.units import mm

ROOM = 0.8
"""Radius of a roller that is chosen, at most, over the least radius of the pitch curve and over the prime radius."""

MARGIN = 1.2
"""Speed up to which a spring that is chosen holds, over the speed of the cam."""


@dataclass(frozen=True, slots=True)
class CamDesign:
    """A cam, designed. `held` is what the follower carries, with its spring, at the cam's speed."""

    params: CamParams
    programme: Programme
    size: Size
    cam: Cam
    held: Held
    roller: Roller | None
    duty: Duty | None
    hub: Hub
    lift_off: LiftOff
    extremes: Extremes
    area: float
    face_width: float
    pressure_limit: float

    @property
    def rise_knots(self) -> FloatArray:
        """Cam angles of the rise [rad] between which it is smooth."""
        return part_knots(self.programme, "rise")

    @property
    def fall_knots(self) -> FloatArray:
        """Cam angles of the fall [rad] between which it is smooth."""
        return part_knots(self.programme, "fall")

    @property
    def undercut(self) -> bool:
        """Whether no surface can guide the follower."""
        return limits.undercut(self.cam)

    def state(self, angle: FloatArray) -> State:
        """Geometry and forces at cam angles [rad]."""
        return state_of(self.params, self.cam, self.held, angle)

    def hertz(self, angle: FloatArray) -> FloatArray:
        """Hertz pressure [Pa] at cam angles [rad]; NaN where cam and follower cannot touch so."""
        return pressure_of(self.params, self.state(angle), self.face_width)


def design(params: CamParams) -> CamDesign:
    """The cam for the parameters. Raises ParameterError where it cannot exist."""
    programme = programme_of(params)
    size = size_of(params, programme)
    held = held_by(params, programme)
    bare = cam_of(params, programme, size, params.roller_radius or 0.0)
    roller, cam = _with_roller(params, bare, size, held)
    width = params.face_width or (roller.width if roller else 10 * mm)
    extremes = extremes_of(params, cam, held, width)
    torque = max(abs(extremes.torque.value), abs(extremes.back_torque.value))
    return CamDesign(
        params=params,
        programme=programme,
        size=size,
        cam=cam,
        held=held,
        roller=roller,
        duty=duty_of(params, cam, held) if params.follower == "roller" else None,
        hub=hub_for(params.bore or bore_for(torque if math.isfinite(torque) else 0.0)),
        lift_off=lift_off(programme, held),
        extremes=extremes,
        area=limits.area(cam),
        face_width=width,
        pressure_limit=pressure_limit(params),
    )


def _with_roller(params: CamParams, bare: Cam, size: Size, held: Held) -> tuple[Roller | None, Cam]:
    """The roller, and the cam for what touches it: as given, from the table, or half of what there is room for.

    The table's smallest roller that lasts is taken; where none does, the largest for which there is room.
    """

    def fitted(radius: float) -> Cam:
        return cam_of(params, bare.programme, size, radius)

    if params.roller is not None:
        roller = find_roller(params.roller)
        return roller, fitted(roller.radius)
    if params.roller_radius is not None or params.follower in ("knife", "flat"):
        return None, bare
    room = min(limits.convex_radius_min(bare).value, bare.prime_radius)
    fitting = [roller for roller in ROLLERS.values() if roller.radius <= ROOM * room]
    if params.follower == "spherical" or not fitting:
        return None, fitted(0.5 * room)
    for roller in fitting:
        duty = duty_of(params, fitted(roller.radius), held)
        if duty.largest <= roller.force_limit and duty.time(roller) >= params.life:
            return roller, fitted(roller.radius)
    return fitting[-1], fitted(fitting[-1].radius)
