"""The names of results in the JSON are stable: none that was documented once goes away unnoticed."""

import json
from pathlib import Path

import pytest
from default_machines import default_report

from ilmek.machines.catalogue import MACHINES
from ilmek.records import declared_results

NAMES = json.loads((Path(__file__).parent / "json_names.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("machine", NAMES)
def test_every_documented_name_is_declared(machine: str) -> None:
    assert set(NAMES[machine]) <= {one.name for one in declared_results(*MACHINES[machine].reported)}


@pytest.mark.parametrize("machine", MACHINES)
def test_what_a_machine_reports_is_declared_and_documented(machine: str) -> None:
    component = MACHINES[machine]
    reported = {result.name for result in default_report(machine).results}
    assert reported <= {one.name for one in declared_results(*component.reported)} <= set(NAMES[machine])
