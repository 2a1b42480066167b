"""Shedding cams: one cam per warp, opposed for odd and even warps, on a square shaft.     [thesis, chapter 3.2]

Each cam lifts its warp by the programme rise, dwell, fall, rest; the cams of the odd warps are the same, half a turn
later. Between the cams stand guide cams (round, higher than the nose), which fill the rest of the pitch and keep the
warps apart. A warp drawn taut over the cam presses with F across the cam's axis: the given force, or, from its tension
T over the half span H, F = 2 T s / sqrt(s^2 + H^2). The speed is low: the torque is that of the warps alone,

    M(theta) = n_even F(s_even) s'_even + n_odd F(s_odd) s'_odd

so that with the usual opposed cams only half of the warps ever load the shaft (the thesis takes all 600). How cams of
a parity may stand one after another instead of all at once: `phases`; tension and force from the warp's way: `warp`.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.laws import LAWS
from ilmek.cams.limits import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements.duty import LoadCycle, MotorDuty, duty
from ilmek.elements.motors import Motor, Reducer, most_torque, smallest_motor
from ilmek.machines.shedding.params import NO_DWELL, SheddingParams
from ilmek.machines.shedding.phases import Shed, chosen_shed
from ilmek.machines.shedding.shaft import Shaft, shaft_for
from ilmek.num.piecewise import Extremum, supremum


@dataclass(frozen=True, slots=True)
class CamStack:
    """The cams on the shaft: thickness of cam and guide [m], guide radius [m], masses [kg], turning inertia [kg m^2].

    Cams and guide cams are weighed bored; the stack with the shaft in its bores.
    """

    thickness: float
    guide_thickness: float
    guide_radius: float
    cam_mass: float
    guide_mass: float
    mass: float
    inertia: float


@dataclass(frozen=True, slots=True)
class SheddingDrive:
    """What turns the shaft: torque [N m] and its rms over the turn, motor torque needed [N m], motor and its limit.

    motor_limit  lasting torque of the motor; where none is strong enough, the most any gives at that speed
    duty         of the motor over a turn, the stack's inertia with it; None without one of the table
    """

    torque_max: Extremum
    torque_min: Extremum
    torque_rms: float
    reducer: Reducer
    motor_torque: float
    motor_speed: float
    motor: Motor | None
    motor_limit: float
    duty: MotorDuty | None


@dataclass(frozen=True, slots=True)
class SheddingDesign:
    """Shedding cams, designed.

    even, odd   programmes of the two parities on the shaft's angle; of staggered cams those of the middle
    shed        all groups of cams, as they stand on the shaft
    across_max  largest force of the lifted warps across the shaft [N]
    """

    params: SheddingParams
    cam: PlateCam
    smallest_prime: Extremum
    even: CamProgramme
    odd: CamProgramme
    shed: Shed
    across_max: Extremum
    stack: CamStack
    shaft: Shaft
    drive: SheddingDrive
    shuttle_window: tuple[float, float]

    def opening(self, angle: FloatArray) -> FloatArray:
        """Distance [m] of the even warps over the odd ones; negative where the odd ones are lifted."""
        return self.shed.opening(angle)

    def torque(self, angle: FloatArray) -> FloatArray:
        """Torque of the warps on the shaft [N m]."""
        return self.shed.torque(angle)


def lifting(params: SheddingParams, law: str | None = None) -> CamProgramme:
    """The programme of one cam, by the law of the parameters or another."""
    motion = LAWS[law or params.law]
    rest = TURN - params.lifted_angle
    segments = [
        rise(params.rise, params.lift, motion),
        *([dwell(params.dwell)] if params.dwell > 0 else []),
        fall(params.fall_angle, params.lift, motion),
        *([dwell(rest)] if rest > NO_DWELL else []),
    ]
    return CamProgramme(tuple(segments))


def design(params: SheddingParams) -> SheddingDesign:
    """Cams, stack, shaft and drive for the parameters. Raises ParameterError where the cam cannot exist."""
    even = lifting(params)
    odd = even.shifted(TURN / 2)
    smallest = pressure_prime(even, CamLimits(params.pressure_angle_limit, params.pressure_angle_limit))
    cam = PlateCam(even, params.prime_radius or smallest.value, roller_radius=params.roller_radius)
    thickness = params.cam_thickness or params.warp_pitch / 2
    guide_radius = cam.prime_radius + params.lift - params.roller_radius + params.guide_height
    thicknesses = thickness, params.warp_pitch - thickness
    areas = limits.area(cam), math.pi * guide_radius**2
    mass, inertia = (
        params.warps * params.density * sum(part * thick for part, thick in zip(parts, thicknesses, strict=True))
        for parts in (areas, (polar_moment(cam), math.pi / 2 * guide_radius**4))
    )
    shed = chosen_shed(params, even)
    drive = _drive(params, shed, inertia)
    across = supremum(shed.across, shed.knots)
    torque = max(drive.torque_max.value, -drive.torque_min.value)
    shaft = shaft_for(params, mass, across.value, torque)
    bored = [
        max(part - shaft.bar**2, 0.0) * thick * params.density for part, thick in zip(areas, thicknesses, strict=True)
    ]
    return SheddingDesign(
        params=params,
        cam=cam,
        smallest_prime=smallest,
        even=even,
        odd=odd,
        shed=shed,
        across_max=across,
        stack=CamStack(*thicknesses, guide_radius, bored[0], bored[1], mass, inertia),
        shaft=shaft,
        drive=drive,
        shuttle_window=shed.window(),
    )


def polar_moment(cam: PlateCam) -> float:
    """Second moment of the cam's face about its axis, bore not taken off [m^4]: integral of r^4 / 4 over the angle."""
    surface = cam.surface(np.arange(_POINTS) * (TURN / _POINTS))
    after = np.roll(surface, -1)
    across = np.abs((np.conj(surface) * after).imag)
    squares = np.abs(surface) ** 2 + np.abs(after) ** 2 + (np.conj(surface) * after).real
    return float(np.sum(across * squares)) / 12


_POINTS = 1440


def _drive(params: SheddingParams, shed: Shed, inertia: float) -> SheddingDrive:
    """Torque over the turn, and the motor behind the reducer, which turns the stack's inertia [kg m^2] too."""
    most, least = shed.peaks()
    rms = shed.rms()
    reducer = Reducer(params.ratio, params.efficiency)
    # Going down the warps drive the cams: the motor holds back what the reducer's friction leaves.
    braking = -least.value * max(reducer.back_driving_efficiency, 0.0) / params.ratio
    needed = max(reducer.motor_torque(most.value), braking, 0.0)
    speed = params.speed * params.ratio
    motor = smallest_motor(needed, speed) if params.motor_torque is None else None
    limit = params.motor_torque or (motor.torque if motor else most_torque(speed))
    if motor is None:
        return SheddingDrive(most, least, rms, reducer, needed, speed, None, limit, None)
    angle = np.arange(_POINTS) * (TURN / _POINTS)
    cycle = LoadCycle(np.full_like(angle, params.speed), np.zeros_like(angle), shed.torque(angle), inertia)
    return SheddingDrive(most, least, rms, reducer, needed, speed, motor, limit, duty(cycle, motor, reducer))
