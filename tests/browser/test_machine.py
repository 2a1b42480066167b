"""The form of a machine in a real browser: typed and dragged values, failing checks, A and B, a new machine, undo."""

import json
import re

from click.testing import CliRunner
from playwright.sync_api import Page, Response, expect
from studio_browser import Seen, Studio, data_of, open_view, until_data, until_file, violations

from ilmek.cli import main

FILE = "machines/beat-up.toml"


def type_value(page: Page, label: str, value: str) -> None:
    """Type a value into a field of the form, and end it by Enter."""
    field = page.get_by_label(label, exact=True)
    field.fill(value)
    field.press("Enter")


def badge(page: Page, words: str) -> None:
    """Wait until the verdict has these words."""
    expect(page.locator(".ui-verdict .ui-badge")).to_have_text(words)


def test_values_are_typed_in_any_unit_and_one_out_of_bounds_is_refused(page: Page, running: Studio, seen: Seen) -> None:
    seen.expected = ("status of 422",)
    open_view(page, running, "machine/beat-up")
    type_value(page, "swing", "31deg")
    until_file(running.project, FILE, 'swing = "31deg"')
    type_value(page, "swing", "0.5rad")
    until_file(running.project, FILE, 'swing = "0.5rad"')
    expect(page.get_by_text("read as 28.648°")).to_be_visible()
    type_value(page, "swing", "200deg")
    refusal = page.get_by_role("alert").filter(has_text="swing=200 deg")
    expect(refusal).to_contain_text("above 0 deg, below 180 deg")
    assert page.get_by_label("swing", exact=True).get_attribute("aria-invalid") == "true"
    assert data_of(running.project, FILE)["settings"]["swing"] == "0.5rad"
    page.get_by_label("swing", exact=True).press("Escape")
    expect(page.get_by_label("swing", exact=True)).to_have_value("0.5 rad")
    expect(refusal).to_have_count(0)


def test_a_slider_is_moved_by_keys_a_check_turns_and_undo_brings_it_back(page: Page, running: Studio) -> None:
    open_view(page, running, "machine/beat-up")
    type_value(page, "swing", "30deg")
    until_file(running.project, FILE, 'swing = "30deg"')
    badge(page, "Every check holds")
    slider = page.get_by_role("slider", name="Adjust swing")
    slider.press("ArrowRight")
    until_data(running.project, FILE, lambda data: data["settings"]["swing"] not in ("30deg", "90deg"))
    type_value(page, "swing", "90deg")
    badge(page, "1 check fails")
    failing = page.get_by_role("list", name="Checks").get_by_role("listitem").first
    expect(failing).to_contain_text("Fails.")
    assert violations(page) == []
    until_file(running.project, FILE, 'swing = "90deg"')
    slider.focus()
    page.keyboard.press("Control+z")
    badge(page, "Every check holds")
    until_data(running.project, FILE, lambda data: data["settings"]["swing"] != "90deg")
    page.keyboard.press("Control+y")
    badge(page, "1 check fails")


def test_two_settings_are_compared_and_switched(page: Page, running: Studio) -> None:
    open_view(page, running, "machine/beat-up")
    type_value(page, "swing", "30deg")
    until_file(running.project, FILE, 'swing = "30deg"')
    page.get_by_role("button", name="Keep this as B").first.click()
    type_value(page, "swing", "40deg")
    page.get_by_role("tab", name="Compare A and B").click()
    row = page.get_by_role("region", name="Parameters").get_by_role("row").filter(has_text="swing").first
    expect(row).to_contain_text("40 deg")
    expect(row).to_contain_text("30 deg")
    expect(row).to_contain_text("+33.3 %")
    page.get_by_role("button", name="Switch A and B").first.click()
    until_file(running.project, FILE, 'swing = "30deg"')
    expect(row.get_by_role("cell").first).to_have_text("30 deg")


def test_a_machine_of_the_catalogue_is_opened_with_the_results_of_the_command_line(page: Page, running: Studio) -> None:
    open_view(page, running, "machine/beat-up")

    def is_view(response: Response) -> bool:
        return response.url.endswith("/machines/hammer/view")

    with page.expect_response(is_view) as answered:
        page.locator(".machine-chooser").select_option("new:hammer")
    page.wait_for_url(re.compile("#machine/hammer$"))
    seen = {one["name"]: one for one in answered.value.json()["results"]}
    page.get_by_role("tab", name="Results").click()
    page.get_by_role("button", name=re.compile(r"^Show all \(")).click()
    rows = page.get_by_role("region", name="Results").get_by_role("row")
    expect(rows).to_have_count(len(seen) + 1)
    shown = page.evaluate(
        "[...document.querySelectorAll('main tbody tr')].map(row => [row.cells[2].innerText, row.cells[1].innerText])"
    )
    assert shown == [[name, one["text"]] for name, one in seen.items()]
    written = CliRunner().invoke(main, ["design", str(running.project / "machines/hammer.toml"), "--json", "-"])
    results = json.loads(written.stdout)["results"]
    numbers = {name: one["value"] for name, one in seen.items() if one["value"] is not None}
    assert numbers == {name: results[name] for name in numbers}
    page.get_by_role("button", name="Command line and Python").click()
    expect(page.get_by_text(re.compile("^ilmek design hammer"))).to_be_visible()
    page.keyboard.press("Escape")
    page.get_by_label("What each parameter does").check()
    expect(page.locator(".machine-strip:visible").first).to_be_visible()
