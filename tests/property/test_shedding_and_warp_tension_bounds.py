"""Whatever the parameters within their bounds: a whole report, or one line that says what is wrong."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.errors import IlmekError
from ilmek.machines import hammer, shedding, warp_tension
from ilmek.params import listed

MACHINES = (shedding.MACHINE, hammer.MACHINE, warp_tension.MACHINE)


def values(parameter):
    """The bounds themselves, and values between them of every size."""
    if parameter.kind is str and not parameter.choices:
        return st.sampled_from(("UCF 207", "6204", "nothing of the kind"))
    if parameter.kind in (bool, str):
        return st.sampled_from(parameter.choices or (True, False))
    low = parameter.at_least if parameter.at_least is not None else parameter.above or 0.0
    high = parameter.at_most if parameter.at_most is not None else parameter.below
    small = max(low, 1e-9)
    spread = st.floats(0, 1).map(lambda share: small * (high / small) ** share)
    inside = st.one_of(st.sampled_from([low, high]), spread).map(lambda x: min(max(x, low), high))
    return inside.map(round) if parameter.kind is int else inside.filter(parameter.within)


@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.name)
@settings(max_examples=8)
@given(data=st.data())
def test_any_parameters_give_a_report_or_one_line(machine, data) -> None:
    parameters = sorted(listed(machine.params), key=lambda parameter: parameter.name)
    chosen = data.draw(st.lists(st.sampled_from(parameters), max_size=5, unique=True))
    drawn = {parameter.name: data.draw(values(parameter), label=parameter.name) for parameter in chosen}
    try:
        report = machine.report(machine.design(machine.params.read(drawn)))
    except IlmekError:
        return
    assert all(math.isfinite(check.value) for check in report.checks)
    assert report.as_json()["results"].keys() == {result.name for result in report.results}
