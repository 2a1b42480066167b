"""The vertical axes of the comb on the guide cams: motion, force, motor.                                [thesis 3.3]

The whole cam system goes down by the stroke, presses, and comes up again within a step of the cams' turn, twice a turn:

    F(t) = m x'' - (1 - c) m g + P(x),      x downwards, c the share of the weight that is balanced

P the fell's force: it follows the fabric from the contact to the end of the stroke, is constant while the comb presses,
and falls on the way up as the fell returns. Against the motion a screw of the lead p needs the torque F p / (2 pi eta),
a belt on a pulley of radius r needs F r / eta; along the motion they give eta F p / (2 pi) and eta F r. The axes share
the force evenly. Neither locks itself: a brake holds (1 - c) m g p / (2 pi) or (1 - c) m g r on each axis' share.

A screw is as long as the stroke and its ends; `screws` chooses it. Where the number of axes is left open, it is that of
the comb's supports, or the next larger one whose screws and servos are enough.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.elements.duty import LoadCycle, ServoDrive, size_motor
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import SERVO
from ilmek.machines.hammer.comb import comb_mass
from ilmek.machines.hammer.params import LEADS, STACK, HammerParams
from ilmek.machines.hammer.screws import SCREW_ENDS, AxisScrew, ScrewLoad, screw_checks, screw_for
from ilmek.records import computed, group, record, result
from ilmek.report import Alternative, Check, Choice, Json, at_least, choose
from ilmek.units import format_quantity
from ilmek.weaving.fell import Fabric

CARRIAGE_MASS = 1.0
"""Of the carriage of an axis, which moves with the comb [kg]; assumed by this project."""

SAMPLES = 720

MOST_AXES = 60
"""Most axes that are tried where their number is left open."""

_STILL = 1e-12


@record
class CombDrive:
    """The comb's vertical drive.

    programme  stroke over the cams' angle, downwards [m]
    angle      of the samples over a turn [rad]          travel, speed, acceleration  of them [m, s]
    force      of all axes, downwards [N]                press  of the comb on the fell [N]
    cycle      of one axis' motor shaft, no reducer      drive  servo of one axis; None: none of the table is enough
    """

    programme: CamProgramme
    angle: FloatArray
    travel: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    force: FloatArray
    press: FloatArray
    cycle: LoadCycle
    drive: ServoDrive | None
    mass: float = result("kg", "mass of cams, comb and carriages, which go down together", name="moving_mass")
    stroke_needed: float = result("mm", "least stroke in which the comb meets the row, packs it and presses the fell")
    balance: float = result("N", "weight that the axes hold, the balanced part taken off", name="weight_carried")
    contact_speed: float = result("mm/s", "speed of the comb where it meets the row: it presses, it does not strike")
    axes: int = result("1", "vertical axes: ball screws or toothed belts", least=0.0)
    brake: float = result("Nm", "torque that holds a screw or pulley: neither locks itself", name="brake_torque")
    screw: AxisScrew | None = group()

    speed_max = computed("mm/s", "largest speed of the comb", lambda it: _most(it.speed))
    acceleration_max = computed("m/s^2", "largest acceleration of the comb", lambda it: _most(it.acceleration))
    inertia_force = computed("N", "force that accelerates cams and comb", lambda it: it.mass * _most(it.acceleration))
    axes_force_down = computed("N", "largest force of all axes, downwards", lambda it: float(np.max(it.force)))
    axes_force_up = computed("N", "largest force of all axes, upwards", lambda it: -float(np.min(it.force)))
    power_max = computed("W", "largest power of all axes", lambda it: _most(it.force * it.speed))
    axis_speed = computed("rpm", "largest speed of a screw or pulley", lambda it: _most(it.cycle.speed))
    axis_torque = computed("Nm", "largest torque at a screw or pulley", lambda it: _most(it.cycle.effort))

    @computed("", "servo of each axis", absent="none of the table is enough")
    def servo(self) -> Json:
        return None if self.drive is None else self.drive.as_json()


def _most(values: FloatArray) -> float:
    return float(np.max(np.abs(values)))


def stroke_programme(params: HammerParams) -> CamProgramme:
    """Two strokes a turn: rest while the shed opens, then down, press and up within the step."""
    law = LAWS[params.law]
    press = params.press_share * params.step
    span = (params.step - press) / 2
    rest = TURN / 2 - params.step
    once = (
        *([dwell(rest)] if rest > 0 else []),
        rise(span, params.stroke, law),
        *([dwell(press)] if press > 0 else []),
        fall(span, params.stroke, law),
    )
    return CamProgramme((*once, *once))


def axis_checks(drive: CombDrive) -> tuple[Check, ...]:
    """Whether stroke, screws and servos are enough."""
    reserve = drive.drive.duty.reserve if drive.drive else 0.0
    stroke = float(np.max(drive.travel))
    cure = "set more axes, a smaller lead, or a lower comb_acceleration"
    return (
        at_least("stroke of the comb's axis", stroke, drive.stroke_needed, "mm", "fabric").with_cure(
            "set a larger stroke"
        ),
        *(() if drive.screw is None else screw_checks(drive.screw)),
        at_least(
            "torque of the servo over the required torque", reserve, 1.0, "1", "motor table, margin 1.25"
        ).with_cure(cure),
    )


def chosen_axes(
    params: HammerParams, fabric: Fabric, force: float
) -> tuple[HammerParams, CombDrive, tuple[Choice, ...]]:
    """The axes that press with a force [N] for each warp, the parameters with their number, and the choice."""
    leads = (params.screw_lead,) if params.lead or params.axis == "belt" else LEADS
    tried: list[tuple[HammerParams, CombDrive]] = []
    for number in _numbers(params):
        for lead in leads:
            taken = replace(params, axes=number, lead=lead)
            tried.append((taken, axis_for(taken, fabric, force)))
            if all(check.ok for check in axis_checks(tried[-1][1])):
                break
        else:
            continue
        break
    if len(tried) == 1:
        return *tried[0], ()
    index, choice = choose("axes", [Alternative(_named(taken), axis_checks(made)) for taken, made in tried])
    return *tried[index], (choice,)


def _named(params: HammerParams) -> str:
    lead = f", lead {format_quantity(params.screw_lead, 'mm')}" if params.axis == "screw" else ""
    return f"{params.axis_count}{lead}"


def _numbers(params: HammerParams) -> Iterator[int]:
    """Numbers of axes to try, ascending: as given, or from one for each support on."""
    number = params.axis_count
    yield number
    while params.axes is None and (number := max(number + 1, round(number * 1.5))) <= MOST_AXES:
        yield number


def axis_for(params: HammerParams, fabric: Fabric, force: float) -> CombDrive:
    """The drive that presses with a force [N] for each warp."""
    programme = stroke_programme(params)
    angle = np.arange(SAMPLES) * (TURN / SAMPLES)
    at, rate = programme.at(angle), params.shed_speed
    speed, acceleration = at.ds * rate, at.dds * rate**2
    stack = STACK * params.cloth.width if params.stack_mass is None else params.stack_mass
    mass = comb_mass(params) + stack + params.axis_count * CARRIAGE_MASS
    balance = (1 - params.counterbalance) * mass * GRAVITY
    press = params.cloth.warps * fabric.over_stroke(force, params.stroke - at.s, speed < -_STILL)
    total = mass * acceleration - balance + press
    arm = params.screw_lead / TURN if params.axis == "screw" else params.pulley_radius
    resisting = press - balance
    lost = np.where(resisting * speed >= 0, 1 / params.axis_efficiency, params.axis_efficiency)
    cycle = LoadCycle(
        speed=speed / arm,
        acceleration=acceleration / arm,
        torque=resisting * lost * arm / params.axis_count,
        inertia=mass * arm**2 / params.axis_count,
    )
    contact = (speed > 0) & (press > 0)
    screw = None
    if params.axis == "screw":
        share = ScrewLoad(total / params.axis_count, speed / arm, params.stroke + SCREW_ENDS)
        screw = screw_for(params, share)
    return CombDrive(
        programme=programme,
        angle=angle,
        travel=at.s,
        speed=speed,
        acceleration=acceleration,
        force=total,
        press=press,
        cycle=cycle,
        drive=size_motor(cycle, kind=SERVO),
        mass=mass,
        stroke_needed=float(fabric.travel(force)),
        balance=balance,
        contact_speed=float(speed[contact].max()) if contact.any() else 0.0,
        axes=params.axis_count,
        brake=balance * arm / params.axis_count,
        screw=screw,
    )
