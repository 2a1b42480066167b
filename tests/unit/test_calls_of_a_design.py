"""How many functions a design of a loom calls: its cost by a figure that other work on the computer does not change."""

import pytest
from processes import printed, python

GIVEN = {"knotting": "cams", "knot_cycle": "1.4s", "weft": "rapier", "heads": "1"}
MOST = {"travelling": 240_000, "linkage": 400_000, "comb": 190_000, "guide-cams": 205_000}
"""Calls of a design with everything given, in a fresh process: a tenth above those of November 2026 (record 0036)."""

COUNTED = """
import sys
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.catalogue import MACHINES
params = AutomatedLoomParams.read(dict(word.split("=") for word in sys.argv[1:]))
modules = [MACHINES[name].design for name in MACHINES]
calls = 0
def count(frame, event, argument):
    global calls
    calls += event in ("call", "c_call")
sys.setprofile(count)
design(params)
sys.setprofile(None)
print(calls)
"""


@pytest.mark.parametrize("beat", MOST)
def test_a_design_calls_no_more_functions_than_it_needs(beat: str) -> None:
    words = [f"{name}={value}" for name, value in {**GIVEN, "beat": beat}.items()]
    assert MOST[beat] / 4 < int(printed(python("-c", COUNTED, *words))) <= MOST[beat]
