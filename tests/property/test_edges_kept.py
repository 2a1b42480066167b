"""The share of the edges that a chart keeps, against loops over all blocks, and its limits."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from scipy.ndimage import maximum_filter, maximum_filter1d, minimum_filter
from skimage.color import deltaE_ciede2000, rgb2lab

from ilmek.carpet.averages import LATTICE, averages_of, reading_loss
from ilmek.carpet.colour import decode, encode, srgb_to_lab
from ilmek.carpet.colour_groups import ColourGroups
from ilmek.carpet.edges_kept import FAINT, REACH, edges_kept, edges_of, lost_colours
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint

YARNS = np.array([(29, 24, 21), (239, 230, 208), (158, 43, 37), (52, 86, 139)], dtype=np.uint8)


def plain_share(design: np.ndarray, chart: np.ndarray) -> float | None:
    """The share by scikit-image's CIEDE2000 of the means of all blocks, the chart's up to a knot beside."""
    labs = [rgb2lab(picture) for picture in (design, chart)]
    means = [(lab[:-1, :-1] + lab[1:, :-1] + lab[:-1, 1:] + lab[1:, 1:]) / 4 for lab in labs]
    seen = kept = 0.0
    for reach, axis in product((2, REACH), (0, 1)):
        pairs = [(np.delete(mean, np.s_[:reach], axis), np.delete(mean, np.s_[-reach:], axis)) for mean in means]
        contrast, drawn = (deltaE_ciede2000(*pair) for pair in pairs)
        drawn = maximum_filter1d(drawn, 3, axis, mode="constant")
        edge = contrast >= FAINT
        seen += contrast[edge].sum()
        kept += np.minimum(contrast, 2 * drawn)[edge].sum()
    return kept / seen if seen else None


@given(st.integers(6, 24), st.integers(6, 24), st.integers(0, 10_000))
def test_share_is_that_of_all_blocks(rows: int, columns: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    shades = random.integers(0, 256, (int(random.integers(2, 9)), 3)).astype(np.uint8)
    design = shades[random.integers(0, len(shades), (rows, columns))]
    distinct, labs = distinct_colours(design), srgb_to_lab(YARNS)
    knots = paint(design, distinct, nearest_yarns(distinct, labs)[0])
    expected = plain_share(design, YARNS[knots])
    found = edges_kept(edges_of(design, distinct), knots, labs)
    assert found == (None if expected is None else pytest.approx(expected, abs=2e-3))


def test_a_blank_chart_keeps_nothing_and_the_design_itself_all() -> None:
    design = np.repeat(np.repeat(YARNS[np.arange(36).reshape(6, 6) % 4], 9, 0), 9, 1)
    distinct, labs = distinct_colours(design), srgb_to_lab(YARNS)
    knots = paint(design, distinct, nearest_yarns(distinct, labs)[0])
    assert edges_kept(edges_of(design, distinct), knots, labs) == 1.0
    assert edges_kept(edges_of(design, distinct), np.zeros_like(knots), labs) == 0.0
    flat = np.full_like(design, 90)
    assert edges_kept(edges_of(flat, distinct_colours(flat)), knots, labs) is None


def test_a_sample_of_a_large_chart_is_near_to_all_of_it() -> None:
    y, x = np.mgrid[:700, :500]
    grey = 128 + 60 * np.sin(x / 23 + y / 41) + 50 * (np.hypot(x - 250, y - 350) < 180)
    design = np.stack([np.clip(grey, 0, 255)] * 3, axis=-1).astype(np.uint8)
    distinct, labs = distinct_colours(design), srgb_to_lab(YARNS)
    knots = paint(design, distinct, nearest_yarns(distinct, labs)[0])
    assert knots.size > LATTICE
    assert edges_kept(edges_of(design, distinct), knots, labs) == pytest.approx(
        plain_share(design, YARNS[knots]), abs=0.02
    )


@pytest.mark.parametrize("grid", [(60, 40), (1210, 830)])
def test_smoothed_edges_are_kept_and_shades_are_not(grid: tuple[int, int]) -> None:
    """Averages by Pillow's box filter of linear light; a large chart is compared on strips of rows."""
    rows, columns = grid
    y, x = np.mgrid[: 2 * rows, : 3 * columns] / (2 * rows)
    disc = np.hypot(y - 0.5, x - 0.5) < 0.31
    picture = np.where(disc[..., None], YARNS[2], YARNS[1])
    averages = averages_of(picture, grid)
    light = decode(picture / 255).reshape(rows, 2, columns, 3, 3).mean(axis=(1, 3))
    assert np.abs(encode(light)[averages.rows] * 255 - averages.colours).max() < 1.0
    design = YARNS[np.where(light[..., 1] < decode(np.array(128 / 255)), 2, 1)]
    distinct, labs = distinct_colours(design), srgb_to_lab(YARNS)
    knots = paint(design, distinct, nearest_yarns(distinct, labs)[0])
    edges = edges_of(design, distinct, averages)
    assert edges_kept(edges, knots, labs) == pytest.approx(1.0, abs=0.015)
    assert reading_loss(design, averages, knots, labs) == 0.0
    shaded = np.clip(picture.astype(float) - 90 * x[..., None] * disc[..., None], 0, 255).astype(np.uint8)
    seen = averages_of(shaded, grid)
    full = np.asarray(Image.fromarray(shaded).reduce((3, 2)))
    off = deltaE_ciede2000(rgb2lab(full), rgb2lab(design))
    inside = maximum_filter(design, (3, 3, 1)) == minimum_filter(design, (3, 3, 1))
    within, rim = (np.where(where & (off >= 5.0), off, 0.0).mean() for where in (inside.all(-1), ~inside.all(-1)))
    assert 0.97 * within <= reading_loss(design, seen, knots, labs) <= 1.03 * (within + rim)
    assert within > 1.0


@given(st.integers(2, 9), st.integers(0, 10_000))
def test_a_colour_is_lost_in_a_larger_one_of_its_yarn_wherever_they_lie(number: int, seed: int) -> None:
    """By scikit-image and loops over all pairs; no two colours of these groups touch."""
    random = np.random.default_rng(seed)
    srgb = random.integers(0, 256, (number, 3)).astype(np.uint8)
    knots = np.sort(10.0 ** random.uniform(0, 4, number))[::-1]
    yarn_of = random.integers(0, len(YARNS), number).astype(np.uint8)
    apart = np.zeros((number, number))
    groups = ColourGroups(np.arange(number, dtype=np.uint8), srgb_to_lab(srgb), knots, apart)
    lab, expected = rgb2lab(srgb[None])[0], {}
    for lesser in range(number):
        share = knots[lesser] / knots.sum()
        least = 5.0 if share >= 0.003 else 10.0 if share >= 0.0005 else 1000.0
        for larger in reversed(range(lesser)):
            if yarn_of[lesser] == yarn_of[larger] and deltaE_ciede2000(lab[lesser], lab[larger]) >= least:
                expected[tuple(srgb[lesser])] = (tuple(srgb[larger]), int(yarn_of[lesser]), pytest.approx(share))
    found = lost_colours(groups, yarn_of, srgb_to_lab(YARNS))
    assert {one.srgb: (one.other, one.yarn, one.share) for one in found} == expected
    assert [one.share for one in found] == sorted((one.share for one in found), reverse=True)
