"""The tension compensator: equilibrium against the least energy, energy balance, swing, strength, choices."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cloths import cloth
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.beam.model import Beam, LineLoad
from ilmek.elements.beam.solve import bend
from ilmek.elements.tubes import find_tube
from ilmek.machines.tension_compensator import MACHINE, TensionCompensator, TensionCompensatorParams, design
from ilmek.machines.tension_compensator.analysis import CompensatorAnalysis, analyse, equilibrium, mean_tension
from ilmek.machines.tension_compensator.design import equilibrium_tension, stiffness, swing
from ilmek.machines.tension_compensator.geometry import WarpPath
from ilmek.machines.tension_compensator.linkage import spring_forces
from ilmek.machines.tension_compensator.members import SADDLE, STEEL, bar_checks, roller_for, roller_pin_check
from ilmek.machines.tension_compensator.tree import lever_motion, tree
from ilmek.part.clearances import approaches
from ilmek.part.contacts import contacts
from ilmek.part.shapes import shape_box
from ilmek.part.welds import welds_of
from ilmek.units import deg, mm
from ilmek.weaving.shed import shed_lengthening

LIFT = float(shed_lengthening(60 * mm, 170 * mm, 170 * mm))


@cache
def usual() -> TensionCompensator:
    return design(TensionCompensatorParams())


@cache
def turned(bars: int) -> CompensatorAnalysis:
    return analyse(design(TensionCompensatorParams(bars=bars)))


def failed(**given_settings: str) -> set[str]:
    return {one.name for one in MACHINE.report(design(TensionCompensatorParams.read(given_settings))).failed}


def potential(made: TensionCompensator, phi: np.ndarray, lengthening: float) -> np.ndarray:
    """Energy of a lever's warps and springs [J], written from their lengths alone."""
    one, task = made.one, made.one.task
    longer = lengthening - one.lever.slack(phi)
    warps = task.warps * (task.tension * longer + task.rate * longer**2 / 2)
    short = one.free_length - one.lever.spring_length(phi)
    return warps + one.springs * one.rate * short**2 / 2


@pytest.mark.parametrize("share", [0.0, 0.1, 0.4, 0.75, 1.0])
@pytest.mark.parametrize("bars", [1, 2])
def test_equilibrium_is_the_least_energy_by_brute_force(bars: int, share: float) -> None:
    made = design(TensionCompensatorParams(bars=bars))
    longer = share * made.one.task.lengthening
    grid = np.linspace(-0.02, made.one.angle + 0.02, 400_001)
    least = grid[np.argmin(potential(made, grid, longer))]
    assert float(equilibrium(made.one, np.array([longer]))[0]) == pytest.approx(least, abs=2 * (grid[1] - grid[0]))


@pytest.mark.parametrize("bars", [1, 2])
def test_the_linkage_engine_finds_no_torque_missing(bars: int) -> None:
    found = turned(bars)
    torque = found.design.loads.torque
    assert np.abs(found.effort).max() < 1e-9 * torque


def test_the_work_of_the_shed_is_the_energy_of_warps_and_springs() -> None:
    """Slowly opened: the integral of the warps' tension over their lengthening."""
    made = usual()
    longer = np.linspace(0.0, made.one.task.lengthening, 2001)
    rotation = equilibrium(made.one, longer)
    tension = mean_tension(made.one.task, longer, made.one.lever.slack(rotation))
    work = made.one.task.warps * float(np.trapezoid(tension, longer))
    ends = [float(potential(made, np.array([phi]), at)[0]) for phi, at in ((rotation[0], 0.0), (rotation[-1], LIFT))]
    assert ends[1] - ends[0] == pytest.approx(work, rel=1e-6)
    springs = made.one.springs * np.trapezoid(
        spring_forces(made.one, rotation), -made.one.lever.spring_length(rotation)
    )
    assert turned(2).stored == pytest.approx(made.levers * springs, rel=1e-6)


def test_a_linear_compensator_gives_the_closed_form() -> None:
    """x = N k l / (K + N k): two springs in series; what is left is the gain of the tension."""
    params, rate = usual().params, usual().one.task.rate
    own = 0.1 * rate
    gives = rate * LIFT / (own + rate)
    assert swing(params, 2) == pytest.approx((15 + rate * (LIFT - gives), 15.0))
    both = rate * (LIFT / 2) / (own + rate)
    one_bar = 15 + rate * (LIFT - both), 15 - rate * both
    assert swing(params, 1) == pytest.approx(one_bar)
    assert float(usual().one.lever.slack(usual().one.angle)) == pytest.approx(gives)


def test_two_bars_relieve_the_lifted_half_and_leave_the_other() -> None:
    found = turned(2)
    assert usual().fixed_tension == pytest.approx(15 + usual().one.task.rate * LIFT)
    assert usual().fixed_tension > 2 * 15
    assert found.tension_max == pytest.approx(usual().tension_open, rel=1e-3)
    assert usual().tension_open < 1.15 * 15
    assert found.tension_min == pytest.approx(15.0, rel=1e-6)
    assert found.odd == pytest.approx(found.even[::-1], abs=1e-6)
    quarter = len(found.angle) // 4
    assert found.even[quarter] == pytest.approx(15 + usual().one.task.rate * LIFT / 11)


def test_one_bar_slackens_the_warps_that_are_not_lifted() -> None:
    found = turned(1)
    assert found.tension_min < 0.5 * 15
    assert found.tension_max > 1.5 * 15
    assert failed(bars="1") >= {"tension in the open shed", "least tension of a warp"}
    choice = MACHINE.choices(usual())[0]
    assert (choice.name, choice.chosen, choice.next_cheaper) == ("bars", "2", "1")
    assert design(TensionCompensatorParams(lift=20 * mm)).bars == 1


@settings(max_examples=25, deadline=None)
@given(first=st.floats(0.02, 0.5), more=st.floats(1.1, 3.0))
def test_a_stiffer_compensator_swings_more(first: float, more: float) -> None:
    soft, stiff = (design(TensionCompensatorParams(bars=2, rate_share=share)) for share in (first, first * more))
    assert 15.0 < soft.tension_open < stiff.tension_open < usual().fixed_tension
    assert soft.relief > stiff.relief


@settings(max_examples=25, deadline=None)
@given(strand=st.floats(20.0, 60.0), x=st.floats(-0.02, 0.02), y=st.floats(-0.02, 0.02))
def test_the_force_of_the_warps_is_minus_the_gradient_of_their_length(strand: float, x: float, y: float) -> None:
    path = WarpPath(0.12, 0.03)
    bar = path.at_rest(strand * deg) + complex(x, y)
    assert path.strands(np.asarray(path.at_rest(strand * deg)))[0] == pytest.approx(strand * deg)
    step, pull = 1e-6, complex(path.pull(np.asarray(bar)))
    for along in (1.0, 1j):
        change = float(path.length(np.asarray(bar + step * along)) - path.length(np.asarray(bar - step * along)))
        assert -change / (2 * step) == pytest.approx((pull * np.conj(along)).real, abs=1e-7)


def test_natural_frequency_from_the_energy_alone() -> None:
    made = usual()
    step = 1e-4
    energy = potential(made, np.array([-step, 0.0, step]), 0.0)
    second = (energy[0] - 2 * energy[1] + energy[2]) / step**2
    assert stiffness(made.one, 0.0) == pytest.approx(second, rel=1e-4)
    moment = made.moving_mass / made.levers * made.params.bar_arm**2
    stiff = min(stiffness(made.one, angle) for angle in (0.0, made.one.angle))
    assert made.frequency == pytest.approx(math.sqrt(stiff / moment) / (2 * math.pi))


@pytest.mark.parametrize("levers", [2, 3, 5])
def test_a_bar_bends_no_more_than_its_checks_say(levers: int) -> None:
    width, line, tube = 0.6 * levers, 5000.0, find_tube("60.3x5")
    params = TensionCompensatorParams(cloth=cloth(warp_pitch=width / 600), support_span=0.6)
    assert params.levers == levers
    at = tuple(float(one) for one in (np.arange(levers) + 0.5) * 0.6)
    bent = bend(Beam(width, at, (LineLoad(0.0, width, line),)))
    sag, stress = bar_checks(params, tube, line)
    largest = bent.deflection_max(STEEL.modulus * tube.inertia).size
    assert largest <= sag.value * (1 + 1e-9)
    assert sag.value == pytest.approx(largest) or levers > 2
    assert stress.value == pytest.approx(line * 0.6**2 / 8 / tube.modulus)


def test_tensions_on_the_way_hold_the_springs() -> None:
    angles = np.linspace(0.0, usual().one.angle, 5)
    tension = equilibrium_tension(usual().one, angles)
    longer = usual().one.lever.slack(angles) + (tension - 15) / usual().one.task.rate
    assert equilibrium(usual().one, longer) == pytest.approx(angles, abs=1e-9)


@pytest.mark.parametrize("error", [0.9, 1.1])
def test_an_error_of_the_springs_rate_changes_the_tension_by_a_few_percent(error: float) -> None:
    """The preload is set again; the rate is not that of the design."""
    one = usual().one
    wrong = replace(one, rate=error * one.rate)
    assert wrong.free_length - one.lever.spring_length(0.0) == pytest.approx(one.preload / wrong.rate)
    longer = np.array([0.0, one.task.lengthening])
    rotation = equilibrium(wrong, longer)
    tension = mean_tension(one.task, longer, one.lever.slack(rotation))
    assert tension[0] == pytest.approx(15.0)
    assert tension[1] == pytest.approx(15 + one.task.rate * LIFT / 11, rel=0.04)


def test_springs_hold_their_force_and_fit() -> None:
    spring = usual().one.spring
    assert spring is not None
    assert spring.rate == pytest.approx(usual().spring_rate)
    assert spring.fatigue_safety(usual().spring_preload, usual().spring_force) >= usual().params.spring_fatigue
    assert spring.free_length - usual().spring_preload / spring.rate < usual().params.strut
    assert usual().one.clearance(usual().lever_height) > 0


def test_where_no_spring_is_enough_the_check_fails() -> None:
    assert "springs of the table" in failed(**{"cloth.tension": "1000N", "cloth.yarns.warp_stiffness": "1e6N"})
    weak = MACHINE.report(design(TensionCompensatorParams(cloth=cloth(tension=1000.0, warp_stiffness=1e6))))
    assert all(check.cure for check in weak.failed)


@pytest.mark.parametrize("width", ["0.6m", "1.2m", "2.4m", "6m"])
def test_a_compensator_for_every_width(width: str) -> None:
    warps = str(round(float(width[:-1]) / 0.002))
    assert failed(**{"cloth.warps": warps}) == set()


HEAVY = {
    "12 springs of a lever": {"cloth.warps": "1050", "cloth.warp_pitch": "2mm", "cloth.tension": "30N", "lift": "70mm"},
    "narrow": {"cloth.warps": "400", "cloth.warp_pitch": "1.25mm", "cloth.tension": "20N"},
    "one bar": {"bars": "1", "lift": "50mm"},
    "light": {"cloth.warps": "300", "cloth.tension": "10N"},
}


@pytest.mark.parametrize("name", HEAVY)
def test_no_part_of_a_compensator_is_through_another_at_rest_and_in_the_open_shed(name: str) -> None:
    """By the common volume of meshes: bars and rods, their saddles and rollers, the springs of neighbours."""
    made = design(TensionCompensatorParams.read(HEAVY[name]))
    angle = np.array([0.0, math.pi, math.tau])
    motion = lever_motion("turn", angle, np.array([0.0, made.one.angle, 0.0]))
    whole = tree(replace(made, bars=1), {"even": motion})
    assert not contacts(whole).through
    moving = approaches(whole, "turn", 1 * mm, ((0.0, math.tau),), lambda _first, _other: 0.0)
    assert [near.parts for near in moving if near.distance < 0] == []


@pytest.mark.parametrize("name", HEAVY)
def test_the_springs_of_a_lever_stand_in_its_share_of_the_width(name: str) -> None:
    made = design(TensionCompensatorParams.read(HEAVY[name]))
    spring, stations = made.one.spring, sorted(made.parts.supports.spring_stations)
    assert spring is not None
    outer = spring.diameter + spring.wire_diameter
    assert np.diff(stations).min() >= outer
    assert stations[-1] + outer / 2 <= made.params.cloth.width / 2


def test_a_lever_passes_the_rod_before_it() -> None:
    """High levers: the rods stand farther apart than radii and arm of the bar require."""
    heavy = {"cloth.warps": "840", "cloth.warp_pitch": "2.5mm", "cloth.tension": "30N", "lift": "70mm", "bars": "1"}
    made = design(TensionCompensatorParams.read(heavy))
    assert made.one.lever.path.half > max(4 * made.radius, 0.55 * made.params.bar_arm)
    assert "room between lever and rod" not in {check.name for check in MACHINE.report(made).failed}


@pytest.mark.parametrize("name", HEAVY)
def test_a_spring_is_guided_over_its_length(name: str) -> None:
    """Between turning ends it would buckle; the bare coils between collar and sleeve are shorter than its diameter."""
    made = design(TensionCompensatorParams.read(HEAVY[name]))
    spring, parts = made.one.spring, made.parts.struts
    assert spring is not None
    assert parts.strut is not None
    assert parts.rod is not None
    assert parts.sleeve is not None
    rest = made.params.strut - 2 * parts.strut.seat
    high = float(shape_box(parts.sleeve.shape)[1][2])
    assert rest - parts.strut.collar - (high - parts.strut.socket) < spring.diameter
    tail = float(shape_box(parts.rod.shape)[1][2]) - parts.strut.socket - parts.strut.collar
    assert tail - (rest - parts.strut.collar - (high - parts.strut.socket)) == pytest.approx(parts.strut.engaged)
    assert parts.strut.guide < spring.diameter - spring.wire_diameter


def test_saddles_are_welded_with_the_throat_that_their_load_needs() -> None:
    """Greatest force on a length of two seams by an elastic sum over their points, at the saddle's own size."""
    made = design(TensionCompensatorParams())
    loads, params, members = made.loads, made.params, made.members
    wide = 2 * made.parts.supports.strip
    force = loads.line * params.cloth.width / params.levers
    along = np.linspace(-wide / 2, wide / 2, 2001)
    points = np.concatenate([along + 0.5j * wide, along - 0.5j * wide])
    length = wide / 2000
    bent = loads.torque / params.bar_arm * (made.radius + 1.25 * members.roller.outer)
    inside = np.abs(points) * bent / (np.sum(np.abs(points) ** 2) * length) + force / (2 * wide)
    lifted = np.abs(points.real) * force * params.lever_thickness / (np.sum(points.real**2) * length)
    stress = float(np.hypot(inside, lifted).max()) / members.throat
    assert 0.2 * 208e6 < stress < 208e6
    welds = welds_of(tree(made))[made.parts.saddle.id]
    for other, share in ((made.parts.lever.id, 1.0), (made.parts.cross_piece.id, 0.5)):  # a rod bears half of a bar
        own = [weld for weld in welds if weld.other == other]
        assert own
        assert all(weld.throat == members.throat and sum(weld.lengths) >= share * 2 * wide for weld in own)


def test_no_pin_nor_roller_bears_more_than_it_may() -> None:
    made = design(TensionCompensatorParams())
    members, one = made.members, made.one
    moment = sum(one.force * one.pitch * (k + 0.5) for k in range(math.ceil(one.springs / 2)))
    assert moment / (math.pi / 32 * members.spring_pin**3) < 750e6 / made.params.safety
    force = made.loads.line * made.params.cloth.width / made.params.levers / math.sqrt(2)
    assert members.roller.static > 1.25 * force


@pytest.mark.parametrize("line", [1e3, 3e3, 6e3, 1e4])
def test_a_roller_is_one_whose_pin_bears_it(line: float) -> None:
    """The moment of half a bar's load at the middle of its roller, 1 mm beside the saddle, by hand."""
    params = usual().params
    roller = roller_for(params, line)
    force = line * params.cloth.width / params.levers / (2 * math.cos(SADDLE))
    stress = 32 * force * (1 * mm + roller.width / 2) / (math.pi * roller.bore**3)
    assert stress <= params.strength / params.safety
    assert roller_pin_check(params, roller, line).value == pytest.approx(stress, rel=1e-12)
