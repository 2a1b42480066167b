"""Drawing on the chart in a real browser: yarns by hand, specks, brushes, copies, motifs, borders, as in the recipe."""

import re
from io import BytesIO

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page, expect
from studio_browser import Studio, data_of, middle, open_view, settled, until_data, until_file, violations

from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

COLOURS = ("#9e2b25", "#1b2a4e", "#efe5cf", "#d9a441")


def _stripes() -> bytes:
    """Four stripes, and a lone pixel in the first one: 80 x 120 pixels."""
    drawn = np.repeat([list(bytes.fromhex(colour[1:])) for colour in COLOURS], 30, axis=0).astype(np.uint8)
    drawn = np.repeat(drawn[:, None], 80, axis=1)
    drawn[10, 10] = drawn[-1, -1]
    file = BytesIO()
    Image.fromarray(drawn).save(file, "PNG")
    return file.getvalue()


@pytest.fixture
def carpet(page: Page, running: Studio) -> Page:
    """The view on a recipe of the stripes, a pixel a knot."""
    (running.project / "pictures/stripes.png").write_bytes(_stripes())
    recipe = 'picture = "pictures/stripes.png"\nsize = "32x48cm"\nquality = "25x25/dm"\nleast_patch = 0\n'
    recipe += "".join(f'[[yarn]]\nname = "{yarn.name}"\nsrgb = "{yarn.hex}"\n' for yarn in default_yarns())
    (running.project / "carpet.toml").write_text(recipe, encoding="utf-8")
    open_view(page, running, "carpet")
    expect(page.locator(".carpet-status")).to_contain_text("80 knots across, 120 rows")
    settled(page)  # the chart lies where it stays: what is pressed in it is what is meant
    return page


def _edits(running: Studio, number: int) -> list[str]:
    """The edits of the recipe, once there are so many."""
    until_data(running.project, "carpet.toml", lambda data: len(data.get("edits", [])) == number)
    found: list[str] = data_of(running.project, "carpet.toml")["edits"]
    return found


def _knots(running: Studio) -> np.ndarray:
    """The colours of the chart of the saved recipe, as the command line makes it."""
    chart = make_charted(read_order(running.project / "carpet.toml")).chart
    return np.array([yarn.srgb for yarn in chart.yarns])[chart.knots]


def _drag(page: Page, begin: tuple[float, float], end: tuple[float, float]) -> None:
    page.mouse.move(*begin)
    page.mouse.down()
    page.mouse.move(*end, steps=4)
    page.mouse.up()


def _tool(page: Page, name: str) -> None:
    page.get_by_role("toolbar").get_by_role("button", name=name).click()


def test_a_drawn_colour_gets_a_yarn_by_hand(carpet: Page, running: Studio) -> None:
    carpet.get_by_role("tab", name="Yarns").click()
    rows = carpet.locator(".carpet-assignment tbody tr")
    expect(rows).to_have_count(4)
    navy = rows.filter(has_text="#1b2a4e")
    expect(navy).to_contain_text("indigo navy")
    expect(navy).to_contain_text("2,400")
    navy.get_by_role("button").click()
    shelf = carpet.get_by_role("group", name="Yarn for #1b2a4e")
    assert violations(carpet) == []
    shelf.get_by_role("button", name="sage green").click()
    until_file(running.project, "carpet.toml", '"#1b2a4e" = "sage green"')
    expect(shelf).to_have_count(0)
    expect(navy).to_contain_text("sage green")
    carpet.keyboard.press("Control+z")
    until_data(running.project, "carpet.toml", lambda data: "map" not in data)


def test_the_crop_is_a_frame_that_is_dragged(carpet: Page, running: Studio) -> None:
    carpet.get_by_role("button", name="Crop the picture").click()
    corner = carpet.get_by_role("button", name=re.compile("^Lower right corner"))
    for key in ("Shift+ArrowLeft", "Shift+ArrowUp") * 4:
        corner.press(key)
    x, y = middle(carpet, ".carpet-frame")
    _drag(carpet, (x, y), (x + 600, y))  # as far as the picture goes
    carpet.locator(".carpet-frame").press("ArrowDown")
    assert violations(carpet) == []
    carpet.get_by_role("button", name="Apply").click()
    until_file(running.project, "carpet.toml", 'crop = "30%,0.5% 100%,80.5%"')


def test_specks_are_marked_and_taken_out(carpet: Page, running: Studio) -> None:
    carpet.get_by_text("Specks", exact=True).click()
    expect(carpet.get_by_text("1 speck: 1 of 1")).to_be_visible()
    carpet.get_by_text("Mark them").click()
    expect(carpet.locator(".carpet-marks .specks")).to_have_attribute("d", re.compile("^M[^M]+Z$"))
    assert violations(carpet) == []
    carpet.get_by_role("button", name="Take all 1 out").click()
    assert _edits(running, 1)[0].startswith("set 110,11 ")
    expect(carpet.get_by_text("0 specks")).to_be_visible()
    assert len(np.unique(_knots(running)[:30].reshape(-1, 3), axis=0)) == 1


def test_a_brush_draws_in_all_four_quarters(carpet: Page, running: Studio) -> None:
    before = _knots(running)
    _tool(carpet, "Pencil")
    carpet.get_by_label("Brush").select_option("5")
    carpet.get_by_label("Symmetry").select_option("both")
    carpet.get_by_label("Yarn", exact=True).select_option("sage green")
    x, y = middle(carpet, ".carpet-surface canvas")
    _drag(carpet, (x - 80, y - 100), (x - 40, y - 60))
    assert violations(carpet) == []
    edits = _edits(running, 4)
    assert all(re.fullmatch(r"stroke 5( \d+,\d+)+ sage green", edit) for edit in edits)
    drawn = (_knots(running) != before).any(axis=-1)
    assert drawn.sum() > 4 * 20
    assert np.array_equal(drawn, np.flip(drawn, 0))
    assert np.array_equal(drawn, np.flip(drawn, 1))


def test_a_part_is_copied_turned_and_moved_by_keys(carpet: Page, running: Studio) -> None:
    surface = carpet.locator(".carpet-surface")
    _tool(carpet, "Select")
    for key in ("ArrowUp", "Enter", "Shift+ArrowUp", "ArrowLeft", "ArrowLeft", "Enter", "Control+c", "r", "m"):
        surface.press(key)
    expect(carpet.locator(".carpet-marks .held")).to_have_count(1)
    assert violations(carpet) == []
    for key in ("Shift+ArrowLeft", "Shift+ArrowLeft", "Enter"):
        surface.press(key)
    (copy,) = _edits(running, 1)
    found = re.fullmatch(r"copy (\d+),(\d+) (\d+),(\d+) to (\d+),(\d+) turned 270deg mirrored across", copy)
    assert found is not None
    row, column, other_row, other_column = map(int, found.groups()[:4])
    assert (other_row - row, column - other_column) == (10, 2)
    for key in ("Escape", "Control+x", "Shift+ArrowUp", "Enter"):
        surface.press(key)
    assert re.fullmatch(r"move [\d, ]+ to \d+,\d+ \w[\w ]*", _edits(running, 2)[1])
    expect(carpet.locator(".carpet-marks .held")).to_have_count(0)


def test_motifs_of_the_shelf_and_tiles_of_the_project_are_placed(carpet: Page, running: Studio) -> None:
    before = _knots(running)
    carpet.get_by_role("tab", name="Motifs").click()
    carpet.get_by_role("button", name=re.compile("^Ram's horn")).click()
    expect(carpet.get_by_role("list", name="Small pictures of the project")).to_contain_text("stripes.png")
    assert violations(carpet) == []
    carpet.get_by_label("Yarn", exact=True).select_option("sage green")
    x, y = middle(carpet, ".carpet-surface canvas")
    carpet.mouse.click(x, y)
    assert _edits(running, 1)[0].endswith(" sage green")
    drawn = (_knots(running) != before).any(axis=-1)
    rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
    assert (np.ptp(rows) + 1, np.ptp(columns) + 1) == (16, 15)
    assert np.array_equal(drawn[:, columns], np.flip(drawn[:, columns], 1))
    carpet.get_by_role("button", name="stripes.png").click()
    carpet.mouse.click(x + 60, y)
    until_file(running.project, "carpet.toml", "[[motif]]")
    assert data_of(running.project, "carpet.toml")["motif"][0]["picture"] == "pictures/stripes.png"


def test_borders_are_listed_and_dragged(carpet: Page, running: Studio) -> None:
    carpet.get_by_role("tab", name="Motifs").click()
    carpet.get_by_text("Borders", exact=True).click()
    carpet.get_by_role("button", name="Add a border").click()
    handle = carpet.get_by_role("button", name="Inner edge of border 1, 3 knots wide")
    handle.press("ArrowRight")
    until_data(running.project, "carpet.toml", lambda data: data.get("border", [{}])[0].get("width") == 4)
    settled(carpet)
    x, y = middle(carpet, ".carpet-border-handle")
    _drag(carpet, (x, y), (x + 40, y))
    until_data(running.project, "carpet.toml", lambda data: 6 < data["border"][0]["width"] < 30)
    assert violations(carpet) == []
    carpet.get_by_label("Border 1", exact=True).select_option("pattern")
    until_data(running.project, "carpet.toml", lambda data: data["border"][0].get("adjust") is True)
    carpet.get_by_role("button", name="Take border 1 out").click()
    until_data(running.project, "carpet.toml", lambda data: "border" not in data)


def test_edits_keep_their_place_when_the_size_changes(carpet: Page, running: Studio) -> None:
    _tool(carpet, "Fill")
    carpet.get_by_label("Yarn", exact=True).select_option("sage green")
    carpet.mouse.click(*middle(carpet, ".carpet-surface canvas"))
    assert len(_edits(running, 1)) == 1
    share = (_knots(running) == _sage()).all(axis=-1).mean()
    size = carpet.get_by_label("Size", exact=True)
    size.fill("64x96cm")
    size.press("Enter")
    until_file(running.project, "carpet.toml", 'grid = "80x120"')
    expect(carpet.locator(".carpet-timing")).to_contain_text("160 × 240")
    assert (_knots(running) == _sage()).all(axis=-1).mean() == pytest.approx(share)


def _sage() -> tuple[int, int, int]:
    return next(yarn.srgb for yarn in default_yarns() if yarn.name == "sage green")
