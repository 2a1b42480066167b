"""Warps pushed aside: contact and forces against brute force, strings whose energy is made least numerically."""

import numpy as np
import pytest
from scipy.optimize import minimize

from ilmek.weaving.warp_opening import WarpSpans, force_of, shifts, tension_of, wall_force

WARP = WarpSpans(tension=15.0, stiffness=1350.0, length=1.5, front=0.06, back=0.11)


def energy(shift: np.ndarray, warp: WarpSpans) -> np.ndarray:
    """Energy of strings [J], each of two straight parts."""
    longer = np.sqrt(warp.front**2 + shift**2) - warp.front + np.sqrt(warp.back**2 + shift**2) - warp.back
    return warp.tension * longer + warp.stiffness * longer**2 / (2 * warp.length)


@pytest.mark.parametrize(("aside", "pitch", "diameter"), [(5e-3, 2e-3, 0.95e-3), (2e-3, 1e-3, 0.6e-3)])
def test_the_warps_stand_where_their_energy_is_least(aside: float, pitch: float, diameter: float) -> None:
    """Brute force: 12 strings beside a wall, none nearer to the next than a diameter; energy by numerical search."""
    number, scale = 12, 1e-3
    contacts = [{"type": "ineq", "fun": lambda x: x[0] - aside / scale}]
    gap = (pitch - diameter) / scale
    contacts += [{"type": "ineq", "fun": lambda x, k=k: x[k + 1] - x[k] + gap} for k in range(number - 1)]
    start = np.full(number, aside / scale)
    found = minimize(
        lambda x: float(energy(x * scale, WARP).sum()) * 1e3,
        start,
        constraints=contacts,
        method="SLSQP",
        options={"ftol": 1e-13, "maxiter": 500},
    )
    moved = shifts(aside, pitch, diameter)
    assert len(moved) == np.ceil(aside / (pitch - diameter))
    assert found.x[: len(moved)] * scale == pytest.approx(moved, abs=2e-6)
    assert found.x[len(moved) :] * scale == pytest.approx(0.0, abs=2e-6)


@pytest.mark.parametrize("aside", [0.3e-3, 4e-3, 14e-3])
def test_the_force_on_the_wall_is_the_slope_of_the_energy(aside: float) -> None:
    """By central differences, within the same number of displaced warps."""
    step = 1e-7

    def total(at: float) -> float:
        return float(energy(shifts(at, 2e-3, 0.95e-3), WARP).sum())

    slope = (total(aside + step) - total(aside - step)) / (2 * step)
    assert wall_force(aside, 2e-3, 0.95e-3, WARP) == pytest.approx(slope, rel=1e-6)


def test_a_string_of_many_links_pulls_as_the_closed_form() -> None:
    """Brute force: a chain of 170 stiff springs, its middle displaced, relaxed by Newton's method."""
    shift, number = 5e-3, 170
    length = (WARP.front + WARP.back) / number
    held = round(WARP.front / length)
    y = np.concatenate([np.linspace(0, shift, held + 1), np.linspace(shift, 0, number - held + 1)[1:]])
    slope = np.diff(y) / length
    longer = float(np.sum(np.hypot(length, length * slope) - length))
    pull = WARP.tension + WARP.stiffness * longer / WARP.length
    up = pull * (slope[held - 1] / np.hypot(1, slope[held - 1]) - slope[held] / np.hypot(1, slope[held]))
    assert float(force_of(np.array(shift), WARP)) == pytest.approx(up, rel=1e-9)
    assert float(tension_of(np.array(shift), WARP)) == pytest.approx(pull, rel=1e-9)


def test_edges() -> None:
    assert len(shifts(0.0, 2e-3, 1e-3)) == len(shifts(-1e-3, 2e-3, 1e-3)) == 0
    assert wall_force(0.0, 2e-3, 1e-3, WARP) == 0.0
    touching = shifts(1e-3, 1e-3, 1e-3)
    assert (touching == 1e-3).all()
    assert len(touching) > 1000
