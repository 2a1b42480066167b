"""How many functions a design of a loom calls: its cost by a figure that other work on the computer does not change."""

import pytest
from processes import printed, python

GIVEN = {"knotting": "cams", "knot_cycle": "1.4s", "weft": "rapier", "heads": "1"}
MOST = {"travelling": 240_000, "linkage": 400_000, "comb": 190_000, "guide-cams": 205_000}
"""Calls of a design with everything given, in a fresh process: a tenth above those of November 2026 (record 0036)."""

COUNTED = """
import os, sys
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.catalogue import MACHINES
modules = [MACHINES[name].design for name in MACHINES]
for beat in sys.argv[1].split():
    params = AutomatedLoomParams.read(dict(word.split("=") for word in (*sys.argv[2:], f"beat={beat}")))
    if os.fork():  # each beat in a process that has designed nothing
        os.wait()
        continue
    calls = 0
    def count(frame, event, argument):
        global calls
        calls += event in ("call", "c_call")
    sys.setprofile(count)
    design(params)
    sys.setprofile(None)
    print(beat, calls, flush=True)
    os._exit(0)
"""


@pytest.fixture(scope="module")
def calls() -> dict[str, int]:
    """Calls by beat."""
    given = (f"{name}={value}" for name, value in GIVEN.items())
    lines = printed(python("-c", COUNTED, " ".join(MOST), *given)).splitlines()
    return {beat: int(number) for beat, number in map(str.split, lines)}


@pytest.mark.parametrize("beat", MOST)
def test_a_design_calls_no_more_functions_than_it_needs(beat: str, calls: dict[str, int]) -> None:
    assert MOST[beat] / 4 < calls[beat] <= MOST[beat]
