"""An interpreter of IEC 61131-3 structured text, for tests of generated control programs.

It knows what such programs need: FUNCTION, FUNCTION_BLOCK and PROGRAM with their variable sections, named arrays of one
dimension, structures, IF, CASE, FOR, WHILE, RETURN and EXIT, calls with named inputs and outputs. Integers overflow as
an error, an index outside its array and a variable read before the program declares it are errors: a test fails where a
controller would misbehave. `Machine.steps` cuts the power off before any statement or member of a structure.
"""

import contextlib
import math
import operator
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, TypeAlias

RANGES = {
    "SINT": (-(2**7), 2**7 - 1), "INT": (-(2**15), 2**15 - 1), "DINT": (-(2**31), 2**31 - 1),
    "USINT": (0, 2**8 - 1), "DWORD": (0, 2**32 - 1), "UINT": (0, 2**16 - 1), "UDINT": (0, 2**32 - 1), "BYTE": (0, 255),
    "LINT": (-(2**63), 2**63 - 1),
}  # fmt: skip
REALS = {"REAL", "LREAL"}
SECTIONS = {"VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_TEMP"}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "ABS": abs, "MIN": min, "MAX": max, "LIMIT": lambda low, value, high: min(max(value, low), high),
    "TRUNC": math.trunc, "SEL": lambda choice, no, yes: yes if choice else no, "SQRT": math.sqrt,
    **{f"{one}_TO_{other}": int for one in RANGES for other in RANGES},
    **{f"{one}_TO_{other}": float for one in RANGES for other in REALS},
    **{f"{one}_TO_DWORD": lambda value: value & 0xFFFF_FFFF for one in RANGES},
    "REAL_TO_LREAL": float, "LREAL_TO_REAL": float,
}  # fmt: skip

TOKENS = re.compile(
    r"\s+|\(\*.*?\*\)|//[^\n]*|(?P<address>%[IQ][XBWD]?\d+(?:\.\d+)?)|(?P<time>T#\d+ms)"
    r"|(?P<number>(?:DWORD#)?16#[0-9A-F]+|\d+\.\d+(?:[eE][+-]?\d+)?|\d+(?!\.\d))|(?P<word>[A-Za-z_]\w*)"
    r"|(?P<sign>:=|=>|<>|<=|>=|\.\.|[-+*/<>=()\[\],;:.&])|(?P<bad>.)",
    re.DOTALL,
)


class StructuredTextError(Exception):
    """A fault of the text, or of its execution."""


class PowerCut(Exception):
    """The power was cut off in the middle of a scan."""


@dataclass
class Declared:
    """A variable: its section, name, type, and initial value as an expression."""

    section: str
    name: str
    kind: "Kind"
    initial: Any = None


@dataclass(frozen=True)
class Kind:
    """A type: its name; of an array the bounds and the type of its elements."""

    name: str
    bounds: tuple[int, int] | None = None
    element: "Kind | None" = None


@dataclass
class Unit:
    """A program organisation unit."""

    kind: str
    name: str
    returns: Kind | None = None
    variables: list[Declared] = field(default_factory=list)
    body: list[Any] = field(default_factory=list)


@dataclass
class Fixed:
    """An array with bounds, each element of one type."""

    kind: Kind
    values: list[Any]

    def index(self, at: int) -> int:
        assert self.kind.bounds is not None
        low, high = self.kind.bounds
        if not low <= at <= high:
            raise StructuredTextError(f"index {at} outside {low}..{high}")
        return at - low


@dataclass
class Instance:
    """An instance of a function block, program or structure: its variables."""

    unit: Unit
    values: dict[str, Any]
    kinds: dict[str, Kind]


Evaluator: TypeAlias = Callable[[Instance], Any]
"""The value of an expression for the variables of an instance."""


class Parser:
    """A recursive-descent parser of a whole text."""

    def __init__(self, text: str) -> None:
        self.tokens = list(self._split(text))
        self.at = 0
        self.units: dict[str, Unit] = {}
        self.structures: dict[str, Unit] = {}
        self.arrays: dict[str, Kind] = {}
        self.tasks: dict[str, str] = {}

    @staticmethod
    def _split(text: str) -> Iterator[tuple[str, str]]:
        for match in TOKENS.finditer(text):
            kind = match.lastgroup
            if kind == "bad":
                raise StructuredTextError(f"unknown character {match.group()!r} at {match.start()}")
            if kind is not None:
                value = match.group()
                yield kind, value.upper() if kind == "word" else value
        yield "end", ""

    @property
    def ahead(self) -> str:
        return self.tokens[self.at][1]

    def take(self, *expected: str) -> str:
        value = self.ahead
        if expected and value not in expected:
            near = " ".join(token for _, token in self.tokens[max(0, self.at - 8) : self.at + 4])
            raise StructuredTextError(f"{value!r} where {' or '.join(expected)} is expected, near {near!r}")
        self.at += 1
        return value

    def accept(self, value: str) -> bool:
        if self.ahead != value:
            return False
        self.at += 1
        return True

    def parse(self) -> "Parser":
        while self.tokens[self.at][0] != "end":
            if self.ahead == "TYPE":
                self._type()
            elif self.ahead == "CONFIGURATION":
                self._configuration()
            else:
                self._unit()
        return self

    def _type(self) -> None:
        self.take("TYPE")
        name = self.take()
        self.take(":")
        if not self.accept("STRUCT"):
            self.arrays[name] = self._kind()
            self.take(";")
            self.take("END_TYPE")
            return
        made = Unit("STRUCT", name)
        while not self.accept("END_STRUCT"):
            made.variables += self._declaration("VAR")
        self.take(";")
        self.take("END_TYPE")
        self.structures[name] = made

    def _configuration(self) -> None:
        """A configuration of one resource, task and program instance: the task's interval by the program's name."""
        for word in ("CONFIGURATION", "", "RESOURCE", "", "ON", "", "TASK", "", "(", "INTERVAL", ":="):
            self.take(*filter(None, (word,)))
        interval = self.take()
        for word in (",", "PRIORITY", ":=", "", ")", ";", "PROGRAM", "", "WITH", "", ":"):
            self.take(*filter(None, (word,)))
        self.tasks[self.take()] = interval
        for word in (";", "END_RESOURCE", "END_CONFIGURATION"):
            self.take(word)

    def _unit(self) -> None:
        kind = self.take("FUNCTION", "FUNCTION_BLOCK", "PROGRAM")
        made = Unit(kind, self.take())
        if kind == "FUNCTION":
            self.take(":")
            made.returns = self._kind()
        while self.ahead in SECTIONS:
            section = self.take()
            while self.ahead in {"RETAIN", "CONSTANT"}:
                section = f"{section} {self.take()}"
            while not self.accept("END_VAR"):
                made.variables += self._declaration(section)
        made.body = self._statements(f"END_{kind}")
        self.take(f"END_{kind}")
        self.units[made.name] = made

    def _declaration(self, section: str) -> list[Declared]:
        names = [self.take()]
        while self.accept(","):
            names.append(self.take())
        if self.accept("AT"):
            self.at += 1
        self.take(":")
        kind = self._kind()
        initial = self._initial() if self.accept(":=") else None
        self.take(";")
        return [Declared(section, name, kind, initial) for name in names]

    def _kind(self) -> Kind:
        if not self.accept("ARRAY"):
            name = self.take()
            return self.arrays.get(name) or Kind(name)
        self.take("[")
        low = int(self.take())
        self.take("..")
        high = int(self.take())
        self.take("]")
        self.take("OF")
        return Kind("ARRAY", (low, high), self._kind())

    def _initial(self) -> Any:
        if not self.accept("["):
            return self._expression()
        values = []
        while not self.accept("]"):
            first = self._expression()
            if self.accept("("):
                values += [self._expression()] * first[1]
                self.take(")")
            else:
                values.append(first)
            self.accept(",")
        return "list", values

    def _statements(self, *ends: str) -> list[Any]:
        found = []
        while self.ahead not in ends and not self._label():
            if not self.accept(";"):
                found.append(self._statement())
        return found

    def _label(self) -> bool:
        """Whether a label of CASE follows: numbers up to a colon."""
        at = self.at
        while self.tokens[at][0] == "number" or self.tokens[at][1] in {",", "..", "-"}:
            at += 1
        return at > self.at and self.tokens[at][1] == ":"

    def _statement(self) -> Any:  # noqa: PLR0911
        word = self.ahead
        if word == "IF":
            return self._if()
        if word == "CASE":
            return self._case()
        if word == "FOR":
            return self._for()
        if word == "WHILE":
            self.take()
            condition = self._expression()
            self.take("DO")
            body = self._statements("END_WHILE")
            self.take("END_WHILE")
            return "while", condition, body
        if word in {"RETURN", "EXIT"}:
            return (self.take().lower(),)
        target = self._primary()
        if target[0] == "call":
            return target
        self.take(":=")
        return "assign", target, self._expression()

    def _if(self) -> Any:
        self.take("IF")
        branches = []
        condition = self._expression()
        self.take("THEN")
        branches.append((condition, self._statements("ELSIF", "ELSE", "END_IF")))
        while self.accept("ELSIF"):
            condition = self._expression()
            self.take("THEN")
            branches.append((condition, self._statements("ELSIF", "ELSE", "END_IF")))
        other = self._statements("END_IF") if self.accept("ELSE") else []
        self.take("END_IF")
        return "if", branches, other

    def _case(self) -> Any:
        self.take("CASE")
        chosen = self._expression()
        self.take("OF")
        branches = []
        while self.ahead not in {"ELSE", "END_CASE"}:
            labels = []
            while True:
                low = int(self.take())
                labels.append((low, int(self.take()) if self.accept("..") else low))
                if self.accept(":"):
                    break
                self.take(",")
            branches.append((labels, self._statements("ELSE", "END_CASE")))
        other = self._statements("END_CASE") if self.accept("ELSE") else []
        self.take("END_CASE")
        return "case", chosen, branches, other

    def _for(self) -> Any:
        self.take("FOR")
        name = self.take()
        self.take(":=")
        first = self._expression()
        self.take("TO")
        last = self._expression()
        step = self._expression() if self.accept("BY") else ("value", 1)
        self.take("DO")
        body = self._statements("END_FOR")
        self.take("END_FOR")
        return "for", name, first, last, step, body

    LEVELS = (("OR",), ("XOR",), ("AND", "&"), ("=", "<>"), ("<", ">", "<=", ">="), ("+", "-"), ("*", "/", "MOD"))

    def _expression(self, level: int = 0) -> Any:
        if level == len(self.LEVELS):
            return self._unary()
        left = self._expression(level + 1)
        while self.ahead in self.LEVELS[level]:
            sign = self.take()
            left = "binary", sign, left, self._expression(level + 1)
        return left

    def _unary(self) -> Any:
        if self.ahead in {"NOT", "-"}:
            return "unary", self.take(), self._unary()
        return self._primary()

    def _primary(self) -> Any:
        kind, value = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            if "#" in value:
                return "value", int(value.rpartition("#")[2], 16)
            return "value", float(value) if "." in value else int(value)
        if value in {"TRUE", "FALSE"}:
            return "value", value == "TRUE"
        if value == "(":
            inner = self._expression()
            self.take(")")
            return inner
        if kind != "word":
            raise StructuredTextError(f"{value!r} where an expression is expected")
        found: Any = ("name", value)
        while self.ahead in {".", "[", "("}:
            if self.accept("."):
                found = "member", found, self.take()
            elif self.accept("["):
                found = "element", found, self._expression()
                self.take("]")
            else:
                found = "call", found, self._arguments()
        return found

    def _arguments(self) -> list[tuple[str, str, Any]]:
        self.take("(")
        found = []
        while not self.accept(")"):
            if self.tokens[self.at + 1][1] in {":=", "=>"}:
                name = self.take()
                found.append((name, self.take(), self._expression()))
            else:
                found.append(("", "", self._expression()))
            self.accept(",")
        return found


def _logical(sign: str, operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    def applied(one: Any, other: Any) -> Any:
        if type(one) is not type(other) or not isinstance(one, int):
            raise StructuredTextError(f"{sign} of {one!r} and {other!r}")
        return operation(one, other)

    return applied


def _quotient(one: Any, other: Any) -> Any:
    if other == 0:
        raise StructuredTextError("division by zero")
    return int(one / other) if isinstance(one, int) and isinstance(other, int) else one / other


def _remainder(one: Any, other: Any) -> Any:
    quotient = _quotient(one, other)
    return one - quotient * other if isinstance(quotient, int) else quotient


OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "AND": _logical("AND", operator.and_), "&": _logical("&", operator.and_), "OR": _logical("OR", operator.or_),
    "XOR": _logical("XOR", operator.xor), "=": operator.eq, "<>": operator.ne, "<": operator.lt, ">": operator.gt,
    "<=": operator.le, ">=": operator.ge, "+": operator.add, "-": operator.sub, "*": operator.mul,
    "/": _quotient, "MOD": _remainder,
}  # fmt: skip


class _Return(Exception):
    pass


class _Exit(Exception):
    pass


class Machine:
    """Executes the units of a text. `instance(name)` makes one; `run(instance, inputs)` is a scan of it."""

    def __init__(self, text: str) -> None:
        parsed = Parser(text).parse()
        self.units, self.structures, self.tasks = parsed.units, parsed.structures, parsed.tasks
        self.steps = -1
        self._evaluators: dict[int, tuple[Evaluator, Any]] = {}
        self._bodies: dict[int, tuple[list[tuple[Callable[..., None], Any]], Any]] = {}

    def instance(self, name: str) -> Instance:
        unit = self.units.get(name.upper()) or self.structures[name.upper()]
        made = Instance(unit, {}, {one.name: one.kind for one in unit.variables})
        for one in unit.variables:
            made.values[one.name] = self._new(one.kind)
            if one.initial is not None:
                self._store(made, ("name", one.name), self._initial(made, one.initial))
        return made

    def run(self, instance: Instance, **inputs: Any) -> None:
        """One scan with inputs by name; other inputs keep their values."""
        for name, value in inputs.items():
            if name.upper() not in instance.values:
                raise StructuredTextError(f"{instance.unit.name} has no variable {name}")
            self._store(instance, ("name", name.upper()), value)
        with contextlib.suppress(_Return):
            self._execute(instance, instance.unit.body)

    def read(self, instance: Instance, path: str) -> Any:
        """The value of a variable: `name`, `name.member`."""
        value: Any = instance
        for part in path.upper().split("."):
            value = value.values[part]
        return list(value.values) if isinstance(value, Fixed) else value

    def write(self, instance: Instance, path: str, value: Any) -> None:
        """Set a variable, or all elements of an array."""
        *parts, last = path.upper().split(".")
        for part in parts:
            instance = instance.values[part]
        self._store(instance, ("name", last), value)

    def call(self, name: str, *arguments: Any) -> Any:
        """The value of a function for arguments in the order of its inputs."""
        unit = self.units[name.upper()]
        made = self.instance(name)
        inputs = [one.name for one in unit.variables if one.section == "VAR_INPUT"]
        assert unit.returns is not None
        made.values[unit.name], made.kinds[unit.name] = self._new(unit.returns), unit.returns
        self.run(made, **dict(zip(inputs, arguments, strict=True)))
        return made.values[unit.name]

    def _new(self, kind: Kind) -> Any:
        if kind.bounds is not None:
            assert kind.element is not None
            return Fixed(kind, [self._new(kind.element) for _ in range(kind.bounds[1] - kind.bounds[0] + 1)])
        if kind.name in RANGES:
            return 0
        if kind.name in REALS:
            return 0.0
        if kind.name == "BOOL":
            return False
        return self.instance(kind.name)

    def _initial(self, instance: Instance, given: Any) -> Any:
        if given[0] == "list":
            return [self._value(instance, one) for one in given[1]]
        return self._value(instance, given)

    @staticmethod
    def _checked(kind: Kind, value: Any) -> Any:
        if kind.name in RANGES:
            if isinstance(value, bool) or not isinstance(value, int):
                raise StructuredTextError(f"{value!r} assigned to {kind.name}")
            low, high = RANGES[kind.name]
            if not low <= value <= high:
                raise StructuredTextError(f"{value} overflows {kind.name}")
            return value
        if kind.name in REALS:
            if isinstance(value, bool) or not isinstance(value, int | float):
                raise StructuredTextError(f"{value!r} assigned to {kind.name}")
            return float(value)
        if kind.name == "BOOL" and not isinstance(value, bool):
            raise StructuredTextError(f"{value!r} assigned to BOOL")
        return value

    def _store(self, instance: Instance, target: Any, value: Any) -> None:
        if target[0] == "name":
            name = target[1]
            if name not in instance.kinds:
                raise StructuredTextError(f"{instance.unit.name}: {name} is not declared")
            kind = instance.kinds[name]
            if kind.bounds is not None:
                given = value.values if isinstance(value, Fixed) else list(value)
                made = instance.values[name]
                if len(given) != len(made.values):
                    raise StructuredTextError(f"{name} has {len(made.values)} elements, not {len(given)}")
                assert kind.element is not None
                made.values[:] = [self._checked(kind.element, one) for one in given]
                return
            if isinstance(value, Instance):
                if value.unit.name != kind.name:
                    raise StructuredTextError(f"{value.unit.name} assigned to {kind.name}")
                made = instance.values[name]
                for member in list(value.values):
                    self._step()
                    self._store(made, ("name", member), value.values[member])
                return
            instance.values[name] = self._checked(kind, value)
            return
        inner = self._value(instance, target[1])
        if target[0] == "member":
            self._store(inner, ("name", target[2]), value)
            return
        assert inner.kind.element is not None
        inner.values[inner.index(self._value(instance, target[2]))] = self._checked(inner.kind.element, value)

    def _execute(self, instance: Instance, body: list[Any]) -> None:
        known = self._bodies.get(id(body))
        if known is None:
            known = self._bodies[id(body)] = [(getattr(self, f"_do_{one[0]}"), one[1:]) for one in body], body
        for statement, arguments in known[0]:
            if self.steps == 0:
                raise PowerCut
            self.steps -= 1
            statement(instance, *arguments)

    def _step(self) -> None:
        """The power is cut off when `steps` have been executed; -1: never."""
        if self.steps == 0:
            raise PowerCut
        self.steps -= 1

    def _do_assign(self, instance: Instance, target: Any, value: Any) -> None:
        self._store(instance, target, self._value(instance, value))

    def _do_call(self, instance: Instance, target: Any, arguments: Any) -> None:
        self._called(instance, target, arguments)

    def _do_if(self, instance: Instance, branches: Any, other: Any) -> None:
        for condition, body in branches:
            if self._truth(instance, condition):
                self._execute(instance, body)
                return
        self._execute(instance, other)

    def _do_case(self, instance: Instance, chosen: Any, branches: Any, other: Any) -> None:
        value = self._value(instance, chosen)
        for labels, body in branches:
            for low, high in labels:
                if low <= value <= high:
                    self._execute(instance, body)
                    return
        self._execute(instance, other)

    def _do_for(self, instance: Instance, name: str, first: Any, last: Any, step: Any, body: Any) -> None:  # noqa: PLR0917
        begin, end, by = (self._value(instance, one) for one in (first, last, step))
        for value in range(begin, end + (1 if by > 0 else -1), by):
            self._store(instance, ("name", name), value)
            try:
                self._execute(instance, body)
            except _Exit:
                return

    def _do_while(self, instance: Instance, condition: Any, body: Any) -> None:
        for _ in range(100_000):
            if not self._truth(instance, condition):
                return
            try:
                self._execute(instance, body)
            except _Exit:
                return
        raise StructuredTextError("WHILE does not end: the watchdog of a controller would stop it")

    def _do_return(self, _instance: Instance) -> None:
        raise _Return

    def _do_exit(self, _instance: Instance) -> None:
        raise _Exit

    def _truth(self, instance: Instance, expression: Any) -> bool:
        value = self._value(instance, expression)
        if not isinstance(value, bool):
            raise StructuredTextError(f"{value!r} as a condition")
        return value

    def _value(self, instance: Instance, expression: Any) -> Any:
        return self._evaluator(expression)(instance)

    def _evaluator(self, expression: Any) -> Evaluator:
        """An expression as a function of the instance, made once: a scan evaluates thousands of them."""
        known = self._evaluators.get(id(expression))
        if known is None:
            known = self._evaluators[id(expression)] = (
                getattr(self, f"_of_{expression[0]}")(*expression[1:]),
                expression,
            )
        return known[0]

    @staticmethod
    def _of_value(value: Any) -> Evaluator:
        return lambda _: value

    @staticmethod
    def _of_name(name: str) -> Evaluator:
        def found(instance: Instance) -> Any:
            if name not in instance.values:
                raise StructuredTextError(f"{instance.unit.name}: {name} is not declared")
            return instance.values[name]

        return found

    def _of_member(self, outer: Any, name: str) -> Evaluator:
        of = self._evaluator(outer)

        def found(instance: Instance) -> Any:
            inner = of(instance)
            if name not in inner.values:
                raise StructuredTextError(f"{inner.unit.name} has no {name}")
            return inner.values[name]

        return found

    def _of_element(self, array: Any, at: Any) -> Evaluator:
        of, index = self._evaluator(array), self._evaluator(at)

        def found(instance: Instance) -> Any:
            inner = of(instance)
            return inner.values[inner.index(index(instance))]

        return found

    def _of_call(self, target: Any, arguments: Any) -> Evaluator:
        return lambda instance: self._called(instance, target, arguments)

    def _of_unary(self, sign: str, expression: Any) -> Evaluator:
        of = self._evaluator(expression)
        return (lambda instance: not of(instance)) if sign == "NOT" else (lambda instance: -of(instance))

    def _of_binary(self, sign: str, left: Any, right: Any) -> Evaluator:
        one, other, operation = self._evaluator(left), self._evaluator(right), OPERATIONS[sign]
        return lambda instance: operation(one(instance), other(instance))

    def _called(self, instance: Instance, target: Any, arguments: Any) -> Any:
        if target[0] == "name" and target[1] not in instance.values:
            values = [self._value(instance, one) for _, _, one in arguments]
            if target[1] in FUNCTIONS:
                return FUNCTIONS[target[1]](*values)
            unit = self.units.get(target[1])
            if unit is None:
                raise StructuredTextError(f"{target[1]} is not known")
            inputs = [one.name for one in unit.variables if one.section == "VAR_INPUT"]
            by_name = {name: value for (name, _, _), value in zip(arguments, values, strict=True) if name}
            return self.call(unit.name, *([by_name[name] for name in inputs] if by_name else values))
        block = self._value(instance, target)
        inputs_given = {name: self._value(instance, one) for name, sign, one in arguments if sign == ":="}
        shared = {one.name for one in block.unit.variables if one.section == "VAR_IN_OUT"}
        block.values.update({name: inputs_given.pop(name) for name in shared})  # not copied
        self.run(block, **inputs_given)
        for name, sign, one in arguments:
            if sign == "=>":
                self._store(instance, one, block.values[name])
        return None
