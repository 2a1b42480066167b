"""A round picture on transparent ground: a round carpet has no knots in its corners, and a chart ties all."""

import json
import math
from pathlib import Path

import pytest
from PIL import Image, ImageDraw

from ilmek.cli import main
from ilmek.io.round_picture import share_outside

CORNERS = 1 - math.pi / 4
"""Share of a square outside of its circle."""


def _drawn(shape: str, box: tuple[int, int, int, int], size: tuple[int, int]) -> Image.Image:
    """A red figure on transparent ground, with smooth edges."""
    large = Image.new("RGBA", (4 * size[0], 4 * size[1]))
    scaled, draw = [4 * side for side in box], ImageDraw.Draw(large)
    if shape == "ellipse":
        draw.ellipse(scaled, fill=(158, 43, 37, 255))
    elif shape == "rounded":
        draw.rounded_rectangle(scaled, radius=2 * size[0] // 3, fill=(158, 43, 37, 255))
    else:
        draw.regular_polygon((2 * size[0], 2 * size[1], 2 * size[0]), 6, fill=(158, 43, 37, 255))
    return large.resize(size, Image.Resampling.LANCZOS)


ROUND = {
    "the case": Image.open(Path(__file__).parents[1] / "data" / "round.png"),
    "a circle": _drawn("ellipse", (0, 0, 299, 299), (300, 300)),
    "an oval": _drawn("ellipse", (0, 0, 399, 249), (400, 250)),
    "a circle with a margin": _drawn("ellipse", (10, 10, 890, 890), (900, 900)),
}
OTHERS = {
    "a rounded rectangle": _drawn("rounded", (0, 0, 299, 299), (300, 300)),
    "a hexagon": _drawn("hexagon", (0, 0, 299, 299), (300, 300)),
    "a small circle": _drawn("ellipse", (60, 60, 240, 240), (300, 300)),
    "nothing": Image.new("RGBA", (64, 64)),
    "an opaque square": Image.new("RGBA", (64, 64), (20, 30, 40, 255)),
}


@pytest.mark.parametrize("name", ROUND)
def test_a_round_picture_is_told(name: str) -> None:
    picture = ROUND[name]
    opaque = sum(code >= 128 for code in picture.getchannel("A").tobytes()) / (picture.width * picture.height)
    assert share_outside(picture) == pytest.approx(1 - opaque, abs=0.01)
    assert share_outside(picture) == pytest.approx(CORNERS, abs=0.04)


@pytest.mark.parametrize("name", OTHERS)
def test_other_pictures_have_no_round_outline(name: str) -> None:
    assert share_outside(OTHERS[name]) == 0.0


@pytest.mark.parametrize(
    ("options", "code"), [((), 3), (("--ground", "#efe6d0"), 0), (("--crop", "20%,20% 80%,80%"), 0)]
)
def test_the_knots_outside_are_a_failed_check(tmp_path: Path, options: tuple[str, ...], code: int) -> None:
    ROUND["a circle"].save(tmp_path / "round.png")
    with pytest.raises(SystemExit) as end:
        main(["chart", str(tmp_path / "round.png"), "--quality", "8x8/dm", "--out", str(tmp_path / "out"), *options])
    assert (end.value.code or 0) == code
    data = json.loads((tmp_path / "out" / "chart.json").read_text())
    failed = {check["name"]: check["value"] for check in data["checks"] if not check["ok"]}
    assert failed == ({"knots outside of the round picture": pytest.approx(CORNERS, abs=0.01)} if code else {})


@pytest.mark.parametrize("shape", ["round", "oval", "picture"])
@pytest.mark.parametrize("colours", ["2", "auto"])
def test_a_round_carpet_needs_no_yarn_for_what_is_cut_away(tmp_path: Path, shape: str, colours: str) -> None:
    """The list has no white, which the picture's ground would be: no colour is lost, none takes a yarn's place."""
    picture = ROUND["a circle"].copy()
    ImageDraw.Draw(picture).ellipse((100, 100, 200, 200), fill=(31, 47, 81, 255))
    picture.save(tmp_path / "round.png")
    yarns = [("red", "#9e2b25"), ("navy", "#1f2f51"), ("sand", "#d8b98c")]
    (tmp_path / "yarns.toml").write_text(
        "".join(f'[[yarn]]\nname = "{name}"\nsrgb = "{code}"\n' for name, code in yarns)
    )
    options = [
        "--size",
        "60x60cm",
        "--quality",
        "10x10/dm",
        "--yarns",
        str(tmp_path / "yarns.toml"),
        "--colours",
        colours,
    ]
    with pytest.raises(SystemExit) as end:
        main(["chart", str(tmp_path / "round.png"), *options, "--shape", shape, "--out", str(tmp_path / "out")])
    assert not end.value.code
    data = json.loads((tmp_path / "out" / "chart.json").read_text())
    assert all(check["ok"] for check in data["checks"])
    knots = {line["name"]: line["knots"] for line in data["results"]["yarn"] if line["use"] == "pile"}
    assert knots == {
        "red": pytest.approx(math.pi * (30**2 - 10**2), rel=0.02),
        "navy": pytest.approx(math.pi * 10**2, rel=0.05),
    }


@pytest.mark.parametrize("mode", ["RGBA", "LA", "P"])
def test_a_picture_of_nothing_is_an_error(tmp_path: Path, mode: str, capsys: pytest.CaptureFixture[str]) -> None:
    Image.new("RGBA", (60, 40)).convert(mode).save(
        tmp_path / "nothing.png", **({"transparency": 0} if mode == "P" else {})
    )
    with pytest.raises(SystemExit) as end:
        main(["chart", str(tmp_path / "nothing.png"), "--out", str(tmp_path / "out")])
    assert end.value.code == 2
    assert "all 60 x 40 pixels are transparent" in capsys.readouterr().err
