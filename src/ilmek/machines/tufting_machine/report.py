"""What is reported of a tufting machine: checks, tables, the verdict."""

import numpy as np

from ilmek.machines.strength_tables import strength_table
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.records import computed, record
from ilmek.report import Check, Json, Report, Table, at_most, columns, reason_json

BALANCE = 1e-9


@record
class TuftingVerdict:
    """Whether a machine tufts its carpet, from its whole report."""

    report: Report

    tufts = computed("", "every check of the machine and of its needle drives holds", lambda it: not it.report.failed)

    @computed("", "checks that do not hold, the heaviest first, with what would cure them", shown=False)
    def reasons(self) -> list[Json]:
        return [reason_json(reason) for reason in self.report.reasons]


def checks(machine: TuftingMachine) -> tuple[Check, ...]:
    """The loop, the looper, needle bar, shafts, feed."""
    return (
        *machine.loop.checks,
        *machine.looper.checks,
        *machine.looper_forces.checks,
        *machine.needle_bar.checks,
        *machine.shafts.checks,
        *machine.feed.checks,
    )


def self_tests(machine: TuftingMachine) -> tuple[Check, ...]:
    """The balance of the looper's power; the hook's path by the linkage against that of its synthesis."""
    forces = machine.looper_forces
    motion, drive, needle = forces.motion, machine.looper, machine.params.needle
    across = motion.point("rocker", "tip").position.real - needle.shaft_distance - needle.needle_distance
    apart = float(np.max(np.abs(drive.sense * across - drive.ahead(forces.angle))))
    return (
        at_most("power balance of the looper's forces", forces.forces.power_error, BALANCE, "1", "virtual power"),
        at_most("hook's path by its linkage and by its synthesis", apart, BALANCE, "mm", "two solvers"),
    )


def tables(machine: TuftingMachine) -> tuple[Table, ...]:
    """Timing of the loop, and the strength of the looper."""
    window, loop = machine.loop.window, machine.loop
    rows = (
        ("hook enters the loop", window.opened, loop.catch, window.shut),
        ("hook leaves the needle's line", window.out, loop.release, window.back),
    )
    heads = columns("moment", "not before [deg]", "crank angle [deg]", "not after [deg]")
    timing = Table("tufting-machine-timing", "Timing of the looper", heads, rows)
    return (timing, *strength_table(machine.looper_forces.strength, "tufting-machine-looper"))
