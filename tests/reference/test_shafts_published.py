"""Shafts against published numbers: Shigley's worked examples of fatigue, roots of the vibrating beam, whirl."""

import math

import numpy as np
import pytest

from ilmek.elements.beam.uniform import Beam
from ilmek.elements.fatigue import (
    Loading,
    endurance_limit,
    goodman,
    notch_factor,
    size_factor,
    surface_factor,
    yielding,
)
from ilmek.elements.sections import round_section, square_section
from ilmek.elements.shafts import square_stress, square_twist
from ilmek.elements.whirl import Mass, frequencies, uniform_root, uniform_speed
from ilmek.errors import ParameterError
from ilmek.units import GPa, MPa, mm


def test_shigley_example_7_1() -> None:
    """d 1.1 in, Ma 1260, Tm 1100 lbf in, Kf 1.58, Kfs 1.39, 105/82 kpsi, 99 %: Se 29.3 kpsi; n 1.62, 1.56, 4.48."""
    inch, kpsi, pound_inch = 0.0254, 6.894757e6, 0.112985
    assert endurance_limit(105 * kpsi, 1.1 * inch, "machined", 0.99) / kpsi == pytest.approx(29.3, abs=0.05)
    loading = Loading(moment=1260 * pound_inch, torque=1100 * pound_inch)
    section, notch = round_section(1.1 * inch), (1.58, 1.39)

    def safety(mean: float) -> float:
        return goodman(loading, section, endurance=29.3 * kpsi, tensile=mean * kpsi, notch=notch)

    assert safety(105) == pytest.approx(1.62, abs=5e-3)
    assert safety(82) == pytest.approx(1.56, abs=8e-3)
    assert yielding(loading, section, strength=82 * kpsi, notch=notch) == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_mean_moment_adds_to_the_largest_whatever_its_sign(sign: int) -> None:
    """A moment of 50 +- 100 N m yields as one of 150 N m."""
    section = round_section(30 * mm)
    both, most = Loading(100.0, 0.0, moment_mean=sign * 50.0), Loading(150.0, 0.0)
    expected = yielding(most, section, strength=300 * MPa)
    assert yielding(both, section, strength=300 * MPa) == pytest.approx(expected)
    assert expected == pytest.approx(300 * MPa * math.pi * 0.03**3 / 32 / 150.0)


def test_shigley_examples_of_the_factors() -> None:
    """Ex. 6-3: 520 MPa machined ka 0.860; 6-4: 32 mm kb 0.858; 6-9: 690 MPa ka 0.798, Se 236 MPa; 6-6: Kf 1.55."""
    assert surface_factor(520 * MPa, "machined") == pytest.approx(0.860, abs=5e-4)
    assert surface_factor(690 * MPa, "machined") == pytest.approx(0.798, abs=5e-4)
    assert size_factor(32 * mm) == pytest.approx(0.858, abs=5e-4)
    assert size_factor(51 * mm) == pytest.approx(size_factor(51.001 * mm), rel=0.01)
    assert endurance_limit(690 * MPa, 32 * mm, "machined", 0.5) == pytest.approx(236 * MPa, rel=2e-3)
    assert notch_factor(1.65, 3 * mm, 690 * MPa) == pytest.approx(1.55, abs=5e-3)
    assert endurance_limit(3000 * MPa, 7.62 * mm, "ground", 0.5) == pytest.approx(
        700 * MPa * surface_factor(3000 * MPa, "ground")
    )


def test_shigley_example_6_9_stress() -> None:
    """6.8 kN, 695.5 N m at 32 mm, Kf 1.55: 335.1 MPa."""
    stress = float(round_section(32 * mm).equivalent_stress(1.55 * 695.5, 0.0))
    assert stress / MPa == pytest.approx(335.1, abs=0.2)


def test_unknown_surface_and_reliability_are_refused() -> None:
    with pytest.raises(ParameterError, match="one of ground, machined"):
        surface_factor(500 * MPa, "painted")
    with pytest.raises(ParameterError, match=r"0.5 to 0.9999"):
        endurance_limit(500 * MPa, 20 * mm, "ground", 0.3)


def test_sections_agree_with_the_square_shafts_formulas() -> None:
    section, side = square_section(80 * mm), 80 * mm
    assert float(section.equivalent_stress(2000.0, 900.0)) == pytest.approx(square_stress(2000.0, 900.0, side))
    twist = float(section.twist(900.0, 6.0, 200 * GPa / 2.6))
    assert twist == pytest.approx(2 * square_twist(900.0, 6.0, 200 * GPa, side))
    corner = float(section.equivalent_stress(2000.0, 0.0, turning=True))
    assert corner == pytest.approx(6 * math.sqrt(2) * 2000 / side**3)


def test_round_sections_are_the_textbooks() -> None:
    """sqrt(σ² + 3 τ²) = 16/(π d³) sqrt(4 M² + 3 T²); a thin tube's J is 2 π r³ t."""
    stress = float(round_section(0.03).equivalent_stress(100.0, 80.0))
    assert stress == pytest.approx(16 / (math.pi * 0.03**3) * math.sqrt(4 * 100**2 + 3 * 80**2))
    thin = round_section(0.1, 0.0998)
    assert thin.torsion == pytest.approx(2 * math.pi * 0.04995**3 * 0.0001, rel=1e-5)
    with pytest.raises(ParameterError, match="less than the diameter"):
        round_section(0.03, 0.03)


@pytest.mark.parametrize(
    ("ends", "squares"),
    [
        ("hinged", [9.8696, 39.4784, 88.8264]),
        ("cantilever", [3.5160, 22.0345, 61.6972]),
        ("clamped", [22.3733, 61.6728, 120.9034]),
        ("propped", [15.4182, 49.9649, 104.2477]),
    ],
)
def test_roots_of_the_vibrating_beam(ends, squares) -> None:
    """(βl)² [Rao, figure 8.15; Blevins, table 8-1], by the closed form and by finite elements."""
    assert [uniform_root(mode, ends) ** 2 for mode in (1, 2, 3)] == pytest.approx(squares, abs=6e-5)
    length, rigidity, density = 1.3, 4000.0, 5.0
    supports = {"cantilever": (0.0,)}.get(ends, (0.0, length))
    clamped = {"hinged": (), "clamped": (0.0, length)}.get(ends, (0.0,))
    found = frequencies(Beam(length, supports, (), clamped), rigidity, density)
    exact = [uniform_speed(mode, ends, length, rigidity, density) for mode in (1, 2, 3)]
    np.testing.assert_allclose(found, exact, rtol=4e-5)
    assert found[0] == pytest.approx(exact[0], rel=1.5e-6)


def test_two_equal_spans() -> None:
    """Their modes are a hinged span's, and a span's clamped over the middle support."""
    found = frequencies(Beam(2.0, (0.0, 1.0, 2.0)), 1.0, 1.0, count=4)
    expected = [uniform_root(mode, ends) ** 2 for mode in (1, 2) for ends in ("hinged", "propped")]
    np.testing.assert_allclose(found, expected, rtol=1e-4)


def test_one_mass_on_a_massless_shaft() -> None:
    """Mid-span: w² = 48 E I / m l³; at a cantilever's tip 3 E I / m l³."""
    rigidity, mass, length = 900.0, 7.0, 0.8
    for beam, at, factor in (
        (Beam(length, (0.0, length)), length / 2, 48),
        (Beam(length, (0.0,), (), (0.0,)), length, 3),
    ):
        exact = math.sqrt(factor * rigidity / (mass * length**3))
        loaded = [Mass(at, mass)]
        assert frequencies(beam, rigidity, 0.0, loaded)[0] == pytest.approx(exact, rel=1e-9)


def test_masses_off_the_shaft_and_no_mass_at_all_are_refused() -> None:
    with pytest.raises(ParameterError, match="a mass at 1200 mm"):
        frequencies(Beam(1.0, (0.0, 1.0)), 1.0, 1.0, [Mass(1.2, 1.0)])
    with pytest.raises(ParameterError, match="without mass"):
        frequencies(Beam(1.0, (0.0, 1.0)), 1.0, 0.0, [Mass(1.0, 1.0)])
    with pytest.raises(ParameterError, match="hinged, cantilever"):
        uniform_root(1, "free")
