"""A four-bar as drawn is the linkage that moves: same pins and tracer, and shifted, turned, scaled, mirrored alike."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from ilmek.errors import MechanismError
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.four_bar import FourBar, LinkLengths, from_lengths

places = st.builds(complex, st.floats(-2, 2), st.floats(-2, 2))


@st.composite
def drawn(draw: st.DrawFn) -> FourBar:
    pins = [draw(places) for _ in range(4)]
    a0, b0, a, b = pins
    assume(min(abs(b0 - a0), abs(a - a0), abs(b - a), abs(b - b0)) > 0.1)
    assume(abs(((b0 - a).conjugate() * (b - a)).imag) > 0.02)
    return FourBar(a0, b0, a, b, draw(places))


@settings(max_examples=40)
@given(drawn())
def test_the_linkage_at_the_drawn_crank_angle_is_the_drawing(four_bar: FourBar) -> None:
    motion = solve(plan(four_bar.mechanism()), np.array([four_bar.crank_angle])).require()
    for body, point, place in (
        ("rocker", "B", four_bar.b),
        ("coupler", "A", four_bar.a),
        ("coupler", "P", four_bar.tracer),
    ):
        assert motion.point(body, point).position[0] == pytest.approx(place, abs=1e-9)
    assert np.exp(1j * motion.angle("rocker")[0]) == pytest.approx(np.exp(1j * four_bar.rocker_angle), abs=1e-9)


@settings(max_examples=40)
@given(drawn(), st.floats(-3, 3), st.floats(0.1, 10), places)
def test_shape_survives_moving_turning_scaling(four_bar: FourBar, angle: float, factor: float, by: complex) -> None:
    other = four_bar.moved(by).turned(angle).scaled(factor)
    assert other.lengths == pytest.approx([factor * length for length in four_bar.lengths])
    assert other.branch == four_bar.branch
    assert other.tracer_on_coupler == pytest.approx(factor * four_bar.tracer_on_coupler, abs=1e-9)
    assert math.cos(other.crank_angle - four_bar.crank_angle - angle) == pytest.approx(1)


@settings(max_examples=40)
@given(drawn())
def test_a_mirrored_four_bar_is_put_together_the_other_way(four_bar: FourBar) -> None:
    other = four_bar.mirrored()
    assert other.branch == -four_bar.branch
    assert other.lengths == pytest.approx(four_bar.lengths)
    assert other.mirrored() == four_bar


@settings(max_examples=40)
@given(drawn())
def test_reversed_drives_the_same_linkage_by_its_rocker(four_bar: FourBar) -> None:
    other = four_bar.reversed()
    assert (other.lengths.crank, other.lengths.rocker) == (four_bar.lengths.rocker, four_bar.lengths.crank)
    assert other.reversed() == four_bar


@settings(max_examples=40)
@given(drawn())
def test_a_four_bar_is_drawn_again_from_its_lengths(four_bar: FourBar) -> None:
    ground = np.angle(four_bar.b0 - four_bar.a0)
    again = from_lengths(
        four_bar.lengths, four_bar.crank_angle - ground, branch=four_bar.branch, tracer=four_bar.tracer_on_coupler
    )
    placed = again.turned(float(ground)).moved(four_bar.a0)
    assert abs(placed.b - four_bar.b) < 1e-9
    assert abs(placed.tracer - four_bar.tracer) < 1e-8


def test_a_four_bar_in_line_is_drawn() -> None:
    stretched = from_lengths(LinkLengths(0.3, 0.1, 0.1, 0.1), 0.0, branch=+1)
    assert stretched.b == pytest.approx(0.2)


def test_what_is_no_four_bar_is_refused() -> None:
    with pytest.raises(MechanismError, match="crank of the four-bar is 0 m"):
        FourBar(0j, 1 + 0j, 0j, 1 + 1j)
    with pytest.raises(MechanismError, match="tracer of the four-bar"):
        FourBar(0j, 1 + 0j, 1j, 1 + 1j, complex(math.nan, 0))
    with pytest.raises(MechanismError, match="does not close at crank angle 180 deg"):
        from_lengths(LinkLengths(0.3, 0.1, 0.1, 0.1), math.pi, branch=+1)
    with pytest.raises(MechanismError, match=r"\+1 or -1"):
        from_lengths(LinkLengths(0.3, 0.1, 0.2, 0.2), 0.0, branch=0)
