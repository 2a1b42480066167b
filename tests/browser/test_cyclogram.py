"""A cyclogram in a real browser: a motion is dragged, a rule turns red, the solver answers, undo brings all back."""

import re

import pytest
from playwright.sync_api import Page, expect
from studio_browser import Seen, Studio, data_of, middle, open_view, until_data, until_file, violations


@pytest.fixture
def press(page: Page, running: Studio, request: pytest.FixtureRequest) -> str:
    """The path of a copy of the press for one test, opened."""
    name = request.node.name.replace("_", "-")
    path = f"cyclograms/{name}.toml"
    (running.project / path).write_bytes((running.project / "cyclograms/press.toml").read_bytes())
    open_view(page, running, f"cyclogram/{name}")
    expect(page.locator(".cyclogram-lanes .bar").first).to_be_visible()
    return path


def test_a_motion_is_dragged_until_a_rule_is_violated(page: Page, running: Studio, press: str) -> None:
    before = data_of(running.project, press)
    x, y = middle(page, ".cyclogram-lanes .bar", 1)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 200, y, steps=6)
    expect(page.get_by_text("1 check fails")).to_be_visible()
    expect(page.get_by_text("both present").first).to_be_attached()
    page.mouse.up()
    until_data(running.project, press, lambda data: data != before)
    page.get_by_label("Undo (Ctrl+Z)").click()
    expect(page.get_by_text("Every check holds")).to_be_visible()
    until_data(running.project, press, lambda data: data == before)


def test_the_solver_names_what_binds_and_its_solution_is_taken(page: Page, running: Studio, press: str) -> None:
    before = data_of(running.project, press)
    page.get_by_role("button", name="Least acceleration").click()
    solution = page.get_by_label("Solution")
    expect(solution.get_by_text("never both die in the tool and feeder in the tool")).to_be_visible()
    assert violations(page) == []
    solution.get_by_role("button", name="Take the solution").click()
    expect(solution).to_have_count(0)
    until_data(running.project, press, lambda data: data != before)
    page.get_by_label("Undo (Ctrl+Z)").click()
    until_data(running.project, press, lambda data: data == before)


def test_an_end_is_moved_by_keys(page: Page, running: Studio, press: str) -> None:
    page.get_by_role("button", name=re.compile("^End of ejector, back at")).press("ArrowRight")
    until_file(running.project, press, "336deg")


def test_a_cyclogram_is_built_from_nothing(page: Page, running: Studio) -> None:
    open_view(page, running, "cyclogram")
    page.get_by_role("button", name="New", exact=True).click()
    page.wait_for_url(re.compile("#cyclogram/cyclogram$"))
    path = "cyclograms/cyclogram.toml"
    page.get_by_role("button", name="Add a track").click()
    second = page.locator("details[open]", has_text="track 2")
    second.get_by_role("button", name="Add a motion and its return").click()
    page.get_by_role("button", name="Add a relation").click()
    rules = page.locator(".cyclogram-rules")
    expect(rules.get_by_text("track 2: motion 1 starts after track 1: out ends")).to_be_visible()
    rules.get_by_label("Gap at least").fill("90deg")
    expect(rules.get_by_text(re.compile("missing$"))).to_be_visible()
    assert violations(page) == []
    second.get_by_label("Name", exact=True).first.fill("slide")
    page.keyboard.press("Enter")
    until_data(running.project, path, lambda data: "slide" in data["tracks"])
    made = data_of(running.project, path)
    assert made["relations"] == [
        {"then": {"track": "slide", "starts": "motion 1"}, "first": {"track": "track 1", "ends": "out"}, "gap": "90deg"}
    ]
    page.locator("details[open]", has_text="slide").get_by_role("button", name="Remove the track").click()
    until_data(running.project, path, lambda data: list(data["tracks"]) == ["track 1"] and "relations" not in data)


def test_a_broken_file_states_its_line_and_keeps_the_view(page: Page, running: Studio, seen: Seen) -> None:
    seen.expected = ("422",)
    text = (running.project / "cyclograms/press.toml").read_text(encoding="utf-8")
    (running.project / "cyclograms/no-toml.toml").write_text('period = "1s"\nperiod = = 3\n', encoding="utf-8")
    (running.project / "cyclograms/overlap.toml").write_text(text.replace('"85deg"', '"70deg"'), encoding="utf-8")
    open_view(page, running, "cyclogram/overlap")
    expect(page.get_by_text("out starts at 70 deg, before in ends at 80 deg")).to_be_visible()
    open_view(page, running, "cyclogram/no-toml")
    expect(page.get_by_text("no-toml.toml, line 2")).to_be_visible()
    page.get_by_role("button", name="Open Files").click()
    page.wait_for_url(re.compile("#files/cyclograms/no-toml.toml"))
