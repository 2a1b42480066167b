"""Inertia of bars, point masses and what is made of them."""

import numpy as np
import pytest

from ilmek.dynamics.inertia import Inertia, bar, bar_moment, combined, point_mass
from ilmek.errors import MechanismError


def test_a_bar_is_the_sum_of_its_halves() -> None:
    whole = bar(0, 0.3 + 0.1j, mass=2.0, width=0.03)
    middle = (0.3 + 0.1j) / 2
    halves = combined(bar(0, middle, mass=1.0, width=0.03), bar(middle, 0.3 + 0.1j, mass=1.0, width=0.03))
    assert halves.mass == whole.mass
    assert halves.centre == pytest.approx(whole.centre)
    assert halves.moment == pytest.approx(whole.moment)


def test_a_bar_is_the_limit_of_a_grid_of_point_masses() -> None:
    cells = (np.arange(60) + 0.5) / 60
    grid = [point_mass(1 / 3600, complex(0.3 * x, 0.1 * (y - 0.5))) for x in cells for y in cells]
    solid = combined(*grid)
    assert solid.centre == pytest.approx(0.15)
    # A grid of n cells falls short of the solid by the part 1/n².
    assert solid.moment == pytest.approx(float(bar_moment(1.0, 0.3, 0.1)) * (1 - 1 / 3600))


def test_parallel_axes() -> None:
    link = combined(bar(0, 0.3, mass=0.65), point_mass(2.5, 0.3))
    assert link.about(0j) == pytest.approx(0.65 * 0.3**2 / 3 + 2.5 * 0.3**2)
    assert min(link.about(complex(x)) for x in np.linspace(0, 0.3, 301)) >= link.moment


def test_nothing_weighs_nothing() -> None:
    assert combined() == combined(point_mass(0.0, 3j)) == Inertia(0.0, 0j, 0.0)


@pytest.mark.parametrize(("mass", "moment"), [(-1.0, 0.0), (float("nan"), 0.0), (1.0, -1e-9), (1.0, float("inf"))])
def test_refuses_what_is_no_inertia(mass: float, moment: float) -> None:
    with pytest.raises(MechanismError, match="not negative|a finite number"):
        Inertia(mass, 0j, moment)
