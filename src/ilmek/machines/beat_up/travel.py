"""The beater that travels along the carpet and strokes along its width.      [Topalbekiroglu and Celik, 2.1.1, Fig 1]

    k = floor(F / R),   n = ceil(N / k)                         warps of a stroke, strokes across the N warps
    T = (2 pi n + D1 + D2) / W                                  the crank turns on from stroke to stroke (through)
    T = n (2 pi + D1 + D2) / W + (n - 1) max(0, t - t_out)       it stands between them (start-stop)

F is the force of the beater at the beat, R the force of a warp that the rows need, D1 + D2 the angles of run-up and
stop. "There must be a slider mechanism which moves along the carpet width together with beat-up mechanism": a belt axis
moves the beat-up by its width k p, limited in speed, acceleration and jerk, while the beater's teeth are out of the
warps. The pivot of the rocker stands level with the fell, so that the beater strikes along the warps; at the rocker's
angle d from the beat it has left them by AE (1 - cos d). With t_out the time for which that is more than the teeth's
reach, the crank can turn on where the step's time t <= t_out.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.elements.drive_parts import PULLEY
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import GRAVITY
from ilmek.linkage.solve import solve
from ilmek.machines.beat_up.beater import Beater, beater_checks, beater_of, plate_check
from ilmek.machines.beat_up.carriage import AXIS_SIDE, BLOCK_LENGTH
from ilmek.machines.beat_up.crank_start import stroke_time
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.use_params import TravelParams
from ilmek.part import catalogue
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.shapes import box
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least, at_most, must
from ilmek.timing.s_curve import AxisLimits, SCurve, move_time, s_curve
from ilmek.units import in_mm, mm, turn
from ilmek.weaving.cloth import Cloth

SLIDE_END = 20 * mm
"""Of the slide beyond its carriage, at each end [m]: assumed by this project."""

AXIS, MOTOR, REDUCER = "beat-up/slide", "beat-up/slide-motor", "beat-up/slide-reducer"

_SAMPLES = 200
_TURN_SAMPLES = 1440


@record
class BeaterTravel:
    """The beater along the width of the cloth; step: its motion from stroke to stroke; every: time between [s]."""

    params: TravelParams
    cloth: Cloth
    beater: Beater
    step: SCurve
    every: float
    stroke_force: float = result("N", "force of the beater at the beat")
    stroke_warps: int = result("1", "warps of a stroke", least=0.0)
    strokes: int = result("1", "strokes across the width")
    mode: str = result("", "crank between two strokes: through or start-stop", name="stroke_mode")
    step_time: float = result("s", "time of a step of the slide")
    out_time: float = result("s", "time of a turn for which the beater is out of the warps")
    clear: float = result("mm", "distance of the beater from the warps, at its farthest", name="beater_out")
    pause: float = result("s", "time for which the crank stands between two strokes", name="stroke_pause")
    slide_mass: float = result("kg", "mass on the slide")
    slide: ServoDrive | None = None
    thrust: float = 0.0

    stroke_warp_force = computed("N", "force of the beat for a warp", lambda it: it.stroke_force / it.stroke_warps)
    beater_width = computed("mm", "width of the beater", lambda it: it.stroke_warps * it.cloth.warp_pitch)
    slide_run = computed(
        "mm",
        "run of the slide from the first stroke to the last",
        lambda it: max(it.cloth.warps - it.stroke_warps, 0) * it.cloth.warp_pitch,
    )

    @property
    def parking(self) -> float:
        """Time of a run beside the cloth, no quicker than a step [s]; 0 without one."""
        limits = AxisLimits(self.step.speed, self.params.acceleration, self.params.jerk)
        return move_time(self.params.park, limits) if self.params.park else 0.0


def travel(design: BeatUp, params: TravelParams, run_up: float) -> BeaterTravel:
    """Strokes, steps and time of a beat along the width; run_up: share of the rotation to the beat."""
    force, cloth = force_at_beat(design), design.params.cloth
    able = min(max(int(force / params.warp_force * (1 + 1e-9)), 1), cloth.warps)
    warps = min(params.stroke_warps or able, cloth.warps)
    strokes = math.ceil(cloth.warps / warps)
    step = s_curve(warps * cloth.warp_pitch, AxisLimits(params.speed, params.acceleration, params.jerk))
    clear, out = _out_of_the_warps(design, params.reach)
    mode = params.mode or ("through" if step.time <= out or strokes == 1 else "start-stop")
    single = stroke_time(design, run_up)
    # Standing at the far dead centre, the slide may begin before the crank stands, and end after it has begun.
    pause = max(0.0, step.time - out) if mode == "start-stop" else 0.0
    return BeaterTravel(
        params=params,
        cloth=cloth,
        beater=beater_of(design.params, warps, design.lengths["beater"]),
        step=step,
        every=turn / design.params.speed if mode == "through" else single + pause,
        stroke_force=force,
        stroke_warps=warps,
        strokes=strokes,
        mode=mode,
        step_time=step.time,
        out_time=out,
        clear=clear,
        pause=pause,
        slide_mass=math.nan,
    )


def with_slide_mass(found: BeaterTravel, mass: float) -> BeaterTravel:
    """The same with a mass on the slide [kg], and the motor that moves it."""
    cycle = _slide_cycle(found.params, found.step, mass, found.every)
    thrust = float(np.max(np.abs(cycle.effort))) / PULLEY
    return replace(found, slide=size_motor(cycle), thrust=thrust, slide_mass=mass)


def force_at_beat(design: BeatUp) -> float:
    """Force between rocker and beater at the beat [N]: m (a - g), as much as the fell can take."""
    motion = solve(design.plan, np.array([design.beta]), design.params.speed)
    beater = motion.carried("rocker", design.plan.mechanism.point("rocker", "E"))
    return design.params.beater_mass * float(abs(beater.acceleration[0] - design.params.gravity_vector))


def travel_checks(found: BeaterTravel) -> tuple[Check, ...]:
    """Whether the beater beats every warp hard enough, leaves the warps, and steps on in time."""
    params, carried = found.params, "set a higher speed of the crank, or a heavier beater"
    checks = (
        at_least(
            "force of a stroke for a warp",
            found.stroke_warp_force,
            params.warp_force,
            "N",
            "force that the rows need, fabric assumed by this project: hammer.packing, laid_pitch, jammed_pitch",
        ).with_cure(carried, *found.beater.ids),
        at_least(
            "beater out of the warps, at its farthest", found.clear, params.reach, "mm", "parameter travel.reach"
        ).with_cure("set shorter teeth, a longer ground, or a larger swing", *found.beater.ids[:1]),
        *beater_checks(found.beater),
        *plate_check(found.beater, found.stroke_force / found.beater.mass if found.beater.mass else 0.0),
        must("a motor moves the slide", found.slide is not None, "motor table, margin 1.25").with_cure(
            "set a lower acceleration of the slide", MOTOR
        ),
    )
    if found.mode == "start-stop" or found.strokes == 1:
        return checks
    cure = "set travel.mode=start-stop, or a quicker slide"
    title, driven = "time of a step of the slide", (AXIS, MOTOR)
    return (*checks, at_most(title, found.step_time, found.out_time, "s", "turn").with_cure(cure, *driven))


def _out_of_the_warps(design: BeatUp, reach: float) -> tuple[float, float]:
    """Greatest distance of the beater from the warps [m], and the time of a turn [s] beyond the teeth's reach."""
    angle = np.arange(_TURN_SAMPLES) * (turn / _TURN_SAMPLES)
    rocker = solve(design.plan, angle).angle("rocker") - design.rocker_angles[0]
    out = design.lengths["beater"] * (1 - np.cos(rocker))
    return design.lengths["beater"] * (1 - math.cos(design.swing)), float(np.mean(out > reach)) * design.period


def _slide_cycle(params: TravelParams, step: SCurve, mass: float, every: float) -> LoadCycle:
    """Load of the slide's motor over a step and the rest until the next one."""
    time = np.linspace(0.0, max(every, step.time), _SAMPLES)
    _, speed, acceleration, _ = step.at(time)
    friction = params.friction * mass * GRAVITY * np.sign(speed)
    return LoadCycle(speed / PULLEY, acceleration / PULLEY, friction * PULLEY, mass * PULLEY**2)


def slide_length(found: BeaterTravel) -> float:
    """Length of the slide: its run, with those beside the cloth, its carriage, and room at both ends [m]."""
    return float(found.slide_run + 2 * found.params.park + BLOCK_LENGTH + 2 * SLIDE_END)


def travel_parts(found: BeaterTravel) -> tuple[Part, ...]:
    """The slide along the carpet, and its motor behind its reducer where it has one."""
    row = found.slide.motor if found.slide else None
    length = slide_length(found)
    speed = found.step.speed / PULLEY
    reducers = (
        (catalogue.reducer(REDUCER, "reducer of the slide", found.slide.reducer, row),)
        if found.slide and found.slide.reducer.ratio != 1
        else ()
    )
    size = "belt drive along the carpet"
    shape = box(AXIS_SIDE, AXIS_SIDE, length)
    stroke = catalogue.stroke_of(float(found.slide_run + 2 * found.params.park))
    data = f"belt axis {in_mm(AXIS_SIDE)} wide, pulley {in_mm(2 * PULLEY)}, {stroke}"
    bought = Bought("belt axis", length=length, data=data)
    return (
        bought_part(AXIS, "slide of the beater", "linear axis", shape, bought, size=size),
        *reducers,
        catalogue.motor(MOTOR, "motor of the slide", row, found.thrust * PULLEY, speed),
    )
