"""Power cuts at random instants, on a disc that loses, tears and reorders writes: every knot is in the carpet once."""

import pytest
from effort import seeds
from loom_cuts.cuts import FAULTY, CutPort, woven_through_cuts
from small_programme import small_programme

from ilmek.loom.twin.comparison import chart_digest
from ilmek.loom.twin.model import NO_FAULTS

PROGRAMME = small_programme(6, 24, 3, 4)


@pytest.mark.parametrize("group", [1, 7])
@pytest.mark.parametrize("rates", [NO_FAULTS, FAULTY], ids=["sound", "faulty"])
def test_a_carpet_is_woven_whole_through_power_cuts(group: int, rates: object) -> None:
    cuts = 0
    for seed in seeds(2, 12):
        found = woven_through_cuts(PROGRAMME, seed, group=group, rates=rates, mean=25.0)  # type: ignore[arg-type]
        assert found.findings == []
        assert found.woven.digest == chart_digest(PROGRAMME)
        cuts += found.cuts
    assert cuts > 50


def test_the_campaign_notices_a_knot_that_is_tied_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(CutPort, "knotted", lambda *_: False)
    assert any(woven_through_cuts(PROGRAMME, seed, mean=25.0).woven.double for seed in range(4))


def test_without_cuts_the_time_is_that_of_the_programme() -> None:
    through, without = (woven_through_cuts(PROGRAMME, 1, most=most) for most in (None, 0))
    assert without.cuts == 0
    assert through.time >= without.time
    assert without.woven.digest == through.woven.digest
