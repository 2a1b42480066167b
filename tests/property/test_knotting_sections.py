"""The knotting head for any section: the arm's triangle closes, its clearance is the best there is, its knot proved."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from cloths import cloth
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.linkage.swivelled_arm import SwivelledArm
from ilmek.machines.knotting_dyad import KnottingDyadParams
from ilmek.machines.knotting_dyad.clearance import arm_bars, to_warps
from ilmek.machines.knotting_dyad.head import Head, head_of
from ilmek.machines.knotting_dyad.search import MISSED, _tried, best_arm
from ilmek.machines.knotting_dyad.section import section_of
from ilmek.plane.round_bars import LeastDistance, least

shares = st.floats(0.05, 0.95)
ENDS = np.array([0.0, 1.0])


@st.composite
def asked(draw: st.DrawFn) -> dict[str, Any]:
    """Sections in which a needle fits, from silk to the coarsest."""
    pitch = 10 ** draw(st.floats(-3.3, -2.3))
    warp = pitch * draw(st.floats(0.2, 0.5))
    return dict(
        knot=draw(st.sampled_from(("symmetric", "asymmetric"))),
        opens=draw(st.sampled_from(("left", "right"))),
        cloth=cloth(warp_pitch=pitch, warp_diameter=warp),
        needle_diameter=max(1e-5, (pitch - warp) * draw(st.floats(0.1, 0.6))),
        clearance=(pitch - warp) * draw(st.sampled_from((0.0, 0.05, 0.15))),
        opening=pitch * draw(st.sampled_from((0.0, 0.3, 1.0))),
        leg=draw(st.floats(6e-3, 15e-3)),
        link_width=draw(st.floats(2e-3, 5e-3)),
    )


def made(params: KnottingDyadParams) -> Head:
    section = section_of(params)
    return head_of(params, section, best_arm(params, section))


@settings(max_examples=8)
@given(asked(), shares)
def test_the_needle_goes_through_the_gap_and_nothing_comes_nearer_than_the_section_allows(
    sizes: dict[str, Any], share: float
) -> None:
    head = made(KnottingDyadParams(**sizes))
    arm, s = head.arm, np.array([share])
    elbow, tip = arm.elbow(s), arm.tip(s)
    assert math.isclose(abs(elbow[0] - tip[0]), arm.second, rel_tol=1e-9)
    assert abs(((tip - elbow) * np.conj(arm.swivel - elbow)).imag[0]) < 1e-12 * arm.second
    assert abs(head.clearance_min - head.section.clearance_bound) < 1e-8
    assert to_warps(head.section, arm_bars(head.section, arm, s))[0] >= head.clearance_min - 1e-9
    assert head.tied.knot == head.knot
    assert head.knot_tied == sizes["knot"]


def swept(arm: SwivelledArm) -> float:
    """Sum of the squares of the links, times the sum of their turns over the path: what the search makes least."""
    elbow, tip = arm.elbow(ENDS), arm.tip(ENDS)
    turns = [np.angle(link[1] / link[0]) for link in (elbow - arm.pivot, tip - elbow)]
    return float((arm.first**2 + arm.second**2) * np.abs(turns).sum())


def test_no_random_arm_that_fits_sweeps_less() -> None:
    params, rng, count = KnottingDyadParams(), np.random.default_rng(5), 4000
    section = section_of(params)
    best, low = best_arm(params, section), section.needle_length + params.link_width
    at = [rng.uniform(np.log(low), np.log(0.15), count), rng.uniform(-section.tilt, section.tilt, count)]
    at += [rng.uniform(np.log(section.reach / 10), np.log(0.15), count)]
    tried = _tried(params, section, np.stack(at, axis=-1), rng.choice([-1.0, 1.0], count))
    fits = np.flatnonzero(tried.cost < MISSED)
    arms = [
        replace(best, pivot=tried.pivot[k], first=tried.first[k], second=tried.second[k], side=int(tried.side[k]))
        for k in fits
    ]
    assert len(arms) > 50
    assert min(map(swept, arms)) >= swept(best) * (1 - 1e-9)


def test_the_best_arm_does_not_depend_on_the_grid_of_the_search() -> None:
    """Limits of the links that none of the best arms comes near to: each spreads the first grid differently."""
    every = [KnottingDyadParams(link_limit=0.15 * factor) for factor in (1, 1.05, 1.1, 1.2)]
    arms = [best_arm(params, section_of(params)) for params in every]
    second, height = np.array([(arm.second, arm.pivot.imag) for arm in arms]).T
    assert np.ptp(second) < 0.01 * second.min()
    assert np.ptp(height) < 1e-4 * height.min()


@given(st.lists(st.tuples(shares, shares, st.floats(0, 1)), min_size=1, max_size=5))
def test_the_least_distance_is_found_to_its_tolerance_among_any_cones(cones: list[tuple[float, float, float]]) -> None:
    """Cones of slope 1 in each direction, the least of which is known."""

    def f(at: np.ndarray) -> np.ndarray:
        heights = [abs(at[:, 0] - x) + abs(at[:, 1] - y) + h for x, y, h in cones]
        return np.min(heights, axis=0)

    found: LeastDistance = least("cones", f, (1.0, 1.0))
    true = min(h for *_, h in cones)
    assert true <= found.value <= true + found.sure
    assert found.sure <= 1e-6 + 5e-3 * found.value + 1e-12
