"""Parameters of a machine: a frozen record whose fields are declared by kind, and may hold further `Params`.

    @dataclass(frozen=True, slots=True)
    class BeatUpParams(Params):
        swing: float = kind.angle(30 * deg, above=0.0, below=180 * deg, doc="swing of the rocker", symbol="psi")

`| None` with the default None makes a parameter optional. A parameter of a nested record is set by its dotted name.
"""

import difflib
import inspect
import types
import typing
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields, replace
from functools import cache
from types import MappingProxyType
from typing import Any, TypeVar

from ilmek.errors import ParameterError, restated
from ilmek.params.parameter import Parameter, Setting, Value
from ilmek.records import JsonObject, brief

P = TypeVar("P", bound="Params")

Namespaces: typing.TypeAlias = Callable[[], Mapping[str, type["Params"]]]


@dataclass(frozen=True, slots=True)
class Overrides:
    """Values set for the parameters of other machines, which replace the values derived for them.

    values  dotted name, `shedding.law`, to value [SI]
    """

    values: Mapping[str, Value] = field(default_factory=lambda: MappingProxyType({}))

    def __hash__(self) -> int:
        return hash(tuple(self.values.items()))

    def of(self, machine: str) -> dict[str, Value]:
        """The values set for one machine, by dotted name below it."""
        return {
            name.removeprefix(f"{machine}."): value
            for name, value in self.values.items()
            if name.startswith(f"{machine}.")
        }

    def over(self, machine: str, derived: P) -> P:
        """The derived parameters with the values set for that machine in place of theirs.

        Raises ParameterError where the values contradict each other.
        """
        with restated(ParameterError, f"{machine}: ", of=ParameterError):
            return derived.with_values(self.of(machine))


def overrides(namespaces: Namespaces, *, without: tuple[str, ...] = (), doc: str) -> Any:
    """Declare a field of `Overrides`.

    namespaces  called when needed, gives the Params of each machine by name
    without     nested records of the machines that are handed to all of them, so that none can have another
    """
    return field(default_factory=Overrides, metadata=dict(overrides=namespaces, without=without, doc=doc))


@dataclass(frozen=True, slots=True)
class Params:
    """Base of every machine's parameters: a frozen dataclass whose fields are declared by `ilmek.params`."""

    def __init_subclass__(cls) -> None:
        cls.__repr__ = Params.__repr__  # type: ignore[method-assign] # the decorator of a dataclass keeps it

    def __repr__(self) -> str:
        """Only the parameters that differ from their defaults."""
        return brief(self, (one.name for one in fields(self) if getattr(self, one.name) != _default(one)))

    def __post_init__(self) -> None:
        for parameter in declared(type(self)):
            value = getattr(self, parameter.name)
            if value is not parameter.default:
                parameter.check(value)
        self.check_together()

    def check_together(self) -> None:
        """Raise ParameterError where parameters contradict each other; nothing by default."""

    @classmethod
    def read(cls: type[P], settings: Mapping[str, Setting], *, prefix: str = "", default: P | None = None) -> P:
        """Parameters from settings by name, alias or dotted name; texts with units are allowed.

        prefix   of the names in messages, where these parameters are nested in others
        default  the record whose values hold for what is not set; without one the defaults of the class
        Raises ParameterError for an unknown name, and for a parameter set by its name and by its alias.
        """
        own, below = _sorted_settings(cls, settings, prefix)
        values: JsonObject = {}
        for parameter, setting in own:
            shown = replace(parameter, name=f"{prefix}{parameter.name}")
            values[parameter.name] = value = shown.read(setting)
            shown.check(value)
        for one in fields(cls):
            if "nested" in one.metadata and one.name in below:
                inner = _default(one) if default is None else getattr(default, one.name)
                values[one.name] = type(inner).read(below[one.name], prefix=f"{prefix}{one.name}.", default=inner)
            elif "overrides" in one.metadata and below:
                values[one.name] = Overrides(MappingProxyType(_read_overrides(cls, one, below)))
        return cls(**values) if default is None else replace(default, **values)

    def with_values(self: P, values: Mapping[str, Value]) -> P:
        """The same with other values [SI] by name or dotted name. Raises ParameterError as the record itself does."""
        own = {name: value for name, value in values.items() if "." not in name}
        groups: dict[str, dict[str, Value]] = {}
        for name, value in values.items():
            if "." in name:
                head, _, rest = name.partition(".")
                groups.setdefault(head, {})[rest] = value
        below = {head: getattr(self, head).with_values(rest) for head, rest in groups.items()}
        changes: JsonObject = {**own, **below}
        return replace(self, **changes) if changes else self

    def as_dict(self) -> dict[str, Value]:
        """Name to SI value in the order of `declared`, nested ones by dotted name; of overrides those that are set."""
        values: dict[str, Value] = {}
        known: Any = type(self)
        for one in _ordered(known):
            value = getattr(self, one.name)
            if isinstance(value, Params):
                values |= {f"{one.name}.{name}": item for name, item in value.as_dict().items()}
            elif isinstance(value, Overrides):
                values |= value.values
            else:
                values[one.name] = value
        return values


def _default(one: Field[Any]) -> Any:
    return one.default if one.default_factory is MISSING else one.default_factory()


def _sorted_settings(
    cls: type[Params], settings: Mapping[str, Setting], prefix: str
) -> tuple[list[tuple[Parameter, Setting]], dict[str, dict[str, Setting]]]:
    """Settings of the class's own parameters, and those with a dotted name by what stands before the first dot."""
    known = {parameter.name: parameter for parameter in declared(cls)}
    aliases = {parameter.alias.casefold(): name for name, parameter in known.items() if parameter.alias}
    groups = {
        name
        for one in fields(cls)
        for name in (
            (one.name,)
            if "nested" in one.metadata
            else one.metadata["overrides"]()
            if "overrides" in one.metadata and any("." in given for given in settings)
            else ()
        )
    }
    given_as: dict[str, str] = {}
    below: dict[str, dict[str, Setting]] = {}
    for given, setting in settings.items():
        head, dot, rest = given.partition(".")
        head = head if head in groups else head.replace("_", "-")
        if dot and head in groups:
            below.setdefault(head, {})[rest] = setting
            continue
        name = given if given in known else aliases.get(given.casefold(), "")
        if not name:
            raise _unknown(cls, f"{prefix}{given}", prefix)
        if name in given_as:
            raise ParameterError(f"{name} is set twice, as {given_as[name]} and as {given}", do="set it once")
        given_as[name] = given
    return [(known[name], settings[given]) for name, given in given_as.items()], below


def _handed_down(loom: type[Params], given: str) -> ParameterError:
    """For a parameter of a record that every machine has alike: the loom's own of that name is meant."""
    own = given.split(".", 2)[2]
    near = own if own in reachable(loom, machines=False) else ""
    return ParameterError(
        f"{given} is that of all machines of the loom", do=f"did you mean {near}?" if near else "set it for the loom"
    )


def _unknown(cls: type[Params], given: str, prefix: str) -> ParameterError:
    names = [f"{prefix}{name}" for name in reachable(cls)]
    names += [f"{prefix}{parameter.alias}".casefold() for parameter in declared(cls) if parameter.alias]
    last = given.rpartition(".")[2]
    near = difflib.get_close_matches(given, names, n=1) or [name for name in names if name.endswith(f".{last}")][:1]
    known = ", ".join(f"{prefix}{parameter.name}" for parameter in declared(cls))
    return ParameterError(f"unknown parameter {given!r}", do=f"did you mean {near[0]}?" if near else f"known: {known}")


def _read_overrides(
    loom: type[Params], declared_field: "Field[Any]", below: Mapping[str, Mapping[str, Setting]]
) -> dict[str, Value]:
    values: dict[str, Value] = {}
    without = declared_field.metadata["without"]
    for machine, cls in declared_field.metadata["overrides"]().items():
        known = reachable(cls)
        for given, setting in below.get(machine, {}).items():
            if given.partition(".")[0] in without:
                raise _handed_down(loom, f"{machine}.{given}")
            if given not in known:
                raise _unknown(cls, f"{machine}.{given}", f"{machine}.")
            parameter = replace(known[given], name=f"{machine}.{given}")
            values[parameter.name] = value = parameter.read(setting)
            parameter.check(value)
    return values


def declared(cls: type[Params]) -> tuple[Parameter, ...]:
    """The parameters of a class in order, its own before those that it inherits; not those of nested records."""
    known: Any = cls  # a checker takes a class of dataclasses for one of its objects, which cannot be hashed
    return _declared(known)


def reachable(cls: type[Params], *, machines: bool = True) -> dict[str, Parameter]:
    """Every parameter that can be set, by name or dotted name: own, nested, and of the machines that it overrides.

    machines  False: without those of the machines
    """
    return dict(_reachable(cls, machines, None))


def listed(cls: type[Params]) -> tuple[Parameter, ...]:
    """The parameters of a class and of the records nested in it, with dotted names."""
    return tuple(replace(one, name=name) for name, one in reachable(cls, machines=False).items())


def overridden(cls: type[Params]) -> tuple[str, ...]:
    """The machines whose parameters can be set by dotted names."""
    return tuple(name for one in fields(cls) if "overrides" in one.metadata for name in one.metadata["overrides"]())


def _reachable(cls: type[Params], machines: bool, default: Params | None) -> Iterator[tuple[str, Parameter]]:
    own = {parameter.name: parameter for parameter in declared(cls)}
    if default is not None:
        own = {name: replace(parameter, default=getattr(default, name)) for name, parameter in own.items()}
    ordered: Any = cls  # as in `declared`
    for one in _ordered(ordered):
        inner: Mapping[str, type[Params]] = {}
        values: Params | None = None
        without = one.metadata.get("without", ())
        if "nested" in one.metadata:
            inner = {one.name: one.metadata["nested"]}
            values = _default(one) if default is None else getattr(default, one.name)
        elif "overrides" in one.metadata:
            inner = one.metadata["overrides"]() if machines else {}
        else:
            yield one.name, own[one.name]
        for head, below in inner.items():
            yield from (
                (f"{head}.{name}", parameter)
                for name, parameter in _reachable(below, machines, values)
                if name.partition(".")[0] not in without
            )


@cache
def _declared(cls: Any) -> tuple[Parameter, ...]:
    """The same, looked up once: every set of parameters that is made needs them."""
    hints = typing.get_type_hints(cls)
    return tuple(_parameter(f, hints[f.name]) for f in _ordered(cls) if not {"nested", "overrides"} & set(f.metadata))


@cache
def _ordered(cls: Any) -> "tuple[Field[Any], ...]":
    """The fields of a class, its own before those that it inherits."""
    known = {one.name: one for one in fields(cls)}
    names = dict.fromkeys(name for base in cls.__mro__ for name in inspect.get_annotations(base))
    return tuple(known[name] for name in names if name in known)


def _parameter(declared_field: "Field[Any]", hint: Any) -> Parameter:
    kinds = [kind for kind in typing.get_args(hint) if kind is not types.NoneType] or [hint]
    if declared_field.default is MISSING or "doc" not in declared_field.metadata:
        raise TypeError(f"{declared_field.name} is not declared by a kind of ilmek.params")
    return Parameter(name=declared_field.name, kind=kinds[0], default=declared_field.default, **declared_field.metadata)
