"""The head's opener, forces, magazine and width; arms in place of its grippers."""

from dataclasses import replace

import numpy as np
import pytest
from cloths import cloth

from ilmek.elements.carpet_yarns import usual_warp
from ilmek.machines.weaver import MACHINE, WeaverParams, design
from ilmek.machines.weaver.forces import HeadForces, grip_force, pressed, tool_force
from ilmek.machines.weaver.magazine import tier_width
from ilmek.machines.weaver.motions import CENTRE_MOTION, HANDLER, OPENER, SLEY
from ilmek.machines.weaver.tool_params import ArmsInHead
from ilmek.report import Check
from ilmek.timing.track import sample
from ilmek.units import mm, turn
from ilmek.weaving.warp_opening import WarpSpans, shifts

ANGLE = np.linspace(0.0, turn, 7201)


def checks_of(params: WeaverParams) -> dict[str, Check]:
    return {check.name: check for check in MACHINE.report(design(params)).checks}


@pytest.mark.parametrize("pitch", [1 * mm, 2 * mm, 8 * mm])
def test_the_opener_stores_the_energy_of_the_warps_it_displaces(pitch: float) -> None:
    """Without friction its force over its travel is the energy of all strings, neighbours and pair, both sides."""
    opener = design(WeaverParams(cloth=cloth(warp_pitch=pitch / 2))).opener
    travel = np.linspace(0.0, opener.travel, 20_001)
    work = float(np.trapezoid(opener.force(travel, np.zeros(20_001)), travel))
    moved = np.append(shifts(opener.shift, opener.pitch, opener.diameter), opener.slot_shift)
    warp: WarpSpans = opener.warp
    longer = np.hypot(warp.front, moved) - warp.front + np.hypot(warp.back, moved) - warp.back
    energy = warp.tension * longer + warp.stiffness * longer**2 / (2 * warp.length)
    assert work == pytest.approx(2 * float(energy.sum()), rel=2e-3)
    into, out = opener.force(travel, np.ones(20_001)), opener.force(travel, -np.ones(20_001))
    assert (into >= out - 1e-12).all()


def test_the_crowd_ends_at_the_first_warp_that_does_not_move() -> None:
    opener = design(WeaverParams()).opener
    beside = 1.5 * opener.pitch + opener.pitch * np.arange(len(opener.shifts))
    stands = beside + opener.shifts
    assert np.diff(stands) == pytest.approx(opener.diameter, abs=1e-9)
    still = 1.5 * opener.pitch + opener.pitch * len(opener.shifts)
    assert still - stands[-1] >= opener.diameter - 1e-9
    assert opener.crowd == pytest.approx(2 * still)


def test_grip_and_press() -> None:
    """Jaws with friction on both sides hold n ends; their force begins where they touch the loose yarn."""
    params = WeaverParams()
    force = grip_force(params.forces.grip_safety, params.friction, 2, params.forces.tightening)
    assert 2 * params.friction * force == pytest.approx(1.5 * 2 * params.forces.tightening)
    touch = params.jaw - 2 * (params.yarn - params.pressed)
    share = pressed(params, np.array([0.0, touch, (touch + params.jaw) / 2, params.jaw]), 2)
    assert share == pytest.approx([0.0, 0.0, 0.5, 1.0])


def test_the_knot_is_tight_until_the_jaws_open_and_the_sley_packs_on_its_way_down_only() -> None:
    head = design(WeaverParams())
    forces = HeadForces(head.params, head.cyclogram, head.opener, head.handler_radius)
    pull = -tool_force(forces, CENTRE_MOTION, ANGLE)
    assert pull.max() == pytest.approx(2 * head.params.forces.tightening)
    opens = head.cyclogram.track("centre-gripper grasp").segment("open").start
    assert (pull[opens < ANGLE] == 0).all()
    packs = tool_force(forces, SLEY, ANGLE)
    down = head.cyclogram.track(SLEY).segment("down")
    up = head.cyclogram.track(SLEY).segment("up")
    assert packs.max() == pytest.approx(10.0)
    assert (packs[(up.start < ANGLE) & (up.end > ANGLE)] == 0).all()
    assert (packs[down.start > ANGLE] == 0).all()
    drawn = tool_force(forces, HANDLER, ANGLE)
    assert float(np.trapezoid(drawn * sample(head.cyclogram.track(HANDLER), ANGLE).slope, ANGLE)) == pytest.approx(
        head.params.forces.yarn_pull * head.drawn, rel=2e-3
    )


@pytest.mark.parametrize("tubes", [1, 16, 60, 200])
def test_the_tubes_have_room_on_the_head_that_is_chosen_and_fewer_tiers_have_not(tubes: int) -> None:
    head = design(WeaverParams(tubes=tubes))
    magazine = head.magazine
    assert magazine.width <= head.width
    assert magazine.tiers * magazine.per_tier >= tubes
    assert head.width == pytest.approx(max(head.needs.values()), abs=1 * mm)
    if magazine.tiers > 1:
        assert tier_width("drum", -(-tubes // (magazine.tiers - 1)), 12 * mm) > max(
            head.needs["cams"], head.needs["warps pushed aside"]
        )


def test_200_tubes_on_a_slide_do_not_pass() -> None:
    """A slide of 200 tubes, 2.4 m, on a head of 80 mm."""
    found = checks_of(WeaverParams(tubes=200, magazine="slide", tube_tiers=1, head_width=0.08))
    assert not found["tubes on the head"].ok
    assert found["tubes on the head"].value == pytest.approx(399 * 0.012)
    assert found["tubes on the head"].cure
    assert not checks_of(WeaverParams(tubes=255, magazine_room=0.02))["tubes on the head"].value > 3.0


@pytest.mark.parametrize("pitch", [0.25, 0.5, 1, 2, 4])
def test_the_points_of_the_opener_need_the_gap_of_the_warps(pitch: float) -> None:
    found = checks_of(WeaverParams(cloth=cloth(warp_pitch=pitch * mm)))["opener: points between two warps"]
    assert found.limit == pytest.approx(pitch * mm - usual_warp(pitch * mm).diameter)
    assert found.ok == (pitch > 0.3)


def test_every_check_of_a_head_has_a_cure_and_no_design_drops_any() -> None:
    usual = checks_of(WeaverParams())
    assert all(check.cure for check in usual.values())
    hard = checks_of(
        WeaverParams(
            knot="asymmetric",
            cloth=cloth(warp_pitch=0.25 * mm),
            tubes=255,
            head_width=0.03,
            opening=2 * mm,
            tool_mass=90.0,
        )
    )
    named = {name.split(",")[0] for name in usual}
    assert {name.split(",")[0] for name in hard} - {"asymmetric knot tied"} == named - {"symmetric knot tied"}


ARMS = WeaverParams(arms=ArmsInHead(time=0.45, yarn=37 * mm, pair=2.2 * mm, outer=2.5 * mm, width=90 * mm))


def test_arms_replace_the_grippers_and_keep_opener_handler_and_sley() -> None:
    head = design(ARMS)
    assert [track.name for track in head.cyclogram.tracks] == [OPENER, HANDLER, SLEY]
    assert [cam.actuator for cam in head.cams] == ["cam 2", "cam 5", "cam 6"]
    assert head.width == pytest.approx(90 * mm)
    assert head.drawn >= 37 * mm
    assert not MACHINE.report(head).failed


@pytest.mark.parametrize("optimise", [False, True])
def test_the_cycle_leaves_the_arms_their_time(optimise: bool) -> None:
    slow = design(replace(ARMS, optimise=optimise, arms=replace(ARMS.arms, time=1.5)))
    opened = slow.cyclogram.track(OPENER).segment("open warps").end
    down, back = slow.cyclogram.track(SLEY).segment("down").start, slow.cyclogram.track(OPENER).segment("return").start
    assert (min(down, back) - opened) / slow.cyclogram.speed >= 1.5 - 1e-6
    assert slow.cycle >= 1.5
    assert not [check for check in MACHINE.report(slow).failed if "after" in check.name]
