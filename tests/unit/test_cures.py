"""Every check of a loom says what would cure it, and every reason repeats it."""

import pytest
from default_machines import loom_report

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.report import Check, Report, at_most

LOOMS = (
    {},
    {"beat": "travelling"},
    {"beat": "linkage"},
    {"beat": "comb", "aim": "time"},
    {"beat": "guide-cams"},
    {"knots_across": "60/dm", "width": "3m", "deadline": "200h", "price_limit": "50000"},
    {"knot": "asymmetric"},
)


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("settings", LOOMS, ids=str)
def test_every_check_of_a_loom_has_a_cure(settings: dict[str, str]) -> None:
    report = loom_report(design(AutomatedLoomParams.read({"aim": "price", **settings})))
    assert [check.name for check in report.all_checks if not check.cure] == []


def test_a_reason_without_a_cure_refers_to_its_limit() -> None:
    def reason(check: Check) -> str:
        return Report("m", "M", {}, (), (check,)).reasons[0].cure

    assert reason(at_most("sag", 2.0, 1.0, "mm", "rail_sag").with_cure("set a stiffer rail")) == "set a stiffer rail"
    assert reason(at_most("sag", 2.0, 1.0, "mm", "rail_sag")).endswith("its limit: rail_sag")
    assert reason(at_most("sag", 2.0, 1.0, "mm", ""))
