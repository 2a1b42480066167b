"""A mechanism moved by one of its inputs at unit speed, with the other inputs locked: the basis of quality measures."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.model import Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.records import record


@record
class OneInput:
    """A plan, the name of the input that moves, and the values [rad, m] of the other, locked inputs."""

    plan: Plan
    name: str
    locked: Mapping[str, float]

    @property
    def turns(self) -> bool:
        """Whether the input is an angle."""
        return any(isinstance(entry, Rotation) and entry.name == self.name for entry in self.plan.mechanism.inputs)

    def motion(self, values: FloatArray, speed: float = 1.0) -> Motion:
        """The motion at values of the input [rad, m], (samples,); at unit speed rates are derivatives by the input."""
        others = {name: np.full(np.shape(values), value) for name, value in self.locked.items()}
        return solve(self.plan, others | {self.name: np.asarray(values, dtype=float)}, {self.name: speed})


def one_input(plan: Plan, name: str = "", locked: Mapping[str, float] | None = None) -> OneInput:
    """A mechanism with one moving input.

    name    the moving input; default: the only one
    locked  name -> value [rad, m] of every other input
    Raises MechanismError where the name is unknown or missing, or a locked value is missing or unknown.
    """
    names = [entry.name for entry in plan.mechanism.inputs]
    locked = dict(locked or {})
    if not name and len(names) == 1:
        name = names[0]
    if name not in names:
        raise MechanismError(f"input {name!r} of {plan.mechanism.name}", allowed=f"one of {', '.join(names)}")
    others = [other for other in names if other != name]
    if set(locked) != set(others):
        raise MechanismError(
            f"locked inputs of {plan.mechanism.name}: {', '.join(locked) or 'none'}",
            allowed=f"while {name} moves, a value for each of: {', '.join(others) or 'none'}",
        )
    return OneInput(plan, name, locked)
