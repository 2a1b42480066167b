"""Frequencies of plane frames against closed forms of textbooks, and of the loom's frame against a finer model.

Evidence: Rao, Mechanical Vibrations, tables 8.4 and 8.5 (uniform beams); the portal with rigid and with hinged beams; a
finer model of the loom's frame, of lumped masses, with springs for its beams.
"""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements import plane_frame
from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.plane_frame import FrameMember, frame_frequencies
from ilmek.errors import ParameterError
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom import frame_modes as modes
from ilmek.machines.automated_loom.parts import parts_of_loom

MODULUS = 210e9
CLAMPED, HINGED = (True, True, True), (True, True, False)


def chain(number: int, length: float, turned: complex, inertia: float, line_mass: float) -> tuple:
    """A straight beam of so many members in a direction."""
    nodes = [turned * length * k / number for k in range(number + 1)]
    return nodes, [FrameMember(k, k + 1, 1.0, inertia, line_mass) for k in range(number)]


@settings(max_examples=8)
@given(st.floats(0.3, 5.0), st.floats(-3.1, 3.1), st.floats(1e-8, 1e-4), st.floats(1.0, 100.0))
def test_uniform_beams_in_any_direction_have_the_frequencies_of_the_textbooks(length, angle, inertia, line_mass):
    nodes, members = chain(4, length, np.exp(1j * angle), inertia, line_mass)
    unit = math.sqrt(MODULUS * inertia / line_mass) / length**2 / (2 * math.pi)
    for held, root in (
        ({0: CLAMPED}, 1.8751040687),
        ({0: CLAMPED, 4: CLAMPED}, 4.7300407449),
        ({0: HINGED, 4: HINGED}, math.pi),
        ({0: CLAMPED, 4: HINGED}, 3.9266023120),
    ):
        own = frame_frequencies(nodes, members, held, {}, MODULUS)
        assert own[0] == pytest.approx(root**2 * unit, rel=2e-3)


@settings(max_examples=12)
@given(st.floats(0.5, 3.0), st.floats(0.5, 3.0), st.floats(10.0, 1e4))
def test_a_portal_sways_by_the_stiffness_of_its_columns(height, width, mass):
    """k = 24 E I / h³ with a rigid beam on clamped columns, 6 E I / h³ on hinged ones, all mass at the beam."""
    nodes = [0j, 1j * height, width + 1j * height, complex(width)]
    column, stiff = FrameMember(0, 1, 1.0, 1e-6, 1e-6), FrameMember(1, 2, 1.0, 1e-1, 1e-6)
    members = [column, stiff, replace(column, start=3, end=2)]
    for held, share in ((CLAMPED, 24), (HINGED, 6)):
        own = frame_frequencies(nodes, members, {0: held, 3: held}, {1: mass / 2, 2: mass / 2}, MODULUS)
        assert own[0] == pytest.approx(math.sqrt(share * MODULUS * 1e-6 / height**3 / mass) / (2 * math.pi), rel=1e-3)


@settings(max_examples=12)
@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), min_size=3, max_size=6, unique=True), st.integers(1, 4))
def test_the_lowest_frequencies_are_those_of_a_dense_solver(points, count):
    """scipy's generalised eigenvalues of the same matrices, of frames at random with all nodes joined to the first."""
    nodes = [0j, *(complex(x, y) + 3.0 * k for k, (x, y) in enumerate(points, start=1))]
    members = [FrameMember(0, k, 1e-3, 1e-6, 8.0) for k in range(1, len(nodes))]
    masses = {k: 5.0 * k for k in range(1, len(nodes))}
    stiffness, bare = plane_frame._assembled(tuple(nodes), tuple(members), MODULUS)
    inertia = bare.copy()
    for node, mass in masses.items():
        inertia[3 * node, 3 * node] += mass
        inertia[3 * node + 1, 3 * node + 1] += mass
    squares = scipy.linalg.eigh(stiffness[3:, 3:], inertia[3:, 3:], eigvals_only=True)
    own = frame_frequencies(nodes, members, {0: CLAMPED}, masses, MODULUS, count=count)
    np.testing.assert_allclose(own, np.sqrt(squares[:count]) / (2 * math.pi), rtol=1e-6)


def test_a_frame_that_nothing_holds_is_refused():
    nodes, members = chain(2, 1.0, 1j, 1e-6, 8.0)
    with pytest.raises(ParameterError, match="mechanism"):
        frame_frequencies(nodes, members, {0: HINGED}, {}, MODULUS)


@cache
def loom(width: float) -> LoomDesign:
    return design(AutomatedLoomParams(aim="price", width=width, length=1.0))


def lumped_sway(own: LoomDesign) -> float:
    """The sway across of one half: its column of 120 lumps, turning held by springs 6 E I / b of the beams [Hz]."""
    frame = parts_of_loom(own).frame
    made, floor = modes.brackets_of(own), own.side.floor
    top, count = own.side.top - floor, 120
    step = top / count
    heights = step * np.arange(count + 1)
    size = 2 * (count + 1)
    k, m = np.zeros((size, size)), np.zeros(size)
    section, h = frame.column, step
    bent = frame.number * STEEL.modulus * section.inertia
    element = bent / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]])
    element = np.vstack([element, -element[0], bent / h * np.array([6 / h, 2, -6 / h, 4])])
    for first, _ in pairwise(range(count + 1)):
        at = slice(2 * first, 2 * first + 4)
        k[at, at] += element
        m[2 * first : 2 * first + 4 : 2] += frame.number * section.line_mass * step / 2
    wide = 2 * sum(frame.beside(made.face)) / frame.number
    base = modes.base_section(own, frame)
    for height, beam in (
        (modes.floor_top(own, frame) - base.side / 2 - floor, base),
        (modes.cam_beam(own, frame, made).imag - floor, section),
        (made.rest.imag - floor, made.beam),
    ):
        node = int(np.argmin(np.abs(heights - height)))
        k[2 * node + 1, 2 * node + 1] += 6 * STEEL.modulus * beam.inertia / wide
        m[2 * node] += beam.line_mass * wide / 2
    for mass, height in modes.carried_masses(own):
        m[2 * int(np.argmin(np.abs(heights - height)))] += mass / 2
    m[1::2] = 1e-9
    free = np.arange(1, size)
    low = scipy.linalg.eigh(k[np.ix_(free, free)], np.diag(m[free]), eigvals_only=True, subset_by_index=[0, 0])
    return float(np.sqrt(low[0])) / (2 * math.pi)


@pytest.mark.parametrize("width", [1.2, 0.8])
def test_the_frame_sways_across_as_a_fine_model_of_its_half_does(width):
    own = loom(width)
    found = modes.frame_modes(own, parts_of_loom(own).frame)
    assert found.across == pytest.approx(lumped_sway(own), rel=0.03)
    assert all(check.ok for check in found.checks)
    assert found.fastest >= own.params.beat_speed / (2 * math.pi) > 1 / own.times.knot


def test_a_thinner_column_and_a_quicker_beat_come_too_near():
    own = loom(1.2)
    frame = parts_of_loom(own).frame
    thin = modes.frame_modes(own, replace(frame, column=HollowSquare(0.04, 0.003)))
    assert thin.along < 0.5 * modes.frame_modes(own, frame).along
    assert [check.name for check in thin.checks if not check.ok]
    quick = replace(modes.frame_modes(own, frame), drives={"strokes of the beat": 7.5})
    assert [check.name for check in quick.checks if not check.ok] == ["frame: sway along the warps: natural frequency"]
