"""What every four-bar that does a task may be required to have besides: the engine's `Filters` as parameters."""

from dataclasses import field
from typing import Any

from ilmek.params import Params, Value, declared, param
from ilmek.synthesis.filters import Filters


def filters(params: Params) -> Filters:
    """The filters that the parameters of a machine require."""
    return Filters(**{one.name: getattr(params, one.name) for one in declared(Filters)})


def _shared(name: str, default: Value = None) -> Any:
    """A parameter as `Filters` declares it, with another default where one is given."""
    of = Filters.__dataclass_fields__[name]
    return field(default=of.default if default is None else default, metadata=of.metadata)


def one_circuit() -> Any:
    """Circuit defects."""
    return _shared("one_circuit")


def one_branch() -> Any:
    """Branch defects."""
    return _shared("one_branch")


def in_order() -> Any:
    """Order defects."""
    return _shared("in_order")


def full_turn(default: bool = False) -> Any:
    """Cranks that turn."""
    return _shared("full_turn", default)


def transmission_min() -> Any:
    """Least transmission angle."""
    return _shared("transmission_min")


def link_ratio_max(default: float | None = None) -> Any:
    """Unequal links."""
    return _shared("link_ratio_max", default)


def size_max() -> Any:
    """Extent."""
    return _shared("size_max")


def chosen() -> Any:
    """Which solution is drawn."""
    return param(1, at_least=1, at_most=1000, doc="number of the solution that is drawn and moved, from 1, the best")


def count(default: int = 5) -> Any:
    """How many."""
    return param(default, at_least=1, at_most=100, doc="solutions that are listed at most")
