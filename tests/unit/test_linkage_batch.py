"""The compiled executor: the same motions as `solve` gives, the same statuses, and what a sweep refuses."""

import dataclasses

import numpy as np
import pytest
from processes import printed, python

from ilmek.errors import MechanismError
from ilmek.linkage.batch import batch_arrays, solve_batch, sweep
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.kernels import BLOCK
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.num.sincos import sincos

BEAT_UP = plan(four_bar(0.300, 0.0597, 0.2007, 0.2308, branch=+1, points={"rocker": {"E": 0.3 + 0.1j}}))
SAMPLES = 5 * BLOCK + 7
TIME = np.linspace(0.0, 9.0, SAMPLES)


def gantry() -> Mechanism:
    """A driven slide carries a driven crank turned by its carrier's side; a rod leads a slider on a moving guide.

    A second dyad of two links hangs on the slider and the crank, off their axes.
    """
    return Mechanism(
        bodies=(
            Body(GROUND, {"x": 0.1j}),
            Body("carriage", {"x": 0.02, "hub": 0.1, "line": -0.3 + 0.05j}),
            Body("crank", {"hub": 0.01j, "A": 0.1, "D": 0.06 + 0.03j}),
            Body("rod", {"A": -0.01, "B": 0.5 + 0.02j}),
            Body("block", {"B": 0.03j, "line": 0.01, "E": 0.1 + 0.1j}),
            Body("one", {"D": 0.0, "F": 0.7j}),
            Body("two", {"E": 0.1, "F": 0.9}),
        ),
        joints=(
            Slide("x", "carriage", GROUND, 0.3, 0.2),
            Pin("hub", "crank", "carriage"),
            Pin("A", "crank", "rod"),
            Pin("B", "rod", "block"),
            Slide("line", "block", "carriage", 0.4, -0.7),
            Pin("D", "one", "crank"),
            Pin("E", "two", "block"),
            Pin("F", "one", "two"),
        ),
        inputs=(Displacement("x"), Rotation("carriage", "hub")),
        branches={"B": +1, "F": -1},
    )


def two_motors() -> Mechanism:
    """Two driven cranks on the ground and the two links between them."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "Q": 0.4}),
            Body("left", {"O": 0, "A": 0.15}),
            Body("right", {"Q": 0, "B": 0.1}),
            Body("one", {"A": 0, "C": 0.5}),
            Body("two", {"B": 0, "C": 0.45j, "tool": 0.1 + 0.6j}),
        ),
        joints=(
            Pin("O", GROUND, "left"),
            Pin("Q", GROUND, "right"),
            Pin("A", "left", "one"),
            Pin("B", "right", "two"),
            Pin("C", "one", "two"),
        ),
        inputs=(Rotation("left", "O"), Rotation("right", "Q")),
        branches={"C": +1},
    )


def press(guided_by_lever: bool = True) -> Mechanism:
    """A block on the crank's pin leads a lever (RPR); sliders on lever and ground cross (PRP); a cross slide (RPP).

    The last is attached to the ground slider and slides on the crank. All lines are offset and turned.
    """
    lever = ("slot", "lever", "block") if guided_by_lever else ("slot", "block", "lever")
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "B": -3 + 0.2j, "u": 0.1 + 0.1j}),
            Body("crank", {"O": 0, "A": 1, "v": 0.2j}),
            Body("block", {"A": 0.1j, "slot": 0.1}),
            Body("lever", {"B": 0.05, "slot": 0.1j, "t": 0.3}),
            Body("on_lever", {"t": 0.1, "C": 0.2j}),
            Body("on_ground", {"C": 0.1, "u": 0.2, "D": 0.3 + 0.1j}),
            Body("middle", {"v": 0.1, "w": 0.2j}),
            Body("out", {"w": 0.05, "D": 0.3j}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide(*lever, 0.2, -0.3),
            Pin("B", GROUND, "lever"),
            Slide("t", "on_lever", "lever", 0.4, 0.1),
            Pin("C", "on_lever", "on_ground"),
            Slide("u", "on_ground", GROUND, 2.0, 0.5),
            Slide("v", "middle", "crank", 0.3, 0.6),
            Slide("w", "middle", "out", 1.1, -0.2),
            Pin("D", "out", "on_ground"),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"slot": +1},
    )


MOVED = {
    "RPR, PRP, RPP": (plan(press()), TIME),
    "RPR of the other guide": (plan(press(guided_by_lever=False)), TIME),
    "RRR": (BEAT_UP, TIME),
    "RRP": (plan(slider_crank(0.1, 0.3, offset=0.04, branch=-1)), TIME),
    "driven bodies and dyads on moving ones": (plan(gantry()), {"x": 0.1 * np.sin(TIME), "carriage": -TIME}),
    "two inputs": (plan(two_motors()), {"left": TIME, "right": 1 - 2 * TIME}),
}


def apart(ours: Motion, theirs: Motion) -> float:
    """The worst difference of any body's motion, of the field's largest value."""
    worst = 0.0
    for body in ours.plan.mechanism.moving:
        for field in ("position", "direction", "omega", "alpha", "velocity", "acceleration"):
            one, other = (getattr(motion[body], field) for motion in (ours, theirs))
            worst = max(worst, float(np.abs(one - other).max()) / max(1.0, float(np.abs(other).max())))
    return worst


@pytest.mark.parametrize("moved", MOVED, ids=str)
@pytest.mark.parametrize("steady", [True, False])
def test_both_executors_agree(moved, steady):
    moving, course = MOVED[moved]
    names = course if isinstance(course, dict) else [entry.name for entry in moving.mechanism.inputs]
    speed, acceleration = (3.0, 0.0) if steady else (3 + np.sin(TIME), np.cos(TIME))
    rates = dict.fromkeys(names, speed), dict.fromkeys(names, acceleration)
    theirs = solve(moving, course, *rates).require()
    ours = solve_batch(moving, course, *rates)
    assert apart(ours, theirs) <= 1e-13
    assert ours.drives.keys() == theirs.drives.keys()


@pytest.mark.parametrize("samples", [1, BLOCK - 1, BLOCK, BLOCK + 1])
def test_any_number_of_samples(samples):
    angle = np.linspace(0.0, 3.0, samples)
    assert apart(solve_batch(BEAT_UP, angle, 1.0), solve(BEAT_UP, angle, 1.0)) <= 1e-13


def test_arrays_can_be_used_again():
    short = plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1))
    arrays = batch_arrays(BEAT_UP, SAMPLES)
    for planned, speed in ((short, 2.0), (BEAT_UP, 1.0)):
        ours, theirs = solve_batch(planned, TIME, speed, into=arrays), solve(planned, TIME, speed)
        np.testing.assert_array_equal(ours.status, theirs.status)
        good = ours.status == Status.OK
        np.testing.assert_allclose(ours.alpha("rocker")[good], theirs.alpha("rocker")[good], rtol=1e-9, atol=1e-12)
        assert np.shares_memory(ours.omega("rocker"), arrays.reals)
    with pytest.raises(MechanismError, match="arrays belong to another plan or number of samples"):
        solve_batch(BEAT_UP, TIME[1:], into=arrays)


def swinging_block(pivot: float, offset: float) -> Mechanism:
    """A lever on `pivot` led by a block on the crank's pin, which comes to the pivot."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "B": pivot}),
            Body("crank", {"O": 0, "A": 0.3}),
            Body("block", {"A": 0, "s": 0}),
            Body("lever", {"B": 0, "s": 1j * offset}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("s", "block", "lever"),
            Pin("B", GROUND, "lever"),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"s": +1},
    )


def square() -> Mechanism:
    """Two sliders pinned to one another on a line of the crank and one of the ground, parallel at 0 and pi."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "g": 0.3j}),
            Body("crank", {"O": 0, "c": 0.1j}),
            Body("one", {"c": 0, "C": 0}),
            Body("two", {"g": 0, "C": 0}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Slide("c", "one", "crank"),
            Pin("C", "one", "two"),
            Slide("g", "two", GROUND),
        ),
        inputs=(Rotation("crank", "O"),),
    )


NEAR = 3 * 10.0 ** -np.arange(2.0, 16.0)


@pytest.mark.parametrize(
    "near",
    [
        four_bar(0.3, 0.1, 0.3, 0.1, branch=+1),
        four_bar(0.3, 0.2, 0.2, 0.23, branch=-1),
        slider_crank(0.3, 0.2, branch=1),
        swinging_block(0.3, offset=0.1),
        swinging_block(0.3, offset=0.0),
        square(),
    ],
    ids=["parallel four-bar", "four-bar that cannot turn", "rod too short", "pins too near", "through the pin", "PRP"],
)
def test_statuses_agree_across_and_beside_dead_centres(near):
    limit = np.arccos((0.3**2 + 0.2**2 - 0.43**2) / (2 * 0.3 * 0.2))
    places = [0.0, np.pi / 2, np.pi, 2.0, limit, np.arcsin(0.2 / 0.3)]
    angle = np.concatenate([places, *(place + sign * NEAR for place in places for sign in (-1, 1))])
    theirs, ours = solve(plan(near), angle, 1.0), solve_batch(plan(near), angle, 1.0)
    assert (ours.status == theirs.status).all()
    assert len(set(theirs.status)) > 1


def test_a_fault_is_said_as_by_solve():
    short = plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1, name="beat-up"))
    with pytest.raises(MechanismError, match=r"cannot close for crank 118\.0°..242\.0°: \|A-B0\| reaches 500 mm"):
        solve_batch(short, np.radians(np.arange(0.0, 360.0, 1.0))).require()


def test_other_groups_are_left_to_solve():
    by_newton = plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1), closed_forms=False)
    assert solve_batch(by_newton, 0.0).status[0] == Status.NOT_CONVERGED  # no pose is given
    with pytest.raises(MechanismError, match="not among the compiled groups"):
        sweep(by_newton, {}, 0.0)


def test_a_sweep_gives_every_variant_its_own_motion():
    rockers, branches = np.array([0.22, 0.23, 0.24]), np.array([1, -1, 1])
    swept = sweep(
        BEAT_UP,
        {("rocker", "B"): rockers, ("rocker", "E"): 0.2},
        TIME,
        2.0,
        1.0,
        branches={"B": branches},
        bodies=["coupler", "rocker"],
        points=[("rocker", "E"), ("coupler", "B"), (GROUND, "B0")],
    )
    for k, (rocker, branch) in enumerate(zip(rockers, branches, strict=True)):
        alone = four_bar(0.3, 0.0597, 0.2007, float(rocker), branch=int(branch), points={"rocker": {"E": 0.2}})
        motion = solve(plan(alone), TIME, 2.0, 1.0)
        for (body, point), moved in swept.points.items():
            for field in ("position", "velocity", "acceleration"):
                np.testing.assert_allclose(
                    getattr(moved, field)[k], getattr(motion.point(body, point), field), rtol=1e-12, atol=1e-13
                )
        for body, turning in swept.bodies.items():
            for field in ("direction", "omega", "alpha"):
                np.testing.assert_allclose(
                    getattr(turning, field)[k], getattr(motion, field)(body), rtol=1e-12, atol=1e-13
                )
        sine = (motion.direction("coupler") * np.conj(motion.direction("rocker"))).imag
        assert swept.margin[k] == pytest.approx(np.abs(sine).min(), rel=1e-12)


@pytest.mark.parametrize("mechanism", [gantry(), press()], ids=["RRR, RRP", "RPR, PRP, RPP"])
def test_every_point_may_vary(mechanism):
    rng = np.random.default_rng(3)
    places = {
        (body.name, point): place + 0.02 * (rng.uniform(-1, 1, 4) + 1j * rng.uniform(-1, 1, 4))
        for body in mechanism.bodies
        for point, place in body.points.items()
    }
    course = {entry.name: 0.1 * TIME for entry in mechanism.inputs}
    swept = sweep(plan(mechanism), places, course, dict.fromkeys(course, 1.0), points=list(places))
    for k in range(4):
        bodies = tuple(
            Body(body.name, {point: complex(places[body.name, point][k]) for point in body.points})
            for body in mechanism.bodies
        )
        motion = solve(
            plan(dataclasses.replace(mechanism, bodies=bodies)), course, dict.fromkeys(course, 1.0)
        ).require()
        for (body, point), moved in swept.points.items():
            for field in ("position", "velocity", "acceleration"):
                theirs = getattr(motion.point(body, point), field)
                assert np.abs(getattr(moved, field)[k] - theirs).max() <= 1e-13 * max(1.0, np.abs(theirs).max())


def test_variants_that_cannot_close_are_told_apart():
    crank = np.array([0.06, 0.2])
    swept = sweep(BEAT_UP, {("crank", "A"): crank}, np.linspace(0, 2 * np.pi, 91), points=[("rocker", "B")])
    assert (swept.status[0] == Status.OK).all()
    lost = swept.status[1] == Status.CANNOT_CLOSE
    assert lost.any()
    assert np.isnan(swept.points["rocker", "B"].position[1, lost]).all()
    assert np.isfinite(swept.points["rocker", "B"].position[1, ~lost]).all()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (dict(dimensions={("rocker", "F"): 0.2}), "no point 'F'"),
        (dict(dimensions={("rokcer", "B"): 0.2}), "did you mean 'rocker'"),
        (dict(dimensions={("rocker", "B"): np.array([0.2, np.nan])}), "not finite in every variant"),
        (dict(dimensions={("rocker", "B"): np.array([0.2, 0.0])}), "'rocker' of four-bar has zero length"),
        (dict(dimensions={("crank", "A"): np.ones(2), ("rocker", "B"): np.ones(3)}), r"shapes \(2,\) and \(3,\)"),
        (dict(dimensions={("crank", "A"): np.ones((2, 2))}), r"shapes \(2, 2\)"),
        (dict(branches={"B": np.array([1, 0])}), "branch of 'B' is not"),
        (dict(branches={"X": 1}), "no joint 'X'"),
        (dict(bodies=["rodent"]), "no body 'rodent'"),
        (dict(points=[("rocker", "F")]), "no point 'F'"),
        (dict(angle=np.array([np.nan])), "not finite everywhere"),
        (dict(angle={"rocker": 0.0}), "unknown input 'rocker'"),
    ],
)
def test_a_sweep_refuses(given, said):
    with pytest.raises(MechanismError, match=said):
        sweep(BEAT_UP, **({"dimensions": {}, "angle": 0.0} | given))


def test_the_compiler_is_imported_by_the_batch_module_alone():
    script = "import sys, ilmek.linkage.solve, ilmek.linkage.fourbar; print('numba' in sys.modules)"
    assert printed(python("-c", script)) == "False\n"


def test_sine_and_cosine_are_right_to_the_last_digits():
    x = np.concatenate([np.linspace(-1e4, 1e4, 400_001), np.arange(-500, 500) * (np.pi / 4), [0.0, 1e-300]])
    sine, cosine = sincos(x)
    assert np.abs(sine - np.sin(x)).max() <= 2.3e-16
    assert np.abs(cosine - np.cos(x)).max() <= 2.3e-16
    assert sincos(-0.3)[0] == -sincos(0.3)[0]
    far = np.linspace(-1e6, 1e6, 100_001)
    assert np.abs(sincos(far)[0] - np.sin(far)).max() <= 1e-15
