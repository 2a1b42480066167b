"""Lone knots: none is left, nothing else is touched, and the books balance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.isolated_knots import count_lone, merge_lone
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint


def lone_by_definition(knots: np.ndarray) -> np.ndarray:
    padded = np.pad(knots.astype(int), 1, constant_values=-1)
    around = [padded[1:-1, :-2], padded[1:-1, 2:], padded[:-2, 1:-1], padded[2:, 1:-1]]
    return np.all([side != knots for side in around], axis=0) & np.any([side >= 0 for side in around], axis=0)


@given(rows=st.integers(1, 12), columns=st.integers(1, 12), yarns=st.integers(2, 6), seed=st.integers(0, 10**6))
def test_one_pass_leaves_none(rows: int, columns: int, yarns: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rgb = rng.integers(0, 256, (rows, columns, 3), dtype=np.uint8)
    labs = srgb_to_lab(rng.integers(0, 256, (yarns, 3), dtype=np.uint8))
    colours = distinct_colours(rgb)
    index, difference = nearest_yarns(colours, labs)
    before = paint(rgb, colours, index)
    lone = lone_by_definition(before)
    after = before.copy()
    assert count_lone(before) == lone.sum()
    merged, added = merge_lone(after, rgb, colours, labs, difference)
    assert count_lone(after) == 0
    assert not np.any((after != before) & ~lone)
    assert merged <= lone.sum()
    target = srgb_to_lab(rgb)
    totals = [delta_e_2000(target, labs[knots]).sum() for knots in (before, after)]
    assert totals[1] - totals[0] == pytest.approx(added, abs=1e-6)


def test_lone_knot_takes_the_neighbour_nearest_to_its_own_colour() -> None:
    palette = np.array([[250, 0, 0], [0, 250, 0], [0, 0, 250], [0, 190, 0]], dtype=np.uint8)
    rgb = palette[np.array([[0, 0, 2], [0, 3, 2], [1, 1, 1]])]
    colours = distinct_colours(rgb)
    index, difference = nearest_yarns(colours, srgb_to_lab(palette))
    knots = paint(rgb, colours, index)
    assert merge_lone(knots, rgb, colours, srgb_to_lab(palette), difference)[0] == 1
    assert knots.tolist() == [[0, 0, 2], [0, 1, 2], [1, 1, 1]]
