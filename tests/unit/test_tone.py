"""Tone: the closed forms of its rules."""

import numpy as np
import pytest

from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.palette import distinct_colours
from ilmek.carpet.reading import ReadParams, read_design
from ilmek.carpet.tone import Tone, found_white, toned, toned_labs
from ilmek.errors import ParameterError

LABS = np.array([[0.0, 0.0, 0.0], [25.0, 12.0, -30.0], [50.0, -20.0, 8.0], [100.0, 0.0, 0.0]])


@pytest.mark.parametrize("share", [-0.9, -0.2, 0.3, 0.9])
def test_brightness_keeps_black_and_white_and_moves_the_mid_tone(share: float) -> None:
    lightness = toned_labs(LABS, Tone(brightness=share), None)[:, 0]
    assert lightness[[0, 2, 3]] == pytest.approx([0.0, 50 * (1 + share), 100.0])
    assert np.all(np.diff(lightness) > 0)


def test_contrast_stretches_about_the_mid_tone() -> None:
    assert toned_labs(LABS, Tone(contrast=0.4), None)[:, 0] == pytest.approx([0.0, 15.0, 50.0, 100.0])
    assert toned_labs(LABS, Tone(contrast=-1.0), None)[:, 0] == pytest.approx(50.0)


def test_saturation_scales_chroma() -> None:
    assert toned_labs(LABS, Tone(saturation=-1.0), None)[:, 1:] == pytest.approx(0.0)
    assert toned_labs(LABS, Tone(saturation=0.5), None)[1] == pytest.approx([25.0, 18.0, -45.0])


@pytest.mark.parametrize("white", [(245, 239, 224), (190, 200, 210), (255, 255, 255)])
def test_the_white_becomes_white_and_greys_of_its_light_become_grey(white: tuple[int, int, int]) -> None:
    rgb = np.array([[white, (0, 0, 0), (120, 60, 30)]], dtype=np.uint8)
    made, _, said = toned(rgb, Tone(white=white))
    assert made[0, 0].tolist() == [255, 255, 255]
    assert made[0, 1].tolist() == [0, 0, 0]
    assert said == "; #{:02x}{:02x}{:02x} becomes white".format(*white)


def test_the_white_is_found_in_the_brightest_hundredth() -> None:
    rgb = np.full((100, 100, 3), 90, dtype=np.uint8)
    rgb[0] = (240, 230, 200)
    found = found_white(distinct_colours(rgb))
    assert toned(rgb, Tone(white="auto"))[0][0, 0].tolist() == [255, 255, 255]
    assert lab_to_srgb(srgb_to_lab(np.array([240, 230, 200], dtype=np.uint8))).tolist() == [240, 230, 200]
    assert found[1] == pytest.approx(0.7929, abs=1e-3)


def test_no_tone_changes_nothing() -> None:
    rgb = np.random.default_rng(0).integers(0, 256, (9, 7, 3), dtype=np.uint8)
    assert toned(rgb, Tone())[0] is rgb
    assert np.array_equal(toned(rgb, Tone(saturation=1e-9))[0], rgb)


@pytest.mark.parametrize("tone", [Tone(brightness=0.3), Tone(contrast=-0.9), Tone(saturation=-1.0, white="auto")])
def test_the_colours_after_a_tone_are_those_of_its_picture(tone: Tone) -> None:
    rgb = np.random.default_rng(5).integers(0, 60, (90, 70, 3), dtype=np.uint8)
    made, colours, _ = toned(rgb, tone)
    counted = distinct_colours(made)
    assert colours is not None
    assert len(counted.counts) < len(distinct_colours(rgb).counts)  # some colours become one
    assert np.array_equal(colours.index, counted.index)
    assert np.array_equal(colours.counts, counted.counts)
    assert np.array_equal(colours.labs, counted.labs)


def test_the_tone_acts_on_every_reading_and_is_reported() -> None:
    rgb = np.full((40, 40, 3), 119, dtype=np.uint8)
    for reading in ("flat", "photo"):
        design = read_design(rgb, (10, 10), ReadParams(reading=reading, brightness=0.2))
        assert design.colours[0, 0].tolist() == [145, 145, 145]  # L = 60
        assert design.reason.endswith("; brightness +20 %")


@pytest.mark.parametrize("white", ["red", "#12345", "#000020", "#f5efe0;"])
def test_a_white_that_is_none_is_refused(white: str) -> None:
    with pytest.raises(ParameterError, match="white"):
        ReadParams(white=white)
