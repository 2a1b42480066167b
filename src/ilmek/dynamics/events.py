"""Events of a forward run: zero crossings of a function of its state, located to rounding.

The end of travel is an event of a position, standstill of a speed, the closing of a gap of a distance. The value is
evaluated after each step of the integrator. Two crossings within one step are not detected, for example of a value that
oscillates faster than the machine moves.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import scipy

from ilmek.errors import MechanismError

At = TypeVar("At")


# Without slots: a slotted frozen class cannot be made through an alias such as Event[State] before Python 3.13.
@dataclass(frozen=True)
class Event(Generic[At]):
    """An event at a zero crossing of a value.

    name       for the report
    value      function of the state
    direction  +1 upward, -1 downward, 0 both
    terminal   whether the run ends there
    """

    name: str
    value: Callable[[At], float]
    direction: int = 0
    terminal: bool = True

    def evaluate(self, state: At) -> float:
        """The value at a state; raises MechanismError where it is NaN."""
        value = float(self.value(state))
        if math.isnan(value):
            raise MechanismError(
                f"value of event {self.name!r} is {value}", allowed="a number", do="correct its function"
            )
        return value

    def crossed(self, old: float, new: float) -> bool:
        """Whether a step from the old to the new value crosses zero in the direction of the event."""
        # A start at zero is not a crossing, nor is the step after one that ended at zero.
        through = old * new < 0 or (new == 0 and old != 0)
        return bool(through and self.direction * old <= 0)


@dataclass(frozen=True)
class EventRecord(Generic[At]):
    """An event that occurred: its name, the time [s], the state there."""

    name: str
    time: float
    state: At
    terminal: bool


def until_terminal(met: list[EventRecord[At]]) -> list[EventRecord[At]]:
    """The events of one step in the order of time, up to the first terminal event."""
    met = sorted(met, key=lambda one: one.time)
    last = next((k for k, one in enumerate(met) if one.terminal), len(met))
    return met[: last + 1]


def crossing_time(value: Callable[[float], float], early: float, late: float) -> float:
    """Time [s] between `early` and `late` at which a value changes its sign, by Brent's method.

    value  function of the time [s], continuous      early, late  ends of the step [s]
    `late` is returned where both ends have the same sign, as where rounding hides the change.
    """
    if value(early) * value(late) >= 0:
        return late
    return float(scipy.optimize.brentq(value, early, late, xtol=4e-16 * max(abs(late), 1e-300), rtol=1e-15))
