"""A cam, designed: motion, size, follower, spring, forces over the turn, roller, hub.

Everything that is "largest" or "least" is an exact bound over the pieces of the programme, not the largest of samples.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.contact import Held, Touch, pressed
from ilmek.cams.hertz import LINE_YIELD, POINT_YIELD, contact_modulus, ellipse_contact, line_contact
from ilmek.cams.pieces import Extremum, Function, infimum, integral, supremum
from ilmek.cams.programme import TURN, Programme
from ilmek.cams.return_spring import (
    LiftOff,
    doubling_spring,
    least_preload,
    least_rate,
    lift_off,
    velocity_drop,
)
from ilmek.cams.trace import Cam, Trace
from ilmek.elements.materials import MATERIALS
from ilmek.machines.cam.hub import Hub, bore_for, hub_for
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.rollers import POWER, ROLLERS, Duty, Roller, find_roller
from ilmek.machines.cam.shape import Size, cam_of, part_knots, programme_of, size_of
from ilmek.units import mm

POISSON = 0.3
"""Of steels; of irons and light metals within a tenth, which moves the pressure by a hundredth."""

ROOM = 0.8
"""Radius of a roller that is chosen, at most, over the least radius of the pitch curve and over the prime radius."""

MARGIN = 1.2
"""Speed up to which a spring that is chosen holds, over the speed of the cam."""


@dataclass(frozen=True, slots=True)
class State:
    """Cam and follower at cam angles: geometry, need along the motion [N], force on the normal [N], torque [N m]."""

    trace: Trace
    force: FloatArray
    normal: FloatArray
    torque: FloatArray


@dataclass(frozen=True, slots=True)
class Extremes:
    """What is largest over the turn, and where; `pressure` is the Hertz pressure [Pa], None for a knife's edge."""

    normal: Extremum
    torque: Extremum
    back_torque: Extremum
    torque_rms: float
    pressure: Extremum | None


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
        return _state(self.params, self.cam, self.held, angle)

    def hertz(self, angle: FloatArray) -> FloatArray:
        """Hertz pressure [Pa] at cam angles [rad]; NaN where cam and follower cannot touch so."""
        return _pressure(self.params, self.state(angle), self.face_width)


def design(params: CamParams) -> CamDesign:
    """The cam for the parameters. Raises ParameterError where it cannot exist."""
    programme = programme_of(params)
    size = size_of(params, programme)
    held = _held(params, programme)
    bare = cam_of(params, programme, size, params.roller_radius or 0.0)
    roller, cam = _with_roller(params, bare, size, held)
    width = params.face_width or (roller.width if roller else 10 * mm)
    extremes = _extremes(params, cam, held, width)
    torque = max(abs(extremes.torque.value), abs(extremes.back_torque.value))
    return CamDesign(
        params=params,
        programme=programme,
        size=size,
        cam=cam,
        held=held,
        roller=roller,
        duty=_duty(params, cam, held) if params.follower == "roller" else None,
        hub=hub_for(params.bore or bore_for(torque if math.isfinite(torque) else 0.0)),
        lift_off=lift_off(programme, held),
        extremes=extremes,
        area=limits.area(cam),
        face_width=width,
        pressure_limit=_pressure_limit(params),
    )


def _held(params: CamParams, programme: Programme) -> Held:
    """Mass, load and return spring; what is not given of the spring is the least that holds up to the hold speed."""
    hold = MARGIN * params.speed if params.hold_speed is None else params.hold_speed
    bare = Held(hold, params.mass, params.spring_rate or 0.0, params.preload or 0.0, params.load)
    if velocity_drop(programme) is not None:
        return replace(bare, speed=params.speed)
    if params.spring_rate is None and params.preload is None:
        bare = doubling_spring(programme, bare)
    elif params.preload is None:
        bare = replace(bare, preload=least_preload(programme, bare))
    elif params.spring_rate is None:
        bare = replace(bare, rate=least_rate(programme, bare))
    return replace(bare, speed=params.speed)


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
        duty = _duty(params, fitted(roller.radius), held)
        if duty.largest <= roller.force_limit and duty.time(roller) >= params.life:
            return roller, fitted(roller.radius)
    return fitting[-1], fitted(fitting[-1].radius)


def _duty(params: CamParams, cam: Cam, held: Held) -> Duty:
    """What a roller bears over the turn."""

    def borne(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        state = _state(params, cam, held, angle)
        spin = np.abs(state.trace.flow / cam.roller_radius - 1)
        return np.maximum(state.normal, 0.0), spin

    def worn(angle: FloatArray) -> FloatArray:
        force, spin = borne(angle)
        return np.asarray(force**POWER * spin)

    knots = cam.programme.knots
    turns = integral(lambda angle: borne(angle)[1], knots)
    mean = (integral(worn, knots) / turns) ** (1 / POWER)
    return Duty(mean, supremum(lambda angle: borne(angle)[0], knots).value, turns / TURN, params.speed)


def _state(params: CamParams, cam: Cam, held: Held, angle: FloatArray) -> State:
    trace = cam.trace(angle)
    way = trace.normal * np.exp(-1j * trace.pressure_angle)
    force = held.force(trace.course.s, trace.course.dds)
    sliding = 0.0 if params.follower == "roller" else params.sliding_friction
    touch = Touch(trace.surface, trace.normal, way)
    found = pressed(touch, trace.course.ds, force, sliding=sliding, guide=params.guide_friction)
    return State(trace, force, found.normal, found.torque)


def _pressure(params: CamParams, state: State, width: float) -> FloatArray:
    first, second = MATERIALS[params.material], MATERIALS[params.follower_material]
    modulus = contact_modulus(first.modulus, POISSON, second.modulus, POISSON)
    round_follower = 1 / state.trace.roller_radius if state.trace.roller_radius > 0 else 0.0
    along = state.trace.surface_curvature + round_follower
    if params.follower == "spherical" or params.crown_radius is not None:
        across = round_follower if params.crown_radius is None else 1 / params.crown_radius
        return ellipse_contact(state.normal, along, across, modulus).pressure
    return line_contact(state.normal / width, along, modulus).pressure


def _pressure_limit(params: CamParams) -> float:
    """Where the weaker of both materials first yields, below its surface [Johnson, Contact Mechanics]."""
    if params.pressure_limit is not None:
        return params.pressure_limit
    strength = min(MATERIALS[name].strength for name in (params.material, params.follower_material))
    point = params.follower == "spherical" or params.crown_radius is not None
    return strength * (POINT_YIELD if point else LINE_YIELD)


def _extremes(params: CamParams, cam: Cam, held: Held, width: float) -> Extremes:
    knots = cam.programme.knots

    def of(pick: str) -> Function:
        def value(angle: FloatArray) -> FloatArray:
            return np.asarray(getattr(_state(params, cam, held, angle), pick))

        return value

    def hertz(angle: FloatArray) -> FloatArray:
        return _pressure(params, _state(params, cam, held, angle), width)

    return Extremes(
        normal=supremum(of("normal"), knots),
        torque=supremum(of("torque"), knots),
        back_torque=infimum(of("torque"), knots),
        torque_rms=math.sqrt(integral(lambda angle: of("torque")(angle) ** 2, knots) / TURN),
        pressure=None if params.follower == "knife" else supremum(hertz, knots),
    )
