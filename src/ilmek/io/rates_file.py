"""Rates of the cost of a carpet, TOML or JSON: the rates of `cost.*` by their names, in place of the usual ones.

    wage = "12/h"
    interest = "8%"
    life = 10
    prices = "milling per h = 70; structural steel per kg = 1.5"

Texts have their units, as on the command line; numbers are SI. `prices` are those of parts and of the workshop.
"""

from pathlib import Path

from ilmek.elements.prices import read_prices
from ilmek.errors import IlmekError, MechanismError, ParameterError, restated
from ilmek.io.data_text import read_data
from ilmek.io.file_entry import FileEntry
from ilmek.io.schema import SourceText
from ilmek.machines.catalogue import find_machine
from ilmek.params import Setting, listed
from ilmek.params.parameter import LONGEST_TEXT

_GROUP, _PRICES = "cost", "prices"
"""Parameters of a loom that are rates."""


def read_rates(path: Path | None) -> dict[str, Setting]:
    """The settings of a loom that a file of rates gives, by dotted name; none without a file.

    Raises ParameterError with the file and the line for what cannot be read, an unknown rate, one out of bounds.
    """
    if path is None:
        return {}
    read = read_data(path, "rates", ParameterError, longest=LONGEST_TEXT)
    with restated(ParameterError, of=MechanismError):
        root = FileEntry(read.data, (), SourceText(str(path), read.lines))
        loom = find_machine("automated-loom").params
        names = (parameter.name.partition(".") for parameter in listed(loom))
        root.keys(*(name for group, _, name in names if group == _GROUP), _PRICES)
        rates = dict(root.settings())
        for name, rate in rates.items():
            try:
                loom.read({_parameter(name): rate})
                if name == _PRICES:
                    read_prices(str(rate))
            except IlmekError as error:
                root.refuse(error, name)
    return {_parameter(name): rate for name, rate in rates.items()}


def _parameter(name: str) -> str:
    return name if name == _PRICES else f"{_GROUP}.{name}"
