"""A cyclogram in a real browser: a motion is dragged, a rule turns red, the solver answers, undo brings all back."""

import re

import pytest
from playwright.sync_api import Page, expect
from studio_browser import PATIENCE, Studio, data_of, middle, open_view, until_data, until_file, violations


@pytest.fixture
def press(page: Page, running: Studio, request: pytest.FixtureRequest) -> str:
    """The path of a copy of the press for one test, opened."""
    name = request.node.name.replace("_", "-")
    path = f"cyclograms/{name}.toml"
    (running.project / path).write_bytes((running.project / "cyclograms/press.toml").read_bytes())
    open_view(page, running, f"cyclogram/{name}")
    expect(page.locator(".cyclogram-lanes .bar").first).to_be_visible(timeout=PATIENCE)
    return path


def test_a_motion_is_dragged_until_a_rule_is_violated(page: Page, running: Studio, press: str) -> None:
    before = data_of(running.project, press)
    x, y = middle(page, ".cyclogram-lanes .bar", 1)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 200, y, steps=6)
    expect(page.get_by_text("1 of 9 violated")).to_be_visible(timeout=PATIENCE)
    expect(page.get_by_text("both present").first).to_be_attached()
    page.mouse.up()
    until_data(running.project, press, lambda data: data != before)
    page.get_by_label("Undo (Ctrl+Z)").click()
    expect(page.get_by_text("All hold")).to_be_visible(timeout=PATIENCE)
    until_data(running.project, press, lambda data: data == before)


def test_the_solver_names_what_binds_and_its_solution_is_taken(page: Page, running: Studio, press: str) -> None:
    before = data_of(running.project, press)
    page.get_by_role("button", name="Least acceleration").click()
    solution = page.get_by_label("Solution")
    expect(solution.get_by_text("never both die in the tool and feeder in the tool")).to_be_visible(timeout=PATIENCE)
    assert violations(page) == []
    solution.get_by_role("button", name="Take the solution").click()
    expect(solution).to_have_count(0)
    until_data(running.project, press, lambda data: data != before)
    page.get_by_label("Undo (Ctrl+Z)").click()
    until_data(running.project, press, lambda data: data == before)


def test_an_end_is_moved_by_keys(page: Page, running: Studio, press: str) -> None:
    page.get_by_role("button", name=re.compile("^End of ejector, back at")).press("ArrowRight")
    until_file(running.project, press, "336deg")
