"""`ilmek design shedding` against the thesis' wefting cams (3.2), re-computed; misprints named in the machine."""

import math

import pytest

from ilmek.machines.shedding import MACHINE
from ilmek.report import Report
from ilmek.units import deg, mm


def answer(**settings: str) -> Report:
    return MACHINE.report(MACHINE.design(MACHINE.params.read(settings)))


def results(**settings: str) -> dict:
    return answer(**settings).as_json()["results"]


@pytest.fixture(scope="module")
def thesis() -> dict:
    return results()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("prime_radius", 78.16653826 * mm),
        ("pressure_angle_max", 30 * deg),
        ("pressure_angle_at", 36.948943 * deg),
        ("curvature_radius_min", 73.94448725 * mm),
        ("shaft_torque_max", 180.0),
        ("shaft_torque_min", -180.0),
        ("torque_rms", 180 / math.sqrt(2)),
        ("power_max", 94.24777961),
        ("shed_work", 180.0),
        ("velocity_max", 31.41592654 * mm),
        ("acceleration_max", 32.89868134 * mm),
        ("shed_opening", 60 * mm),
        ("turn_time", 12.0),
        ("cam_thickness", 1 * mm),
        ("shaft_length", 1.2),
    ],
)
def test_the_thesis_loom(thesis, name, value) -> None:
    """60 mm, harmonic, 90 deg up and down, 30 deg, 600 warps of 10 N, 5 rpm; only one parity lifts at a time."""
    assert thesis[name] == pytest.approx(value, rel=2e-9, abs=1e-8 if name == "pressure_angle_at" else 0)


def test_acceleration_jumps_where_cam_leaves_and_meets_its_dwell(thesis) -> None:
    assert [jump["angle"] for jump in thesis["acceleration_jumps"]] == pytest.approx([0.0, math.pi])


def test_torque_from_tension_and_half_span() -> None:
    """15 N over a half span of 169.7056 mm: 119.9063824 N m at 59.45321513 deg, 92.64935264 J a rise."""
    span = 0.12 * math.sqrt(2)
    found = results(half_span=f"{span!r}m")
    assert found["shaft_torque_max"] == pytest.approx(119.9063824, rel=1e-9)
    assert found["shed_work"] == pytest.approx(92.64935264, rel=1e-9)
    design = MACHINE.design(MACHINE.params.read(dict(half_span=f"{span!r}m")))
    assert design.drive.torque_max.at % math.pi == pytest.approx(59.45321513 * deg, abs=1e-7)


def test_half_span_of_the_thesis_gives_its_lateral_force() -> None:
    """10 N = 2 x 15 N sin 19.4712 deg at the full lift."""
    assert 2 * 15 * math.sin(math.atan2(60, 120 * math.sqrt(2))) == pytest.approx(10.0)
    alone, drawn = results(), results(half_span=f"{0.12 * math.sqrt(2)!r}m")
    assert drawn["shaft_load"] == pytest.approx(alone["shaft_load"])


@pytest.mark.parametrize(
    ("load", "slope", "deflection"),
    [("7kN/m", 52.4361, 58.0301), ("14000", 62.3574, 69.0098), ("21kN/m", 69.0098, 76.3719)],
)
def test_table_3_2_columns_in_their_places(load, slope, deflection) -> None:
    found = results(
        shaft_load=load, shaft_length="1.2m", modulus="200GPa", slope_limit="0.004rad", deflection_limit="1mm"
    )
    assert found["shaft_side_slope"] / mm == pytest.approx(slope, abs=5e-5)
    assert found["shaft_side_deflection"] / mm == pytest.approx(deflection, abs=5e-5)
    assert found["shaft_side"] == max(found["shaft_side_slope"], found["shaft_side_deflection"])


def test_safety_on_a_given_load() -> None:
    assert results(shaft_load="7kN/m", safety="2")["shaft_side_deflection"] / mm == pytest.approx(69.0098, abs=5e-5)


@pytest.mark.parametrize("limit", [20, 25, 35, 45])
def test_prime_radius_by_limit(limit) -> None:
    printed = {20: 137.5561870, 25: 102.1214432, 35: 60.78867895, 45: 37.08203932}[limit]
    assert results(pressure_angle_limit=f"{limit}deg")["prime_radius_min"] == pytest.approx(printed * mm, rel=1e-9)
