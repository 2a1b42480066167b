"""Random mechanisms of every group of class II, many at once; `python -m benchmarks accuracy` is the same with 10^5."""

import numpy as np
import pytest
from benchmarks.campaign.accuracy import accuracy
from benchmarks.campaign.branches import crank_rockers
from benchmarks.campaign.near_dead import near_dead
from benchmarks.campaign.random_linkages import KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_loops_close_newton_agrees_and_rates_are_derivatives(kind):
    found = accuracy(kind, 1000, np.random.default_rng(1))
    assert found.mechanisms == 1000
    assert found.closure <= 1e-12
    assert found.newton <= 1e-10
    assert found.velocity <= 1e-9
    assert found.acceleration <= 1e-9


@pytest.mark.parametrize("kind", KINDS[:4])
def test_nothing_is_silently_wrong_beside_a_dead_centre(kind):
    found = near_dead(kind, 150, np.random.default_rng(2))
    assert found.mechanisms == 150
    assert 0 < found.solved < found.samples
    assert found.silent == found.misjudged == 0


def test_crank_rockers_stay_on_their_branch_however_few_the_steps():
    found = crank_rockers(500, np.random.default_rng(3))
    assert found.greatest > 0.9999
    assert found.samples == 500 * (36 + 72 + 360)
    assert found.wrong == 0
