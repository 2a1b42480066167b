"""What every four-bar that answers a task may be asked for besides: the parameters of the sieve, declared once."""

from typing import Any, Protocol, runtime_checkable

from ilmek.params import param
from ilmek.synthesis.filters import Filters
from ilmek.units import deg


@runtime_checkable
class FilterParams(Protocol):
    """Parameters of a machine that the sieve reads."""

    @property
    def one_circuit(self) -> bool:
        """Whether a four-bar that must be taken apart goes."""

    @property
    def one_branch(self) -> bool:
        """Whether one that passes a dead centre of its crank goes."""

    @property
    def in_order(self) -> bool:
        """Whether one that meets the positions out of order goes."""

    @property
    def full_turn(self) -> bool:
        """Whether one whose crank does not turn fully goes."""

    @property
    def transmission_min(self) -> float:
        """Least transmission angle [rad]."""

    @property
    def link_ratio_max(self) -> float | None:
        """Longest link over the shortest."""

    @property
    def size_max(self) -> float | None:
        """Greatest extent [m]."""


def filters(wishes: FilterParams) -> Filters:
    """The sieve that the parameters ask for."""
    return Filters(
        one_circuit=wishes.one_circuit,
        one_branch=wishes.one_branch,
        in_order=wishes.in_order,
        full_turn=wishes.full_turn,
        transmission=wishes.transmission_min or None,
        link_ratio=wishes.link_ratio_max,
        size=wishes.size_max,
    )


def one_circuit() -> Any:
    """Circuit defects."""
    return param(True, doc="leave out four-bars that must be taken apart between two positions")


def one_branch() -> Any:
    """Branch defects."""
    return param(True, doc="leave out four-bars that pass a dead centre of the crank between two positions")


def in_order() -> Any:
    """Order defects."""
    return param(True, doc="leave out four-bars whose crank meets the positions in another order")


def full_turn(default: bool = False) -> Any:
    """Cranks that turn."""
    return param(default, doc="leave out four-bars whose crank does not turn fully")


def transmission_min() -> Any:
    """Least transmission angle."""
    return param(
        0.0, unit="deg", at_least=0.0, below=90 * deg, doc="least angle between coupler and rocker over the motion"
    )


def link_ratio_max(default: float | None = None) -> Any:
    """Unequal links."""
    return param(default, at_least=1.0, at_most=1e6, doc="longest link over the shortest, at most")


def size_max() -> Any:
    """Extent."""
    return param(None, unit="mm", above=0.0, at_most=1e3, doc="greatest extent of the moving four-bar, at most")


def chosen() -> Any:
    """Which solution is drawn."""
    return param(1, at_least=1, at_most=1000, doc="number of the solution that is drawn and moved, from 1, the best")


def count(default: int = 5) -> Any:
    """How many."""
    return param(default, at_least=1, at_most=100, doc="solutions that are listed at most")
