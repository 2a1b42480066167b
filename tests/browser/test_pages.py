"""Pages of machines in a real browser: the client draws their figures, and without scripts and in print they stand."""

from pathlib import Path

import numpy as np
import pytest
from default_machines import default_page, default_report, page_data
from playwright.sync_api import Browser, Page, expect
from studio_browser import Seen, context_of, violations

from ilmek.report import Animation, Axis, DesignCloud, Plot, Report
from ilmek.units import deg, mm
from ilmek.viz.page import machine_page


def opened(page: Page, seen: Seen, folder: Path, machine: str) -> list[dict[str, object]]:
    """Open the page of a machine, and return the data of its figures."""
    text = default_page(machine)[0]
    file = folder / f"{machine}.html"
    file.write_text(text, encoding="utf-8")
    seen.watch(page, file.as_uri())
    page.goto(file.as_uri())
    return page_data(text)


@pytest.mark.parametrize("dark", [False, True])
def test_the_slider_moves_the_machine_and_the_cursors_of_its_charts(
    browser: Browser, seen: Seen, tmp_path: Path, dark: bool
) -> None:
    report = default_report("beat-up")
    with context_of(browser, dark=dark) as context:
        page = context.new_page()
        page.emulate_media(reduced_motion="reduce")
        opened(page, seen, tmp_path, "beat-up")
        stage, charts = page.locator(".motion .stage figure"), page.locator(".motion .charts figure")
        stage.scroll_into_view_if_needed()
        expect(stage).to_have_class("shown drawn")
        expect(stage.locator(".still")).to_be_hidden()
        before = stage.locator("canvas").nth(1).screenshot()
        slider = stage.get_by_role("slider", name="crank angle")
        slider.focus()
        for _ in range(8):
            page.keyboard.press("PageUp")
        angle = float(slider.input_value())
        distance = next(one for one in report.figures if isinstance(one, Plot) and one.name == "beater-travel")
        (curve,) = distance.series
        expect(charts.first.locator("b").last).to_have_text(f"{float(np.interp(angle, curve.x, curve.y)) / mm:.4g} mm")
        assert stage.locator("canvas").nth(1).screenshot() != before
        stage.get_by_role("button", name="Play").click()
        page.wait_for_function(
            "([angle]) => Math.abs(document.querySelector('.motion .live').shadowRoot.querySelector('input').value"
            " - angle) > 0.2",
            arg=[angle],
        )
        stage.get_by_role("button", name="Pause").click()
        assert violations(page) == []
    assert seen.faults == []


def test_without_scripts_and_in_print_a_page_has_the_figures_that_stand(
    browser: Browser, seen: Seen, tmp_path: Path
) -> None:
    figures = default_report("weft").figures
    readings = [one for figure in figures if isinstance(figure, Animation) for one in figure.readings]
    with context_of(browser) as context:
        page = context.new_page()
        opened(page, seen, tmp_path, "weft")
        page.locator("figure.shown").first.scroll_into_view_if_needed()
        expect(page.locator("figure.drawn").first).to_be_visible()
        page.emulate_media(media="print")
        expect(page.locator(".live").first).to_be_hidden()
        expect(page.locator("figure .still > .scroll > svg").first).to_be_visible()
    plain = browser.new_context(java_script_enabled=False)
    page = plain.new_page()
    page.goto((tmp_path / "weft.html").as_uri())
    assert page.locator("figure .still > .scroll > svg").count() == len(figures)
    expect(page.locator("figure .still > .scroll > svg").first).to_be_visible()
    expect(page.locator(".readings dt").first).to_have_text(readings[0].label)
    plain.close()
    assert seen.faults == []


def test_a_cyclogram_tells_position_velocity_and_acceleration_at_the_cursor(
    browser: Browser, seen: Seen, tmp_path: Path
) -> None:
    with context_of(browser) as context:
        page = context.new_page()
        data = opened(page, seen, tmp_path, "weaver")
        timing = next(one["timing"] for one in data if one["timing"])
        assert isinstance(timing, dict)
        figure = page.locator("figure.shown.wide").first
        figure.scroll_into_view_if_needed()
        field = figure.get_by_role("slider")
        field.focus()
        page.keyboard.press("Home")
        for _ in range(4):
            page.keyboard.press("PageUp")
        assert float(field.get_attribute("aria-valuenow") or 0) == pytest.approx(40 * deg)
        rows = figure.locator("tbody tr")
        expect(rows).to_have_count(len(timing["lanes"]))
        for row, lane in enumerate(timing["lanes"]):
            moving = any(move["start"] <= 40 * deg < move["end"] for move in lane["moves"])
            said = rows.nth(row).locator("td").nth(0)
            expect(said).not_to_have_text("dwell") if moving else expect(said).to_have_text("dwell")
        path = figure.locator(".fig-svg path").first
        before = path.get_attribute("d")
        figure.locator(".fig-orders").get_by_role("button", name="Acceleration").click()
        expect(path).not_to_have_attribute("d", before or "")
        assert violations(page) == []
    assert seen.faults == []


def test_designs_of_a_study_are_kept_by_ranges_and_have_their_command(
    browser: Browser, seen: Seen, tmp_path: Path
) -> None:
    values = np.array([0.01, 0.02, 0.03, 0.04]), np.array([4.0, 3.0, 2.0, 1.0])
    columns, commands = (Axis("crank", "mm"), Axis("torque", "N*m")), tuple(f"ilmek design {n}" for n in "abcd")
    cloud = DesignCloud("d", "Designs", columns, values, ("front", "holds"), np.array([1, 0, 0, 1]), commands)
    file = tmp_path / "study.html"
    file.write_text(machine_page(Report("study", "Study", {}, (), (), figures=(cloud,))), encoding="utf-8")
    with context_of(browser) as context:
        page = context.new_page()
        seen.watch(page, file.as_uri())
        page.goto(file.as_uri())
        designs = page.get_by_role("application", name="Designs")
        designs.scroll_into_view_if_needed()
        expect(designs.get_by_text("4 of 4 designs")).to_be_visible()
        box = designs.locator(".fig-field").first.bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 64, box["y"] + 20)  # the first axis, its upper half
        page.mouse.down()
        page.mouse.move(box["x"] + 64, box["y"] + 140, steps=3)
        page.mouse.up()
        expect(designs.get_by_text("2 of 4 designs")).to_be_visible()
        designs.focus()
        page.keyboard.press("ArrowRight")
        expect(designs.locator("pre")).to_have_text("ilmek design c")
        page.keyboard.press("Escape")
        designs.get_by_role("button", name="holds (2)").click()
        expect(designs.get_by_text("2 of 4 designs")).to_be_visible()
        assert violations(page) == []
    assert seen.faults == []
