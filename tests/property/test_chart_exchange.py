"""Charts through the files of the trade: what comes back is what was written; exact reading changes no knot."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageCms

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.indexed import write_chart_bmp
from ilmek.io.chart.oxs import write_chart_oxs
from ilmek.io.chart.oxs_reading import read_chart_oxs
from ilmek.io.chart.png import read_chart_png, write_chart_png
from ilmek.io.picture import read_picture
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

NAME = st.text(st.characters(exclude_categories=("C", "Z")), min_size=1, max_size=20)
SHARE = st.floats(0.1, 400.0, allow_nan=False)


@st.composite
def charts(draw: st.DrawFn) -> Chart:
    names = draw(st.lists(NAME, min_size=2, max_size=12, unique_by=str.casefold))
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    codes = rng.choice(1 << 24, len(names), replace=False)
    yarns = tuple(
        Yarn(
            f"№ {name}",
            (int(code) >> 16, int(code) >> 8 & 255, int(code) & 255),
            (rng.uniform(0, 100), rng.uniform(-90, 90), rng.uniform(-90, 90)),
            draw(SHARE),
            draw(st.integers(1, 64)),
            draw(st.none() | st.floats(0, 1e5)),
        )
        for name, code in zip(names, codes, strict=True)
    )
    rows, columns = draw(st.integers(8, 40)), draw(st.integers(8, 40))
    knots = rng.integers(0, len(names), (rows, columns), dtype=np.uint8)
    knots[0, 0:2] = 0
    marks = [KnotMark(0, 0, JUFTI)] if draw(st.booleans()) else []
    if draw(st.booleans()):
        marks.append(KnotMark(rows - 1, 3, HALF, int(knots[rows - 1, 3] + 1) % len(names)))
    quality = Quality(draw(st.floats(100, 700)), draw(st.floats(100, 700)))
    size = CarpetSize(columns / quality.across, rows / quality.along, draw(NAME | st.just("")))
    return Chart(
        knots, yarns, size, quality, draw(st.sampled_from(("symmetric", "asymmetric"))), overlay=overlay_of(marks)
    )


def same(one: Chart, other: Chart) -> bool:
    facts = ("yarns", "size", "quality", "knot")
    return (
        np.array_equal(one.knots, other.knots)
        and all(getattr(one, name) == getattr(other, name) for name in facts)
        and one.overlay.equals(other.overlay)
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("exchange")


@given(charts())
@settings(max_examples=40, deadline=None)
def test_png_and_oxs_bring_everything_back(folder: Path, chart: Chart) -> None:
    write_chart_png(folder / "chart.png", chart)
    assert same(read_chart_png(folder / "chart.png"), chart)
    write_chart_oxs(folder / "chart.oxs", chart)
    back, notes = read_chart_oxs(folder / "chart.oxs")
    assert (same(back, chart), notes) == (True, ())


@given(charts())
@settings(max_examples=15, deadline=None)
def test_an_order_takes_a_chart_as_it_is(folder: Path, chart: Chart) -> None:
    write_chart_png(folder / "chart.png", chart)
    made = make_charted(read_order(folder / "chart.png")).chart
    assert same(made, chart)
    write_chart_oxs(folder / "chart.oxs", made)
    again = make_charted(read_order(folder / "chart.oxs")).chart
    write_chart_png(folder / "again.png", again)
    assert (folder / "again.png").read_bytes() == (folder / "chart.png").read_bytes()


@given(charts())
@settings(max_examples=15, deadline=None)
def test_bmp_keeps_the_colours_and_the_order_of_the_yarns(folder: Path, chart: Chart) -> None:
    write_chart_bmp(folder / "chart.bmp", chart)
    colours = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)
    assert np.array_equal(read_picture(folder / "chart.bmp").rgb, colours[chart.knots])
    with Image.open(folder / "chart.bmp") as opened:
        assert opened.mode == "P"
        assert np.array_equal(np.asarray(opened), chart.knots)


def test_a_bmp_needs_no_option_whatever_is_drawn(folder: Path) -> None:
    yarns = tuple(Yarn(f"{n}", (n, 255 - n, 7 * n % 256), (0.0, 0.0, 0.0), 5.0) for n in range(0, 200, 2))
    knots = np.random.default_rng(1).integers(0, 100, (60, 50), dtype=np.uint8)
    write_chart_bmp(folder / "a.bmp", Chart(knots, yarns, CarpetSize(0.1, 0.2), Quality(500.0, 300.0), "symmetric"))
    made = make_charted(read_order(folder / "a.bmp", knot="asymmetric"))
    assert (made.chart.reading.kind, made.chart.knots.shape) == ("exact", (60, 50))
    assert made.chart.quality == Quality(500.0, 300.0)
    assert "its resolution is that of knots: 50x30/dm" in made.notes
    assert len(made.chart.reading.matches) == 100


@pytest.mark.parametrize("dots", [72, 96, 300, 0.5])
def test_the_resolution_of_a_screen_or_printer_states_no_knots(folder: Path, dots: float) -> None:
    noise = np.random.default_rng(1).integers(0, 4, (60, 50, 1), dtype=np.uint8)
    Image.fromarray(noise.repeat(3, 2) * 60).save(folder / "screen.png", dpi=(dots, dots))
    assert make_charted(read_order(folder / "screen.png")).chart.reading.kind != "exact"


INDEXED = [
    ("PNG", {"bits": 1}, 2), ("PNG", {"bits": 2}, 4), ("PNG", {"bits": 4}, 16), ("PNG", {"bits": 8}, 256),
    ("BMP", {}, 200), ("GIF", {}, 200), ("TIFF", {}, 200), ("PCX", {}, 200),
]  # fmt: skip


@pytest.mark.parametrize(("form", "how", "most"), INDEXED)
def test_indexed_pictures_are_read_with_exact_colours(
    tmp_path: Path, form: str, how: dict[str, int], most: int
) -> None:
    rng = np.random.default_rng(most)
    palette = rng.integers(0, 256, (most, 3), dtype=np.uint8)
    palette[1] = palette[0]  # two entries of one colour
    numbers = rng.integers(0, most, (30, 21), dtype=np.uint8)
    picture = Image.frombytes("P", (21, 30), numbers.tobytes())
    picture.putpalette(palette.tobytes())
    path = tmp_path / f"chart.{form.lower()}"
    picture.save(path, form, **how)
    read = read_picture(path)
    assert np.array_equal(read.rgb, palette[numbers])
    assert read.notes == ()


def test_a_profile_that_is_srgb_changes_no_colour(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    rgb = rng.integers(0, 256, (40, 30, 3), dtype=np.uint8)
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB"))
    Image.fromarray(rgb).save(tmp_path / "a.png", icc_profile=srgb.tobytes().replace(b"sRGB", b"GIMP"))
    read = read_picture(tmp_path / "a.png")
    assert np.array_equal(read.rgb, rgb)
    assert read.notes == ()


@pytest.mark.parametrize("bits", [1, 4])
def test_bmp_of_few_bits_is_read_with_exact_colours(tmp_path: Path, bits: int) -> None:
    """Pillow does not write these: rows from the bottom, padded to four bytes, most significant pixel first."""
    rng = np.random.default_rng(bits)
    palette, numbers = rng.integers(0, 256, (1 << bits, 3), dtype=np.uint8), rng.integers(0, 1 << bits, (9, 13))
    words = ((numbers[::-1, :, None] >> np.arange(bits - 1, -1, -1)) & 1).reshape(9, -1).astype(np.uint8)
    rows = np.packbits(words, axis=1)
    rows = np.pad(rows, ((0, 0), (0, -rows.shape[1] % 4)))
    table = np.pad(palette[:, ::-1], ((0, 0), (0, 1))).astype(np.uint8).tobytes()
    numbers32 = lambda *values: b"".join(int(value).to_bytes(4, "little") for value in values)  # noqa: E731
    begin = 54 + len(table)
    header = b"BM" + numbers32(begin + rows.size, 0, begin, 40, 13, 9) + b"\1\0" + bytes([bits, 0])
    header += numbers32(0, rows.size, 0, 0, 0, 0)
    (tmp_path / "chart.bmp").write_bytes(header + table + rows.tobytes())
    assert np.array_equal(read_picture(tmp_path / "chart.bmp").rgb, palette[numbers])


@given(st.integers(0, 2**32), st.integers(2, 12))
@settings(max_examples=15, deadline=None)
def test_a_random_drawing_with_diagonals_keeps_every_knot(folder: Path, seed: int, colours: int) -> None:
    rng = np.random.default_rng(seed)
    palette = rng.choice(1 << 24, colours, replace=False)
    numbers = np.zeros((50, 40), dtype=np.int64)
    for line in range(12):
        row, column, slope = rng.integers(50), rng.integers(40), rng.choice([-1, 0, 1])
        for step in range(25):
            if 0 <= row + slope * step < 50 and column + step < 40:
                numbers[row + slope * step, column + step] = 1 + line % (colours - 1)
    drawing = np.stack([palette >> 16, palette >> 8 & 255, palette & 255], axis=-1).astype(np.uint8)[numbers]
    Image.fromarray(drawing).save(folder / "drawing.png")
    made = make_charted(read_order(folder / "drawing.png", size="40x50cm", quality="10x10/dm")).chart
    yarn_of = {match.srgb: match.yarn for match in made.reading.matches}
    wanted = [[yarn_of[tuple(colour)] for colour in row] for row in drawing.tolist()]
    assert np.array_equal(made.knots, wanted)
    assert (made.reading.kind, made.reading.changed) == ("exact", 0)
    write_chart_png(folder / "drawn.png", made)
    again = make_charted(read_order(folder / "drawn.png")).chart
    assert same(again, replace(made, reading=again.reading))
