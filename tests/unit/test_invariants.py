"""Invariants of every report: what breaks one becomes a failed check; impossible parameters are refused."""

import math
from dataclasses import replace
from types import NoneType
from typing import get_args, get_type_hints

import numpy as np
import pytest

from ilmek.errors import IlmekError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.invariants import SOURCE, broken
from ilmek.plane.contours import circle
from ilmek.records import declared_results, layout
from ilmek.report import BillLine, CamTable, Hole, Plate, Report, Result, Work, at_most
from ilmek.units import mm

SQUARE = np.array([0, 1, 1 + 1j, 1j])
SOUND = Report("press", "Press", {}, (), ())
PLATE = Plate("face", "Face", SQUARE, 5 * mm, "steel", holes=(Hole(0.5 + 0.5j, 0.4),))


def result(value: object, unit: str = "1", **more: object) -> Report:
    return replace(SOUND, results=(Result("m", value, unit, "meaning", **more),))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("report", "name"),
    [
        (result(math.nan), "m is finite"),
        (result({"a": [1.0, np.array([1j, math.inf])]}), "m is finite"),
        (result(None), "m has a value"),
        (result([2.0, -1.0], "kg", least=0.0), "m is not below its bound"),
        (replace(SOUND, checks=(at_most("heat", 1.0, math.inf, "1", ""),)), "heat: value and limit are finite"),
        (replace(SOUND, parts=(BillLine("rod", 1, "", "", "", -0.1),)), "mass of the rod is positive"),
        (replace(SOUND, parts=(BillLine("rod", -1, "", "", ""),)), "number of the rod is positive"),
        (replace(SOUND, plates=(replace(PLATE, thickness=0.0),)), "thickness of the plate face is positive"),
        (replace(SOUND, plates=(replace(PLATE, outline=SQUARE[::-1]),)), "area of the plate face is positive"),
        (
            replace(SOUND, plates=(replace(PLATE, area=-1.0),)),
            "area of the plate face, holes not taken off, is positive",
        ),
        (
            replace(SOUND, plates=(replace(PLATE, holes=(Hole(0.5 + 0.5j, 0.51),)),)),
            "the holes of the plate face are inside of its outline",
        ),
        (
            replace(SOUND, plates=(replace(PLATE, outline=circle(0.5 + 0.5j, 0.3)),)),
            "the holes of the plate face are inside of its outline",
        ),
        (
            replace(SOUND, plates=(replace(PLATE, holes=(Hole(2j, 0.1),)),)),
            "the holes of the plate face are inside of its outline",
        ),
        (
            replace(SOUND, cam_tables=(CamTable("axis", "", np.sin, np.zeros(1), "mm", 0.0),)),
            "period of axis is positive",
        ),
    ],
)
def test_a_broken_invariant_is_a_failed_check(report: Report, name: str) -> None:
    (check,) = broken(report)
    assert (check.name, check.ok, check.source) == (name, False, SOURCE)


@pytest.mark.parametrize("energy", [-1.0, math.nan, math.inf])
def test_work_is_finite_and_not_negative(energy: float) -> None:
    (check,) = broken(SOUND, [Work("beating", 1.0, "row"), Work("shedding", energy, "row")])
    assert check.name == "energy of shedding is positive"
    assert not check.ok


@pytest.mark.parametrize(
    "report",
    [
        result(-1.0),
        result(0.0, "kg", least=0.0),
        result(None, absent="no load"),
        result({"a": None, "b": "text", "c": True}),
        replace(SOUND, parts=(BillLine("rod", 0, "", "", ""),)),
        replace(SOUND, plates=(PLATE, replace(PLATE, outline=circle(0.5 + 0.5j, 0.41)))),
    ],
)
def test_a_sound_report_gets_no_further_check(report: Report) -> None:
    assert broken(report) == ()


@pytest.mark.parametrize(
    ("machine", "settings", "refused"),
    [
        ("cam", {"kind": "barrel", "bore": "100mm"}, "does not fit into the barrel cam"),
        ("beat-up", {"members": "100000"}, "at most 10000"),
        ("hammer", {"cloth.warps": "100000", "comb_depth": "1mm", "cloth.warp_pitch": "50mm"}, "at most 500"),
    ],
)
def test_impossible_parameters_are_refused(machine: str, settings: dict[str, str], refused: str) -> None:
    with pytest.raises(IlmekError, match=refused):
        MACHINES[machine].report_for(settings)


@pytest.mark.parametrize("depth", ["4mm", "6mm", "19mm"])
def test_slots_that_cut_through_the_spacer_fail_a_check_and_break_no_invariant(depth: str) -> None:
    report = MACHINES["warp-tension"].report_for({"slot_depth": depth, "spacer_tube": "110x5"})
    assert "metal under the slots" in {check.name for check in report.failed}
    assert broken(report) == ()


def test_a_follower_that_jams_fails_a_check_and_has_no_torque() -> None:
    jammed = {"follower": "spherical", "sliding_friction": "0.84", "guide_friction": "0.44"}
    report = MACHINES["cam"].report_for(jammed)
    (failed,) = report.failed
    assert failed.name.startswith("the follower does not jam")
    assert failed.value < failed.limit == 0
    assert report["torque_max"] is None


def test_every_mass_and_time_has_a_bound() -> None:
    report = MACHINES["shedding"].report_for({})
    bounds = {one.name: one.least for one in report.results}
    assert bounds["mass"] == bounds["turn_time"] == bounds["cam_area"] == 0
    assert bounds["shaft_torque_min"] == -math.inf


def test_the_reference_states_when_a_result_is_null() -> None:
    (one,) = (one for one in declared_results(*MACHINES["cam"].reported) if one.name == "lift_off_speed")
    assert one.meaning.endswith("; null: never")


def test_a_result_that_may_be_none_is_optional_or_states_when() -> None:
    unstated = [
        f"{cls.__name__}.{attribute}"
        for machine in MACHINES.values()
        for cls in machine.reported
        for attribute, declaration, _ in layout(cls)
        if declaration is not None and attribute in (hints := get_type_hints(cls))
        if NoneType in get_args(hints[attribute]) and not (declaration.optional or declaration.absent)
    ]
    assert unstated == []
