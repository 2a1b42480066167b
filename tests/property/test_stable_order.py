"""The stable order by digits is that of NumPy's stable sort."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from ilmek.num.stable_order import stable_order


@given(st.lists(st.integers(0, 2**24 - 1), max_size=300), st.sampled_from([np.int32, np.int64]), st.integers(0, 23))
def test_order_is_that_of_a_sort_by_comparisons(numbers: list[int], kind: type[np.integer], shift: int) -> None:
    found = np.array(numbers, dtype=kind) >> shift  # many are equal
    assert stable_order(found).tolist() == np.argsort(found, kind="stable").tolist()
