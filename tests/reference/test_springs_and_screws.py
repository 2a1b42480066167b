"""Springs and screws against Shigley's worked examples and limiting cases."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.screws import END_FIXITY, Screw, trapezoidal
from ilmek.elements.springs import WIRE_DIAMETERS, WIRES, CompressionSpring, choose_spring
from ilmek.errors import ParameterError
from ilmek.units import deg, mm

INCH, POUND, KPSI = 0.0254, 4.4482216, 6.894757e6


def test_shigley_example_10_1() -> None:
    """No. 16 music wire, D 0.400 in, 10.5 active coils: Ssy 146 kpsi, k 4.13 lbf/in; buckles from L0 2.1 in on."""
    spring = CompressionSpring("music wire", 0.037 * INCH, 0.400 * INCH, 10.5, 2.0 * INCH)
    assert spring.allowed / KPSI == pytest.approx(146, abs=1)
    assert spring.rate / (POUND / INCH) == pytest.approx(4.13, abs=0.01)
    assert spring.index == pytest.approx(10.8, abs=0.02)
    assert spring.stress(6.46 * POUND) == pytest.approx(spring.allowed, rel=0.02)
    assert math.isinf(spring.buckling_deflection())
    longer = CompressionSpring("music wire", 0.037 * INCH, 0.400 * INCH, 10.5, 2.15 * INCH)
    assert longer.buckling_deflection() < longer.free_length


def test_shigley_example_10_4() -> None:
    """Music wire 0.092 in, outside 9/16 in, 5 to 35 lbf: amplitude 29.7 kpsi, 1.18 by Sines, unpeened.

    The book takes Bergsträsser's factor 1.287 for Wahl's 1.303.
    """
    spring = CompressionSpring("music wire", 0.092 * INCH, (9 / 16 - 0.092) * INCH, 21.0, 4.125 * INCH)
    assert spring.wahl == pytest.approx(1.303, abs=5e-4)
    assert spring.stress(15 * POUND) / KPSI == pytest.approx(29.7 * 1.303 / 1.287, rel=2e-3)
    assert spring.fatigue_safety(5 * POUND, 35 * POUND) == pytest.approx(1.18 * 1.287 / 1.303, rel=5e-3)


def test_wahls_factor() -> None:
    """C 10: 1.1448; C 4: 1.4038 [Wahl's diagram]."""
    found = [CompressionSpring("music wire", 1e-3, c * 1e-3, 5.0, 0.05).wahl for c in (10, 4)]
    assert found == pytest.approx([1.1448, 1.4038], abs=1e-4)


def test_surge_is_that_of_a_rod_between_walls() -> None:
    """The lowest wave goes up and down once: f = c / 2 L, c = L sqrt(k / m)."""
    spring = CompressionSpring("oil-tempered wire", 3 * mm, 24 * mm, 8.0, 0.09)
    closed = 3 * mm / (2 * math.pi * (24 * mm) ** 2 * 8) * math.sqrt(77.2e9 / (2 * 7850))
    assert spring.surge == pytest.approx(closed)


@settings(max_examples=5)
@given(st.floats(200, 20000), st.floats(1, 200), st.floats(0.002, 0.05))
def test_chosen_spring_keeps_all_its_limits(rate, preload, travel) -> None:
    spring = choose_spring(rate, preload, travel, inner=8 * mm, outer=60 * mm)
    if spring is not None:
        assert spring.rate == pytest.approx(rate)
        assert spring.wire_diameter in WIRE_DIAMETERS
        assert spring.stress(preload + rate * travel) < spring.solid_stress <= spring.allowed
        assert spring.free_length - spring.solid_length > preload / rate + travel
        assert spring.buckling_deflection() > preload / rate + travel
        assert spring.diameter - spring.wire_diameter >= 8 * mm


def test_no_spring_for_an_impossible_task() -> None:
    assert choose_spring(1000.0, 5000.0, 0.05) is None
    for wrong in ((0.0, 5.0, 0.01), (100.0, -1.0, 0.01)):
        with pytest.raises(ParameterError, match="a rate above 0"):
            choose_spring(*wrong)
    lasting = choose_spring(2000.0, 20.0, 0.02, fatigue=1.2)
    assert lasting is not None
    assert lasting.fatigue_safety(20.0, 60.0) >= 1.2
    with pytest.raises(ParameterError, match="nearest offered is 'music wire'"):
        choose_spring(1000.0, 5.0, 0.05, wire="musik wire")
    assert set(WIRES) >= {"music wire", "stainless wire"}


def test_shigley_example_8_1() -> None:
    """Square thread, 32 mm, double, pitch 4 mm, f 0.08, collar 40 mm, 6.4 kN: 26.18 and 9.77 N m, efficiency 0.311."""
    screw = Screw(30 * mm, 8 * mm, 28 * mm, 0.08)
    collar = 6400.0 * 0.08 * 40 * mm / 2
    assert screw.torque(6400.0) + collar == pytest.approx(26.18, abs=6e-3)
    assert collar - screw.holding_torque(6400.0) == pytest.approx(9.77, abs=6e-3)
    assert 6400 * 8 * mm / (2 * math.pi * (screw.torque(6400.0) + collar)) == pytest.approx(0.311, abs=1e-3)
    assert not Screw(30 * mm, 8 * mm, 28 * mm, 0.08).self_locking
    assert Screw(30 * mm, 8 * mm, 28 * mm, 0.09).self_locking


@settings(max_examples=25)
@given(st.floats(1, 89), st.floats(0.001, 0.5), st.floats(0, 15))
def test_a_screw_loses_power_both_ways(lead_angle, friction, flank) -> None:
    diameter = 10 * mm
    screw = Screw(diameter, math.pi * diameter * math.tan(lead_angle * deg), 8 * mm, friction, flank * deg)
    assert 0 <= screw.efficiency < 1
    assert 0 <= screw.back_driving_efficiency < 1
    if screw.self_locking:
        assert screw.efficiency < 0.5
    else:
        force = 2.0 / screw.holding_torque(1.0)
        assert 2.0 * 2 * math.pi == pytest.approx(force * screw.lead * screw.back_driving_efficiency)
    assert screw.jams == math.isinf(screw.torque(1.0))


def test_trapezoidal_threads() -> None:
    """ISO 2904: Tr 40 x 7 d2 36.5, d3 32; Tr 12 x 3 d2 10.5, d3 8.5; four starts no longer lock."""
    assert [trapezoidal(40 * mm).diameter / mm, trapezoidal(40 * mm).core / mm] == pytest.approx([36.5, 32.0])
    assert [trapezoidal(12 * mm).diameter / mm, trapezoidal(12 * mm).core / mm] == pytest.approx([10.5, 8.5])
    assert trapezoidal(12 * mm).self_locking
    assert not trapezoidal(12 * mm, starts=4).self_locking
    with pytest.raises(ParameterError, match="nearest offered is Tr 20"):
        trapezoidal(21 * mm)


def test_euler() -> None:
    """A hinged steel core of 20 mm, 1 m long: π³ E d⁴ / 64 l²; clamped ends four times of it."""
    screw = Screw(22 * mm, 5 * mm, 20 * mm, 0.1)
    hinged = screw.buckling_force(1.0, 210e9, "hinged")
    assert hinged == pytest.approx(math.pi**3 * 210e9 * (20 * mm) ** 4 / 64)
    assert screw.buckling_force(1.0, 210e9, "clamped") == pytest.approx(4 * hinged)
    with pytest.raises(ParameterError, match="one of clamped-free"):
        screw.buckling_force(1.0, 210e9, "loose")
    with pytest.raises(ParameterError, match="lead above 0"):
        Screw(22 * mm, 0.0, 20 * mm, 0.1)
    assert set(END_FIXITY) == {"clamped-free", "hinged", "clamped-hinged", "clamped"}
