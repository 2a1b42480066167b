"""The run of an own machine, as `ilmek mechanism` reports it."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping
from pathlib import Path

from ilmek.api.mechanisms import read_mechanism
from ilmek.arguments import Arguments, Quantity
from ilmek.arrays import FloatArray
from ilmek.dynamics.inverse import Forces
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.jobs.mechanism.analysis import Analysis, analysis
from ilmek.jobs.mechanism.data import columns
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.request import STEPS, MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.model import Mechanism
from ilmek.linkage.motion import Motion
from ilmek.records import record
from ilmek.report import Report
from ilmek.report.framed import Framed

Runnable = OwnMachine | MechanismFile | Mechanism | str | Path
"""A machine, a mechanism, or the file of one."""

MOST_STEPS = 10**7
"""Largest number of steps of a range."""


@record
class MachineRun(Framed):
    """An own machine in motion: what `ilmek mechanism` reports of it.

    analysis  motion, forces, strength, servo, study and forward run, as far as the machine states them
    report    results by name (`run.report["drive_torque_max"]`), checks, tables, figures
    """

    analysis: Analysis
    report: Report

    @property
    def motion(self) -> Motion:
        """The motion over the range."""
        return self.analysis.run.motion

    @property
    def forces(self) -> Forces | None:
        """Joint forces and drive efforts by sample; None without masses, loads and friction."""
        forces = self.analysis.run.forces
        return None if forces is None else forces.forces

    def table(self) -> dict[str, FloatArray]:
        """All columns of `--csv` by heading, SI and radians."""
        return columns(self.analysis)


def run_machine(
    machine: Runnable,
    *,
    over: tuple[Quantity, Quantity] | str = "",
    speed: Quantity = "",
    steps: int = STEPS,
    fixed: Mapping[str, Quantity] | None = None,
) -> MachineRun:
    """Motion, forces and strength of an own machine over a range of its driving input, as `ilmek mechanism` gives them.

    machine  a file or its path, a machine, or a mechanism
    over     range of the driving input [rad; m], or a text like "0deg..180deg"; default: a full turn
    speed    of the driving input [rad/s; m/s], or a text like "150rpm"; default: that of the machine, else 1
    steps    of the range
    fixed    input -> value [rad; m] or text; with all inputs fixed one pose is computed; default: none

    Raises MechanismError, as for a range in which the mechanism closes nowhere; UnitError for a text that is no
    quantity.

    >>> from ilmek import four_bar
    >>> beat_up = four_bar(0.300, 0.060, 0.200, 0.230)
    >>> half_turn = run_machine(beat_up, over=(0.0, 3.14), speed=15.5, steps=36)
    >>> len(half_turn.motion), bool(half_turn.motion.drives["crank"].speed == 15.5)
    (37, True)
    >>> float(run_machine(beat_up, fixed={"crank": 1.0}).motion.drives["crank"].value[0])
    1.0
    """
    given = Arguments("a run", MechanismError)
    if isinstance(machine, str | Path):
        machine = read_mechanism(machine)
    if isinstance(machine, Mechanism):
        machine = OwnMachine(as_drawn(machine))
    whole: MechanismFile | OwnMachine = given.record("machine", machine, (MechanismFile, OwnMachine))
    file = whole if isinstance(whole, MechanismFile) else MechanismFile(whole)
    request = MotionRequest(
        given.mapping("fixed", fixed or {}, lambda _, value: value),
        over if isinstance(over, str) else _range(given, over),
        speed,
        given.whole("steps", steps, least=1, most=MOST_STEPS),
    )
    judged = analysis(run(file, request))
    return MachineRun(judged, report(judged))


def _range(given: Arguments, over: object) -> tuple[Quantity, Quantity]:
    first, last = given.pair("over", over, "the first and the last value")
    return first, last
