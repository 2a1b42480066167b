"""Laws of any beam: equilibrium, superposition, Maxwell's reciprocity, derivatives, mirror and work."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.elements.beam.uniform import Beam, Couple, LineLoad, PointLoad, bend

LENGTH = 2.0
place = st.integers(0, 40).map(lambda n: n * LENGTH / 40)
size = st.complex_numbers(max_magnitude=100, allow_nan=False, allow_infinity=False)
point = st.builds(PointLoad, place, size)
couple = st.builds(Couple, place, size)
line = st.tuples(st.lists(st.integers(0, 40), min_size=2, max_size=2, unique=True), size, size).map(
    lambda drawn: LineLoad(min(drawn[0]) * LENGTH / 40, max(drawn[0]) * LENGTH / 40, drawn[1], drawn[2])
)
loads = st.lists(st.one_of(point, couple, line), min_size=1, max_size=5).map(tuple)
supports = st.lists(st.integers(0, 20), min_size=2, max_size=5, unique=True).map(
    lambda drawn: tuple(n * LENGTH / 20 for n in sorted(drawn))
)


@st.composite
def beams(draw):
    at = draw(supports)
    ends = [end for end in (0.0, LENGTH) if end in at]
    return at, draw(loads), tuple(draw(st.lists(st.sampled_from(ends), unique=True)) if ends else ())


def first_moment(load) -> complex:
    if isinstance(load, Couple):
        return load.moment
    if isinstance(load, PointLoad):
        return load.at * load.force
    middle, half = (load.start + load.end) / 2, (load.end - load.start) / 2
    return 2 * half * (middle * load.value(middle) + load.gradient * half * half / 3)


@settings(max_examples=15)
@given(beams())
def test_equilibrium_and_supports(drawn) -> None:
    beam = Beam(LENGTH, *drawn)
    bent = bend(beam)
    moments = sum(first_moment(load) for load in beam.loads)
    held = sum(at * force for at, force in zip(beam.supports, bent.reactions, strict=True)) + sum(bent.clamps)
    strength = 1 + max(abs(reaction) for reaction in bent.reactions) + max(map(abs, bent.clamps), default=0.0)
    assert sum(bent.reactions) == pytest.approx(beam.weight, abs=1e-10 * strength)
    assert held == pytest.approx(moments, abs=1e-10 * strength)
    assert np.max(np.abs(bent.deflection(np.array(beam.supports), 1.0))) < 1e-11 * strength
    for end in beam.clamped:
        assert abs(bent.slope(end, 1.0)) < 1e-11 * strength


@settings(max_examples=12)
@given(beams())
def test_line_moment_and_shear_are_continuous_where_they_must_be(drawn) -> None:
    """y and y' everywhere; M but at couples and clamps, V but at forces and supports."""
    beam = Beam(LENGTH, *drawn)
    bent = bend(beam)
    inner = bent.breaks[1:-1]
    strength = 1 + max(abs(reaction) for reaction in bent.reactions) + bent.moment_max.size
    before = inner - 1e-9
    assert np.all(np.abs(bent.deflection(inner, 1.0) - bent.deflection(before, 1.0)) < 1e-7 * strength)
    assert np.all(np.abs(bent.slope(inner, 1.0) - bent.slope(before, 1.0)) < 1e-7 * strength)
    turned = {load.at for load in beam.loads if isinstance(load, Couple)}
    smooth = np.array([x for x in inner if x not in turned])
    assert np.all(np.abs(bent.moment(smooth) - bent.moment(smooth - 1e-9)) < 1e-6 * strength)
    ends = bent.moment(np.array([LENGTH])), bent.shear(np.array([LENGTH]))
    if LENGTH not in beam.supports and not any(getattr(load, "at", None) == LENGTH for load in beam.loads):
        assert np.all(np.abs(ends) < 1e-10 * strength)


@settings(max_examples=12)
@given(supports, loads, loads)
def test_superposition(at, first, second) -> None:
    x = np.linspace(0, LENGTH, 33)
    together = bend(Beam(LENGTH, at, first + second)).deflection(x, 1.0)
    apart = bend(Beam(LENGTH, at, first)).deflection(x, 1.0) + bend(Beam(LENGTH, at, second)).deflection(x, 1.0)
    np.testing.assert_allclose(together, apart, atol=1e-9)


@settings(max_examples=12)
@given(supports, place, place)
def test_maxwells_reciprocity(at, one, other) -> None:
    """A unit force here deflects there as one there deflects here; a unit couple likewise by the slope."""
    by_one, by_other = (bend(Beam(LENGTH, at, (PointLoad(x, 1.0),))) for x in (one, other))
    assert by_one.deflection(other, 1.0) == pytest.approx(by_other.deflection(one, 1.0), abs=1e-12)
    by_couple = bend(Beam(LENGTH, at, (Couple(other, 1.0),)))
    assert by_one.slope(other, 1.0) == pytest.approx(by_couple.deflection(one, 1.0), abs=1e-12)


@settings(max_examples=15)
@given(supports, loads)
def test_mirrored_beam(at, drawn) -> None:
    def turned(load):
        if isinstance(load, LineLoad):
            return LineLoad(LENGTH - load.end, LENGTH - load.start, load.value(load.end), load.first)
        flipped = LENGTH - load.at
        return PointLoad(flipped, load.force) if isinstance(load, PointLoad) else Couple(flipped, -load.moment)

    x = np.linspace(0, LENGTH, 33)
    there = bend(Beam(LENGTH, at, drawn)).deflection(x, 1.0)
    mirrored = Beam(LENGTH, tuple(LENGTH - place for place in reversed(at)), tuple(map(turned, drawn)))
    np.testing.assert_allclose(bend(mirrored).deflection(LENGTH - x, 1.0), there, atol=1e-9)


@settings(max_examples=15)
@given(beams())
def test_extremes_are_never_passed(drawn) -> None:
    bent, x = bend(Beam(LENGTH, *drawn)), np.linspace(0, LENGTH, 801)
    for values, largest in (
        (bent.shear(x), bent.shear_max),
        (bent.moment(x), bent.moment_max),
        (bent.slope(x, 3.0), bent.slope_max(3.0)),
        (bent.deflection(x, 3.0), bent.deflection_max(3.0)),
    ):
        assert np.max(np.abs(values)) <= largest.size * (1 + 1e-9) + 1e-12
        assert 0 <= largest.at <= LENGTH
