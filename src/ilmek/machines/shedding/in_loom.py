"""The shedding cams in a loom: their parameters from its task, their lines in its parts list, their work."""

import math
from dataclasses import replace

from ilmek.elements.drive_parts import motor_part, positive_work, reducer_part
from ilmek.machines.arrangement import HALF_SPAN
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding.design import SheddingDesign, design
from ilmek.machines.shedding.params import SheddingParams
from ilmek.report import NOT_WEIGHED, Part, Work
from ilmek.units import format_quantity, mm

STEEL = "structural steel"

ITERATIONS = 20
LARGEST_PRIME = 1.0
"""Largest prime radius that is tried [m]."""


def fit(task: LoomTask) -> SheddingParams:
    """The parameters for a loom, with a prime radius that leaves room for the shaft's bore.

    A larger cam is heavier and needs a thicker shaft: the prime radius, in whole millimetres, is found by iteration.
    """
    params = task.params
    derived = task.parameters(
        "shedding",
        SheddingParams(
            lift=params.lift,
            warps=task.warps,
            warp_pitch=params.pitch,
            tension=task.tension,
            half_span=HALF_SPAN,
            warp_stiffness=task.yarns.warp.stiffness,
            warp_length=max(params.warp_length, 2 * HALF_SPAN),
            shuttle_height=params.shuttle_height,
            speed=params.shed_speed,
            shaft_length=task.width,
            spans=math.ceil(task.width / params.shaft_span - 1e-9),
        ),
    )
    found = derived
    for _ in range(ITERATIONS if derived.prime_radius is None else 0):
        made = design(found)
        least = made.prime_radius_for_bore
        if made.cam.prime_radius >= least or least > LARGEST_PRIME:
            break
        found = replace(derived, prime_radius=math.ceil(least / mm) * mm)
    return found


def parts(made: SheddingDesign) -> tuple[Part, ...]:
    """Cams, guide cams, shaft, its bearings and steadies, motor and reducer."""
    params, stack, shaft, drive = made.params, made.stack, made.shaft, made.drive
    prime, guide, bar = (format_quantity(size, "mm") for size in (made.cam.prime_radius, stack.guide_radius, shaft.bar))
    mass, ends = shaft.bar**2 * shaft.length * params.density, shaft.seat.bearing
    bearing, weight = ("none of the table is enough", NOT_WEIGHED) if ends is None else (ends.name, ends.mass)
    steadies = (Part("steady of the cam shaft", params.spans - 1, "rollers", "", "bearing"),)
    return (
        Part("shedding cam", params.warps, f"prime radius {prime}", STEEL, "laser-cut part", stack.cam_mass),
        Part("guide cam", params.warps, f"radius {guide}", STEEL, "laser-cut part", stack.guide_mass),
        Part("cam shaft", 1, f"square {bar}", STEEL, "steel bar", mass, shaft.length),
        Part("bearing of the cam shaft", 2, bearing, "", "bearing", weight),
        *(steadies if params.spans > 1 else ()),
        motor_part("motor of the cam shaft", drive.motor, drive.motor_torque, drive.motor_speed),
        reducer_part("reducer of the cam shaft", drive.reducer.ratio, drive.motor),
    )


def work(made: SheddingDesign) -> tuple[Work, ...]:
    """The work of a row: a turn of the shaft."""
    return (Work("shedding", positive_work(made.shed.torque), "row"),)
