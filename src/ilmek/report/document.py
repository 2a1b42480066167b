"""The report of a machine: results, checks, tables and figures, and the reports of the machines it consists of."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from ilmek.errors import ParameterError, did_you_mean
from ilmek.records import JsonObject, record, shown_value
from ilmek.report.bill import BillLine
from ilmek.report.check import Check
from ilmek.report.choice import Choice
from ilmek.report.figure import Figure
from ilmek.report.json import Json, plain
from ilmek.report.results import Result
from ilmek.report.shown import Shown
from ilmek.report.table import Table
from ilmek.report.verdict import reasons, verdict_json
from ilmek.report.workshop import CamTable, Plate, WorkPiece

BUILDABLE = "buildable"
"""Result of a machine whose parts are compared with each other in space: whether they make one machine."""

NEAREST = "nearest"
"""Name of a result: the nearest tasks that the machine could do, each a wish and its value."""

_Named = TypeVar("_Named", Plate, CamTable, WorkPiece)


class UnknownResult(ParameterError, KeyError):
    """A result that a report does not have."""

    __str__ = Exception.__str__  # that of KeyError would put quotation marks around the message


@record
class Report(Shown):
    """What a design reports; `children` are the reports of the machines in it.

    `results`, `checks`, `warnings`, `plates` and `cam_tables` are its own; those of the whole tree carry the name of
    their machine: `all_checks`, `all_warnings`, `all_plates`, `all_cam_tables`. `headline` names results that stand at
    the top level of the JSON too. `self_tests` are tests of the computation, not of the machine: power balances,
    closure; one that fails is among `checks` too. `lead` is a sentence that stands below the title of its page.

    >>> report = Report("press", "Press", {}, (Result("force", 60.0, "N", "greatest force"),), ())
    >>> report["force"], report.failed
    (60.0, ())
    """

    machine: str
    title: str
    parameters: Mapping[str, Json]
    results: tuple[Result, ...]
    checks: tuple[Check, ...]
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    warnings: tuple[str, ...] = ()
    plates: tuple[Plate, ...] = ()
    cam_tables: tuple[CamTable, ...] = ()
    pieces: tuple[WorkPiece, ...] = ()
    parts: tuple[BillLine, ...] = ()
    children: tuple["Report", ...] = ()
    choices: tuple[Choice, ...] = ()
    headline: tuple[str, ...] = ()
    self_tests: tuple[Check, ...] = ()
    lead: str = ""

    @property
    def key(self) -> str:
        """Name of the machine as a key of JSON: `beat_up`."""
        return self.machine.replace("-", "_")

    @property
    def all_checks(self) -> tuple[Check, ...]:
        """The checks of the whole tree; those of a machine in it begin with its name."""
        below = (
            replace(check, name=f"{child.machine}: {check.name}")
            for child in self.children
            for check in child.all_checks
        )
        return (*self.checks, *below)

    @property
    def all_self_tests(self) -> tuple[Check, ...]:
        """The self-tests of the whole tree; those of a machine in it begin with its name."""
        below = (
            replace(test, name=f"{child.machine}: {test.name}")
            for child in self.children
            for test in child.all_self_tests
        )
        return (*self.self_tests, *below)

    @property
    def all_warnings(self) -> tuple[str, ...]:
        """The warnings of the whole tree; those of a machine in it begin with its name."""
        below = (f"{child.machine}: {warning}" for child in self.children for warning in child.all_warnings)
        return (*self.warnings, *below)

    @property
    def all_plates(self) -> tuple[Plate, ...]:
        """The plates of the whole tree."""
        return (*self.plates, *(one for child in self.children for one in _named(child, child.all_plates)))

    @property
    def all_pieces(self) -> tuple[WorkPiece, ...]:
        """The pieces of the whole tree that have no plate."""
        return (*self.pieces, *(one for child in self.children for one in _named(child, child.all_pieces)))

    @property
    def all_cam_tables(self) -> tuple[CamTable, ...]:
        """The cam tables of the whole tree, those of the machines in it first."""
        return (*(one for child in self.children for one in _named(child, child.all_cam_tables)), *self.cam_tables)

    @property
    def failed(self) -> tuple[Check, ...]:
        """The checks of the whole tree that do not hold."""
        return tuple(check for check in self.all_checks if not check.ok)

    @property
    def reasons(self) -> tuple[Check, ...]:
        """Why the machine does not do its work, the heaviest reason first; empty where every check holds."""
        return reasons(self.all_checks)

    @property
    def nearest(self) -> str:
        """The nearest tasks that the machine could do, in words; "" where its results name none.

        >>> fits = [{"wish": "width", "value": "1 m"}, {"wish": "knot", "value": "symmetric"}]
        >>> Report("loom", "Loom", {}, (Result("nearest", fits, "", "what it could weave"),), ()).nearest
        'width 1 m; knot symmetric'
        """
        found: Any = next((result.value for result in self.results if result.name == NEAREST), ())
        return "; ".join(f"{one['wish']} {one['value']}" for one in found)

    @property
    def all_choices(self) -> tuple[Choice, ...]:
        """The choices of the whole tree; those of a machine in it begin with its name."""
        below = (
            replace(choice, name=f"{child.machine}: {choice.name}")
            for child in self.children
            for choice in child.all_choices
        )
        return (*self.choices, *below)

    def __getitem__(self, name: str) -> Json:
        """The value of a result [SI] by its name, of a machine in it by a dotted name: `beat_up.crank`.

        Raises UnknownResult, naming the nearest, for any other; `names` lists them.
        """
        if not isinstance(name, str):
            raise UnknownResult(f"{shown_value(name)} given for a result of {self.machine}", allowed="its name")
        head, dot, rest = name.partition(".")
        if dot:
            for child in self.children:
                if head in (child.key, child.machine):
                    return child[rest]
        for result in self.results:
            if result.name == name:
                return result.value
        hint = did_you_mean(name, self.names(), otherwise="its names() lists them")
        raise UnknownResult(f"{self.machine} has no result {name!r}", do=hint)

    def number(self, name: str) -> float:
        """The value of a result [SI], as `report[name]`. Raises UnknownResult for one that is no number."""
        value = self[name]
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise UnknownResult(
                f"{name} of {self.machine} is {shown_value(value)}", allowed="a result that is a number"
            )
        return float(value)

    def figure(self, name: str) -> Figure:
        """A figure by its name, of a machine in it by a dotted name; a notebook shows it, `save` writes it.

        Raises UnknownResult, naming the nearest, for any other.
        """
        drawn = dict(self._figures())
        if not isinstance(name, str) or name not in drawn:
            hint = did_you_mean(str(name), drawn, otherwise=f"it has {', '.join(drawn)}" if drawn else "")
            raise UnknownResult(f"{self.machine} has no figure {shown_value(name)}", do=hint)
        return drawn[name]

    def _figures(self) -> Iterator[tuple[str, Figure]]:
        yield from ((drawn.name, drawn) for drawn in self.figures)
        yield from ((f"{child.key}.{name}", drawn) for child in self.children for name, drawn in child._figures())

    def names(self) -> Iterator[str]:
        """The names of all results, dotted for the machines in it."""
        yield from (result.name for result in self.results)
        yield from (f"{child.key}.{name}" for child in self.children for name in child.names())

    def __repr__(self) -> str:
        held = len(self.all_checks) - len(self.failed)
        return f"<Report {self.machine}: {len(self.results)} results, {held} of {len(self.all_checks)} checks hold>"

    def results_as_json(self) -> JsonObject:
        """Name to value, and under the key of each machine in it its results."""
        own = {result.name: plain(result.value) for result in self.results}
        return own | {child.key: child.results_as_json() for child in self.children}

    def as_json(self) -> JsonObject:
        """The contract of `--json`: machine, verdict, parameters, results, checks, choices; SI, full precision.

        `machines` has the parameters in force of the machines in it.
        """
        results = self.results_as_json()
        return {
            "machine": self.machine,
            **{name: results[name] for name in self.headline},
            **verdict_json(self.all_checks),
            "parameters": plain(self.parameters),
            "results": results,
            "checks": [check.as_json() for check in self.all_checks],
            "self_tests": [test.as_json() for test in self.all_self_tests],
            "choices": [choice.as_json() for choice in self.all_choices],
            "warnings": list(self.all_warnings),
            **({"machines": self._machines()} if self.children else {}),
        }

    def _machines(self) -> JsonObject:
        """The parameters of the machines in it, by their names, each with those of its own machines."""
        return {
            child.machine: {"parameters": plain(child.parameters)}
            | ({"machines": child._machines()} if child.children else {})
            for child in self.children
        }

    def own(self) -> "Report":
        """The same without the machines in it."""
        return replace(self, children=())


def _named(child: Report, made: tuple[_Named, ...]) -> Iterator[_Named]:
    return (replace(one, name=f"{child.machine}-{one.name}") for one in made)
