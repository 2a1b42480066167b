"""Oblique slides, yokes and crossed sliders by hand: pressure and transmission angles, extremes of rates, scale."""

import numpy as np
import pytest

from ilmek.linkage.anchors import span
from ilmek.linkage.extremes import rate_extremes
from ilmek.linkage.judgement import growths
from ilmek.linkage.model import GROUND, Body, Coupling, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.one_input import one_input
from ilmek.linkage.outputs import Coordinate, Travel
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import pressure_angle, transmission_angles

ANGLES = np.linspace(0.1, 6.2, 25)
CRANK, ROD, ALONG, OFFSET = 0.05, 0.17, np.radians(37.0), 0.02


def slider_crank_on_a_slope() -> Mechanism:
    """A slider-crank whose line, `OFFSET` left of the pivot, has the slope `ALONG`."""
    root = 1j * OFFSET * np.exp(1j * ALONG)
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "line": root}),
            Body("crank", {"O": 0, "A": CRANK}),
            Body("rod", {"A": 0, "B": ROD}),
            Body("block", {"B": 0, "line": 0}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "rod"),
            Pin("B", "rod", "block"),
            Slide("line", "block", GROUND, along=ALONG),
        ),
        inputs=(Rotation("crank", "O"),),
        branches={"B": +1},
    )


def test_the_rod_leans_against_an_oblique_line_by_its_height_over_its_length() -> None:
    """The crank's pin is r sin(q - slope) above the line's parallel through the pivot, the line `OFFSET` above it."""
    motion = solve(plan(slider_crank_on_a_slope()), ANGLES)
    height = OFFSET - CRANK * np.sin(ANGLES - ALONG)
    lean = np.arcsin(np.abs(height) / ROD)
    assert pressure_angle(motion, "line") == pytest.approx(lean, abs=1e-12)
    assert transmission_angles(motion)["B"] == pytest.approx(np.pi / 2 - lean, abs=1e-12)


def yoke() -> Mechanism:
    """A Scotch yoke, its slot square to the ram, on a line of the slope `ALONG`: s = r cos(q - slope)."""
    return Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "line": 0}),
            Body("crank", {"O": 0, "A": CRANK}),
            Body("block", {"A": 0, "slot": 0}),
            Body("ram", {"slot": 0, "line": 0, "T": 0.1}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Pin("A", "crank", "block"),
            Slide("slot", "block", "ram", along=np.pi / 2),
            Slide("line", "ram", GROUND, along=ALONG, turned=ALONG),
        ),
        inputs=(Rotation("crank", "O"),),
    )


@pytest.mark.parametrize("samples", [720, 40])
def test_the_rate_of_a_yoke_is_least_and_greatest_at_mid_stroke(samples: int) -> None:
    crank = one_input(plan(yoke()))
    found = rate_extremes(crank, Travel("line"), 0.0, 2 * np.pi, samples=samples)
    assert [extreme.input for extreme in found] == pytest.approx([ALONG + np.pi / 2, ALONG + 3 * np.pi / 2])
    assert [extreme.value for extreme in found] == pytest.approx([-CRANK, CRANK])
    assert [extreme.greatest for extreme in found] == [False, True]


@pytest.mark.parametrize("begin", [0.0, 12 * 2 * np.pi])
def test_extremes_of_a_rate_that_lie_close_together_keep_their_kind(begin: float) -> None:
    """A point of a gear of ratio 12 on the crank: x = r cos q + e cos 12 q; many extremes, five steps apart."""
    ratio, eccentric = 12.0, 0.004
    wheel = Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "W": 1.0}),
            Body("crank", {"O": 0}),
            Body("wheel", {"W": 0, "P": eccentric}),
        ),
        joints=(Pin("O", GROUND, "crank"), Pin("W", GROUND, "wheel")),
        inputs=(Rotation("crank", "O"),),
        couplings=(Coupling("belt", "belt", ("crank", "O"), ("wheel", "W"), ratio, 0.0, 0.0),),
    )
    found = rate_extremes(one_input(plan(wheel)), Coordinate("wheel", "P"), begin, begin + 2 * np.pi, samples=120)
    kept = begin + (np.arange(24) + 0.5) * np.pi / ratio
    assert [extreme.input for extreme in found] == pytest.approx(list(kept))
    greatest = -np.sin(ratio * kept) < 0  # x' = -12 e sin(12 q): least where the sine is 1
    assert [extreme.greatest for extreme in found] == list(~greatest)
    assert [extreme.value for extreme in found] == pytest.approx(list(-ratio * eccentric * np.sin(ratio * kept)))


def test_rounding_grows_with_the_crossing_angle_of_two_sliders_alone() -> None:
    """1 / sin^3 of the angle between the lines, whatever the sliders' lengths: 10 mm in a mechanism of 3 m."""
    crossed = Mechanism(
        bodies=(
            Body(GROUND, {"O": 0, "line": 3.0}),
            Body("crank", {"O": 0, "slot": 0}),
            Body("first", {"slot": 0, "C": 0.01}),
            Body("second", {"line": 0, "C": 0.01}),
        ),
        joints=(
            Pin("O", GROUND, "crank"),
            Slide("slot", "first", "crank"),
            Pin("C", "first", "second"),
            Slide("line", "second", GROUND, np.pi / 2),
        ),
        inputs=(Rotation("crank", "O"),),
    )
    planned, size = plan(crossed), span(crossed)
    assert size == 3.0
    assert growths(planned, [None, 0.5], size) == [1.0, pytest.approx(8.0)]
    assert growths(planned, [None, 0.5], 2 * size) == [1.0, pytest.approx(16.0)]
