"""Welds, screws and feet against published values, brute force and the parts of the tree.

Evidence: EN 1993-1-8 (fillet welds of S235: 207.8 N/mm²; table of preloads of 8.8 screws, 0.7 f_ub A_s), ISO 898-1,
forces of a weld group summed over its length by brute force, screws counted from the bodies of a loom.
"""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.fillet_welds import STRENGTH, THROATS, RoundSquare, TwoSeams, throat_for
from ilmek.elements.machine_screws import SCREWS, FourScrews
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.brackets import bracket_checks, brackets_of
from ilmek.machines.automated_loom.feet import FEET, foot_for
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.joints import foot_check, joint_checks, seams, tipping
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.steady_posts import steady_checks
from ilmek.machines.shedding.steady import ASIDE, steady_of
from ilmek.part.bolting import bolted

PRELOADS = {"M12": 47e3, "M16": 88e3, "M20": 137e3, "M24": 198e3}
"""kN of 8.8 screws, as design tables for EN 1993-1-8 round them [N]."""


@cache
def loom(width: float = 1.2) -> LoomDesign:
    return design(AutomatedLoomParams(aim="price", width=width, length=1.0))


@pytest.mark.parametrize(("name", "preload"), PRELOADS.items())
def test_preloads_are_those_of_the_tables(name: str, preload: float) -> None:
    assert SCREWS[name].preload == pytest.approx(preload, rel=5e-3)


def test_a_weld_of_s235_bears_what_the_code_says() -> None:
    assert pytest.approx(207.8e6, rel=1e-3) == STRENGTH


def brute_force(points: np.ndarray, force: complex, moment: float, across: float) -> float:
    """Greatest force on a length of seams through points: evenly, and linearly about their middle [N/m]."""
    polar, upright = np.mean(np.abs(points) ** 2), np.mean(points.imag**2)
    whole = force + 1j * moment * points / polar
    return float(np.hypot(np.abs(whole), across * points.imag / upright).max())


@given(st.floats(0.05, 0.6), st.floats(0.04, 0.4), st.floats(1.0, 1e5), st.floats(0.0, 1e4), st.floats(0.0, 1e3))
def test_two_seams_are_never_weaker_than_their_points_summed(
    length: float, distance: float, force: float, moment: float, across: float
) -> None:
    seam = (np.arange(4000) + 0.5) / 4000 * length - length / 2
    points = np.concatenate([distance / 2 + 1j * seam, -distance / 2 + 1j * seam])
    total = 2 * length
    worst = max(
        brute_force(points, force * turned / total, moment / total, across / total) for turned in (1, 1j, 0.6 + 0.8j)
    )
    found = TwoSeams(length, distance).force(force, moment, across)
    assert worst * (1 - 1e-9) <= found <= math.sqrt(2) * worst * (1 + 1e-3) + 1e-9


@given(st.floats(0.03, 0.4), st.floats(0.0, 1e4))
def test_a_weld_round_a_square_bends_as_its_lines(side: float, moment: float) -> None:
    edge = (np.arange(2000) + 0.5) / 2000 * side - side / 2
    heights = np.concatenate([edge, edge, np.full(2000, side / 2), np.full(2000, -side / 2)])
    inertia = float(np.sum(heights**2)) * side / 2000
    assert RoundSquare(side).force(0.0, moment) == pytest.approx(moment * side / 2 / inertia, rel=1e-3)


def test_a_throat_is_the_least_that_bears_its_force_and_never_more_than_its_wall_allows() -> None:
    least = throat_for(0.0, 0.02)
    offered = [throat for throat in THROATS if throat >= least]
    for throat, thinner in zip(offered[1:], offered, strict=False):
        assert throat_for(STRENGTH * (thinner + throat) / 2, 0.02) == throat
    assert throat_for(1e9, 0.006) == 0.004


@given(st.floats(0.0005, 0.03), st.floats(0.0, 0.03), st.floats(0.0, 1e7))
def test_a_throat_burns_through_no_wall_and_only_a_thin_one_is_below_what_the_thick_one_needs(
    wall: float, more: float, force: float
) -> None:
    thickest = wall + more
    throat = throat_for(force, wall, thickest)
    assert throat <= 0.7 * wall + 1e-6 or (throat == 0.003 and 0.004 - 1e-6 <= wall < 0.0044)
    needed = math.sqrt(thickest * 1e3) * 1e-3 - 0.5e-3
    larger = [own for own in THROATS if throat < own <= 0.7 * wall]
    assert throat >= needed - 1e-6 or not larger


@given(st.floats(0.06, 0.3), st.floats(10.0, 1e5), st.floats(0.0, 0.05))
def test_four_screws_hold_by_friction_what_presses_less_what_pulls(side: float, force: float, lever: float) -> None:
    group = FourScrews(side, force, lever)
    screw = group.screw
    pulled = force * lever / (side - 2.4 * screw.diameter)
    assert group.holds(screw) == pytest.approx(0.2 * (4 * 0.7 * 800e6 * screw.area - 0.8 * pulled) / 1.25)
    smaller = [one for one in SCREWS.values() if one.diameter < screw.diameter]
    assert all(group.holds(one) < force for one in smaller) or not smaller


@pytest.mark.parametrize("width", [1.2, 0.6])
def test_every_bearing_of_a_shaft_has_four_screws_in_tree_and_list(width: float) -> None:
    own = loom(width)
    placed = {part.id: (part, number) for part, number in loom_tree(own).occurrences()}
    listed = {line.part: line for line in parts_of_loom(own).parts}
    bearings = [name for name in placed if name + "-screw" in placed]
    assert len(bearings) == 3 + len(own.side.cams)
    for name in bearings:
        part, number = placed[f"{name}-screw"]
        line = listed[part.id]
        assert number == 4 * placed[name][1] == line.number
        assert line.description == part.purchase.row
        assert part.purchase.row.startswith("ISO 4017 - M")
        assert line.mass == pytest.approx(part.shape.volume * 7850)


def test_the_frame_is_welded_and_stands_and_says_so_where_it_does_not() -> None:
    own = loom()
    frame = parts_of_loom(own).frame
    assert all(check.ok for check in joint_checks(own, frame))
    assert {seam.part for seam in seams(own, frame)} >= {"upper-bracket", "rail-post", "rail-arm", "beat-post"}
    shaken = replace(own, beat=replace(own.beat, frame_force=1e6))
    assert not tipping(shaken, frame).ok
    listed = {line.part for line in parts_of_loom(own).parts}
    checks = (*joint_checks(own, frame), *bracket_checks(own, brackets_of(own), frame.column), *frame.checks)
    assert {part for check in checks for part in check.parts} <= listed


def test_feet_bear_half_of_the_loom_each() -> None:
    found = parts_of_loom(loom())
    assert found.frame.foot_load == pytest.approx(found.mass * 9.81 / 2, rel=0.02)
    assert found.frame.foot == foot_for(found.frame.foot_load) == FEET[0]
    assert foot_for(30e3).name == "M24"
    assert foot_for(1e9) == FEET[-1]
    assert foot_check(found.frame).ok
    assert not foot_check(replace(found.frame, foot_load=1e6)).ok


def test_a_wide_rail_has_supports_between_its_ends() -> None:
    own = loom(2.4)
    frame = parts_of_loom(own).frame
    ends, between = rail_supports(own, frame)
    assert frame.guide[1].spans == 2
    assert len(ends.stations) == 2
    assert len(between.stations) == 1
    assert all(check.ok for one in (ends, between) for check in one.checks)
    broken = replace(between, load=1e5)
    assert [check.name for check in broken.checks if not check.ok]
    names = {body.id: {one.part.id: len(one.positions) for one in body.occurrences} for body in loom_tree(own).bodies}
    assert names["heads' rail"]["automated-loom/rail-bracket"] == 1
    assert names["automated-loom/retreat"]["automated-loom/retreat-axis"] == 3
    assert names["automated-loom/frame"]["automated-loom/post"] == 1


@pytest.mark.parametrize("width", [1.2, 2.4])
def test_the_rail_is_screwed_to_a_carriage_of_each_of_its_axes(width: float) -> None:
    """By the meshes: each axis touches one carriage; its screws go through that into the rail's plate, beside the axis,
    and no head is in the rail or its arms, which are closed.
    """
    whole = bolted(loom_tree(loom(width)))

    def pieces(name: str) -> list[np.ndarray]:
        stands = [
            body.positions[0].after(lies).points(own.part.shape.mesh(1e-4).points)
            for body in whole.bodies
            for own in body.occurrences
            for lies in own.positions
            if own.part.id == f"automated-loom/{name}"
        ]
        return [np.stack([points.min(0), points.max(0)]) for points in stands]

    axes, carriages = pieces("retreat-axis"), pieces("retreat-carriage")
    screws = [own for name in ("rail-plate", "rail-bracket-plate") for own in pieces(f"retreat-carriage-{name}-screw")]
    assert len(axes) == len(carriages) == (2 if width < 2 else 3)
    assert len(screws) == 4 * len(carriages)
    for axis in axes:
        (carriage,) = (own for own in carriages if abs(own - axis[::-1])[:, 0].min() < 1e-6)
        own = [screw for screw in screws if abs(screw[:, 0].mean() - carriage[:, 0].mean()) < 24e-3]
        assert len(own) == 4
        for screw in own:  # from the side of the axis through the carriage into the plate
            away = np.sort(abs(screw[:, 0] - axis[:, 0].mean()))
            assert 20e-3 < away[0] < 44e-3 < away[1] < 54e-3 + 1e-6


def test_rollers_of_a_steady_touch_the_rims_and_its_post_the_block() -> None:
    """By the meshes: no point of a steady is inside the guide cams' radius, and the rollers reach it."""
    own = loom(2.4)
    frame, shaft, cam = parts_of_loom(own).frame, own.shedding.shafts[0], own.side.cams[0]
    steady = steady_of(shaft)
    assert steady is not None
    mesh = steady.part("steady", "steady").shape.mesh(1e-5).points
    assert np.hypot(mesh[:, 0], mesh[:, 1]).min() == pytest.approx(shaft.stack.guide_radius, abs=1e-4)
    assert mesh[:, 0].min() == pytest.approx(-steady.rear)
    (post,) = [
        one for body in loom_tree(own).bodies for one in body.occurrences if one.part.id == "automated-loom/steady-post"
    ]
    assert len(post.positions) == shaft.params.spans - 1
    points = post.positions[0].points(post.part.shape.mesh(1e-4).points)
    assert points[:, 2].max() == pytest.approx(cam.at.real - steady.rear)
    assert points[:, 1].max() == pytest.approx(cam.at.imag + steady.half_height)
    assert steady.force * math.cos(ASIDE) == pytest.approx(shaft.shaft.seat.reaction)
    checks = steady_checks(own, frame, brackets_of(own))
    assert [check.name for check in checks if not check.ok] == []
    assert not replace(steady, force=1e6).check("").ok
    assert {part for check in checks for part in check.parts} <= {line.part for line in parts_of_loom(own).parts}
