"""A design of which some results are asked for has the same numbers and checks as one of which all are."""

import pytest

from ilmek.jobs.study.targets import MachineTarget

ASKED = {
    "beat-up": ("drive_torque_max", "pin_force_max.A", "run_fluctuation", "own.beta", "stroke_warps"),
    "weaver": ("cycle_time_knot", "speed_max.pile handler"),
    "cam": ("prime_radius",),
}


@pytest.mark.parametrize("machine", ASKED)
def test_chosen_results_are_those_of_the_whole_design(machine: str) -> None:
    target = MachineTarget(machine, {})
    whole = target.numbers({})
    some = target.numbers({}, ASKED[machine])
    assert set(ASKED[machine]) <= some.results.keys() < whole.results.keys()
    assert {name: whole.results[name] for name in some.results} == some.results
    assert [(one.name, one.value, one.ok) for one in some.checks] == [(c.name, c.value, c.ok) for c in whole.checks]
