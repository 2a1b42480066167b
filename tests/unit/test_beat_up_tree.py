"""Beat-up and hammer as trees: list, plates, forces and checks by one description of each part."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from cloths import cloth
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.shoulders import LEAST_SAFETY
from ilmek.machines import beat_up, hammer
from ilmek.machines.beat_up import BeatUpParams
from ilmek.machines.beat_up.beater import beater_checks, beater_of
from ilmek.machines.beat_up.carriage import BELT_WIDTH, SHAFTS, shared_checks, shared_end
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.machines.beat_up.tree import tree as tree_of_beat_up
from ilmek.machines.beat_up.use import in_use
from ilmek.machines.hammer import HammerParams
from ilmek.machines.hammer.tree import tree as tree_of_hammer
from ilmek.machines.link_tree import PIN_STEEL
from ilmek.part.tree import Tree
from ilmek.plane.solids import is_closed, volume
from ilmek.report import Report

Made = tuple[Tree, Report]


def _beat_up(**given_settings: Any) -> Made:
    design = beat_up.design(BeatUpParams(**given_settings))
    return tree_of_beat_up(design), beat_up.MACHINE.report(design, illustrated=False)


def _hammer(**given_settings: Any) -> Made:
    design = hammer.design(HammerParams(**given_settings))
    return tree_of_hammer(design), hammer.MACHINE.report(design, illustrated=False)


MACHINES: dict[str, Callable[[], Made]] = {
    "the paper's": lambda: _beat_up(link_mass="bars", density=7210.0),
    "as made": _beat_up,
    "heavy": lambda: _beat_up(beater_mass=8.0, speed=25.0, width=0.05, thickness=0.02),
    "comb on axes": _hammer,
    "comb on crank-rockers": lambda: _hammer(drive="linkage"),
    "narrow comb on one crank-rocker": lambda: _hammer(drive="linkage", cloth=cloth(warps=100), beaters=1),
}


@pytest.mark.parametrize("name", MACHINES)
def test_every_line_is_a_part_of_the_tree_and_back(name: str) -> None:
    bodies, report = MACHINES[name]()
    parts = {part.id: (part, number) for part, number in bodies.occurrences()}
    assert [line.part for line in report.parts] == list(parts)
    for line in report.parts:
        part, number = parts[line.part]
        assert part.shape is not None, part.id
        assert is_closed(part.shape.mesh())
        assert line.number == number
        if part.material is not None:
            assert line.mass == pytest.approx(volume(part.shape.mesh(1e-7)) * part.material.density, rel=5e-5)


@pytest.mark.parametrize("name", MACHINES)
def test_checks_name_parts_that_the_machine_has(name: str) -> None:
    bodies, report = MACHINES[name]()
    names = {part.id for part, _ in bodies.occurrences()}
    concerned = {part for check in report.checks for part in check.parts}
    assert concerned <= names
    assert "comb" in name or {PART_IDS[link] for link in ("crank", "coupler", "rocker", "A")} <= concerned


@settings(max_examples=8)
@given(st.floats(0.15, 0.8), st.floats(0.6, 6.0), st.floats(5.0, 40.0), st.floats(0.02, 0.05), st.floats(0.006, 0.02))
def test_forces_use_the_masses_of_the_parts(
    ground: float, mass: float, speed: float, width: float, thickness: float
) -> None:
    """Mass, mass centre and inertia of each body of the dynamics are those of the body in the tree; the beater's mass
    stands in E there, with the inertia of its part about the pivot.
    """
    params = BeatUpParams(ground=ground, beater_mass=mass, speed=speed, width=width, thickness=thickness)
    design = beat_up.design(params)
    bodies = tree_of_beat_up(design)
    for name in ("crank", "coupler"):
        made, used = bodies.body(PART_IDS[name]).moments, design.bodies[name]
        assert used.mass == pytest.approx(made.zeroth, rel=1e-12)
        assert used.centre == pytest.approx(complex(made.centre[0], made.centre[1]), rel=1e-12, abs=1e-12)
        assert used.moment == pytest.approx(made.inertia[2, 2], rel=1e-9)
    made, used = bodies.body(PART_IDS["rocker"]).moments, design.bodies["rocker"]
    assert used.mass == pytest.approx(made.zeroth, rel=1e-9)
    found = in_use(design).travel.beater
    if all(check.ok for check in beater_checks(found)):
        about = made.second[0, 0] + made.second[1, 1]
        assert used.about(0j) == pytest.approx(about, rel=0.01)


def test_the_comb_that_crank_rockers_swing_weighs_what_they_bear() -> None:
    design = hammer.design(HammerParams(drive="linkage"))
    comb = tree_of_hammer(design).body("hammer/comb")
    assert design.linkage is not None
    one = design.linkage.one
    assert comb.moments.zeroth == pytest.approx(design.linkage.number * one.params.beater_mass, rel=1e-9)
    plates = hammer.MACHINE.plates(design)
    assert {plate.name for plate in plates} == {
        *("crank", "coupler", "rocker", "carriage-plate", "drive-plate", "leaf", "bracket"),
    }
    assert all(plate.thickness < 0.1 for plate in plates)


@pytest.mark.parametrize(("mass", "warps", "failed"), [(0.0, 6, 1), (0.01, 20, 2), (2.5, 6, 0), (500.0, 6, 1)])
def test_a_beater_that_cannot_be_fails(mass: float, warps: int, failed: int) -> None:
    found = beater_of(BeatUpParams(beater_mass=mass), warps, 0.3)
    assert sum(not check.ok for check in beater_checks(found)) == failed


def test_the_flywheel_has_the_inertia_that_the_clutch_needs() -> None:
    start = {"start.drive": "clutch"}
    design = beat_up.design(BeatUpParams.read(start))
    wheel = next(part for part, _ in tree_of_beat_up(design).occurrences() if part.id == "beat-up/flywheel")
    moments = wheel.moments
    assert moments is not None
    needed = next(one.value for one in beat_up.MACHINE.report(design).results if one.name == "start_flywheel")
    assert moments.inertia[2, 2] == pytest.approx(needed, rel=1e-9)
    assert math.isfinite(wheel.mass)


@given(st.floats(20.0, 2000.0), st.integers(1, 8))
def test_the_shaft_of_all_cranks_bears_torque_and_last_belt_at_its_shoulder(torque: float, number: int) -> None:
    """Stress by the section's formulas; the next thinner journal would not last."""
    linkage = beat_up.design(BeatUpParams())
    end = shared_end(linkage, torque, number)
    bent = torque / (number * linkage.params.width / 2) * BELT_WIDTH / 2
    stress = math.hypot(32 * bent, math.sqrt(3) * 16 * torque) / (math.pi * end.journal**3)
    checks = shared_checks(linkage, torque, number)
    assert checks[0].value == pytest.approx(stress)
    thinner = SHAFTS.index(end.journal) - 1
    if all(check.ok for check in checks) and thinner >= 0:
        weaker = replace(end, shaft=end.journal, journal=SHAFTS[thinner])
        assert weaker.safety < LEAST_SAFETY or weaker.stress > PIN_STEEL.strength / LEAST_SAFETY
    assert end.shaft > end.journal
