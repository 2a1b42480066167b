"""The tension compensator in a loom: its parameters from the task, its lines in the parts list."""

import numpy as np

from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding import shed_lengthenings
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.params import STEEL, TensionCompensatorParams
from ilmek.report import NOT_WEIGHED, BillLine
from ilmek.units import format_quantity, mm, turn

SAMPLES = 73
"""Angles of the cam shaft at which the lengthening of the warps is computed, 5 degrees apart."""


def fit(task: LoomTask) -> TensionCompensatorParams:
    """The parameters for a loom: its warps, and the shed of its cams."""
    params, cams, side = task.params, task.designs["shedding"], task.side
    assert side is not None
    shed, turns = cams.params, np.linspace(0.0, turn, SAMPLES)
    return task.parameters(
        "tension-compensator",
        TensionCompensatorParams(
            warps=task.warps,
            tension=task.tension,
            warp_stiffness=task.yarns.warp.stiffness,
            warp_length=side.warp_length,
            warp_pitch=params.pitch,
            width=task.cloth_width,
            lift=side.lift,
            front_span=side.front_span,
            back_span=side.back_span,
            lengthening=float(max(parity.max() for parity in shed_lengthenings(cams, turns))),
            rise=shed.rise,
            dwell=shed.dwell,
            fall=shed.fall_angle,
            law=shed.law,
            speed=shed.speed,
        ),
    )


def parts(made: TensionCompensator) -> tuple[BillLine, ...]:
    """Bars and rods, their rollers, levers, springs, pins and beams."""
    params, members, number = made.params, made.members, made.bars * made.levers
    tube = members.tube.mass(STEEL.density) * params.width
    flat = params.lever_thickness * members.lever * (params.bar_arm + params.spring_arm) * STEEL.density
    wound = "none of the table is enough"
    if made.one.spring is not None:
        diameter = made.one.spring.wire_diameter / mm
        wound = f"{params.wire} {diameter:g} mm, {format_quantity(made.one.rate, 'N/mm', 3)}"
    beam = members.beam.line_mass * params.width
    spring = made.one.spring.mass if made.one.spring else NOT_WEIGHED
    return (
        BillLine("bar of the compensator", made.bars, f"tube {members.tube.name} mm", STEEL.name, "steel tube", tube),
        BillLine(
            "rod of the compensator", 2 * made.bars, f"tube {members.tube.name} mm", STEEL.name, "steel tube", tube
        ),
        BillLine("roller of bars and rods", 6 * number, "two at every support", "", "bearing"),
        BillLine("lever of the compensator", number, "with its pin and bush", STEEL.name, "machined link", flat),
        BillLine("spring of the compensator", number * made.springs, wound, "", "spring", spring),
        BillLine("beam of the compensator", made.bars, members.beam.name, STEEL.name, "welded frame", beam),
    )
