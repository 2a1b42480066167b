"""The shortest cycle of a knot that each limit allows, and the head's cutter.

Speeds of a cam shaft that turns once for a knot are as 1/T, accelerations, forces and torques at most as 1/T²: those of
springs, warps and yarn do not grow with the speed. So from the cycle T of the design, at most

    tools       T such that no track exceeds speed and acceleration      cutter   its time over its share of a turn
    cams        T p / p_limit         since p² is as the force           carriage its step over the window's share
    motor       the least at which the motor still gives 1.25 times the torque of inertia and work

Cutting takes at most the force that breaks all the fibres of the pile yarn at once [`cutter`].
"""

import math
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.loaded_plate_cam import PRESSURE_LIMIT, torque_at
from ilmek.elements.duty import MARGIN
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.motions import HANDLER
from ilmek.machines.weaver.selector import Selector, selector_of
from ilmek.machines.weaver.tree import mass_of
from ilmek.num.brackets import bracketed_roots
from ilmek.records import computed, group, record, result
from ilmek.units import turn

_SHORTEST = 1e-6
"""A cycle that no motor allows, as a part of the cycle."""


@record
class HeadLimits:
    """How short the cycle could be, cutter, selector, masses."""

    cycle_limits: Mapping[str, float] = result("s", "the shortest cycle that each limit allows")
    cutting_force: float = result("N", "force that cuts all fibres of the yarn at once")
    cutting_time: float = result("s", "time of the cutter's blade across the yarn")
    cutting_window: float = result("s", "time from the end of drawing to presenting")
    selector: Selector = group("selector_")
    masses: Mapping[str, float] = result("kg", "masses of the head's parts, and of arms")

    cycle_time_possible = computed(
        "s", "the shortest cycle that all limits allow", lambda it: max(it.cycle_limits.values())
    )
    cycle_time_possible_set_by = computed(
        "", "the limit that sets it", lambda it: max(it.cycle_limits, key=lambda name: it.cycle_limits[name])
    )
    mass = computed("kg", "mass of all parts of the head, as they are made", lambda it: sum(it.masses.values()))


def head_limits(weaver: Weaver) -> HeadLimits:
    """The limits of a head."""
    return HeadLimits(
        cycle_limits=cycle_limits(weaver),
        cutting_force=weaver.params.strength,
        cutting_time=weaver.params.cutting_time,
        cutting_window=cut_share(weaver) * weaver.cycle,
        selector=selector_of(weaver.params, weaver.magazine),
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


def _motor_limit(weaver: Weaver) -> float:
    """The shortest cycle that the head's motor allows [s]; its inertia goes as 1/T², springs and tools' work stay."""
    servo, cycle = weaver.drive.servo, weaver.cycle
    if servo is None:
        return math.inf
    angle = weaver.cams[0].angle
    total = torque_at(weaver.cams, angle)
    inertial = sum(np.interp(angle, cam.angle, cam.inertial_torque, period=turn) for cam in weaver.cams)
    most = float(np.max(np.abs(total)))

    def spare(time: FloatArray) -> FloatArray:
        share = ((cycle / np.ravel(time)) ** 2 - 1)[:, None]
        peak = np.max(np.abs(total + share * inertial), axis=1).reshape(np.shape(time)) / most
        allowed = servo.motor.peak_at(servo.reducer.ratio * turn / time)
        return np.asarray(allowed - MARGIN * servo.duty.peak * peak)

    found = float(bracketed_roots(spare, np.array([cycle * _SHORTEST]), np.array([cycle]))[0])
    return found if math.isfinite(found) else cycle
