"""Program organisation units of IEC 61131-3 as plain data, and their structured text.

Names are in capitals and small letters, at most 31 characters; variables have one of the elementary types, an array of
one dimension or a structure. A unit is written the same as text and into PLCopen XML.
"""

from dataclasses import dataclass, field

INDENT = "    "


@dataclass(frozen=True, slots=True)
class PlcArray:
    """An array of one dimension: its first and last index, and the type of its elements."""

    first: int
    last: int
    element: str

    def __str__(self) -> str:
        """The type in structured text."""
        return f"ARRAY[{self.first}..{self.last}] OF {self.element}"


PlcType = str | PlcArray


@dataclass(frozen=True, slots=True)
class PlcVariable:
    """A variable: its type, its initial value as written, or a list for an array, and what it means."""

    name: str
    kind: PlcType
    meaning: str = ""
    initial: str | tuple[str, ...] = ""

    @property
    def text(self) -> str:
        """The declaration in structured text."""
        given = f" := {initial_text(self.initial)}" if self.initial else ""
        remark = f" (* {self.meaning} *)" if self.meaning else ""
        return f"{self.name} : {self.kind}{given};{remark}"


def initial_text(initial: str | tuple[str, ...]) -> str:
    """An initial value in structured text; the elements of an array in lines of ten."""
    if isinstance(initial, str):
        return initial
    lines = [", ".join(initial[at : at + 10]) for at in range(0, len(initial), 10)]
    return "[" + (",\n" + 2 * INDENT).join(lines) + "]"


@dataclass(frozen=True, slots=True)
class PlcStructure:
    """A structure."""

    name: str
    variables: tuple[PlcVariable, ...]

    @property
    def text(self) -> str:
        """The declaration in structured text."""
        lines = "\n".join(f"{INDENT}{variable.text}" for variable in self.variables)
        return f"TYPE {self.name} :\nSTRUCT\n{lines}\nEND_STRUCT;\nEND_TYPE\n"


@dataclass(frozen=True, slots=True)
class PlcSection:
    """Variables of one kind: VAR_INPUT, VAR_OUTPUT, VAR, VAR RETAIN, VAR CONSTANT."""

    kind: str
    variables: tuple[PlcVariable, ...]


@dataclass(frozen=True, slots=True)
class PlcUnit:
    """A FUNCTION, FUNCTION_BLOCK or PROGRAM; returns: the type of a function."""

    kind: str
    name: str
    meaning: str
    sections: tuple[PlcSection, ...]
    body: str
    returns: str = ""

    @property
    def text(self) -> str:
        """The unit in structured text."""
        head = f"{self.kind} {self.name}" + (f" : {self.returns}" if self.returns else "")
        lines = [f"(* {self.meaning} *)", head]
        for section in self.sections:
            lines += [section.kind, *(f"{INDENT}{variable.text}" for variable in section.variables), "END_VAR"]
        return "\n".join((*lines, self.body.rstrip(), f"END_{self.kind}", ""))


@dataclass(frozen=True, slots=True)
class PlcProject:
    """A control program: its structures and units, in the order in which they refer to each other.

    name  of the project      program  the unit that a task runs every `cycle` [s]
    """

    name: str
    structures: tuple[PlcStructure, ...]
    units: tuple[PlcUnit, ...]
    program: str
    cycle: float
    remarks: tuple[str, ...] = field(default=())

    @property
    def text(self) -> str:
        """The whole program in structured text."""
        head = "".join(f"(* {remark} *)\n" for remark in self.remarks)
        texts = [*(structure.text for structure in self.structures), *(unit.text for unit in self.units)]
        return "\n".join((head, *texts))


def indented(text: str) -> str:
    """Lines moved to the right by a level; empty lines stay empty."""
    return "\n".join(f"{INDENT}{line}" if line else line for line in text.splitlines())
