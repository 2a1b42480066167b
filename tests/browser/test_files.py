"""The project's files and everything out: written, downloaded, changed, mended, in conflict."""

import contextlib
import re
import shlex
import shutil
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner
from playwright.sync_api import Locator, Page, Route, expect
from studio_browser import Seen, Studio, open_view, until_file

from ilmek.cli import main
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.tasks import PathRequest, read_file

LINKAGE = "[bodies.ground.points]\nA0 = [0, 0]\n"
RECIPE = 'plain = "ivory"\nsize = "20x30cm"\npdf = false\n\n[[border]]\nyarn = "dark red"\nwidth = 3\n'


def product(page: Page, title: str) -> Locator:
    return page.get_by_role("listitem").filter(has=page.get_by_role("heading", name=title, exact=True))


def write(page: Page, title: str) -> Locator:
    """Write a product; its row."""
    row = product(page, title)
    row.get_by_role("button", name="Write").click()
    expect(row.get_by_text("up to date")).to_be_visible()
    return row


def downloaded(page: Page, row: Locator) -> bytes:
    with page.expect_download() as found:
        row.get_by_role("link", name=re.compile("^Download")).click()
    return Path(found.value.path()).read_bytes()


def by_command(running: Studio, row: Locator, folder: Path) -> Path:
    """What the command line of a product writes in a copy of the project."""
    shutil.copytree(running.project, folder, ignore=shutil.ignore_patterns("out", ".studio"))
    (folder / "out").mkdir()
    row.locator("summary").filter(has_text="Command line").click()
    command = row.locator("pre").inner_text()
    with contextlib.chdir(folder):
        result = CliRunner().invoke(main, shlex.split(command)[1:])
    assert result.exit_code == 0, result.output
    return folder / "out"


def test_the_page_of_a_machine_is_the_one_of_the_command_line(page: Page, running: Studio, tmp_path: Path) -> None:
    open_view(page, running, "files/machines/beat-up.toml")
    row = write(page, "Report page")
    expect(row.get_by_role("link", name="Show out/machine-beat-up.html")).to_be_visible()
    content = downloaded(page, row)
    assert content == (by_command(running, row, tmp_path / "copy") / "machine-beat-up.html").read_bytes()
    file = running.project / "machines" / "beat-up.toml"
    file.write_text(file.read_text() + "\n# changed by another program\n")
    expect(row.get_by_text("older than machines/beat-up.toml")).to_be_visible()


def test_the_chart_of_a_carpet_is_shown_and_packed(page: Page, running: Studio, tmp_path: Path) -> None:
    (running.project / "small.toml").write_text(RECIPE)
    open_view(page, running, "files")
    page.get_by_role("button", name="small").click()
    row = write(page, "Chart and yarn")
    expect(row.get_by_role("img", name="Preview of out/small-chart/carpet.png")).to_be_visible()
    with ZipFile(BytesIO(downloaded(page, row))) as packed:
        files = {name: packed.read(name) for name in packed.namelist()}
    out = by_command(running, row, tmp_path / "copy")
    made = {f"small-chart/{file.name}": file.read_bytes() for file in (out / "small-chart").glob("[!.]*")}
    assert "small-chart/chart.png" in files
    assert files == made
    page.get_by_role("button", name="Delete out/small-chart").click()
    expect(row.get_by_text("Not written yet")).to_be_visible()
    assert not (running.project / "out" / "small-chart").exists()


def tab_to(page: Page, name: str) -> None:
    """Press Tab until an element with a name has the focus."""
    named = "document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent"
    for _ in range(120):
        page.keyboard.press("Tab")
        if page.evaluate(named) == name:
            return
    raise AssertionError(f"Tab does not reach {name}")


def press(page: Page, name: str) -> None:
    tab_to(page, name)
    page.keyboard.press("Enter")


def test_files_come_and_go_by_keys_alone(page: Page, running: Studio) -> None:
    open_view(page, running, "files")
    heading = page.locator("#files-chosen")
    press(page, "New file: Linkages")
    expect(heading).to_have_text("new")
    press(page, "Duplicate")
    expect(heading).to_have_text("new-copy")
    press(page, "Rename")
    expect(page.get_by_label("New name")).to_be_focused()
    page.keyboard.type("çağrı 2")
    page.keyboard.press("Enter")
    expect(heading).to_have_text("çağrı 2")
    linkages = running.project / "linkages"
    assert (linkages / "çağrı 2.toml").read_text() == (linkages / "new.toml").read_text()
    assert not (linkages / "new-copy.toml").exists()
    press(page, "Delete")
    expect(page.get_by_text("linkages/çağrı 2.toml was deleted.")).to_be_visible()
    assert not (linkages / "çağrı 2.toml").exists()
    press(page, "Bring it back")
    expect(heading).to_have_text("çağrı 2")
    assert (linkages / "çağrı 2.toml").read_text() == (linkages / "new.toml").read_text()


@pytest.mark.parametrize(("button", "request_path"), [("Rename", "rename"), ("Delete", "delete")])
def test_a_file_that_goes_is_not_asked_for_again(
    page: Page, running: Studio, seen: Seen, button: str, request_path: str
) -> None:
    """The list of files without it may arrive before the answer to the request that took it away."""
    (running.project / "linkages" / f"{request_path}.toml").write_text(LINKAGE)
    open_view(page, running, f"files/linkages/{request_path}.toml")
    expect(page.locator("#files-chosen")).to_have_text(request_path)

    def late(route: Route) -> None:
        answer = route.fetch()
        with page.expect_response(re.compile(r"/api/project\?")):
            pass
        page.wait_for_timeout(300)  # time in which a wrong request would be sent
        route.fulfill(response=answer)

    page.route(f"**/api/project/{request_path}", late)
    page.get_by_role("button", name=button, exact=True).click()
    if button == "Rename":
        page.get_by_label("New name").fill("renamed")
        page.keyboard.press("Enter")
        expect(page.locator("#files-chosen")).to_have_text("renamed")
    else:
        expect(page.get_by_text(f"linkages/{request_path}.toml was deleted.")).to_be_visible()
    assert seen.faults == []


def test_a_new_file_of_each_kind_can_be_used(page: Page, running: Studio) -> None:
    open_view(page, running, "files")
    for kind, folder in (("Machines", "machines"), ("Syntheses", "synthesis"), ("Yarn lists", "yarns")):
        page.get_by_role("button", name=f"New file: {kind}").click()
        path = f"{folder}/new.toml"
        expect(page.locator("#files-chosen + span")).to_contain_text(path)
        assert read_file(PathRequest(path), Context(str(running.project))).error is None


def test_a_broken_file_is_mended_at_its_line(page: Page, running: Studio) -> None:
    file = running.project / "machines" / "cam.toml"
    good = file.read_text()
    file.write_text(good + 'lift = "20mm" "30mm"\n')
    line = good.count("\n") + 1
    open_view(page, running, "files")
    page.get_by_role("button", name=f"cam error in line {line}").click()
    page.get_by_role("button", name=f"Go to line {line}").click()
    text = page.get_by_label("Text of machines/cam.toml")
    assert text.evaluate("area => area.value.slice(area.selectionStart, area.selectionEnd)") == 'lift = "20mm" "30mm"'
    page.keyboard.press("Delete")
    until_file(running.project, "machines/cam.toml", good.rstrip())
    expect(page.get_by_role("button", name="cam", exact=True)).to_be_visible()
    assert "30mm" not in file.read_text()


@pytest.mark.parametrize("choice", ["Keep mine", "Take theirs"])
def test_two_changes_of_one_file_are_both_kept(page: Page, running: Studio, seen: Seen, choice: str) -> None:
    seen.expected = ("ERR_FAILED",)
    path = "cyclograms/press.toml"
    open_view(page, running, f"files/{path}")
    page.get_by_text("Text of the file").click()
    text = page.get_by_label(f"Text of {path}")
    expect(text).to_be_enabled()
    before = text.input_value()
    page.route("**/api/project/files/**", lambda route: route.abort())
    text.fill(before + "# mine\n")
    expect(page.get_by_text("Kept in this browser").first).to_be_visible()
    (running.project / path).write_text(before + "# theirs\n")
    page.unroute("**/api/project/files/**")
    dialog = page.get_by_role("dialog", name=f"{path} was changed twice")
    expect(dialog.get_by_text("# mine")).to_be_visible()
    expect(dialog.get_by_text("# theirs")).to_be_visible()
    assert (running.project / path).read_text() == before + "# theirs\n"
    dialog.get_by_role("button", name=choice).click()
    kept, other = ("# mine", "# theirs") if choice == "Keep mine" else ("# theirs", "# mine")
    until_file(running.project, path, kept)
    expect(text).to_have_value(re.compile(kept))
    page.get_by_role("button", name=re.compile("^Undo")).click()
    until_file(running.project, path, other)
