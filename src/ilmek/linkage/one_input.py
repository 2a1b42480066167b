"""A mechanism moved by one of its inputs at unit speed, the others held: what most questions of quality are about."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.model import Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan


@dataclass(frozen=True, slots=True)
class OneInput:
    """A plan, the name of the input that moves, and the values [rad, m] at which the others are held."""

    plan: Plan
    name: str
    held: Mapping[str, float]

    @property
    def turns(self) -> bool:
        """Whether the input is an angle."""
        return any(isinstance(entry, Rotation) and entry.name == self.name for entry in self.plan.mechanism.inputs)

    def motion(self, values: FloatArray) -> Motion:
        """The motion at values of the input [rad, m], at unit speed: rates are derivatives by the input."""
        courses = {name: np.full(np.shape(values), value) for name, value in self.held.items()}
        return solve(self.plan, courses | {self.name: np.asarray(values, dtype=float)}, {self.name: 1.0})


def one_input(plan: Plan, name: str = "", held: Mapping[str, float] | None = None) -> OneInput:
    """The input `name` moves (the only one, if it is not said), every other stands at its value in `held`.

    Raises MechanismError where the name is unknown or needed, or an input's value is missing or unknown.
    """
    names = [entry.name for entry in plan.mechanism.inputs]
    held = dict(held or {})
    if not name and len(names) == 1:
        name = names[0]
    if name not in names:
        raise MechanismError(f"input {name!r} of {plan.mechanism.name}", allowed=f"one of {', '.join(names)}")
    others = [other for other in names if other != name]
    if set(held) != set(others):
        raise MechanismError(
            f"held inputs of {plan.mechanism.name}: {', '.join(held) or 'none'}",
            allowed=f"while {name} moves, a value for each of: {', '.join(others) or 'none'}",
        )
    return OneInput(plan, name, held)
