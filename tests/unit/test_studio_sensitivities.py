"""What each parameter does to each check, and two settings side by side."""

import math

import pytest

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.comparison import ComparisonRequest, comparison
from ilmek.jobs.studio.machine.sensitivities import Sensitivity, SensitivityRequest, sensitivities
from ilmek.machines.catalogue import MACHINES
from ilmek.progress import Cancelled, Progress

HERE = Context()


def moved(name: str, parameter: str, settings: dict[str, str] | None = None) -> Sensitivity:
    (found,) = sensitivities(SensitivityRequest(name, settings or {}, (parameter,)), HERE).sensitivities
    return found


def test_effect_of_a_limit_is_its_reciprocal() -> None:
    """A safety that is required is the check's limit: value / limit falls by 1 % where the limit rises by 1 %."""
    found = moved("warp-tension", "deflection_limit")
    effects = {one.check: one for one in found.effects}
    assert effects
    for one in effects.values():
        assert one.relative == pytest.approx(-0.01, rel=1e-3)


def test_check_turns_where_the_straight_line_meets_its_limit() -> None:
    """The force on the beater is proportional to its mass: the line is exact, and the check turns there."""
    found = moved("beat-up", "beater_mass")
    one = next(one for one in found.effects if one.check == "force on the beater")
    assert one.ok
    assert one.turns_at is not None
    for mass, holds in ((one.turns_at * 1.001, True), (one.turns_at * 0.999, False)):
        report = MACHINES["beat-up"].report_for({"beater_mass": mass})
        assert next(check.ok for check in report.checks if check.name == one.check) is holds


def test_central_difference_is_that_of_two_designs() -> None:
    machine = MACHINES["shedding"]
    lift = machine.params.read({}).as_dict()["lift"]
    assert isinstance(lift, float)
    low, high = (machine.report_for({"lift": lift * (1 + sign * 0.01)}) for sign in (-1, 1))
    for one in moved("shedding", "lift").effects:
        before, after = (next(c for c in report.checks if c.name == one.check) for report in (low, high))
        if before.limit:
            assert one.change == pytest.approx((after.value / after.limit - before.value / before.limit) / 2, rel=1e-9)


def test_parameter_that_cannot_move_is_stated_with_the_reason() -> None:
    assert "the design chooses it" in moved("beat-up", "rocker").unmoved
    assert "text" in moved("path-four-bar", "points").unmoved
    by_hand = {"knotting": "hand", "shed": "hand", "beat": "travelling"}
    assert "variant" in moved("automated-loom", "knotting", by_hand).unmoved
    assert moved("weft", "carrier").step.count(" instead of ") == 1


def test_sensitivities_are_shown_one_by_one_and_end_when_cancelled() -> None:
    seen: list[object] = []
    request = SensitivityRequest("weft", {}, ("speed", "acceleration"))
    sensitivities(request, Context(show=seen.append))
    assert [one.parameter for one in seen if isinstance(one, Sensitivity)] == ["speed", "acceleration"]
    with pytest.raises(Cancelled):
        sensitivities(request, Context(progress=Progress(cancelled=lambda: True)))


def test_comparison_names_what_differs_and_the_checks_that_turn_first() -> None:
    found = comparison(ComparisonRequest("beat-up", {"beater_mass": "2kg"}, {}), HERE)
    assert [(one.name, one.b) for one in found.parameters] == [("beater_mass", "2.5 kg")]
    assert found.parameters[0].change == pytest.approx(-0.2)
    turned = found.checks[0]
    assert (turned.name, turned.a_holds, turned.b_holds) == ("force on the beater", False, True)
    assert found.a_failed == found.b_failed + sum(one.a_holds is False and bool(one.b_holds) for one in found.checks)
    assert all(one.a != one.b for one in (*found.results, *found.checks))
    same = comparison(ComparisonRequest("beat-up", {}, {}), HERE)
    assert (same.parameters, same.results, same.checks) == ((), (), ())


def test_comparison_refuses_settings_that_cannot_be_designed() -> None:
    with pytest.raises(IlmekError, match="out of bounds"):
        comparison(ComparisonRequest("beat-up", {}, {"swing": f"{math.pi * 2}"}), HERE)
