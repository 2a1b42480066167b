"""Result of a forward run: motion of the input, drive effort, energy balance, and the reason of the end."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from typing import TypeAlias

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import Float, RealField
from ilmek.dynamics.events import EventRecord
from ilmek.dynamics.reduced import ReducedMechanism, Samples
from ilmek.errors import MechanismError
from ilmek.linkage.model import Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.records import record
from ilmek.report.framed import Framed
from ilmek.units import turn

Drive: TypeAlias = Callable[[float, float, float], float]
"""Effort on an input [N m; N] as a function of time [s], position [rad; m] and speed [rad/s; m/s]: a `MotorDrive`, or
a function."""

Row: TypeAlias = Float[np.ndarray, " integrated"]
"""Integrated quantities: positions of the inputs, as many momenta or speeds, work of the drives, and of the loads."""

OfInputs: TypeAlias = Float[np.ndarray, "*inputs samples"]
"""One value per sample; of several inputs one row each, in their order."""


@record
class ForwardState:
    """Position [rad; m] and speed [rad/s; m/s] of the input at a time [s]; of several inputs arrays in their order."""

    position: RealField
    speed: RealField = 0.0
    time: float = 0.0


class EndKind(Enum):
    """Why a run ended.

    TIME           the duration was reached        EVENT          a terminal event occurred
    DEAD_CENTRE    links in line: the motion of the input does not determine theirs
    CANNOT_CLOSE   end of the input's range        NOT_CONVERGED  Newton's method found no further pose
    HELD           friction holds the machine, or one of its joints
    STEP           an effort that is not finite, or not smooth enough for the requested error
    STEPS          the most steps of the integrator were made
    """

    TIME = "time"
    EVENT = "event"
    DEAD_CENTRE = "dead centre"
    CANNOT_CLOSE = "cannot close"
    NOT_CONVERGED = "not converged"
    HELD = "held"
    STEP = "step"
    STEPS = "steps"

    @property
    def early(self) -> bool:
        """Whether the run ended before its duration, and neither at an event nor held by friction."""
        return self not in (EndKind.TIME, EndKind.EVENT, EndKind.HELD)


@dataclass(frozen=True, slots=True)
class RunEnd:
    """How a run ended: the kind, the last state, and the reason as a sentence."""

    kind: EndKind
    state: ForwardState
    reason: str


@record
class ForwardRun(Framed):
    """A forward run, one value per sample; the last sample is the end.

    time                           [s]
    position, speed, acceleration  of the input [rad; m, per s, per s²]; of several inputs one row each, in their order
    effort                         of the drive [N m; N], likewise
    kinetic, potential             energies, recomputed from the mechanism [J]; potential of gravity relative to the
                                   ground's origin
    drive_work, load_work          work since the start [J]: of the drives; of the loads except gravity, and of friction
    end, events                    reason of the end; the events that occurred, in their order
    table_error                    error of the Fourier table, relative to the greatest value; None without a table

    >>> from ilmek import bar, forward_dynamics, four_bar
    >>> run = forward_dynamics(four_bar(0.300, 0.060, 0.200, 0.230), {"crank": bar(0, 0.060, mass=0.4)}, 0.2, speed=10)
    >>> run.end.kind.name, bool(run.energy_error < 1e-6)
    ('TIME', True)
    """

    reduced: ReducedMechanism
    time: Samples
    position: OfInputs
    speed: OfInputs
    acceleration: OfInputs
    effort: OfInputs
    kinetic: Samples
    potential: Samples
    drive_work: Samples
    load_work: Samples
    end: RunEnd
    events: tuple[EventRecord[ForwardState], ...]
    table_error: float | None

    def table(self) -> dict[str, Samples]:
        """Columns by heading: time, motion of the inputs, efforts, energies and work; SI and radians."""
        inputs = self.reduced.plan.mechanism.inputs
        columns = {"time [s]": self.time}
        rows = (np.atleast_2d(one) for one in (self.position, self.speed, self.acceleration, self.effort))
        for entry, position, speed, acceleration, drive in zip(inputs, *rows, strict=True):
            unit, effort = ("rad", "N*m") if isinstance(entry, Rotation) else ("m", "N")
            of = f"{entry.name} " if len(inputs) > 1 else ""
            columns |= {
                f"{of}position [{unit}]": position,
                f"{of}speed [{unit}/s]": speed,
                f"{of}acceleration [{unit}/s^2]": acceleration,
                f"{of}effort [{effort}]": drive,
            }
        return {
            **columns,
            "kinetic energy [J]": self.kinetic,
            "potential energy [J]": self.potential,
            "work of the drive [J]": self.drive_work,
            "work of the loads [J]": self.load_work,
        }

    @property
    def energy_residual(self) -> Samples:
        """Energy gained minus work done since the start [J]: the error of the integration."""
        energy = self.kinetic + self.potential
        residual: Samples = energy - energy[0] - self.drive_work - self.load_work
        return residual

    @property
    def energy_error(self) -> float:
        """Greatest energy residual, relative to the greatest energy or work of the run [1]; 0 where both are 0."""
        curves = (self.kinetic, self.potential - self.potential[0], self.drive_work, self.load_work)
        size = max(float(np.nanmax(np.abs(curve))) for curve in curves)
        return float(np.nanmax(np.abs(self.energy_residual))) / size if size else 0.0

    def motion(self) -> Motion:
        """The motion of the mechanism at the samples, for example for the joint forces by `inverse`."""
        rates = (self.position, self.speed, np.nan_to_num(self.acceleration))
        return motion_of(self.reduced, self.time, *rates)

    def require_turns(self, turns: float = 1.0) -> "ForwardRun":
        """The run itself, if the input made at least this number of turns, in either direction.

        Raises MechanismError that states the number of turns reached: the drive is too weak or the duration too short.
        """
        turns = Arguments("a run", MechanismError).number("turns", turns)
        if len(self.reduced.wheels) > 1:
            raise MechanismError("turns are asked of a run with several inputs", do="read its `position`")
        required, curve = turns * turn, self.position - self.position[0]
        reached = float(np.max(np.abs(curve)))
        if reached >= required:
            return self
        name, at = self.reduced.plan.mechanism.name, int(np.argmax(np.abs(curve)))
        raise MechanismError(
            f"{name} made {reached / turn:.3f} of {turns:g} turns and stood at {self.time[at]:.4g} s; "
            f"the drive effort was {self.effort[at]:.4g} there",
            allowed=f"the run ended: {self.end.reason}",
            do="give a stronger drive, a flywheel, more speed at the start, or more time",
        )


def motion_of(reduced: ReducedMechanism, time: Samples, *rates: OfInputs) -> Motion:
    """Motion at times [s], of positions of the inputs [rad; m], then their speeds, then their accelerations."""
    names = tuple(reduced.wheels)
    values = [dict(zip(names, np.atleast_2d(rate), strict=True)) for rate in rates]
    return replace(solve(reduced.plan, *values), time=time)
