"""Closing ranges of random mechanisms of class II and III end where det J = 0, by an independent calculation.

`python -m benchmarks closing` is the same with 100 of each class.
"""

import dataclasses

import numpy as np
import pytest
from benchmarks.campaign.random_closing import CLASS_II, CLASS_III, check, four_bar, plate_behind_a_dyad, six_bar

from ilmek.linkage.closing import closing
from ilmek.linkage.one_input import one_input
from ilmek.linkage.pose_branch import pose_branch
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

END = 1e-6 * np.pi / 180


@pytest.mark.parametrize("make", [*CLASS_II, *CLASS_III, plate_behind_a_dyad], ids=lambda make: make.__name__)
@pytest.mark.one_in(2)
def test_ranges_end_at_dead_centres_and_nothing_is_missed(make):
    rng = np.random.default_rng(7)
    for _ in range(3 if make in CLASS_II else 1):
        found = check(make(rng), 91)
        assert found.error <= END / 1e3
        assert found.missed == 0


@pytest.mark.parametrize("make", [four_bar, six_bar])
def test_newtons_method_has_the_range_of_the_closed_forms_that_contains_the_pose(make):
    """The same mechanism without closed forms: one group by Newton's method for each dyad, in series."""
    mechanism = make(np.random.default_rng(5))
    ranges = closing(one_input(plan(mechanism)), -np.pi, np.pi).ranges
    (drawn,) = [ends for ends in ranges if ends[0] <= 0 <= ends[1]]
    newton = plan(mechanism, closed_forms=False)
    np.testing.assert_allclose(closing(one_input(newton), -np.pi, np.pi).ranges, [drawn], atol=1e-12)
    values = np.linspace(*drawn, 40)[1:-1]
    ours, theirs = solve(newton, values).require(), solve(plan(mechanism), values).require()
    for body in mechanism.moving:
        np.testing.assert_allclose(ours.direction(body), theirs.direction(body), atol=1e-10)


def test_a_rough_pose_has_the_branch_of_the_exact_one():
    mechanism = CLASS_III[0](np.random.default_rng(3))
    rough = {body: (0.02 - 0.01j, 0.02) for body in mechanism.moving if body != "crank"}
    exact, found = (
        closing(one_input(plan(dataclasses.replace(mechanism, pose=pose))), -np.pi, np.pi).ranges
        for pose in ({}, rough)
    )
    np.testing.assert_allclose(found, exact, atol=1e-12)


def test_a_sample_does_not_depend_on_the_others_nor_on_their_order():
    mechanism = CLASS_III[0](np.random.default_rng(3))
    planned = plan(mechanism)
    branch = pose_branch(planned, "crank", {})
    low, high = branch.start, branch.stop
    values = np.random.default_rng(0).uniform(low, high, 50)
    together = solve(planned, values).require()
    turned = solve(planned, values[::-1] + 2 * np.pi).require()
    np.testing.assert_allclose(turned.direction("plate")[::-1], together.direction("plate"), atol=1e-9)
    alone = [solve(planned, value).direction("plate")[0] for value in values[:5]]
    np.testing.assert_allclose(alone, together.direction("plate")[:5], atol=1e-13)
