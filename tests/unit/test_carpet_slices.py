"""Charts are made in slices of rows, with the same result for slices of any size."""

import numpy as np
import pytest

from ilmek.carpet import confetti, design, differences, palette, patches, tally
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.palette_rules import PaletteParams
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.yarn_file import default_yarns
from ilmek.progress import Cancelled, Progress
from ilmek.viz.carpet_picture import draw_carpet

PICTURE = np.random.default_rng(3).integers(0, 256, (90, 70, 3), dtype=np.uint8)
SIZE = CarpetSize(0.6, 0.7)


def made(quality: float, progress: Progress | None = None) -> Chart:
    yarns = default_yarns()
    return make_chart(
        PICTURE,
        SIZE,
        Quality(quality, quality),
        yarns,
        palette=PaletteParams(colours=7),
        progress=progress or Progress(),
    )


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("quality", [40.0, 120.0])
@pytest.mark.parametrize("most", [1, 1000])
def test_slices_change_nothing(monkeypatch: pytest.MonkeyPatch, quality: float, most: int) -> None:
    whole = made(quality)
    picture = draw_carpet(whole).jpeg
    bands = design.bands
    for module in (design,):
        monkeypatch.setattr(module, "_SLICE", most)
    for module in (palette, confetti, patches, tally, differences):
        monkeypatch.setattr(module, "bands", lambda rows, columns, _=0: bands(rows, columns, most))
    sliced = made(quality)
    assert np.array_equal(sliced.knots, whole.knots)
    for name in ("counts", "lone_fraction", "changes_per_knot", "yarns"):
        assert getattr(sliced, name) == getattr(whole, name)
    assert sliced.reading.mean_delta_e == whole.reading.mean_delta_e
    assert draw_carpet(sliced).jpeg == picture


@pytest.mark.parametrize("most", [5, 300, 3000])
def test_colours_are_pooled_by_cells_in_the_order_of_their_keys(most: int) -> None:
    codes = np.random.default_rng(5).integers(0, 256, (5000, 3), dtype=np.uint8)
    corners = np.array([[r, g, b] for r in (0, 255) for g in (0, 255) for b in (0, 255)], dtype=np.uint8)
    colours = palette.distinct_colours(np.concatenate([codes, codes[:1000], corners])[None])
    labs, weights = palette.pooled(colours, most)
    cell, cells = 1.0, most + 1
    while cells > most:
        keys = (np.floor(colours.labs / cell).astype(np.int64) + 512) @ np.array([1 << 20, 1 << 10, 1])
        group = np.unique(keys, return_inverse=True)[1]
        cells, cell = group.max() + 1, 1.5 * cell
    assert np.array_equal(weights, np.bincount(group, colours.counts))
    means = [np.bincount(group, colours.counts * axis) / weights for axis in colours.labs.T]
    assert np.allclose(labs, np.stack(means, axis=-1), rtol=1e-12)


def test_progress_ascends_and_is_cancelled() -> None:
    shares: list[float] = []
    made(400.0, Progress(lambda _, share: shares.append(share)))
    assert shares == sorted(shares)
    assert len(shares) > 20
    for last in range(0, len(shares), 5):
        calls = iter(range(len(shares)))
        with pytest.raises(Cancelled):
            made(400.0, Progress(cancelled=lambda calls=calls, last=last: next(calls) >= last))


def test_the_tally_is_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    chart = made(100.0)
    assert sum(chart.counts) == chart.knots.size
    monkeypatch.setattr("ilmek.carpet.chart.tally_of", None)
    assert chart.colours == 7
    assert "_tallies" not in repr(chart)
