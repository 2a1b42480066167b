"""Lone knots are counted as they are defined."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ilmek.carpet.tally import tally_of


def lone_by_definition(knots: np.ndarray) -> np.ndarray:
    padded = np.pad(knots.astype(int), 1, constant_values=-1)
    around = [padded[1:-1, :-2], padded[1:-1, 2:], padded[:-2, 1:-1], padded[2:, 1:-1]]
    return np.all([side != knots for side in around], axis=0) & np.any([side >= 0 for side in around], axis=0)


@given(rows=st.integers(1, 12), columns=st.integers(1, 12), yarns=st.integers(2, 6), seed=st.integers(0, 10**6))
def test_lone_knots_are_counted(rows: int, columns: int, yarns: int, seed: int) -> None:
    knots = np.random.default_rng(seed).integers(0, yarns, (rows, columns), dtype=np.uint8)
    assert tally_of(knots, yarns).lone == lone_by_definition(knots).sum()
