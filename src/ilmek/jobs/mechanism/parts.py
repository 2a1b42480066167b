"""What the making of a mechanism of a file depends on: its whole way; the laws of its inputs as cam tables."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.own_machine import GivenMotion, OwnMachine
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.linkage.model import Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.report import CamTable
from ilmek.units import turn

SAMPLES = 360
"""Steps of the way in which layers are searched."""

BESIDE = 1e-6
"""Distance of the ends of a way from a dead centre, over its length."""


def full_travel(run: MechanismRun) -> Motion:
    """The motion that a mechanism's parts must make: a turn, or its longest range that closes, there and back."""
    if run.running is None:
        return run.motion
    if run.by_time or not run.others_rest:
        return _closing(run)
    start, stop = max(run.closing, key=lambda ends: abs(ends[1] - ends[0]))
    if isinstance(run.running, Rotation) and abs(abs(stop - start) - turn) < BESIDE:
        return solve(run.plan, run.at(np.linspace(start, stop, SAMPLES + 1)))
    aside = BESIDE * (stop - start)
    there = np.linspace(start + aside, stop - aside, SAMPLES // 2 + 1)
    return solve(run.plan, run.at(np.concatenate([there, there[-2::-1]])))


def _closing(run: MechanismRun) -> Motion:
    """The longest run of samples that close, there and back where its ends are apart."""
    first, last = max(run.samples_that_close, key=lambda ends: ends[1] - ends[0])
    drives = {
        name: np.broadcast_to(drive.value, (len(run.motion),))[first : last + 1]
        for name, drive in run.motion.drives.items()
    }
    return solve(run.plan, {name: np.concatenate([values, values[-2::-1]]) for name, values in drives.items()})


def cam_tables(machine: OwnMachine) -> tuple[CamTable, ...]:
    """The laws that inputs follow periodically, over one turn of a master; a constant speed is no cam."""
    return tuple(_tables(machine))


def _tables(machine: OwnMachine) -> Iterator[CamTable]:
    turning = {entry.name for entry in machine.mechanism.inputs if isinstance(entry, Rotation)}
    for name, given in machine.motions.items():
        if given.period is None or given.speed is not None:
            continue
        yield _table(name, given, given.period, "deg" if name in turning else "mm")


def _table(name: str, given: GivenMotion, period: float, unit: str) -> CamTable:
    per_angle = period / turn

    def motion(angle: FloatArray) -> FloatArray:
        value, speed, acceleration = given.law(np.asarray(angle) * per_angle)
        return np.stack([value, speed * per_angle, acceleration * per_angle**2])

    knots = np.unique(np.concatenate([[0.0], np.array(given.breaks) / per_angle, [turn]]))
    start, end = given.law(np.array([0.0, period]))[0]
    return CamTable(
        name, f"Input {name}", motion, knots[(knots >= 0) & (knots <= turn)], unit, period, float(end - start)
    )
