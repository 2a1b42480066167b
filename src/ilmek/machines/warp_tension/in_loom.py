"""The warp tension in a loom: parameters from its task with the lightest tube, lines of its parts list, its work."""

from dataclasses import replace

from ilmek.elements.drive_parts import motor_part, reducer_part
from ilmek.elements.tubes import Tube, find_tube
from ilmek.errors import LoomError
from ilmek.machines.arrangement import HALF_SPAN
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.warp_tension.cylinders import Cylinder, cylinders
from ilmek.machines.warp_tension.design import WarpTensionDesign, tubes_within_limits
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.report import Part, Work
from ilmek.units import format_quantity, mm

STEEL = "structural steel"

STOCK_TUBES = (
    *map(find_tube, ("140x5", "139.7x10", "168.3x6.3", "168.3x10", "193.7x8", "219.1x8", "219.1x12.5", "244.5x10")),
    *map(find_tube, ("273x10", "273x16", "323.9x12.5", "355.6x16", "406.4x16", "457x20")),
    *(Tube(outer * mm, wall * mm, "EN 10210-2") for outer, wall in ((508, 25), (610, 30), (711, 40))),
)
"""Tubes for the cylinders of a loom: the thesis' 140 x 5 mm, others of stock, and three large ones for wide looms."""


def fit(task: LoomTask) -> WarpTensionParams:
    """The parameters for a loom, with the lightest of `STOCK_TUBES` that keeps slope and deflection.

    Raises LoomError where none does.
    """
    params = task.params
    derived = task.parameters(
        "warp-tension",
        WarpTensionParams(
            warps=task.warps,
            tension=task.tension,
            width=task.width,
            row_pitch=task.row_pitch,
            take_up_time=task.take_up_time,
            row_time=task.row_time,
            carpet_length=params.length,
            warp_pitch=params.pitch,
            free_length=params.warp_length,
            warp_stiffness=task.yarns.warp.stiffness,
            warp_diameter=task.yarns.warp.diameter,
            friction=task.yarns.warp.friction,
            shed_lift=params.lift,
            shed_span=HALF_SPAN,
        ),
    )
    if any(one is not None for one in (derived.tube, derived.outer_radius, derived.inner_radius)):
        return derived
    found = tubes_within_limits(derived, STOCK_TUBES)
    if not found:
        pull, across = format_quantity(derived.pull / derived.width, "kN/m"), format_quantity(derived.width, "m")
        raise LoomError(
            f"no stock tube carries {pull} of warps over {across}",
            allowed=f"slope {derived.slope_limit:g} rad, deflection {format_quantity(derived.deflection_limit, 'mm')}",
            do="set a lower tension or a narrower carpet",
        )
    return replace(derived, outer_radius=found[0].outer_radius, inner_radius=found[0].inner_radius)


def parts(made: WarpTensionDesign) -> tuple[Part, ...]:
    """Cylinders, bearings, drives: upper and lower cylinder are alike; a motor for each of the three [thesis 3.1]."""
    upper, lower, spacer = cylinders(made)
    return (
        Part("cylinder", 2, _tube(upper), STEEL, "steel tube", upper.mass),
        Part("spacer cylinder", 1, _tube(spacer), STEEL, "steel tube", spacer.mass),
        *(
            Part(f"bearing of the {one.name}", 2, one.bearing.name, "", "bearing", one.bearing.mass)
            for one in (upper, lower, spacer)
        ),
        motor_part("motor of a cylinder", made.motor, made.motor_torque, made.motor_speed, 3),
        reducer_part("reducer of a cylinder", made.reducer.ratio, made.motor, 3),
    )


def _tube(one: Cylinder) -> str:
    """Outer diameter and wall of a cylinder: of the stock tube, or of its own."""
    outer, wall = (2 * one.outer, one.outer - one.inner) if one.tube is None else (one.tube.outer, one.tube.wall)
    return f"tube {format_quantity(outer, 'mm')} x {format_quantity(wall, 'mm')}"


def work(made: WarpTensionDesign) -> tuple[Work, ...]:
    """The work of taking up the carpet against the pull of the warps, the reducer's losses included."""
    params = made.params
    return (Work("take-up", params.pull * params.carpet_length / made.reducer.efficiency, "carpet"),)
