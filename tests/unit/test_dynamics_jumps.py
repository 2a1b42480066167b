"""Windows, friction and curves that jump."""

import numpy as np
import pytest

from ilmek.arrays import FloatArray
from ilmek.dynamics.friction import AngleRange, Friction
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import inverse
from ilmek.errors import MechanismError
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.num.piecewise import around, integrals, roots_of_turn, suprema
from ilmek.units import deg, turn

BREAKS = (1.0, 4.0)


def saw(angle: FloatArray, side: FloatArray) -> dict[str, FloatArray]:
    """Up from 0 to 3 between the breaks, elsewhere from -1 upward; and a smooth curve beside it."""
    inside = AngleRange(*BREAKS).contains(angle + 1e-9 * side)
    after = np.mod(angle - 4.0 + 1e-7, turn) - 1e-7
    return {"saw": np.where(inside, angle - 1.0, -1.0 + 0.1 * after), "smooth": np.cos(angle - 2.0)}


def test_a_supremum_that_is_not_reached_is_the_limit_at_the_break() -> None:
    found = suprema(saw, around(BREAKS))
    assert (found["saw"].value, found["saw"].at, found["saw"].side) == pytest.approx((3.0, 4.0, -1), abs=1e-12)
    assert (found["smooth"].value, found["smooth"].at) == pytest.approx((1.0, 2.0), abs=1e-6)
    assert found["smooth"].side == 0


def test_falling_to_the_break_the_limit_is_from_above() -> None:
    falling = suprema(lambda angle, side: {"minus": -saw(angle, side)["saw"]}, around(BREAKS))["minus"]
    assert (falling.value, falling.at, falling.side) == pytest.approx((1.0, 4.0, +1), abs=1e-12)


def test_pieces_go_round_and_breaks_given_twice_count_once() -> None:
    found = around([4.0, 1.0, 1.0 + turn])
    np.testing.assert_allclose([found.starts, found.ends], [[1.0, 4.0], [4.0, 1.0 + turn]], rtol=1e-15)
    whole = around()
    assert (whole.starts.tolist(), whole.ends.tolist()) == ([0.0], [turn])


def test_integrals_are_exact_across_jumps() -> None:
    found = {name: float(np.sum(parts)) for name, parts in integrals(saw, around(BREAKS, parts=16)).items()}
    rest = turn - 3.0
    assert found["saw"] == pytest.approx(4.5 - rest + 0.05 * rest**2, rel=1e-13)
    assert found["smooth"] == pytest.approx(0.0, abs=1e-13)


def test_zeros_are_found_to_rounding_also_at_the_seam() -> None:
    np.testing.assert_allclose(
        roots_of_turn(lambda angle: np.sin(2 * (angle - 0.3))), 0.3 + np.arange(4) * np.pi / 2, atol=1e-14
    )
    np.testing.assert_allclose(np.sin(roots_of_turn(np.sin)), 0.0, atol=1e-14)
    assert roots_of_turn(lambda angle: 2 + np.sin(angle)).size == 0


@pytest.mark.parametrize(
    ("start", "end", "inside", "outside"),
    [
        (22.0, 194.0, (22, 100, 193.9, 382), (21.9, 194, 300, -1)),
        (300.0, 60.0, (300, 0, 359, 59.9), (60, 180, 299)),
        (-60.0, 60.0, (300, 0, 359, 59.9), (60, 180, 299)),
        (0.0, 360.0, (0, 100, 359.9), ()),
        (90.0, 90.0, (), (0, 90, 180)),
    ],
)
def test_windows(start: float, end: float, inside: tuple[float, ...], outside: tuple[float, ...]) -> None:
    window = AngleRange(start * deg, end * deg)
    assert window.contains(np.array(inside) * deg).all()
    assert not window.contains(np.array(outside) * deg).any()


def rubbed(angle: FloatArray, speed: float, **kinds: object) -> tuple[FloatArray, FloatArray]:
    """Force on a slider against its motion, and the drive's power less what the friction takes."""
    motion = solve(plan(slider_crank(0.1, 0.3, branch=+1)), angle, speed)
    friction = Friction("slider.B", 50.0, "crank", **kinds)  # type: ignore[arg-type]
    forces = inverse(motion, {"slider": Inertia(0.0, 0j, 0.0)}, (friction,))
    force = np.real(friction.force(motion))
    velocity = np.real(motion.point("slider", "B").velocity)
    return force, forces.input_power + force * velocity


def test_friction_opposes_the_motion_and_takes_the_power_of_the_drive() -> None:
    angle = np.linspace(0.1, 6.2, 50)
    for speed in (3.0, -3.0):
        force, missing = rubbed(angle, speed)
        np.testing.assert_allclose(force, 50.0 * np.sign(np.sin(angle)) * np.sign(speed))
        np.testing.assert_allclose(missing, 0.0, atol=1e-12)


def test_friction_has_two_values_at_a_dead_centre_and_at_the_ends_of_its_window() -> None:
    side = np.array([-1.0, 1.0])
    force, _ = rubbed(np.array([np.pi, np.pi]), 3.0, side=side)
    np.testing.assert_allclose(force, [50.0, -50.0])
    force, _ = rubbed(np.array([1.0, 1.0, 2.0, 2.0]), 3.0, side=np.tile(side, 2), window=AngleRange(1.0, 2.0))
    np.testing.assert_allclose(force, [0.0, 50.0, 50.0, 0.0])


def test_friction_at_rest_has_no_direction() -> None:
    with pytest.raises(MechanismError, match="crank does not move"):
        rubbed(np.array([1.0]), 0.0)
