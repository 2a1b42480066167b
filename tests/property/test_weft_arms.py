"""The arms of the tube behind the shuttle's bar: stress and deflection against the moment integrated along an arm."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.columns import HollowSquare
from ilmek.machines.automated_loom.supports import TubeLoads
from ilmek.units import mm

FORCES, REACHES = st.floats(0.0, 5000.0), st.floats(50 * mm, 600 * mm)


@given(FORCES, FORCES, REACHES, st.sampled_from([(40 * mm, 3 * mm), (60 * mm, 4 * mm), (100 * mm, 5 * mm)]))
def test_an_arm_bends_as_its_moment_integrated_twice(
    weight: float, inertia: float, reach: float, size: tuple[float, float]
) -> None:
    section, span = HollowSquare(*size), 1.5
    loads = TubeLoads(span, 60.0, 0.0, reach + section.side / 2, weight, inertia)
    _, stress, sag = loads.checks(section)
    side, wall = size
    hollow = side - 2 * wall
    upright = (side**4 - hollow**4) / 12
    mass = (side**2 - hollow**2) * 7850.0 * span
    along = np.linspace(0.0, reach, 4001)
    bent = []
    for force in ((weight + mass * 9.80665) / 2, inertia / 2):
        moment = force * (reach - along)
        slope = np.concatenate([[0.0], np.cumsum((moment[1:] + moment[:-1]) / 2 * np.diff(along))]) / (210e9 * upright)
        bent.append((moment[0] * side / 2 / upright, float(np.trapezoid(slope, along))))
    expected = np.hypot(*np.array(bent))
    assert stress.value == pytest.approx(expected[0], rel=1e-3)
    assert sag.value == pytest.approx(expected[1], rel=0.01)


def test_a_weft_side_that_is_too_heavy_fails() -> None:
    loads = TubeLoads(1.5, 60.0, 0.0, 0.5, 40e3, 0.0)
    assert not any(check.ok for check in loads.checks(HollowSquare(40 * mm, 3 * mm))[1:])


def test_a_tube_at_the_columns_has_no_arms() -> None:
    loads = TubeLoads(1.5, 60.0, 0.1, 0.1, 100.0, 10.0)
    assert [check.value for check in loads.checks(HollowSquare(40 * mm, 3 * mm))[1:]] == [0.0, 0.0]
