"""A browser that lacks what the page needs shows a notice instead of an empty page."""

import pytest
from playwright.sync_api import Browser, Page, Route, expect
from studio_browser import Studio, context_of


@pytest.mark.parametrize("lacking", ["delete window.structuredClone", "CSS.supports = () => false"])
def test_a_browser_without_a_feature_is_told(browser: Browser, running: Studio, lacking: str) -> None:
    with context_of(browser) as context:
        page = context.new_page()
        page.add_init_script(lacking)
        page.goto(running.address)
        expect(page.locator("#old-browser")).to_be_visible()


def test_a_browser_that_cannot_read_the_script_is_told(browser: Browser, running: Studio) -> None:
    def newer(route: Route) -> None:
        route.fulfill(body="let a = #newer;", content_type="text/javascript")

    with context_of(browser) as context:
        page = context.new_page()
        page.route("**/assets/index-*.js", newer)
        page.goto(running.address)
        expect(page.locator("#old-browser")).to_be_visible()


def test_a_browser_of_today_is_not(page: Page) -> None:
    page.wait_for_selector("main[data-ready='true']")
    expect(page.locator("#old-browser")).to_be_hidden()
