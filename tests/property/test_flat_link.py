"""Moments of flat links in closed form: those of their shape, by Green's theorem over its outline."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.part.flat_link import PinHole, flat_link, flat_link_moments


@given(
    st.floats(0.01, 2.0),
    st.floats(0.2, 0.9),
    st.floats(1e-3, 0.1),
    st.lists(st.tuples(st.floats(0.0, 0.9), st.floats(0.1, 0.6)), max_size=3),
)
def test_the_closed_form_is_the_shape_s(length: float, slender: float, thickness: float, drilled: list) -> None:
    width = slender * length
    # Holes one after another along the link, each in its own third.
    bores = [PinHole((k + share) * length / 3, size * width / 3) for k, (share, size) in enumerate(drilled)]
    apart = all(b.at - a.at > (a.diameter + b.diameter) / 2 for a, b in pairwise(bores))
    bores = bores if apart else bores[:1]
    shape = flat_link(length, width, thickness, bores).moments
    found = flat_link_moments(length, width, thickness, bores)
    assert found.zeroth == pytest.approx(shape.zeroth, rel=1e-12)
    assert found.first == pytest.approx(shape.first[0], rel=1e-12)
    assert found.second == pytest.approx(shape.second[0, 0] + shape.second[1, 1], rel=1e-12)
    assert found.about_centre == pytest.approx(shape.inertia[2, 2], rel=1e-10)


def test_many_links_are_those_one_by_one() -> None:
    lengths, holes = np.array([0.05, 0.2, 0.7]), np.array([0.0, 0.006, 0.01])
    many = flat_link_moments(lengths, 0.03, 0.01, [PinHole(0.0, holes), PinHole(lengths, holes)])
    for k, (length, hole) in enumerate(zip(lengths, holes, strict=True)):
        one = flat_link_moments(length, 0.03, 0.01, [PinHole(0.0, hole), PinHole(length, hole)])
        assert [float(moment[k]) for moment in many] == pytest.approx(list(one), rel=1e-15)
