"""What the warp tension chose of what was left open, and the checks that the next cheaper ones fail."""

from collections.abc import Iterator

from ilmek.elements.beam import uniform
from ilmek.elements.motors import MOTORS, Motor, smallest_motor
from ilmek.elements.tubes import Tube
from ilmek.machines.warp_tension.cylinders import (
    bearing_checks,
    bearings_offered,
    cylinders,
    slots_of,
    spacer_load,
    spacer_tubes,
)
from ilmek.machines.warp_tension.design import (
    RATIOS,
    WarpTensionDesign,
    peak_rate,
    tube_weight,
    tubes_offered,
    worst_load,
)
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.report import Alternative, Check, Choice, at_most, choose


def choices(design: WarpTensionDesign) -> tuple[Choice, ...]:
    """Tube, tube of the spacer, bearings, motor and ratio, as far as they were left open."""
    return tuple(_choices(design))


def _choices(design: WarpTensionDesign) -> Iterator[Choice]:
    params, load = design.params, worst_load(design.params)
    offered = sorted(tubes_offered(params), key=lambda tube: tube.area)
    if offered:
        yield choose("tube", [Alternative(one.name, tube_checks(params, one, 0.0, load)) for one in offered])[1]
    if params.spacer_tube is None:
        depth, pull = slots_of(params).depth, spacer_load(params, abs(load))
        found = [Alternative(one.name, tube_checks(params, one, depth, pull)) for one in spacer_tubes(params)]
        yield choose("spacer_tube", found)[1]
    if params.bearing is None:
        most = max(cylinders(design), key=lambda one: one.reaction)
        given = most.reaction, most.torque, most.slope
        yield choose(
            "bearing",
            [Alternative(bearing.name, bearing_checks(params, bearing, *given)) for bearing in bearings_offered()],
        )[1]
    if params.by_hand:
        return
    if params.motor_torque is None:
        by_power = sorted(MOTORS, key=lambda motor: motor.power)
        yield choose("motor", [Alternative(one.name, motor_checks(design, one)) for one in by_power])[1]
    if params.motor_torque is None and params.ratio is None and design.motor is not None:
        yield choose(
            "ratio", [Alternative(f"{ratio:g}", ratio_checks(design, ratio, design.motor)) for ratio in RATIOS]
        )[1]


def tube_checks(params: WarpTensionParams, tube: Tube, depth: float, load: complex) -> tuple[Check, ...]:
    """Slope and deflection of a tube with slots of a depth [m] under a load [N/m] and its own weight."""
    outer, inner = tube.outer_radius - depth, tube.inner_radius
    size = abs(load - 1j * tube_weight(params, inner, outer))
    bent = size, params.span, params.modulus, float(uniform.tube_inertia(outer, inner))
    return (
        at_most("slope in the bearings", float(uniform.slope_max(*bent)), params.slope_limit, "rad", "slope_limit"),
        at_most("deflection", float(uniform.deflection_max(*bent)), params.deflection_limit, "mm", "deflection_limit"),
    )


def motor_checks(design: WarpTensionDesign, motor: Motor) -> tuple[Check, ...]:
    """Torque of a motor behind the largest of the ratios at which it is quick enough; its speed where none is."""
    params, rate = design.params, peak_rate(design.params, design.outer_radius)
    ratios = RATIOS if params.ratio is None else (params.ratio,)
    quick = max((ratio for ratio in ratios if ratio * rate <= motor.speed), default=0.0)
    if not quick:
        return (at_most("motor speed", min(ratios) * rate, motor.speed, "rpm", "its rated speed"),)
    torque = design.torque_full / (quick * params.efficiency)
    return (at_most("motor torque", torque, motor.torque, "Nm", "its continuous torque"),)


def ratio_checks(design: WarpTensionDesign, ratio: float, motor: Motor) -> tuple[Check, ...]:
    """Power of the least motor at a ratio against that of the one chosen."""
    speed = ratio * peak_rate(design.params, design.outer_radius)
    least = smallest_motor(design.torque_full / (ratio * design.params.efficiency), speed)
    power = least.power if least else float("inf")
    return (at_most("power of the motor", power, motor.power, "W", "the least motor at any ratio"),)
