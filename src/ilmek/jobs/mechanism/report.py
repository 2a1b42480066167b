"""The report of a mechanism: structure, mobility, motion, forces; checks, and tests of the computation."""

import numpy as np

from ilmek.jobs.mechanism.analysis import Analysis
from ilmek.jobs.mechanism.figures import figures
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.jobs.mechanism.tables import tables
from ilmek.linkage.mobility import mobility
from ilmek.linkage.model import degrees_of_freedom
from ilmek.linkage.motion import Status
from ilmek.report import Json, Report, Result, results_of

HEADLINE = ("closing_ranges", "pin_forces_max", "drive_torque_max", "power_residual")
"""Results that stand at the top level of the JSON too; None without forces."""

NO_FORCES = (
    Result("pin_forces_max", None, "N", "greatest force of each pin; null: no forces", shown=False),
    Result("drive_torque_max", None, "N*m", "greatest torque of the drive; null: no forces", shown=False),
    Result("power_residual", None, "1", "greatest residual of the power balance; null: no forces", shown=False),
)


def report(found: Analysis, *, drawn: bool = True) -> Report:
    """Structure, mobility, motion and forces of the mechanism; `drawn`: with its figures."""
    run = found.run
    return Report(
        machine="mechanism",
        title=run.name,
        parameters={"running": run.running.name if run.running else None, "speed": run.speed},
        results=(*_structure(run), *_forces(found)),
        checks=found.checks,
        self_tests=found.self_tests,
        tables=tables(found),
        figures=figures(found) if drawn else (),
        warnings=found.warnings,
        headline=HEADLINE,
    )


def _structure(run: MechanismRun) -> tuple[Result, ...]:
    mechanism = run.plan.mechanism
    closing = [list(ends) for ends in run.closing] if run.running else []
    ranges = "ranges of the driving input in which the mechanism closes"
    count = "degrees of freedom by count, and by the rank of all constraints in the first pose that closes"
    results = (
        Result("freedoms", degrees_of_freedom(mechanism), "1", "degrees of freedom by count, with the inputs free"),
        Result("mobility", _mobility(run), "", count),
        Result("inputs", [entry.name for entry in mechanism.inputs], "", "driving inputs"),
        Result(
            "groups",
            [step.description for step in run.plan.steps],
            "",
            "Assur groups of the mechanism, in the order of solution",
        ),
        Result("closes", closing, run.unit, ranges),
        Result("closing_ranges", closing, run.unit, f"{ranges}, from and to", shown=False),
        *_dead_centres(run),
    )
    return results if run.running else tuple(result for result in results if result.name != "closes")


def _dead_centres(run: MechanismRun) -> tuple[Result, ...]:
    """Dead centres of the driving input, with the bodies in line there."""
    if run.closed is None:
        return ()
    found: list[Json] = [{"at": at, "bodies": list(bodies)} for at, bodies in run.closed.dead_centres]
    meaning = "ends of the ranges at which the driving input reverses [rad; m], and the bodies in line there"
    return (Result("dead_centres", found, "", meaning, shown=False),)


def _forces(found: Analysis) -> tuple[Result, ...]:
    run = found.run
    least = {pin: float(np.nanmin(angle)) for pin, angle in found.transmission.items() if np.isfinite(angle).any()}
    angles = Result("transmission_angle_min", least, "deg", "least transmission angle of each free pin", shown=False)
    if run.forces is None:
        return (angles, *NO_FORCES)
    return (angles, *results_of(run.forces, found.strength, found.servo, found.study, found.forward, found.balance))


def _mobility(run: MechanismRun) -> str:
    first = int(np.flatnonzero(run.motion.status == Status.OK)[0])
    mechanism = run.plan.mechanism
    without = f", without the redundant constraints at {', '.join(mechanism.redundant)}" if mechanism.redundant else ""
    return mobility(mechanism, run.motion.pose(first)).description + without
