"""The program that a task runs: the loom's block, its signals at their addresses, the host's values as variables."""

from ilmek.io.plc.io_list import HOST, IoRow
from ilmek.io.plc.sequence_logic import BLOCK
from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable

MAIN = "Main"
"""Name of the program."""


def element_name(element: str) -> str:
    """Name of a signal's variable: an element of an array without its brackets.

    >>> element_name("TieDone[2]")
    'TieDone2'
    """
    return element.replace("[", "").replace("]", "")


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
                name = f"{name}Signal" if name == variable.name else name
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
