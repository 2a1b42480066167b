"""The carpet in a real browser: a dropped picture, the chart that follows, edits of the recipe, rows to weave by."""

import re
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import Page, expect
from processes import PATIENCE, ilmek, start, until
from studio_browser import Seen, Studio, data_of, middle, open_view, until_file, violations

from ilmek.io.yarn_file import default_yarns

DROP = """([name, bytes]) => {
  const data = new DataTransfer();
  data.items.add(new File([Uint8Array.from(bytes)], name));
  const view = document.querySelector('.carpet-view');
  for (const kind of ['dragover', 'drop'])
    view.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""
LOSE = """new Promise(done => {
  const canvas = document.querySelector('.carpet-surface canvas');
  const context = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
  canvas.addEventListener('webglcontextlost', () => setTimeout(() => context.restoreContext()));
  canvas.addEventListener('webglcontextrestored', () => done());
  context.loseContext();
})"""
AT_KNOT = re.compile(r"Row (\d+) from below, knot (\d+) from the left: (.+) \((.)\)")


def _picture(mode: str = "RGB") -> bytes:
    """A drawing of four stripes."""
    drawing = Image.new("RGB", (80, 120), "#9e2b25")
    for number, colour in enumerate(("#1b2a4e", "#efe5cf", "#d9a441")):
        drawing.paste(colour, (0, 30 * number, 80, 30 * number + 30))
    file = BytesIO()
    drawing.convert(mode).save(file, "PNG")
    return file.getvalue()


def _drop(page: Page, name: str, content: bytes) -> None:
    page.evaluate(DROP, [name, list(content)])


def _set(page: Page, label: str, value: str) -> None:
    field = page.get_by_label(label, exact=True)
    field.fill(value)
    field.press("Enter")


def _tool(page: Page, name: str) -> None:
    page.get_by_role("toolbar").get_by_role("button", name=name).click()


def _status(page: Page, text: str | re.Pattern[str]) -> str:
    """The line below the chart, once it has a text."""
    line = page.locator(".carpet-status")
    expect(line).to_contain_text(text)
    return line.inner_text()


def _edits(running: Studio) -> list[str]:
    found: list[str] = data_of(running.project, "carpet.toml").get("edits", [])
    return found


def _until_drawn(page: Page) -> None:
    """Wait until the canvas shows more than its ground."""
    canvas = page.locator(".carpet-surface canvas")

    def colours() -> int:
        return len(Image.open(BytesIO(canvas.screenshot())).convert("RGB").reduce(8).getcolors(100_000) or ())

    until(lambda: colours() > 10, "the chart")


@pytest.fixture
def carpet(page: Page, running: Studio) -> Page:
    open_view(page, running, "carpet")
    return page


def test_a_dropped_picture_and_a_size_are_in_the_recipe(carpet: Page, running: Studio) -> None:
    _drop(carpet, "stripes.png", _picture())
    until_file(running.project, "carpet.toml", "pictures/stripes.png")
    assert (running.project / "pictures/stripes.png").read_bytes() == _picture()
    _set(carpet, "Size", "40x60cm")
    _status(carpet, "100 knots across, 150 rows")
    until_file(running.project, "carpet.toml", "40x60cm")
    carpet.locator("input[type=file]").set_input_files(
        {"name": "again.png", "mimeType": "image/png", "buffer": _picture()}
    )
    until_file(running.project, "carpet.toml", "pictures/again.png")


def test_what_is_no_picture_is_refused_and_loses_nothing(carpet: Page, running: Studio, seen: Seen) -> None:
    seen.expected = ("status of 422",)
    before = (running.project / "carpet.toml").read_text(encoding="utf-8")
    for name, content in {"empty.png": b"", "letter.pdf": b"%PDF-1.7"}.items():
        _drop(carpet, name, content)
        refused = re.compile(rf"{name} is (no picture|damaged)")
        expect(carpet.get_by_role("alert").filter(has_text=refused)).to_be_visible()
    assert (running.project / "carpet.toml").read_text(encoding="utf-8") == before
    _status(carpet, re.compile(r"knots across"))


def test_a_stroke_is_an_edit_that_undo_takes_out(carpet: Page, running: Studio) -> None:
    before = _edits(running)
    _tool(carpet, "Pencil")
    carpet.get_by_role("button", name="Single knots").click()
    x, y = middle(carpet, ".carpet-surface")
    carpet.mouse.move(x, y)
    found = AT_KNOT.search(_status(carpet, AT_KNOT))
    assert found is not None
    carpet.get_by_label("Yarn", exact=True).select_option("sage green")
    carpet.mouse.click(x, y)
    until_file(running.project, "carpet.toml", f"set {found[1]},{found[2]} sage green")
    expect(carpet.locator(".carpet-status")).to_contain_text("sage green")
    carpet.keyboard.press("Control+z")
    expect(carpet.locator(".carpet-status")).to_contain_text(found[3])
    assert _edits(running) == before


def test_each_tool_works_by_keys_and_each_edit_is_taken_out(carpet: Page, running: Studio) -> None:
    surface = carpet.locator(".carpet-surface")
    to_whole = carpet.get_by_role("button", name="On the whole carpet")
    two_ends = ("ArrowUp", "Enter", "Shift+ArrowUp", "Shift+ArrowLeft", "Enter")
    for tool, keys, whole, edit in (
        ("Line", two_ends, False, r"line \d+,\d+ \d+,\d+ \S+"),
        ("Fill", ("Enter",), False, r"fill \d+,\d+ \S+"),
        ("Mirror", two_ends, False, r"mirror across in \d+,\d+ \d+,\d+"),
        ("Repeat", two_ends, True, r"repeat \d+,\d+ \d+,\d+"),
        ("Border", (), True, r"border 3 \S+"),
    ):
        _tool(carpet, tool)
        for key in keys:
            surface.press(key)
        if whole:
            to_whole.click()
        tab = carpet.get_by_role("tab", name=re.compile("^Edits"))
        tab.click()
        expect(carpet.locator(".carpet-edits code").first).to_have_text(re.compile(f"^{edit}"))
    until_file(running.project, "carpet.toml", "border 3")
    assert len(_edits(running)) == 5
    carpet.get_by_role("button", name="Take edit 2 out").click()
    expect(carpet.locator(".carpet-edits li")).to_have_count(4)
    assert violations(carpet) == []
    carpet.get_by_role("button", name="Take all edits out").click()
    expect(tab).to_have_text("Edits (0)")
    expect(carpet.locator(".project-saved.saved")).to_be_visible()
    assert _edits(running) == []


def test_the_crop_is_set_by_keys(carpet: Page, running: Studio) -> None:
    carpet.get_by_role("button", name="Crop the picture").click()
    corner = carpet.get_by_role("button", name=re.compile("^Lower right corner"))
    for key in ("Shift+ArrowLeft", "Shift+ArrowUp"):
        corner.press(key)
    assert violations(carpet) == []
    carpet.get_by_role("button", name="Apply").click()
    until_file(running.project, "carpet.toml", "crop = ")
    carpet.keyboard.press("Control+z")
    expect(carpet.locator(".carpet-side")).to_contain_text("whole picture")


def test_a_knot_is_that_of_the_command_line(carpet: Page, running: Studio, tmp_path: Path) -> None:
    recipe, out = running.project / "carpet.toml", tmp_path / "chart"
    with start(ilmek("chart", recipe, "--no-pdf", "--rows", "none", "--out", out)) as charting:
        carpet.get_by_role("button", name="Single knots").click()
        surface = carpet.locator(".carpet-surface")
        surface.press("ArrowUp")
        begin = AT_KNOT.search(_status(carpet, AT_KNOT))
        assert begin is not None
        for key in ("Shift+ArrowUp", "ArrowLeft", "Shift+ArrowLeft"):
            surface.press(key)
        at_cursor = _status(carpet, f"Row {int(begin[1]) + 10} from below, knot {int(begin[2]) - 11} from")
        carpet.mouse.move(*middle(carpet, ".carpet-marks .cursor"))
        expect(carpet.locator(".carpet-status")).to_have_text(at_cursor)
        charting.communicate(timeout=PATIENCE)
        assert charting.returncode == 0
    found = AT_KNOT.search(at_cursor)
    assert found is not None
    colour_of = {yarn.name: yarn.hex for yarn in default_yarns()}
    chart = Image.open(out / "chart.png").convert("RGB")
    rgb = chart.getpixel((int(found[2]) - 1, chart.height - int(found[1])))
    assert colour_of[found[3]] == "#{:02x}{:02x}{:02x}".format(*rgb)


def test_the_weaver_goes_on_where_the_page_was_left(carpet: Page, running: Studio) -> None:
    carpet.get_by_role("button", name="Weaver's view").click()
    weaver = carpet.locator(".carpet-weaver")
    expect(weaver).to_be_focused()
    for key in ("ArrowUp", "ArrowUp", "ArrowDown", "ArrowUp", "ArrowUp"):
        weaver.press(key)
    heading = weaver.get_by_role("heading")
    expect(heading).to_contain_text(re.compile("^Row 4 of"))
    expect(weaver.locator("[aria-current=step]")).to_have_count(1)
    assert violations(carpet) == []
    carpet.reload()
    open_view(carpet, running, "carpet")
    carpet.get_by_role("button", name="Weaver's view").click()
    expect(heading).to_contain_text(re.compile("^Row 4 of"))
    expect(weaver).to_be_focused()
    carpet.keyboard.press("Escape")
    expect(carpet.locator(".carpet-surface")).to_be_visible()
    _until_drawn(carpet)
    carpet.evaluate(LOSE)
    _until_drawn(carpet)
