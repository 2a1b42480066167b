"""Designs of a study that a table gives: a column a parameter, a row a design."""

from pathlib import Path

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import IlmekError, ParameterError, restated
from ilmek.io.csv_lines import csv_lines
from ilmek.io.text_file import read_text
from ilmek.jobs.study.order import nominal_in
from ilmek.jobs.study.targets import StudyTarget
from ilmek.params import Parameter, Value
from ilmek.studies.variable import Variable
from ilmek.units import counted, read_number

LARGEST = 200_000_000
"""Largest size of a table [bytes]."""


def read_designs(target: StudyTarget, path: Path) -> tuple[tuple[Variable, ...], Float[np.ndarray, "n variables"]]:
    """The variables of a table, and their values, a row a design; a plain number is SI, as `--csv` writes it.

    Raises ParameterError, with the line, for an unknown name, a value that cannot be read, and one out of bounds.
    """
    with restated(ParameterError, f"--designs {path}: ", of=IlmekError):
        table = csv_lines(
            read_text(path, noun="table", largest=LARGEST, error=ParameterError, do="check its name"), ParameterError
        )
        _, names = table.header
        parameters = [target.parameter(name) for name in names]
        rows = []
        for line, cells in table.lines:
            with restated(ParameterError, f"line {line}: ", of=IlmekError):
                if len(cells) < len(names):
                    raise ParameterError(counted(len(cells), "cell"), allowed=f"{len(names)}, one for each column")
                rows.append([_value(one, cell) for one, cell in zip(parameters, cells, strict=True)])
        if not rows:
            raise ParameterError("no row below the headings", do="give a row for each design")
    columns = [
        _column(target, name, one, values)
        for name, one, values in zip(names, parameters, zip(*rows, strict=True), strict=True)
    ]
    return tuple(variable for variable, _ in columns), np.column_stack([points for _, points in columns])


def _value(parameter: Parameter, cell: str) -> Value:
    number = read_number(cell)
    value = parameter.read(cell if number is None or parameter.kind not in (int, float) else parameter.kind(number))
    parameter.check(value)
    return value


def _column(
    target: StudyTarget, name: str, parameter: Parameter, values: tuple[Value, ...]
) -> tuple[Variable, np.ndarray]:
    """The variable of a column: numbers between its ends, or the choices that occur in it."""
    numbers = [float(value) for value in values if isinstance(value, int | float) and parameter.kind in (int, float)]
    if len(numbers) == len(values) and min(numbers) < max(numbers):
        low, high = min(numbers), max(numbers)
        middle = nominal_in(target.nominal(name), low, high)
        return Variable(name, parameter.unit, low, high, middle, whole=parameter.kind is int), np.array(numbers)
    choices = tuple(dict.fromkeys(values))
    unit = parameter.unit if parameter.kind is float else ""
    variable = Variable(name, unit, 0.0, float(len(choices) - 1), 0.0, choices=choices)
    return variable, np.array([float(choices.index(value)) for value in values])
