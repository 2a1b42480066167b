"""The smallest plate cam for a pressure angle, with its loads by spring or groove, and the drive of its shaft.

A lever, or a rack and pinion, connects the cam's follower to a tool: the follower moves s = x/i, and a mass m of the
tool counts as i² m at the follower. A part that rotates in one direction only is driven forward through a freewheel, a
brake stops it, and the rack returns while it is at rest. With the speed w of the cam shaft, the required force on the
follower is

    F = m w² s'' + b + k s + P + load        b of the brake during the motion forward: sup m w² |s''|

The load is what the tool's work takes, i times the force on the tool (virtual work), positive against the lift.

The contact force is N = F / cos(mu), the torque F s'. The spring is the weakest one whose force doubles over the lift
and that presses the follower on the cam with a force, up to 1.2 times the speed; a groove requires none. Prime circle
and forces are maxima over samples every 1/8 degree and on both sides of every joint of the motion.

The torque of the shaft is the sum of F s' of all cams. At constant speed its mean over a turn is the torque of brakes
and loads. Friction is not included.          [derived from the equation of motion of the follower and virtual power]
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.figures import sample_angles
from ilmek.cams.hertz import contact_modulus, line_contact
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion
from ilmek.cams.trace import CamTrace
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import MATERIALS, hertz_limit
from ilmek.elements.motors import NO_MOTOR
from ilmek.plane.contours import polygon_moments
from ilmek.records import computed, record, result
from ilmek.units import mm, turn

SAMPLES, DRIVE_SAMPLES = 2881, 2880
STEEL, ROLLER = MATERIALS["induction-hardened steel"], MATERIALS["bearing steel"]
PRESSURE_LIMIT = hertz_limit(STEEL, ROLLER) or 0.0
MODULUS = contact_modulus(STEEL.modulus, STEEL.poisson, ROLLER.modulus, ROLLER.poisson)

FASTER = 1.2
"""Speed up to which a spring keeps its follower on the cam, over the speed of the cam."""

ROOM = 1.25
"""Least radius of curvature of a pitch curve over its roller's radius."""

WALL = 5 * mm
"""Least metal between the bore's keyway and the cam's surface."""

_FIT = 1e-9


@record
class LoadedPlateCam:
    """A sized and loaded plate cam.

    name, actuator   what it moves, through what    ratio    i: the tool's motion [m, rad] over the follower's [m]
    programme, cam   of the follower            lift     of the follower [m]
    angle, motion, trace  over the turn         mass_moved  at the follower, forward and back [kg]
    rate, preload    of the spring [N/m, N]     brake    on what it moves forward [N]
    load             of the tool's work over the turn, against the lift [N]
    force, contact   F and N over the turn [N]  pressure Hertz, over the turn [Pa]
    lift_off         speed of the shaft at which the follower would leave the cam [rad/s]
    area [m²]        of the face without bore   inertia  about the axis [kg m²]      speed  of the shaft [rad/s]
    """

    name: str
    actuator: str
    ratio: float
    programme: CamProgramme
    cam: PlateCam
    lift: float
    angle: FloatArray
    motion: FollowerMotion
    trace: CamTrace
    mass_moved: tuple[float, float]
    rate: float
    preload: float
    brake: float
    load: FloatArray
    force: FloatArray
    contact: FloatArray
    pressure: FloatArray
    lift_off: float
    area: float
    inertia: float
    thickness: float
    speed: float

    @property
    def torque(self) -> FloatArray:
        """Torque on the cam shaft over the turn [N m]."""
        return np.asarray(self.force * self.motion.ds)

    @property
    def inertial_torque(self) -> FloatArray:
        """Torque on the cam shaft that is proportional to its speed squared, of masses and brake [N m]."""
        forward, back = self.mass_moved
        need = np.where(self.motion.ds >= 0, forward, back) * self.speed**2 * self.motion.dds
        return np.asarray((need + self.brake * (self.motion.ds > 0)) * self.motion.ds)

    @property
    def pressure_angle(self) -> float:
        """Largest pressure angle [rad]."""
        return float(np.max(np.abs(self.trace.pressure_angle)))

    @property
    def contact_max(self) -> float:
        """Greatest force of the roller on the cam [N]."""
        return float(self.contact.max())

    @property
    def pressure_max(self) -> float:
        """Greatest Hertz pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def convex_radius(self) -> float:
        """Least radius of curvature of the pitch curve where it is convex [m]."""
        return _convex_radius(self.trace)

    @property
    def concave_radius(self) -> float:
        """Least radius of curvature of the pitch curve where it is concave [m]; inf where it is convex all round."""
        hollow = float(np.min(self.trace.curvature))
        return -1 / hollow if hollow < 0 else math.inf

    @property
    def spare_acceleration(self) -> float:
        """Acceleration of the follower that errors of the profile may add [m/s²]: it stays on, within the pressure."""
        forward, back = self.mass_moved
        mass = np.where(self.motion.ds >= 0, forward, back)
        loaded = self.contact > 0  # without a force nothing says how far the pressure may rise
        more = np.full_like(self.contact, np.inf)
        more[loaded] = self.contact[loaded] * ((PRESSURE_LIMIT / self.pressure[loaded]) ** 2 - 1)
        more *= np.cos(self.trace.pressure_angle)
        room = np.minimum(self.force, more) if self.preload > 0 else more
        return max(0.0, float(np.min(room / mass)))

    @property
    def undercut(self) -> bool:
        """Whether no surface can guide the roller."""
        return self.convex_radius <= self.cam.roller_radius

    @property
    def radius(self) -> float:
        """Largest radius of the cam [m]."""
        return float(np.max(np.abs(self.trace.surface)))


@record
class PlateCamTask:
    """What a sprung or grooved plate cam moves, and its limits.

    speed        of the cam shaft [rad/s]                     mass     at the follower, forward and back [kg]
    braked       whether a brake holds the forward mass       closure  "spring", doubling over the lift, or "groove"
    contact_force  least of a sprung roller [N]               pressure_angle  largest [rad]
    shaft        its diameter [m]          roller_radius, roller_width, thickness   of the roller and of the plate [m]
    load         force on the follower against its lift [N] at angles of the shaft [rad]; default: none
    """

    speed: float
    mass: tuple[float, float]
    braked: bool
    closure: str
    contact_force: float
    pressure_angle: float
    shaft: float
    roller_radius: float
    roller_width: float
    thickness: float
    load: Callable[[FloatArray], FloatArray] | None = None


def loaded_plate_cam(
    name: str, actuator: str, ratio: float, programme: CamProgramme, task: PlateCamTask
) -> LoadedPlateCam:
    """The smallest cam for a task, and its loads; name, actuator, ratio: see `LoadedPlateCam`.

    programme  of the follower [m, rad]      task  masses [kg], loads [N] and limits, see `PlateCamTask`
    """
    angle, speed, (forward, back) = sample_angles(programme, count=SAMPLES), task.speed, task.mass
    motion = programme.at(angle)
    lift = float(np.max(motion.s))
    cam, trace = _sized(task, programme, angle, motion)
    need = np.where(motion.ds >= 0, forward, back) * speed**2 * motion.dds
    brake = float(np.max(forward * speed**2 * np.abs(motion.dds[motion.ds > 0]), initial=0.0)) if task.braked else 0.0
    need = need + brake * (motion.ds > 0)
    load = np.zeros(angle.shape) if task.load is None else task.load(angle)
    weight = 1 + motion.s / lift
    preload = _preload(task, np.minimum(need, 0.0) * FASTER**2 + load, weight)  # at every speed from 0 on
    force = need + load + preload * weight
    contact = np.abs(force) / np.cos(trace.pressure_angle)
    width = min(task.roller_width, task.thickness)
    pressure = line_contact(contact / width, 1 / task.roller_radius + trace.surface_curvature, MODULUS).pressure
    area, polar = polygon_moments(trace.surface[::-1])
    return LoadedPlateCam(
        name=name,
        actuator=actuator,
        ratio=ratio,
        programme=programme,
        cam=cam,
        lift=lift,
        angle=angle,
        motion=motion,
        trace=trace,
        mass_moved=task.mass,
        rate=preload / lift,
        preload=preload,
        brake=brake,
        load=load,
        force=force,
        contact=contact,
        pressure=pressure,
        lift_off=_lift_off(task, need / speed**2, preload * weight + load),
        area=area,
        inertia=polar * task.thickness * STEEL.density,
        thickness=task.thickness,
        speed=speed,
    )


def _sized(
    task: PlateCamTask, programme: CamProgramme, angle: FloatArray, motion: FollowerMotion
) -> tuple[PlateCam, CamTrace]:
    """The cam on the least whole millimetre of prime radius that keeps pressure angle, bore and roller."""
    slope = math.tan(task.pressure_angle)
    hub = 0.7 * task.shaft + WALL + task.roller_radius
    least = max(float(np.max(np.abs(motion.ds) / slope - motion.s)), hub)
    cam = PlateCam(programme, math.ceil(least / mm - _FIT) * mm, 0.0, task.roller_radius)
    trace = cam.trace_of(angle, motion)
    while _convex_radius(trace) < ROOM * task.roller_radius:
        cam = cam.resized(cam.prime_radius + max(1.0, math.floor(0.05 * cam.prime_radius / mm)) * mm)
        trace = cam.trace_of(angle, motion)
    return cam, trace


def _convex_radius(trace: CamTrace) -> float:
    sharpest = float(np.max(trace.curvature))
    return 1 / sharpest if sharpest > 0 else math.inf


def _preload(task: PlateCamTask, need: FloatArray, weight: FloatArray) -> float:
    """Preload of the spring whose force doubles over the lift [N]: sup (c - need) / (1 + s / lift); 0 for a groove."""
    return max(0.0, float(np.max((task.contact_force - need) / weight))) if task.closure == "spring" else 0.0


def _lift_off(task: PlateCamTask, need: FloatArray, hold: FloatArray) -> float:
    """Speed of the shaft [rad/s] at which the follower leaves the cam: 1 / w² = sup -need / hold."""
    if task.closure != "spring":
        return math.inf
    greatest = float(np.max(-need / np.maximum(hold, _FIT)))
    return 1 / math.sqrt(greatest) if greatest > 0 else math.inf


def torque_at(cams: Sequence[LoadedPlateCam], angle: FloatArray) -> FloatArray:
    """Torque of all cams together [N m] at cam angles [rad].

    angle  any shape, the shape of the result
    """
    total = np.zeros(angle.shape)
    for cam in cams:
        total += np.interp(angle, cam.angle, cam.torque, period=TURN)
    return total


def _of_servo(unit: str, doc: str, value: Callable[[ServoDrive], Any]) -> Any:
    return computed(unit, doc, lambda it: it.servo and value(it.servo), absent=NO_MOTOR)


@record
class CamShaftDrive:
    """The cam shaft's drive: `servo` of least power whose motor bears the turn; None where none does."""

    torque_max: float = result("Nm", "greatest torque of all cams on their shaft", name="cam_torque_max")
    torque_rms: float = result("Nm", "root mean square of the same", name="cam_torque_rms")
    power_max: float = result("W", "greatest power of the same, in both directions", name="cam_power_max")
    power_mean: float = result("W", "mean power, of brakes and loads", name="cam_power_mean")
    inertia: float = result("kg*m^2", "moment of inertia of the cams", name="cam_inertia")
    servo: ServoDrive | None

    motor = _of_servo("", "class of motor of the cam shaft", lambda servo: servo.motor.name)
    ratio = _of_servo("1", "ratio of its reducer", lambda servo: servo.reducer.ratio)
    motor_torque_peak = _of_servo("Nm", "greatest torque of the motor", lambda servo: servo.duty.peak)
    motor_torque_rms = _of_servo("Nm", "root mean square of the same", lambda servo: servo.duty.rms)
    motor_inertia_ratio = _of_servo(
        "1", "inertia of the cams at the motor over its rotor's", lambda servo: servo.duty.inertia_ratio
    )


def drive_for(cams: Sequence[LoadedPlateCam], speed: float, belt: float = 1.0) -> CamShaftDrive:
    """The drive of a cam shaft with these cams at a speed [rad/s].

    belt  ratio of a belt between reducer and shaft; default: the reducer is on it
    """
    angle = np.arange(DRIVE_SAMPLES) * (turn / DRIVE_SAMPLES)
    torque = torque_at(cams, angle)
    most, inertia = float(np.max(np.abs(torque))), sum(cam.inertia for cam in cams)
    turning, still = np.full(DRIVE_SAMPLES, belt * speed), np.zeros(DRIVE_SAMPLES)
    cycle = LoadCycle(turning, still, torque / belt, inertia / belt**2)
    return CamShaftDrive(
        torque_max=most,
        torque_rms=math.sqrt(float(np.mean(torque**2))),
        power_max=most * speed,
        power_mean=float(np.mean(torque)) * speed,
        inertia=inertia,
        servo=_smallest(cycle),
    )


def _smallest(cycle: LoadCycle) -> ServoDrive | None:
    """The motor of least power, with the least ratio at which it bears the cycle."""
    return size_motor(cycle, best=lambda drive: drive.reducer.ratio)
