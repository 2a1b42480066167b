"""The quality of a JPEG file as Pillow wrote it, and the note on one that breaks lines."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, JpegImagePlugin

from ilmek.io.jpeg_quality import jpeg_loss, jpeg_quality
from ilmek.io.picture import read_picture

PICTURE = Image.fromarray(np.random.default_rng(3).integers(0, 256, (16, 16, 3), dtype=np.uint8))


def written(quality: int) -> JpegImagePlugin.JpegImageFile:
    file = io.BytesIO()
    PICTURE.save(file, format="JPEG", quality=quality)
    file.seek(0)
    return JpegImagePlugin.JpegImageFile(file)


def test_the_quality_is_the_one_that_was_asked_for() -> None:
    found = [jpeg_quality(written(quality).quantization[0]) for quality in range(10, 101)]
    assert found == list(range(10, 101))


@pytest.mark.parametrize(
    ("quality", "named"), [(40, True), (60, True), (69, True), (70, False), (75, False), (95, False)]
)
def test_a_low_quality_is_named(tmp_path: Path, quality: int, named: bool) -> None:
    file = tmp_path / "drawing.jpg"
    PICTURE.save(file, quality=quality)
    notes = [note for note in read_picture(file).notes if "quality" in note]
    assert bool(notes) == named
    assert not named or f"a JPEG of quality {quality}," in notes[0]


def test_a_png_has_none() -> None:
    assert jpeg_loss(PICTURE) == ()
