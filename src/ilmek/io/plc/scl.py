"""The control program as a source of SCL for S7-1200 and S7-1500.

Differences from IEC 61131-3: local names have a #, names of blocks and types quotes; there are no array types and no
programs: a function without a result takes the inputs from their addresses, calls the block's instance and writes the
outputs; the values of the host are in the instance. It is called in a cyclic interrupt.
"""

import re

from ilmek.io.plc.io_list import HOST, IoRow
from ilmek.io.plc.units import INDENT, PlcArray, PlcProject, PlcSection, PlcUnit, PlcVariable, indented, initial_text

_TOKEN = re.compile(r"\(\*.*?\*\)|\.?[A-Za-z_]\w*(?:#[0-9A-F#]+)?|:=|=>|.|\n", re.DOTALL)
_ELEMENTARY = {"BOOL": "Bool", "INT": "Int", "DINT": "DInt", "USINT": "USInt", "REAL": "Real", "DWORD": "DWord"}


def scl_source(project: PlcProject, rows: list[IoRow]) -> str:
    """The program as text. rows: the list of inputs and outputs of its last unit."""
    block = project.units[-1]
    names = {structure.name for structure in project.structures} | {unit.name for unit in project.units}
    texts = ["".join(f"// {remark}\n" for remark in project.remarks)]
    for structure in project.structures:
        members = "\n".join(f"{2 * INDENT}{_declared(own)}" for own in structure.variables)
        texts.append(
            f'TYPE "{structure.name}"\nVERSION : 0.1\n{INDENT}STRUCT\n{members}\n{INDENT}END_STRUCT;\nEND_TYPE\n'
        )
    texts += [_unit(unit, names) for unit in project.units]
    texts.append(f'DATA_BLOCK "{block.name}Data"\nVERSION : 0.1\n"{block.name}"\nBEGIN\nEND_DATA_BLOCK\n')
    texts.append(_cycle(project, rows))
    return "\n".join(texts)


def _declared(variable: PlcVariable) -> str:
    initial = f" := {initial_text(variable.initial)}" if variable.initial else ""
    return f"{variable.name} : {_type(variable)}{initial}; // {variable.meaning}".removesuffix(" // ")


def _type(variable: PlcVariable) -> str:
    kind = variable.kind
    if isinstance(kind, PlcArray):
        return f"Array[0..{kind.size - 1}] of {_ELEMENTARY[kind.element]}"
    return _ELEMENTARY.get(kind, f'"{kind}"')


def _unit(unit: PlcUnit, names: set[str]) -> str:
    head = f'{unit.kind} "{unit.name}"' + (f" : {_ELEMENTARY[unit.returns]}" if unit.returns else "")
    lines = [head, f"TITLE = {unit.meaning}", "VERSION : 0.1"]
    for section in unit.sections:
        lines += [_section(section, unit), *(f"{INDENT}{_declared(own)}" for own in section.variables), "END_VAR"]
    local = {variable.name for variable in unit.variables} | ({unit.name} if unit.returns else set())
    return "\n".join((*lines, "BEGIN", indented(scl_body(unit.body, local, names).rstrip()), f"END_{unit.kind}", ""))


def _section(section: PlcSection, unit: PlcUnit) -> str:
    """Local values of a function are temporary: it has no memory."""
    return "VAR_TEMP" if unit.returns and section.kind == "VAR" else section.kind


def scl_body(body: str, local: set[str], names: set[str]) -> str:
    """Statements in SCL.

    >>> scl_body("Sum := CrcOf(Crc := Sum, Bits := 8) + Now.Row;", {"Sum", "Now", "Crc"}, {"CrcOf"})
    '#Sum := "CrcOf"(Crc := #Sum, Bits := 8) + #Now.Row;'
    """
    tokens = [token for token in _TOKEN.findall(body) if token]
    written, depth = [], 0
    for number, token in enumerate(tokens):
        depth += {"(": 1, ")": -1}.get(token, 0)
        following = next((later for later in tokens[number + 1 :] if not later.isspace()), "")
        formal = depth > 0 and following in {":=", "=>"}
        if token in local and not formal:
            written.append(f"#{token}")
        elif token in names:
            written.append(f'"{token}"')
        else:
            written.append(token)
    return "".join(written)


def _cycle(project: PlcProject, rows: list[IoRow]) -> str:
    block = project.units[-1]
    data = f'"{block.name}Data"'
    field = [row for row in rows if row[0].partition("[")[0] not in HOST]
    lines = [f"{data}.{row[0]} := {row[3]};" for row in field if row[1] == "input"]
    lines += [f"{data}();"]
    lines += [f"{row[3]} := {data}.{row[0]};" for row in field if row[1] == "output"]
    title = f"call it in a cyclic interrupt of {round(1000 * project.cycle)} ms"
    body = indented("\n".join(lines))
    return f'FUNCTION "{block.name}Cycle" : Void\nTITLE = {title}\nVERSION : 0.1\nBEGIN\n{body}\nEND_FUNCTION\n'
