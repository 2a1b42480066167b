"""Frozen records, and the results that they declare.

    @record
    class Shaft:
        motion: Motion
        slope: float = result("rad", "slope at the supports", name="shaft_slope")

        @computed("mm", "deflection between the supports", name="shaft_deflection")
        def deflection(self) -> float: ...

    @record
    class Shedding:
        mass: float = result("kg", "mass of all cams")
        shaft: Shaft = group()

A record may hold arrays and mappings: two are equal only where they are the same object, every one can be hashed, and
its representation is a short line. Records of plain values that are compared by value are frozen dataclasses, or
`value_record` where they hold further records and would print long.

Report, JSON, its reference and the columns of studies are made from the declared results: `layout` finds them on a
class, `declared_results` lists them without a record.
"""

import types
import typing
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cache
from typing import Any, Generic, TypeAlias, TypedDict, TypeVar, Unpack, dataclass_transform, overload

from ilmek.sentences import Sentence, translated

T = TypeVar("T")

JsonObject: TypeAlias = dict[str, Any]
"""An object of JSON, as results become: its writer knows the kind of each value, no type of Python says it."""


@dataclass(frozen=True, slots=True)
class DeclaredResult:
    """The declaration of a result.

    name      stable, as in JSON           unit   in which it is shown; the value is SI
    meaning   a phrase                     shown  False: for JSON alone, where a table shows it better to a reader
    optional  it is left out where its value is None
    absent    when its value is None and reported as null; "": never
    least     bound that no value of any design is below [SI]; None: by the unit, see `report.results.least_of_unit`
    """

    name: str
    unit: str
    meaning: str
    shown: bool = True
    optional: bool = False
    absent: str = ""
    least: float | None = None


class Stated(TypedDict, total=False):
    """What a declaration may state of a result beside its unit and its meaning, as in `DeclaredResult`."""

    name: str
    shown: bool
    optional: bool
    absent: str
    least: float | None


def result(unit: str, doc: str, *, default: Any = ..., **more: Unpack[Stated]) -> Any:
    """Declare a field of a record as a result.

    unit   in which it is shown, "" for texts and groups of values     doc       meaning, a phrase
    name   in JSON, where it is not the field's                        shown     False: in JSON only
    optional  left out where the value is None                         default   of the field, if any
    absent    when the value is None and reported as null, a phrase    least     bound of every value [SI], -inf: none
    """
    given = {} if default is ... else {"default": default}
    return field(metadata={"result": _declared(unit, doc, more)}, **given)


def _declared(unit: str, doc: str, more: Stated) -> DeclaredResult:
    meaning = f"{doc}; null: {more['absent']}" if more.get("absent") else doc
    return replace(DeclaredResult("", unit, meaning), **more)


def group(prefix: str = "") -> Any:
    """Declare a field that holds a record with results of its own, reported with `prefix` before their names.

    Where the field is None its results are left out.
    """
    return field(metadata={"group": prefix})


_LONGEST = 60
"""Characters of a field's value in a representation."""

_LONGEST_LINE = 280
"""Characters of a representation after which further fields are left out."""


@dataclass_transform(eq_default=False, frozen_default=True, field_specifiers=(result, group, field))
def record(cls: type[T]) -> type[T]:
    """The class as a frozen, slotted dataclass with equality by identity and a short representation.

    >>> import numpy as np
    >>> @record
    ... class Curve:
    ...     name: str
    ...     values: np.ndarray
    >>> one, other = Curve("s", np.zeros(500)), Curve("s", np.zeros(500))
    >>> one, one == other, len({one, other})
    (Curve(name='s', values=float64[500]), False, 2)
    """
    made = dataclass(frozen=True, slots=True, eq=False, repr=False)(cls)
    if "__repr__" not in vars(cls):
        made.__repr__ = brief  # type: ignore[method-assign]
    return made


@dataclass_transform(frozen_default=True, field_specifiers=(result, group, field))
def value_record(cls: type[T]) -> type[T]:
    """The class as a frozen, slotted dataclass with equality by value and a short representation."""
    made = dataclass(frozen=True, slots=True, repr=False)(cls)
    if "__repr__" not in vars(cls):
        made.__repr__ = brief  # type: ignore[method-assign]
    return made


def with_fields(value: T, **changes: Any) -> T:
    """A record with other fields, unchecked: they may be arrays in place of numbers."""
    made = object.__new__(type(value))
    for one in fields(value):  # type: ignore[arg-type]
        object.__setattr__(made, one.name, changes.get(one.name, getattr(value, one.name)))
    return made


def brief(value: Any, names: Iterable[str] | None = None) -> str:
    """A record in one line: plain values as they are, arrays by type and shape, records and collections by size.

    names  of the fields that are shown; default: all. Those beyond _LONGEST_LINE characters are left out.
    """
    head, shown = f"{type(value).__name__}(", ""
    for name in (one.name for one in fields(value)) if names is None else names:
        item = f"{', ' if shown else ''}{name}={shown_value(getattr(value, name))}"
        if len(head) + len(shown) + len(item) > _LONGEST_LINE:
            return f"{head}{shown}, ...)"
        shown += item
    return f"{head}{shown})"


def shown_value(value: Any) -> str:
    """A value in a few characters: plain values as they are, arrays by type and shape, collections by size.

    >>> shown_value("text"), shown_value([1, 2]), shown_value(object())
    ("'text'", 'list[2]', 'object')
    """
    if hasattr(value, "dtype") and hasattr(value, "shape"):  # an array; numpy is not imported for a record
        if value.shape == ():
            return shown_value(value.item())
        return f"{value.dtype}[{'x'.join(str(size) for size in value.shape)}]"
    if value is None or isinstance(value, bool | int | float | complex | str):
        text = repr(value)
        return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
    if isinstance(value, tuple | list | dict):
        return f"{type(value).__name__}[{len(value)}]"
    return type(value).__name__


class Computed(Generic[T]):
    """A property of a record that is a result; its meaning is its documentation."""

    def __init__(self, function: Callable[[Any], T], declaration: DeclaredResult) -> None:
        self.function = function
        self.declaration = declaration
        self.__doc__ = f"{declaration.meaning} [{declaration.unit}]" if declaration.unit else declaration.meaning

    def __set_name__(self, owner: type, name: str) -> None:
        """The result has the attribute's name where it is given no other."""
        if not self.declaration.name:
            self.declaration = replace(self.declaration, name=name)

    @overload
    def __get__(self, instance: None, owner: type) -> "Computed[T]": ...
    @overload
    def __get__(self, instance: object, owner: type) -> T: ...
    def __get__(self, instance: object | None, owner: type) -> "Computed[T] | T":
        """The value for a record, the declaration for its class."""
        return self if instance is None else self.function(instance)


@overload
def computed(unit: str, doc: str, function: Callable[[Any], T], **more: Unpack[Stated]) -> Computed[T]: ...
@overload
def computed(unit: str, doc: str, **more: Unpack[Stated]) -> Callable[[Callable[[Any], T]], Computed[T]]: ...
def computed(unit: str, doc: str, function: Callable[[Any], Any] | None = None, **more: Unpack[Stated]) -> Any:
    """Declare a result that is computed from its record when it is read; other arguments as of `result`.

    On one line with a function of the record, or as the decorator of a method without arguments:

        crank = computed("1", "crank over ground", lambda design: design.links.crank)

        @computed("mm", "chord of the beater's path")
        def stroke(self) -> float: ...
    """
    declaration = _declared(unit, doc, more)
    return Computed(function, declaration) if function else lambda method: Computed(method, declaration)


class ComputedGroup(Generic[T]):
    """A property that is a record with results of its own, made only where one of them is asked for."""

    def __init__(self, function: Callable[[Any], T]) -> None:
        self.function, self.__doc__ = function, function.__doc__

    @overload
    def __get__(self, instance: None, owner: type) -> "ComputedGroup[T]": ...
    @overload
    def __get__(self, instance: object, owner: type) -> T: ...
    def __get__(self, instance: object | None, owner: type) -> "ComputedGroup[T] | T":
        """The group of a record, the declaration of its class."""
        return self if instance is None else self.function(instance)


def declared_results(*classes: type) -> tuple[DeclaredResult, ...]:
    """The results declared by classes of records, in order, those of their groups included."""
    return tuple(declaration for cls in classes for declaration in _declarations(cls, ""))


def _declarations(cls: type, prefix: str) -> Iterator[DeclaredResult]:
    for attribute, declaration, inner in layout(cls):
        if declaration is not None:
            yield replace(declaration, name=prefix + declaration.name)
        else:
            for kind in _kinds(cls, attribute):
                yield from _declarations(kind, prefix + (inner or ""))


def _kinds(cls: type, attribute: str) -> Iterator[type]:
    """The classes of records that a group may be."""
    made = vars(cls)[attribute]
    hints = typing.get_type_hints(made.function if isinstance(made, ComputedGroup) else cls)
    hint = hints["return" if isinstance(made, ComputedGroup) else attribute]
    for kind in [kind for kind in typing.get_args(hint) if kind is not types.NoneType] or [hint]:
        if is_dataclass(kind) and isinstance(kind, type):
            yield kind


@cache
def group_names(cls: type, attribute: str) -> frozenset[str]:
    """Names of the results of a group, without its prefix."""
    return frozenset(one.name for one in declared_results(*_kinds(cls, attribute)))


@cache
def layout(cls: Any) -> tuple[tuple[str, DeclaredResult | None, str | None], ...]:
    """Attributes that are results (with their declaration) or groups (with their prefix), in order of declaration."""
    found: list[tuple[str, DeclaredResult | None, str | None]] = []
    if is_dataclass(cls):
        for one in fields(cls):
            if "result" in one.metadata:
                declaration = one.metadata["result"]
                found.append((one.name, replace(declaration, name=declaration.name or one.name), None))
            elif "group" in one.metadata:
                found.append((one.name, None, one.metadata["group"]))
    for base in reversed(cls.__mro__):
        for name, one in vars(base).items():
            if isinstance(one, Computed):
                found.append((name, one.declaration, None))
            elif isinstance(one, ComputedGroup):
                found.append((name, None, ""))
    return tuple(found)


def alike(kind: Callable[..., T], source: object, /, **more: object) -> T:
    """A record of a class, with what a source has under the names of its fields, but for the fields that are given."""
    names = (field.name for field in fields(kind) if field.name not in more and hasattr(source, field.name))  # type: ignore[arg-type]
    return kind(**{name: getattr(source, name) for name in names}, **more)


def json_value(value: Any) -> object:
    """What an encoder of JSON is told of a value that it does not know.

    A sentence is its text in the language that is spoken, an array its list, a complex number x and y; an array of them
    x, y, x, y, … Raises TypeError for anything else.

    >>> json_value(1 + 2j), json_value(Sentence("sheet.mass"))
    ((1.0, 2.0), 'Mass')
    """
    if isinstance(value, Sentence):
        return translated(value)
    if isinstance(value, complex):
        return value.real, value.imag
    if hasattr(value, "tolist"):  # an array or a number of numpy, which is not imported for a record
        return (value.copy().view(value.real.dtype) if value.dtype.kind == "c" and value.ndim else value).tolist()
    raise TypeError(f"{type(value).__name__} in JSON")
