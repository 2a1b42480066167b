"""The table [map] in the studio, on two drawings: a flag of three colours, and an indexed picture of five."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from ilmek.errors import YarnError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.carpet import stages
from ilmek.jobs.studio.carpet.answers import ChartRequest
from ilmek.jobs.studio.carpet.tasks import chart

WOOL = {"yarns": "wool", "quality": "20x20/dm"}


def flag(folder: Path) -> np.ndarray:
    """A disc and a ring on a field, 400 × 600 pixels; returns the code of each pixel."""
    down, across = np.mgrid[:400, :600]
    radius = np.hypot(down - 200, across - 220)
    codes = np.select([radius < 60, (radius > 90) & (radius < 140)], [0xFFD100, 0xF4F4F4], 0x0A6B4F)
    Image.fromarray(colours(codes)).save(folder / "flag.png")
    return codes


def steps(folder: Path) -> np.ndarray:
    """Diagonal steps of five colours, 20 pixels a knot, as an indexed GIF; returns the code of each pixel."""
    palette = np.array([0x7B2D8B, 0xE07A1F, 0x2F9ED8, 0x101010, 0xF2EAD3])
    down, across = np.mgrid[:30, :20]
    codes = palette[(down + 2 * across) // 4 % 5].repeat(20, axis=0).repeat(20, axis=1)
    Image.fromarray(colours(codes)).quantize(8).save(folder / "steps.gif")
    return codes


def colours(codes: np.ndarray) -> np.ndarray:
    return np.stack([codes >> 16, codes >> 8 & 255, codes & 255], axis=-1).astype(np.uint8)


def shown(folder: Path, recipe: dict[str, Any]) -> tuple[dict[str, Any], np.ndarray]:
    """What the studio gets: about the chart, and the name of the yarn of each knot."""
    stages.forget()
    body = chart(ChartRequest({**WOOL, **recipe}), Context(str(folder))).body
    length = int.from_bytes(body[:4], "little")
    about = json.loads(body[4 : 4 + length])
    knots = np.frombuffer(body[4 + length :], np.uint8, about["rows"] * about["columns"])
    return about, np.array([yarn["name"] for yarn in about["yarns"]])[knots.reshape(about["rows"], about["columns"])]


@pytest.mark.parametrize(
    ("draw", "recipe", "pairs"),
    [
        (flag, {"picture": "flag.png", "size": "150x100cm"}, {"#0a6b4f": "rose", "#ffd100": "indigo navy"}),
        (steps, {"picture": "steps.gif", "size": "100x150cm"}, {"#7b2d8b": "gold", "#101010": "rose"}),
    ],
)
def test_each_pair_holds_knot_by_knot(tmp_path: Path, draw: Any, recipe: dict[str, Any], pairs: dict[str, str]) -> None:
    """The judge is the middle pixel of each knot, away from the edges of the areas."""
    codes = draw(tmp_path)
    about, yarns = shown(tmp_path, {**recipe, "map": pairs})
    rows, columns = yarns.shape
    down, across = codes.shape[0] / rows, codes.shape[1] / columns
    middle = codes[((np.arange(rows) + 0.5) * down).astype(int)][:, ((np.arange(columns) + 0.5) * across).astype(int)]
    even = np.ones_like(middle, dtype=bool)
    for axis in (0, 1):
        for step in (-1, 1):
            even &= np.roll(middle, step, axis) == middle
    for colour, yarn in pairs.items():
        assert set(yarns[even & (middle == int(colour[1:], 16))].tolist()) == {yarn}
    row = {one["colour"]: one["yarn"] for one in about["assignment"]}
    assert {colour: row[colour] for colour in pairs} == pairs


@pytest.mark.parametrize(
    ("draw", "recipe"),
    [(flag, {"picture": "flag.png", "size": "150x100cm"}), (steps, {"picture": "steps.gif", "size": "100x150cm"})],
)
def test_a_missing_yarn_is_named_with_its_row(tmp_path: Path, draw: Any, recipe: dict[str, Any]) -> None:
    draw(tmp_path)
    with pytest.raises(YarnError, match=r"map #0a6b4f: the list has no yarn 'silk'"):
        shown(tmp_path, {**recipe, "map": {"#FFD100": "ivory", "#0a6b4f": "silk"}})
