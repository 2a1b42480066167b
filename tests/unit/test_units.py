"""Units: exact factors, dimensions kept apart, slips named."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.errors import UnitError
from ilmek.units import format_quantity, from_si, parse_quantity, parse_unit


@pytest.mark.parametrize(
    ("text", "unit", "si"),
    [
        ("60mm", "m", 0.06),
        ("170deg", "rad", 170 * math.pi / 180),
        ("15.5rad/s", "rpm", 15.5),
        ("5rpm", "rad/s", math.pi / 6),
        ("2.5kg", "g", 2.5),
        ("7210 kg/m^3", "kg/m^3", 7210.0),
        ("7.21g/cm³", "kg/m^3", 7210.0),
        ("9.81 m/s²", "m/s^2", 9.81),
        ("14kN/m", "N/m", 14000.0),
        ("210GPa", "MPa", 210e9),
        ("630N·m", "N*m", 630.0),
        ("3/4", "", None),
        ("0.06", "mm", 0.06),
        ("-.5e1mm", "m", -0.005),
        ("72h", "s", 259200.0),
        ("40/dm", "1/m", 400.0),
        ("5N·m", "Nm", 5.0),
        ("12in", "mm", 0.3048),
    ],
)
def test_reads_a_quantity(text: str, unit: str, si: float | None) -> None:
    if si is None:
        with pytest.raises(UnitError):
            parse_quantity(text, unit)
    else:
        assert parse_quantity(text, unit) == pytest.approx(si, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "mm", "nan", "inf", "1e999m", "60mmm", "60 deg", "6,5mm", "0x10mm", "60kg", "1 m m"]
)
def test_refuses_what_is_no_length(text: str) -> None:
    with pytest.raises(UnitError):
        parse_quantity(text, "mm")


def test_names_the_nearest_unit() -> None:
    with pytest.raises(UnitError, match="did you mean 'deg'"):
        parse_quantity("30degs", "rad")


@given(st.floats(1e-6, 1e6), st.sampled_from(["mm", "kg/m^3", "rpm", "kN/m", "MPa", "m/s^2", "deg"]))
def test_writing_and_reading_round_trips(value: float, unit: str) -> None:
    shown = format_quantity(value, unit, digits=15)
    assert parse_quantity(shown, unit) == pytest.approx(value, rel=1e-13)
    assert from_si(value, unit) * parse_unit(unit).factor == pytest.approx(value, rel=1e-15)
