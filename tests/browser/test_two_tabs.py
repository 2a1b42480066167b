"""Two tabs on one project, another program beside them, and a server that is lost during an edit."""

import re

import pytest
from playwright.sync_api import Browser, Locator, Page, expect
from studio_browser import Seen, Studio, context_of, open_view, settled, until_file

FILE = "machines/beat-up.toml"


def _field(page: Page) -> Locator:
    return page.get_by_role("textbox", name=re.compile("^swing"))


def _swing(page: Page) -> str:
    return _field(page).input_value()


def _type_swing(page: Page, value: str) -> None:
    field = _field(page)
    field.fill(value)
    field.press("Enter")


@pytest.fixture
def machine(page: Page, running: Studio) -> Page:
    open_view(page, running, "machine/beat-up")
    return page


def test_an_edit_is_in_the_file_and_in_the_other_tab(browser: Browser, running: Studio, machine: Page) -> None:
    with context_of(browser) as context:
        other = context.new_page()
        open_view(other, running, "machine/beat-up")
        _type_swing(machine, "31deg")
        until_file(running.project, FILE, "31deg")
        expect(_field(other)).to_have_value(re.compile("^31"))


def test_undo_is_there_after_a_reload(running: Studio, machine: Page) -> None:
    before = _swing(machine)
    _type_swing(machine, "33deg")
    until_file(running.project, FILE, "33deg")
    machine.reload()
    open_view(machine, running, "machine/beat-up")
    machine.get_by_role("button", name=re.compile("^Undo")).first.click()
    expect(_field(machine)).to_have_value(before)


def test_an_edit_survives_a_server_that_is_killed(running: Studio, machine: Page, seen: Seen) -> None:
    seen.expected = (
        "ERR_CONNECTION_REFUSED",
        "WebSocket connection",
        "ERR_EMPTY_RESPONSE",
        "ERR_CONNECTION_RESET",
        "ERR_INCOMPLETE",
    )
    running.kill()
    _type_swing(machine, "34deg")
    expect(machine.get_by_role("status").filter(has_text=re.compile("server|connection", re.I)).first).to_be_visible()
    running.restart()
    until_file(running.project, FILE, "34deg")
    settled(machine)
    assert _swing(machine).startswith("34")


def test_a_change_of_another_program_is_shown(running: Studio, machine: Page) -> None:
    path = running.project / FILE
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r'swing = ".*?"', 'swing = "29deg"', text), encoding="utf-8")
    expect(_field(machine)).to_have_value(re.compile("^29"))
