"""Reversals of joints with dry friction in a forward run, and the joints that friction holds."""

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
    """The end of the last step, and no joints; or the first reversal of a joint with friction in it, and what rests."""
    end = RunSample(float(solver.t), np.array(solver.y), equation)
    if not isinstance(equation, GeneralEquation) or not equation.dry:
        return end, None
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
    return found, resting


def restarted(at: RunSample, resting: BoolArray) -> RunSample | RunEnd:
    """The state with the signs after it, where some joints with dry friction rest; the end where friction holds one."""
    assert isinstance(at.equation, GeneralEquation)
    turned = at.equation.turned(at.time, at.row, resting)
    if turned is not None:
        return at._replace(equation=turned)
    names = " or ".join(law.joint for law, rests in zip(at.equation.laws, resting, strict=False) if rests)
    one = len(at.equation.drives) == 1
    return RunEnd(EndKind.HELD, at.state, "friction holds it at rest" if one else f"friction holds joint {names}")
