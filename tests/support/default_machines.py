"""The machines with all parameters at their defaults, designed and drawn once in a process: read only."""

from functools import cache

from ilmek.machines.catalogue import MACHINES
from ilmek.report import Report
from ilmek.viz.page import machine_page


@cache
def default_report(machine: str) -> Report:
    """The report of a machine."""
    return MACHINES[machine].report_for({})


@cache
def default_page(machine: str) -> tuple[str, tuple[str, ...]]:
    """The page of a machine, and what is left out of it."""
    left_out: list[str] = []
    return machine_page(default_report(machine), left_out), tuple(left_out)
