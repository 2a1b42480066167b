"""Laws of crossing words: what is done to a yarn without crossing a warp leaves its word; the laws of the group."""

from itertools import pairwise

import numpy as np
from effort import examples
from hypothesis import given
from hypothesis import strategies as st

from ilmek.units import mm
from ilmek.weaving.knots.crossings import WarpRow, arc_lengths, crossings, row_of_warps
from ilmek.weaving.knots.path import KnotDimensions, knot_path
from ilmek.weaving.knots.proof import knot_of_curve, tied_knot
from ilmek.weaving.knots.word import SINGLE, inverse, knot, passes, recognised, reduced

CASES = examples(100, 20)
WARPS = row_of_warps(5, 1.0)
ROW = WarpRow(WARPS)
LETTERS = st.integers(1, 5).flatmap(lambda warp: st.sampled_from((warp, -warp)))
WORDS = st.lists(LETTERS, max_size=9).map(tuple)
SEEDS = st.integers(0, 2**32 - 1)
KINDS = st.sampled_from(("symmetric", "asymmetric", SINGLE))
SIDES = st.sampled_from(("left", "right"))


def word_of(points: np.ndarray) -> tuple[int, ...]:
    return reduced(crossings(ROW, points))


def drawn(word: tuple[int, ...]) -> np.ndarray:
    """A polyline that crosses the cuts as the word says, coming up into the pile between any two letters."""
    corners = [-1 + 2j]
    for letter in word:
        before, after = (-0.5, 0.5) if letter > 0 else (0.5, -0.5)
        at = abs(letter) - 1
        corners += [at + before + 2j, at + before - 1j, at + after - 1j, at + after + 2j]
    return np.array([*corners, 7 + 3j, 7 + 2j])


def holds_a_warp(a: complex, b: complex, c: complex) -> bool:
    """Whether the triangle holds a warp, or comes near one."""
    sides = [np.imag(np.conj(q - p) * (WARPS - p)) / max(abs(q - p), 1e-9) for p, q in ((a, b), (b, c), (c, a))]
    near = 1e-6
    return bool(np.any((np.min(sides, axis=0) > -near) | (np.max(sides, axis=0) < near)))


def deformed(points: np.ndarray, seed: int, moves: int = 120) -> np.ndarray:
    """Corners added, moved and led to and fro at random; a move that would sweep a warp is left out."""
    random = np.random.default_rng(seed)
    line = list(points)
    for _ in range(moves):
        at = int(random.integers(1, len(line) - 1))
        target = line[at] + complex(*random.normal(0.0, 1.0, 2))
        kind = random.integers(3)
        if kind == 0:
            share = random.uniform()
            line.insert(at, line[at - 1] + share * (line[at] - line[at - 1]))
        elif kind == 1:
            line[at:at] = [line[at], target]
        elif not (holds_a_warp(line[at - 1], line[at], target) or holds_a_warp(line[at], target, line[at + 1])):
            line[at] = target
    return np.array(line)


@CASES
@given(WORDS)
def test_a_path_drawn_from_a_word_has_that_word(word: tuple[int, ...]) -> None:
    assert crossings(ROW, drawn(word)) == word
    assert word_of(drawn(word)) == reduced(word)


@CASES
@given(WORDS, SEEDS)
def test_deforming_a_path_without_crossing_a_warp_leaves_its_word(word: tuple[int, ...], seed: int) -> None:
    moved = deformed(drawn(word), seed)
    assert word_of(moved) == reduced(word)


@CASES
@given(KINDS, st.integers(1, 2), SIDES, st.integers(1, 2), SEEDS)
def test_deforming_a_knot_leaves_the_knot(kind: str, first: int, opens: str, each: int, seed: int) -> None:
    known = knot(kind, first, opens=opens, each=each)
    curve = knot_path(known, KnotDimensions(1.0, 0.4, 0.2, 0.1, leg=2.0))
    points = deformed(curve.point(curve.distances(0.4)), seed, moves=60)
    assert tied_knot(points, WARPS).knot == known


@CASES
@given(WORDS, SEEDS, st.floats(-20.0, 20.0))
def test_stirring_the_plane_between_the_warps_leaves_the_word(word: tuple[int, ...], seed: int, turns: float) -> None:
    """A whirl in a circle that holds no warp: a homeomorphism of the plane that leaves every warp where it is."""
    random = np.random.default_rng(seed)
    points = drawn(word)
    fine = np.concatenate([np.linspace(a, b, 800, endpoint=False) for a, b in pairwise(points)])
    fine = np.append(fine, points[-1])
    centre = complex(random.uniform(-2, 6), random.uniform(-2, 1))
    radius = 0.98 * np.abs(WARPS - centre).min()
    away = np.abs(fine - centre) / radius
    whirl = centre + (fine - centre) * np.exp(1j * turns * np.maximum(1 - away**2, 0.0) ** 2)
    assert word_of(whirl) == reduced(word)


@CASES
@given(WORDS, WORDS)
def test_words_form_the_free_group(first: tuple[int, ...], second: tuple[int, ...]) -> None:
    one, two = drawn(first), drawn(second)
    assert word_of(np.concatenate([one, two])) == reduced(first + second)
    assert word_of(one[::-1]) == reduced(inverse(first)) == inverse(reduced(first))
    assert word_of(np.concatenate([one, one[::-1]])) == ()
    mirrored = tuple(-(6 - letter) if letter > 0 else 6 + letter for letter in first)
    assert word_of(4 - np.conj(one)) == reduced(mirrored)


@CASES
@given(WORDS, SEEDS)
def test_word_counts_the_turns_that_angles_count(word: tuple[int, ...], seed: int) -> None:
    """The letters of each warp add up to the winding number of the closed path about it, measured by its angle."""
    points = deformed(drawn(word), seed)
    closed = np.append(points, points[0])
    for warp, place in enumerate(WARPS, start=1):
        turns = np.angle((closed[1:] - place) / (closed[:-1] - place)).sum() / (2 * np.pi)
        assert round(turns) == sum(np.sign(letter) for letter in word if abs(letter) == warp)


@CASES
@given(WORDS, SEEDS)
def test_reduction_does_not_depend_on_the_order_of_striking_out(word: tuple[int, ...], seed: int) -> None:
    random, left = np.random.default_rng(seed), list(word)
    while pairs := [at for at in range(len(left) - 1) if left[at] == -left[at + 1]]:
        at = pairs[int(random.integers(len(pairs)))]
        del left[at : at + 2]
    assert reduced(word) == tuple(left)


@CASES
@given(WORDS)
def test_passes_put_together_are_the_word_and_no_knot_is_known_by_two_names(word: tuple[int, ...]) -> None:
    assert tuple(letter for part in passes(word) for letter in part) == word
    known = recognised(reduced(word))
    if known:
        assert reduced(word) in (known.word, inverse(known.word))


@CASES
@given(SEEDS)
def test_a_smooth_motion_is_judged_alike_by_its_bound_and_by_dense_samples(seed: int) -> None:
    random = np.random.default_rng(seed)
    waves = np.arange(1, 5)
    size = (random.normal(0, 1, 4) + 1j * random.normal(0, 1, 4)) / waves
    back = (random.normal(0, 1, 4) + 1j * random.normal(0, 1, 4)) / waves
    speed = float(2 * np.pi * ((np.abs(size) + np.abs(back)) * waves).sum())

    def curve(u: np.ndarray) -> np.ndarray:
        phase = np.exp(2j * np.pi * u[:, None] * waves)
        return np.asarray(2 + (phase @ size) * 1.0 + np.conj(phase) @ back)

    dense = curve(np.linspace(0.0, 1.0, 4001))
    if np.abs(dense[:, None] - WARPS).min() < 0.02:
        return
    lengths = arc_lengths(dense)
    assert lengths.max() <= speed / 4000
    assert knot_of_curve(curve, speed, WARPS) == tied_knot(dense, WARPS, lengths=lengths)


@CASES
@given(st.floats(0.01, 100.0), st.floats(0.1, 0.9), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_every_curve_there_is_ties_its_knot(pitch: float, filled: float, share: float, spare: float) -> None:
    """Any pitch, any warp and yarn that leave room, any clearance."""
    room = pitch * filled
    warp, yarn = room * (0.1 + 0.8 * share), room * (0.9 - 0.8 * share)
    size = KnotDimensions(pitch * mm, warp * mm, yarn * mm, (pitch - room) / 2 * spare * mm * (1 - 1e-9), pitch * mm)
    for kind, opens, each in (("symmetric", "left", 1), ("asymmetric", "right", 1), ("asymmetric", "left", 2)):
        known = knot(kind, 2, opens=opens, each=each)
        curve = knot_path(known, size)
        points = curve.point(curve.distances(size.radius / 20))
        tied = tied_knot(points, row_of_warps(6, size.pitch), keep_out=0.99 * size.radius, lengths=arc_lengths(points))
        assert tied.knot == known


@CASES
@given(SEEDS)
def test_sweeping_a_path_across_one_warp_changes_its_word(seed: int) -> None:
    """The control of the laws above: the word tells the two sides of a warp apart."""
    corners = np.random.default_rng(seed).normal(0.0, 3.0, (20, 3, 2)) @ np.array([1, 1j]) + 2
    around = np.roll(corners, -1, axis=1)
    sides = np.imag(np.conj(around - corners)[..., None] * (WARPS - corners[..., None]))
    inside = (sides > 0).all(axis=1) | (sides < 0).all(axis=1)
    swept = corners[inside.sum(axis=1) == 1]
    assert all(word_of(triangle) != word_of(triangle[[0, 2]]) for triangle in swept)
    empty = corners[inside.sum(axis=1) == 0]
    assert all(word_of(triangle) == word_of(triangle[[0, 2]]) for triangle in empty)
