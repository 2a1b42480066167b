"""The shedding cams in a loom: their parameters from its task, their lines in its parts list, their work."""

import math
from collections.abc import Mapping
from typing import Any

from ilmek.elements.drive_parts import motor_part, positive_work, reducer_part
from ilmek.machines.arrangement.spans import ShedRoom, shed_room, shed_spans, warp_length
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding.design import SheddingDesign, design
from ilmek.machines.shedding.params import SheddingParams
from ilmek.report import NOT_WEIGHED, Part, Work
from ilmek.units import format_quantity, mm

STEEL = "structural steel"

ITERATIONS = 20
FIRST_PRIME = 80 * mm
"""Prime radius for the spans of the first iteration [m]; the cams are then designed for their pressure angle."""

LARGEST_PRIME = 1.0
"""Largest prime radius that is tried [m]."""


def fit(task: LoomTask) -> SheddingParams:
    """The parameters for a loom, with a prime radius that leaves room for the shaft's bore.

    A larger cam is heavier and needs a thicker shaft: the prime radius, in whole millimetres, is found by iteration,
    and with it the spans of the warps that leave the guide cams their room.
    """
    room, given = shed_room(task), task.params.machines.of("shedding")
    prime, found = FIRST_PRIME, _at_prime(task, room, FIRST_PRIME, given)
    for _ in range(ITERATIONS):
        made = design(found)
        least = made.prime_radius_for_bore
        enough = "prime_radius" in given or made.cam.prime_radius >= least or least > LARGEST_PRIME
        if enough and made.cam.prime_radius == prime:
            break
        prime = made.cam.prime_radius if enough else math.ceil(least / mm) * mm
        found = _at_prime(task, room, prime, given)
    return found


def _at_prime(task: LoomTask, room: ShedRoom, prime: float, given: Mapping[str, Any]) -> SheddingParams:
    """The parameters with a prime radius [m] and the spans that it needs; those `given` by the user in their place."""
    params = task.params
    usual = task.parameters("shedding", SheddingParams(lift=params.lift))
    spans = shed_spans(room, prime, prime + usual.lift - usual.roller_radius + usual.guide_height)
    both = {"front_span": spans.front[0], "back_span": spans.back[0]}
    length = warp_length(room, spans)
    derived = SheddingParams(
        lift=params.lift,
        warps=task.warps,
        warp_pitch=params.pitch,
        tension=task.tension,
        **({"half_span": given["half_span"]} if "half_span" in given else both),
        warp_stiffness=task.yarns.warp.stiffness,
        warp_length=length,
        shuttle_height=room.opening,
        prime_radius=None if prime == FIRST_PRIME else prime,
        speed=params.shed_speed,
        shaft_length=task.width,
        spans=math.ceil(task.width / params.shaft_span - 1e-9),
    )
    return task.parameters("shedding", derived)


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
