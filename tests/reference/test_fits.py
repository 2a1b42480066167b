"""ISO 286 against limits as published by class: tables of ISO 286-2, and the misprints that its corrigendum corrects.

The module computes limits from fundamental deviations and grades (part 1); these tables list the limits themselves.
"""

import numpy as np
import pytest

from ilmek.elements.fits import fit, tolerance_grade, tolerance_zone
from ilmek.errors import ParameterError
from ilmek.units import mm, um

SIZES = (2, 5, 8, 12, 25, 45, 70, 110, 170, 240, 300, 380, 480)

PUBLISHED = {
    "H7": "10 0 12 0 15 0 18 0 21 0 25 0 30 0 35 0 40 0 46 0 52 0 57 0 63 0",
    "k6": "6 0 9 1 10 1 12 1 15 2 18 2 21 2 25 3 28 3 33 4 36 4 40 4 45 5",
    "k8": "14 0 18 0 22 0 27 0 33 0 39 0 46 0 54 0 63 0 72 0 81 0 89 0 97 0",
    "m6": "8 2 12 4 15 6 18 7 21 8 25 9 30 11 35 13 40 15 46 17 52 20 57 21 63 23",
    "n6": "10 4 16 8 19 10 23 12 28 15 33 17 39 20 45 23 52 27 60 31 66 34 73 37 80 40",
    "p6": "12 6 20 12 24 15 29 18 35 22 42 26 51 32 59 37 68 43 79 50 88 56 98 62 108 68",
    "g6": "-2 -8 -4 -12 -5 -14 -6 -17 -7 -20 -9 -25 -10 -29 -12 -34 -14 -39 -15 -44 -17 -49 -18 -54 -20 -60",
    "f7": "-6 -16 -10 -22 -13 -28 -16 -34 -20 -41 -25 -50 -30 -60 -36 -71 -43 -83 -50 -96 -56 -108 -62 -119 -68 -131",
    "h9": "0 -25 0 -30 0 -36 0 -43 0 -52 0 -62 0 -74 0 -87 0 -100 0 -115 0 -130 0 -140 0 -155",
    "K7": "0 -10 3 -9 5 -10 6 -12 6 -15 7 -18 9 -21 10 -25 12 -28 13 -33 16 -36 17 -40 18 -45",
    "M7": "-2 -12 0 -12 0 -15 0 -18 0 -21 0 -25 0 -30 0 -35 0 -40 0 -46 0 -52 0 -57 0 -63",
    "N7": "-4 -14 -4 -16 -4 -19 -5 -23 -7 -28 -8 -33 -9 -39 -10 -45 -12 -52 -14 -60 -14 -66 -16 -73 -17 -80",
    "N9": "-4 -29 0 -30 0 -36 0 -43 0 -52 0 -62 0 -74 0 -87 0 -100 0 -115 0 -130 0 -140 0 -155",
    "P7": "-6 -16 -8 -20 -9 -24 -11 -29 -14 -35 -17 -42 -21 -51 -24 -59 -28 -68 -33 -79 -36 -88 -41 -98 -45 -108",
    "P9": "-6 -31 -12 -42 -15 -51 -18 -61 -22 -74 -26 -88 -32 -106 -37 -124 -43 -143 -50 -165 -56 -186 -62 -202 "
    "-68 -223",
    "E9": "39 14 50 20 61 25 75 32 92 40 112 50 134 60 159 72 185 85 215 100 240 110 265 125 290 135",
    "JS9": "12.5 -12.5 15 -15 18 -18 21.5 -21.5 26 -26 31 -31 37 -37 43.5 -43.5 50 -50 57.5 -57.5 65 -65 70 -70 "
    "77.5 -77.5",
}
"""Upper and lower limit deviation at `SIZES` [µm]."""


@pytest.mark.parametrize("name", PUBLISHED)
def test_limits_of_a_class_are_those_of_its_published_table(name: str) -> None:
    limits = [(zone.upper, zone.lower) for zone in (tolerance_zone(name, size * mm) for size in SIZES)]
    published = np.array(PUBLISHED[name].split(), dtype=float).reshape(-1, 2)
    assert np.array(limits) / um == pytest.approx(published, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "size", "lower", "upper"),
    [
        ("A13", 350, 1200, 2090),  # the first four: ISO 286-2:1988/Cor 1:2006
        ("E8", 100, 72, 126),
        ("R10", 20, -112, -28),
        ("f9", 300, -186, -56),
        ("M6", 300, -41, -9),  # the exception of ISO 286-1, table 3
        ("S7", 70, -78, -48),
        ("u6", 80, 102, 121),
        ("r6", 65, 41, 60),
    ],
)
def test_limits_of_single_classes(name: str, size: float, lower: float, upper: float) -> None:
    zone = tolerance_zone(name, size * mm)
    assert (zone.lower / um, zone.upper / um) == pytest.approx((lower, upper))


def test_a_range_has_its_upper_end_and_grades_grow() -> None:
    assert tolerance_grade(7, 30 * mm) == pytest.approx(21 * um)
    assert tolerance_grade(7, 30.001 * mm) == pytest.approx(25 * um)
    for size in SIZES:
        grades = [tolerance_grade(grade, size * mm) for grade in ("01", *range(19))]
        assert np.all(np.diff(grades) > 0)


@pytest.mark.parametrize(("running", "alike"), [("H7/g6", "G7/h6"), ("H7/p6", "P7/h6"), ("H7/s6", "S7/h6")])
def test_homologous_fits_have_the_same_clearance(running: str, alike: str) -> None:
    for size in SIZES[1:]:
        one, other = fit(running, size * mm), fit(alike, size * mm)
        assert one.least_clearance == pytest.approx(other.least_clearance)
        assert one.largest_clearance == pytest.approx(other.largest_clearance)


@pytest.mark.parametrize("name", ["H7", "g6/H7", "H7/", "HH7/g6", "H19/g6", "H7/q6", "Hg7/g6", "K9/h6"])
def test_a_wrong_fit_is_refused(name: str) -> None:
    with pytest.raises(ParameterError):
        fit(name, 20 * mm)


@pytest.mark.parametrize("size", [0.0, -1 * mm, 501 * mm, float("nan")])
def test_a_size_beyond_the_tables_is_refused(size: float) -> None:
    with pytest.raises(ParameterError):
        tolerance_zone("H7", size)
