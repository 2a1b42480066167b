"""Bearing life against ISO 281 and a textbook's example; tubes against the standard's table."""

import math
from itertools import pairwise

import numpy as np
import pytest

from ilmek.elements.bearings import (
    RELIABILITY,
    ROLLING_BEARINGS,
    RollingBearing,
    equivalent_load,
    find_bearing,
    hours,
    life,
    reliability_factor,
    slope_limit,
    smallest_bearing,
    static_load,
)
from ilmek.elements.tubes import TUBES, find_tube
from ilmek.errors import ParameterError
from ilmek.machines.bearing_seats import seat_of
from ilmek.part.catalogue import FLANGE
from ilmek.units import kN, mm, rpm


@pytest.mark.parametrize(
    ("kind", "revolutions", "at_300_rpm"), [("ball", 125e6, 6944.4), ("cylindrical roller", 213.746993e6, 11874.8)]
)
def test_life_at_a_fifth_of_the_rating(kind, revolutions, at_300_rpm) -> None:
    found = life(5.0, 1.0, kind)
    assert found == pytest.approx(revolutions, rel=5e-9)
    assert hours(found, 300 * rpm) == pytest.approx(at_300_rpm, abs=0.05)


@pytest.mark.parametrize(("reliability", "factor"), list(RELIABILITY.items()))
def test_reliability_shortens_the_life(reliability, factor) -> None:
    """ISO 281:2007, table 12: 1 / .64 / .55 / .47 / .37 / .25."""
    assert factor == {0.90: 1, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}[reliability]
    assert life(30.0, 3.0, "ball", reliability) == pytest.approx(factor * 1e9)
    with pytest.raises(ParameterError, match=r"0.90 to 0.99"):
        reliability_factor(0.995)


def test_shigley_example_of_an_axial_load() -> None:
    """Shigley, example 11-4 (SI here): C0 4450 lbf, C 7900 lbf, Fr 500, Fa 400 lbf, 720 rpm: P 891 lbf, 16 150 h."""
    bearing = RollingBearing("example", "deep-groove ball", 0.05, 0.09, 0.02, 7900.0, 4450.0, 0.0, 1e3)
    load = equivalent_load(bearing, 500.0, 400.0)
    assert load == pytest.approx(890.8, abs=0.5)
    assert hours(life(bearing.dynamic, load, bearing.kind), 720 * rpm) == pytest.approx(16150, rel=2e-3)


def test_equivalent_load_is_the_radial_one_or_more() -> None:
    bearing = find_bearing("6207")
    loads = [equivalent_load(bearing, 1 * kN, axial) for axial in range(0, 8000, 100)]
    assert loads[0] == 1 * kN
    assert loads[-1] == pytest.approx(0.56 * 1 * kN + 7900 * float(np.interp(7900 / 15300, [0.42, 0.56], [1.04, 1.0])))
    assert min(loads) >= 1 * kN
    assert static_load(bearing, 1000.0, 3000.0) == pytest.approx(0.6 * 1000 + 0.5 * 3000)


def test_roller_bearing_takes_no_axial_load() -> None:
    with pytest.raises(ParameterError, match="axial load of 10 N on NU 205"):
        equivalent_load(find_bearing("NU 205"), 100.0, 10.0)


def test_the_thesis_bearing() -> None:
    ucf = find_bearing("UCF 207")
    assert (ucf.dynamic, ucf.static, ucf.bore) == (25.7 * kN, 15.4 * kN, 35 * mm)
    assert slope_limit(ucf) == 0.004


@pytest.mark.parametrize(
    ("given", "near"), [("UCF 216", "UCF 212"), ("6213", "6212"), ("NU 203", "NU 204"), ("6204-2RS", "6204")]
)
def test_unknown_bearing_names_the_nearest(given, near) -> None:
    with pytest.raises(ParameterError, match=f"nearest offered is '{near}'"):
        find_bearing(given)


def test_boundary_dimensions_and_ratings_are_of_their_series() -> None:
    """ISO 15: 62, NU 2 and UC 2 share bore and outer diameter; within a series a wider bore bears more."""
    for size in ("04", "05", "06", "07", "08", "09", "10", "11", "12"):
        ball, roller, insert = (find_bearing(f"{series}{size}") for series in ("62", "NU 2", "UC 2"))
        assert ball.bore == roller.bore == insert.bore == pytest.approx(int(size) * 5 * mm)
        assert ball.outer == roller.outer == insert.outer
        assert insert.dynamic == pytest.approx(ball.dynamic, rel=0.04)
        assert roller.dynamic > ball.dynamic
    for series in ("60", "62", "63", "NU 2", "UC 2", "UCF 2"):
        names = [name for name in ROLLING_BEARINGS if name[: len(series)] == series and name[len(series) :].isdigit()]
        rows = [ROLLING_BEARINGS[name] for name in names]
        for small, large in pairwise(rows):
            assert small.bore < large.bore
            assert small.outer < large.outer
            assert small.dynamic < large.dynamic
            assert small.static < large.static
            assert small.mass < large.mass
            assert small.speed >= large.speed
        for one in rows:
            full = math.pi / 4 * (one.outer**2 - one.bore**2) * one.width * 7850
            assert one.flange > 0 or 0.3 * full < one.mass < full


def test_smallest_bearing_is_enough_and_none_lighter_is() -> None:
    taken = smallest_bearing(6 * kN, 5e7, axial=1 * kN, bore=25 * mm, speed=1500 * rpm, reliability=0.95)
    assert taken is not None

    def lives(one: RollingBearing) -> bool:
        return life(one.dynamic, equivalent_load(one, 6 * kN, 1 * kN), one.kind, 0.95) >= 5e7

    assert lives(taken)
    lighter = [one for one in ROLLING_BEARINGS.values() if one.kind == taken.kind and one.mass < taken.mass]
    assert not [one for one in lighter if lives(one) and one.bore >= 25 * mm - 1e-12]
    assert smallest_bearing(1e6, 1e9) is None


@pytest.mark.parametrize(
    ("name", "mass", "area", "inertia", "modulus"),
    [
        ("60.3x4", 5.55, 7.07, 28.2, 9.34),
        ("114.3x5", 13.5, 17.2, 257, 45.0),
        ("139.7x5", 16.6, 21.2, 481, 68.8),
        ("168.3x6.3", 25.2, 32.1, 1053, 125),
        ("219.1x8", 41.6, 53.1, 2960, 270),
    ],
)
def test_tubes_of_the_standard(name, mass, area, inertia, modulus) -> None:
    """EN 10210-2, table B.1: kg/m, cm², cm⁴, cm³, to three figures."""
    tube = find_tube(name)
    found = (tube.mass(), tube.area * 1e4, tube.inertia * 1e8, tube.modulus * 1e6)
    assert found == pytest.approx((mass, area, inertia, modulus), rel=4e-3)


def test_tube_not_in_stock_names_the_nearest() -> None:
    with pytest.raises(ParameterError, match="nearest offered is '140x5'"):
        find_tube("141x5")
    with pytest.raises(ParameterError, match="write it like 140x5"):
        find_tube("round")
    assert find_tube("140 mm × 5 mm") is TUBES["140x5"]


FLANGED = {204: (64, "M10"), 205: (70, "M10"), 206: (83, "M10"), 207: (92, "M12"), 208: (102, "M14"), 209: (105, "M14"),
           210: (111, "M14"), 211: (130, "M16"), 212: (143, "M16")}  # fmt: skip
"""Distance of the bolt holes of square flanged units [mm] and their bolts: tables of makers of insert bearings."""


@pytest.mark.parametrize(("size", "row"), FLANGED.items())
def test_flanged_bearings_stand_on_the_bolts_of_their_tables(size: int, row: tuple[float, str]) -> None:
    seat = seat_of(find_bearing(f"UC {size}"), 1000.0)
    bearing, screw = seat.bearing, seat.screws.screw
    assert (round(1e3 * 2 * float(seat.corners()[0].real), 6), screw.name) == row
    washer, thickness = screw.washer
    assert bearing.pitch + washer <= bearing.flange + 1e-9  # it lies on the flange
    assert bearing.pitch / math.sqrt(2) - washer / 2 > bearing.outer / 2  # and clear of the bearing
    assert 1.5e-3 <= bearing.hole - screw.diameter <= 3e-3
    assert washer > bearing.hole + 4e-3
    assert seat.screw_length - thickness - FLANGE >= screw.diameter  # of thread in the bracket
