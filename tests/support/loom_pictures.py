"""The pictures of the loom in the documentation: the whole loom, its standard views, and one knot in twelve steps.

    PYTHONPATH=src:tests/support .venv/bin/python -m loom_pictures build/medallion/loom.html docs/_static
    PYTHONPATH=src:tests/support .venv/bin/python -m loom_pictures build/by-hand/loom.html docs/_static hand-loom

The second, of a loom of weavers, takes the whole loom alone, under a name of its own.
They are taken from the page that `ilmek weave` writes, by Chromium without a graphics card.
"""

import io
import math
import sys
from collections.abc import Callable
from pathlib import Path

from PIL import Image, ImageDraw
from playwright.sync_api import Page, sync_playwright
from studio_browser import PATIENCE, launched

VIEWS = ("Whole loom", "Front", "Side", "Above", "Fell", "Shed")
STEPS = (20, 62, 95, 110, 165, 180, 190, 198, 235, 280, 320, 350)
"""Angles of the knot [deg]: each shows what has just been done, or is being done."""
SLIDER_STEP = math.pi / 360
CAPTION = 26
"""Height of the line over a picture [px]."""


def main() -> None:
    """Takes the pictures of a page into a folder."""
    page_file, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    with sync_playwright() as playwright:
        browser = launched(playwright)
        page = browser.new_page(viewport={"width": 1500, "height": 1000})
        page.goto(page_file.as_uri())
        page.add_style_tag(content="nav { display: none !important }")
        if sys.argv[3:]:
            _view(page, VIEWS[0]).save(folder / f"{sys.argv[3]}.webp", quality=82)
            return
        views = [(name, _view(page, name)) for name in VIEWS]
        page.set_viewport_size({"width": 1040, "height": 720})
        page.get_by_role("button", name="Head", exact=True).click()
        pictures = [(angle, _step(page, angle), page.locator(".loom-moving").inner_text()) for angle in STEPS]
        knot = [(f"{angle}°  {moving}", picture) for angle, picture, moving in pictures]
        browser.close()
    views[0][1].save(folder / "loom.webp", quality=82)
    _sheet(views, 2, 620).save(folder / "loom-views.webp", quality=82)
    _sheet(knot, 3, 430).save(folder / "loom-knot.webp", quality=82)


def _view(page: Page, name: str) -> Image.Image:
    return _picture(page, lambda: page.get_by_role("button", name=name, exact=True).click())


def _step(page: Page, angle: float) -> Image.Image:
    shown = str(round(math.radians(angle) / SLIDER_STEP) * SLIDER_STEP)
    return _picture(page, lambda: page.locator(".loom-picture").get_by_label("Master angle").fill(shown))


def _picture(page: Page, change: Callable[[], None]) -> Image.Image:
    """The picture after a change, once it is drawn finely; as it is where the change changes nothing."""
    canvas = page.locator("canvas").first
    pictures = canvas.get_attribute("data-pictures")
    canvas.evaluate("canvas => { canvas.dataset.fine = 'false'; }")
    change()
    page.wait_for_timeout(1000)
    if canvas.get_attribute("data-pictures") != pictures:
        fine = "canvas => canvas.dataset.fine === 'true'"
        page.wait_for_function(fine, arg=canvas.element_handle(), timeout=PATIENCE)
    return Image.open(io.BytesIO(canvas.screenshot())).convert("RGB")


def _sheet(pictures: list[tuple[str, Image.Image]], columns: int, width: int) -> Image.Image:
    """Pictures side by side, each under its caption."""
    first = pictures[0][1]
    height = round(width * first.height / first.width)
    rows = -(-len(pictures) // columns)
    sheet = Image.new("RGB", (columns * width, rows * (height + CAPTION)), "white")
    draw = ImageDraw.Draw(sheet)
    for number, (caption, picture) in enumerate(pictures):
        left, top = number % columns * width, number // columns * (height + CAPTION)
        sheet.paste(picture.resize((width, height), Image.Resampling.LANCZOS), (left, top + CAPTION))
        draw.text((left + 8, top + 4), caption, fill="black", font_size=16)
    return sheet


if __name__ == "__main__":
    main()
