"""Keys of the recipe in the view of the carpet: what the knots of an edit are, and the page of a PDF."""

from io import BytesIO

import pytest
from playwright.sync_api import Page, expect
from reportlab.pdfgen.canvas import Canvas
from studio_browser import Studio, open_view, until_data, violations

EDITS = ["set 1,1 ivory", "set 2,2 ivory", "set 3,3 ivory"]


def _pages() -> bytes:
    """A PDF of two pages of 80 x 120 points: a red one, then a blue one with a white band."""
    file = BytesIO()
    pen = Canvas(file, pagesize=(80, 120))
    for colour, band in (((0.6, 0.1, 0.1), 0), ((0.1, 0.1, 0.5), 30)):
        pen.setFillColorRGB(*colour)
        pen.rect(0, 0, 80, 120, stroke=0, fill=1)
        pen.setFillColorRGB(1, 1, 1)
        pen.rect(0, 40, 80, band or 1, stroke=0, fill=1)
        pen.showPage()
    pen.save()
    return file.getvalue()


def _open(page: Page, running: Studio, recipe: str) -> Page:
    (running.project / "carpet.toml").write_text(recipe, encoding="utf-8")
    open_view(page, running, "carpet")
    expect(page.locator(".carpet-status")).to_contain_text("40 knots across, 60 rows")
    return page


def test_one_edit_is_held_at_this_size_alone(page: Page, running: Studio) -> None:
    carpet = _open(page, running, f'plain = "camel"\nsize = "20x30cm"\nquality = "20x20/dm"\nedits = {EDITS}\n')
    carpet.get_by_role("tab", name="Edits").click()
    carpet.get_by_label("Knots of edit 2").select_option("at this size only")
    held = [EDITS[0], {"on": "knots", "grid": "40x60", "lines": [EDITS[1]]}, EDITS[2]]
    until_data(running.project, "carpet.toml", lambda data: data["edits"] == held)
    expect(carpet.locator(".carpet-status")).to_contain_text("40 knots across, 60 rows")
    assert violations(carpet) == []


def test_the_page_of_a_pdf_is_chosen(page: Page, running: Studio) -> None:
    pytest.importorskip("pypdfium2")
    (running.project / "pictures/two.pdf").write_bytes(_pages())
    recipe = 'picture = "pictures/two.pdf"\nsize = "20x30cm"\nquality = "20x20/dm"\nyarns = "wool"\n'
    carpet = _open(page, running, recipe)
    carpet.get_by_role("tab", name="Yarns").click()
    rows = carpet.locator(".carpet-assignment tbody tr")
    expect(rows).to_have_count(2)
    expect(rows.filter(has_text="#991a1a")).to_have_count(1)
    carpet.get_by_role("tab", name="Picture").click()
    carpet.get_by_label("Page of the PDF").fill("2")
    until_data(running.project, "carpet.toml", lambda data: data.get("page") == 2)
    carpet.get_by_role("tab", name="Yarns").click()
    expect(rows.filter(has_text="#1a1a80")).to_have_count(1)
    assert violations(carpet) == []
