"""The page of a sheet's doubtful cells: corrected by click and by key, its edits give the right chart."""

import json
from pathlib import Path

import numpy as np
from click.testing import CliRunner
from PIL import Image
from playwright.sync_api import Browser, expect
from sheets import printed, random_design, random_palette
from studio_browser import Seen, context_of, violations

from ilmek.cli import main
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

PITCH, BLOTS = 14, ((20, 11), (8, 4))
"""Pitch of the sheet [pixels], and its cells of no colour, row and column from the top left."""


def blotted_sheet(path: Path) -> None:
    rng = np.random.default_rng(3)
    palette, design = random_palette(rng, 4), random_design(rng, 30, 30, 4)
    flat = printed(rng, design, palette, PITCH).copy()
    for number, (row, column) in enumerate(BLOTS):
        cell = flat[PITCH * row + 2 : PITCH * (row + 1) - 1, PITCH * column + 2 : PITCH * (column + 1) - 1]
        cell[:] = (palette[number].astype(int) + palette[number + 1]) // 2
    Image.fromarray(flat).save(path)


def test_edits_of_the_page_correct_the_chart(browser: Browser, seen: Seen, tmp_path: Path) -> None:
    picture, recipe, corrected = tmp_path / "sheet.png", tmp_path / "carpet.toml", tmp_path / "corrected.toml"
    blotted_sheet(picture)
    chart = ["chart", str(picture), "--paper", "--out", str(tmp_path / "out"), "--save-recipe", str(recipe)]
    shown = CliRunner().invoke(main, chart)
    assert shown.exit_code == 0, shown.output
    before = make_charted(read_order(picture, paper=True)).chart
    with context_of(browser) as context:
        page = context.new_page()
        address = (tmp_path / "out" / "paper.html").as_uri()
        seen.watch(page, address)
        page.goto(address)
        assert violations(page) == []
        cells, yarns = page.locator("#cells button"), page.locator("#yarns button")
        expect(cells).to_have_count(len(BLOTS))
        expect(yarns).to_have_count(len(before.used))
        cells.nth(0).click()
        page.keyboard.press("3")
        expect(cells.nth(0)).to_have_class("corrected")
        expect(cells.nth(1)).to_have_attribute("aria-pressed", "true")
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("ArrowRight")
        yarns.nth(3).click()
        edits = page.locator("#edits").input_value()
        with page.expect_download() as download:
            page.get_by_role("link", name="Download").click()
        assert Path(download.value.path()).read_text(encoding="utf-8") == edits
        data = json.loads(page.locator("#paper-data").inner_text())
        page.screenshot(path=tmp_path / "paper.png", full_page=True)
    assert seen.faults == []
    assert {(before.rows - cell["row"], cell["column"] - 1) for cell in data["cells"]} == set(BLOTS)
    corrected.write_text(edits + recipe.read_text(encoding="utf-8"), encoding="utf-8")
    after = make_charted(read_order(corrected)).chart
    meant = np.array([[before.yarns[number].name for number in row] for row in before.knots])
    for cell, yarn in zip(data["cells"], (data["yarns"][2], data["yarns"][3]), strict=True):
        meant[before.rows - cell["row"], cell["column"] - 1] = yarn["name"]
    assert (np.array([[after.yarns[number].name for number in row] for row in after.knots]) == meant).all()
