"""Redundant constraints that leave a mechanism movable: closed forms, and the null space of all equations.

The judge has all the joints of the file, none set free: three equations of each body in world coordinates, solved by
least squares. What the null space does not change is determined, and must agree; what it changes must be reported open.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import Forces, inverse
from ilmek.dynamics.loads import Gravity
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.making import made_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.mobility import mobility
from ilmek.linkage.model import Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.redundant import without_redundant
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross

GRAVITY = 2.0 - 9.81j


@dataclass
class Unknown:
    """A constraint force or the drive's effort: what it does to `on`, and the opposite to `by`."""

    name: str
    on: str
    by: str
    at: complex
    force: complex
    moment: float


def judged(
    unknowns: list[Unknown], inertias: dict[str, Inertia], centre: dict[str, complex], changes: dict[str, complex]
) -> tuple[dict[str, complex], set[str]]:
    """Force of each name, with a slide's couple as `NAME couple`; and the names that the null space changes.

    changes  body -> acceleration of its mass centre; no body turns with an angular acceleration
    """
    bodies = list(inertias)
    m, y = np.zeros((3 * len(bodies), len(unknowns))), np.zeros(3 * len(bodies))
    for row, body in enumerate(bodies):
        change = inertias[body].mass * (changes[body] - GRAVITY)
        y[3 * row : 3 * row + 2] = change.real, change.imag
        for column, one in enumerate(unknowns):
            sign = (one.on == body) - (one.by == body)
            turn = one.moment + float(cross(one.at - centre[body], one.force))
            m[3 * row : 3 * row + 3, column] = sign * np.array([one.force.real, one.force.imag, turn])
    sizes = np.linalg.lstsq(m, y, rcond=1e-12)[0]
    np.testing.assert_allclose(m @ sizes, y, atol=1e-9 * np.abs(y).max())
    free = np.linalg.norm(np.linalg.svd(m)[2][np.linalg.matrix_rank(m, tol=1e-9) :], axis=0) > 1e-9
    found: dict[str, complex] = {}
    for one, size in zip(unknowns, sizes, strict=True):
        found[one.name] = found.get(one.name, 0j) + size * (one.force or one.moment)
    return found, {one.name for one, loose in zip(unknowns, free, strict=True) if loose}


def check(forces: Forces, k: int, found: dict[str, complex], loose: set[str], drive: str) -> None:
    """That forces and couples of a sample are those of the judge where they are determined, and NaN elsewhere."""
    size = max(abs(force) for force in found.values())
    for name, force in found.items():
        joint, _, couple = name.partition(" ")
        own = forces.couples[joint][k] if couple else forces.effort(drive)[k] if joint == "drive" else None
        own = forces.reactions[joint][k] if own is None else own
        assert np.isnan(own) if name in loose else abs(own - force) <= 1e-9 * size, (name, own, force)


@pytest.mark.parametrize("seed", range(25))
def test_wedge_of_three_slides(seed: int) -> None:
    """Wedge at slope a, tappet along b: s_Y = s_X sin a / sin(a - b), both with an acceleration."""
    rng = np.random.default_rng(seed)
    slope, rise = rng.uniform(0.1, 1.2), rng.uniform(1.3, 2.8)
    at = dict(zip("XYW", rng.normal(size=3) + 1j * rng.normal(size=3), strict=True))
    bodies = [Body("ground", {"X": at["X"], "Y": at["Y"]}), Body("wedge", {"X": at["X"], "W": at["W"]})]
    bodies.append(Body("tappet", {"Y": at["Y"], "W": at["W"]}))
    joints = [Slide("X", "wedge", "ground"), Slide("W", "tappet", "wedge", along=slope)]
    joints.append(Slide("Y", "tappet", "ground", along=rise))
    order = rng.permutation(3)
    whole = Mechanism(tuple(bodies), tuple(joints[i] for i in order), (Displacement("X"),))
    assert (mobility(whole).counted, mobility(whole).ranked) == (0, 1)
    mechanism = without_redundant(whole)
    inertias = {
        body: Inertia(rng.uniform(1, 3), complex(*rng.normal(size=2)), rng.uniform(0.1, 1))
        for body in ("wedge", "tappet")
    }
    values, speed, acceleration = np.linspace(-0.3, 0.4, 5), 0.7, 5.0
    motion = solve(plan(mechanism), values, speed, acceleration).require()
    forces = inverse(motion, inertias, [Gravity(GRAVITY)])
    gain = np.sin(slope) / np.sin(slope - rise) * np.exp(1j * rise)
    np.testing.assert_allclose(motion.point("tappet", "Y").position, at["Y"] + gain * values, atol=1e-12)
    np.testing.assert_allclose(motion.point("tappet", "Y").acceleration, 5.0 * gain, atol=1e-12)
    for k, s in enumerate(values):
        moved = {"ground": 0, "wedge": s, "tappet": gain * s}
        unknowns = [Unknown("drive", "wedge", "ground", at["X"] + s, 1 + 0j, 0.0)]
        for joint in joints:
            place, along = at[joint.name] + moved[joint.body], 1j * np.exp(1j * joint.along)
            unknowns.append(Unknown(joint.name, joint.body, joint.guide, place, along, 0.0))
            unknowns.append(Unknown(f"{joint.name} couple", joint.body, joint.guide, place, 0j, 1.0))
        centre = {body: moved[body] + inertia.centre for body, inertia in inertias.items()}
        found, loose = judged(unknowns, inertias, centre, {"wedge": 5.0, "tappet": 5.0 * gain})
        assert loose == {"X couple", "Y couple", "W couple"}
        check(forces, k, found, loose, "X")
    assert forces.power_error < 1e-12


@pytest.mark.parametrize("seed", range(25))
def test_parallelogram_of_three_to_five_cranks(seed: int) -> None:
    """The coupler translates in a circle over a full turn; the radial forces of all cranks are open."""
    rng = np.random.default_rng(seed)
    number, radius, angle = int(rng.integers(3, 6)), rng.uniform(0.2, 0.6), rng.uniform(0, 6)
    feet = rng.normal(size=number) + 1j * rng.normal(size=number)
    heads = feet + radius * np.exp(1j * angle)
    bodies = [Body("ground", {f"A{i}": a for i, a in enumerate(feet)})]
    bodies += [Body(f"crank{i}", {f"A{i}": a, f"B{i}": b}) for i, (a, b) in enumerate(zip(feet, heads, strict=True))]
    bodies += [Body("coupler", {f"B{i}": b for i, b in enumerate(heads)})]
    pins = [Pin(f"A{i}", "ground", f"crank{i}") for i in range(number)]
    pins += [Pin(f"B{i}", f"crank{i}", "coupler") for i in range(number)]
    mechanism = as_drawn(without_redundant(Mechanism(tuple(bodies), tuple(pins), (Rotation("crank1", "A1"),))))
    inertias = {
        body.name: Inertia(rng.uniform(1, 3), complex(*rng.normal(size=2)), rng.uniform(0.1, 1)) for body in bodies[1:]
    }
    values = np.linspace(0, 2 * np.pi, 7)
    motion = solve(plan(mechanism), values, 3.0).require()
    forces = inverse(motion, inertias, [Gravity(GRAVITY)])
    arm = radius * np.exp(1j * (angle + values))
    for i, foot in enumerate(feet):
        np.testing.assert_allclose(motion.point("coupler", f"B{i}").position, foot + arm, atol=1e-12)
        np.testing.assert_allclose(motion.point(f"crank{i}", f"B{i}").position, foot + arm, atol=1e-12)
    for k, value in enumerate(values):
        turned = np.exp(1j * value)
        unknowns = [Unknown("drive", "crank1", "ground", feet[1], 0j, 1.0)]
        for i, foot in enumerate(feet):
            for axis in (1, 1j):
                unknowns.append(Unknown(f"A{i}", f"crank{i}", "ground", foot, axis, 0.0))
                unknowns.append(Unknown(f"B{i}", "coupler", f"crank{i}", foot + arm[k], axis, 0.0))
        arms = {f"crank{i}": (inertias[f"crank{i}"].centre - foot) * turned for i, foot in enumerate(feet)}
        centre = {f"crank{i}": foot + arms[f"crank{i}"] for i, foot in enumerate(feet)}
        centre["coupler"] = inertias["coupler"].centre - heads[0] + feet[0] + arm[k]
        changes = {body: -9.0 * own for body, own in arms.items()} | {"coupler": -9.0 * arm[k]}
        found, loose = judged(unknowns, inertias, centre, changes)
        assert loose == {pin.name for pin in pins}
        check(forces, k, found, loose, "crank1")
    assert forces.power_error < 1e-12


WEDGE = """\
inputs = { X = "wedge" }
motions = { X = "10mm/s" }
[bodies]
ground.points = { X = [0, 0], Y = [0, 0] }
wedge.points = { X = [0, 0], W = [0, 0] }
tappet = { points = { Y = [0, 0], W = [0, 0] }, mass = "3kg" }
[joints]
X = { slide = ["wedge", "ground"] }
W = { slide = ["tappet", "wedge"], along = "20deg" }
Y = { slide = ["tappet", "ground"], along = "90deg" }
"""


def test_a_file_names_what_is_redundant_and_what_is_open() -> None:
    file = parse_mechanism(WEDGE)
    found = analysis(run(file, MotionRequest({}, over=(0.0, 0.08))))
    assert [check.name for check in found.checks if not check.ok] == []
    assert any(check.name == "Y free: stands still" for check in found.checks)
    (warning,) = found.warnings
    assert warning.endswith("redundant constraint at Y free: the forces of couple of W, couple of X, couple of Y")
    for text, toml in ((mechanism_toml(file.machine), True), (mechanism_json(file.machine), False)):
        assert parse_mechanism(text, toml=toml).machine.mechanism == file.mechanism


def test_a_tappet_that_cannot_move_is_refused_as_before() -> None:
    turned = WEDGE.replace('along = "90deg" }', 'along = "90deg", turned = "1deg" }')
    with pytest.raises(MechanismError, match="over-constrained"):
        parse_mechanism(turned).plan()


def test_cranks_of_unequal_length_are_over_constrained() -> None:
    feet = {"A0": 0, "A1": 1, "A2": 2 + 0.5j}
    heads = {"B0": 1j, "B1": 1 + 1j, "B2": 2.1 + 1.5j}
    bodies = [Body("ground", feet), Body("coupler", heads)]
    bodies += [Body(f"crank{i}", {f"A{i}": feet[f"A{i}"], f"B{i}": heads[f"B{i}"]}) for i in range(3)]
    pins = [Pin(f"A{i}", "ground", f"crank{i}") for i in range(3)] + [
        Pin(f"B{i}", f"crank{i}", "coupler") for i in range(3)
    ]
    whole = Mechanism(tuple(bodies), tuple(pins), (Rotation("crank0", "A0"),), {"B1": 1})
    assert without_redundant(whole) is whole
    with pytest.raises(MechanismError, match="over-constrained"):
        plan(whole)


def test_no_parts_are_made_of_a_redundant_constraint() -> None:
    with pytest.raises(MechanismError, match="Y free are open"):
        made_mechanism(run(parse_mechanism(WEDGE), MotionRequest({}, over=(0.0, 0.08))))
