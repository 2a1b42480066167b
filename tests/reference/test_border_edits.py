"""Edits on a border: the judge is the carpet whose tile was changed by Pillow, as it is drawn at each size."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from ilmek.carpet.chart import Chart
from ilmek.errors import CarpetError
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import chart_of_recipe, saved_recipe

RED, IVORY, NAVY, GOLD = "#9e2b25", "#efe6d0", "#1b2442", "#c08a2b"
HIGH, LONG = 6, 8


def tile(folder: Path, name: str = "tile.png", long: int = LONG) -> Image.Image:
    """A leaf on navy that no reflection leaves as it is."""
    image = Image.new("RGB", (long, HIGH), NAVY)
    ImageDraw.Draw(image).polygon([(1, 1), (5, 2), (2, 4)], fill=RED)
    image.putpixel((long - 1, 0), (239, 230, 208))
    image.save(folder / name)
    return image


def charted(folder: Path, text: str) -> Chart:
    (folder / "carpet.toml").write_text(f'plain = "ivory"\nyarns = "wool"\n{text}')
    made = make_charted(read_order(folder / "carpet.toml", quality="25x25/dm"))
    assert all(check.ok for check in made.checks if check.name.startswith("recipe"))
    return made.chart


def colours(chart: Chart) -> np.ndarray:
    return np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)[chart.knots]


def edits(on: str, *lines: str, grid: str = "") -> str:
    return f'[[edits]]\non = "{on}"\n{f"grid = {grid!r}" if grid else ""}\nlines = {list(lines)!r}\n'


def of_wool(name: str) -> tuple[int, int, int]:
    return next(yarn.srgb for yarn in default_yarns() if yarn.name == name)


BORDERS = {
    "tile": ("48x57.6cm", 'tile = "tile.png"', "32x38.4cm", "51.2x32cm"),
    "adjusted": ("47.6x55.6cm", 'tile = "tile.png"\nadjust = true', "30x41.2cm", "64.4x33.2cm"),
    "alternating": ("43.2x51.2cm", 'tile = "wide.png"\nalternate = true\nadjust = true', "36.4x30cm", "70x40cm"),
    "enlarged": ("47.6x55.6cm", 'tile = "tile.png"\nwidth = 12\nlength = 16\nadjust = true', "36x41.2cm", "64x34cm"),
}


@pytest.mark.parametrize("kind", BORDERS)
@pytest.mark.parametrize("size", [0, 2, 3])
def test_an_edit_is_in_every_repeat_and_in_the_corners_at_every_size(tmp_path: Path, kind: str, size: int) -> None:
    """Knot by knot the carpet whose tile has the same pixels changed."""
    place, border = BORDERS[kind][size], BORDERS[kind][1]
    name, long = ("wide.png", 2 * LONG) if "wide" in border else ("tile.png", LONG)
    image = tile(tmp_path, name, long)
    layout = f'size = "{place}"\n[[border]]\nyarn = "dark red"\nwidth = 2\n[[border]]\n{border}\n'
    lines = (
        "set 6,1 5,1 3,7 gold",
        "line 1,2 1,6 camel",
        "fill 4,3 rose",
        "replace indigo navy by sage green in 1,7 6,8",
    )
    edited = charted(tmp_path, layout + edits("border 2", *lines, grid=f"{long}x{HIGH}"))
    pen = ImageDraw.Draw(image)
    pen.point([(0, 0), (0, 1), (6, 3)], fill=of_wool("gold"))
    pen.line([(1, 5), (5, 5)], fill=of_wool("camel"))
    ImageDraw.floodfill(image, (2, 2), of_wool("rose"))
    for across in (6, 7):
        for down in range(HIGH):
            if image.getpixel((across, down)) == of_wool("indigo navy"):
                image.putpixel((across, down), of_wool("sage green"))
    image.save(tmp_path / name)
    drawn = charted(tmp_path, layout)
    assert np.array_equal(colours(edited), colours(drawn))
    assert edited.reading.edited > 100


def test_a_stripe_is_edited_all_round(tmp_path: Path) -> None:
    """Row 1 is the inner edge; the border of two yarns is the judge."""
    layout = 'size = "{}"\n[[border]]\nyarn = "dark red"\nwidth = {}\n{}'
    inner = '[[border]]\nyarn = "gold"\nwidth = 1\n'
    for size in ("40x60cm", "48.4x30cm", "80x120cm"):
        edited = charted(tmp_path, layout.format(size, 3, edits("border 1", "set 1,1 gold")))
        assert np.array_equal(colours(edited), colours(charted(tmp_path, layout.format(size, 2, inner))))


def test_teeth_are_edited_in_each_tooth(tmp_path: Path) -> None:
    """Teeth of 4 knots: the tooth from outside is 8 knots long there; each gets one knot of gold in its tip."""
    layout = 'size = "{}"\n[[border]]\nteeth = ["dark red", "indigo navy"]\nwidth = 4\nadjust = true\n'
    for size in ("32x48cm", "41.6x48cm", "64x96cm"):
        plain = charted(tmp_path, layout.format(size))
        chart = charted(tmp_path, layout.format(size) + edits("border 1", "replace dark red by gold in 1,4 1,5"))
        changed = (colours(chart) != colours(plain)).any(axis=-1)
        assert np.array_equal(changed, changed[::-1])
        assert np.array_equal(changed, changed[:, ::-1])
        assert changed.any()
        tips = {int(row) for row in np.flatnonzero(changed[:, 8:-8].any(axis=1))}
        assert tips == {0, chart.rows - 1} or tips == {3, chart.rows - 4}


def test_a_corner_with_a_picture_is_edited_in_all_four(tmp_path: Path) -> None:
    tile(tmp_path)
    corner = Image.new("RGB", (HIGH, HIGH), RED)
    corner.save(tmp_path / "corner.png")
    for size in ("48x56cm", "32x40cm", "51.2x32cm"):
        layout = f'size = "{size}"\n[[border]]\ntile = "tile.png"\ncorner = "corner.png"\nadjust = true\n'
        corner = Image.new("RGB", (HIGH, HIGH), RED)
        corner.save(tmp_path / "corner.png")
        edited = charted(tmp_path, layout + edits("corner 1", "set 6,1 gold", "line 1,1 1,6 camel"))
        pen = ImageDraw.Draw(corner)
        pen.point([(0, 0)], fill=of_wool("gold"))
        pen.line([(0, 5), (5, 5)], fill=of_wool("camel"))
        corner.save(tmp_path / "corner.png")
        assert np.array_equal(colours(edited), colours(charted(tmp_path, layout)))


def test_a_motif_over_a_border_stays_as_it_is(tmp_path: Path) -> None:
    tile(tmp_path)
    layout = 'size = "48x56cm"\n[[border]]\ntile = "tile.png"\nadjust = true\n'
    motif = '[[motif]]\npicture = "tile.png"\nposition = [3, 41]\n'
    plain, chart = (
        colours(charted(tmp_path, layout + motif + more)) for more in ("", edits("border 1", "set 4,2 gold"))
    )
    changed = (chart != plain).any(axis=-1)
    assert not changed[-8:-2, 40:48].any()
    assert changed[-6:].any()


def test_the_grid_is_saved_where_the_width_is_a_length(tmp_path: Path) -> None:
    """Border of 2.4 cm: 6 knots at 25 knots a decimetre, 12 at 50; a line of a knot is there two knots wide."""
    tile(tmp_path)
    text = 'plain = "ivory"\nyarns = "wool"\nsize = "48x56cm"\n'
    text += '[[border]]\ntile = "tile.png"\nwidth = "2.4cm"\nadjust = true\n'
    (tmp_path / "carpet.toml").write_text(text + edits("border 1", "line 1,1 1,8 gold"))
    made = chart_of_recipe(read_order(tmp_path / "carpet.toml", quality="25x25/dm"))
    saved = saved_recipe(made.order, made.chart, tmp_path)
    assert 'on = "border 1"\ngrid = "8x6"' in saved
    (tmp_path / "saved.toml").write_text(saved)
    fine = chart_of_recipe(read_order(tmp_path / "saved.toml", quality="50x50/dm")).chart
    gold = (colours(fine) == of_wool("gold")).all(axis=-1)
    assert gold[10:12, 12:-12].all()
    assert gold[12:-12, 10:12].all()
    assert not gold[:10].any()
    assert not gold[12:-12, 12:-12].any()


@pytest.mark.parametrize(
    ("on", "line", "said"),
    [
        ("border 3", "set 1,1 gold", "border 3 is not there; border 1 to 2"),
        ("corner 2", "set 1,1 gold", 'border 2 has no picture of its corner; write on = "border 2"'),
        ("border 2", "set 7,1 gold", "knot 7,1 lies outside the carpet"),
        ("border 2", "copy 1,1 2,2 to 3,3", "copy is no edit of a border"),
        ("border 2", "half 1,1 gold", "half is no edit of a border"),
        ("border", "set 1,1 gold", "nothing to count on"),
    ],
)
def test_what_a_border_cannot_have_is_an_error(tmp_path: Path, on: str, line: str, said: str) -> None:
    tile(tmp_path)
    layout = (
        'size = "48x56cm"\n[[border]]\nyarn = "dark red"\nwidth = 2\n[[border]]\ntile = "tile.png"\nadjust = true\n'
    )
    with pytest.raises(CarpetError, match=said):
        charted(tmp_path, layout + edits(on, line))
