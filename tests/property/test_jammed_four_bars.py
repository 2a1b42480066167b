"""A four-bar that cannot transmit is never offered: least transmission angles from intersections of circles alone."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.machines.catalogue import find_machine
from ilmek.machines.motion_four_bar import MACHINE
from ilmek.synthesis.filters import JAM

CLICKED = "(-29mm,-9.5mm,0deg) (0mm,14.5mm,0deg) (29mm,-5mm,0deg)"
QUICK = {
    "motion-four-bar": {"links": "120", "samples": "40", "loosen": "no"},
    "path-four-bar": {"starts": "16"},
    "function-four-bar": {},
}
DEG = math.pi / 180
Solution = dict[str, Any]


def brute_force(solution: Solution, cranks: np.ndarray) -> float:
    """Least acute angle between coupler and rocker [rad], B followed step by step where two circles meet."""
    a0, b0, a, b = (pin(solution, name) for name in ("a0", "b0", "a", "b"))
    crank, coupler, rocker = abs(a - a0), abs(b - a), abs(b - b0)
    drawn = cross(b - a, b0 - a) > 0
    least = math.pi / 2
    for angle in cranks:
        moved = a0 + crank * complex(math.cos(angle), math.sin(angle))
        base = abs(b0 - moved)
        x = (coupler**2 - rocker**2 + base**2) / (2 * base)
        y = math.sqrt(max(coupler**2 - x**2, 0.0))
        joint = moved + complex(x, -y if drawn else y) * (b0 - moved) / base
        mu = abs(math.remainder(np.angle((joint - moved) / (joint - b0)), math.pi))
        least = min(least, mu)
    return least


def pin(solution: Solution, name: str) -> complex:
    return complex(*np.atleast_1d(solution[name]))


def cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def used_motion(solution: Solution) -> np.ndarray:
    """Crank angles of the motion [rad]: a whole turn, or from the first to the last position."""
    if solution["crank_turns"]:
        base = pin(solution, "b0") - pin(solution, "a0")
        return float(np.angle(base)) + np.linspace(0, 2 * math.pi, 1441)
    cranks = solution["crank_angles"]
    return np.linspace(min(cranks), max(cranks), 1441)


def offered(machine: str, given: dict[str, str]) -> Iterator[Solution]:
    yield from find_machine(machine).report_for({**QUICK[machine], **given}).as_json()["results"]["solutions"]


def never_jams(machine: str, given: dict[str, str]) -> int:
    number = 0
    for number, solution in enumerate(offered(machine, given), 1):
        least = brute_force(solution, used_motion(solution))
        assert least >= JAM - 1e-6, f"{machine} {given}: solution {number} has {least / DEG} deg"
    return number


angles = st.floats(-90, 90)
points = st.tuples(st.floats(-40, 40), st.floats(-40, 40))


@settings(max_examples=12)
@given(st.lists(st.tuples(points, angles), min_size=3, max_size=3), st.booleans())
def test_three_poses(poses: list[Any], translated: bool) -> None:
    far = [(x + 60 * at, y) for at, ((x, y), _) in enumerate(poses)]
    turned = [0.0 if translated else round(angle + 7 * at, 3) for at, (_, angle) in enumerate(poses)]
    text = " ".join(f"({x:.3f}mm,{y:.3f}mm,{angle}deg)" for (x, y), angle in zip(far, turned, strict=True))
    never_jams("motion-four-bar", {"poses": text})


@settings(max_examples=6)
@given(st.lists(st.tuples(points, angles), min_size=5, max_size=5))
def test_five_poses(poses: list[Any]) -> None:
    text = " ".join(
        f"({x + 40 * at:.3f}mm,{y:.3f}mm,{angle + 11 * at:.3f}deg)" for at, ((x, y), angle) in enumerate(poses)
    )
    never_jams("motion-four-bar", {"poses": text})


@settings(max_examples=4)
@given(st.lists(points, min_size=5, max_size=5), st.booleans())
def test_a_path(path: list[Any], closed: bool) -> None:
    text = " ".join(f"({x + 30 * at:.3f}mm,{y:.3f}mm)" for at, (x, y) in enumerate(path))
    never_jams("path-four-bar", {"points": text, "closed": "yes" if closed else "no"})


@pytest.mark.parametrize("crank", [40, 75, 110, 150])
@pytest.mark.parametrize("rocker", [-80, 35, 90])
def test_a_function(crank: int, rocker: int) -> None:
    never_jams("function-four-bar", {"crank_swing": f"{crank}deg", "rocker_swing": f"{rocker}deg"})


def test_clicked_poses_of_one_angle_leave_jammed_parallelograms_out_by_name() -> None:
    results = find_machine("motion-four-bar").report_for({"poses": CLICKED}).as_json()["results"]
    jammed = results["left_out"]["transmits"]
    assert jammed > 100_000
    assert f"left out: {jammed} whose least transmission angle is below 1 deg" in results["sieve"]
    assert results["solutions"]
    assert never_jams("motion-four-bar", {"poses": CLICKED}) > 0


def test_poses_that_only_jammed_four_bars_take_say_so() -> None:
    half_circle = "(-29mm,0mm,0deg) (0mm,29mm,0deg) (29mm,0mm,0deg)"  # each link turns by half a turn
    report = find_machine("motion-four-bar").report_for({"poses": half_circle, "loosen": "no", "links": "120"})
    assert report.as_json()["results"]["solutions"] == []
    assert [check.name for check in report.failed] == ["four-bars without defects"]
    assert any("the poses have one angle: only parallelograms take them" in words for words in report.warnings)
    # The brute force finds the jams of what the search offers without the filter.
    design = MACHINE.designed(MACHINE.params.read({"poses": half_circle, "transmits": "no"}))
    shown = [option.as_json() for option in design.choice.kept]
    assert any(brute_force(solution, used_motion(solution)) < JAM for solution in shown)
