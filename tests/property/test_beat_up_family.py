"""The beat-up's family: every member as `design` makes it, the choice against brute force, the front against pairs."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.errors import ParameterError
from ilmek.machines.beat_up import MACHINE, BeatUpParams, design
from ilmek.machines.beat_up.family import QUANTITIES, chosen_ratio, tabulate
from ilmek.machines.beat_up.params import LIMITS, OBJECTIVES
from ilmek.machines.beat_up.use_params import CastLinkParams
from ilmek.synthesis.crank_rocker.dead_centres import beta_of_ratio, links_of_ratio, rotation_limits
from ilmek.synthesis.crank_rocker.family import family
from ilmek.units import deg

unit = st.floats(0.03, 0.97)
PIN = 0.008
"""Diameter of the pins of all members [m]."""


@st.composite
def asked(draw: st.DrawFn) -> dict[str, Any]:
    swing = draw(st.floats(10 * deg, 110 * deg))
    low, high = rotation_limits(swing)
    return {
        "swing": swing,
        "crank_rotation": float(low + draw(unit) * (high - low)),
        "gravity": draw(st.sampled_from([0.0, 9.81])),
        "gravity_direction": draw(st.integers(-180, 180)) * deg,
        "beater": draw(st.sampled_from([None, 0.1, 0.5])),
        "speed": draw(st.floats(3, 40)),
        "link_mass": draw(st.sampled_from(["made", "bars"])),
        "strength": CastLinkParams(pin_diameter=PIN),
    }


@settings(max_examples=8)
@given(asked(), st.integers(2, 37))
def test_a_member_has_the_peaks_that_its_design_has(asked_of: dict[str, Any], place: int) -> None:
    params = BeatUpParams(**asked_of)
    members = family(params.rocker_swing, params.crank_rotation, 40)
    table = tabulate(params, members.links, members.beta, PIN)
    assert list(table) == list(QUANTITIES)
    links = [float(np.asarray(link)[place]) * params.ground for link in members.links]
    given = dict(zip(("crank", "coupler", "rocker"), links, strict=True))
    outright = replace(params, **given, crank_angle=float(members.beta[place]))
    made = design(outright)
    peaks = made.peaks
    expected = {
        "transmission_angle_min": made.transmission_angle_min,
        "beater_acceleration_max": peaks["beater_acceleration"].value,
        "beater_force_max": peaks["beater_force"].value,
        "drive_torque_max": peaks["drive_torque"].value,
        "joint_force_max": max(peaks[pin].value for pin in "ABCD"),
        "rocker_speed_max": peaks["beater_velocity"].value / made.lengths["beater"],
        "beta": made.beta,
    }
    assert {name: float(table[name][place]) for name in expected} == pytest.approx(expected, rel=1e-4)
    assert made.at is not None
    assert float(table["force_at_beat"][place]) == pytest.approx(float(np.abs(made.at.beater_force[0])), rel=1e-6)
    assert float(table["acceleration_at_beat"][place]) == pytest.approx(
        float(np.abs(made.at.beater.acceleration[0])), rel=1e-6
    )


@settings(max_examples=8)
@given(asked(), st.sampled_from(sorted(OBJECTIVES)), st.floats(0.2, 0.8), st.floats(0.2, 0.8))
def test_no_member_within_the_limits_beats_the_chosen_one(
    asked_of: dict[str, Any], objective: str, first: float, second: float
) -> None:
    params = BeatUpParams(**asked_of)
    members = family(params.rocker_swing, params.crank_rotation, 400)
    table = tabulate(params, members.links, members.beta, PIN)
    # Two limits that a part of the members keeps.
    picked = ("transmission_min", "torque_max")
    bounds = {
        name: float(np.quantile(table[LIMITS[name][0]], part if LIMITS[name][1] < 0 else 1 - part))
        for name, part in zip(picked, (first, second), strict=True)
    }
    kept = np.ones(len(members), dtype=bool)
    for name, bound in bounds.items():
        kept &= LIMITS[name][1] * (table[LIMITS[name][0]] - bound) >= 0
    asked_for = replace(params, **bounds, objective=objective, members=100)
    if not kept.any():
        with pytest.raises(ParameterError, match="clash"):
            chosen_ratio(asked_for, PIN)
        return
    place = params.rocker_swing, params.crank_rotation, np.array([chosen_ratio(asked_for, PIN)])
    found = tabulate(params, links_of_ratio(*place), beta_of_ratio(*place), PIN)
    own = {name: float(of[0]) for name, of in found.items()}
    for name, bound in bounds.items():
        assert LIMITS[name][1] * (own[LIMITS[name][0]] - bound) >= -1e-8 * bound
    quantity, sign = OBJECTIVES[objective]
    floored = kept & (members.ratio >= 0.1)
    rivals = table[quantity][floored if floored.any() else kept]
    assert sign * own[quantity] >= np.max(sign * rivals) * (1 - sign * 1e-6)


def test_limits_alone_choose_what_beats_hardest_within_them() -> None:
    made = design(BeatUpParams.read({"transmission_min": "45deg", "ratio_max": "0.3"}))
    assert float(made.links.crank / made.links.coupler) == pytest.approx(0.3, rel=1e-12)
    said = MACHINE.report(made)
    assert [check.name for check in said.checks[-2:]] == [
        "crank/coupler ratio, ratio_max",
        "least transmission angle, transmission_min",
    ]
    assert not said.failed


def test_a_stub_of_a_crank_is_chosen_only_where_it_is_asked_for() -> None:
    def ratio(**settings: str) -> float:
        links = design(BeatUpParams.read({"objective": "transmission_angle", **settings})).links
        return float(links.crank / links.coupler)

    assert ratio() == pytest.approx(0.1, rel=1e-6)
    assert ratio(ratio_min="0.02") == pytest.approx(0.02, rel=1e-6)
    assert ratio(ratio_max="0.06") < 0.06


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"transmission_min": "80deg"}, "it reaches at most 75 deg"),
        (
            {"transmission_min": "70deg", "force_at_beat_min": "90N"},
            "transmission_min=70 deg and force_at_beat_min=90 N",
        ),
        ({"ratio_min": "0.5", "ratio_max": "0.3"}, "ratio_min=0.5 and ratio_max=0.3 clash"),
        ({"ratio_max": "0.3", "beta": "48deg"}, "leave out beta, or ratio_max"),
        ({"objective": "size", "crank": "50mm", "coupler": "200mm", "rocker": "200mm"}, "nothing is left to choose"),
        ({"transmission_min": "45"}, "did you mean 45deg"),
        ({"objective": "sise"}, "did you mean size"),
        ({"front": "transmision_angle size"}, "did you mean transmission_angle"),
        ({"front": "size size"}, "two or more different"),
        ({"front": ""}, "two or more different"),
    ],
)
def test_refuses_in_words(settings: dict[str, str], said: str) -> None:
    with pytest.raises(ParameterError) as refused:
        design(BeatUpParams.read(settings))
    assert said in str(refused.value)


def test_the_front_is_told_by_the_names_that_are_promised() -> None:
    said = MACHINE.report_for({"crank_rotation": "200deg", "front": "transmission_angle, force_at_beat"})
    results = said.as_json()["results"]
    assert results["pareto_weighed"] == ["transmission_angle", "force_at_beat"]
    assert 25 == len(results["pareto"]) < results["pareto_count"] < 500
    assert all(list(member) == list(results["own"]) == list(QUANTITIES) for member in results["pareto"])
    angles = np.array([member["transmission_angle_min"] for member in results["pareto"]])
    forces = np.array([member["force_at_beat"] for member in results["pareto"]])
    # In a front of two the one rises as the other falls.
    assert (np.diff(forces[np.argsort(angles)]) < 0).all()
    assert results["best_ratio"] == pytest.approx(0.3904, abs=1e-4)
    assert results["best_transmission_angle"] >= angles.max()
    assert results["family_limits"]["beta"] == pytest.approx([0, 75 * deg])
    assert results["own"]["crank_coupler_ratio"] == pytest.approx(results["crank_coupler_ratio"])


def test_lengths_given_outright_stand_in_the_family_of_their_own_swing() -> None:
    made = design(BeatUpParams.read(dict(crank="59.7mm", coupler="200.7mm", rocker="230.8mm")))
    weighed = made.family()
    assert weighed.own["crank_coupler_ratio"] == pytest.approx(59.7 / 200.7)
    near = int(np.argmin(np.abs(weighed.table["crank_coupler_ratio"] - 59.7 / 200.7)))
    for name, value in weighed.own.items():
        assert float(weighed.table[name][near]) == pytest.approx(value, rel=0.02), name
