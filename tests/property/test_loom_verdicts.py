"""Verdicts on looms against reasons that are written here from first principles, not from the code under test.

A row of the table: settings of a loom, and the reasons for which it cannot weave, as patterns of their checks' names.
Every failed check must be one of them, and each of them must fail; no reason: the loom weaves. Where a reason has a
figure, it is recomputed here by its textbook formula.
"""

import math
import re
from collections.abc import Callable
from typing import Any

import pytest
from default_machines import loom_report

from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.report import all_checks
from ilmek.report import Check, reasons
from ilmek.units import GPa, mm

N_WARPS, PITCH = 608, 2 * mm
"""The default loom: 300 knots at 4 mm, two warps each, eight of the selvedges."""

ROWS = 4 * mm / 0.99 * (1 + 15 / (2.1 * 641.11))
"""25 rows a dm of the finished carpet: 1 % longer before it is washed, on cotton of 2.1 N/tex under 15 N."""

Figure = Callable[[LoomDesign], tuple[float, float]]
"""Value and limit of a reason, recomputed."""


def warp_diameter(tex: float) -> float:
    """Of cotton: mu = phi rho pi d^2 / 4, with 1520 kg/m^3 and a packing of 0.6."""
    return math.sqrt(4 * tex * 1e-6 / (math.pi * 1520 * 0.6))


def rows_after(force: float) -> float:
    """Distance of rows after a force on a warp: F = K T (1/(p - D) - 1/(P - D)), P, D, K = 1.5, 0.75, 0.25 rows."""
    laid, jammed, packing, tension = 1.5 * ROWS, 0.75 * ROWS, 0.25 * ROWS, 15.0
    return jammed + 1 / (force / (packing * tension) + 1 / (laid - jammed))


def half_of_breaking(_loom: LoomDesign) -> tuple[float, float]:
    """A cotton warp of 641 tex breaks at 17 cN/tex; 60 N and what the shed adds are more than half of it."""
    return math.nan, 0.5 * 0.17 * 641.11


def thin_tube(loom: LoomDesign) -> tuple[float, float]:
    """5 w l^4 / (384 E I) of a tube 140 x 5 mm over the width, under the worst pull and its own weight."""
    tension = loom.warp_tension
    inertia = math.pi / 64 * ((140 * mm) ** 4 - (130 * mm) ** 4)
    weight = math.pi / 4 * ((140 * mm) ** 2 - (130 * mm) ** 2) * tension.params.density * 9.80665
    worst = max(check.value for check in all_checks(loom) if check.name == "deflection")
    length = loom.task.cloth.width + 2 * 50 * mm
    load = worst * 384 * tension.params.modulus * inertia / (5 * length**4)
    assert load - weight >= loom.warps * 15.0 / length * (1 - 1e-9), "the worst pull is at least that at rest"
    return worst, 1 * mm


def weak_press(_loom: LoomDesign) -> tuple[float, float]:
    """A force of 1 N on a warp, where 10 N are needed."""
    assert rows_after(10.0) == pytest.approx(ROWS)
    return rows_after(1.0), 1.02 * ROWS


def buckling(loom: LoomDesign) -> tuple[float, float]:
    """Euler's load of a screw of 12 mm, clamped at one end and guided at the other: 2.046 pi^2 E I / l^2, over the
    quarter of the weight that it carries at least: the safety is less than that, and the limit is 3.
    """
    length = loom.beat.beat.stroke
    euler = 2.046 * math.pi**2 * 210 * GPa * math.pi / 64 * (12 * mm) ** 4 / length**2
    assert euler / (loom.beat.design.mass * 9.80665 / 4) > 0.9
    return math.nan, 3.0


def _plate() -> float:
    """Thickness of a cam on two shafts at a pitch of 0.25 mm [m]."""
    return (0.5 * mm - warp_diameter(29.525) - 2 * 0.025 * mm) / 3


BESIDE: dict[str, Figure | None] = {
    "room of the rapier": lambda loom: (loom.task.cloth.width + 0.51, 3.0),
    "bow of the beam behind the cams": None,  # between brackets as wide as the reducers' flanges it is low
}

DRIVE = r"force of a warp|distance of the rows|force of the crank-rockers"

TABLE: tuple[tuple[dict[str, Any], dict[str, Figure | None]], ...] = (
    # What must weave: the shipped loom, every beat, every quality up to 100 knots/dm, both knots.
    ({}, {}),
    ({"aim": "time"}, {}),
    *(({"beat": beat}, {}) for beat in ("travelling", "linkage", "comb", "guide-cams")),
    *(({"beat": "comb", "warp_pitch": pitch}, {}) for pitch in ("0.5mm", "0.7mm", "1mm", "4mm")),
    ({"beat": "comb", "warp_pitch": "0.5mm", "knot": "asymmetric"}, {}),
    ({"beat": "comb", "knot": "asymmetric"}, {}),
    ({"beat": "linkage", "width": "0.6m", "length": "0.9m"}, {}),
    # The yarn is led round every bend of a chain of 6 m from the creel.
    # The columns, in the room between the cylinders' reducers, bow under the warps' pull.
    (
        {"beat": "comb", "width": "6m", "length": "9m"},
        {"yarn path: pull at the eye": None, "frame: bow of a column": None},
    ),
    # A rapier of the cloth's width, both runs to the edge, its clamp and drive, within 3 m beside the cloth.
    # One head on 4 m has too long a chain and belt, and a yarn that is led too far.
    # Fuses of large servos: more than the largest cabinet has.
    ({"beat": "guide-cams", "width": "4m", "length": "6m"}, {**BESIDE, "control: length of its mounting rails": None}),
    ({"beat": "comb", "heads": 7}, {}),
    ({"beat": "comb", "colours": 200}, {"energy chain: width of its lines": None}),
    # The head of the thesis leads both ends round the outside of their warps: never the asymmetric knot.
    ({"beat": "comb", "knotting": "cams", "knot": "asymmetric"}, {"asymmetric knot tied": None}),
    # 0.25 mm: a warp of 29.5 tex is 0.203 mm thick, which leaves 0.047 mm between two. On two shafts a cam and its two
    # guide cams share the pitch of 0.5 mm with the other warp and its clearances of 0.025 mm.
    (
        {"beat": "comb", "warp_pitch": "0.25mm", "width": "0.6m", "length": "0.9m"},
        {
            "opener: points between two warps": lambda _: (math.nan, 0.25 * mm - warp_diameter(29.525)),
            "thickness of a(?: guide)? cam": lambda _: (_plate(), math.nan),
            "groove against warp": lambda _: (_plate() - 0.02 * mm, warp_diameter(29.525)),
            "cam stack": None,  # nothing is left of a guide cam for shims
            "buckling of a cam": None,  # it is thinner than its groove by the tolerance of the sheet
            "guide rod in its sleeve": None,  # the compensator's springs are short
            "yarn path: tension of the yarn": None,  # a yarn so fine bears less than the pull of the head
        },
    ),
    (
        {"beat": "comb", "tension": "60N"},
        {"tension of a (?:lifted|displaced) warp": half_of_breaking, "springs of the table": None},
    ),
    # Thicker than their pitch, warps lie in no slot, no groove and no opener.
    (
        {"beat": "comb", "yarns.warp_diameter": "2.2mm"},
        {
            "warps beside each other": lambda _: (2.2 * mm, 2 * mm),
            "opener|land between slots|warp in its slot|groove against warp|Hertz|springs|clearance|cam|gap": None,
            "lip of a side plate": None,
        },
    ),
    (
        {"beat": "comb", "width": "4m", "length": "6m", "warp-tension.tube": "140x5", "pile_height": "8mm"},
        {"^(?:warp-tension: )?deflection$": thin_tube, "slope in the bearings|bending stress|under its slot": None},
    ),
    ({"beat": "comb", "hammer.force": "1N"}, {"distance of the rows that": weak_press, DRIVE: None}),
    (
        {"beat": "linkage", "hammer.beat_speed": "15.5rad/s", "hammer.ballast": "0kg"},
        {"force of the crank-rockers": None, DRIVE: None},
    ),
    (
        {"beat": "guide-cams", "width": "4m", "length": "6m", "hammer.axes": 4, "hammer.screw_diameter": "12mm"},
        {
            "buckling of the screws": buckling,
            "(?:life|static load|critical speed) of the screws|servo over": None,
            **BESIDE,
        },
    ),
    # Guide cams of 148 mm do not clear what stands 80 mm from their shaft.
    (
        {"beat": "comb", "shedding.half_span": "80mm"},
        {"clearance: .*guide cams": None, "clearance|span|reach|hold|tension in the open shed|sensors": None},
    ),
    # 135,000 knots at 1.18 s are 44 h for one head, 6.3 h for seven.
    ({"beat": "comb", "deadline": "6h"}, {"weaving time": lambda _: (math.nan, 21_600.0)}),
    ({"beat": "comb", "price_limit": 10_000}, {"price of the loom": lambda _: (math.nan, 10_000.0)}),
)


def matches(check: Check, pattern: str) -> bool:
    return re.search(pattern, check.name) is not None


@pytest.mark.matrix(light=7)
@pytest.mark.parametrize(
    ("settings", "expected"), TABLE, ids=[" ".join(f"{k}={v}" for k, v in one.items()) or "default" for one, _ in TABLE]
)
def test_the_verdict_has_these_reasons_and_no_other(
    settings: dict[str, Any], expected: dict[str, Figure | None]
) -> None:
    loom = design(AutomatedLoomParams.read({"aim": "price", **settings}))
    found = all_checks(loom)
    failed = [check for check in found if not check.ok]
    unforeseen = [check.name for check in failed if not any(matches(check, pattern) for pattern in expected)]
    assert unforeseen == []
    for pattern, figure in expected.items():
        meant = [check for check in failed if matches(check, pattern)]
        assert meant, pattern
        if figure is None:
            continue
        value, limit = figure(loom)
        assert any(
            (math.isnan(value) or one.value == pytest.approx(value, rel=2e-3))
            and (math.isnan(limit) or one.limit == pytest.approx(limit, rel=2e-3))
            for one in meant
        ), [(one.name, one.value, one.limit) for one in meant]


def test_the_reasons_stand_in_order_of_weight() -> None:
    report = loom_report(
        design(AutomatedLoomParams.read({"aim": "price", "beat": "comb", "hammer.force": "1N", "tension": "60N"}))
    )
    found = reasons(report.all_checks)
    assert len(found) == len(report.failed) > 1
    ratios = [one.value / one.limit if one.limit else math.inf for one in found]
    missed = [abs(math.log(one)) if 0 < one < math.inf else math.inf for one in ratios]
    assert missed == sorted(missed, reverse=True)
