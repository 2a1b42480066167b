"""Shedding cams: one cam per warp, opposed for odd and even warps, on a square shaft.     [thesis, chapter 3.2]

Each cam lifts its warp by the programme rise, dwell, fall, rest; the cams of the odd warps are the same, half a turn
later. Between the cams stand guide cams (round, higher than the nose), which fill the rest of the pitch and keep the
warps apart. A warp drawn taut over the cam presses with F across the cam's axis: the given force, or, from its tension
T over the half span H, F = 2 T s / sqrt(s^2 + H^2). The speed is low: the torque is that of the warps alone,

    M(theta) = n_even F(s_even) s'_even + n_odd F(s_odd) s'_odd

so that with the usual opposed cams only half of the warps ever load the shaft (the thesis takes all 600).
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import PlateCam
from ilmek.cams.pieces import Extremum, crossing, infimum, integral, supremum
from ilmek.cams.programme import TURN, Programme, dwell, fall, rise
from ilmek.elements.motors import Motor, Reducer, most_torque, smallest_motor
from ilmek.machines.shedding.params import NO_DWELL, SheddingParams
from ilmek.machines.shedding.shaft import Shaft, shaft_for


@dataclass(frozen=True, slots=True)
class Stack:
    """The cams on the shaft: thickness of cam and guide [m], guide radius [m], masses [kg]."""

    thickness: float
    guide_thickness: float
    guide_radius: float
    cam_mass: float
    guide_mass: float
    mass: float


@dataclass(frozen=True, slots=True)
class Drive:
    """What turns the shaft: torque [N m] and its rms over the turn, motor torque needed [N m], motor and its limit.

    motor_limit  lasting torque of the motor; where none is strong enough, the most any gives at that speed
    """

    torque_max: Extremum
    torque_min: Extremum
    torque_rms: float
    reducer: Reducer
    motor_torque: float
    motor_speed: float
    motor: Motor | None
    motor_limit: float


@dataclass(frozen=True, slots=True)
class SheddingDesign:
    """Shedding cams, designed. `even` and `odd` are the programmes of the two parities on the shaft's angle."""

    params: SheddingParams
    cam: PlateCam
    smallest_prime: Extremum
    even: Programme
    odd: Programme
    stack: Stack
    shaft: Shaft
    drive: Drive
    shuttle_window: tuple[float, float]

    def opening(self, angle: FloatArray) -> FloatArray:
        """Distance [m] of the even warps over the odd ones; negative where the odd ones are lifted."""
        return np.asarray(self.even.at(angle).s - self.odd.at(angle).s)

    def torque(self, angle: FloatArray) -> FloatArray:
        """Torque of the warps on the shaft [N m]."""
        return shaft_torque(self.params, (self.even, self.odd), angle)


def lifting(params: SheddingParams, law: str | None = None) -> Programme:
    """The programme of one cam, by the law of the parameters or another."""
    motion = LAWS[law or params.law]
    rest = TURN - params.lifted_angle
    segments = [
        rise(params.rise, params.lift, motion),
        *([dwell(params.dwell)] if params.dwell > 0 else []),
        fall(params.fall_angle, params.lift, motion),
        *([dwell(rest)] if rest > NO_DWELL else []),
    ]
    return Programme(tuple(segments))


def turn_knots(even: Programme, odd: Programme) -> FloatArray:
    """Shaft angles of one turn [rad] between which both parities move smoothly."""
    inner = np.mod(np.concatenate([even.knots, odd.knots]), TURN)
    return np.unique(np.concatenate([inner, [0.0, TURN]]))


def warp_force(params: SheddingParams, s: FloatArray) -> FloatArray:
    """Force [N] of a warp across the cam at a displacement [m]: constant while lifted, or 2 T s / sqrt(s^2 + H^2)."""
    if params.tension is None or params.half_span is None:
        return np.full_like(s, params.warp_force)
    return np.asarray(2 * params.tension * s / np.hypot(s, params.half_span))


def shaft_torque(params: SheddingParams, parities: tuple[Programme, Programme], angle: FloatArray) -> FloatArray:
    """Torque [N m] of the even and the odd warps on the shaft, quasi-static: sum of n F s'."""
    total = np.zeros_like(angle)
    for number, programme in zip((params.warps // 2, params.warps - params.warps // 2), parities, strict=True):
        at = programme.at(angle)
        total += number * warp_force(params, at.s) * at.ds
    return total


def design(params: SheddingParams) -> SheddingDesign:
    """Cams, stack, shaft and drive for the parameters. Raises ParameterError where the cam cannot exist."""
    even = lifting(params)
    odd = even.shifted(TURN / 2)
    smallest = limits.smallest_prime_radius(even, params.pressure_angle_limit)
    cam = PlateCam(even, params.prime_radius or smallest.value, roller_radius=params.roller_radius)
    thickness = params.cam_thickness or params.warp_pitch / 2
    guide_radius = cam.prime_radius + params.lift - params.roller_radius + params.guide_height
    areas = limits.area(cam), math.pi * guide_radius**2
    solid = areas[0] * thickness + areas[1] * (params.warp_pitch - thickness)
    drive = _drive(params, even, odd)
    lifted = math.ceil(params.warps / 2) if params.opposed else params.warps
    across = lifted * float(warp_force(params, np.array(params.lift)))
    torque = max(drive.torque_max.value, -drive.torque_min.value)
    shaft = shaft_for(params, params.warps * solid * params.density, across, torque)
    return SheddingDesign(
        params=params,
        cam=cam,
        smallest_prime=smallest,
        even=even,
        odd=odd,
        stack=_stack(params, areas, thickness, guide_radius, shaft.bar),
        shaft=shaft,
        drive=drive,
        shuttle_window=_shuttle_window(params, even, odd),
    )


def _stack(
    params: SheddingParams, areas: tuple[float, float], thickness: float, guide_radius: float, bore: float
) -> Stack:
    """Masses of a cam and of a guide (bored), and of the stack with its shaft."""
    guide_thickness = params.warp_pitch - thickness
    solid = areas[0] * thickness + areas[1] * guide_thickness
    cam_mass = max(areas[0] - bore**2, 0.0) * thickness * params.density
    guide_mass = max(areas[1] - bore**2, 0.0) * guide_thickness * params.density
    mass = params.warps * solid * params.density
    return Stack(thickness, guide_thickness, guide_radius, cam_mass, guide_mass, mass)


def _drive(params: SheddingParams, even: Programme, odd: Programme) -> Drive:
    """Torque over the turn, and the motor behind the reducer."""
    knots = turn_knots(even, odd)

    def torque(angle: FloatArray) -> FloatArray:
        return shaft_torque(params, (even, odd), angle)

    most, least = supremum(torque, knots), infimum(torque, knots)
    rms = math.sqrt(integral(lambda angle: torque(angle) ** 2, knots) / TURN)
    reducer = Reducer(params.ratio, params.efficiency)
    # Going down the warps drive the cams: the motor holds back what the reducer's friction leaves.
    braking = -least.value * max(reducer.back_driving_efficiency, 0.0) / params.ratio
    needed = max(reducer.motor_torque(most.value), braking, 0.0)
    speed = params.speed * params.ratio
    motor = smallest_motor(needed, speed) if params.motor_torque is None else None
    limit = params.motor_torque or (motor.torque if motor else most_torque(speed))
    return Drive(most, least, rms, reducer, needed, speed, motor, limit)


def _shuttle_window(params: SheddingParams, even: Programme, odd: Programme) -> tuple[float, float]:
    """Shaft angles [rad] between which the even shed is open enough for the shuttle, longest; equal where it never is.

    At angle 0 the even warps are down, so that no shed runs over the end of the turn.
    """

    def room(angle: FloatArray) -> FloatArray:
        return np.asarray(even.at(angle).s - odd.at(angle).s - params.shuttle_height)

    angle = np.unique(np.concatenate([turn_knots(even, odd), np.linspace(0.0, TURN, _GRID)]))
    edges = np.diff(np.concatenate([[False], room(angle) >= 0, [False]]).astype(np.int8))
    begins, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1
    if begins.size == 0:
        return params.rise, params.rise
    longest = int(np.argmax(angle[ends] - angle[begins]))
    first, last = int(begins[longest]), int(ends[longest])
    return (
        crossing(room, float(angle[first - 1]), float(angle[first])),
        crossing(room, float(angle[min(last + 1, angle.size - 1)]), float(angle[last])),
    )


_GRID = 2049
"""Angles at which the shed is looked at, besides the ends of the motions; its edges are then found to rounding."""
