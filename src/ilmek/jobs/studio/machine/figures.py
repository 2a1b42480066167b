"""Figures of a machine's design, chosen by name, and its tables, as data that the client draws."""

from dataclasses import dataclass, field

from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.view import designed
from ilmek.jobs.studio.words import all_in_page, spoken
from ilmek.machines.catalogue import find_machine
from ilmek.machines.component import AnyComponent, Child
from ilmek.params import Setting
from ilmek.report import Figure, Table
from ilmek.viz.number_format import quiet
from ilmek.viz.plain import KINDS, ShownFigure, shown_figures


@dataclass(frozen=True, eq=False, slots=True)
class FiguresRequest:
    """Figures of a design of a machine.

    part   a machine in it, "" for the machine itself      names  of the figures; null: all, with an empty list none
    """

    name: str
    settings: dict[str, Setting] = field(default_factory=dict)
    part: str = ""
    names: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True)
class NamedFigure:
    """A figure that the machine has; kind: plot, drawing, animation, timing, gantt or bars."""

    name: str
    title: str
    kind: str


@dataclass(frozen=True, slots=True)
class NamedPart:
    """A machine in the machine, by its name and its title."""

    name: str
    title: str


@dataclass(frozen=True, eq=False, slots=True)
class MachineFigures:
    """The figures required, all that there are, the machines in it, and a warning for each that cannot be made."""

    figures: list[ShownFigure]
    known: tuple[NamedFigure, ...]
    parts: tuple[NamedPart, ...]
    warnings: tuple[str, ...]


@dataclass(frozen=True, eq=False, slots=True)
class TablesRequest:
    """The tables of a design of a machine; part: of a machine in it, "" for the machine itself."""

    name: str
    settings: dict[str, Setting] = field(default_factory=dict)
    part: str = ""


@dataclass(frozen=True, eq=False, slots=True)
class MachineTables:
    """The tables of a design."""

    tables: list[Table]


def figures(request: FiguresRequest, context: Context) -> MachineFigures:
    """Draw figures of a design. Raises as `design_machine` does, and ParameterError for an unknown part."""
    machine, params = find_machine(request.name).ordered(request.settings)
    design = designed(machine, params, context.progress)
    children = tuple(machine.children(design))
    drawn, warnings = _drawn(machine, design, children, request.part)
    chosen = [one for one in drawn if request.names is None or one.name in request.names]
    answer = MachineFigures(
        shown_figures(chosen),
        tuple(NamedFigure(one.name, one.title, KINDS[type(one)]) for one in drawn),
        tuple(NamedPart(child.name, child.component.title) for child in children),
        all_in_page(warnings),
    )
    return spoken(answer)


def tables(request: TablesRequest, context: Context) -> MachineTables:
    """The tables of a design. Raises as `design_machine` does, and ParameterError for an unknown part."""
    machine, params = find_machine(request.name).ordered(request.settings)
    design = designed(machine, params, context.progress)
    component = machine
    if request.part:
        child = _part(machine, tuple(machine.children(design)), request.part)
        component, design = child.component, child.design
    return spoken(MachineTables([quiet(table) for table in component.tables(component.analysis(design))]))


def _part(machine: AnyComponent, children: tuple[Child, ...], part: str) -> Child:
    child = next((one for one in children if one.name == part), None)
    if child is None:
        names = ", ".join(one.name for one in children) or "none"
        raise ParameterError(f"{machine.name} has no part {part!r}", allowed=f"parts: {names}")
    return child


def _drawn(
    machine: AnyComponent, design: object, children: tuple[Child, ...], part: str
) -> tuple[tuple[Figure, ...], tuple[str, ...]]:
    if not part:
        return machine.drawn(design)
    child = _part(machine, children, part)
    return child.component.drawn(child.design, in_a_loom=True)
