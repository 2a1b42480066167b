"""A cam shaft: the cams of its warps, their stack, the square shaft with its bearings, and its drive.

The speed is low: the torque is that of the warps alone,

    M(theta) = n_even F(s_even) s'_even + n_odd F(s_odd) s'_odd

The prime circle is the smallest that keeps the pressure angle and, in whole millimetres, leaves room for the bore: a
larger cam is heavier and needs a thicker bar, so that both are found together.
"""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements.duty import LoadCycle, MotorDuty, duty
from ilmek.elements.locknuts import Locknut, locknut_for
from ilmek.elements.motors import Motor, Reducer, most_torque, smallest_motor, strongest_motor
from ilmek.elements.nose_buckling import nose_buckling
from ilmek.elements.parallel_keys import KeyedEnd, keyed_end
from ilmek.elements.square_shaft import LEAST_BAR, SquareShaft, SquareShaftTask, square_shaft
from ilmek.machines.bearing_seats import BearingSeat, seat_of
from ilmek.machines.shedding.params import NO_DWELL, SheddingParams
from ilmek.machines.shedding.phases import Shed, chosen_shed
from ilmek.machines.shedding.stack import POINTS, CamStack, PitchShares, filled, stack_of
from ilmek.num.piecewise import Extremum, supremum
from ilmek.records import computed, record, result
from ilmek.units import mm


@record
class SheddingDrive:
    """The drive of a shaft: its torque over the turn, its reducer and its motor.

    motor        None where its torque is given
    motor_limit  continuous torque of the motor; where none is strong enough, the most that any gives at that speed
    duty         of the motor over a turn, the stack's inertia included; None without a motor of the table
    """

    torque_max: Extremum
    torque_min: Extremum
    torque_rms: float = result("Nm", "root mean square of the shaft's torque over the turn")
    reducer: Reducer
    motor_torque: float = result("Nm", "required torque of the motor")
    motor_speed: float = result("rpm", "speed of the motor")
    motor: Motor | None
    motor_limit: float
    duty: MotorDuty | None

    shaft_torque_max = computed("Nm", "largest torque that lifts the warps", lambda it: it.torque_max.value)
    shaft_torque_min = computed("Nm", "largest torque of the warps on the return", lambda it: it.torque_min.value)
    motor_power = computed("W", "largest power of the motor", lambda it: it.motor_torque * it.motor_speed)

    @computed(
        "", "class of motor chosen; the strongest where none is enough", name="motor", absent="its torque is given"
    )
    def name(self) -> str | None:
        return self.motor.name if self.motor else None

    @computed("Nm", "rms of the motor's torque over the turn", absent="its torque is given")
    def motor_torque_rms(self) -> float | None:
        return self.duty.rms if self.duty else None

    @computed("W", "mean power, losses included", absent="its torque is given")
    def motor_power_mean(self) -> float | None:
        return self.duty.power_mean if self.duty else None

    @computed("1", "load over rotor inertia", absent="its torque is given")
    def inertia_ratio(self) -> float | None:
        return self.duty.inertia_ratio if self.duty else None


@record
class CamShaft:
    """One of the cam shafts.

    params      of this shaft: lift, spans and warps are its own, the pitch is that of all warps
    beyond       distance beyond the first shaft, along the warps [m]     numbers  of its even and odd warps
    even, odd   programmes of the two parities over the shaft's angle; of staggered cams those of the middle
    shed        all groups of cams, as they are fixed on the shaft
    across_max  largest force of the lifted warps across the shaft [N]
    window      shaft angles between which the even shed is open for the shuttle [rad]
    """

    params: SheddingParams
    beyond: float
    numbers: tuple[int, int]
    cam: PlateCam
    smallest_prime: Extremum
    even: CamProgramme
    odd: CamProgramme
    shed: Shed
    across_max: Extremum
    stack: CamStack
    shaft: SquareShaft
    drive: SheddingDrive
    window: tuple[float, float]

    @property
    def prime_radius_for_bore(self) -> float:
        """Smallest prime radius that leaves the wall outside the corners of the square bore [m]."""
        return _for_bore(self.params, self.shaft.bar)

    @property
    def base_radius(self) -> float:
        """Radius on which the warps at rest lie [m]."""
        return self.cam.prime_radius - self.cam.roller_radius

    @property
    def seat(self) -> BearingSeat:
        """A bearing of the shaft on the frame's bracket."""
        return seat_of(self.shaft.seat.bearing, self.shaft.seat.reaction)

    @property
    def driven_end(self) -> KeyedEnd:
        """The end of the shaft in its reducer, with its key: it bears the torque with the safety."""
        return keyed_end(self.seat.bearing.bore, self.shaft.torque, self.params.strength)

    @property
    def screws_inside(self) -> float:
        """Diameter within which the screws of the bearings leave room [m]."""
        screw = self.seat.screws.screw
        return float(2 * abs(self.seat.corners()[0])) - max(screw.across, screw.washer[0]) - 2 * mm

    @property
    def nut(self) -> Locknut:
        """The nut that clamps the cams at each end of the bar."""
        return locknut_for(self.shaft.bar, self.screws_inside)

    @property
    def beyond_cams(self) -> float:
        """From the end of the cams to the inner side of a bearing [m]: ring, washer, nut, room for the screws."""
        nut, room = self.nut, self.seat.screw_room
        clamped = RING + nut.washer + nut.width + nut.pitch
        return max(RING + room, clamped + (room if nut.outer > self.screws_inside else 0.0))

    @property
    def friction_torque(self) -> float:
        """Torque that the clamped neighbours of a cam hold on it by friction, both at the bar's side at least [N m]."""
        return 2 * STACK_FRICTION * self.nut.tightened * self.shaft.bar / 2

    def cam_torque(self) -> float:
        """Largest torque of the warp on a cam [N m]."""
        angle = np.linspace(0.0, self.params.rise, _NOSE)
        motion = self.even.at(angle)
        return float(np.max(self.shed.force(motion.s) * motion.ds))

    @property
    def reach(self) -> float:
        """Half of the length of the warps' line that the guides, and the gap beside them, take up [m]."""
        return math.sqrt(self.stack.guide_radius**2 - self.base_radius**2) + self.params.shaft_gap

    def buckling(self) -> tuple[float, float]:
        """Force on the tip where the nose is nearest to buckling, and the force at which it buckles there [N]."""
        angle = np.linspace(0.0, self.params.rise, _NOSE)
        cosine = np.cos(self.cam.pressure_angle(angle))
        force = self.shed.force(self.even.at(angle).s) / cosine
        critical = np.asarray(
            nose_buckling(self.stack.thickness, self.params.lift, cosine, self.params.modulus), dtype=float
        )
        worst = int(np.argmax(force / critical))
        return float(force[worst]), float(critical[worst])


_NOSE = 91

RING, STACK_FRICTION = 15 * mm, 0.1
"""Thickness of the rings at the ends of the cams [m], and friction of oiled sheets; assumed by this project."""

LARGEST_PRIME = 1.0
"""Largest prime radius that is tried for the bore [m]."""


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


def smallest_prime(params: SheddingParams) -> Extremum:
    """The smallest prime radius for the pressure angle [m], and its cam angle."""
    allowed = params.pressure_angle_limit
    return pressure_prime(lifting(params), CamLimits(allowed, allowed))


def cam_shaft(params: SheddingParams, numbers: tuple[int, int], shares: PitchShares, beyond: float = 0.0) -> CamShaft:
    """A cam shaft with so many even and odd warps, for its own parameters. Raises ParameterError as `PlateCam`."""
    loads, cams = _loads(replace(params, speed=_ANY_SPEED), numbers), sum(numbers)
    smallest, across, shed = loads.smallest, loads.across, replace(loads.shed, params=params)
    torque = max(loads.peaks[0].value, -loads.peaks[1].value)
    first = params.prime_radius or max(smallest.value, least_prime(params))
    cam = PlateCam(loads.even, first, roller_radius=params.roller_radius)
    bar, length = least_bar(params), params.shaft_length or cams * shares.pitch
    while True:
        mass, inertia = filled(params, cam, shares, cams, bar)
        shaft = square_shaft(_shaft_task(params, length, mass, across.value, torque))
        if shaft.bar > bar:  # a thicker bar fills more of the last guide cam: grams
            bar = shaft.bar
            continue
        least = _for_bore(params, shaft.bar)
        if params.prime_radius is not None or cam.prime_radius >= least or least > LARGEST_PRIME:
            break
        cam = cam.resized(math.ceil(least / mm - _ROUNDING) * mm)
    return CamShaft(
        params=params,
        beyond=beyond,
        numbers=numbers,
        cam=cam,
        smallest_prime=smallest,
        even=loads.even,
        odd=loads.even.shifted(TURN / 2),
        shed=shed,
        across_max=across,
        stack=stack_of(params, cam, shares, cams, bar),
        shaft=shaft,
        drive=_drive(params, shed, loads, inertia),
        window=loads.window,
    )


@record
class _Loads:
    """What the warps do to a shaft, whatever its speed: programme, shed, torque, force across it, window."""

    even: CamProgramme
    smallest: Extremum
    shed: Shed
    peaks: tuple[Extremum, Extremum]
    rms: float
    across: Extremum
    window: tuple[float, float]


@lru_cache(maxsize=16)
def _loads(params: SheddingParams, numbers: tuple[int, int]) -> _Loads:
    """Loads by the warps; a loom designs the same cams at several speeds: the last ones are kept."""
    even = lifting(params)
    shed = chosen_shed(params, even, numbers)
    across = supremum(shed.across, shed.knots)
    return _Loads(even, smallest_prime(params), shed, shed.peaks(), shed.rms(), across, shed.window())


_ANY_SPEED = 1.0


_ROUNDING = 1e-9


def least_prime(params: SheddingParams) -> float:
    """Prime radius that the bore of the smallest bar of stock, or of a given one, needs [m], in whole millimetres."""
    return math.ceil(_for_bore(params, least_bar(params)) / mm - _ROUNDING) * mm


def least_bar(params: SheddingParams) -> float:
    """The smallest bar of stock, or the given one [m]."""
    return params.shaft_bar or LEAST_BAR


def _for_bore(params: SheddingParams, bar: float) -> float:
    return bar / math.sqrt(2) + params.bore_wall + params.roller_radius


def of_shaft(params: SheddingParams, beyond: float, last: float, number: int) -> SheddingParams:
    """The parameters of a shaft at a distance beyond the first one, the last one at `last` [m], for its warps.

    The warps of all shafts open one line from the fell on: the lift is in proportion to the distance from it. Without
    spans the lift is that of the first.
    """
    spans, prime = params.spans_of_warp, params.prime_radius
    own = replace(
        params,
        shafts=None,
        cam_thickness=None,
        cloth=replace(params.cloth, warps=max(number, 2)),
        stagger_groups=max(min(params.stagger_groups, number // 2), 1),
    )
    if spans is None:
        return own
    front, back = spans
    higher = min((front + beyond) / front, HIGHEST_LIFT / params.lift)
    return replace(
        own,
        lift=params.lift * higher,
        prime_radius=None if prime is None else min(prime * higher, _LARGEST_PRIME),
        half_span=None,
        front_span=min(front + beyond, _LONGEST),
        back_span=min(back + last - beyond, _LONGEST),
        warp_length=None if params.warp_length is None else max(params.warp_length, front + back + last),
    )


HIGHEST_LIFT, _LARGEST_PRIME, _LONGEST = 1.0, 2.0, 10.0
"""Bounds of the parameters of a shaft [m]."""


def _shaft_task(params: SheddingParams, length: float, mass: float, across: float, torque: float) -> SquareShaftTask:
    """The shaft's task: its length [m], the stack's mass with filled bores [kg], the warps' pull [N], torque [N m]."""
    return SquareShaftTask(
        length=length,
        spans=params.spans,
        speed=params.speed,
        mass=mass,
        pull=across,
        pull_angle=params.pull_angle,
        torque=torque,
        load=params.shaft_load,
        safety=params.safety,
        modulus=params.modulus,
        strength=params.strength,
        tensile=params.tensile,
        slope=params.slope_limit,
        deflection=params.deflection_limit,
        twist=params.twist_limit,
        bar=params.shaft_bar,
        bearing=params.bearing,
        bearing_life=params.bearing_life,
    )


def _drive(params: SheddingParams, shed: Shed, loads: _Loads, inertia: float) -> SheddingDrive:
    """Torque over the turn, and the motor with its reducer, the inertia of the stack [kg m^2] included.

    The shaft starts and stops with the shed closed, when no warp loads it: its motor then bears J w / t alone.
    """
    (most, least), rms = loads.peaks, loads.rms
    reducer = Reducer(params.ratio, params.efficiency)
    # Falling warps drive the cams: the motor brakes what the reducer's friction leaves.
    braking = -least.value * max(reducer.back_driving_efficiency, 0.0) / params.ratio
    starting = 0.0 if params.stop_time is None else inertia * params.speed / params.stop_time
    needed = max(reducer.motor_torque(max(most.value, starting)), braking, 0.0)
    speed = params.speed * params.ratio
    if params.motor_torque is not None:
        return SheddingDrive(most, least, rms, reducer, needed, speed, None, params.motor_torque, None)
    enough = smallest_motor(needed, speed)
    motor, limit = (enough, enough.torque) if enough else (strongest_motor(speed), most_torque(speed))
    angle = np.arange(POINTS) * (TURN / POINTS)
    cycle = LoadCycle(np.full_like(angle, params.speed), np.zeros_like(angle), shed.torque(angle), inertia)
    return SheddingDrive(most, least, rms, reducer, needed, speed, motor, limit, duty(cycle, motor, reducer))
