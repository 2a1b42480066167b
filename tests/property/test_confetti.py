"""Patches are components; confetti is merged alike in every position, and what was drawn stays."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from ilmek.carpet import confetti
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.confetti import merge_patches
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint
from ilmek.carpet.patches import count_patches, small_patches
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import LEAST_PATCHES, ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import yarn_labs
from ilmek.io.yarn_file import default_yarns
from ilmek.num import threads

YARNS = default_yarns()
LABS = yarn_labs(YARNS)
SRGB = np.array([yarn.srgb for yarn in YARNS], dtype=np.uint8)
BLACK, IVORY, RED = 8, 5, 0
PHOTO = LEAST_PATCHES["photo"]


def painted(rgb: np.ndarray) -> np.ndarray:
    colours = distinct_colours(rgb)
    return paint(rgb, colours, nearest_yarns(colours, LABS)[0])


def grained(seed: int, shape: tuple[int, int] = (40, 32), scale: float = 14.0) -> np.ndarray:
    """Two soft areas with the grain of a photograph, which its yarns turn into specks."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[: shape[0], : shape[1]]
    soft = 120 + 70 * np.sin(x / 9 + rng.uniform(0, 6)) * np.cos(y / 11)
    picture = soft[..., None] * rng.uniform(0.6, 1.0, 3) + rng.normal(scale=scale, size=(*shape, 3))
    return np.asarray(np.clip(np.rint(picture), 0, 255), dtype=np.uint8)


def merged(rgb: np.ndarray, least: int = PHOTO) -> np.ndarray:
    return merge_patches(painted(rgb), rgb, LABS, least)[0]


def sizes(knots: np.ndarray) -> list[int]:
    of_all: list[int] = []
    for yarn in np.unique(knots):
        labels, _ = ndimage.label(knots == yarn, np.ones((3, 3)))
        of_all += np.bincount(labels.ravel())[1:].tolist()
    return of_all


def around_small(knots: np.ndarray, most: int) -> dict[int, int]:
    """The knots of small patches, and the yarn that most of the knots around have, by dilation of each component."""
    found: dict[int, int] = {}
    for yarn in np.unique(knots):
        labels, number = ndimage.label(knots == yarn, np.ones((3, 3)))
        for label in range(1, number + 1):
            own = labels == label
            if own.sum() > most:
                continue
            counts = np.zeros(int(knots.max()) + 1)
            for row, column in np.argwhere(own):  # a knot around counts for each knot that it touches
                near = knots[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2]
                counts += np.bincount(near[near != yarn], minlength=len(counts))
            around = int(counts.argmax()) if counts.any() else int(yarn)
            found |= dict.fromkeys(np.flatnonzero(own).tolist(), around)
    return found


@given(
    rows=st.integers(1, 14), columns=st.integers(1, 14), yarns=st.integers(2, 6), most=st.integers(1, 9),
    seed=st.integers(0, 10**6),
)  # fmt: skip
def test_patches_are_the_components(rows: int, columns: int, yarns: int, most: int, seed: int) -> None:
    knots = np.random.default_rng(seed).integers(0, yarns, (rows, columns), dtype=np.uint8)
    assert count_patches(knots, most) == sum(size <= most for size in sizes(knots))
    found = small_patches(knots, most)
    assert found.sizes.sum() == count_patches(knots, most)
    assert dict(zip(found.knots.tolist(), found.around.tolist(), strict=True)) == around_small(knots, most)


@settings(max_examples=25)
@given(seed=st.integers(0, 10**6), least=st.integers(2, 12), scale=st.floats(2.0, 60.0))
def test_merging_again_changes_nothing_and_positions_do_not_matter(seed: int, least: int, scale: float) -> None:
    rgb = grained(seed, scale=scale)
    once = merged(rgb, least)
    assert merge_patches(once, rgb, LABS, least)[1] == 0
    for turn in (lambda a: a[::-1], lambda a: a[:, ::-1], np.rot90, lambda a: a.swapaxes(0, 1)):
        assert np.array_equal(merged(turn(rgb), least), turn(once))


@settings(max_examples=10)
@given(seed=st.integers(0, 10**6), least=st.integers(2, 12))
def test_every_change_removes_a_patch(seed: int, least: int) -> None:
    rgb = grained(seed)
    before, (after, changed) = painted(rgb), merge_patches(painted(rgb), rgb, LABS, least)
    assert changed == np.count_nonzero(after != before) > 0
    assert len(sizes(after)) < len(sizes(before))
    assert sorted(sizes(after))[-1] >= sorted(sizes(before))[-1] - changed


def test_grain_is_removed() -> None:
    rgb = grained(5, (200, 160))
    before, after = painted(rgb), merged(rgb)
    assert count_patches(before, 3) > 300
    assert count_patches(after, 3) < 0.15 * count_patches(before, 3)


def test_random_yarns_lose_their_patches() -> None:
    rgb = SRGB[np.random.default_rng(3).integers(0, 16, (120, 90))]
    before, after = painted(rgb), merged(rgb, 8)
    assert count_patches(after, 7) < 0.25 * count_patches(before, 7)


@pytest.mark.parametrize("least", [0, 1])
def test_nothing_changes_without_a_least_patch(least: int) -> None:
    rgb = grained(1)
    assert merge_patches(painted(rgb), rgb, LABS, least)[1] == 0


def ground(rows: int = 80, columns: int = 60, yarn: int = IVORY) -> np.ndarray:
    return np.full((rows, columns), yarn, dtype=np.uint8)


def spots(*places: tuple[object, object], yarn: int = RED) -> np.ndarray:
    """A ground with knots at rows and columns."""
    knots = ground()
    for rows, columns in places:
        knots[rows, columns] = yarn
    return knots


STEPS, SIXTHS = np.arange(50), np.rint(np.arange(3, 58, 6.4)).astype(int)
DRAWINGS = {
    "diagonal": spots((STEPS + 5, STEPS + 5)),
    "dotted border": spots((np.s_[4:-4:4], [4, 55]), ([4, 75], np.s_[4:-4:4])),
    "lattice": spots((np.s_[3::6], np.s_[3::7])),
    "staggered lattice": spots((np.s_[3::6], np.s_[3::8]), (np.s_[6::6], np.s_[7::8])),
    "uneven dots": spots((40, SIXTHS)),
    "dashes": spots(*((20 + k, np.s_[5 * k + 5 : 5 * k + 8]) for k in range(10))),
    "pieces of a line": np.where(
        (STEPS % 5 < 2)[:, None],
        spots((STEPS + 10, STEPS // 2 + 5))[10:60],
        spots((STEPS + 10, STEPS // 2 + 5), yarn=1)[10:60],
    ),
    "eyes": spots((20, [20, 30]), yarn=BLACK),
    "colon": spots((np.s_[20:22], np.s_[20:22]), (np.s_[25:27], np.s_[20:22])),
}
"""Drawings in yarns that their designers meant."""


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("kind", ["flat", "photo"])
def test_what_was_drawn_stays(name: str, kind: str) -> None:
    knots = DRAWINGS[name]
    assert merge_patches(knots, SRGB[knots], LABS, LEAST_PATCHES[kind])[1] == 0


@pytest.mark.parametrize("name", ["diagonal", "lattice", "dotted border", "staggered lattice", "dashes"])
def test_a_pattern_stays_whatever_the_least_patch(name: str) -> None:
    knots = DRAWINGS[name]
    kept = merge_patches(knots, SRGB[knots], LABS, 12)[0]
    lost = np.count_nonzero((kept != knots) & (knots == RED)) / np.count_nonzero(knots == RED)
    assert lost <= 0.05


def test_a_speck_of_the_ground_s_own_colour_goes() -> None:
    knots = ground()
    knots[20, 20], rgb = RED, SRGB[ground()]
    assert merge_patches(knots, rgb, LABS, 2) == (pytest.approx(ground()), 1)


def test_windows_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    rgb = grained(9, (400, 60), 30.0)
    whole = merged(rgb)
    monkeypatch.setattr(confetti, "bands", lambda rows, *_: (slice(row, row + 1) for row in range(rows)))
    assert np.array_equal(merged(rgb), whole)


@pytest.mark.parametrize("number", [1, 3])
def test_threads_change_nothing(monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    rgb = grained(9, (700, 60), 30.0)
    whole = chart(rgb, 4)
    for module in (threads, confetti):
        monkeypatch.setattr(module, "MOST_THREADS", number)
    monkeypatch.setattr(confetti, "_WINDOW", 1)
    made = chart(rgb, 4)
    assert np.array_equal(made.knots, whole.knots)
    assert made.tally() == whole.tally()
    assert made.reading.mean_delta_e == whole.reading.mean_delta_e
    assert made.reading.differences == whole.reading.differences


def test_light_has_the_colour_of_its_codes() -> None:
    codes = np.random.default_rng(1).integers(0, 256, (200, 3), dtype=np.uint8)
    labs = np.array([lab_of_light(*map(float, LIGHT[code])) for code in codes])
    assert np.abs(labs - srgb_to_lab(codes)).max() < 1e-3


def chart(rgb: np.ndarray, least: int) -> Chart:
    size, quality = CarpetSize(rgb.shape[1] / 1000, rgb.shape[0] / 1000), Quality(1000.0, 1000.0)
    return make_chart(rgb, size, quality, YARNS, reading=ReadParams(reading="photo", least_patch=least, halftone=0.0))


def test_differences_are_those_of_the_changed_chart() -> None:
    rgb = grained(2)
    plain, made = chart(rgb, 0), chart(rgb, 5)
    labs = srgb_to_lab(rgb)
    assert made.reading.changed == np.count_nonzero(made.knots != plain.knots) > 0
    assert made.reading.mean_delta_e == pytest.approx(delta_e_2000(labs, LABS[made.knots]).mean(), rel=1e-9)
    assert made.reading.least_delta_e == plain.reading.mean_delta_e < made.reading.mean_delta_e
    assert made.small_patches == count_patches(made.knots, 3)
