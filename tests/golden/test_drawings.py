"""Every drawing of the documentation is that of its script, and the photograph too."""

import contextlib
import io
import re
import runpy
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).parents[2]
STATIC = ROOT / "docs" / "_static"
SLOW = {
    f"draw_{name}"
    for name in (
        *("approximation", "arrangement", "clearance", "four_bars", "loom_scaling"),
        *("nine_points", "overview", "path", "warp_machines"),
    )
}
"""Scripts that take more than a second of processor time."""

SCRIPTS = sorted(
    script
    for script in (ROOT / "examples").glob("draw_*.py")
    if script.stem not in ("draw_medallion", "draw_photograph")
)
BY_HAND = {"workshop-cam.svg"}
"""A view of a DXF by another program: its texts are outlines of the fonts of one machine."""

_NUMBER = re.compile(r"-?\d+\.?\d*(?:e[+-]\d+)?")
_PICTURE = re.compile(r"data:image/[^\"]*")


def _drawn(script: Path, folder: Path) -> dict[str, str]:
    """The drawings of a script, by name: run in a copy of its folders, with the pictures it shows."""
    drawings = folder / "docs" / "_static"
    shutil.copytree(STATIC, drawings, ignore=shutil.ignore_patterns("*.svg"))
    shutil.copytree(ROOT / "examples", folder / "examples", ignore=shutil.ignore_patterns("__pycache__"))
    with contextlib.redirect_stdout(io.StringIO()):
        runpy.run_path(str(folder / "examples" / script.name), run_name="__main__")
    return {file.name: file.read_text(encoding="utf-8") for file in drawings.glob("*.svg")}


def _parts(drawing: str) -> tuple[list[str], np.ndarray]:
    """What is not a number, without pictures inside, and the numbers."""
    plain = _PICTURE.sub("", drawing)
    return _NUMBER.split(plain), np.array([float(number) for number in _NUMBER.findall(plain)])


@pytest.mark.parametrize(
    "script", [script for script in SCRIPTS if script.stem not in SLOW], ids=lambda script: script.stem
)
def test_the_drawings_of_a_script_are_those_of_the_pages(script: Path, tmp_path: Path) -> None:
    _compare(script, tmp_path)


@pytest.mark.matrix(light=0)
@pytest.mark.parametrize(
    "script", [script for script in SCRIPTS if script.stem in SLOW], ids=lambda script: script.stem
)
def test_the_drawings_of_a_long_script_are_those_of_the_pages(script: Path, tmp_path: Path) -> None:
    _compare(script, tmp_path)


def _compare(script: Path, tmp_path: Path) -> None:
    drawings = _drawn(script, tmp_path)
    assert drawings
    for name, drawing in drawings.items():
        (texts, numbers), (shown_texts, shown) = _parts(drawing), _parts((STATIC / name).read_text(encoding="utf-8"))
        assert texts == shown_texts, f"{name} differs: run {script.name} again"
        assert np.allclose(numbers, shown, rtol=0, atol=0.021), f"{name} differs: run {script.name} again"


def test_every_drawing_has_a_script() -> None:
    sources = "".join(script.read_text(encoding="utf-8") for script in SCRIPTS)
    stems = [drawing.stem for drawing in STATIC.glob("*.svg") if drawing.name not in BY_HAND]
    # A name stands whole in its script, or without its last part, which the script adds.
    without = [stem for stem in stems if stem not in sources and stem.partition("-")[2] not in sources]
    assert not without


@pytest.mark.matrix(light=0)
def test_the_photograph_is_that_of_its_script() -> None:
    module = runpy.run_path(str(ROOT / "examples" / "draw_photograph.py"))
    drawn = np.asarray(Image.open(io.BytesIO(module["draw"]())), dtype=float)
    shown = np.asarray(Image.open(ROOT / "examples" / "photo.jpg"), dtype=float)
    assert np.abs(drawn - shown).mean() < 2
    assert (ROOT / "examples" / "photo.jpg").stat().st_size < 300_000
