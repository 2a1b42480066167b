"""Hertz' pressure: printed numbers, closed forms of sphere and cylinders, and his equations by another quadrature."""

import math

import numpy as np
import pytest
from scipy import special

from ilmek.cams.hertz import contact_modulus, ellipse_contact, line_contact

STEEL = contact_modulus(206e9, 0.3, 206e9, 0.3)
LINE = 1000 / 0.015


@pytest.mark.parametrize(("cam", "width", "pressure"), [(40e-3, 0.0832014, 510.1036), (-40e-3, 0.113384, 374.3137)])
def test_roller_of_12_mm_on_a_cam_of_40_mm(cam, width, pressure) -> None:
    line = line_contact(LINE, 1 / 12e-3 + 1 / cam, STEEL)
    assert line.half_width * 1e3 == pytest.approx(width, abs=6e-7)
    assert line.pressure * 1e-6 == pytest.approx(pressure, abs=6e-5)


def test_sphere_on_a_plane() -> None:
    force, radius = 250.0, 8e-3
    found = ellipse_contact(force, 1 / radius, 1 / radius, STEEL)
    a = (3 * force * radius / (4 * STEEL)) ** (1 / 3)
    assert found.narrow == pytest.approx(a, rel=1e-13)
    assert found.wide == pytest.approx(a, rel=1e-13)
    assert found.pressure == pytest.approx((6 * force * STEEL**2 / (math.pi**3 * radius**2)) ** (1 / 3), rel=1e-13)


def test_equal_crossed_cylinders_touch_as_a_sphere_on_a_plane() -> None:
    crossed = ellipse_contact(250.0, 1 / 8e-3 + 0.0, 0.0 + 1 / 8e-3, STEEL)
    assert crossed.pressure == pytest.approx(ellipse_contact(250.0, 125.0, 125.0, STEEL).pressure, rel=1e-15)


@pytest.mark.parametrize("ratio", [1.0001, 1.7, 12.0, 900.0, 4e5])
def test_ellipse_solves_the_equations_of_hertz(ratio) -> None:
    flat = 3.0
    found = ellipse_contact(700.0, flat * ratio, flat, STEEL)
    slim = float(found.narrow / found.wide)
    first, second = special.ellipkm1(slim**2), special.ellipe(1 - slim**2)
    assert (second / slim**2 - first) / (first - second) == pytest.approx(ratio, rel=1e-9 if ratio > 1.01 else 1e-6)
    a, e2 = float(found.wide), 1 - slim**2
    sharpest = 2 * found.pressure * slim / (STEEL * a * e2) * (second / slim**2 - first)
    assert sharpest == pytest.approx(flat * ratio, rel=1e-9 if ratio > 1.01 else 1e-6)


def test_long_ellipse_is_nearly_a_line() -> None:
    """Johnson 4.2: in the middle of a long ellipse the line of the load there, 3 F / (4 a)."""
    found = ellipse_contact(700.0, 1e5, 1e-3, STEEL)
    line = line_contact(0.75 * 700.0 / found.wide, 1e5, STEEL)
    assert found.pressure == pytest.approx(line.pressure, rel=1e-5)


def test_nothing_presses_or_nothing_touches() -> None:
    assert line_contact(-5.0, 20.0, STEEL).pressure == 0
    assert ellipse_contact(0.0, 20.0, 30.0, STEEL).pressure == 0
    assert np.isnan(line_contact(LINE, -1.0, STEEL).pressure)
    assert np.isnan(ellipse_contact(5.0, 20.0, -1.0, STEEL).pressure)
    assert ellipse_contact(np.full((2, 3), 5.0), 20.0, np.full(3, 2.0), STEEL).wide.shape == (2, 3)
