"""Shedding cams: one cam per warp, opposed for odd and even warps, on a square shaft.     [thesis, chapter 3.2]

Each cam lifts its warp by the programme rise, dwell, fall, rest; the cams of the odd warps are the same, half a turn
later. Between the cams stand guide cams (round, higher than the nose), which fill the rest of the pitch and keep the
warps apart. A warp drawn taut over the cam presses with F across the cam's axis: the given force, or, from its tension
T over the half span H, F = 2 T s / sqrt(s^2 + H^2). The speed is low: the torque is that of the warps alone,

    M(theta) = n_even F(s_even) s'_even + n_odd F(s_odd) s'_odd

so that with the usual opposed cams only half of the warps ever load the shaft (the thesis takes all 600). Cams of a
parity that are staggered: `phases`; tension and force of a warp: `warp`.
"""

import math
from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, jumps, rise
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements.duty import LoadCycle, MotorDuty, duty
from ilmek.elements.motors import NO_MOTOR, Motor, Reducer, most_torque, smallest_motor
from ilmek.elements.square_shaft import SquareShaft, SquareShaftTask, square_shaft
from ilmek.machines.shedding.params import NO_DWELL, SheddingParams
from ilmek.machines.shedding.phases import Shed, chosen_shed
from ilmek.machines.shedding.warp import lifting_work
from ilmek.num.piecewise import Extremum, supremum
from ilmek.plane.contours import polygon_moments
from ilmek.records import computed, record, result
from ilmek.report import Json


@record
class CamStack:
    """The cams on the shaft; cams and guide cams are weighed bored, the stack with the shaft in its bores."""

    thickness: float = result("mm", "thickness of a cam", name="cam_thickness", least=0.0)
    guide_thickness: float = result("mm", "thickness of a guide cam: the rest of the pitch", least=0.0)
    guide_radius: float = result("mm", "radius of a guide cam", least=0.0)
    cam_mass: float = result("kg", "mass of a cam, bored")
    guide_mass: float = result("kg", "mass of a guide cam, bored")
    mass: float = result("kg", "mass of all cams, guide cams and the shaft between them")
    inertia: float = result("kg*m^2", "moment of inertia of all these about the shaft")


@record
class SheddingDrive:
    """The drive of the shaft: its torque over the turn, its reducer and its motor.

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
    name = computed(
        "",
        "class of motor chosen",
        lambda it: it.motor.name if it.motor else None,
        name="motor",
        absent=NO_MOTOR,
    )
    motor_torque_rms = computed(
        "Nm", "rms of the motor's torque over the turn", lambda it: it.duty.rms if it.duty else None, absent=NO_MOTOR
    )
    motor_power_mean = computed(
        "W", "mean power, losses included", lambda it: it.duty.power_mean if it.duty else None, absent=NO_MOTOR
    )
    inertia_ratio = computed(
        "1", "load over rotor inertia", lambda it: it.duty.inertia_ratio if it.duty else None, absent=NO_MOTOR
    )


@record
class SheddingDesign:
    """The design of shedding cams.

    even, odd   programmes of the two parities over the shaft's angle; of staggered cams those of the middle
    shed        all groups of cams, as they are fixed on the shaft
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
    shaft: SquareShaft
    drive: SheddingDrive
    shuttle_window: tuple[float, float]

    prime_radius = computed("mm", "prime radius of the cam, Rp", lambda it: it.cam.prime_radius, least=0.0)
    prime_radius_min = computed("mm", "smallest for the pressure angle", lambda it: it.smallest_prime.value)
    prime_radius_for_bore = computed(
        "mm",
        "smallest that leaves the wall outside the corners of the square bore",
        lambda it: it.shaft.bar / math.sqrt(2) + it.params.bore_wall + it.cam.roller_radius,
    )
    pressure_angle_max = computed("deg", "largest pressure angle", lambda it: limits.pressure_angle_max(it.cam).value)
    pressure_angle_at = computed("deg", "cam angle of that maximum", lambda it: limits.pressure_angle_max(it.cam).at)
    curvature_radius_min = computed(
        "mm", "least convex radius of the pitch curve", lambda it: limits.convex_radius_min(it.cam).value
    )

    @computed("mm", "least concave radius of the pitch curve", absent="it is convex all round")
    def concave_radius_min(self) -> float | None:
        hollow = limits.concave_radius_min(self.cam)
        return hollow.value if hollow else None

    cam_area = computed("cm^2", "area inside the cam's surface, bore included", lambda it: limits.area(it.cam))

    shed_opening = computed("mm", "largest distance of even and odd warps", lambda it: it.peak(it.shed.opening))
    shuttle_start = computed("deg", "shaft angle at which the even shed opens", lambda it: it.shuttle_window[0])
    shuttle_end = computed(
        "deg", "shaft angle at which it closes; the odd shed follows half a turn later", lambda it: it.shuttle_window[1]
    )
    shuttle_window_angle = computed(
        "deg",
        "shaft angle for which a shed is open for the shuttle",
        lambda it: it.shuttle_window[1] - it.shuttle_window[0],
        name="shuttle_window",
    )
    shuttle_time = computed("s", "time that each shed is open", lambda it: it.shuttle_window_angle / it.params.speed)
    turn_time = computed("s", "time of a turn: two sheds", lambda it: TURN / it.params.speed)
    phase_groups = computed("1", "groups of each parity's cams, staggered", lambda it: it.shed.groups)
    phase_spread = computed("deg", "angle from the first group to the last", lambda it: it.shed.spread)
    shed_overlap = computed(
        "deg",
        "angle for which one parity falls while the other rises, at each change of the shed",
        lambda it: max(0.0, it.params.lifted_angle + it.shed.spread - TURN / 2),
    )
    velocity_max = computed(
        "mm/s", "largest warp velocity", lambda it: it.params.speed * it.peak(lambda q: it.even.at(q).ds)
    )
    acceleration_max = computed(
        "mm/s^2", "largest warp acceleration", lambda it: it.params.speed**2 * it.peak(lambda q: it.even.at(q).dds)
    )
    acceleration_jumps = computed(
        "",
        "jumps of the acceleration of the even warps, shaft angle [rad]",
        lambda it: [{"angle": jump.angle, "place": jump.where} for jump in jumps(it.even)],
    )
    shaft_supports = computed("1", "supports of the shaft, both ends included", lambda it: it.params.spans + 1)
    warps_across = computed("N", "largest force of the lifted warps across the shaft", lambda it: it.across_max.value)
    power_max = computed("W", "largest power of the shaft", lambda it: it.drive.shaft_torque_max * it.params.speed)
    shed_work = computed(
        "J",
        "work of lifting the even warps once, returned when they fall",
        lambda it: float(it.params.warps // 2 * lifting_work(it.params)),
    )

    @computed("", "the cycle of even and odd warps, shaft angles [rad]")
    def phases(self) -> Json:
        names = ("warps", "phase", "start", "end")
        return [dict(zip(names, phase, strict=True)) for phase in self.cycle_phases]

    @property
    def cycle_phases(self) -> tuple[tuple[str, str, float, float], ...]:
        """Parity, phase, first and last shaft angle [rad] of each part of the turn; odd ones may exceed a turn."""
        return tuple(
            (parity, segment.name, float(programme.start + begin), float(programme.start + begin + segment.span))
            for parity, programme in (("even", self.even), ("odd", self.odd))
            for begin, segment in zip(programme.edges, programme.segments, strict=False)
        )

    def peak(self, function: Callable[[FloatArray], FloatArray]) -> float:
        """Largest magnitude over the turn of a function of the shaft's angle."""
        return supremum(lambda angle: np.abs(function(angle)), self.shed.knots).value


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
    _, polar = polygon_moments(cam.surface(np.arange(_POINTS) * (TURN / _POINTS))[::-1])
    areas = limits.area(cam), math.pi * guide_radius**2
    mass, inertia = (
        params.warps * params.density * sum(part * thick for part, thick in zip(parts, thicknesses, strict=True))
        for parts in (areas, (polar, math.pi / 2 * guide_radius**4))
    )
    shed = chosen_shed(params, even)
    drive = _drive(params, shed, inertia)
    across = supremum(shed.across, shed.knots)
    torque = max(drive.torque_max.value, -drive.torque_min.value)
    shaft = square_shaft(_shaft_task(params, mass, across.value, torque))
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


_POINTS = 1440


def _shaft_task(params: SheddingParams, mass: float, across: float, torque: float) -> SquareShaftTask:
    """The shaft's task: the mass [kg] of the stack, bores filled, the pull of the warps [N], their torque [N m]."""
    return SquareShaftTask(
        length=params.shaft_length or params.warps * params.warp_pitch,
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


def _drive(params: SheddingParams, shed: Shed, inertia: float) -> SheddingDrive:
    """Torque over the turn, and the motor with its reducer, the inertia of the stack [kg m^2] included."""
    most, least = shed.peaks()
    rms = shed.rms()
    reducer = Reducer(params.ratio, params.efficiency)
    # Falling warps drive the cams: the motor brakes what the reducer's friction leaves.
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
