"""Machines of the catalogue, designed from their parameters, and the verification manual."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.arguments import Arguments
from ilmek.errors import ParameterError
from ilmek.jobs.design import design_machine
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.machines import machine_form, machine_list
from ilmek.jobs.reproduce import ReproductionResult, reproduce_papers
from ilmek.params import Parameter, Setting
from ilmek.progress import SILENT, Progress
from ilmek.report import Report
from ilmek.report.framed import RecordTable

Settings = Mapping[str, Setting]
"""Values by name: texts with units, or numbers in SI."""

COARSE = 100.0
"""Knots per metre below which knots per dm were meant; assumed by this project: 10 knots per dm are the coarsest."""


def list_machines() -> dict[str, str]:
    """The machines that `design` takes: name -> summary.

    >>> "beat-up" in list_machines()
    True
    """
    return machine_list()


def parameters(name: str) -> RecordTable[Parameter]:
    """The parameters of a machine of the catalogue, one a row: name, unit, default in SI, bounds, meaning.

    `parameters("beat-up").frame()` is a DataFrame. Raises ParameterError for an unknown machine, with the nearest.

    >>> [(entry.name, entry.unit) for entry in parameters("beat-up") if entry.name == "swing"]
    [('swing', 'deg')]
    """
    form = machine_form(Arguments("a machine").text("name", name))
    columns = ("name", "unit", "default", "at_least", "above", "below", "at_most", "choices", "doc")
    return RecordTable(form.parameters, columns)


def design(
    name: str, parameters: Settings = MappingProxyType({}), /, *, progress: Progress = SILENT, **settings: Setting
) -> Report:
    """Design a machine of the catalogue and report it.

    name        of the machine, like "beat-up"; see `list_machines`. Or the path of a machine file, .toml or .json
    parameters  values by name, nested ones by dotted names: {"pile_handler.rise": "30deg"}
    settings    the same as keywords: design("beat-up", swing=30 * deg)

    Values are texts with units or numbers in SI. `report["drive_torque_max"]` gives a result in SI, `report.failed` the
    checks that do not hold. Raises ParameterError for an unknown machine or parameter and for a value out of bounds;
    errors of the machine; Cancelled.

    >>> report = design("beat-up", swing="30deg", beta="48deg")
    >>> report.failed, report["drive_torque_max"] > 0
    ((), True)
    """
    given = Arguments("a design")
    values = {**given.mapping("parameters", parameters, lambda _, value: value), **settings}
    order = read_machine_order(given.text("name", name), values)
    _check_densities(order.machine, order.settings)
    return design_machine(order.machine, order.settings, progress=given.record("progress", progress, Progress)).report


def _check_densities(name: str, settings: Mapping[str, Setting]) -> None:
    """Raise ParameterError where a number of knots per metre is so small that knots per dm were meant."""
    densities = {parameter.name for parameter in machine_form(name).parameters if parameter.unit == "1/dm"}
    for parameter in densities & settings.keys():
        value = settings[parameter]
        if isinstance(value, int | float) and 0 < value < COARSE:
            raise ParameterError(
                f"{parameter}={value:g} is {value / 10:g} knots per dm",
                allowed=f"a bare number is in knots per metre, above {COARSE:g}",
                do=f'did you mean "{value:g}/dm"?',
            )


def reproduce(*papers: str, progress: Progress = SILENT) -> ReproductionResult:
    """Recompute the numbers, equations and statements of the papers of the verification manual, and judge each.

    papers  names like "beat-up"; default: all
    Raises ParameterError for an unknown paper; Cancelled.

    >>> list(reproduce("beat-up").verdicts)
    ['beat-up']
    """
    given = Arguments("the manual")
    names = [given.text("paper", paper) for paper in papers]
    return reproduce_papers(names, progress=given.record("progress", progress, Progress))
