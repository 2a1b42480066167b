"""Pictures that are no plans of knots, plain grounds, and greys of few bits, as a customer sends them."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ilmek.cli import main


def _charted(picture: Path, tmp_path: Path, *options: str) -> dict[str, object]:
    with pytest.raises(SystemExit) as end:
        main(["chart", str(picture), "--quality", "12x12/dm", "--out", str(tmp_path / "out"), *options])
    assert end.value.code in {0, 3, None}
    data: dict[str, object] = json.loads((tmp_path / "out" / "chart.json").read_text())
    return data


def test_a_large_scan_of_two_colours_is_no_plan_of_knots(tmp_path: Path) -> None:
    """A fax of 1,728 × 2,200 pixels: a pixel a knot would be a carpet of 14 × 18 m."""
    page = np.ones((2200, 1728), dtype=bool)
    generator = np.random.default_rng(4)
    for row in range(100, 2100, 40):
        page[row : row + 20, 150:1500] = generator.random((20, 1350)) > 0.3
        page[row + 9, 150:1500] = False
    Image.fromarray(page).save(tmp_path / "fax.png")
    _charted(tmp_path / "fax.png", tmp_path)
    with Image.open(tmp_path / "out" / "chart.png") as chart:
        assert max(chart.size) < 3.0 * 120  # 12 knots a dm


def test_the_white_ground_of_a_photo_stays_white(tmp_path: Path) -> None:
    """A shaded ball on white paper: the paper is tied in pure white, without a dot."""
    y, x = np.mgrid[0:240, 0:240] / 120.0 - 1.0
    inside = x**2 + y**2 < 0.45
    light = np.clip(0.9 - 0.5 * x - 0.3 * y, 0.1, 1.0)
    noise = np.random.default_rng(2).normal(0, 6, (240, 240, 1))
    ball = np.stack([210 * light, 90 * light, 60 * light], axis=-1) + noise
    picture = np.where(inside[..., None], ball, 255).clip(0, 255).astype(np.uint8)
    Image.fromarray(picture).save(tmp_path / "ball.png")
    _charted(tmp_path / "ball.png", tmp_path, "--read", "photo")
    chart = np.asarray(Image.open(tmp_path / "out" / "chart.png").convert("RGB"))
    rim = np.concatenate([chart[:8].reshape(-1, 3), chart[-8:].reshape(-1, 3)])
    assert (rim == 255).all()


def test_greys_of_twelve_bits_are_not_one_black_yarn(tmp_path: Path) -> None:
    ramp = np.tile(np.linspace(0, 3000, 300), (300, 1)).astype(np.uint16)
    Image.fromarray(ramp).save(tmp_path / "ramp.png")
    data = _charted(tmp_path / "ramp.png", tmp_path)
    chart = np.asarray(Image.open(tmp_path / "out" / "chart.png").convert("L"), dtype=float)
    assert data["holds"]
    assert chart[:, -5:].mean() - chart[:, :5].mean() > 150


def test_a_hard_line_keeps_its_colour_though_its_codes_lie_between_two_others(tmp_path: Path) -> None:
    """Terracotta lines on ivory: their codes lie between those of the red and the yellow, which they do not touch."""
    ivory, red, yellow, terracotta = (239, 230, 208), (158, 43, 37), (227, 192, 74), (181, 83, 47)
    drawing = np.full((122, 184, 3), ivory, dtype=np.uint8)
    drawing[:20], drawing[-20:] = red, yellow
    drawing[40:80:6, 20:160] = terracotta
    Image.fromarray(drawing).save(tmp_path / "lines.png")
    yarns = tmp_path / "yarns.csv"
    named = zip(["ivory", "red", "yellow", "terracotta"], (ivory, red, yellow, terracotta), strict=True)
    yarns.write_text("name,srgb\n" + "".join(f"{name},#{r:02x}{g:02x}{b:02x}\n" for name, (r, g, b) in named))
    _charted(tmp_path / "lines.png", tmp_path, "--size", "92x61cm", "--quality", "40x40/dm", "--yarns", str(yarns))
    chart = np.asarray(Image.open(tmp_path / "out" / "chart.png").convert("RGB"))
    assert {tuple(code) for code in chart.reshape(-1, 3).tolist()} == {ivory, red, yellow, terracotta}
