"""`ilmek design cam` with a compliant linkage: against the rigid follower and the closed form of the residual."""

import math

import pytest

from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.return_spring import least_force
from ilmek.cams.vibration import residual
from ilmek.errors import ParameterError
from ilmek.machines.cam import MACHINE
from ilmek.machines.cam.compliant_follower import compliant_follower, vibration_checks
from ilmek.machines.cam.design import CamDesign
from ilmek.report import Plot, results_of

ASKED = {"lift": "20mm", "rise": "90deg", "mass": "2kg", "speed": "300rpm", "law": "modified-sine"}


def design(**said: str) -> CamDesign:
    return MACHINE.design(MACHINE.params.read({**ASKED, **said}))


def numbers(design: CamDesign) -> dict[str, float]:
    made = compliant_follower(design)
    assert made is not None
    return {result.name: result.value for result in results_of(made)}


def test_a_rigid_follower_says_nothing_of_vibration() -> None:
    assert compliant_follower(design()) is None


def test_frequency_ratio_and_residual_are_those_of_the_law() -> None:
    got = numbers(design(linkage_stiffness="200N/mm", spring_rate="0N/mm", preload="400N", linkage_damping="0"))
    frequency = math.sqrt(200e3 / 2.0) / (2 * math.pi)
    assert got["natural_frequency"] == pytest.approx(frequency, rel=1e-12)
    assert got["time_ratio"] == pytest.approx(frequency * 0.05, rel=1e-12)
    left = 0.02 * float(residual(LAWS["modified-sine"], frequency * 0.05))
    assert got["residual_vibration"] == pytest.approx(left, rel=1e-9)
    assert got["residual_vibration_fall"] == pytest.approx(left, rel=1e-9)


@pytest.mark.parametrize("more", [{}, {"motion": "oscillating", "arm": "80mm"}])
def test_a_stiff_linkage_is_the_rigid_follower(more) -> None:
    cam = design(linkage_stiffness="2e6N/mm", **more)
    got = numbers(cam)
    rigid = least_force(cam.programme, cam.follower_load).value / cam.params.per_unit
    assert got["contact_springy_min"] == pytest.approx(rigid, rel=0.02)
    assert got["lag_max"] < 1e-6
    assert got["residual_vibration"] < 1e-6


def test_a_soft_linkage_leaves_the_cam_before_the_rigid_follower_does() -> None:
    cam = design(linkage_stiffness="200N/mm")
    assert cam.lift_off.speed > cam.params.speed
    report = MACHINE.report(cam)
    assert [check.name for check in report.failed] == ["force of the compliant follower on the cam"]
    found = {result.name: result.value for result in report.results}
    assert found["contact_springy_min"] < 0 < found["hold_force_min"]
    table = next(table for table in report.tables if table.name == "cam-vibration")
    assert [row[0] for row in table.rows] == list(SMOOTH_LAWS)
    speeds = {row[0]: row[3] for row in table.rows}
    assert speeds["4-5-6-7"] > speeds["harmonic"]
    plots = {figure.name: figure for figure in report.figures if isinstance(figure, Plot)}
    assert len(plots["cam-vibration"].series) == 4
    assert plots["cam-lag"].series[0].y.max() <= found["lag_max"]


def test_a_groove_pulls_too() -> None:
    made = compliant_follower(design(linkage_stiffness="200N/mm", kind="grooved"))
    assert made is not None
    assert vibration_checks(made) == ()


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ({"mass": "0kg"}, "linkage_stiffness with mass=0; mass above 0; or leave it out"),
        ({"speed": "0rpm"}, "linkage_stiffness with speed=0; speed above 0"),
        ({"linkage_stiffness": "1e9N/mm", "mass": "1e-6kg"}, "take it as rigid"),
    ],
)
def test_refuses(said, message) -> None:
    with pytest.raises(ParameterError, match=message):
        compliant_follower(design(**{"linkage_stiffness": "200N/mm", **said}))
