"""The shortest cycle of a knot that each limit allows, and the head's cutter, colour selector and masses.

Speeds of a cam shaft that turns once for a knot are as 1/T, accelerations, forces and torques at most as 1/T²: those of
springs, warps and yarn do not grow with the speed. So from the cycle T of the design, at most

    tools       T such that no track exceeds speed and acceleration      cutter   sqrt(4 h / a) over its share of a turn
    cams        T p / p_limit         since p² is as the force           carriage its step over the window's share
    motor       the least at which the motor still gives 1.25 times the torque of inertia and work

The cutter's blade moves h = 2 d across the yarn from rest to rest. Cutting takes at most the force that breaks all the
fibres of the pile yarn at once.
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.loaded_plate_cam import PRESSURE_LIMIT, STEEL
from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import FULL_STEPS, NO_MOTOR, Motor, smallest_motor
from ilmek.machines.weaver.design import Weaver, shaft_torque
from ilmek.machines.weaver.motions import HANDLER
from ilmek.num.brackets import bracketed_roots
from ilmek.records import computed, group, record, result
from ilmek.units import turn

_SHORTEST = 1e-6
"""A cycle that no motor allows, as a part of the cycle."""


@record
class Selector:
    """The stepper that brings a tube in line; `stepper` is None where none of the table is enough.

    speed  of the motor [rad/s]
    """

    torque: float = result("Nm", "torque that it must give")
    speed: float
    step: float = result("mm", "travel of the tubes for a step of it")
    stepper: Motor | None

    motor = computed("", "stepper that moves the tubes", lambda it: it.stepper and it.stepper.name, absent=NO_MOTOR)


@record
class HeadLimits:
    """How short the cycle could be, cutter, selector, masses."""

    cycle_limits: Mapping[str, float] = result("s", "the shortest cycle that each limit allows")
    cutting_force: float = result("N", "force that cuts all fibres of the yarn at once")
    cutting_time: float = result("s", "time of the cutter's blade across the yarn")
    cutting_window: float = result("s", "time from the end of drawing to presenting")
    selector: Selector = group("selector_")
    masses: Mapping[str, float] = result("kg", "masses of cams, shaft, tools, tubes, motors, and arms")

    cycle_time_possible = computed(
        "s", "the shortest cycle that all limits allow", lambda it: max(it.cycle_limits.values())
    )
    cycle_time_possible_set_by = computed(
        "", "the limit that sets it", lambda it: max(it.cycle_limits, key=lambda name: it.cycle_limits[name])
    )
    mass = computed("kg", "mass of the head's cams, shaft, tools, tubes and motors", lambda it: sum(it.masses.values()))


def head_limits(weaver: Weaver) -> HeadLimits:
    """The limits of a head."""
    return HeadLimits(
        cycle_limits=cycle_limits(weaver),
        cutting_force=weaver.params.strength,
        cutting_time=weaver.params.cutting_time,
        cutting_window=cut_share(weaver) * weaver.cycle,
        selector=selector_of(weaver),
        masses=mass_of(weaver),
    )


def cycle_limits(weaver: Weaver) -> Mapping[str, float]:
    """The shortest cycle that each limit allows [s]."""
    cycle = weaver.cycle
    pressure = max(cam.pressure_max for cam in weaver.cams)
    limits = {
        "tools": weaver.shortest,
        "cutter": weaver.params.cutting_time / cut_share(weaver),
        "cams": cycle * pressure / PRESSURE_LIMIT,
        "carriage": weaver.carriage_step / (weaver.carriage_window / cycle),
    }
    return limits if weaver.drive.servo is None else {**limits, "motor": _motor_limit(weaver)}


def cut_share(weaver: Weaver) -> float:
    """Share of the turn that the cutter has: from the end of drawing to the begin of presenting."""
    handler = weaver.cyclogram.track(HANDLER)
    return (handler.segment("present").start - handler.segment("draw").end) / turn


def selector_of(weaver: Weaver) -> Selector:
    """The selector's stepper, on a belt round its pulley."""
    params = weaver.params
    radius, mass = params.selector_pulley, params.tubes * params.tube_mass
    # A drum turns its tubes at the radius of their pitch: the same mass, moved along its circumference.
    torque, speed = MARGIN * mass * params.selector_acceleration * radius, params.selector_speed / radius
    return Selector(torque, speed, turn * radius / FULL_STEPS, smallest_motor(torque, speed, kind="stepper"))


def mass_of(weaver: Weaver) -> Mapping[str, float]:
    """Masses of the head's parts [kg]."""
    params, servo, stepper = weaver.params, weaver.drive.servo, selector_of(weaver).stepper
    axes = 1 if weaver.magazine.tiers == 1 else 2
    return {
        **({"arms": params.arms.mass} if params.with_arms else {}),
        "cams": sum(cam.mass for cam in weaver.cams),
        "shaft": math.pi / 4 * params.shaft**2 * weaver.width * STEEL.density,
        "tools": params.tool_mass * len(weaver.cams),
        "tubes": params.tubes * params.tube_mass,
        "motors": (servo.motor.mass if servo else 0) + (axes * stepper.mass if stepper else 0),
    }


def head_mass(weaver: Weaver) -> float:
    """Mass of the head on its carriage [kg]: as given, or as designed."""
    return weaver.params.head_mass or sum(mass_of(weaver).values())


def _motor_limit(weaver: Weaver) -> float:
    """The shortest cycle that the head's motor allows [s]; its inertia goes as 1/T², springs and tools' work stay."""
    servo, cycle = weaver.drive.servo, weaver.cycle
    if servo is None:
        return math.inf
    angle = weaver.cams[0].angle
    total = shaft_torque(weaver, angle)
    inertial = sum(np.interp(angle, cam.angle, cam.inertial_torque, period=turn) for cam in weaver.cams)
    most = float(np.max(np.abs(total)))

    def spare(time: FloatArray) -> FloatArray:
        share = ((cycle / np.ravel(time)) ** 2 - 1)[:, None]
        peak = np.max(np.abs(total + share * inertial), axis=1).reshape(np.shape(time)) / most
        allowed = servo.motor.peak_at(servo.reducer.ratio * turn / time)
        return np.asarray(allowed - MARGIN * servo.duty.peak * peak)

    found = float(bracketed_roots(spare, np.array([cycle * _SHORTEST]), np.array([cycle]))[0])
    return found if math.isfinite(found) else cycle
