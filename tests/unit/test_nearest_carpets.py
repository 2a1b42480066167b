"""The nearest carpets that a loom could weave, against a trial of every share."""

from typing import Any

import pytest

from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.automated_loom.nearest import SHARES, nearest_fits
from ilmek.units import dm

WISHES = AutomatedLoomParams(aim="price", width=2.0, knots_across=50 / dm, knots_along=40 / dm)


@pytest.mark.parametrize("finest", [60 / dm, 43 / dm, 31 / dm, 16 / dm, 10 / dm])
@pytest.mark.parametrize("widest", [1.85, 1.0, 0.3])
@pytest.mark.parametrize("spoilt_in_space", [0.0, 0.2])
def test_the_largest_share_that_weaves_is_named(
    monkeypatch: pytest.MonkeyPatch, finest: float, widest: float, spoilt_in_space: float
) -> None:
    """A loom that weaves up to a quality, and one up to a width: each less by a share where its parts are compared."""

    def weaves(params: AutomatedLoomParams, *, in_space: bool = True) -> bool:
        most = 1.0 - spoilt_in_space * in_space
        coarser = params.knots_across < WISHES.knots_across
        return params.knots_across <= most * finest if coarser else params.width <= most * widest

    monkeypatch.setattr("ilmek.machines.automated_loom.nearest.weaves", weaves)
    tried: dict[str, list[Any]] = {
        "quality": [share for share in SHARES if 50 / dm * share <= (1 - spoilt_in_space) * finest],
        "width": [share for share in SHARES if 2.0 * share <= (1 - spoilt_in_space) * widest],
    }
    named = {fit.wish: float(fit.value.split()[0].partition("/")[0]) for fit in nearest_fits(WISHES)}
    whole = {"quality": 50.0, "width": 2.0}
    expected = {wish: whole[wish] * max(shares) for wish, shares in tried.items() if shares}
    assert {wish: value for wish, value in named.items() if wish != "knot"} == pytest.approx(expected)
