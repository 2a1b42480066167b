"""The warp tension in a loom: parameters from its task with the lightest tube, lines of its parts list, its work."""

from dataclasses import replace

from ilmek.elements.drive_parts import motor_part, reducer_part
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.warp_loads import loads_in_loom
from ilmek.machines.warp_tension.cylinders import Cylinder, cylinders
from ilmek.machines.warp_tension.design import USUAL, WarpTensionDesign
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.report import BillLine, Work
from ilmek.units import format_quantity

STEEL = "structural steel"


def fit(task: LoomTask) -> WarpTensionParams:
    """The parameters for a loom, with the lightest of the usual tubes that keeps slope and deflection."""
    params, loads = task.params, loads_in_loom(task)
    assert task.side is not None
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
            free_length=task.side.warp_length,
            warp_stiffness=task.yarns.warp.stiffness,
            warp_diameter=task.yarns.warp.diameter,
            friction=task.yarns.warp.friction,
            shed_lift=params.lift,
            shed_span=task.side.front_span,
            tension_shed=loads.lifted,
            tension_shed_low=loads.others,
            tension_beat=loads.beat,
            warps_beaten=loads.beaten,
            breaking_force=task.yarns.warp.breaking_force,
        ),
    )
    if any(one is not None for one in (derived.tube, derived.outer_radius, derived.inner_radius)):
        return derived
    return replace(derived, tube=USUAL)


def parts(made: WarpTensionDesign) -> tuple[BillLine, ...]:
    """Cylinders, bearings, drives: upper and lower cylinder are alike; a motor for each of the three [thesis 3.1]."""
    upper, lower, spacer = cylinders(made)
    return (
        BillLine("cylinder", 2, _tube(upper), STEEL, "steel tube", upper.mass),
        BillLine("spacer cylinder", 1, _tube(spacer), STEEL, "steel tube", spacer.mass),
        *(
            BillLine(f"bearing of the {one.name}", 2, one.bearing.name, "", "bearing", one.bearing.mass)
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
