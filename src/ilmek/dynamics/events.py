"""Events of a forward run: a value that goes through zero on the way, found to rounding.

An event is any function of the run's state. Ends of travel are events of a position, standstill one of a speed, the
closing of a gap one of a distance. A value is looked at after each step of the integrator: two crossings in one step
cancel, as in a value that swings faster than the machine moves.
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
    """Something that happens where `value` goes through zero: upward (direction +1), downward (-1), either way (0).

    terminal  whether the run ends there
    """

    name: str
    value: Callable[[At], float]
    direction: int = 0
    terminal: bool = True

    def look(self, state: At) -> float:
        """The value in a state; raises MechanismError where it is not a number."""
        value = float(self.value(state))
        if math.isnan(value):
            raise MechanismError(f"event {self.name!r} gives {value}", allowed="a number", do="mend its function")
        return value

    def crossed(self, old: float, new: float) -> bool:
        """Whether a step from one value to another goes through zero in the direction that is meant."""
        # A start on zero is not a crossing; nor is the step after an end on zero, whose old value is that zero.
        through = old * new < 0 or (new == 0 and old != 0)
        return bool(through and self.direction * old <= 0)


@dataclass(frozen=True)
class EventRecord(Generic[At]):
    """An event that was met: its name, the time [s], the state there."""

    name: str
    time: float
    state: At
    terminal: bool


def until_terminal(met: list[EventRecord[At]]) -> list[EventRecord[At]]:
    """What was met in one step, in its order, up to the first that ends the run."""
    met = sorted(met, key=lambda one: one.time)
    last = next((k for k, one in enumerate(met) if one.terminal), len(met))
    return met[: last + 1]


def located(value: Callable[[float], float], early: float, late: float) -> float:
    """Where a value changes its sign between two times; the later one where rounding hides the change."""
    if value(early) * value(late) >= 0:
        return late
    return float(scipy.optimize.brentq(value, early, late, xtol=4e-16 * max(abs(late), 1e-300), rtol=1e-15))
