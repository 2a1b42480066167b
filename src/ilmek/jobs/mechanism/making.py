"""A mechanism of a file as made: its parts, and its forces with their masses where the file leaves them open."""

from dataclasses import replace

from ilmek.dynamics.inverse_run import inverse_run
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.analysis import Analysis, analysis
from ilmek.jobs.mechanism.parts import cam_tables, full_travel
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.run import MechanismRun
from ilmek.machines.own_linkage.construction import Construction, construction
from ilmek.machines.own_linkage.report import (
    construction_checks,
    construction_results,
    construction_table,
    made_inertias,
)
from ilmek.machines.own_linkage.tree import own_tree
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.tree import Tree
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import Papers, Report

ROUNDS = 6
"""Rounds in which the sizes of the parts follow their masses, at most."""


@record
class MadeMechanism:
    """A mechanism in motion with its parts; its forces are those with the masses of the parts."""

    analysis: Analysis
    built: Construction
    report: Report

    @property
    def tree(self) -> Tree:
        """Its parts in bodies."""
        return own_tree(self.built)

    @property
    def papers(self) -> Papers:
        """How it is put together, what wears in it, lists of its parts; what makes them is imported here."""
        from ilmek.machines.tree_papers import tree_papers

        return tree_papers(self.tree, in_space=True)


def made_mechanism(run: MechanismRun, progress: Progress = SILENT, *, drawn: bool = False) -> MadeMechanism:
    """The parts of a mechanism in motion, and its analysis and report with them; drawn: with figures.

    Raises MechanismError for a link that is too short for its pins, and for redundant constraints, whose forces are
    open; ParameterError for a pin without a ring; Cancelled.
    """
    redundant = run.plan.mechanism.redundant
    if redundant:
        given = f"no parts of {run.name}: the forces of its redundant constraints at {', '.join(redundant)} are open"
        raise MechanismError(given, do="leave out the bodies or joints that are redundant")
    way = full_travel(run)
    built = construction(run.machine, way, run.forces)
    for _ in range(ROUNDS):
        progress(0.0)
        weighed = _weighed(run, built)
        if weighed is run:
            break
        run = weighed
        sized = construction(run.machine, way, run.forces)
        if _same(sized, built):
            break
        built = sized
    built = replace(built, machine=run.machine)
    found = analysis(run, progress)
    return MadeMechanism(found, built, _with_parts(report(found, drawn=drawn), built, run.machine))


def _same(built: Construction, other: Construction) -> bool:
    """Whether two constructions have the same sizes and layers."""
    sizes = ([(stud.journal, stud.shank, one.key(stud.axis)) for stud in one.studs.values()] for one in (built, other))
    alike = next(sizes) == next(sizes)
    return alike and (built.layering.layers, built.layering.sides) == (other.layering.layers, other.layering.sides)


def _weighed(run: MechanismRun, built: Construction) -> MechanismRun:
    """The run with the masses of the parts for the bodies whose masses are open; itself without any, or forces."""
    machine = run.machine
    if not machine.open_masses or run.forces is None:
        return run
    inertias = made_inertias(built)
    weighed = replace(machine, inertias={**machine.inertias, **{body: inertias[body] for body in machine.open_masses}})
    driving = run.running.name if run.running else None
    return replace(run, machine=weighed, forces=inverse_run(weighed, run.motion, driving, run.time))


def _with_parts(made: Report, built: Construction, machine: OwnMachine) -> Report:
    """The report with the parts and the laws of the inputs as cam tables, layers, masses, and checks of the parts."""
    tree = own_tree(built)
    return replace(
        made,
        results=(*made.results, *construction_results(built)),
        checks=(*made.checks, *construction_checks(built)),
        tables=(*made.tables, construction_table(built)),
        plates=plates_of(tree),
        pieces=pieces_of(tree),
        cam_tables=cam_tables(machine),
    )
