"""Corners and a size cut nothing of a photographed carpet, whatever the perspective suggests."""

from pathlib import Path

import numpy as np
import photographs
import pytest
from PIL import Image

from ilmek.api import carpets
from ilmek.carpet.chart import Chart
from ilmek.carpet.fitting import FitParams, prepare_picture
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.straightening import true_proportions

DATA, EXAMPLES = Path(__file__).parents[1] / "data", Path(__file__).parents[2] / "examples"

IN_PHOTO = "306.3,15.1 579.9,34.5 610.5,409.1 146.7,352.1"
"""Corners of the carpet in `carpet-in-photo.jpg`, whose perspective suggests 0.52 : 1 instead of 2 : 3."""


def colours(chart: Chart) -> np.ndarray:
    return np.array([yarn.lab for yarn in chart.yarns])[chart.knots]


def test_the_medallion_in_a_cropped_photograph_is_whole() -> None:
    settings = {"size": "120x180cm", "quality": "5x5/dm", "reading": "photo", "yarns": "wool", "halftone": 0.0}
    found = carpets.make_chart(DATA / "carpet-in-photo.jpg", corners=IN_PHOTO, **settings)
    truth = carpets.make_chart(EXAMPLES / "medallion.png", **settings)
    fit = found.reading.fit
    assert (fit.cropped, fit.padded, fit.shown) == (0.0, 0.0, (0.0, 0.0, 1.0, 1.0))
    # The medallion is its own mirror image, so what is cut at one end shows.
    apart = np.linalg.norm(colours(found) - colours(truth), axis=-1)
    shifted = np.linalg.norm(colours(found)[4:-4] - colours(truth)[8:], axis=-1)
    assert np.median(apart) < 5.0 < np.median(shifted)
    for end in (apart[:4], apart[-4:], apart[:, :4], apart[:, -4:]):
        assert np.mean(end) < 20.0


QUADS = {
    "upright": ([(200, 60), (620, 90), (700, 560), (90, 500)], CarpetSize(1.0, 1.5), 0.0),
    "lying": ([(120, 150), (760, 110), (850, 560), (60, 500)], CarpetSize(1.0, 1.5), np.pi / 2),
}
"""Corners drawn freely: no camera shows a rectangle of those proportions so."""


@pytest.mark.parametrize("name", QUADS)
def test_a_checkerboard_between_free_corners_is_whole(name: str) -> None:
    quad, size, turned = QUADS[name]
    across, along = (20, 30) if turned == 0.0 else (30, 20)
    board = Image.fromarray(photographs.checkerboard(across, along, 24))
    photo = np.asarray(photographs.projected_by_pillow(board, quad, (640, 900)))
    text = " ".join(f"{x},{y}" for x, y in quad)
    for fit in ("auto", "crop", "pad"):
        made, done = prepare_picture(photo, FitParams(corners=text, fit=fit), size=size)
        assert (done.cropped, done.turned) == (0.0, turned)
        assert made.shape[1] / made.shape[0] == pytest.approx(size.width / size.length, abs=0.003)
        reds = np.asarray(Image.fromarray(made).resize((20, 30), Image.Resampling.BOX))[..., 0] > 115
        odd = (np.arange(20) + np.arange(30)[:, None] + (turned != 0.0)) % 2 == 1
        assert np.array_equal(reds, ~odd)


def test_without_a_size_the_proportions_are_those_of_the_perspective() -> None:
    with Image.open(DATA / "carpet-in-photo.jpg") as photo:
        rgb = np.asarray(photo)
    quad = np.array([[float(one) for one in point.split(",")] for point in IN_PHOTO.split()])
    made, _ = prepare_picture(rgb, FitParams(corners=IN_PHOTO))
    guessed = true_proportions(quad, rgb.shape[1], rgb.shape[0])
    assert made.shape[1] / made.shape[0] == pytest.approx(guessed, abs=0.005)
    assert guessed < 0.6
