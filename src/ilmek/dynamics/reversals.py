"""Reversals of joints with dry friction, and of one input against loads that jump there; what friction holds.

One input that comes to rest moves on in the direction in which it is accelerated once it moves in it, with all friction
against that motion. Where it is accelerated in neither, friction holds it.    [Coulomb; derived here]
"""

import math
from typing import NamedTuple, TypeAlias

import numpy as np
import scipy

from ilmek.arrays import BoolArray
from ilmek.dynamics.equation_of_motion import GeneralEquation
from ilmek.dynamics.events import crossing_time
from ilmek.dynamics.forward_run import EndKind, ForwardState, Row, RunEnd
from ilmek.dynamics.one_input import OneInputEquation

Equation: TypeAlias = OneInputEquation | GeneralEquation

RESTING = 1e-7
"""Speed in a joint, over the greatest of all joints with friction, that counts as rest where one of them reverses."""


LEAST = 1e-9
"""Speed or momentum of an input that comes to rest or has just left it, in the units of its row."""


class RunSample(NamedTuple):
    """A row at a time [s], and the equation that holds there."""

    time: float
    row: Row
    equation: Equation

    @property
    def state(self) -> ForwardState:
        """Position and speed of the inputs."""
        return self.equation.state(self.time, self.row)


def between(solver: "scipy.integrate.DOP853", equation: Equation, time: float) -> RunSample:
    """The state at a time in the last step."""
    return RunSample(time, solver.dense_output()(time), equation)


def reversal(solver: "scipy.integrate.DOP853", equation: Equation) -> tuple[RunSample, BoolArray | None]:
    """The end of the last step, and no joints; or the first reversal with a jump in it, and which joints rest there."""
    end = RunSample(float(solver.t), np.array(solver.y), equation)
    if not isinstance(equation, GeneralEquation) or not equation.dry:
        rest = _input_at_rest(solver, equation)
        return (end, None) if rest is None else (rest, np.zeros(0, dtype=bool))
    speeds = equation.along(end.time, end.row)
    turning = np.flatnonzero(speeds < 0)
    if len(turning) == 0:
        return end, None
    dense = solver.dense_output()
    times = [
        crossing_time(lambda time, k=k: float(equation.along(time, dense(time))[k]), solver.t_old, solver.t)  # type: ignore[misc]
        for k in turning
    ]
    first = int(np.argmin(times))
    found = between(solver, equation, times[first])
    there = np.abs(equation.along(found.time, found.row))
    resting = there <= RESTING * max(float(np.max(np.abs(speeds))), float(np.max(there)))
    resting[turning[first]] = True
    if len(equation.drives) == 1 and abs(found.row[1]) <= RESTING * max(abs(solver.y_old[1]), abs(end.row[1])):
        found.row[1] = math.copysign(LEAST, solver.y_old[1])
    return found, resting


def _input_at_rest(solver: "scipy.integrate.DOP853", equation: Equation) -> RunSample | None:
    """The state in the last step at which one input rests and its acceleration jumps."""
    if len(equation.reduced.wheels) > 1 or solver.y_old[1] * solver.y[1] >= 0:
        return None
    dense = solver.dense_output()
    rest = between(solver, equation, crossing_time(lambda time: float(dense(time)[1]), solver.t_old, solver.t))
    rest.row[1] = math.copysign(LEAST, solver.y_old[1])
    ahead, back = (departed(rest, direction)[1] for direction in (1.0, -1.0))
    return None if abs(ahead - back) <= RESTING * (abs(ahead) + abs(back)) else rest


def departed(rest: RunSample, direction: float) -> tuple[RunSample, float]:
    """The state just after a rest of one input, in a direction, and the derivative of its speed or momentum there."""
    row = rest.row.copy()
    row[1] = direction * LEAST
    equation = rest.equation
    if isinstance(equation, GeneralEquation):
        equation = equation.departed(rest.time, row, direction)
    return RunSample(rest.time, row, equation), float(equation.rates(rest.time, row)[1])


def restarted(at: RunSample, resting: BoolArray) -> RunSample | RunEnd:
    """The state with the signs after it, where some joints with dry friction rest; the end where friction holds one."""
    one = len(at.equation.reduced.wheels) == 1
    if one and abs(at.row[1]) <= LEAST:
        departures = [(direction, *departed(at, direction)) for direction in (1.0, -1.0)]
        possible = [(direction * rate, after) for direction, after, rate in departures if direction * rate > 0]
        if possible:
            return max(possible, key=lambda departure: departure[0])[1]
        return RunEnd(EndKind.HELD, at.state, "friction holds it at rest")
    assert isinstance(at.equation, GeneralEquation)
    turned = at.equation.turned(at.time, at.row, resting)
    if turned is not None:
        return at._replace(equation=turned)
    names = " or ".join(law.joint for law, rests in zip(at.equation.laws, resting, strict=False) if rests)
    return RunEnd(EndKind.HELD, at.state, "friction holds it at rest" if one else f"friction holds joint {names}")
