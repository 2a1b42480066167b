"""Loads that follow the machine: over a table of an input or of time, in the direction of a body, viscous drag."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.friction import AngleRange, Friction, WindowedLoad
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.loads import Load, Wrench
from ilmek.errors import MechanismError
from ilmek.linkage.joints import FreePoint, set_points
from ilmek.linkage.motion import Motion
from ilmek.records import record
from ilmek.units import turn


@dataclass(frozen=True, slots=True)
class FollowerForce:
    """A follower force [N] on a point of a body: constant in the body's frame, it turns with the body."""

    on: FreePoint
    force: complex

    def __post_init__(self) -> None:
        set_points(self, "on")

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        body, local = motion.plan.mechanism.located(self.on)
        yield Wrench(body, self.force * motion.direction(body), local)


@dataclass(frozen=True, slots=True)
class Drag:
    """Viscous resistance on a point of a body: F = -c v, with its velocity v; c [N s/m], not negative."""

    on: FreePoint
    coefficient: float

    def __post_init__(self) -> None:
        set_points(self, "on")
        if not 0 <= self.coefficient < np.inf:
            given = f"drag on {self.on!r} is {self.coefficient:g}"
            raise MechanismError(given, allowed="finite and not negative")

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:  # noqa: ARG002
        """One wrench."""
        body, local = motion.plan.mechanism.located(self.on)
        yield Wrench(body, -self.coefficient * motion.carried(body, local).velocity, local)


@record
class TabulatedLoad:
    """A load times a factor that is given at values of an input, or at times, with straight lines between.

    load        the load at a factor of 1      input_name  name of the input; None: the table is over time
    at          values of the input [rad; m] or times [s], ascending      factors  [1] at these values
    turns       whether the table repeats in every turn of the input; else its end values hold outside

    A table that repeats is read from its last entry to its first one turn later. Raises MechanismError for fewer than
    two entries, values that do not ascend, and a table that repeats and is over time or longer than a turn.
    """

    load: Load
    input_name: str | None
    at: tuple[float, ...]
    factors: tuple[float, ...]
    turns: bool = True

    def __post_init__(self) -> None:
        if len(self.at) < 2 or len(self.at) != len(self.factors):
            given = f"a table has {len(self.at)} values and {len(self.factors)} factors"
            raise MechanismError(given, allowed="the same number, 2 or more")
        if not np.all(np.diff(self.at) > 0):
            raise MechanismError("the values of a table do not ascend", do="write each above the one before")
        if self.turns and self.input_name is None:
            raise MechanismError("a table over time repeats in every turn", do="give it over an input, or turns=False")
        if self.turns and self.at[-1] - self.at[0] > turn * (1 + 1e-12):
            given = f"a table over a turning input is {self.at[-1] - self.at[0]:g} rad long"
            raise MechanismError(given, allowed="at most a turn")

    def factor(self, values: FloatArray | float) -> FloatArray:
        """The factor at values of the input [rad; m] or times [s], of the same shape."""
        at, factors = np.asarray(self.at), np.asarray(self.factors)
        if self.turns:
            values = at[0] + np.mod(np.asarray(values) - at[0], turn)
            if at[-1] - at[0] < turn * (1 - 1e-12):
                at, factors = np.append(at, at[0] + turn), np.append(factors, factors[0])
        found: FloatArray = np.interp(values, at, factors)
        return found

    def wrenches(self, motion: Motion, inertias: Mapping[str, Inertia]) -> Iterable[Wrench]:
        """The wrenches of the load, times the factor. Raises MechanismError where the motion has no time."""
        values = motion.time if self.input_name is None else motion.drives[self.input_name].value
        if values is None:
            raise MechanismError("a load varies over time, and the inputs stand still", do="give a speed or a motion")
        factor = self.factor(values)
        for wrench in self.load.wrenches(motion, inertias):
            yield Wrench(wrench.body, wrench.force * factor, wrench.at, wrench.torque * factor)


def jumps(load: Load, input_name: str) -> set[float]:
    """Values of an input [rad; m] at which a load jumps: the ends of its window, and of the windows of what it wraps.

    A window of a whole turn has no ends. Windows over another input are left out.
    """
    inner = jumps(load.load, input_name) if isinstance(load, WindowedLoad | TabulatedLoad) else set[float]()
    if not isinstance(load, WindowedLoad | Friction) or load.window is None or load.input_name != input_name:
        return inner
    whole = isinstance(load.window, AngleRange) and abs(load.window.end - load.window.start) >= turn
    return inner if whole else inner | {load.window.start, load.window.end}
