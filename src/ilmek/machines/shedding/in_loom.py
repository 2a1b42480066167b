"""The shedding cams in a loom: their parameters from its task, their lines in its parts list, their work."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ilmek.elements.drive_parts import positive_work
from ilmek.machines.arrangement.spans import ShedRoom, shed_room, shed_spans, warp_length
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding.cam_shaft import smallest_prime
from ilmek.machines.shedding.design import SheddingDesign, design
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.warp_loads import planned_bars, planned_compensation
from ilmek.records import value_record
from ilmek.report import Work
from ilmek.units import mm
from ilmek.weaving.shed import shed_lengthening

ITERATIONS = 6
"""Trials of the spans: the room that the guides need depends on the bars, and these on the warps' forces."""

USUAL_SPAN = 0.4
"""Spans of the warps before they are known [m]."""

LONGER, STEP = 1.5, 10 * mm
"""Longer back spans that are tried for a soft or slack warp, and their step [m]; assumed by this project."""

SPARE = 1.05
"""Gain of a warp's tension that is planned for, over that by mean spans: the cams' own lengthening is a little more."""

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
        params = _with_spans(task, room, outline, given)
        made = _outline_of(design(params))
        if not made.differs(outline):
            break
        outline = made
    return params


def _usual(task: LoomTask, given: Mapping[str, Any]) -> SheddingParams:
    """Parameters with the loom's lift, for spans of which the user may set one or all."""
    if "half_span" in given:
        return SheddingParams(cloth=task.cloth, lift=task.params.lift, half_span=given["half_span"])
    return SheddingParams(cloth=task.cloth, lift=task.params.lift, front_span=USUAL_SPAN, back_span=USUAL_SPAN)


def _outline_of(made: SheddingDesign) -> _Outline:
    first, last = ((one.cam.prime_radius, one.stack.guide_radius) for one in (made.first, made.shafts[-1]))
    return _Outline(first, last, made.shafts[-1].beyond)


def _with_spans(task: LoomTask, room: ShedRoom, outline: _Outline, given: Mapping[str, Any]) -> SheddingParams:
    """The parameters with the spans that shafts of an outline need; those `given` by the user in their place."""
    params, spans = task.params, shed_spans(room, *outline.first)
    front, beside = spans.front[0], warp_length(room, spans) + outline.apart - spans.back[0]
    back = _single_bar(task, front, shed_spans(room, *outline.last).back[0], beside)
    both = {"front_span": front, "back_span": back}
    derived = SheddingParams(
        cloth=task.cloth,
        lift=params.lift,
        **({"half_span": given["half_span"]} if "half_span" in given else both),
        warp_length=beside + back,
        compensation=planned_compensation(task, _gain(task, front, back, beside)),
        shuttle_height=room.opening,
        guideway=False,
        speed=params.cam_speed,
        stop_time=params.shed_stop / 2 if params.shed_stop > 0 else None,
        shaft_length=task.width,
        spans=math.ceil(task.width / params.shaft_span - 1e-9),
    )
    return task.parameters("shedding", derived)


def _single_bar(task: LoomTask, front: float, back: float, beside: float) -> float:
    """The back span [m], at least `back`, with which one bar of the compensator keeps the warps' tension: a second has
    no room below them. `back` where two are given, or one is too few with any span.

    beside  length of a warp that is not in the back span [m]
    """
    offered = (back + longer for longer in np.arange(0.0, LONGER, STEP).tolist())
    return next((one for one in offered if planned_bars(task, SPARE * _gain(task, front, one, beside)) == 1), back)


def _gain(task: LoomTask, front: float, back: float, beside: float) -> float:
    """Gain of a lifted warp's tension on a fixed back rest [N]; arguments as above."""
    longer = float(shed_lengthening(task.params.lift, front, back))
    return task.yarns.warp.stiffness / (beside + back) * longer


def work(made: SheddingDesign) -> tuple[Work, ...]:
    """The work of a row: a turn of every shaft, each with a motor of its own, without recovery."""
    return (Work("shedding", sum(positive_work(shaft.shed.torque) for shaft in made.shafts), "row"),)
