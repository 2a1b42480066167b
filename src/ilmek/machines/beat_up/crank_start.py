"""The crank's start and stop: one turn, or several, from rest with the beater farthest from the fell, and back to rest.

    w(t) = W (3 u^2 - 2 u^3),   u = t / T,   T = 2 D / W      run-up to the speed W over the angle D; the stop mirrored
    M = J(q) w' + J'(q) w^2 / 2 + F(s) ds/dq                  torque on the crank shaft      [Eksergian; `reduced`]

J is the inertia of all crank-rockers reduced to the crank, s the travel of the beater towards the fell, F the fell's
force on it. The run-up is over before the beat, a share of the rotation to it, so that the beat has its full speed.
Bearings and gears lose a share 1 - e: the drive gives M / e where it drives, and gets e M back where it brakes.

Servo: the motor's shaft follows w(t). Clutch and brake: a flywheel with its motor turns on at W; the clutch slips until
the crank has the speed, loses half of what it transmits, and the brake takes the rest:

    E = int M W dt (slipping) + int M w dt (coupled),   J_f = E / (d W^2),   P = E / (time of a beat and its rest)
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.reduced import reduce
from ilmek.elements.duty import MARGIN, LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import MATERIALS
from ilmek.elements.motors import SERVO, Motor, geared_motor
from ilmek.elements.prices import PRICES, price_of
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.use_params import STARTS, CrankStartParams
from ilmek.part import catalogue
from ilmek.part.bill import line_of
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import placement
from ilmek.part.shapes import Placed, Sum, Turned, bar, tube
from ilmek.records import computed, record, result
from ilmek.report import Alternative, Check, Choice, Json, at_most, choose, must
from ilmek.units import format_quantity, turn
from ilmek.weaving.fell import Fabric

MOTOR, CLUTCH, FLYWHEEL = "beat-up/motor", "beat-up/clutch", "beat-up/flywheel"
"""Ids of what starts and turns the crank."""

CLUTCHES = (7.5, 15.0, 30.0, 60.0, 120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0, 7680.0)
"""Torques of clutches and brakes to choose from [N m], each twice the one before: usual sizes."""

CLUTCH_POWER = 8.0
"""Power of the coils of clutch and brake of 1 N m [W]; of a torque times its power 0.4: assumed by this project."""

CLUTCH_MASS = 0.1
"""Mass of clutch and brake for each N m of their torque [kg]: assumed by this project."""

FLYWHEEL_RADIUS = 0.2
"""Radius of a flywheel's rim [m]: assumed by this project."""

WEB_SHARES, HUB = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002), 0.2
"""Inertia of a flywheel's web and hub over that of all; radius of the hub over that of the web; assumed here."""

WIDEST_RIM = 0.2
"""Largest width of a flywheel's rim, across and along, before it gets longer [m]; assumed by this project."""

LONGEST_WHEEL = 2 * (FLYWHEEL_RADIUS + WIDEST_RIM / 2)
"""Length of a flywheel on the end of its shaft, at most its greatest diameter [m]; assumed by this project."""

STEEL = MATERIALS["structural steel"]

_SAMPLES = 96
"""Samples of a run-up, a stop, and a turn between them."""

_RESTS = 24
"""Most samples of a beat with its rest, relative to those of the beat: a longer rest counts as this one."""


@record
class CrankDuty:
    """What the crank-rockers of a beat do between two rests.

    linkage  one of them, all alike     number   of them on the crank shaft
    fabric   at the fell                warps    beaten by all of them     force  of the beat, for a warp [N]
    strokes  turns of the crank from a start to its stop   starts, pause  of a beat, and the time between two [s]
    every    time from the start of a beat to that of the next [s]; None: no rest between
    """

    linkage: BeatUp
    number: int
    fabric: Fabric
    warps: int
    force: float
    strokes: int = 1
    starts: int = 1
    pause: float = 0.0
    every: float | None = None

    def time(self, run_up: float) -> float:
        """Time of a beat from rest to rest [s]; run_up: share of the rotation to the beat."""
        single = stroke_time(self.linkage, run_up, self.strokes)
        return self.starts * single + (self.starts - 1) * self.pause


@record
class CrankStart:
    """The crank's start, its turns and its stop; the arrays are those of a single turn from rest to rest.

    torque  on the crank shaft [N m]      travel  of the beater from the fell, along its path [m]
    cycle   of the servo, with its rest   servo   None: none is enough, or a clutch is taken
    clutch  size [N m]; None: servo, or none is enough      motor  of the flywheel, with its reducer
    """

    duty: CrankDuty
    params: CrankStartParams
    time: FloatArray
    angle: FloatArray
    speed: FloatArray
    torque: FloatArray
    travel: FloatArray
    fell_force: FloatArray
    cycle: LoadCycle
    servo: ServoDrive | None
    clutch: float | None
    motor: tuple[Motor, Reducer] | None
    drive: str = result("", "how the crank starts and stops: servo, or clutch and brake", name="crank_start")
    beat_time: float = result("s", "time of a beat from rest to rest, all its strokes")
    run_up_time: float = result("s", "time from rest to the speed of the beat")
    run_up_work: float = result("J", "work of the drive in the run-up, losses included")
    run_up_energy: float = result("J", "kinetic energy of crank-rockers and beater at its end")
    run_up_loss: float = result("J", "lost in the run-up: bearings and gears, and the slip of a clutch")
    start_work: float = result("J", "work of the drive for a beat, none of it recovered")
    clutch_torque: float = result("Nm", "torque that clutch and brake need")
    start_flywheel: float = result("kg*m^2", "flywheel on the motor's side of the clutch")
    choices: tuple[Choice, ...] = ()

    start_torque = computed("Nm", "greatest torque on the crank shaft", lambda it: float(np.max(np.abs(it.torque))))

    @computed("", "motor of the crank", absent="none of the table is enough", name="crank_motor")
    def crank_motor(self) -> Json:
        pair = self.pair
        return None if pair is None else {"motor": pair[0].name, "ratio": pair[1].ratio}

    @property
    def pair(self) -> tuple[Motor, Reducer] | None:
        """The motor and its reducer."""
        return (self.servo.motor, self.servo.reducer) if self.servo else self.motor


def crank_start(duty: CrankDuty, params: CrankStartParams) -> CrankStart:
    """The start and stop of the crank shaft; of servo and clutch the given one, or the cheaper that is enough."""
    time, angle, rate, rise = _motion(duty.linkage, params.run_up)
    load, turns = _load(duty, angle), _turns_work(duty, params)
    drives = (params.drive,) if params.drive else STARTS
    made = [_started(duty, params, drive, (time, rate, rise), load, turns) for drive in drives]
    made.sort(key=lambda one: sum(price_of(line_of(part), PRICES) for part in start_parts(one)))
    index, choice = choose("start.drive", [Alternative(one.drive, start_checks(one)) for one in made])
    return replace(made[index], choices=(choice,) if len(made) > 1 else ())


def start_checks(start: CrankStart) -> tuple[Check, ...]:
    """Whether a motor, and a clutch where there is one, start and stop the crank, in the time between two beats."""
    slower = "set a lower speed of the crank, more beaters, or a longer run-up"
    source, driven = "motor table, margin 1.25", (MOTOR,)
    motor = must("a motor starts and stops the crank", start.pair is not None, source).with_cure(slower, *driven)
    every, source = start.duty.every, "time from beat to beat"
    in_time = every and at_most("time of a beat", start.beat_time, every, "s", source).with_cure(slower, *driven)
    start_checks = (motor, in_time) if in_time else (motor,)
    if start.drive == "servo":
        return start_checks
    largest = f"sizes of clutches, up to {format_quantity(CLUTCHES[-1], 'Nm')}"
    clutch = (CLUTCH,)
    torque = at_most("torque of the clutch", start.clutch_torque, CLUTCHES[-1], "Nm", largest).with_cure(
        slower, *clutch
    )
    return *start_checks, torque, _wheel_check(start)


def _wheel_check(start: CrankStart) -> Check:
    """Whether the flywheel has room beside the loom, on the end of its shaft."""
    long = _length(_rim(start.start_flywheel)) if start.start_flywheel > 0 else 0.0
    cure = "set start.drive=servo, a higher speed of the crank, a larger start.speed_drop, or another beat"
    source = "greatest diameter of a flywheel; assumed by this project"
    return at_most("length of the flywheel", long, LONGEST_WHEEL, "mm", source).with_cure(cure, FLYWHEEL)


def _length(rim: Turned) -> float:
    return float(rim.profile.outline.points.real.max())


def start_parts(start: CrankStart) -> tuple[Part, ...]:
    """What starts and turns the crank shaft, from the shaft on: clutch and brake, flywheel, reducer, motor."""
    return (*coupled_parts(start), *_geared(start))


def coupled_parts(start: CrankStart) -> tuple[Part, ...]:
    """What is on the shaft before its reducer and motor."""
    return tuple(_coupled(start))


def _coupled(start: CrankStart) -> Iterator[Part]:
    """Clutch and brake as a cylinder of steel, half as long as it is wide, and the flywheel's rim."""
    if start.drive != "clutch":
        return
    size = start.clutch or start.clutch_torque
    mass = CLUTCH_MASS * size
    wide = (8 * mass / (math.pi * STEEL.density)) ** (1 / 3)
    bought = Bought(format_quantity(size, "Nm"), mass, power=CLUTCH_POWER * size**0.4)
    name = "clutch and brake"
    fixing = "its hub is keyed to the shaft, its other half screwed to the flywheel, as its maker says"
    yield bought_part(CLUTCH, f"{name} of the beat-up", name, bar(wide, wide / 2), bought, fixing=fixing)
    if start.start_flywheel > 0:
        wheel = _wheel(start.start_flywheel)
        yield Part(FLYWHEEL, "flywheel of the beat-up", "steel bar", wheel, STEEL)


def _wheel(inertia: float) -> Sum:
    """A flywheel of a moment of inertia [kg m²], from z = 0: a rim, and inside of it a web and its hub.

    Web and hub have a share of the inertia, the largest of `WEB_SHARES` whose web is thinner than half the rim.
    """
    for share in WEB_SHARES:
        rim = _rim((1 - share) * inertia)
        points = rim.profile.outline.points
        length, inner = _length(rim), float(points.imag.min())
        web, hub = (math.pi * STEEL.density * radius**4 / 2 for radius in (inner, HUB * inner))
        thick = (share * inertia - hub * length) / (web - hub)
        if 0 < thick < length / 2:
            break
    else:
        return Sum((Placed(rim),))
    boss = Placed(bar(2 * HUB * inner, length - thick), (placement(z=thick),))
    return Sum((Placed(rim), Placed(bar(2 * inner, thick)), boss))


def _rim(inertia: float) -> Turned:
    """A rim of a moment of inertia [kg m²] about its mean radius R, w wide: J = 2 pi rho R w l (R² + w² / 4).

    Square, l = w, up to `WIDEST_RIM`; then longer.
    """
    radius = FLYWHEEL_RADIUS
    area = inertia / (2 * math.pi * STEEL.density * radius)
    # Of w² (R² + w² / 4) = area the positive root.
    wide = min(math.sqrt(2 * (math.sqrt(radius**4 + area) - radius**2)), WIDEST_RIM)
    return tube(2 * radius + wide, wide, area / (wide * (radius**2 + wide**2 / 4)))


def _geared(start: CrankStart) -> Iterator[Part]:
    row, reducer = start.pair or (None, DIRECT)
    if reducer.ratio != 1:
        yield catalogue.reducer("beat-up/reducer", "reducer of the beat-up", reducer, row)
    speed = start.duty.linkage.params.speed
    yield catalogue.motor(MOTOR, "motor of the beat-up", row, start.start_torque, speed, rear=True)


def stroke_time(linkage: BeatUp, run_up: float, strokes: int = 1) -> float:
    """Time [s] of some turns of the crank from rest to rest: T = (2 pi n + D1 + D2) / W, D1 and D2 run-up and stop."""
    return (turn * strokes + run_up * turn) / linkage.params.speed


def _motion(linkage: BeatUp, run_up: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Time, crank angle, speed and acceleration of one turn from rest to rest, the beat within it."""
    speed, back = linkage.params.speed, linkage.crank_rotation
    first, last = run_up * (turn - back), run_up * back
    u = np.linspace(0.0, 1.0, _SAMPLES + 1)
    ramp, slope = 3 * u**2 - 2 * u**3, 6 * u - 6 * u**2
    turned = 2 * (u**3 - u**4 / 2)
    up, down, even = 2 * first / speed, 2 * last / speed, (turn - first - last) / speed
    time = np.concatenate([up * u, (up + even * u)[1:], (up + even + down * u)[1:]])
    angle = np.concatenate([first * turned, (first + (turn - first - last) * u)[1:], (turn - last * turned[::-1])[1:]])
    rate = np.concatenate([speed * ramp, np.full(_SAMPLES, speed), speed * ramp[::-1][1:]])
    rise = np.concatenate([speed / up * slope, np.zeros(_SAMPLES), -speed / down * slope[::-1][1:]])
    return time, linkage.back_angle + angle, rate, rise


@record
class _Load:
    """J and dJ/dq of all crank-rockers, travel from the fell and its slope, force of the fell, at crank angles."""

    angle: FloatArray
    inertia: FloatArray
    bend: FloatArray
    travel: FloatArray
    slope: FloatArray
    fell: FloatArray


def _load(duty: CrankDuty, angle: FloatArray) -> _Load:
    linkage = duty.linkage
    terms, motion = reduce(linkage.plan, linkage.bodies).terms(angle), solve(linkage.plan, angle, 1.0)
    arm, (at_beat, back) = linkage.lengths["beater"], linkage.rocker_angles
    travel = arm * np.abs(np.angle(np.exp(1j * (motion.angle("rocker") - at_beat))))
    slope = arm * motion.omega("rocker") * np.sign(back - at_beat)
    fell = duty.warps * duty.fabric.over_stroke(duty.force, travel, slope > 0)
    return _Load(angle, duty.number * terms.inertia, duty.number * terms.slope, travel, slope, fell)


def _started(  # noqa: PLR0917
    duty: CrankDuty,
    params: CrankStartParams,
    drive: str,
    motion: tuple[FloatArray, FloatArray, FloatArray],
    load: _Load,
    turns: float,
) -> CrankStart:
    """With a servo, or clutch and brake; turns: work of the turns between run-up and stop [J]."""
    speed, end = duty.linkage.params.speed, _SAMPLES
    time, rate, rise = motion
    # The travel from the fell falls on the way to it: there the fell resists.
    moved = load.inertia * rise + load.bend * rate**2 / 2 - load.fell * load.slope
    lossy = np.where(moved * rate >= 0, moved / params.efficiency, moved * params.efficiency)
    clutch = drive == "clutch"
    shaft = np.where(np.arange(time.size) <= end, speed, rate) if clutch else rate
    lost = float(_integral((lossy - moved) * rate, time)[end])
    slip = float(_integral(np.maximum(lossy, 0.0) * (shaft - rate), time)[end])
    energy = float(load.inertia[end] * speed**2 / 2)
    resisted = float(_integral(-load.fell * load.slope * rate, time)[end])
    drawn = duty.starts * (float(np.trapezoid(np.maximum(lossy, 0.0) * shaft, time)) + turns)
    total, torque = duty.time(params.run_up), float(np.max(np.abs(lossy)))
    power = drawn / max(duty.every or total, total)
    cycle = _cycle(duty, total, time, rate, rise, lossy, float(load.inertia.max()))
    return CrankStart(
        duty=duty,
        params=params,
        time=time,
        angle=load.angle,
        speed=rate,
        torque=moved,
        travel=load.travel,
        fell_force=load.fell,
        cycle=cycle,
        servo=None if clutch else size_motor(cycle, kind=SERVO),
        clutch=next((size for size in CLUTCHES if size >= torque), None) if clutch else None,
        motor=geared_motor(MARGIN * power / speed, speed, (DIRECT, *PLANETARY)) if clutch else None,
        drive=drive,
        beat_time=total,
        run_up_time=float(time[end]),
        run_up_work=energy + resisted + lost + slip,
        run_up_energy=energy,
        run_up_loss=lost + slip,
        start_work=drawn,
        clutch_torque=torque if clutch else 0.0,
        start_flywheel=drawn / duty.starts / (params.speed_drop * speed**2) if clutch else 0.0,
    )


def _integral(values: FloatArray, time: FloatArray) -> FloatArray:
    """Running integral by trapezoids."""
    return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(time))])


def _turns_work(duty: CrankDuty, params: CrankStartParams) -> float:
    """Work of the drive for the turns at speed between run-up and stop [J], none of it recovered."""
    if duty.strokes == 1:
        return 0.0
    angle = duty.linkage.back_angle + np.linspace(0.0, turn, 2 * _SAMPLES + 1)
    load = _load(duty, angle)
    torque = load.bend * duty.linkage.params.speed**2 / 2 - load.fell * load.slope
    return (duty.strokes - 1) * float(np.trapezoid(np.maximum(torque, 0.0), angle)) / params.efficiency


def _cycle(  # noqa: PLR0917
    duty: CrankDuty,
    total: float,
    time: FloatArray,
    rate: FloatArray,
    rise: FloatArray,
    torque: FloatArray,
    inertia: float,
) -> LoadCycle:
    """The servo's load at equal steps of time: turns from rest to rest, and the rest until the next beat.

    Several strokes count as one turn after the other, each started and stopped: more than they need.
    """
    turns = duty.strokes * duty.starts
    every = max((duty.every or total) / turns, time[-1])
    count = min(max(round(every / time[-1] * _SAMPLES), _SAMPLES), _RESTS * _SAMPLES)
    at = np.linspace(0.0, every, count, endpoint=False)
    on = at <= time[-1]
    speed, acceleration, effort = (np.where(on, np.interp(at, time, curve), 0.0) for curve in (rate, rise, torque))
    return LoadCycle(speed, acceleration, effort - inertia * acceleration, inertia)
