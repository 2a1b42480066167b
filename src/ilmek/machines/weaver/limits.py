"""How short a knot's cycle could be, by what limits it, and what else the head needs: cutter, colour selector, mass.

Speeds of a cam shaft that turns once for a knot go with 1/T, accelerations, forces and torques with 1/T². So from the
cycle T of the design

    tools       T such that no track exceeds speed and acceleration      cutter   sqrt(4 h / a) over its share of a turn
    cams        T p / p_limit         since p² goes with the force        carriage its step over the window's share
    motor       the least at which the motor still gives 1.25 times the torque, T sqrt(M / M(w))

The cutter's blade goes h = 2 d across the yarn from rest to rest. Cutting takes at most the force that breaks all the
fibres of the pile yarn at once.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import FULL_STEPS, Motor, smallest_motor
from ilmek.elements.yarns import WOOL
from ilmek.machines.weaver.cams import PRESSURE_LIMIT, STEEL
from ilmek.machines.weaver.cyclogram import HANDLER
from ilmek.machines.weaver.design import Weaver
from ilmek.num.brackets import bracketed_roots
from ilmek.units import turn

_SHORTEST = 1e-6
"""A cycle that no motor allows, as a part of the cycle."""


@dataclass(frozen=True, slots=True)
class Selector:
    """The stepper that brings a tube in line: its torque [N m] and speed [rad/s], way of a step [m], the motor."""

    torque: float
    speed: float
    step: float
    motor: Motor | None


def cycle_limits(weaver: Weaver) -> Mapping[str, float]:
    """The shortest cycle that each limit allows [s]."""
    cycle = weaver.cycle
    pressure = max(float(cam.pressure.max()) for cam in weaver.cams)
    limits = {
        "tools": weaver.shortest,
        "cutter": weaver.params.cutting_time / cut_share(weaver),
        "cams": cycle * pressure / PRESSURE_LIMIT,
        "carriage": weaver.carriage_step / (weaver.carriage_window / cycle),
    }
    if weaver.drive.motor is not None:
        limits["motor"] = _motor_limit(weaver)
    return limits


def cut_share(weaver: Weaver) -> float:
    """Share of the turn that the cutter has: from the end of the draw to the begin of presenting."""
    handler = weaver.cyclogram.track(HANDLER)
    return (handler.segment("present").start - handler.segment("draw").end) / turn


def cutting_force(weaver: Weaver) -> float:
    """Upper bound of the cutting force [N]: all fibres of the yarn at once."""
    return WOOL.breaking_force(weaver.params.yarn_density)


def selector_of(weaver: Weaver) -> Selector:
    """The selector's stepper, on a belt round its pulley."""
    params = weaver.params
    radius, mass = params.selector_pulley, params.tubes * params.tube_mass
    torque, speed = MARGIN * mass * params.selector_acceleration * radius, params.selector_speed / radius
    return Selector(torque, speed, turn * radius / FULL_STEPS, smallest_motor(torque, speed, kind="stepper"))


def mass_of(weaver: Weaver) -> Mapping[str, float]:
    """Masses of the head's parts [kg]."""
    params, motor, selector = weaver.params, weaver.drive.motor, selector_of(weaver).motor
    return {
        "cams": sum(cam.mass for cam in weaver.cams),
        "shaft": math.pi / 4 * params.shaft**2 * params.head_width * STEEL.density,
        "tools": params.tool_mass * len(weaver.cams),
        "tubes": params.tubes * params.tube_mass,
        "motors": sum(one.mass for one in (motor, selector) if one is not None),
    }


def _motor_limit(weaver: Weaver) -> float:
    """The shortest cycle that the head's motor allows [s],"""
    drive, cycle = weaver.drive, weaver.cycle
    motor, reducer = drive.motor, drive.reducer
    if motor is None or reducer is None or drive.duty is None:
        return math.inf
    peak = MARGIN * drive.duty.peak

    def spare(time: FloatArray) -> FloatArray:
        return np.asarray(motor.peak_at(reducer.ratio * turn / time) - peak * (cycle / time) ** 2)

    found = float(bracketed_roots(spare, np.array([cycle * _SHORTEST]), np.array([cycle]))[0])
    return found if math.isfinite(found) else cycle
