"""What is reported of a tufting machine: checks, tables, the verdict."""

from dataclasses import replace

import numpy as np

from ilmek.dynamics.pin_strength import bearing_life, pin_duty
from ilmek.machines.strength_tables import strength_table
from ilmek.machines.tufting import report as needle_report
from ilmek.machines.tufting.tree import design_pitch
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.frame import presser_thickness
from ilmek.machines.tufting_machine.needle_parts import NEEDLE_BAR
from ilmek.machines.tufting_machine.price import tufting_price
from ilmek.machines.tufting_machine.rocker_drive import TIP
from ilmek.machines.tufting_machine.rocker_forces import RockerForces
from ilmek.machines.tufting_machine.rocker_parts import CLEAR, NAME, looper_bearing
from ilmek.machines.tufting_machine.shafts import MAIN_SHAFT
from ilmek.records import computed, record
from ilmek.report import Check, Json, Report, Table, at_least, at_most, columns, reason_json

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
    """The loop, the needle drives, the looper, needle bar, shafts, feed, and their room."""
    drive = (*needle_report.angle_checks(machine.needle), *needle_report.strength_checks(_drive(machine)))
    return (
        *machine.loop.checks,
        *machine.looper.checks,
        *(machine.knife.checks if machine.knife else ()),
        *(check for forces in machine.below for check in forces.checks),
        *machine.needle_bar.checks,
        *(machine.latches.checks if machine.latches else ()),
        *machine.shafts.checks,
        *machine.feed.checks,
        *_room_checks(machine),
        *(replace(one, name=f"needle drive: {one.name}") for one in drive),
    )


def _drive(machine: TuftingMachine) -> needle_report.TuftingAnalysis:
    return needle_report.analyse(machine.needle)


def _room_checks(machine: TuftingMachine) -> tuple[Check, ...]:
    """Drives beside each other, and the needle bar over the presser where it is lowest."""
    params = machine.params
    pitch, over = params.width / params.drives, machine.loop.depth + presser_thickness(params) + CLEAR / 2
    life, limits = looper_bearing_life(machine), params.needle.strength
    row = looper_bearing(params.looper)
    return (
        at_least("life of the loopers' bearings", life, limits.bearing_life, "h", f"ISO 281, {row.name}").with_cure(
            "set a larger looper.shaft", f"{NAME}/looper-bearing"
        ),
        at_most(
            "needle drive with its bearing plates along the shafts",
            design_pitch(machine.needle),
            pitch,
            "mm",
            "distance of the drives",
        ).with_cure("set fewer drives, or a wider machine", MAIN_SHAFT),
        at_least(
            "needles out of their bar", params.needle_bar.needle_length, over, "mm", "depth, presser and clearance"
        ).with_cure("set a longer needle_bar.needle_length", NEEDLE_BAR),
    )


def looper_bearing_life(machine: TuftingMachine) -> float:
    """Least life of the bearings of all shafts below [s of running]; each of the two of a shaft bears half."""
    row, speed = looper_bearing(machine.params.looper), machine.params.needle.speed
    duties = (pin_duty(forces.forces, name, forces.moves.angle / speed) for forces in machine.below for name in "QP")
    return min(bearing_life(replace(duty, force=duty.force / 2), row) for duty in duties)


def self_tests(machine: TuftingMachine) -> tuple[Check, ...]:
    """The balance of the looper's power; the hook's path by the linkage against that of its synthesis."""
    forces = machine.looper_forces
    moves, drive, needle = forces.moves, machine.looper, machine.params.needle
    across = (
        moves.motion.point(moves.drive.bodies[2], TIP).position.real - needle.shaft_distance - needle.needle_distance
    )
    apart = float(np.max(np.abs(drive.sense * across - drive.ahead(moves.angle))))
    own = (replace(test, name=f"needle drive: {test.name}") for test in needle_report.self_tests(_drive(machine)))
    return (
        *own,
        *(_power_test(forces) for forces in machine.below),
        at_most("hook's path by its linkage and by its synthesis", apart, BALANCE, "mm", "two solvers"),
    )


def _power_test(forces: RockerForces) -> Check:
    name = f"power balance of the {forces.moves.drive.name}'s forces"
    return at_most(name, forces.forces.power_error, BALANCE, "1", "virtual power")


def tables(machine: TuftingMachine) -> tuple[Table, ...]:
    """Timing of the loop, and the strength of the looper."""
    window, loop = machine.loop.window, machine.loop
    rows = (
        ("hook enters the loop", window.opened, loop.catch, window.shut),
        ("hook leaves the needle's line", window.out, loop.release, window.back),
    )
    heads = columns("moment", "not before [deg]", "crank angle [deg]", "not after [deg]")
    timing = Table("tufting-machine-timing", "Timing of the looper", heads, rows)
    return (
        timing,
        tufting_price(machine).table,
        *needle_report.tables(_drive(machine)),
        *(
            table
            for forces in machine.below
            for table in strength_table(forces.strength, f"tufting-machine-{forces.moves.drive.name}")
        ),
    )
