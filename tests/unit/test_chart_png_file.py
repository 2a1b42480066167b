"""The chart PNG: read back it is the same chart; other files are told from it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import PictureError
from ilmek.io.chart.png import read_chart_png, write_chart_png


def chart(yarns: int, rows: int = 37, columns: int = 23) -> Chart:
    rng = np.random.default_rng(yarns)
    colours = rng.integers(0, 256, (yarns, 3)).tolist()
    threads = tuple(Yarn(f"kök kırmızı № {n}", (r, g, b), (0.0, 0.0, 0.0), 4.0) for n, (r, g, b) in enumerate(colours))
    knots = rng.integers(0, yarns, (rows, columns), dtype=np.uint8)
    return Chart(knots, threads, CarpetSize(columns / 250, rows / 330), Quality(250.0, 330.0), "asymmetric")


def read_back(folder: Path, made: Chart) -> bool:
    write_chart_png(folder / "again.png", made)
    return read_chart_png(folder / "again.png").yarns == made.yarns


@pytest.mark.parametrize("yarns", [2, 3, 16, 17, 200, 255])
def test_comes_back_knot_by_knot(tmp_path: Path, yarns: int) -> None:
    made = chart(yarns)
    write_chart_png(tmp_path / "chart.png", made)
    back = read_chart_png(tmp_path / "chart.png")
    assert np.array_equal(back.knots, made.knots)
    assert read_back(tmp_path, replace(made, yarns=tuple(replace(yarn, metric_count=None) for yarn in made.yarns)))
    assert (back.yarns, back.size, back.quality, back.knot) == (made.yarns, made.size, made.quality, made.knot)


def test_any_viewer_sees_the_yarns_colours_and_the_proportions(tmp_path: Path) -> None:
    made = chart(7)
    write_chart_png(tmp_path / "chart.png", made)
    with Image.open(tmp_path / "chart.png") as picture:
        assert picture.size == (23, 37)
        seen = np.asarray(picture.convert("RGB"))
        assert picture.info["dpi"] == pytest.approx((250.0 * 0.0254, 330.0 * 0.0254), rel=1e-3)
    assert np.array_equal(seen, np.array([yarn.srgb for yarn in made.yarns], dtype=np.uint8)[made.knots])


@pytest.mark.parametrize("spoil", ["photo", "palette", "text", "truncated", "missing"])
def test_other_files_are_refused_in_one_line(tmp_path: Path, spoil: str) -> None:
    path = tmp_path / "other.png"
    if spoil == "photo":
        Image.new("RGB", (9, 9)).save(path)
    elif spoil == "palette":
        Image.new("P", (9, 9)).save(path)
    elif spoil == "text":
        path.write_text("no picture", encoding="utf-8")
    elif spoil == "truncated":
        write_chart_png(path, chart(5))
        path.write_bytes(path.read_bytes()[:-60])
    with pytest.raises(PictureError, match="is no knot chart|does not exist"):
        read_chart_png(path)
