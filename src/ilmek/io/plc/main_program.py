"""The program that a task runs: the loom's block, its signals at their addresses, the host's values as variables."""

from collections.abc import Mapping

from ilmek.io.plc.io_list import HOST, IoRow
from ilmek.io.plc.sequence_logic import BLOCK
from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable
from ilmek.records import JsonObject

MAIN = "Main"
"""Name of the program."""


def element_name(element: str) -> str:
    """Name of a signal's variable: an element of an array without its brackets.

    >>> element_name("TieDone[2]"), element_name("EndDone")
    ('TieDone2', 'EndDoneSignal')
    """
    return element.replace("[", "").replace("]", "") if "[" in element else f"{element}Signal"


def signal_values(values: Mapping[str, object]) -> JsonObject:
    """Values of the block's variables as those of the program: one for each signal with an address.

    >>> signal_values({"TieDone": [True, False], "EndDone": True, "EndAnswer": 2})
    {'TieDone0': True, 'TieDone1': False, 'EndDoneSignal': True, 'EndAnswer': 2}
    """
    signals: JsonObject = {}
    for name, value in values.items():
        if name in HOST:
            signals[name] = value
        elif isinstance(value, list):
            signals |= {element_name(f"{name}[{index}]"): one for index, one in enumerate(value)}
        else:
            signals[element_name(name)] = value
    return signals


def main_program(block: PlcUnit, rows: list[IoRow]) -> PlcUnit:
    """The program of a block for the rows of its list of inputs and outputs."""
    addresses = {row[0]: row[3] for row in rows}
    located: list[PlcVariable] = []
    before: list[str] = []
    behind: list[str] = []
    inputs, outputs = block.of_kind("VAR_INPUT"), block.of_kind("VAR_OUTPUT")
    for variables, lines in ((inputs, before), (outputs, behind)):
        for variable in variables:
            for element, kind in variable.elements if variable.name not in HOST else ():
                name = element_name(element)
                located.append(PlcVariable(name, kind, variable.meaning, address=addresses[element]))
                lines.append(f"{element} := {name};" if lines is before else f"{name} := {element};")
    given = [f"{variable.name} := {variable.name}" for variable in inputs]
    taken = [f"{variable.name} => {variable.name}" for variable in outputs]
    call = ",\n    ".join((*given, *taken))
    sections = (
        PlcSection("VAR", tuple(located)),
        PlcSection("VAR", (*inputs, *outputs, PlcVariable("Control", BLOCK))),
    )
    body = "\n".join((*before, f"Control({call});", *behind))
    meaning = "signals to the loom's block, and its orders to the signals"
    return PlcUnit("PROGRAM", MAIN, meaning, sections, body)
