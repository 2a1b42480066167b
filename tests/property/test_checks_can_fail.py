"""A check compares two numbers that can differ: over random settings every check of every machine moves or fails.

A check that always has its limit as its value, or always the same share of it and never fails, says nothing of the
design. `WITNESSES` are settings at which checks fail that a design otherwise keeps exactly, because what it leaves
open is chosen so.
"""

import math
import random
from collections import defaultdict
from collections.abc import Iterator, Mapping

import pytest
from designs import random_settings
from effort import number

from ilmek.errors import IlmekError
from ilmek.machines.catalogue import MACHINES
from ilmek.report import Check, Report, at_most, must

NUMBER = number(12, 24)
SLOW = ("automated-loom", "knotting-dyad", "path-four-bar", "motion-four-bar", "tufting-machine", "weaver")
"""Designs of each machine, a quarter of those that take seconds each or whose witnesses move nearly all checks; these
without their parts in space, which one or two checks are of, but in a campaign.
"""

LOOMS = ("automated-loom", "hand-loom")

FEWER = {"path-four-bar": {"starts": "96"}}

WITNESSES: Mapping[str, tuple[dict[str, str], ...]] = {
    "beat-up": (
        {"beater_mass": "100t"},
        {"start.drive": "servo", "speed": "300rad/s", "beater_mass": "50kg"},
        {"interval": "1s"},
        {"swing": "84.3deg", "crank_rotation": "311.3deg"},
    ),
    "cam": (
        {"prime_radius": "20mm"},
        {"law": "uniform"},
        {"law": "parabolic", "speed": "300rpm"},
        {"kind": "grooved", "roller_radius": "6.5mm", "cutter_radius": "7mm"},
        {"prime_radius": "6mm", "lift": "3mm", "rise": "150deg", "bore": "2mm"},
    ),
    "hammer": (
        {"drive": "linkage", "beat_speed": "5rad/s", "ballast": "1kg"},
        {"drive": "linkage", "start.drive": "servo", "beat_speed": "60rad/s"},
        {"cloth.row_pitch": "3mm", "force": "1N"},
    ),
    "knotting-dyad": (
        {"pair_opened": "0.1mm"},
        {"opening": "0.1mm"},
        {"cloth.warp_pitch": "1mm", "yarn_pull": "2N"},
        {"cloth.warp_pitch": "3.2mm", "link_width": "48mm"},
        {"strength.pin_diameter": "1mm"},
        {"gear_ratio": "10000"},
        {"elbow_mass": "2kg"},
        {"grip_safety": "10"},
        {"grasp_time": "1ms", "release_time": "1ms"},
        {"cloth.yarns.pile_density": "20g/m"},
        {"depth": "30mm"},
    ),
    "knotting-four-bar": (
        {"sides": "2", "poses": "(0,0,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)", "warp_pitch": "20mm"},
        {"sides": "2"},
        {"speed": "1000rad/s"},
        {"strength.pin_diameter": "1mm"},
    ),
    "shedding": (
        {"cloth.warp_pitch": "0.5mm"},
        {"cam_thickness": "0.2mm"},
        {"shuttle_height": "80mm"},
        {"cloth.yarns.warp_diameter": "1.5mm"},
        {"prime_radius": "40mm"},
        {"rise": "100deg", "fall": "100deg"},
        {"shaft_length": "1m"},
    ),
    "tension-compensator": (
        {"strand_angle": "75deg", "bar_arm": "20mm"},
        {"springs": "1", "wire": "0.5mm"},
        {"rate_share": "1e-3"},
    ),
    "tufting": ({"entry": "200deg", "exit": "300deg"}, {"speed": "20000rpm"}),
    "tufting-machine": (
        {"gauge": "2mm"},
        {"looper.late": "60deg"},
        {"looper.transmission": "85deg"},
        {"looper.strength.pin_diameter": "30mm"},
        {"needle_bar.needle_length": "20mm"},
        {"shift": "2"},
        {"drives": "40"},
        {"needle.phase": "36deg", "needle_bar.joint": "20mm"},
        {"needle.needle_distance": "110mm"},
        {"needle.crank": "20mm"},
        {"needle.speed": "3000rpm", "feed.yarn_tension": "100N", "feed.backing_tension": "50000N/m"},
        {"pattern.colours": "5", "pattern.creel": "3", "pattern.attachment": "rollers"},
        {"pile": "cut", "knife.under": "50mm", "knife.depth": "120mm", "gauge": "2.5mm"},
        {"pile": "cut", "knife.under": "0.1mm", "knife.overlap": "15mm", "looper.transmission": "88.8deg"},
        {"pile": "cut", "knife.force": "300N"},
        {
            "pattern.selection": "needles",
            "needle_bar.notch": "0.001mm",
            "needle_bar.height": "20mm",
            "needle_bar.latch_shear": "0.2MPa",
        },
    ),
    "warp-tension": (
        {"cloth.yarns.warp_diameter": "1.5mm", "cloth.tension": "20N"},
        {"efficiency": "0.6"},
        {"motor_torque": "1Nm"},
        {"slot_width": "0.5mm"},
    ),
    "motion-four-bar": ({"transmission_min": "10deg"}, {"transmission_min": "60deg"}, {"link_width": "60mm"}),
    "path-four-bar": ({"link_width": "20mm"},),
    "function-four-bar": ({"link_width": "60mm"},),
    "weaver": (
        {"head_mass": "500kg", "carriage_acceleration": "100m/s^2"},
        {"relation_gap": "4deg"},
        {"crossing_turn": "60deg"},
        {"clearance": "3mm"},
        {"opener.tip": "3mm"},
        {"cycle": "0.05s", "speed_limit": "100m/s", "acceleration_limit": "20000m/s^2"},
        {"opener.height": "80mm"},
        {"cycle": "0.5s"},
        {"knot_yarn": "20mm"},
        {"knot": "asymmetric"},
        {"head_width": "40mm"},
        {"roller_radius": "12mm"},
        {"pressure_angle_limit": "22deg"},
        {"cutter_turn": "15ms", "cloth.yarns.pile_density": "2g/m"},
        {"carriage_acceleration": "50m/s^2", "head_mass": "400kg"},
    ),
    "weft": (
        {"carrier": "shuttle", "crossed": "no"},
        {"carrier": "rapier", "turn": "8mm"},
        {"carrier": "shuttle", "bobbin_diameter": "12mm"},
        {"cloth.yarns.friction": "2"},
        {"acceleration": "0.1m/s^2"},
        {"speed": "0.5m/s"},
    ),
}
"""Settings at which checks fail that the choices of a design keep at their limit."""


def reports(machine: str) -> Iterator[Report]:
    """The default, random designs, and the witnesses."""
    component = MACHINES[machine]
    designs = NUMBER // 4 if machine in SLOW else NUMBER
    drawn = [random_settings(machine, random.Random(f"{machine} moves {seed}"), most=3) for seed in range(designs)]
    for settings in ({}, *drawn, *WITNESSES.get(machine, ())):
        try:
            params = component.params.read(settings | FEWER.get(machine, {}))
            assembled = number(machine not in SLOW, True)
            yield component.report(component.design(params), illustrated=False, assembled=assembled)
        except IlmekError:
            continue


def never_differ(checks: Mapping[str, list[Check]]) -> set[str]:
    """The names of checks whose value is always the limit, or always the same share of it without a failure."""
    return {name for name, found in checks.items() if not any(moves(check, found) for check in found)}


def moves(check: Check, others: list[Check]) -> bool:
    """Whether a check fails, or has another share of its limit than another design and differs from the limit."""
    if not check.ok:
        return True
    return check.value != check.limit and any(share(check) != share(other) for other in others)


def share(check: Check) -> tuple[float, ...]:
    """The value over the limit; both, where that is no number."""
    finite = check.limit and math.isfinite(check.value / check.limit)
    return (round(check.value / check.limit, 9),) if finite else (check.value, check.limit)


@pytest.mark.parametrize("machine", [name for name in MACHINES if name not in LOOMS])
def test_every_check_of_a_machine_can_differ(machine: str) -> None:
    """The checks of the looms are those of their machines, of the cyclogram, of clearances, and wishes."""
    checks: dict[str, list[Check]] = defaultdict(list)
    number = 0
    for report in reports(machine):
        number += 1
        for check in report.checks:
            checks[check.name].append(check)
    assert number > 1
    seldom = {name for name, found in checks.items() if len(found) < number / 4}
    assert never_differ(checks) - seldom == set()


def test_a_check_against_its_own_value_is_found() -> None:
    """The kind of check that this test is for: a time beside the same time."""
    times = [at_most("time", value, value, "s", "") for value in (1.0, 40.84, 3.0)]
    slack = [at_most("slack", value, 2 * value, "s", "") for value in (1.0, 40.84, 3.0)]
    assert never_differ({"time": times, "slack": slack, "always": [must("a", True, "")] * 3}) == {
        "time",
        "slack",
        "always",
    }
    assert never_differ({"time": [*times, at_most("time", 2.0, 1.0, "s", "")]}) == set()
    assert never_differ({"slack": [*slack, at_most("slack", 2.0, 5.0, "s", "")]}) == set()


def test_the_time_of_a_beat_has_a_limit_of_its_own() -> None:
    """Without a time between beats nothing limits it, and there is no check."""
    names = {check.name for check in MACHINES["beat-up"].report_for({}).checks}
    assert "time of a beat" not in names
    (check,) = (
        check for check in MACHINES["beat-up"].report_for({"interval": "50s"}).checks if check.name == "time of a beat"
    )
    assert (check.limit, check.ok) == (50.0, True)
    assert check.value < 50.0
