"""A study in a real browser: designs over ranges, one of which opens beside the present one or gives its values."""

from playwright.sync_api import Page, expect
from studio_browser import Studio, data_of, open_view, until_data, violations

FILE = "machines/beat-up.toml"


def ask(page: Page, varied: str, span: str, result: str, designs: int) -> None:
    """Choose what varies with its range, a result that is to be small, and the number of designs; begin."""
    page.get_by_role("tab", name="Study").click()
    page.get_by_label("Vary", exact=True).select_option(varied)
    page.get_by_label(varied, exact=True).last.fill(span)
    page.get_by_label("Result", exact=True).select_option(result)
    page.get_by_label("Designs", exact=False).first.fill(str(designs))
    page.get_by_role("button", name="Study", exact=True).click()


def test_a_design_of_a_study_opens_as_b_and_gives_its_values(page: Page, running: Studio) -> None:
    open_view(page, running, "machine/beat-up")
    before = data_of(running.project, FILE)["settings"]
    ask(page, "swing", "28deg..34deg", "drive_torque_max", 5)
    designs = page.get_by_role("application", name="Designs")
    expect(page.get_by_text("5 designs, 5 made")).to_be_visible()
    expect(page.get_by_text("drive_torque_max over swing").first).to_be_visible()
    designs.press("ArrowRight")
    expect(designs).to_contain_text("ilmek design beat-up")
    page.get_by_role("button", name="Open as B").click()
    assert data_of(running.project, FILE)["settings"] == before
    expect(page.locator(".machine-difference")).to_contain_text("swing")
    designs.press("ArrowRight")
    page.get_by_role("button", name="Take its values").click()
    until_data(running.project, FILE, lambda data: str(data["settings"].get("swing", "")).startswith("29.5"))
    assert violations(page) == []


def test_a_mechanism_is_studied_over_its_values(page: Page, running: Studio) -> None:
    open_view(page, running, "linkage/slider-crank-press")
    file = "linkages/slider-crank-press.toml"
    name = next(iter(data_of(running.project, file)["values"]))
    ask(page, name, "56mm..64mm", "drive_torque_rms", 4)
    expect(page.get_by_text("4 designs, 4 made")).to_be_visible()
    page.get_by_role("application", name="Designs").press("ArrowRight")
    page.get_by_role("button", name="Take its values").click()
    until_data(running.project, file, lambda data: data["values"][name] == "56mm")
