"""A published nine-point problem: the number of real four-bars, certified there by another method, and here.

[Wampler, Morgan and Sommese, Complete solution of the nine-point path synthesis problem for four-bar linkages, 1992,
 problem 3; Hauenstein and Sottile, Algorithm 921: alphaCertified, ACM TOMS 38 (2012): 384 = 6 x 64 real solutions]
"""

import numpy as np

from ilmek.synthesis.alt_burmester.defects import best_drive
from ilmek.synthesis.alt_burmester.four_bars import complete_four_bars
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.task import PrecisionTask

POINTS = np.array([0.25, 0.52 + 0.1j, 0.8 + 0.7j, 1.2 + 1j, 1.4 + 1.3j, 1.1 + 1.48j, 0.7 + 1.4j, 0.2 + 1j, 0.02 + 0.4j])


def test_problem_3_has_64_real_curves_of_three_cognates():
    answer = complete_four_bars(PosesAndPoints(POINTS, np.full(9, np.nan)))
    assert answer.complete
    assert answer.paths == 1442
    assert len({one.family for one in answer.found}) == 64
    assert len(answer.found) == 3 * 64
    assert all(one.certified for one in answer.found)
    assert max(one.distance for one in answer.found) < 1e-8

    drives = [best_drive(one, POINTS) for one in answer.found]
    usable = [four_bar for four_bar, defect in drives if defect is None]
    assert len(usable) == 2  # two cognates of one curve; the third one's links rock
    for four_bar in usable:
        seen = judge(four_bar, PrecisionTask(points=POINTS))
        assert seen.met
        assert seen.one_branch
        assert seen.in_order
        assert seen.crank_turns
