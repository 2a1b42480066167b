"""Bounds of the prime radius of a plate cam whose follower dips below its rest: by hand, and by trial.

The fall s = 1 - (7 u^2 - 6 u^3) dips to 1 - 7 (7/9)^2 + 6 (7/9)^3 = -0.4115 of the lift, at u = 7/9.
"""

import math

import numpy as np
import pytest

from ilmek.cams.laws import LAWS, law_of
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.errors import ParameterError
from ilmek.units import mm

LIFT = 10 * mm
DIP = LIFT * (7 * (7 / 9) ** 2 - 6 * (7 / 9) ** 3 - 1)
OVERSHOOT = law_of("polynomial", {"start": (0, 0), "end": (1, -4.0)})
DIPPING = CamProgramme((rise(2.0, LIFT, LAWS["3-4-5"]), fall(2.0, LIFT, OVERSHOOT), dwell(TURN - 4.0)))
PLAIN = CamProgramme((rise(2.0, LIFT, LAWS["3-4-5"]), fall(2.0, LIFT, LAWS["3-4-5"]), dwell(TURN - 4.0)))
SIZES = [(0.0, 9.0), (4.0, 9.0), (-4.0, 9.0), (11.0, 9.0), (5.0, 0.0), (0.0, 0.0)]
"""Offset and roller radius [mm]."""


def by_trial(offset: float, roller_radius: float) -> float:
    """The least prime radius with which the roller's centre stays on its side of the axis, beyond its radius."""
    angle = np.linspace(0, TURN, 100_001)
    lowest = float(DIPPING.at(angle).s.min())
    low, high = abs(offset), 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        height = math.sqrt(middle**2 - offset**2) + lowest
        clear = height > 0 and math.hypot(height, offset) > roller_radius
        low, high = (low, middle) if clear else (middle, high)
    return high


@pytest.mark.parametrize(("offset", "roller_radius"), SIZES)
def test_a_dip_raises_the_lower_bound(offset: float, roller_radius: float) -> None:
    offset, roller_radius = offset * mm, roller_radius * mm
    cam = PlateCam(DIPPING, 0.1, offset, roller_radius)
    least = cam.prime_bounds[0]
    assert least == pytest.approx(by_trial(offset, roller_radius), abs=1e-9)
    assert cam.prime_bounds[1] == math.inf
    assert PlateCam(DIPPING, least * 1.000001, offset, roller_radius).prime_radius > least
    with pytest.raises(ParameterError, match="too small"):
        PlateCam(DIPPING, least * 0.999999, offset, roller_radius)


def test_the_bounds_by_hand() -> None:
    """Without an offset the roller and the dip; with a knife edge the hypotenuse of offset and dip."""
    assert abs(DIP - 4.1152263 * mm) < 1e-10
    assert PlateCam(DIPPING, 0.1, 0.0, 9 * mm).prime_bounds[0] == pytest.approx(9 * mm + DIP)
    assert PlateCam(DIPPING, 0.1, 5 * mm, 0.0).prime_bounds[0] == pytest.approx(math.hypot(5 * mm, DIP))
    assert PlateCam(DIPPING, 0.1, 4 * mm, 9 * mm).prime_bounds[0] == pytest.approx(12.81761 * mm, rel=1e-6)


@pytest.mark.parametrize(("offset", "roller_radius"), SIZES)
def test_without_a_dip_the_bound_is_the_larger_of_offset_and_roller(offset: float, roller_radius: float) -> None:
    cam = PlateCam(PLAIN, 0.1, offset * mm, roller_radius * mm)
    assert cam.prime_bounds[0] == pytest.approx(max(abs(offset), roller_radius) * mm, rel=1e-15)


def test_the_pitch_curve_keeps_clear_of_the_axis_above_the_bound() -> None:
    angle = np.linspace(0, TURN, 20_001)
    least = PlateCam(DIPPING, 0.1, 4 * mm, 9 * mm).prime_bounds[0]
    assert np.abs(PlateCam(DIPPING, 1.001 * least, 4 * mm, 9 * mm).trace(angle).pitch).min() > 9 * mm
    assert np.abs(PlateCam(DIPPING, 1.001 * least, 4 * mm, 9 * mm).trace(angle).pitch).min() < 9.1 * mm


def test_the_pressure_angle_of_a_trace_is_that_of_the_curve_by_differences() -> None:
    """Between the normal of the pitch curve, by differences of its points, and the follower's line."""
    cam = PlateCam(PLAIN, 40 * mm, 7 * mm, 9 * mm)
    angle, step = np.linspace(0.2, 1.8, 9), 1e-6
    before, after = (cam.trace(angle + sign * step).pitch * np.exp(1j * angle) for sign in (-1, 1))
    normal = 1j * (after - before)
    assert cam.trace(angle).pressure_angle == pytest.approx(np.angle(normal), abs=1e-7)
    assert cam.pressure_angle(angle) == pytest.approx(np.angle(normal), abs=1e-7)
