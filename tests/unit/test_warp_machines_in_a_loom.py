"""Shedding and warp tension in a loom: parameters from its task, lines of the parts list, work."""

import math

import numpy as np
import pytest
from cam_bars import beyond_cams
from cloths import cloth

from ilmek.machines import shedding, warp_tension
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.machines.warp_tension.design import USUAL_TUBES, keeps_limits, worst_load
from ilmek.units import mm


def whole(**settings: str) -> LoomTask:
    """The task of a loom, all machines designed."""
    return design(AutomatedLoomParams.read({"aim": "price", **settings})).task


def test_fitted_cams_leave_room_for_the_bore_of_their_own_shaft() -> None:
    assert shedding.MACHINE.fit(whole()).prime_radius is None
    found = shedding.MACHINE.fit(whole(width="3m", length="4m", shaft_span="4m"))
    made = shedding.design(found)
    assert made.cam.prime_radius > made.prime_radius_min
    assert made.cam.prime_radius >= made.prime_radius_for_bore
    assert made.cam.prime_radius == pytest.approx(round(made.cam.prime_radius / mm) * mm)
    assert (found.cloth.warps, found.shaft_length) == (1508, pytest.approx(found.cloth.width + 0.1))


def test_a_prime_radius_that_the_user_set_stays() -> None:
    assert shedding.MACHINE.fit(whole(**{"shedding.prime_radius": "150mm"})).prime_radius == pytest.approx(0.15)


def test_parts_of_the_shedding_weigh_what_the_design_weighs() -> None:
    made = shedding.design(shedding.SheddingParams(prime_radius=0.2))
    parts = {part.name: part for part in shedding.MACHINE.parts(made)}
    sheets = "shedding cam", "guide cam", "guide cam beside shims", "shims of the cams"
    cams = sum(parts[name].mass_all for name in sheets)
    # The stack is weighed with the bar in its bores; the shaft goes on to its bearings and has journals.
    rings = parts["pressure ring of the cams"].mass_all
    within = parts["cam shaft"].mass + rings - made.params.density * beyond_cams(made, 0, made.params.cloth.width)
    assert cams + within == pytest.approx(made.stack.mass, rel=1e-6)
    assert [part.name for part in parts.values() if part.drives] == ["motor of the cam shaft"]
    assert parts["bearing of the cam shaft"].number == 2
    spans = shedding.design(shedding.SheddingParams(prime_radius=0.2, spans=3))
    assert {part.name: part.number for part in shedding.MACHINE.parts(spans)}["steady of the cam shaft"] == 2


def test_tubes_of_the_parts_list_are_those_of_the_cylinders() -> None:
    made = warp_tension.design(warp_tension.WarpTensionParams())
    parts = {part.name: part.description for part in warp_tension.MACHINE.parts(made)}
    for name, one in zip(("cylinder", "spacer cylinder"), cylinders(made)[::2], strict=True):
        outer, wall = (2 * one.outer, one.outer - one.inner) if one.tube is None else (one.tube.outer, one.tube.wall)
        section, _, _ = parts[name].removeprefix("tube ").partition(" mm")
        sizes = [float(size) * mm for size in section.split(" x ")]
        assert sizes == pytest.approx([outer, wall], rel=1e-3)


def test_work_of_a_row_is_that_of_lifting_both_parities() -> None:
    """Opposed cams without tension: each parity is lifted while the other lies, and pushes back when it falls."""
    made = shedding.design(shedding.SheddingParams())
    (work,) = shedding.MACHINE.work(made)
    assert work.per == "row"
    assert work.energy == pytest.approx(600 * 10 * 0.06, rel=1e-4)
    stiff = shedding.design(
        shedding.SheddingParams(cloth=cloth(warp_stiffness=1050.0), half_span=0.17, warp_length=0.34)
    )
    angle = np.linspace(0.0, 2 * math.pi, 20001)
    wanted = np.trapezoid(np.maximum(stiff.shed.torque(angle), 0.0), angle)
    assert shedding.MACHINE.work(stiff)[0].energy == pytest.approx(wanted, rel=1e-5)


def test_fitted_cylinder_is_the_lightest_that_keeps_the_limits() -> None:
    fitted = warp_tension.MACHINE.fit(whole(width="3m", length="4m"))
    made = warp_tension.design(fitted)
    area = math.pi * (made.outer_radius**2 - made.inner_radius**2)
    lighter = [one for one in USUAL_TUBES if one.area < area - 1e-9]
    load = worst_load(fitted)
    assert lighter
    assert keeps_limits(fitted, made.inner_radius, made.outer_radius, load)
    assert not any(keeps_limits(fitted, one.inner_radius, one.outer_radius, load) for one in lighter)
    choice = warp_tension.MACHINE.choices(made)[0]
    assert (choice.name, choice.next_cheaper) == ("tube", max(lighter, key=lambda one: one.area).name)
    woven = 4.0 * (1 + fitted.cloth.warp_strain) / 0.99
    assert (fitted.width, fitted.carpet_length) == (pytest.approx(made.params.width), pytest.approx(woven))


def test_a_tube_that_the_user_set_stays() -> None:
    found = warp_tension.MACHINE.fit(whole(**{"warp-tension.tube": "168.3x10"}))
    assert (found.tube, found.outer_radius) == ("168.3x10", None)


def test_no_tube_for_too_wide_a_loom() -> None:
    made = warp_tension.design(warp_tension.MACHINE.fit(whole(width="12m")))
    assert made.outer_radius == max(one.outer_radius for one in USUAL_TUBES)
    assert made.deflection_loaded > made.params.deflection_limit


def test_parts_and_work_of_the_cylinders() -> None:
    made = warp_tension.design(warp_tension.WarpTensionParams())
    parts = {part.name: part for part in warp_tension.MACHINE.parts(made)}
    assert parts["cylinder"].number == 2
    taken = made.mass - parts["cylinder"].mass  # by the slot of its bar, and the bores of its ends
    bores = 2 * 20e-3 * math.pi * (65.5e-3**2 - 65e-3**2) * made.params.density
    taken -= bores
    assert 0 < taken < 6.3e-3 * 2.6e-3 * made.params.span * made.params.density
    assert {name: part.number for name, part in parts.items() if name.startswith("bearing")} == {
        "bearing of the upper cylinder": 2,
        "bearing of the lower cylinder": 2,
        "bearing of the spacer cylinder": 2,
    }
    assert [(part.name, part.number) for part in parts.values() if part.drives] == [("motor of a cylinder", 3)]
    (work,) = warp_tension.MACHINE.work(made)
    assert (work.name, work.per) == ("take-up", "carpet")
    assert work.energy == pytest.approx(600 * 15 * 1.8 / 0.45)


@pytest.mark.parametrize("settings", [{}, {"tension-compensator.bars": "2"}, {"lift": "100mm"}])
def test_cams_are_designed_for_the_tension_that_the_compensator_leaves(settings: dict[str, str]) -> None:
    loom = design(AutomatedLoomParams.read({"aim": "price", **settings}))
    compensator = loom.machines["tension-compensator"].design
    assert loom.shedding.params.compensation == pytest.approx(compensator.relief, abs=0.02)
    assert loom.warp_tension.loads.lifted == pytest.approx(compensator.tension_open, rel=0.01)
    assert compensator.swing <= loom.side.room.swing


def test_slack_warps_are_longer_instead_of_a_second_bar() -> None:
    """A bar for each parity would keep them as short: the lower one has no room over the cams."""
    usual, slack = (design(AutomatedLoomParams.read({"aim": "price", **one})) for one in ({}, {"tension": "8N"}))
    compensator = slack.machines["tension-compensator"].design
    assert compensator.bars == 1
    assert compensator.tension_open <= 1.5 * 8
    assert compensator.tension_low >= 0.5 * 8
    assert slack.side.back_span > usual.side.back_span + 0.1
    assert slack.side.front_span == pytest.approx(usual.side.front_span)


@pytest.mark.parametrize("kind", ["travelling", "comb"])
def test_the_beat_pulls_at_the_warps_that_it_beats(kind: str) -> None:
    loom = design(AutomatedLoomParams.read({"aim": "price", "beat": kind}))
    loads, drive = loom.warp_tension.loads, loom.beat
    assert loads.beat == pytest.approx(15.0 + drive.warp_force_extra)
    assert loads.pull("beat") == pytest.approx(608 * 15.0 + drive.beaten * drive.warp_force_extra)
    assert loads.worst_case == ("beat" if kind == "comb" else "shed open")
