"""What a forward run answers: the course of the input, what drove it, the energy balance, and why it ended."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

import numpy as np

from ilmek.dynamics.events import EventRecord
from ilmek.dynamics.reduced import ReducedMechanism, Samples
from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.units import turn

Drive: TypeAlias = Callable[[float, float, float], float]
"""Effort on the input [N m, or N] of time [s], position [rad, m] and speed [rad/s, m/s]."""


@dataclass(frozen=True, slots=True)
class ForwardState:
    """Position [rad, m] and speed [rad/s, m/s] of the input at a time [s]."""

    position: float
    speed: float = 0.0
    time: float = 0.0


class EndKind(Enum):
    """Why a run ended.

    TIME           its time was over               EVENT  a terminal event was met
    DEAD_CENTRE    links in line: the drive has no definite hold on them
    CANNOT_CLOSE   the input's range ends there    NOT_CONVERGED  Newton's method found no pose beyond
    STEP           an effort that is not finite, or too rough for the error asked
    """

    TIME = "time"
    EVENT = "event"
    DEAD_CENTRE = "dead centre"
    CANNOT_CLOSE = "cannot close"
    NOT_CONVERGED = "not converged"
    STEP = "step"


@dataclass(frozen=True, slots=True)
class RunEnd:
    """How a run ended: the kind, the last state, and the reason in words."""

    kind: EndKind
    state: ForwardState
    words: str


@dataclass(frozen=True, slots=True)
class ForwardRun:
    """A forward run, sample by sample; the last sample is the end.

    position, speed, acceleration  of the input [rad, m; per s; per s²]      effort  of the drive [N m, N]
    kinetic, potential             energies, from the engine [J]; the weights' potential against the world's origin
    drive_work, load_work          done since the start [J]: by the drive; by the loads that are not weights
    end, events                    why it ended; the events met on the way, the ending one last
    table_error                    of the Fourier table, of the greatest value; None where the engine itself was run
    """

    reduced: ReducedMechanism
    time: Samples
    position: Samples
    speed: Samples
    acceleration: Samples
    effort: Samples
    kinetic: Samples
    potential: Samples
    drive_work: Samples
    load_work: Samples
    end: RunEnd
    events: tuple[EventRecord[ForwardState], ...]
    table_error: float | None

    @property
    def energy_residual(self) -> Samples:
        """Energy gained less work done since the start [J]: zero but for the integration's error."""
        energy = self.kinetic + self.potential
        residual: Samples = energy - energy[0] - self.drive_work - self.load_work
        return residual

    @property
    def energy_error(self) -> float:
        """Greatest energy residual over the greatest energy or work that was turned over."""
        courses = (self.kinetic, self.potential - self.potential[0], self.drive_work, self.load_work)
        size = max(float(np.nanmax(np.abs(course))) for course in courses)
        return float(np.nanmax(np.abs(self.energy_residual))) / size if size else 0.0

    def motion(self) -> Motion:
        """The mechanism's motion over the samples, ready for `inverse`: bearing loads of the run."""
        return solve(self.reduced.plan, self.position, self.speed, np.nan_to_num(self.acceleration))

    def require_turns(self, turns: float = 1.0) -> "ForwardRun":
        """The run itself, if the input made so many turns (or metres) in the direction in which it was driven.

        Raises MechanismError that says how far it came: a drive too weak to start, or a time too short.
        """
        wanted, course = turns * turn, self.position - self.position[0]
        reached = float(np.max(np.abs(course)))
        if reached >= wanted:
            return self
        name, at = self.reduced.plan.mechanism.name, int(np.argmax(np.abs(course)))
        raise MechanismError(
            f"{name} came {reached / turn:.3f} of {turns:g} turns and stood at {self.time[at]:.4g} s; "
            f"the drive gave {self.effort[at]:.4g} there",
            allowed=f"it ended because {self.end.words}",
            do="give a stronger drive, a flywheel, more speed at the start, or more time",
        )


def energies(reduced: ReducedMechanism, position: Samples, speed: Samples) -> tuple[Samples, Samples]:
    """Kinetic and potential energy [J] from the engine, not from a table."""
    return reduced.terms(position).inertia * speed**2 / 2, reduced.potential(position)
