"""A cyclogram in a real browser: a motion is dragged, a rule turns red, the solver answers, undo brings all back."""

import re

from playwright.sync_api import Page, expect
from studio_browser import PATIENCE, Studio, data_of, middle, open_view, until_file, violations

FILE = "cyclograms/press.toml"


def test_a_motion_is_dragged_until_a_rule_is_violated(page: Page, running: Studio) -> None:
    open_view(page, running, "cyclogram/press")
    bars = page.locator(".cyclogram-lanes .bar")
    expect(bars.first).to_be_visible(timeout=PATIENCE)
    before = data_of(running.project, FILE)
    x, y = middle(page, ".cyclogram-lanes .bar", 1)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 200, y, steps=6)
    expect(page.get_by_text(re.compile("violated$")).first).to_be_visible(timeout=PATIENCE)
    expect(page.get_by_text("both present").first).to_be_attached()
    page.mouse.up()
    page.get_by_label("Undo (Ctrl+Z)").click()
    expect(page.get_by_text("All hold")).to_be_visible(timeout=PATIENCE)
    assert data_of(running.project, FILE) == before


def test_the_solver_names_what_binds_and_its_solution_is_taken(page: Page, running: Studio) -> None:
    open_view(page, running, "cyclogram/press")
    page.get_by_role("button", name="Least acceleration").click(timeout=PATIENCE)
    solution = page.get_by_label("Solution")
    expect(solution.get_by_text("never both die in the tool and feeder in the tool")).to_be_visible(timeout=PATIENCE)
    assert violations(page) == []
    before = data_of(running.project, FILE)
    solution.get_by_role("button", name="Take the solution").click()
    expect(solution).to_have_count(0, timeout=PATIENCE)
    expect(page.get_by_label("Undo (Ctrl+Z)")).to_be_enabled(timeout=PATIENCE)
    expect(page.get_by_text("Saved")).to_be_visible(timeout=PATIENCE)
    assert data_of(running.project, FILE) != before
    page.get_by_label("Undo (Ctrl+Z)").click()
    until_file(running.project, FILE, before["tracks"]["die"]["motions"]["down"]["start"])


def test_an_end_is_moved_by_keys(page: Page, running: Studio) -> None:
    open_view(page, running, "cyclogram/press")
    end = page.get_by_role("button", name=re.compile("^End of ejector, back at"))
    expect(end).to_be_visible(timeout=PATIENCE)
    end.focus()
    page.keyboard.press("ArrowRight")
    until_file(running.project, FILE, "336deg")
