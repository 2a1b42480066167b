"""Equation of motion of a machine with one input and without friction in its joints, for `forward`.

    J q'' + J' q'^2 / 2 = Q + M,   written as   q' = p / √J,   p' = (Q + M) / √J       [see `reduced`; M drive effort]

With p = √J q' the kinetic energy is p^2 / 2, J' is not needed, and p stays finite where J does not: at a dead centre. A
machine whose input rotates fully has J and Q as Fourier tables (see `fourier_terms`).
"""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.forward_run import Drive, ForwardState, Row
from ilmek.dynamics.fourier_terms import FourierTerms
from ilmek.dynamics.reduced import ReducedMechanism, Samples
from ilmek.errors import MechanismError
from ilmek.linkage.status import Status
from ilmek.records import record


@record
class OneInputEquation:
    """The equation of a reduced mechanism; table: its terms; drive: None, the machine coasts."""

    reduced: ReducedMechanism
    table: FourierTerms | None
    drive: Drive | None

    def terms(self, position: float) -> tuple[float, float, float]:
        """J, Q of gravity and Q of the other steady loads; NaN where the mechanism does not close."""
        if self.table is not None:
            return self.table(position)
        found = self.reduced.terms(np.array([position]))
        if found.status[0] != Status.OK:
            return math.nan, math.nan, math.nan
        return float(found.inertia[0]), float(found.weight[0]), float(found.push[0])

    def efforts(self, time: float, position: float, speed: float) -> tuple[float, float]:
        """Efforts of the drive and of the live loads [N m; N]."""
        effort = float(self.drive(time, position, speed)) if self.drive is not None else 0.0
        if not self.reduced.live:
            return effort, 0.0
        return effort, float(self.reduced.live_force(*np.array([[position], [speed], [time]]))[0])

    def rates(self, time: float, row: Row) -> tuple[float, float, float, float]:
        """Time derivative of a row; NaN where the mechanism does not close."""
        position = float(row[0])
        if not math.isfinite(position):
            return math.nan, math.nan, math.nan, math.nan
        inertia, weight, steady = self.terms(position)
        if not inertia > 0:
            return math.nan, math.nan, math.nan, math.nan
        root = math.sqrt(inertia)
        speed = float(row[1]) / root
        effort, live = self.efforts(time, position, speed)
        load = steady + live
        return speed, (weight + load + effort) / root, effort * speed, load * speed

    def state(self, time: float, row: Row) -> ForwardState:
        """Position and speed of a row."""
        position = float(row[0])
        return ForwardState(position, float(row[1]) / math.sqrt(self.terms(position)[0]), time)

    def first(self, start: ForwardState) -> tuple[Row, Row]:
        """The first row, and the scale of the errors: 1 rad, and the energy at the start or the work over 1 rad."""
        position, speed = float(start.position), float(start.speed)
        inertia, weight, steady = self.terms(position)
        effort, live = self.efforts(start.time, position, speed)
        if not math.isfinite(effort + live):
            raise MechanismError(
                f"effort of the drive or a load is {effort + live} at the start",
                allowed="finite efforts",
                do="correct its function",
            )
        if not inertia > 0:
            raise MechanismError("no mass moves with the input at the start", do="give a flywheel or another start")
        momentum = math.sqrt(inertia) * speed
        energy = max(0.5 * momentum**2, abs(weight) + abs(steady) + abs(effort) + abs(live)) or inertia
        return np.array([position, momentum, 0.0, 0.0]), np.array([1.0, math.sqrt(2 * energy), energy, energy])

    def history(self, time: Samples, rows: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Speeds, accelerations and efforts of the drive at rows, shape (samples,), from the mechanism's equations."""
        position, momentum = rows[:, 0], rows[:, 1]
        found = self.reduced.terms(position)
        speed: FloatArray = momentum / np.sqrt(found.inertia)
        efforts = [self.efforts(*state) for state in zip(time, position, speed, strict=True)]
        effort, live = np.array(efforts).T
        force = found.weight + found.push + live + effort - 0.5 * found.slope * speed**2
        return speed, force / found.inertia, effort
