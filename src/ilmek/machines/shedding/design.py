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
from ilmek.elements import shafts
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.elements.motors import Motor, Reducer, smallest_motor
from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import GPa, MPa, N, deg, format_quantity, mm, rpm

_NO_DWELL = 1e-9


@dataclass(frozen=True, slots=True)
class SheddingParams(Params):
    """What is asked of the shedding cams."""

    lift: float = param(
        60 * mm, unit="mm", at_least=0.01 * mm, at_most=1.0, doc="lift of a warp: the height of the shed"
    )
    rise: float = param(90 * deg, unit="deg", at_least=1 * deg, below=TURN, doc="cam angle of the rise", symbol="beta")
    fall: float | None = param(
        None, unit="deg", at_least=1 * deg, below=TURN, doc="cam angle of the return; none: as the rise"
    )
    dwell: float = param(0.0, unit="deg", at_least=0.0, below=TURN, doc="cam angle for which the warp stays lifted")
    law: str = param("harmonic", choices=tuple(LAWS), doc="motion law of rise and return")
    pressure_angle_limit: float = param(
        30 * deg, unit="deg", at_least=1 * deg, below=90 * deg, doc="largest pressure angle", symbol="mu"
    )
    prime_radius: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=2.0,
        doc="prime radius; none: the smallest for the pressure angle",
        symbol="Rp",
    )
    roller_radius: float = param(
        0.0, unit="mm", at_least=0.0, at_most=0.5, doc="radius of the warp or roller on the cam"
    )
    warps: int = param(600, at_least=2, at_most=100_000, doc="warps, one cam each")
    warp_pitch: float = param(2 * mm, unit="mm", at_least=0.01 * mm, at_most=50 * mm, doc="distance between two warps")
    cam_thickness: float | None = param(
        None, unit="mm", at_least=0.001 * mm, at_most=50 * mm, doc="thickness of a cam; none: half the pitch"
    )
    guide_height: float = param(
        10 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="height of the guide cams over the nose"
    )
    density: float = param(
        MATERIALS["structural steel"].density,
        unit="kg/m^3",
        at_least=1.0,
        at_most=25e3,
        doc="density of cams and shaft",
    )
    warp_force: float = param(10 * N, unit="N", at_least=0.0, at_most=1e4, doc="force of a lifted warp across the cam")
    tension: float | None = param(None, unit="N", at_least=1e-6, at_most=1e4, doc="tension of a warp, with half_span")
    half_span: float | None = param(
        None,
        unit="mm",
        at_least=0.1 * mm,
        at_most=10.0,
        doc="cam to the next hold of the warp: force from tension and lift",
    )
    shuttle_height: float = param(
        40 * mm, unit="mm", at_least=0.01 * mm, at_most=1.0, doc="opening that the shuttle needs"
    )
    speed: float = param(5 * rpm, unit="rpm", at_least=1e-6 * rpm, at_most=600 * rpm, doc="speed of the cam shaft")
    shaft_length: float | None = param(
        None, unit="m", at_least=1 * mm, at_most=20.0, doc="shaft between its bearings; none: warps x pitch", symbol="l"
    )
    shaft_load: float | None = param(
        None, unit="kN/m", at_least=1e-3, at_most=1e7, doc="load of the shaft; none: from cams and warps", symbol="w"
    )
    safety: float | None = param(
        None, at_least=1.0, at_most=20.0, doc="factor on the load; none: 1 on a given load, 2 on one computed here"
    )
    modulus: float = param(
        200 * GPa, unit="GPa", at_least=1 * MPa, at_most=1e13, doc="Young's modulus of the shaft", symbol="E"
    )
    slope_limit: float = param(0.004, unit="rad", at_least=1e-9, below=0.5, doc="largest slope at the bearings")
    deflection_limit: float = param(
        1 * mm, unit="mm", at_least=1e-9, at_most=0.1, doc="largest deflection of the shaft"
    )
    bore_wall: float = param(
        5 * mm, unit="mm", at_least=0.0, at_most=0.5, doc="least wall between square bore and surface"
    )
    ratio: float = param(100.0, at_least=1e-3, at_most=1e5, doc="ratio of the reducer on the shaft")
    efficiency: float = param(0.85, at_least=0.01, at_most=1.0, doc="efficiency of the reducer")
    motor_torque: float | None = param(
        None, unit="Nm", at_least=1e-6, at_most=1e4, doc="torque of the motor; none: the smallest that is enough"
    )

    def check_together(self) -> None:
        """Raise ParameterError where angles do not fit the turn, cams the pitch, or half of a pair is missing."""
        if self.lifted_angle > TURN + _NO_DWELL:
            given = f"rise + dwell + fall = {format_quantity(self.lifted_angle, 'deg')}"
            raise ParameterError(given, allowed="they must fit one turn, 360 deg", do="shorten one of them")
        if self.cam_thickness is not None and self.cam_thickness >= self.warp_pitch:
            pitch = format_quantity(self.warp_pitch, "mm")
            given = f"cam_thickness={format_quantity(self.cam_thickness, 'mm')} does not fit warp_pitch={pitch}"
            raise ParameterError(given, allowed=f"below {pitch}", do="leave it out for half the pitch")
        if (self.tension is None) != (self.half_span is None):
            missing = "half_span" if self.half_span is None else "tension"
            raise ParameterError(f"{missing} is missing", do="give tension and half_span together, or warp_force alone")

    @property
    def fall_angle(self) -> float:
        """Cam angle of the return [rad]."""
        return self.rise if self.fall is None else self.fall

    @property
    def lifted_angle(self) -> float:
        """Cam angle for which a warp is off its line [rad]."""
        return self.rise + self.dwell + self.fall_angle

    @property
    def opposed(self) -> bool:
        """Whether one parity is down whenever the other is up."""
        return self.lifted_angle <= TURN / 2 + _NO_DWELL


@dataclass(frozen=True, slots=True)
class Shaft:
    """The square shaft: load [N/m], length [m], least sides for slope and deflection, side of the bar taken [m]."""

    load: float
    length: float
    side_slope: float
    side_deflection: float
    bar: float

    @property
    def side(self) -> float:
        """Least side [m] for both limits."""
        return max(self.side_slope, self.side_deflection)


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
    """What turns the shaft: torque [N m] and its rms over the turn, motor torque needed [N m], motor and its limit."""

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
        *([dwell(rest)] if rest > _NO_DWELL else []),
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
    shaft = _shaft(params, solid * params.density)
    return SheddingDesign(
        params=params,
        cam=cam,
        smallest_prime=smallest,
        even=even,
        odd=odd,
        stack=_stack(params, areas, thickness, guide_radius, shaft.bar),
        shaft=shaft,
        drive=_drive(params, even, odd),
        shuttle_window=_shuttle_window(params, even, odd),
    )


def _shaft(params: SheddingParams, mass_of_a_pitch: float) -> Shaft:
    """The square shaft under its load; cams are weighed with their bores filled, which is the shaft's own weight."""
    length = params.shaft_length or params.warps * params.warp_pitch
    load, safety = params.shaft_load, params.safety or 1.0
    if load is None:
        lifted = math.ceil(params.warps / 2) if params.opposed else params.warps
        across = lifted * float(warp_force(params, np.array(params.lift)))
        weight = params.warps * mass_of_a_pitch * GRAVITY
        load, safety = math.hypot(weight, across) / length, params.safety or 2.0
    load *= safety
    by_slope = shafts.square_side(shafts.inertia_for_slope(load, length, params.modulus, params.slope_limit))
    by_deflection = shafts.square_side(
        shafts.inertia_for_deflection(load, length, params.modulus, params.deflection_limit)
    )
    least = max(by_slope, by_deflection)
    # Beyond the dealers' largest bar one is made to measure, in whole centimetres.
    return Shaft(load, length, by_slope, by_deflection, shafts.stock_side(least) or math.ceil(least * 100) / 100)


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
    limit = params.motor_torque or (motor.torque if motor else math.nan)
    return Drive(most, least, rms, reducer, needed, speed, motor, limit)


def _shuttle_window(params: SheddingParams, even: Programme, odd: Programme) -> tuple[float, float]:
    """Shaft angles [rad] between which the even shed is open enough for the shuttle; equal where it never is."""

    def room(angle: FloatArray) -> FloatArray:
        return np.asarray(even.at(angle).s - odd.at(angle).s - params.shuttle_height)

    first, last = params.rise, params.rise + params.dwell
    if float(room(np.array(first))) < 0 or float(room(np.array(last))) < 0:
        return first, first
    return crossing(room, 0.0, first), crossing(room, params.lifted_angle, last)
