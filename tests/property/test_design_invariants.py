"""Random designs of every machine: refused as an IlmekError, or reported with all invariants; none ends otherwise.

`designs.random_settings` draws them from the declarations of the parameters; a NumPy warning is an error here.
"""

import random

import pytest
from default_machines import default_report
from designs import random_settings
from effort import seeds

from ilmek.errors import IlmekError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.invariants import SOURCE

SLOW = ("automated-loom", "knotting-dyad", "path-four-bar", "motion-four-bar")
"""Machines whose designs take a second or two each."""

FEWER = {"path-four-bar": {"starts": 96}}
"""A search of few starts has the same kinds of results."""


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.one_in(3)
def test_random_designs_keep_the_invariants_or_are_refused(machine: str) -> None:
    component = MACHINES[machine]
    made = 0
    for seed in seeds(2, 6) if machine in SLOW else seeds(8, 24):
        settings = random_settings(machine, random.Random(f"{machine} {seed}")) | FEWER.get(machine, {})
        try:
            report = component.report(component.design(component.params.read(settings)), illustrated=False)
        except IlmekError:
            continue
        made += 1
        assert [check for check in report.all_checks if check.source == SOURCE] == [], settings
        assert all(part.mass_all >= 0 for part in report.parts), settings
    assert made


def test_the_same_seed_gives_the_same_settings() -> None:
    one, other = (random_settings("cam", random.Random(7)) for _ in range(2))
    assert one == other


@pytest.mark.parametrize("machine", MACHINES)
def test_a_sound_design_has_no_check_of_an_invariant(machine: str) -> None:
    report = default_report(machine)
    assert [check for check in report.all_checks if check.source == SOURCE] == []
