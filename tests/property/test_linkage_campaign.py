"""Random mechanisms of every group of class II, many at once: few in `make test`, more in a campaign.

`python -m benchmarks accuracy` is the same with 10^5.
"""

import numpy as np
import pytest
from benchmarks.campaign.accuracy import accuracy
from benchmarks.campaign.branches import crank_rockers
from benchmarks.campaign.near_limits import near_limits
from benchmarks.campaign.random_linkages import KINDS
from effort import first, number


@pytest.mark.parametrize("kind", KINDS)
def test_loops_close_newton_agrees_and_rates_are_derivatives(kind):
    count = number(150, 4000)
    found = accuracy(kind, count, np.random.default_rng(first(1)))
    assert found.mechanisms == count
    assert found.closure <= 1e-12
    assert found.newton <= 1e-10
    assert found.velocity <= 1e-9
    assert found.acceleration <= 1e-9


@pytest.mark.parametrize(
    ("kind", "count", "dyads", "closed_forms"),
    [
        *((kind, number(15, 60), 1, True) for kind in KINDS),
        ("RRR", number(6, 30), 2, True),
        ("RRP", number(6, 30), 3, True),
        ("RPR", number(2, 8), 1, False),
    ],
)
def test_beside_a_limit_ok_means_two_digits_of_every_acceleration_of_forty(kind, count, dyads, closed_forms):
    found = near_limits(kind, count, np.random.default_rng(first(2)), dyads=dyads, closed_forms=closed_forms)
    assert found.ok > 0
    assert found.worst <= 0.01
    assert found.silent == 0
    assert found.misjudged == 0
    # On average PRP refuses one good sample in nine, the others one in a hundred. The samples of a mechanism come
    # together, so the count scatters about twice as far as independent ones would; the second term is four times that.
    assert found.refused <= 0.15 * found.good + 4 * np.sqrt(0.15 * found.good)


def test_crank_rockers_stay_on_their_branch_however_few_the_steps():
    count = number(150, 2000)
    found = crank_rockers(count, np.random.default_rng(first(3)))
    assert found.greatest > 0.999
    assert found.samples == count * (36 + 72 + 360)
    assert found.wrong == 0
