"""Worm reducers: their sizes, and how they hang on shafts."""

from itertools import pairwise

import numpy as np
import pytest

from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.elements.parallel_keys import keyed_end
from ilmek.elements.reducers import SINGLE, WORM_SIZES, Reducer, worm_for
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.shaft_stand import HOLDER
from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.machines.warp_tension.tree import IN_LOOM, stand, tree
from ilmek.part.catalogue import motor
from ilmek.part.placement import placement
from ilmek.part.shapes import shape_box
from ilmek.part.tree import Tree
from ilmek.part.worm_reducer import eye, eye_face, eye_radius, inlet, journal, motor_in, reducer_position, worm_reducer


def test_sizes_grow_together() -> None:
    for smaller, larger in pairwise(WORM_SIZES):
        for name in ("centre", "torque", "single", "bore", "length", "motor", "half", "top", "cover", "mass"):
            assert getattr(smaller, name) < getattr(larger, name), name
    for row in WORM_SIZES:
        assert row.single < row.torque
        assert row.centre < row.top  # the worm is in the housing
        assert 2 * row.cover < row.length < 2 * (row.cover + row.half)
        assert row.circle > row.pilot + SOCKET_SCREWS[row.thread].diameter
        assert row.bore < row.pilot
        assert row.arm > row.half + eye_radius(row)  # the eye is beside the housing


@pytest.mark.parametrize("torque", [50.0, 700.0, 758.0, 2000.0, 7000.0])
@pytest.mark.parametrize("ratio", [50.0, 100.0, 150.0])
def test_the_smallest_that_holds(torque: float, ratio: float) -> None:
    row = worm_for(torque, ratio)
    assert row.holds(ratio) >= torque
    assert all(other.holds(ratio) < torque for other in WORM_SIZES if other.centre < row.centre)


@pytest.mark.parametrize("ratio", [SINGLE, 150.0])
@pytest.mark.parametrize("arm", [1, 1j, -1, -1j, np.exp(0.3j)])
def test_the_hollow_shaft_is_on_the_shaft_and_the_motor_across(ratio: float, arm: complex) -> None:
    """By points of the part's own axes, carried by its position."""
    row = WORM_SIZES[4]
    long = inlet(row, ratio, None)
    lies = reducer_position(row, long, 0.7, complex(arm))
    axis = lies.points(np.array([[-0.1, -row.centre, long], [0.1, -row.centre, long]]))
    assert axis == pytest.approx(np.array([[0, 0, 0.6], [0, 0, 0.8]]), abs=1e-12)
    worm = lies.rotation[:, 2]
    assert worm[2] == pytest.approx(0.0, abs=1e-12)
    nearest = np.cross(np.cross(worm, lies.origin - np.array([0, 0, 0.7])), worm)  # of the worm's axis from the shaft
    assert np.linalg.norm(nearest) == pytest.approx(row.centre)
    held = lies.points(np.array([[eye_face(row), -row.centre - row.arm, long]]))[0]
    assert held == pytest.approx(eye(row, 0.7, complex(arm)).origin)
    shaft = lies.after(motor_in(row, ratio, None)).rotation[:, 2]
    assert abs(shaft @ np.array([0, 0, 1.0])) == pytest.approx(float(ratio > SINGLE), abs=1e-12)
    assert held[:2] == pytest.approx([row.arm * arm.real, row.arm * arm.imag])


@pytest.mark.parametrize("row", WORM_SIZES, ids=lambda row: row.name)
def test_its_room_is_that_of_the_catalogue(row: object) -> None:
    end = keyed_end(row.bore, 0.3 * row.single, 370e6)  # type: ignore[attr-defined]
    part = worm_reducer("reducer", "reducer", Reducer(100.0, 0.45), row, None, end)  # type: ignore[arg-type]
    low, high = shape_box(part.shape)  # type: ignore[arg-type]
    assert high[0] - low[0] >= row.length - 1e-9  # type: ignore[attr-defined]
    assert low[1] == pytest.approx(-row.centre - row.arm - eye_radius(row) - 0.005)  # type: ignore[arg-type, attr-defined]
    assert high[2] == pytest.approx(row.motor + row.half)  # type: ignore[attr-defined]
    assert low[2] == pytest.approx(0.0)


def _turned(made: Tree, ending: str) -> list[np.ndarray]:
    bodies = {body.id: body for body in made.bodies}
    return [
        bodies[name].positions[0].after(own.positions[0]).rotation[:, 2]
        for name in bodies
        for own in bodies[name].occurrences
        if own.part.id.endswith(ending)
    ]


@pytest.mark.parametrize("in_loom", [False, True])
def test_motors_stand_across_their_cylinders(in_loom: bool) -> None:
    machine = MACHINES["warp-tension"]
    design = machine.designed(machine.params.read({}))
    positions = {own.name: placement(y=-k) for k, own in enumerate(cylinders(design))}
    made = tree(design, positions, IN_LOOM) if in_loom else tree(design)
    motors = _turned(made, "/motor")
    assert len(motors) == 3
    assert all(abs(axis[2]) < 1e-12 for axis in motors)
    (shaft,) = {
        own.part.id for body in made.bodies for own in body.occurrences if own.part.id.endswith("upper-driven-end")
    }
    part = next(part for part, _ in made.occurrences() if part.id == shaft)
    row = design.worm(cylinders(design)[0].bearing.bore)
    plain = design.params.stub + cylinders(design)[0].seat.journal
    spigot = cylinders(design)[0].spigot[1]
    low, high = shape_box(part.shape)  # type: ignore[arg-type]
    assert high[2] - low[2] == pytest.approx(spigot + plain + journal(row))


def test_the_stand_holds_the_arms_where_their_eyes_are() -> None:
    machine = MACHINES["warp-tension"]
    design = machine.designed(machine.params.read({}))
    (frame,) = stand(design).bodies
    holders = [own for own in frame.occurrences if own.part.id.endswith("-arm-holder")]
    assert len(holders) == 3
    row = design.worm(cylinders(design)[0].bearing.bore)
    for own in holders:
        low, high = shape_box(own.part.shape)  # type: ignore[arg-type]
        ends = own.positions[0].points(np.array([[0, 0, low[2]], [0, 0, high[2]]]))
        assert ends[:, 0] == pytest.approx(-row.arm)
        assert high[0] - low[0] == pytest.approx(HOLDER)


def test_a_motor_shares_the_flange() -> None:
    own = motor("motor", "motor", None, 5.0, 10.0)
    end = keyed_end(0.045, 700.0, 370e6)
    geared = worm_reducer("reducer", "reducer", Reducer(100.0, 0.45), WORM_SIZES[4], None, end)
    assert own.purchase is not None
    assert geared.purchase is not None
    assert geared.purchase.holes[1].across == own.purchase.holes[0].across
    assert geared.purchase.row == "worm reducer 100:1"
