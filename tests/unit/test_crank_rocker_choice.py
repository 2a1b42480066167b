"""Choice from a family of one parameter: the best within limits, met from inside, and which limits clash."""

import numpy as np
import pytest

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.synthesis.crank_rocker.choice import Limit, Objective, Table, choose
from ilmek.units import deg

PLACES = np.linspace(0, 10, 101)


def hills(x: FloatArray) -> Table:
    """`up` grows, `down` falls, `hill` is 9 at 3, `twin` has hills at 2 and at 8, `broken` is nothing beyond 5."""
    return {
        "up": x,
        "down": 10 - x,
        "hill": 9 - (x - 3) ** 2,
        "twin": np.maximum(1 - (x - 2) ** 2, 2 - (x - 8) ** 2),
        "broken": np.where(x < 5, x, np.nan),
    }


def at_least(quantity: str, bound: float) -> Limit:
    return Limit(quantity, bound, +1, f"{quantity}_min")


def at_most(quantity: str, bound: float) -> Limit:
    return Limit(quantity, bound, -1, f"{quantity}_max")


@pytest.mark.parametrize(
    ("objective", "limits", "place"),
    [
        (Objective("hill", +1), [], 3.0),
        (Objective("up", -1), [], 0.0),
        (Objective("up", +1), [at_least("hill", 5.0)], 5.0),
        (Objective("up", +1), [at_least("hill", 5.0), at_most("up", 1.23456789)], 1.23456789),
        (Objective("twin", +1), [at_most("up", 7.0)], 2.0),
        (Objective("twin", +1), [], 8.0),
        (Objective("broken", +1), [at_most("up", 9.0)], 5.0),
        # A window between two members of the table, as narrow as rounding: only closer looks find it.
        (Objective("up", +1), [at_least("hill", 9.0 - 1e-6)], 3.001),
        (Objective("down", +1), [at_least("up", 3.14159265), at_most("up", 3.14159265)], 3.14159265),
    ],
)
def test_the_best_within_limits_is_found_to_the_limit(objective: Objective, limits: list[Limit], place: float) -> None:
    found = choose(hills, PLACES, objective, limits)
    assert found == pytest.approx(place, abs=1e-4 if objective.quantity in {"hill", "twin"} else 1e-6)
    assert all(limit.kept(hills(np.array([found])))[0] for limit in limits)


def test_what_is_preferred_gives_way_to_what_is_asked() -> None:
    least, floor = Objective("up", -1), [at_least("up", 4.0)]
    assert choose(hills, PLACES, least, [], floor) == pytest.approx(4.0)
    assert choose(hills, PLACES, least, [at_least("hill", 5.0)], floor) == pytest.approx(4.0)
    assert choose(hills, PLACES, least, [at_most("up", 3.0)], floor) == pytest.approx(0.0)


def clash_of(*limits: Limit) -> ParameterError:
    with pytest.raises(ParameterError) as refused:
        choose(hills, PLACES, Objective("up", +1), limits)
    return refused.value


def test_a_limit_out_of_reach_is_named_alone() -> None:
    said = clash_of(at_most("up", 3.0), at_least("hill", 9.5), at_least("down", 1.0))
    assert said.given == "no crank-rocker of the family has hill_min=9.5"
    assert said.allowed == "it reaches at most 9"


def test_two_that_clash_are_named_with_what_each_leaves_the_other() -> None:
    said = clash_of(at_least("hill", 1.0), at_least("up", 6.0), at_least("down", 5.0))
    assert said.given == "hill_min=1 and up_min=6 clash"
    assert said.allowed == "hill_min can be at most 0 with up_min=6; up_min can be at most 5.8 with hill_min=1"
    assert said.do


def test_three_that_clash_though_any_two_agree_are_named_together() -> None:
    # Near 2 or near 8; neither between 1.5 and 2.5; below 5.
    ring = Limit("ring", 1.0, +1, "ring_min")

    def rings(x: FloatArray) -> Table:
        return {**hills(x), "ring": np.abs(x - 2) * 2}

    with pytest.raises(ParameterError) as refused:
        choose(rings, PLACES, Objective("up", +1), [at_least("twin", 0.8), ring, at_most("up", 5.0)])
    assert refused.value.given == "twin_min=0.8 and ring_min=1 and up_max=5 clash"
    assert "ring_min=1" in refused.value.allowed


def test_limits_are_said_in_the_unit_they_are_given_in() -> None:
    assert Limit("angle", 45 * deg, +1, "transmission_min", "deg").words == "transmission_min=45 deg"
