"""The head's cams: a plate cam for every track, as small as the pressure angle allows, its loads, the shaft's drive.

A lever, or for the handler a rack and pinion, stands between a cam's follower and its tool: the follower moves s = x/i,
and the tool's mass m counts i² m there. The handler turns in one direction only: its rack drives it forward through a
freewheel, a brake keeps it from running on, and the rack returns while it stands. With w the speed of the cam shaft the
follower needs

    F = m w² s'' + b + k s + P + load        b of the brake while the handler turns forward: sup m w² |s''|

and presses with N = F / cos(mu) on the cam, at the torque F s'. The spring is the weakest of those whose force doubles
over the lift that holds the follower at 1.2 times the speed; a groove needs none. Prime circle and forces are the
largest of samples every 1/8 degree and at both sides of every joint of the motion.

The torque of the shaft is the sum of F s' of all cams. At constant speed its mean over a turn is the torque of the
handler's brake. Friction is not included.
"""

import math
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.figures import sample_angles
from ilmek.cams.hertz import contact_modulus, line_contact
from ilmek.cams.laws import LAWS
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, CamSegment, FollowerMotion, dwell
from ilmek.cams.trace import CamTrace
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import MATERIALS, hertz_limit
from ilmek.elements.reducers import DIRECT, PLANETARY
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.params import WeaverParams
from ilmek.plane.vectors import cross, dot
from ilmek.records import computed, record, result
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import Track
from ilmek.units import mm, turn

SAMPLES, DRIVE_SAMPLES = 2881, 2880
STEEL, ROLLER = MATERIALS["induction-hardened steel"], MATERIALS["bearing steel"]
PRESSURE_LIMIT = hertz_limit(STEEL, ROLLER) or 0.0
MODULUS = contact_modulus(STEEL.modulus, STEEL.poisson, ROLLER.modulus, ROLLER.poisson)

FASTER = 1.2
"""Speed up to which a spring holds its follower, over the head's."""

ROOM = 1.25
"""Least radius of curvature of a pitch curve over its roller's radius."""

WALL = 5 * mm
"""Least metal between the bore's keyway and the cam's surface."""

_FIT = 1e-9
_REST = 0.03
"""Share of the rest of the turn for which the rack stands before and after its return."""


@record
class HeadCam:
    """A cam of the head.

    name, actuator   of its track               ratio    i: the tool's motion [m, rad] over the follower's [m]
    programme, cam   of the follower            lift     of the follower [m]
    angle, motion, trace  over the turn         mass_moved  at the follower, forward and back [kg]
    rate, preload    of the spring [N/m, N]     brake    on the handler, at its rack [N]
    force, contact   F and N over the turn [N]  pressure Hertz, over the turn [Pa]
    lift_off         speed of the shaft at which the follower would leave the cam [rad/s]
    area [m²]        of the face without bore   inertia  about the axis [kg m²]
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
    force: FloatArray
    contact: FloatArray
    pressure: FloatArray
    lift_off: float
    area: float
    inertia: float
    thickness: float

    @property
    def torque(self) -> FloatArray:
        """Torque on the cam shaft over the turn [N m]."""
        return np.asarray(self.force * self.motion.ds)

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
    def undercut(self) -> bool:
        """Whether no surface can guide the roller."""
        return self.convex_radius <= self.cam.roller_radius

    @property
    def radius(self) -> float:
        """Largest radius of the cam [m]."""
        return float(np.max(np.abs(self.trace.surface)))

    @property
    def mass(self) -> float:
        """Mass of the plate, its bore filled by the shaft [kg]."""
        return self.area * self.thickness * STEEL.density


def cams_for(params: WeaverParams, cyclogram: Cyclogram, handler_radius: float) -> tuple[HeadCam, ...]:
    """The cams of a head, one for each track."""
    return tuple(_cam_for(params, track, cyclogram.speed, handler_radius) for track in cyclogram.tracks)


def programme_of(track: Track, ratio: float) -> CamProgramme:
    """The follower's programme over the turn, from its lowest position on; the rack of a tool that turns on returns.

    ratio  the tool's motion over the follower's
    """
    parts: list[CamSegment] = []
    at = 0.0
    for part in track.segments:
        parts += _still(part.start - at)
        change = (part.finish - part.begin) / ratio
        parts.append(CamSegment(part.name, part.end - part.start, change, LAWS[part.law.name]))
        at = part.end
    left = sum(part.change for part in parts)
    if abs(left) > _FIT:
        gap = _REST * (turn - at)
        parts += [*_still(gap), CamSegment("back", turn - at - 2 * gap, -left, LAWS[track.segments[0].law.name])]
        at = turn - gap
    parts += _still(turn - at)
    bases = np.cumsum([0.0, *(part.change for part in parts[:-1])])
    first = int(np.argmin(np.round(bases / _FIT)))
    start = sum(part.span for part in parts[:first])
    return CamProgramme((*parts[first:], *parts[:first]), float(start))


def _still(span: float) -> list[CamSegment]:
    return [dwell(span)] if span > _FIT else []


def _cam_for(params: WeaverParams, track: Track, speed: float, handler_radius: float) -> HeadCam:
    turns = track.name == HANDLER
    ratio = 1 / params.pinion if turns else params.lever
    programme = programme_of(track, ratio)
    angle = sample_angles(programme, count=SAMPLES)
    motion = programme.at(angle)
    lift = float(np.max(motion.s))
    cam, trace = _sized(params, programme, angle, motion)
    moved = params.tool_mass * ((handler_radius * ratio) ** 2 if turns else ratio**2)
    masses = (moved, params.tool_mass) if turns else (moved, moved)
    need = np.where(motion.ds >= 0, masses[0], masses[1]) * speed**2 * motion.dds
    brake = float(np.max(masses[0] * speed**2 * np.abs(motion.dds[motion.ds > 0]), initial=0.0)) if turns else 0.0
    need = need + brake * (motion.ds > 0)
    weight = 1 + motion.s / lift
    preload = _preload(params, need * FASTER**2, weight)
    force = need + (preload * weight + params.contact_force if params.closure == "spring" else 0.0)
    contact = np.abs(force) / np.cos(trace.pressure_angle)
    width = params.cam_thickness
    pressure = line_contact(contact / width, 1 / params.roller_radius + trace.surface_curvature, MODULUS).pressure
    area, inertia = _sections(trace)
    return HeadCam(
        name=track.name,
        actuator=track.actuator,
        ratio=ratio,
        programme=programme,
        cam=cam,
        lift=lift,
        angle=angle,
        motion=motion,
        trace=trace,
        mass_moved=masses,
        rate=preload / lift,
        preload=preload,
        brake=brake,
        force=force,
        contact=contact,
        pressure=pressure,
        lift_off=_lift_off(params, need / speed**2, preload * weight + params.contact_force),
        area=area,
        inertia=inertia * width * STEEL.density,
        thickness=width,
    )


def _sized(
    params: WeaverParams, programme: CamProgramme, angle: FloatArray, motion: FollowerMotion
) -> tuple[PlateCam, CamTrace]:
    """The cam on the least whole millimetre of prime radius that keeps pressure angle, bore and roller."""
    slope = math.tan(params.pressure_angle_limit)
    hub = 0.7 * params.shaft + WALL + params.roller_radius
    least = max(float(np.max(np.abs(motion.ds) / slope - motion.s)), hub)
    cam = PlateCam(programme, math.ceil(least / mm - _FIT) * mm, 0.0, params.roller_radius)
    trace = cam.trace_of(angle, motion)
    while _convex_radius(trace) < ROOM * params.roller_radius:
        cam = cam.resized(cam.prime_radius + max(1.0, math.floor(0.05 * cam.prime_radius / mm)) * mm)
        trace = cam.trace_of(angle, motion)
    return cam, trace


def _convex_radius(trace: CamTrace) -> float:
    sharpest = float(np.max(trace.curvature))
    return 1 / sharpest if sharpest > 0 else math.inf


def _preload(params: WeaverParams, need: FloatArray, weight: FloatArray) -> float:
    """Preload of the spring whose force doubles over the lift [N]: sup -need / (1 + s / lift); 0 for a groove."""
    return max(0.0, float(np.max(-need / weight))) if params.closure == "spring" else 0.0


def _lift_off(params: WeaverParams, need: FloatArray, hold: FloatArray) -> float:
    """Speed of the shaft [rad/s] at which the follower leaves the cam: 1 / w² = sup -need / hold."""
    if params.closure != "spring":
        return math.inf
    greatest = float(np.max(-need / np.maximum(hold, _FIT)))
    return 1 / math.sqrt(greatest) if greatest > 0 else math.inf


def _sections(trace: CamTrace) -> tuple[float, float]:
    """Area [m²] inside the surface, and its polar moment about the axis [m⁴], of the triangles under its polygon."""
    one = trace.surface[::-1]
    then = np.roll(one, -1)
    twice = cross(one, then)
    polar = twice * (dot(one, one) + dot(one, then) + dot(then, then)) / 12
    return float(np.sum(twice) / 2), float(np.sum(polar))


def stack_width(params: WeaverParams, cams: Sequence[HeadCam]) -> float:
    """Width of the cams that sit on the cam shaft itself, with their gaps [m]."""
    on_it = sum(1 for cam in cams if cam.actuator.startswith("cam"))
    return on_it * params.cam_thickness + (on_it + 1) * params.cam_gap


def torque_at(cams: Sequence[HeadCam], angle: FloatArray) -> FloatArray:
    """Torque of all cams together [N m] at cam angles [rad]."""
    total = np.zeros(angle.shape)
    for cam in cams:
        total += np.interp(angle, cam.angle, cam.torque, period=TURN)
    return total


@record
class CamShaftDrive:
    """The cam shaft's drive: `servo` of least power whose motor bears the turn; None where none does."""

    torque_max: float = result("Nm", "greatest torque of all cams on their shaft", name="cam_torque_max")
    torque_rms: float = result("Nm", "root mean square of the same", name="cam_torque_rms")
    power_max: float = result("W", "greatest power of the same, in both directions", name="cam_power_max")
    power_mean: float = result("W", "mean power, of the handler's brake", name="cam_power_mean")
    inertia: float = result("kg*m^2", "moment of inertia of the cams", name="cam_inertia")
    servo: ServoDrive | None

    motor = computed("", "class of motor of the cam shaft", lambda it: it.servo and it.servo.motor.name)
    ratio = computed("1", "ratio of its reducer", lambda it: it.servo and it.servo.reducer.ratio)
    motor_torque_peak = computed("Nm", "greatest torque of the motor", lambda it: it.servo and it.servo.duty.peak)
    motor_torque_rms = computed("Nm", "root mean square of the same", lambda it: it.servo and it.servo.duty.rms)
    motor_inertia_ratio = computed(
        "1", "inertia of the cams at the motor over its rotor's", lambda it: it.servo and it.servo.duty.inertia_ratio
    )


def drive_for(cams: Sequence[HeadCam], speed: float) -> CamShaftDrive:
    """The drive of a cam shaft with these cams at a speed [rad/s]."""
    angle = np.arange(DRIVE_SAMPLES) * (turn / DRIVE_SAMPLES)
    torque = torque_at(cams, angle)
    most, inertia = float(np.max(np.abs(torque))), sum(cam.inertia for cam in cams)
    cycle = LoadCycle(np.full(DRIVE_SAMPLES, speed), np.zeros(DRIVE_SAMPLES), torque, inertia)
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
    ratios = sorted((DIRECT, *PLANETARY), key=lambda reducer: reducer.ratio)
    found = [size_motor(cycle, (reducer,)) for reducer in ratios]
    return min((one for one in found if one), key=lambda one: one.motor.power, default=None)
