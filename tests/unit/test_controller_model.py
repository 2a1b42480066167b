"""Every interleaving of endings, crashes, restarts, commands, faults and answers over small carpets.

The counts are those of docs/explanation/controller.md.
"""

from dataclasses import replace
from pathlib import Path

import pytest
from control_model import Budget, Model, TinyProgramme

from ilmek.loom.control import doubts
from ilmek.loom.control.controller import Controller
from ilmek.records import value_record

PAGE = Path(__file__).parents[2] / "docs/explanation/controller.md"


@value_record
class Case:
    """A programme of so many rows, what may happen, knots in a group commit, and how many worlds there are."""

    rows: int
    budget: Budget
    group: int
    worlds: int


CASES = {
    "one crash": Case(2, Budget(crashes=1, unknown=2), 1, 501),
    "two crashes, groups of 3": Case(2, Budget(crashes=2, unknown=2), 3, 1350),
    "a crash and a command": Case(2, Budget(crashes=1, commands=1), 1, 3084),
    "a crash and a fault, groups of 2": Case(2, Budget(crashes=1, faults=1), 2, 2650),
    "a crash and a sensor": Case(1, Budget(crashes=1, sensors=1), 1, 2337),
    "a command and a fault": Case(2, Budget(crashes=0, commands=1, faults=1), 1, 6460),
}


@pytest.mark.matrix(light=3)
@pytest.mark.parametrize("name", CASES)
def test_every_operation_is_in_the_carpet_once_and_the_carpet_can_always_be_finished(name: str) -> None:
    case = CASES[name]
    model = Model(TinyProgramme(case.rows), case.budget, case.group)
    assert model.explore() == case.worlds
    row = f"| {name} | {case.rows} | {case.worlds:,} | {model.steps:,} | {model.crashes:,} |"
    assert row in PAGE.read_text(encoding="utf-8")


def explore(budget: Budget, group: int = 1) -> None:
    Model(TinyProgramme(1), budget, group).explore()


def test_the_model_notices_that_nothing_is_asked_after_a_restart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doubts, "add_frontier", lambda *_, **__: None)
    with pytest.raises(AssertionError, match="may be in the carpet"):
        explore(Budget(crashes=1))


def test_the_model_notices_that_one_question_is_not_enough_for_a_group(monkeypatch: pytest.MonkeyPatch) -> None:
    resolve = Controller._resolve

    def short(self: Controller, key: int, **rest: object) -> None:
        self.state.doubts[key] = replace(self.state.doubts[key], onward=False)
        resolve(self, key, **rest)  # type: ignore[arg-type]

    monkeypatch.setattr(Controller, "_resolve", short)
    explore(Budget(crashes=1))
    with pytest.raises(AssertionError, match="may be in the carpet"):
        explore(Budget(crashes=1), group=3)


def test_the_model_notices_that_an_abort_forgets_what_moved(monkeypatch: pytest.MonkeyPatch) -> None:
    stopped = Controller.stopped_moving

    def forgetful(self: Controller, draft: object) -> None:
        self.state.progress.clear()
        stopped(self, draft)  # type: ignore[arg-type]

    monkeypatch.setattr(Controller, "stopped_moving", forgetful)
    with pytest.raises(AssertionError, match="may be in the carpet"):
        explore(Budget(crashes=0, commands=1))


def test_the_model_notices_a_group_that_is_too_large() -> None:
    class Late(Model):
        def restarted(self, *given: object):  # type: ignore[no-untyped-def]
            self.group = 4
            yield from super().restarted(*given)  # type: ignore[arg-type]
            self.group = 1

    model = Late(TinyProgramme(1), Budget(crashes=0))
    with pytest.raises(AssertionError, match="are not durable"):
        model.explore()
