"""A component: a machine, or a part of one, by what it can do; all but parameters, design and analysis is optional.

    params --design--> design --analysis--> analysis --> results, checks, tables, figures, warnings
                        |
                        +--> plates, cam tables, cyclograms, parts, work, tracks, children

A machine is a component with children; `report` makes its report and those of its children. In a loom a component
gets its parameters from the loom's task (`fit`), and the loom sums what its components return.

`Component[P, D, A]` is typed by its parameters, its design and its analysis: a checker refuses checks that do not take
what the analysis returns. Machines of all types together, as in the catalogue, are of the type `AnyComponent`.
"""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Generic, Protocol, TypeAlias, TypeVar

from ilmek.dynamics.own_machine import OwnMachine
from ilmek.machines import ENTRIES
from ilmek.machines.beat import PlannedBeat
from ilmek.machines.invariants import broken
from ilmek.machines.loom_task import LoomTask, MachineDesign, P
from ilmek.params import Params, Setting
from ilmek.part.bill import bill
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.tree import GROUND, Tree
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.report import (
    BUILDABLE,
    BillLine,
    CamTable,
    Check,
    Choice,
    Figure,
    Papers,
    Plate,
    Report,
    Table,
    Work,
    WorkPiece,
    results_of,
)
from ilmek.report.left_out import LazyFigure, made_figures
from ilmek.timing.cyclogram import Cyclogram, Track

D = TypeVar("D", bound=MachineDesign)
A = TypeVar("A")
Item = TypeVar("Item")


def itself(item: Item) -> Item:
    """The analysis of a machine whose design is all that its report needs."""
    return item


def _nothing(_item: object) -> tuple[()]:
    return ()


def _no_variant(_params: object) -> None:
    return None


def _first(design: D, _params: object) -> D:
    return design


def _parameters(design: MachineDesign) -> Params:
    return design.params


class PartsInSpace(Protocol):
    """The parts of a machine against each other, a record with declared results."""

    @property
    def checks(self) -> tuple[Check, ...]:
        """Whether they have room, and make one machine."""

    @property
    def tables(self) -> tuple[Table, ...]:
        """Which come nearest."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Component(Generic[P, D, A]):
    """A machine of the catalogue, or of a loom.

    name        as typed on the command line: `beat-up`          title    heading of its report
    params      its declared parameters
    design      parameters -> design, a frozen record of the machine's own
    long_design parameters, progress -> the same design, for one that can take more than 2 s
    analysis    design -> what is computed for its report only; `itself`: the design is
    results     analysis -> records with declared results (one, or a tuple of them); default: the analysis
    reported    the classes of these records, from which the reference of its JSON names is made
    checks, tables, figures, warnings   analysis -> each; a figure that cannot be made is left out with a warning
    self_tests  analysis -> tests of the computation itself, such as a power balance; listed apart, a failed one is a
                failed check too, so that such a design is never reported as sound
    tree        design -> its parts in bodies, from which its parts list, its plates and its pieces follow
    stand       design -> the bodies that carry it where it is alone, which are in its tree then; a loom's frame does
    own_tree    design -> the bodies of it that are in none of its children; default: all
    plates, pieces, cam_tables, cyclograms   design -> what is made of it, what its axes follow, its timing
    mechanism   design -> its linkage as an own mechanism, for a file; None where the design has none
    papers      design, report -> its papers; default: the lists of its parts
    parts       design -> lines of the parts list                work     design -> work of its acts
    tracks      design -> its tracks on the loom's cyclogram of a row
    choices     design -> what it chose of what was left open, and which check decided
    children    design -> the machines in it
    parameters  design -> the parameters in force, where the design chose some that were left open
    fit         loom's task -> parameters, for a machine that can be in a loom
    beat        loom's task, kind of beat -> its planned beat, for a machine that can beat (`ilmek.machines.beat`)
    own_figures beginnings of the names of figures that only its own page shows, not a loom's
    assembly    design -> its parts against each other in space; takes some seconds
    with_room   design, parameters -> the design, or the next choice whose parts have room in space; takes seconds
    verdict     report -> a record with results that follow from all checks, of the machines in it too
    variant     parameters -> the machine that they name in its place, and the parameters of that; None: itself
    headline    names of results that stand at the top level of the JSON too
    """

    name: str
    title: str
    params: type[P]
    design: Callable[[P], D]
    analysis: Callable[[D], A]
    results: Callable[[A], object] = itself
    reported: tuple[type, ...] = ()
    checks: Callable[[A], tuple[Check, ...]] = _nothing
    self_tests: Callable[[A], tuple[Check, ...]] = _nothing
    tables: Callable[[A], tuple[Table, ...]] = _nothing
    figures: Callable[[A], tuple[Figure | LazyFigure, ...]] = _nothing
    warnings: Callable[[A], tuple[str, ...]] = _nothing
    tree: Callable[[D], Tree] | None = None
    stand: Callable[[D], Tree] | None = None
    own_tree: Callable[[D], Tree] | None = None
    pieces: Callable[[D], tuple[WorkPiece, ...]] = _nothing
    plates: Callable[[D], tuple[Plate, ...]] = _nothing
    cam_tables: Callable[[D], tuple[CamTable, ...]] = _nothing
    cyclograms: Callable[[D], tuple[Cyclogram, ...]] | None = None
    mechanism: Callable[[D], OwnMachine | None] | None = None
    papers: Callable[[D, Report], Papers] | None = None
    parts: Callable[[D], tuple[BillLine, ...]] = _nothing
    work: Callable[[D], tuple[Work, ...]] = _nothing
    tracks: Callable[[D], tuple[Track, ...]] = _nothing
    choices: Callable[[D], tuple[Choice, ...]] = _nothing
    children: Callable[[D], "tuple[Child, ...]"] = _nothing
    parameters: Callable[[D], Params] = _parameters
    fit: Callable[[LoomTask], P] | None = None
    beat: Callable[[LoomTask, str], PlannedBeat] | None = None
    own_figures: tuple[str, ...] = ()
    assembly: Callable[[D], PartsInSpace] | None = None
    with_room: Callable[[D, P], D] = _first
    verdict: Callable[[Report], object] | None = None
    headline: tuple[str, ...] = ()
    variant: Callable[[P], "tuple[AnyComponent, Params] | None"] = _no_variant
    long_design: Callable[[P, Progress], D] | None = None

    def __post_init__(self) -> None:
        if self.tree is not None:
            tree = whole = lru_cache(maxsize=8)(self.tree)
            if self.stand is not None:
                stand = lru_cache(maxsize=8)(self.stand)
                object.__setattr__(self, "stand", stand)
                whole = lru_cache(maxsize=8)(lambda design: stand(design).carrying(GROUND, tree(design)))
            object.__setattr__(self, "tree", whole)
            object.__setattr__(self, "parts", lru_cache(maxsize=8)(lambda design: bill(tree(design))))
            own = self.own_tree or tree
            object.__setattr__(self, "plates", lambda design: plates_of(own(design)))
            object.__setattr__(self, "pieces", lambda design: pieces_of(own(design)))

    def __repr__(self) -> str:
        return f"<Component {self.name}>"

    @property
    def summary(self) -> str:
        """One line for `ilmek machines`: that of the catalogue."""
        return ENTRIES[self.name].summary

    def ordered(self, settings: Mapping[str, Setting]) -> "tuple[AnyComponent, Params]":
        """The machine for settings, itself or a variant, and its parameters. Raises ParameterError, LoomError."""
        params = self.params.read(settings)
        return self.variant(params) or (self, params)

    def designed(self, params: P, progress: Progress = SILENT) -> D:
        """The design for parameters. Raises any IlmekError, and Cancelled."""
        progress(0.0)
        return self.long_design(params, progress) if self.long_design else self.design(params)

    def report(
        self,
        design: D,
        *,
        in_a_loom: bool = False,
        illustrated: bool = True,
        drawn: bool = True,
        assembled: bool = True,
        listed: bool = True,
        only: frozenset[str] | None = None,
    ) -> Report:
        """The report of a design, with those of the machines in it.

        A broken invariant is a failed check of it (`ilmek.machines.invariants`).

        in_a_loom    True: without the figures that only the machine's own page shows
        illustrated  False: without tables and figures, which take as long as all the rest
        drawn        False: without figures
        assembled    False: without its parts against each other in space
        listed       False: without lists of parts, plates and cam tables, for one of very many designs
        only         names of results: the others are not computed, but where a check needs them
        """
        analysis = self.analysis(design)
        records = self.results(analysis)
        whole = (self.assembly(design),) if self.assembly and assembled else ()
        figures, left_out = self.drawn(design, in_a_loom=in_a_loom) if illustrated and drawn else ((), ())
        tests = self.self_tests(analysis)
        stand = Tree() if in_a_loom or self.stand is None or not listed else self.stand(design)
        report = Report(
            machine=self.name,
            title=self.title,
            parameters=self.parameters(design).as_dict(),
            results=results_of(*(records if isinstance(records, tuple) else (records,)), *whole, only=only),
            checks=(
                *self.checks(analysis),
                *(check for parts in whole for check in parts.checks),
                *(test for test in tests if not test.ok),
            ),
            self_tests=tests,
            tables=(*self.tables(analysis), *(table for parts in whole for table in parts.tables))
            if illustrated
            else (),
            figures=figures,
            warnings=(*self.warnings(analysis), *left_out),
            plates=(*self.plates(design), *plates_of(stand)) if listed else (),
            cam_tables=self.cam_tables(design) if listed else (),
            pieces=(*self.pieces(design), *pieces_of(stand)) if listed else (),
            parts=(*self.parts(design), *bill(stand)) if listed else (),
            children=tuple(
                child.reported(illustrated=illustrated, drawn=drawn, listed=listed, only=only)
                for child in self.children(design)
            ),
            choices=self.choices(design),
            headline=tuple(name for name in self.headline if whole or name != BUILDABLE),
        )
        report = replace(report, checks=(*report.checks, *broken(report, self.work(design))))
        return replace(report, results=(*results_of(self.verdict(report)), *report.results)) if self.verdict else report

    def drawn(self, design: D, *, in_a_loom: bool = False) -> tuple[tuple[Figure, ...], tuple[str, ...]]:
        """The figures of a design, and a warning for each that cannot be made.

        in_a_loom  True: without those that only the machine's own page shows
        """
        left_out: list[str] = []
        figures = made_figures(lambda: self.figures(self.analysis(design)), left_out)
        if in_a_loom and self.own_figures:
            figures = tuple(figure for figure in figures if not figure.name.startswith(self.own_figures))
        return figures, tuple(left_out)

    def report_for(self, settings: Mapping[str, Setting]) -> Report:
        """The report of the design for settings of its parameters, texts with units allowed. Raises any IlmekError."""
        machine, params = self.ordered(settings)
        return machine.report(machine.design(params))


AnyComponent: TypeAlias = Component[Any, Any, Any]
"""A machine of any parameters, design and analysis."""


@record
class Child:
    """A machine in another: its component, its design, and the number of them.

    number  0: an alternative that is reported, but is not in the parts list
    made    its report, where it was made already
    """

    component: AnyComponent
    design: Any
    number: int = 1
    made: Report | None = None

    @property
    def name(self) -> str:
        """The component's name."""
        return self.component.name

    def design_as(self, kind: type[D]) -> D:
        """Its design, of a class. Raises TypeError where it is of another."""
        design = self.design
        if not isinstance(design, kind):
            raise TypeError(f"{self.name}: the design is a {type(design).__name__}, not a {kind.__name__}")
        return design

    @property
    def parts(self) -> tuple[BillLine, ...]:
        """Lines of the parts list of one of them."""
        return self.component.parts(self.design)

    @property
    def work(self) -> tuple[Work, ...]:
        """Work of its acts."""
        return self.component.work(self.design)

    def reported(
        self,
        *,
        illustrated: bool = True,
        drawn: bool = True,
        listed: bool = True,
        only: frozenset[str] | None = None,
    ) -> Report:
        """Its report, as a machine in a loom, as `Component.report` makes it."""
        drawn = illustrated and drawn
        return self.made or _report_in_a_loom(self.component, self.design, illustrated, drawn, listed, only)


@lru_cache(maxsize=32)
def _report_in_a_loom(  # noqa: PLR0917
    component: AnyComponent, design: Hashable, illustrated: bool, drawn: bool, listed: bool, only: frozenset[str] | None
) -> Report:
    """The report of a machine in a loom, made once for a design: looms that differ elsewhere share it."""
    return component.report(design, in_a_loom=True, illustrated=illustrated, drawn=drawn, listed=listed, only=only)
