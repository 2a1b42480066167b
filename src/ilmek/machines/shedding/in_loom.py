"""The shedding cams in a loom: their parameters from its task, their lines in its parts list, their work."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from ilmek.elements.drive_parts import motor_part, positive_work, reducer_part
from ilmek.machines.arrangement.spans import ShedRoom, shed_room, shed_spans, warp_length
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding.cam_shaft import CamShaft, smallest_prime
from ilmek.machines.shedding.design import SheddingDesign, design
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.warp_loads import planned_compensation
from ilmek.records import value_record
from ilmek.report import BillLine, Work
from ilmek.units import format_quantity
from ilmek.weaving.shed import shed_lengthening

STEEL = "structural steel"

ITERATIONS = 6
"""Trials of the spans: the room that the guides need depends on the bars, and these on the warps' forces."""

USUAL_SPAN = 0.4
"""Spans of the warps before they are known [m]."""

SAME = 1e-6
"""Difference in size that needs no other spans [m]."""


@value_record
class _Outline:
    """Prime and guide radius of the first and of the last shaft, and the distance between the two [m]."""

    first: tuple[float, float]
    last: tuple[float, float]
    apart: float

    def differs(self, other: "_Outline") -> bool:
        mine, others = ((*one.first, *one.last, one.apart) for one in (self, other))
        return max(abs(a - b) for a, b in zip(mine, others, strict=True)) > SAME


def fit(task: LoomTask) -> SheddingParams:
    """The parameters for a loom: its warps, between spans that leave the guides of its cam shafts their room.

    Carrier and comb have room below the guides of the first shaft, the back rest above those of the last. The carrier
    runs in the shed in front of the guides, not on the cams' tips.
    """
    room, given = shed_room(task), task.params.machines.of("shedding")
    usual = task.parameters("shedding", _usual(task, given))
    prime = usual.prime_radius or smallest_prime(usual).value
    usual_outline = prime, prime + usual.lift - usual.roller_radius + usual.guide_height
    outline = _Outline(usual_outline, usual_outline, 0.0)
    for _ in range(ITERATIONS):
        found = _with_spans(task, room, outline, given)
        made = _outline_of(design(found))
        if not made.differs(outline):
            break
        outline = made
    return found


def _usual(task: LoomTask, given: Mapping[str, Any]) -> SheddingParams:
    """Parameters with the loom's lift, for spans of which the user may set one or all."""
    if "half_span" in given:
        return SheddingParams(lift=task.params.lift, tension=task.tension, half_span=given["half_span"])
    return SheddingParams(lift=task.params.lift, tension=task.tension, front_span=USUAL_SPAN, back_span=USUAL_SPAN)


def _outline_of(made: SheddingDesign) -> _Outline:
    first, last = ((one.cam.prime_radius, one.stack.guide_radius) for one in (made.first, made.shafts[-1]))
    return _Outline(first, last, made.shafts[-1].beyond)


def _with_spans(task: LoomTask, room: ShedRoom, outline: _Outline, given: Mapping[str, Any]) -> SheddingParams:
    """The parameters with the spans that shafts of an outline need; those `given` by the user in their place."""
    params, warp = task.params, task.yarns.warp
    spans = shed_spans(room, *outline.first)
    back = shed_spans(room, *outline.last).back[0]
    both = {"front_span": spans.front[0], "back_span": back}
    length = warp_length(room, spans) + outline.apart + back - spans.back[0]
    gain = warp.stiffness / length * float(shed_lengthening(params.lift, spans.front[0], back))
    derived = SheddingParams(
        lift=params.lift,
        warps=task.warps,
        warp_pitch=params.pitch,
        warp_diameter=warp.diameter,
        tension=task.tension,
        **({"half_span": given["half_span"]} if "half_span" in given else both),
        warp_stiffness=warp.stiffness,
        warp_length=length,
        compensation=planned_compensation(task, gain),
        breaking_force=warp.breaking_force,
        friction=warp.friction,
        shuttle_height=room.opening,
        guideway=False,
        speed=params.shed_speed,
        stop_time=params.shed_stop / 2 if params.shed_stop > 0 else None,
        shaft_length=task.width,
        spans=math.ceil(task.width / params.shaft_span - 1e-9),
    )
    return task.parameters("shedding", derived)


def parts(made: SheddingDesign) -> tuple[BillLine, ...]:
    """Cams, guides and spacers, and of every shaft the bar, its bearings and steadies, motor and reducer."""
    several = len(made.shafts) > 1
    return tuple(
        part
        for index, one in enumerate(made.shafts)
        for part in _of_shaft(made, one, f" {index + 1}" if several else "")
    )


def _of_shaft(made: SheddingDesign, one: CamShaft, number: str) -> Iterator[BillLine]:
    """Lines of a shaft; `number` is added to the names where there are several."""
    params, stack, shaft, drive, cams = one.params, one.stack, one.shaft, one.drive, sum(one.numbers)
    prime, guide, bar = (format_quantity(size, "mm") for size in (one.cam.prime_radius, stack.guide_radius, shaft.bar))
    cut = "laser-cut part"
    yield BillLine(f"shedding cam{number}", cams, f"prime radius {prime}", STEEL, cut, stack.cam_mass)
    if stack.shares.guides:
        guides = cams * stack.shares.guides
        yield BillLine(f"guide cam{number}", guides, f"radius {guide}", STEEL, cut, stack.guide_mass)
    else:
        dents = made.params.warps + 1
        yield BillLine(f"dent of the reed{number}", dents, f"round {guide}", STEEL, cut, stack.guide_mass)
    if stack.spacer_mass > 0:
        ring = format_quantity(stack.shares.spacer, "mm")
        yield BillLine(f"spacer of the cams{number}", cams, f"{ring} thick", STEEL, cut, stack.spacer_mass)
    mass, ends, name = shaft.bar**2 * shaft.length * params.density, shaft.seat.bearing, f"cam shaft{number}"
    yield BillLine(name, 1, f"square {bar}", STEEL, "steel bar", mass, shaft.length)
    yield BillLine(f"bearing of the {name}", 2, ends.name, "", "bearing", ends.mass)
    if params.spans > 1:
        yield BillLine(f"steady of the {name}", params.spans - 1, "rollers", "", "bearing")
    yield motor_part(f"motor of the {name}", drive.motor, drive.motor_torque, drive.motor_speed)
    yield reducer_part(f"reducer of the {name}", drive.reducer.ratio, drive.motor)


def work(made: SheddingDesign) -> tuple[Work, ...]:
    """The work of a row: a turn of every shaft, each with a motor of its own, without recovery."""
    return (Work("shedding", sum(positive_work(one.shed.torque) for one in made.shafts), "row"),)
