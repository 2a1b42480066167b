"""The vertical axes of the comb on the guide cams: motion, force, motor.                                [thesis 3.3]

The whole cam system goes down by the stroke, presses, and comes up again within a step of the cams' turn, twice a turn:

    F(t) = m x'' - (1 - c) m g + P(x),      x downwards, c the share of the weight that is balanced

P the fell's force: it rises as the fabric has it while the comb goes its last way, stands while the comb presses, and
falls by what the fell gives back on the way up. A screw of the lead p turns F into F p / (2 pi eta), a belt on a pulley
of radius r into F r / eta; against the way it goes, times eta instead. The axes share the force evenly. Neither locks
itself: a brake holds what hangs on an axis, (1 - c) m g p / (2 pi), or r in place of p / (2 pi).

A screw is as long as the stroke and its ends, and must not buckle under three times its force (Euler, one end clamped).
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import SERVO
from ilmek.elements.screws import Screw
from ilmek.machines.hammer.comb import comb_mass
from ilmek.machines.hammer.params import STACK, STEEL, HammerParams
from ilmek.units import mm
from ilmek.weaving.fell import Fabric

SAMPLES = 720


@dataclass(frozen=True, slots=True)
class CombDrive:
    """The comb's vertical drive.

    programme  stroke over the cams' angle, downwards [m]      mass  that moves: cams and comb [kg]
    angle      of the samples over a turn [rad]                travel, speed, acceleration of them [m, s]
    force      of all axes, downwards [N]                      press  what the comb presses with [N]
    inertia_force  largest m x'' [N]                            balance  what holds the weight [N], (1 - c) m g
    cycle      of one axis' motor shaft without reducer        drive  servo of one axis; None: no one bears it
    power_max  of all axes [W]                                 meets  speed of the comb where it meets the row [m/s]
    brake      torque that holds an axis at rest [N m]         screw  diameter [m], None: belts
    buckling   safety of a screw against it; inf for belts
    """

    programme: CamProgramme
    mass: float
    angle: FloatArray
    travel: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    force: FloatArray
    press: FloatArray
    inertia_force: float
    balance: float
    cycle: LoadCycle
    drive: ServoDrive | None
    power_max: float
    meets: float
    brake: float
    screw: float | None
    buckling: float


def stroke_programme(params: HammerParams) -> CamProgramme:
    """Two strokes a turn: rest while the shed opens, then down, press and up within the step."""
    law = LAWS[params.law]
    press = params.press_share * params.step
    way = (params.step - press) / 2
    rest = TURN / 2 - params.step
    once = (
        *([dwell(rest)] if rest > 0 else []),
        rise(way, params.stroke, law),
        *([dwell(press)] if press > 0 else []),
        fall(way, params.stroke, law),
    )
    return CamProgramme((*once, *once))


def axis_for(params: HammerParams, fabric: Fabric, force: float) -> CombDrive:
    """The drive that presses with a force [N] for each warp."""
    programme = stroke_programme(params)
    angle = np.arange(SAMPLES) * (TURN / SAMPLES)
    at, rate = programme.at(angle), params.shed_speed
    speed, acceleration = at.ds * rate, at.dds * rate**2
    stack = STACK * params.width if params.stack_mass is None else params.stack_mass
    mass = comb_mass(params) + stack
    balance = (1 - params.counterbalance) * mass * GRAVITY
    press = params.warps * _fell_force(params, fabric, force, at.s, speed)
    total = mass * acceleration - balance + press
    arm = params.lead / TURN if params.axis == "screw" else params.pulley_radius
    resisting = press - balance
    driven = resisting * speed >= 0
    lost = np.where(driven, 1 / params.axis_efficiency, params.axis_efficiency)
    cycle = LoadCycle(
        speed=speed / arm,
        acceleration=acceleration / arm,
        torque=resisting * lost * arm / params.shared,
        inertia=mass * arm**2 / params.shared,
    )
    contact = (speed > 0) & (press > 0)
    screw, buckling = _screw(params, float(np.max(np.abs(total))) / params.shared)
    return CombDrive(
        programme=programme,
        mass=mass,
        angle=angle,
        travel=at.s,
        speed=speed,
        acceleration=acceleration,
        force=total,
        press=press,
        inertia_force=mass * float(np.max(np.abs(acceleration))),
        balance=balance,
        cycle=cycle,
        drive=size_motor(cycle, kind=SERVO),
        power_max=float(np.max(np.abs(total * speed))),
        meets=float(speed[contact].max()) if contact.any() else 0.0,
        brake=balance * arm / params.shared,
        screw=screw,
        buckling=buckling,
    )


def _screw(params: HammerParams, force: float) -> tuple[float | None, float]:
    """Diameter [m] of a ball screw under a force [N], and its safety against buckling; None and inf for belts."""
    if params.axis == "belt":
        return None, float("inf")
    length = params.stroke + SCREW_ENDS

    def safety(diameter: float) -> float:
        ball = Screw(diameter, params.lead, CORE * diameter, BALL_FRICTION)
        return ball.buckling_force(length, STEEL.modulus) / force if force > 0 else float("inf")

    offered = (params.screw_diameter,) if params.screw_diameter else BALL_SCREWS
    taken = next((diameter for diameter in offered if safety(diameter) >= BUCKLING), offered[-1])
    return taken, safety(taken)


BALL_SCREWS = tuple(diameter * mm for diameter in (12, 16, 20, 25, 32, 40, 50, 63, 80, 100))
"""Nominal diameters of ball screws [m] [ISO 3408-2]."""

CORE, BALL_FRICTION = 0.85, 0.005
SCREW_ENDS = 0.2
"""Length of a screw beyond its stroke [m]: nut and bearings."""

BUCKLING = 3.0
"""Safety against buckling that is asked of a screw."""


def _fell_force(
    params: HammerParams, fabric: Fabric, force: float, travel: FloatArray, speed: FloatArray
) -> FloatArray:
    """Force of one warp on the comb [N] along the stroke, which ends where the force is reached."""
    forces = np.concatenate([[0.0], np.geomspace(force * 1e-4, force, _TABLE)])
    left = params.stroke - travel
    going = np.interp(float(fabric.travel(force)) - left, np.asarray(fabric.travel(forces)), forces, left=0.0)
    back = np.interp(float(fabric.fell(force)) - left, np.asarray(fabric.fell(forces)), forces, left=0.0)
    return np.asarray(np.where(speed >= -_STILL, going, back))


_TABLE, _STILL = 200, 1e-12


def stroke_needed(fabric: Fabric, force: float) -> float:
    """Least stroke [m] in which the comb meets the row, packs it and presses the fell back."""
    return float(fabric.travel(force))
