"""Joint forces of single mechanisms, by hand; failing samples, long batches, wrong names."""

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity, Torque
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import four_bar, slider_crank
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan

ANGLES = np.arange(128) * (2 * np.pi / 128)


def crank_of(radius: float, rod: float) -> tuple[Motion, np.ndarray, np.ndarray]:
    """A slider-crank turning at 10 rad/s, with sine of the rod's angle and the slider's acceleration by hand."""
    motion = solve(plan(slider_crank(radius, rod, branch=+1)), ANGLES, 10.0)
    sine = -radius * np.sin(ANGLES) / rod
    cosine = np.sqrt(1 - sine**2)
    turning = -radius * np.cos(ANGLES) * 10.0 / (rod * cosine)
    spinning = (radius * np.sin(ANGLES) * 100.0 / rod + turning**2 * sine) / cosine
    along = -radius * np.cos(ANGLES) * 100.0 - rod * (spinning * sine + turning**2 * cosine)
    return motion, sine / cosine, along


def test_slider_crank_by_hand() -> None:
    motion, tangent, acceleration = crank_of(0.1, 0.3)
    forces = inverse(motion, {"slider": Inertia(2.0, 0j, 0.01)})
    # The massless rod pushes along itself: its force on the slider is 2 kg · a in x, and tangent times that in y.
    np.testing.assert_allclose(forces.pin("B"), 2.0 * acceleration * (1 + 1j * tangent), atol=1e-10)
    np.testing.assert_allclose(forces.pin("line"), -2j * acceleration * tangent, atol=1e-10)
    np.testing.assert_allclose(forces.couples["line"], 0.0, atol=1e-10)
    np.testing.assert_array_equal(forces.pin("B", on="rod"), -forces.pin("B", on="slider"))


def test_a_couple_holds_a_slider_whose_weight_hangs_beside_its_pin() -> None:
    motion = solve(plan(slider_crank(0.1, 0.3, branch=+1)), ANGLES)
    forces = inverse(motion, {"slider": Inertia(2.0, 0.05 + 0j, 0.01)}, (Gravity(-10j),))
    np.testing.assert_allclose(forces.couples["line"], 2.0 * 10.0 * 0.05, rtol=1e-12)
    np.testing.assert_allclose(forces.pin("line"), 20j, atol=1e-12)


def test_a_driven_slide_pushes_along_its_line() -> None:
    mechanism = Mechanism(
        bodies=(Body(GROUND, {"line": 0}), Body("slider", {"line": 0})),
        joints=(Slide("line", "slider", GROUND, along=np.pi / 6),),
        inputs=(Displacement("line"),),
    )
    motion = solve(plan(mechanism), np.linspace(0, 1, 5), 2.0, 3.0)
    forces = inverse(motion, {"slider": Inertia(4.0, 0j, 1.0)}, (Gravity(-10j),))
    np.testing.assert_allclose(forces.effort("line"), 4.0 * 3.0 + 4.0 * 10.0 * np.sin(np.pi / 6))
    np.testing.assert_allclose(np.abs(forces.pin("line")), 4.0 * 10.0 * np.cos(np.pi / 6))
    assert forces.power_error < 1e-14


def test_statics_of_a_torque_on_the_driven_crank() -> None:
    mechanism = four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)
    forces = inverse(solve(plan(mechanism), ANGLES), {}, (Torque("crank", 5.0),))
    np.testing.assert_allclose(forces.effort("crank"), -5.0)
    np.testing.assert_allclose(np.abs(forces.pin("B")), 0.0, atol=1e-12)


def test_samples_that_do_not_close_are_nan_and_leave_the_others_alone() -> None:
    motion = solve(plan(four_bar(0.3, 0.2, 0.2, 0.15, branch=+1)), np.radians([0.0, 60.0, 180.0]), 1.0)
    forces = inverse(motion, {"rocker": Inertia(1.0, 0.1 + 0j, 0.01)})
    assert np.isnan(forces.effort("crank")).tolist() == (motion.status != 0).tolist()
    assert np.isnan(forces.effort("crank")).sum() in (1, 2)
    assert np.isfinite(forces.pin("A")[motion.status == 0]).all()
    assert forces.power_error < 1e-12


def test_long_batches_are_solved_in_blocks() -> None:
    mechanism = plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1))
    bodies = {"rocker": Inertia(1.0, 0.1 + 0j, 0.01)}
    angles = np.linspace(0, 2 * np.pi, 9001)
    torque = inverse(solve(mechanism, angles, 10.0), bodies).effort("crank")
    few = inverse(solve(mechanism, angles[::1000], 10.0), bodies).effort("crank")
    np.testing.assert_allclose(torque[::1000], few, rtol=1e-12, atol=1e-12)


def test_names_that_do_not_exist_are_refused() -> None:
    motion = solve(plan(four_bar(0.3, 0.06, 0.2, 0.23, branch=+1)), ANGLES, 1.0)
    with pytest.raises(MechanismError, match="no body 'rokcer'"):
        inverse(motion, {"rokcer": Inertia(1.0, 0j, 0.1)})
    forces = inverse(motion, {})
    with pytest.raises(MechanismError, match="one of crank"):
        forces.effort("rocker")
    with pytest.raises(MechanismError, match="one of crank, coupler"):
        forces.pin("A", on="rocker")


def test_at_a_dead_centre_forces_are_nan_and_beside_it_they_are_not() -> None:
    folds = plan(four_bar(0.3, 0.1, 0.3, 0.1, branch=+1))
    motion = solve(folds, np.array([0.0, 0.1, np.pi / 2]), 1.0)
    forces = inverse(motion, {"rocker": Inertia(1.0, 0.1 + 0j, 0.01)})
    assert [Status(one) for one in motion.status] == [Status.DEAD_CENTRE, Status.OK, Status.OK]
    assert np.isnan(forces.pin("B")).tolist() == [True, False, False]
    assert np.isnan(forces.effort("crank")).tolist() == [True, False, False]
