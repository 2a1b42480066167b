"""The family of crank-rockers: closed forms against first principles, against each other and against brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.linkage import quality
from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    best_ratio,
    beta_limits,
    beta_of_ratio,
    coupler_limits,
    dead_centres,
    grashof_margin,
    links_of_beta,
    links_of_coupler,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
    transmission_angle_min,
    transmission_angles,
)
from ilmek.units import deg

unit = st.floats(0.02, 0.98)
swings = st.floats(5 * deg, 150 * deg)


def between(limits: tuple[float, float], part: float) -> float:
    return float(limits[0] + part * (limits[1] - limits[0]))


@st.composite
def tasks(draw: st.DrawFn) -> tuple[float, float]:
    swing = draw(swings)
    rotation = between(rotation_limits(swing), draw(unit))
    special = np.pi + swing
    return swing, rotation if abs(rotation - special) > 1e-3 else special + 1e-3


@given(tasks(), unit)
def test_closed_form_solves_the_two_dead_centre_equations(task: tuple[float, float], part: float) -> None:
    swing, rotation = task
    beta = between(beta_limits(swing, rotation), part)
    # (b - a) e^{i(beta + phi - pi)} - 1 = [(a + b) e^{i beta} - 1] e^{i psi}: linear in a and b.
    extended, folded = np.exp(1j * (beta + swing)), np.exp(1j * (beta + rotation - np.pi))
    of_a, of_b, known = -folded - extended, folded - extended, 1 - np.exp(1j * swing)
    matrix = np.array([[of_a.real, of_b.real], [of_a.imag, of_b.imag]])
    crank, coupler = np.linalg.solve(matrix, [known.real, known.imag])
    rocker = abs((crank + coupler) * np.exp(1j * beta) - 1)
    np.testing.assert_allclose(links_of_beta(swing, rotation, beta), (crank, coupler, rocker), rtol=1e-9)


@given(tasks(), unit)
def test_three_names_of_one_member_agree(task: tuple[float, float], part: float) -> None:
    swing, rotation = task
    beta = between(beta_limits(swing, rotation), part)
    links = links_of_beta(swing, rotation, beta)
    np.testing.assert_allclose(links_of_ratio(swing, rotation, links.crank / links.coupler), links, rtol=1e-8)
    np.testing.assert_allclose(links_of_coupler(swing, rotation, links.coupler), links, rtol=1e-8)
    np.testing.assert_allclose(beta_of_ratio(swing, rotation, links.crank / links.coupler), beta, rtol=1e-8)


@given(tasks(), unit)
def test_the_way_back_finds_swing_rotation_and_beta(task: tuple[float, float], part: float) -> None:
    swing, rotation = task
    ratio = between(ratio_limits(swing, rotation), part)
    found = dead_centres(links_of_ratio(swing, rotation, ratio))
    np.testing.assert_allclose(found, (swing, rotation, beta_of_ratio(swing, rotation, ratio)), atol=1e-7)


@given(swings, unit)
def test_every_coupler_works_where_rotation_is_half_a_turn_and_the_swing(swing: float, part: float) -> None:
    coupler = np.sin(swing / 2) + 4 * part
    links = links_of_coupler(swing, np.pi + swing, coupler)
    np.testing.assert_allclose(links.rocker**2, 1 + coupler**2 - links.crank**2, rtol=1e-12)
    np.testing.assert_allclose(dead_centres(links)[:2], (swing, np.pi + swing), rtol=1e-9)


@given(tasks())
def test_beta_and_coupler_intervals_are_those_of_strict_crank_rockers(task: tuple[float, float]) -> None:
    swing, rotation = task
    beta = np.linspace(-np.pi / 2, 1.5 * np.pi, 4001)
    links = links_of_beta(swing, rotation, beta)
    low, high = beta_limits(swing, rotation)
    shortest = (links.crank > 0) & (links.crank < links.coupler) & (links.crank < links.rocker) & (links.crank < 1)
    right = shortest & (grashof_margin(links) > 0) & (links.coupler > 0)
    # Outside, the formulas give other circuits (B below the ground line), other senses of rotation or no linkage.
    with np.errstate(invalid="ignore"):
        measured = dead_centres(LinkRatios(*(np.where(right, link, np.nan) for link in links)))
    right &= (np.abs(measured.beta - beta) < 1e-6) & (np.abs(measured.rotation - rotation) < 1e-6)
    away = (np.abs(beta - low) > 1e-6) & (np.abs(beta - high) > 1e-6)
    assert np.array_equal(right[away], ((beta > low) & (beta < high))[away])
    couplers = coupler_limits(swing, rotation)
    at_ends = links_of_beta(swing, rotation, np.array([low, high])).coupler
    np.testing.assert_allclose(np.sort(at_ends), couplers, rtol=1e-6)


@given(tasks())
def test_no_member_beats_the_best_ratio(task: tuple[float, float]) -> None:
    swing, rotation = task
    low, high = ratio_limits(swing, rotation)
    ratios = np.linspace(low, high, 2003)[1:-1]
    angles = transmission_angle_min(links_of_ratio(swing, rotation, ratios))
    best = float(best_ratio(swing, rotation))
    assert low <= best <= high
    assert float(transmission_angle_min(links_of_ratio(swing, rotation, best))) >= np.max(angles) - 1e-12
    # One maximum only: `select_ratio` relies on it.
    assert np.sum(np.diff(np.sign(np.diff(angles))) < 0) <= 1


@given(tasks(), unit)
def test_agrees_with_the_qualities_of_a_four_bar(task: tuple[float, float], part: float) -> None:
    swing, rotation = task
    links = links_of_ratio(swing, rotation, between(ratio_limits(swing, rotation), part))
    lengths = (1.0, *(float(link) for link in links))
    extended, folded = quality.dead_centres(*lengths, branch=+1)
    found = dead_centres(links)
    assert extended.crank_angle == pytest.approx(float(found.beta), abs=1e-6)
    assert np.angle(np.exp(1j * (folded.crank_angle - found.beta - found.rotation))) == pytest.approx(0, abs=1e-6)
    assert folded.rocker_angle - extended.rocker_angle == pytest.approx(swing, abs=1e-6)
    assert quality.transmission_extremes(*lengths) == pytest.approx(transmission_angles(links), abs=1e-7)
    assert quality.grashof(*lengths).kind == "crank-rocker"
