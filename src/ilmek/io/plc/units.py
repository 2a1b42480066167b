"""Program organisation units of IEC 61131-3 as plain data, and their structured text.

Names are in capitals and small letters, at most 31 characters; variables have one of the elementary types, an array of
one dimension or a structure. The text keeps to what all compilers agree about: an array type has a name, a label of
CASE stands alone, a FOR has two passes or more, arguments have names, and there is no RETURN.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field

INDENT = "    "


@dataclass(frozen=True, slots=True)
class PlcArray:
    """An array of one dimension from index 0: its size, and the type of its elements."""

    size: int
    element: str

    @property
    def name(self) -> str:
        """Name of the type: arrays of one name can be assigned to each other."""
        return f"Array{self.size}Of{self.element.capitalize()}"

    @property
    def definition(self) -> str:
        """The type in structured text."""
        return f"ARRAY[0..{self.size - 1}] OF {self.element}"

    @property
    def text(self) -> str:
        """The declaration of the type in structured text."""
        return f"TYPE {self.name} : {self.definition}; END_TYPE\n"

    def __str__(self) -> str:
        """How a variable names its type."""
        return self.name


PlcType = str | PlcArray


@dataclass(frozen=True, slots=True)
class PlcVariable:
    """A variable: its type, what it means, its initial value as written, or a list for an array, and its address."""

    name: str
    kind: PlcType
    meaning: str = ""
    initial: str | tuple[str, ...] = ""
    address: str = ""

    @property
    def text(self) -> str:
        """The declaration in structured text."""
        location = f" AT {self.address}" if self.address else ""
        given = f" := {initial_text(self.initial)}" if self.initial else ""
        remark = f" (* {self.meaning} *)" if self.meaning else ""
        return f"{self.name}{location} : {self.kind}{given};{remark}"

    @property
    def elements(self) -> tuple[tuple[str, str], ...]:
        """Name and type of each element of an array, or of the variable itself."""
        if isinstance(self.kind, str):
            return ((self.name, self.kind),)
        return tuple((f"{self.name}[{index}]", self.kind.element) for index in range(self.kind.size))


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
    """Variables of one kind: VAR_INPUT, VAR_OUTPUT, VAR, VAR RETAIN."""

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
    def variables(self) -> tuple[PlcVariable, ...]:
        """The variables of all sections."""
        return tuple(variable for section in self.sections for variable in section.variables)

    def of_kind(self, kind: str) -> tuple[PlcVariable, ...]:
        """The variables of a kind of section."""
        return tuple(variable for section in self.sections if section.kind == kind for variable in section.variables)

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

    name  of the project      cycle  of the task that runs the last unit [s]
    """

    name: str
    structures: tuple[PlcStructure, ...]
    units: tuple[PlcUnit, ...]
    cycle: float
    remarks: tuple[str, ...] = field(default=())

    @property
    def arrays(self) -> tuple[PlcArray, ...]:
        """The array types of structures and units, each once."""
        owners: tuple[PlcStructure | PlcUnit, ...] = (*self.structures, *self.units)
        kinds = (variable.kind for owner in owners for variable in owner.variables)
        return tuple(dict.fromkeys(kind for kind in kinds if isinstance(kind, PlcArray)))

    @property
    def interval(self) -> str:
        """The cycle of the task as a duration of IEC 61131-3."""
        return f"T#{round(1000 * self.cycle)}ms"

    @property
    def text(self) -> str:
        """The whole program in structured text; a PROGRAM at its end gets a configuration with its task."""
        head = "".join(f"(* {remark} *)\n" for remark in self.remarks)
        declared: tuple[PlcArray | PlcStructure | PlcUnit, ...] = (*self.arrays, *self.structures, *self.units)
        texts = [declaration.text for declaration in declared]
        if self.units[-1].kind == "PROGRAM":
            texts.append(self._configuration)
        return "\n".join((head, *texts))

    @property
    def _configuration(self) -> str:
        name = self.units[-1].name
        return (
            f"CONFIGURATION Configuration0\n{INDENT}RESOURCE Controller ON PLC\n"
            f"{2 * INDENT}TASK Cycle(INTERVAL := {self.interval}, PRIORITY := 0);\n"
            f"{2 * INDENT}PROGRAM {name}Instance WITH Cycle : {name};\n{INDENT}END_RESOURCE\nEND_CONFIGURATION\n"
        )


def indented(text: str) -> str:
    """Lines moved to the right by a level; empty lines stay empty."""
    return "\n".join(f"{INDENT}{line}" if line else line for line in text.splitlines())


def loop(counter: str, count: int, body: str) -> str:
    """A body for each value of a counter from 0 on; without a loop where there is one pass."""
    if count == 1:
        return f"{counter} := 0;\n{body.rstrip()}"
    return f"FOR {counter} := 0 TO {count - 1} DO\n{indented(body)}\nEND_FOR;"


def cases(selector: str, branches: Iterable[tuple[int, str]], otherwise: str = "") -> str:
    """A CASE with one label for each branch."""
    lines = [f"CASE {selector} OF"]
    lines += [f"{INDENT}{label}:\n{indented(indented(body))}" for label, body in branches]
    if otherwise:
        lines.append(f"ELSE\n{indented(otherwise)}")
    return "\n".join((*lines, "END_CASE;"))
