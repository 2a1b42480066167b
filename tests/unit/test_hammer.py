"""The hammer: what the fabric answers, how evenly the comb presses, what drives it, what is refused."""

import functools
import math
from typing import Any

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import Manifold, Mesh

from ilmek.errors import ParameterError
from ilmek.machines.hammer import MACHINE, Hammer, HammerParams
from ilmek.machines.hammer.comb import second_moment, slot_of
from ilmek.machines.hammer.linkage import bracket
from ilmek.machines.hammer.tree import tree
from ilmek.part.tree import Occurrence
from ilmek.report import Drawing, Plot, Report
from ilmek.units import mm
from ilmek.weaving.comb_on_fell import fell_pressure, krylov
from ilmek.weaving.fell import Fabric

FINE = cloth(warps=2400, warp_pitch=0.25 * mm)
FELL = Fabric(tension=15.0, laid=6 * mm, jammed=3 * mm, packing=1 * mm, warp_rate=1200.0, cloth_rate=3600.0)
forces = st.floats(1e-6, 1e4)


@functools.cache
def made(**asked) -> Hammer:
    return MACHINE.design(HammerParams(**asked))


@functools.cache
def answer(**asked) -> Report:
    return MACHINE.report(made(**asked))


def result(report: Report, name: str):
    return next(result.value for result in report.results if result.name == name)


@given(force=forces)
def test_the_row_resists_with_what_it_is_pressed_with(force) -> None:
    assert FELL.resistance(FELL.spacing(force)) == pytest.approx(force, rel=1e-6, abs=1e-9)


@given(force=forces, more=st.floats(1.001, 10.0))
def test_more_force_packs_closer_and_more_tension_looser(force, more) -> None:
    tighter = Fabric(15.0 * more, FELL.laid, FELL.jammed, FELL.packing, FELL.warp_rate, FELL.cloth_rate)
    assert FELL.spacing(force * more) < FELL.spacing(force) < tighter.spacing(force)
    assert tighter.bump > FELL.bump
    assert FELL.energy(force * more) > FELL.energy(force)


def test_no_force_leaves_the_row_laid_and_an_endless_one_jams_it() -> None:
    assert FELL.spacing(0.0) == FELL.laid
    assert FELL.spacing(1e12) == pytest.approx(FELL.jammed, rel=1e-9)
    assert FELL.energy(0.0) == 0.0


def test_far_laid_rows_resist_as_greenwood_and_cowhig_found() -> None:
    """R (p - D) is one number, K T, whatever p, where the row comes from afar."""
    far = Fabric(15.0, 1e6, 3 * mm, 1 * mm, 1200.0, 3600.0)
    for spacing in (3.1 * mm, 4 * mm, 20 * mm):
        assert far.resistance(spacing) * (spacing - 3 * mm) == pytest.approx(15e-3, rel=1e-7)


def test_the_fell_gives_way_as_warp_and_cloth_until_the_cloth_is_slack() -> None:
    """20 N: 15 N of tension times 1 + 1200/3600; there the cloth has given all its 15 N over 3600 N/m."""
    assert FELL.bump == pytest.approx(20.0)
    assert FELL.fell(20.0) == pytest.approx(15 / 3600)
    assert FELL.fell(10.0) == pytest.approx(10 / 4800)
    assert FELL.fell(32.0) == pytest.approx(17 / 1200)


@pytest.mark.parametrize("force", [1.0, 10.0, 20.0, 45.0])
def test_work_is_the_area_under_the_force_along_the_combs_way(force) -> None:
    way = np.linspace(0.0, force, 200_001)
    area = np.trapezoid(way, FELL.travel(way))
    assert FELL.energy(force) == pytest.approx(area, rel=1e-7)
    assert FELL.struck(FELL.energy(force)) == pytest.approx(force, rel=1e-9)


@pytest.mark.parametrize("force", [2.0, 10.0, 30.0])
def test_stiffness_of_the_fell_is_the_slope_of_its_force(force) -> None:
    step = 1e-5 * force
    slope = 2 * step / float(FELL.travel(force + step) - FELL.travel(force - step))
    assert FELL.rate(float(FELL.spacing(force))) == pytest.approx(slope, rel=1e-6)


def test_krylov_functions_are_each_others_derivatives() -> None:
    z, step = np.linspace(0.0, 3.0, 31), 1e-5
    slope = (krylov(z + step) - krylov(z - step)) / (2 * step)
    k = krylov(z)
    np.testing.assert_allclose(slope, [-4 * k[3], k[0], k[1], k[2]], rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("rigidity", [1e7, 350e3, 2e3, 20.0])
def test_comb_held_at_its_ends_by_hetenyi(rigidity) -> None:
    """Middle over ends: cosh u cos u / (cosh^2 u cos^2 u + sinh^2 u sin^2 u), u = l W / 2."""
    found = fell_pressure(1.2, np.array([0.0, 1.2]), rigidity, 1.6e6)
    u = found.number / 2
    c, s = math.cosh(u) * math.cos(u), math.sinh(u) * math.sin(u)
    middle = found.share[np.argmin(np.abs(found.x - 0.6))]
    assert middle / found.share[0] == pytest.approx(c / (c**2 + s**2), rel=1e-9)


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("places", [(0.6,), (0.3, 0.9), (0.0, 0.5, 1.2), (0.1, 0.35, 0.8)])
def test_comb_on_the_fell_against_finite_elements(places) -> None:
    """600 beam elements on springs, pushed down by 1 at the supports."""
    width, rigidity, foundation, count = 1.2, 4e3, 1.6e6, 600
    found = fell_pressure(width, np.array(places), rigidity, foundation)
    step = width / count
    stiff = rigidity / step**3 * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    bed = (
        foundation * step / 420 * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    )
    whole = np.zeros((2 * count + 2, 2 * count + 2))
    for element in range(count):
        whole[2 * element : 2 * element + 4, 2 * element : 2 * element + 4] += stiff + bed
    held = [2 * round(place / step) for place in places]
    free = np.setdiff1d(np.arange(2 * count + 2), held)
    moved = np.zeros(2 * count + 2)
    moved[held] = 1.0
    moved[free] = np.linalg.solve(whole[np.ix_(free, free)], -whole[np.ix_(free, held)].sum(axis=1))
    line = moved[::2]
    wanted = np.interp(found.x, np.linspace(0, width, count + 1), line) / np.trapezoid(line, dx=step) * width
    np.testing.assert_allclose(found.share, wanted, rtol=1e-3, atol=1e-4)


def test_a_rigid_comb_presses_evenly() -> None:
    assert fell_pressure(1.2, np.array([0.2, 0.7]), 1e15, 1e6).uniformity == 1.0


@pytest.mark.parametrize("rigidity", [1e8, 1e15])
def test_a_rigid_comb_on_one_support_tilts_until_its_moments_balance(rigidity) -> None:
    found = fell_pressure(1.2, np.array([0.4]), rigidity, 1e6)
    assert np.trapezoid(found.share * (found.x - 0.4), found.x) == pytest.approx(0.0, abs=1e-4)
    assert np.trapezoid(found.share, found.x) == pytest.approx(1.2, rel=1e-4)
    assert found.share[[0, -1]] == pytest.approx([2.0, 0.0], abs=0.02)


def test_mean_of_the_shares_is_one() -> None:
    found = fell_pressure(4.0, np.array([0.0, 1.3, 4.0]), 1e4, 1.6e6)
    fine = np.interp(np.linspace(0, 4.0, 4001), found.x, found.share)
    assert np.trapezoid(fine, dx=1e-3) / 4.0 == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("drive", ["comb", "linkage"])
def test_the_report_is_whole(drive) -> None:
    report = answer(drive=drive)
    names = [figure.name for figure in report.figures]
    assert len(set(names)) == len(names) == 6
    assert [type(figure) for figure in report.figures].count(Drawing) == 1
    for figure in report.figures:
        for series in figure.series if isinstance(figure, Plot) else ():
            assert series.x.shape == series.y.shape
            assert np.all(np.isfinite(series.y))
    for table in report.tables:
        assert {len(row) for row in table.rows} == {len(table.columns)}
    links = {"hammer-link-strength", "hammer-pin-strength"} if drive == "linkage" else set()
    assert {table.name for table in report.tables} == {"hammer-rows", "hammer-blow", "hammer-across"} | links


def test_the_thesis_loom_is_beaten_to_its_rows() -> None:
    """25 rows a decimetre, 10 N for each of 600 warps; the deepest comb needed presses within a tenth."""
    design, report = made(), answer()
    assert report.failed == ()
    assert design.rows_along == pytest.approx(250.0)
    assert result(report, "force") == pytest.approx(6000.0)
    assert design.comb.line.uniformity >= 0.9
    one_less = made(comb_depth=design.params.depth - 10 * mm)
    assert one_less.comb.line.uniformity < 0.9


def test_cams_and_comb_go_down_together() -> None:
    """m a of the stroke, the weight held, the power of both axes."""
    axis = made().axis
    assert axis is not None
    assert axis.mass == pytest.approx(550.0 + made().comb.mass + 2.0)
    way = (1 - 0.15) / 2 * 3.0
    assert np.max(np.abs(axis.acceleration)) == pytest.approx(5.527957 * 0.1 / way**2, rel=1e-3)
    assert axis.balance == pytest.approx(axis.mass * 9.81)
    assert np.max(axis.press) == pytest.approx(6000.0, rel=1e-6)
    np.testing.assert_allclose(axis.force, axis.mass * axis.acceleration - axis.balance + axis.press)
    assert axis.drive is not None


def test_a_balanced_comb_asks_for_the_press_alone() -> None:
    axis = made(counterbalance=1.0).axis
    assert axis is not None
    assert np.max(axis.force) == pytest.approx(6000.0, abs=axis.inertia_force)
    assert axis.balance == 0.0


def test_screws_do_not_buckle_and_brakes_hold_what_hangs() -> None:
    """Euler, one end clamped: 2 pi^2 E I / l^2 over the force of an axis, l = 300 mm."""
    axis = made().axis
    assert axis is not None
    assert axis.screw is not None
    force = np.max(np.abs(axis.force)) / 2
    inertia = math.pi * (0.85 * axis.screw.diameter) ** 4 / 64
    assert axis.screw.buckling == pytest.approx(2 * math.pi**2 * 210e9 * inertia / 0.3**2 / force)
    assert axis.screw.buckling >= 3
    assert axis.brake == pytest.approx(axis.balance / 2 * 0.01 / (2 * math.pi))
    failed = [check.name for check in answer(screw_diameter=8 * mm, stroke=1.5, axes=2).failed]
    assert {"buckling of the screws", "static load of the screws"} <= set(failed)
    belt = answer(axis="belt")
    assert "screw_diameter" not in [one.name for one in belt.results]
    assert "buckling of the screws" not in [check.name for check in belt.checks]


def test_screws_are_thick_enough_for_load_speed_and_life() -> None:
    """Whirl by the frequency equation, tan z = tanh z; life by the cube of the load over all turns of the nut."""
    axis = made().axis
    assert axis is not None
    assert axis.screw is not None
    screw = axis.screw
    root = 3.9266
    assert math.tan(root) == pytest.approx(math.tanh(root), rel=1e-3)
    core = 0.85 * screw.diameter
    stiff, line = 210e9 * math.pi * core**4 / 64, 7850 * math.pi * core**2 / 4
    quickest = np.max(np.abs(axis.speed)) / 0.01 * 2 * math.pi
    assert screw.critical == pytest.approx(quickest / (root**2 * math.sqrt(stiff / line) / 0.3**2), rel=1e-3)
    assert screw.speed_value == pytest.approx(screw.diameter * quickest)
    turned = np.abs(axis.speed) / 0.01
    damage = np.mean((np.abs(axis.force) / 2 / 14e3) ** 3 * turned) / 1e6
    assert screw.life == pytest.approx(1 / damage, rel=1e-9)
    thin = answer(screw_diameter=16 * mm, axes=2, lead=10 * mm)
    assert "life of the screws" in [check.name for check in thin.failed]
    assert screw.life >= 10_000 * 3600


def test_axes_are_as_many_as_their_checks_need() -> None:
    """A comb that goes quickly and far needs a larger lead; a heavy one more axes: the choice says which check."""
    quick = made(stroke=0.3, step=0.9, stack_mass=0.0)
    assert quick.params.screw_lead > 10 * mm
    (choice,) = quick.choices
    assert choice.decided_by in {"torque of the servo over the required torque", "speed value of the screws"}
    heavy = made(cloth=cloth(warps=3000), stack_mass=60_000.0)
    assert heavy.params.axis_count > heavy.params.support_count
    assert answer(cloth=cloth(warps=3000), stack_mass=60_000.0).failed == ()


def test_work_of_the_press_over_a_turn_packs_two_rows() -> None:
    """Over a turn the axes do what packs: gravity and inertia give all back, the fell what it stretched."""
    design = made()
    axis = design.axis
    assert axis is not None
    work = np.sum(axis.press * axis.speed) * (12.0 / axis.speed.size)
    assert work == pytest.approx(2 * 600 * design.fabric.packing_work(design.spacing), rel=0.03)


def test_rows_of_the_table_follow_from_their_force() -> None:
    design = made()
    table = next(table for table in MACHINE.report(design).tables if table.name == "hammer-rows")
    force, every, spacing, along, displacement, energy = np.array(table.rows).T
    np.testing.assert_allclose(every, 600 * force)
    np.testing.assert_allclose(spacing * along, 1.0)
    assert spacing[force == design.needed] == pytest.approx(design.spacing)
    assert energy[force == design.needed] == pytest.approx(600 * design.energy)
    assert (np.diff(spacing) < 0).all()
    assert (np.diff(displacement) > 0).all()


def test_leaves_of_the_comb_bend_as_cantilevers() -> None:
    design = made()
    p, comb = design.params, design.comb
    force, inertia = design.needed * comb.line.most, p.leaf * p.leaf_height**3 / 12
    assert comb.leaf_sag == pytest.approx(force * p.reach**3 / (3 * p.modulus * inertia))
    assert comb.leaf_stress == pytest.approx(force * p.reach * (p.leaf_height / 2) / inertia)


def test_work_of_a_beat_packs_a_row_and_lifts_what_is_not_balanced() -> None:
    energies = {}
    for balanced in (0.0, 0.4, 1.0):
        design = made(counterbalance=balanced)
        (work,) = MACHINE.work(design)
        assert work.per == "beat"
        energies[balanced] = work.energy
    assert energies[0.0] - energies[1.0] == pytest.approx(design.mass * 9.81 * design.params.stroke)
    assert energies[0.4] - energies[1.0] == pytest.approx(0.6 * (energies[0.0] - energies[1.0]))
    assert design.axis is not None
    pressed = np.sum(np.maximum(design.axis.press * design.axis.speed, 0.0)) * (12.0 / design.axis.speed.size)
    assert 2 * energies[1.0] == pytest.approx(pressed, rel=0.01)


PAPER = dict(drive="linkage", beat_speed=15.5, ballast=0.0, beaters=1)


def test_force_of_the_linkage_goes_with_the_square_of_its_speed() -> None:
    slow, quick = made(**PAPER), made(**{**PAPER, "beat_speed": 31.0})
    assert slow.linkage is not None
    assert quick.linkage is not None
    # Stronger links have heavier brackets on the comb.
    slow_mass, quick_mass = (found.linkage.one.params.beater_mass for found in (slow, quick))
    assert quick.linkage.force / quick_mass == pytest.approx(4 * slow.linkage.force / slow_mass)
    assert quick.spacing < slow.spacing
    needed = slow.linkage.speed_needed
    reached = made(**{**PAPER, "beat_speed": needed})
    assert reached.spacing == pytest.approx(reached.params.cloth.row_distance)


def test_a_slow_linkage_leaves_the_rows_loose_and_says_so() -> None:
    report = answer(**PAPER)
    assert {"distance of the rows", "force of the crank-rockers"} <= {check.name for check in report.failed}
    assert any("rows a decimetre where 25 are required" in said for said in report.warnings)


@pytest.mark.parametrize("asked", [{}, dict(cloth=cloth(warps=300)), dict(cloth=cloth(warps=3000)), dict(cloth=FINE)])
def test_crank_rockers_are_as_strong_as_needed(asked) -> None:
    """The comb's inertia at the beat, its ballast included, is the force of all rows; every check holds."""
    design, report = made(drive="linkage", **asked), answer(drive="linkage", **asked)
    assert report.failed == ()
    linkage = design.linkage
    assert linkage is not None
    brackets = linkage.number * bracket(linkage.one.params, design.params).mass
    mass = design.comb.mass + linkage.ballast + brackets
    at_beat = linkage.one.state_at(np.array([linkage.one.beta])).beater.acceleration[0]
    assert mass * abs(at_beat) == pytest.approx(linkage.force)
    assert linkage.force >= design.needed * design.params.cloth.warps
    assert design.force == pytest.approx(design.needed)
    assert linkage.one.params.beater_mass * linkage.number == pytest.approx(mass)


def test_a_ballast_too_light_is_the_user_s_choice_and_fails() -> None:
    report = answer(drive="linkage", ballast=1.0, beat_speed=20.0)
    assert "force of the crank-rockers" in [check.name for check in report.failed]
    assert all(check.cure for check in report.failed)


def test_the_stroke_for_the_controller_comes_back_twice_a_turn() -> None:
    (table,) = answer().cam_tables
    angle = np.linspace(0, math.pi, 40)
    np.testing.assert_allclose(table.motion(angle), table.motion(angle + math.pi), atol=1e-12)
    assert table.motion(np.array([0.0, math.pi / 4]))[0] == pytest.approx([0.0, 0.0])
    assert float(table.motion(np.array([3 * math.pi / 4]))[0, 0]) == pytest.approx(0.1)


def test_wide_carpets_hold_the_comb_more_often() -> None:
    wide = made(cloth=cloth(warps=4000, warp_pitch=1 * mm))
    assert (wide.params.support_count, wide.params.axis_count) == (4, 4)
    assert wide.comb.line.uniformity >= 0.9


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(jammed_pitch="5mm"), "rows 4 mm apart; between jammed_pitch=5 mm and laid_pitch=6 mm"),
        (dict(laid_pitch="3.5mm"), "between jammed_pitch=3 mm and laid_pitch=3.5 mm"),
        (dict(leaf_thickness="2mm"), "leaf_thickness=2 mm on a warp pitch of 2 mm; below 2 mm"),
        (dict(support_inset="700mm"), "at most half of the width, 600 mm"),
        (dict(drive="hand"), "one of comb, linkage"),
        ({"cloth.tension": "0N"}, "out of bounds"),
    ],
)
def test_what_cannot_be_is_refused(asked, said) -> None:
    with pytest.raises(ParameterError, match=said):
        HammerParams.read(asked)


@pytest.mark.parametrize("settings", [{}, {"leaf_height": 30 * mm, "comb_thickness": 25 * mm}, {"comb_depth": 40 * mm}])
def test_the_second_moment_of_a_slotted_bar_is_that_of_its_cells(settings: dict[str, Any]) -> None:
    """Cells of 1/400 of its sides, those of the slots left out."""
    params = HammerParams(**{"comb_depth": 110 * mm, **settings})
    (moment, edge), (deep, tall) = second_moment(params), slot_of(params)
    high, wide = params.depth, params.comb_thickness
    y, x = np.meshgrid((np.arange(800) + 0.5) / 800 * high, (np.arange(800) + 0.5) / 800 * wide)
    cells = ~((y < tall) & (x < deep))
    middle = float(y[cells].mean())
    cell = high * wide / 800**2
    assert moment == pytest.approx(float(((y[cells] - middle) ** 2).sum()) * cell, rel=2e-3)
    assert edge == pytest.approx(max(middle, high - middle), rel=2e-3)


@pytest.mark.parametrize("drive", ["comb", "linkage"])
def test_each_leaf_fills_its_slot_in_the_bar(drive: str) -> None:
    """By manifold3d: the leaves are in no metal of the bar, and half a slot aside all of them are."""
    bodies = tree(MACHINE.design(HammerParams(drive=drive))).body("hammer/comb")
    (bar,) = (own for own in bodies.occurrences if own.part.id == "hammer/bar")
    (leaves,) = (own for own in bodies.occurrences if own.part.id == "hammer/leaf")

    def solid(own: Occurrence, number: int, aside: float) -> Manifold:
        assert own.part.shape is not None
        mesh, place = own.part.shape.mesh(), own.positions[number]
        points = place.points(mesh.points) + place.rotation @ np.array([0.0, 0.0, aside])
        return Manifold(Mesh((points * 1e3).astype(np.float32), mesh.triangles.astype(np.uint32)))

    metal = solid(bar, 0, 0.0)
    for number in (0, 1, len(leaves.positions) // 2, len(leaves.positions) - 1):
        assert (metal ^ solid(leaves, number, 0.0)).volume() < 0.05
        assert (metal ^ solid(leaves, number, 0.4 * mm)).volume() > 5.0
