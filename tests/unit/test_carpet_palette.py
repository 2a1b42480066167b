"""Palette: each distinct colour once, and the best N yarns against every choice tried."""

import itertools
import math

import numpy as np
import pytest

from ilmek.carpet import palette
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.palette import best_yarns, distinct_colours, nearest_yarns, paint
from ilmek.errors import YarnError
from ilmek.progress import Progress


def picture(seed: int, levels: int = 5) -> np.ndarray:
    codes = np.random.default_rng(seed).integers(0, levels, (40, 30, 3)) * (255 // (levels - 1))
    return codes.astype(np.uint8)


def test_distinct_colours_are_counted() -> None:
    rgb = picture(1)
    colours = distinct_colours(rgb)
    flat, counts = np.unique(rgb.reshape(-1, 3), axis=0, return_counts=True)
    assert len(colours.labs) == len(flat)
    for colour, count in zip(flat.astype(int), counts, strict=True):
        place = colours.index[colour[0] << 16 | colour[1] << 8 | colour[2]] - 1
        assert colours.counts[place] == count
        assert colours.labs[place] == pytest.approx(srgb_to_lab(colour.astype(np.uint8)))


def test_painted_with_the_nearest_yarn() -> None:
    rgb = picture(2, levels=200)
    yarns = srgb_to_lab(np.random.default_rng(3).integers(0, 256, (9, 3), dtype=np.uint8))
    colours = distinct_colours(rgb)
    shares: list[float] = []
    knots = paint(rgb, colours, nearest_yarns(colours, yarns, Progress(lambda _, share: shares.append(share)))[0])
    assert np.array_equal(knots, delta_e_2000(srgb_to_lab(rgb)[..., None, :], yarns).argmin(axis=-1))
    assert shares == [1.0]


@pytest.mark.parametrize("trials", [palette._MOST_TRIALS, 0], ids=["all tried", "greedy and swaps"])
@pytest.mark.parametrize("seed", range(6))
def test_best_yarns_against_every_choice(seed: int, trials: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(palette, "_MOST_TRIALS", trials)
    colours = distinct_colours(picture(seed, levels=4))
    yarns = srgb_to_lab(np.random.default_rng(seed).integers(0, 256, (9, 3), dtype=np.uint8))
    table = delta_e_2000(colours.labs, yarns[:, None]) * colours.counts

    def total(choice: tuple[int, ...]) -> float:
        return float(table[list(choice)].min(axis=0).sum())

    for count in (2, 4, 8):
        least = min(total(choice) for choice in itertools.combinations(range(9), count))
        found = best_yarns(colours, yarns, count)
        assert len(set(found)) == count
        assert list(found) == sorted(found)
        assert total(found) == pytest.approx(least, rel=1e-5)


def test_near_colours_are_pooled_where_the_table_would_be_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    colours = distinct_colours(picture(4, levels=100))
    yarns = srgb_to_lab(np.random.default_rng(4).integers(0, 256, (12, 3), dtype=np.uint8))
    table = delta_e_2000(colours.labs, yarns[:, None]) * colours.counts
    exact = best_yarns(colours, yarns, 5)
    monkeypatch.setattr(palette, "_LARGEST_TABLE", 12 * 200)
    pooled = best_yarns(colours, yarns, 5)
    totals = [table[list(choice)].min(axis=0).sum() for choice in (exact, pooled)]
    assert len(colours.labs) > 1000
    assert totals[0] <= totals[1] * (1 + 1e-6) <= totals[0] * 1.02


@pytest.mark.parametrize("count", [-1, 0, 1, 10])
def test_counts_refused(count: int) -> None:
    colours = distinct_colours(picture(5))
    with pytest.raises(YarnError, match=f"{count} colours cannot be picked"):
        best_yarns(colours, srgb_to_lab(np.zeros((9, 3), dtype=np.uint8)), count)


def test_all_yarns_of_the_list_is_a_choice() -> None:
    colours = distinct_colours(picture(6))
    yarns = srgb_to_lab(np.random.default_rng(6).integers(0, 256, (7, 3), dtype=np.uint8))
    assert math.comb(7, 7) == 1
    assert best_yarns(colours, yarns, 7) == tuple(range(7))
