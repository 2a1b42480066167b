"""SVG, PDF and layered files: rendered for the knots, thin strokes kept, and nothing read from outside the file."""

import io
import struct
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageDraw
from psd_tools import PSDImage
from psd_tools.constants import Resource
from psd_tools.psd import image_resources
from pypdf import PdfWriter
from reportlab.pdfgen.canvas import Canvas
from scipy.ndimage import label

from ilmek.errors import CarpetError, PictureError
from ilmek.io.picture import read_picture
from ilmek.io.rendered.kind import is_svg
from ilmek.io.rendered.resolution import PIXELS, Rendering, scale_for
from ilmek.io.rendered.svg import drawn_sides, read_tree, take_out_references
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

IVORY, RED, NAVY = "#efe6d0", "#9e2b25", "#1b2442"
HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n<!-- drawn -->\n'
OPEN = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 120 180">'
GROUND = f'<rect width="120" height="180" fill="{IVORY}"/>'


@pytest.fixture(autouse=True)
def _extra() -> None:
    for name in ("resvg_py", "pypdfium2"):
        pytest.importorskip(name, reason=f"the extra vector: there is no wheel of {name} for this platform")


def svg(folder: Path, body: str, head: str = HEAD + OPEN + GROUND) -> Path:
    path = folder / "rug.svg"
    path.write_text(f"{head}{body}</svg>", encoding="utf-8")
    return path


def colours(path: Path, **options: Any) -> list[list[str]]:
    chart = make_charted(read_order(path, **options)).chart
    return [[chart.yarns[knot].name for knot in row] for row in chart.knots.tolist()]


@pytest.mark.parametrize(
    ("begin", "expected"),
    [
        (b"<svg>", True), (b"\xef\xbb\xbf <svg\n", True), (b"<?xml version='1.0'?><svg/>", True),
        (b"<!DOCTYPE svg PUBLIC 'x' 'y' [<!ENTITY a 'b'>]>\n<svg:svg ", True),
        ("<?xml version='1.0' encoding='UTF-16'?><svg ".encode("utf-16"), True),
        (b"<?xml version='1.0'?><html><svg>", False), (b"<svgx>", False), (b"GIF89a<svg>", False),
    ],
)  # fmt: skip
def test_a_drawing_is_recognised_behind_what_may_precede_it(begin: bytes, expected: bool) -> None:
    assert is_svg(begin) == expected


@pytest.mark.parametrize(
    "before", [b" " * 70_000, b"<!---->" * 9000 + b"<x", b"<!DOCTYPE a[]>" * 4000, b"<?xml>" * 9000]
)
def test_what_precedes_a_drawing_takes_no_time(before: bytes) -> None:
    begin = time.process_time()
    assert not is_svg(before)
    assert time.process_time() - begin < 0.5


def test_a_drawing_has_the_knots_that_pillow_draws(tmp_path: Path) -> None:
    """Edges between knots: every knot as drawn by another program."""
    body = f'<rect x="12" y="20" width="72" height="100" fill="{RED}"/>'
    body += f'<rect x="40" y="60" width="8" height="80" fill="{NAVY}"/>'
    made = colours(svg(tmp_path, body), size="60x90cm", quality="20x20/dm")
    drawn = Image.new("L", (120, 180), 0)
    ImageDraw.Draw(drawn).rectangle((12, 20, 83, 119), 1)
    ImageDraw.Draw(drawn).rectangle((40, 60, 47, 139), 2)
    names = np.array(["ivory", "madder red", "indigo navy"])
    assert made == names[np.asarray(drawn)].tolist()


@pytest.mark.parametrize("size", ["24x36cm", "120x180cm"])
def test_a_drawing_has_pixels_for_its_knots(tmp_path: Path, size: str) -> None:
    made = make_charted(read_order(svg(tmp_path, ""), size=size))
    found = next(note for note in made.notes if note.startswith("rendered with"))
    width, height = (int(word) for word in found.split() if word.isdigit())
    assert (width, height) == (PIXELS * made.chart.columns, PIXELS * made.chart.rows)
    assert not any("coarser" in note for note in made.notes)


def test_pixels_are_enough_where_the_carpet_shows_a_part() -> None:
    assert scale_for(100, 100, (450, 300)) * 100 == pytest.approx(PIXELS * 450)
    assert scale_for(1, 1, (100_000, 100_000)) ** 2 == pytest.approx(40_000_000)


STROKES = {
    "attribute": '<path stroke="{0}" stroke-width="0.02" {1}/>',
    "class": "<style>.a {{ stroke: {0}; stroke-width: 0.02px }}</style><path class='a' {1}/>",
    "inherited": '<g stroke="{0}" style="stroke-width:0.02"><path {1}/></g>',
    "scaled": '<g transform="scale(.01)" stroke="{0}" stroke-width=".02"><path transform="scale(100)" {1}/></g>',
    "wide": '<path stroke="{0}" stroke-width="2" {1}/>',
}


@pytest.mark.parametrize("kind", STROKES)
@pytest.mark.parametrize("path", ["M10 20 L110 150", "M10 100 L110 108", "M60 10 L64 170"])
def test_a_thin_stroke_stays_in_one_piece(tmp_path: Path, kind: str, path: str) -> None:
    """A stroke of a hundredth of a knot; judged by the pieces that scipy labels."""
    made = colours(svg(tmp_path, STROKES[kind].format(NAVY, f'd="{path}" fill="none"')), size="60x90cm")
    line = np.array(made) == "indigo navy"
    assert label(line, np.ones((3, 3)))[1] == 1
    longest = max(np.ptp(axis) for axis in np.nonzero(line)) + 1
    expected = {"wide": 2.5}.get(kind, 1.0) * 1.25
    assert 0.8 * expected / 1.25 <= line.sum() / longest <= max(2.0, 1.6 * expected)


def test_small_letters_keep_their_stems(tmp_path: Path) -> None:
    """Letters of eight knots, whose stems are 0.7 knots: each of the four is there, in one piece."""
    text = f'<text x="10" y="60" font-family="DejaVu Sans" font-size="9" letter-spacing="4" fill="{NAVY}">HILT</text>'
    made = np.array(colours(svg(tmp_path, text), size="60x90cm", quality="20x20/dm")) == "indigo navy"
    assert label(made, np.ones((3, 3)))[1] == 4


@pytest.mark.parametrize(
    "body",
    [
        '<image xlink:href="{0}" width="120" height="180"/>',
        '<image href="file://{0}" width="120" height="180"/>',
        '<image href="data:image/svg+xml,%3Csvg/%3E" width="120" height="180"/>',
        '<use href="other.svg#a"/>',
        '<image href="http://192.0.2.1/a.png" width="9" height="9"/>',
        '<style>@import "http://192.0.2.1/a.css";</style>',
        '<rect width="120" height="180" style="fill:url(http://192.0.2.1/a.svg#b)"/>',
    ],
)
def test_nothing_outside_the_file_is_read(tmp_path: Path, body: str) -> None:
    Image.new("RGB", (12, 18), RED).save(tmp_path / "secret.png")
    picture = read_picture(svg(tmp_path, body.format(tmp_path / "secret.png")))
    assert (picture.rgb == picture.rgb[0, 0]).all()
    assert any(note.startswith("1 reference to other files left out") for note in picture.notes)


def test_pictures_inside_the_file_and_references_within_it_stay() -> None:
    tree = read_tree(
        f'{OPEN}<a href="http://x/"/><use href="#a"/><image href="data:image/png;base64,AA"/></svg>'.encode()
    )
    assert take_out_references(tree) == 0


def _entities(*lines: str, use: str = "") -> bytes:
    return f"<!DOCTYPE svg [{''.join(lines)}]>{OPEN}{use}</svg>".encode()


LAUGHS = [f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 9)]
DAMAGED: dict[str, bytes] = {
    "entities that name others": _entities('<!ENTITY a0 "ha">', *LAUGHS, use="<text>&a8;</text>"),
    "many entities": _entities(*(f'<!ENTITY b{n} "x">' for n in range(200))),
    "cut": f"{OPEN}{GROUND}".encode(),
    "no size": b'<svg xmlns="http://www.w3.org/2000/svg"><rect width="9" height="9"/></svg>',
    "a thread": b'<svg xmlns="http://www.w3.org/2000/svg" width="100000" height="1"/>',
    "deep": f"{OPEN}{'<g>' * 1000}{'</g>' * 1000}</svg>".encode(),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_or_hostile_drawing_is_one_error(tmp_path: Path, name: str) -> None:
    (tmp_path / "rug.svg").write_bytes(DAMAGED[name])
    with pytest.raises(PictureError, match="is damaged or truncated"):
        read_picture(tmp_path / "rug.svg")


def test_an_entity_of_another_file_is_empty(tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret")
    data = _entities(f'<!ENTITY x SYSTEM "file://{tmp_path}/secret.txt">', use="<text>a&x;b</text>")
    assert "secret" not in "".join(read_tree(data).itertext())


@pytest.mark.parametrize(
    ("attributes", "sides"),
    [
        ('width="60mm" height="90mm" viewBox="0 0 6 9"', (60 * 96 / 25.4, 90 * 96 / 25.4)),
        ('viewBox="10 20 30 40"', (30, 40)),
        ('width="100%" height="100%" viewBox="0,0,30,40"', (30, 40)),
        ('width="15" viewBox="0 0 30 40"', (15, 20)),
        ('height="80" viewBox="0 0 30 40"', (60, 80)),
    ],
)
def test_the_sides_of_a_drawing(attributes: str, sides: tuple[float, float]) -> None:
    found, _ = drawn_sides(read_tree(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}/>'.encode()))
    assert found == pytest.approx(sides)


def pdf(folder: Path, *pages: Callable[[Canvas], None]) -> Path:
    path = folder / "rug.pdf"
    canvas = Canvas(str(path), pagesize=(120, 180), invariant=True)
    for page in pages:
        page(canvas)
        canvas.showPage()
    canvas.save()
    return path


def _block(canvas: Canvas) -> None:
    canvas.setFillColor(RED)
    canvas.rect(12, 60, 72, 100, stroke=0, fill=1)  # 20 to 120 from the upper edge


def _hairline(canvas: Canvas) -> None:
    canvas.setStrokeColor(NAVY)
    canvas.setLineWidth(0.01)
    canvas.scale(2, 2)
    canvas.line(5, 10, 55, 75)


def test_a_page_of_a_pdf_file_has_the_knots_that_pillow_draws(tmp_path: Path) -> None:
    path = pdf(tmp_path, _hairline, _block)
    made = np.array(colours(path, size="60x90cm", quality="20x20/dm", page=2))
    drawn = Image.new("L", (120, 180), 0)
    ImageDraw.Draw(drawn).rectangle((12, 20, 83, 119), 1)
    assert np.array_equal(made == "madder red", np.asarray(drawn) == 1)
    notes = make_charted(read_order(path, size="60x90cm", page=2)).notes
    assert "page 2 of 2 is used" in notes


def test_a_hairline_of_a_pdf_file_stays_in_one_piece(tmp_path: Path) -> None:
    line = np.array(colours(pdf(tmp_path, _hairline), size="60x90cm")) == "indigo navy"
    assert label(line, np.ones((3, 3)))[1] == 1
    assert line.any(axis=1).sum() > 150


def test_pages_that_are_not_there_and_files_without_pages(tmp_path: Path) -> None:
    with pytest.raises(PictureError, match=r"page=3 is given, and .*rug.pdf has 2 pages; page 1 to 2"):
        read_picture(pdf(tmp_path, _block, _block), rendering=Rendering(3))
    with pytest.raises(PictureError, match=r"page=2 is given, and .*rug.svg has one picture"):
        read_picture(svg(tmp_path, ""), rendering=Rendering(2))
    Image.new("RGB", (9, 9)).save(tmp_path / "a.png")
    with pytest.raises(PictureError, match=r"page=2 is given, and .*a.png has one picture"):
        read_picture(tmp_path / "a.png", rendering=Rendering(2))


def test_a_locked_and_a_damaged_pdf_file(tmp_path: Path) -> None:
    writer = PdfWriter(clone_from=pdf(tmp_path, _block))
    writer.encrypt("word")
    writer.write(tmp_path / "locked.pdf")
    (tmp_path / "cut.pdf").write_bytes(b"%PDF-1.7\nnothing")
    for name, reason in (("locked.pdf", "is locked by a password"), ("cut.pdf", "is damaged")):
        with pytest.raises(PictureError, match=reason):
            read_picture(tmp_path / name)


def layered(folder: Path, *, has_merged: bool) -> Path:
    """A PSD file of two layers; what it has as their merged picture is blank."""
    made = PSDImage.new("RGB", (40, 60), color=255)
    for colour, place in ((RED, (0, 0, 40, 60)), (NAVY, (10, 20, 30, 40))):
        layer = Image.new("RGB", (place[2] - place[0], place[3] - place[1]), colour)
        made.create_pixel_layer(layer, top=place[1], left=place[0], name=colour)
    info = image_resources.VersionInfo(1, has_merged, "test", "test", 1)
    made.image_resources[Resource.VERSION_INFO] = image_resources.ImageResource(
        key=Resource.VERSION_INFO.value, data=info.tobytes()
    )
    file = io.BytesIO()
    made.save(file)
    (folder / "rug.psd").write_bytes(file.getvalue())
    return folder / "rug.psd"


def test_layers_without_their_merged_picture_are_put_together(tmp_path: Path) -> None:
    picture = read_picture(layered(tmp_path, has_merged=False))
    expected = Image.new("RGB", (40, 60), RED)
    ImageDraw.Draw(expected).rectangle((10, 20, 29, 39), NAVY)
    assert np.array_equal(picture.rgb, np.asarray(expected))
    assert any(note.startswith("its layers are put together") for note in picture.notes)


def test_a_merged_picture_is_taken_as_it_is(tmp_path: Path) -> None:
    path = layered(tmp_path, has_merged=True)
    with Image.open(path) as opened:
        assert np.array_equal(read_picture(path).rgb, np.asarray(opened.convert("RGB")))


def test_a_missing_extra_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    large = struct.pack(">4sH6sHIIHH", b"8BPS", 2, b"", 3, 20, 20, 8, 3)  # a PSB file, which Pillow does not read
    (tmp_path / "rug.psb").write_bytes(large)
    files = svg(tmp_path, ""), pdf(tmp_path, _block), tmp_path / "rug.psb"
    for name in ("resvg_py", "pypdfium2", "psd_tools"):
        monkeypatch.setitem(sys.modules, name, None)
    for path in files:
        with pytest.raises(PictureError, match=r"needs the extra vector \(.* is not installed\)") as error:
            read_picture(path)
        assert "pip install 'ilmek[vector]'" in str(error.value)


def test_a_tile_of_a_recipe_has_pixels(tmp_path: Path) -> None:
    svg(tmp_path, "")
    (tmp_path / "carpet.toml").write_text('plain = "ivory"\nsize = "40x60cm"\n[[motif]]\npicture = "rug.svg"\n')
    with pytest.raises(CarpetError, match=r"motif.0: rug.svg has no pixels; save a tile or a motif as PNG"):
        make_charted(read_order(tmp_path / "carpet.toml"))


def test_a_field_of_a_recipe_may_be_a_drawing(tmp_path: Path) -> None:
    body = f'<rect x="12" y="20" width="72" height="100" fill="{RED}"/>'
    svg(tmp_path, body)
    (tmp_path / "carpet.toml").write_text(
        'picture = "rug.svg"\nsize = "60x90cm"\nquality = "20x20/dm"\n[[border]]\nyarn = "gold"\nwidth = 3\n'
    )
    made = np.array(colours(tmp_path / "carpet.toml"))
    assert (made[:3] == "gold").all()
    assert 0.30 < (made == "madder red").mean() < 0.33
