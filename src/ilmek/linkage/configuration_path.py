"""Paths of configurations: along one input of a mechanism, or along a circuit through its dead centres.

Results along a path (crossings of a coupler curve, the least clearance) are reported with the parameter of the path, a
number between start and stop, and the value of the input.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.model import Mechanism
from ilmek.linkage.one_input import OneInput


@runtime_checkable
class ConfigurationPath(Protocol):
    """A path of configurations of a mechanism: `InputPath`, `circuits.Circuit`."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""

    @property
    def closed(self) -> bool:
        """Whether the end is the start."""

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Parameters from start to stop; the motion is smooth between them."""

    def bodies(self, parameters: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body at the parameters, with first and second rates by the parameter."""

    def inputs(self, parameters: FloatArray) -> FloatArray:
        """Values of the input [rad, m] at the parameters."""


@dataclass(frozen=True, slots=True)
class InputPath:
    """The path from one value of the input to another [rad, m], its own parameter. Closed over one turn.

    Raises MechanismError where the mechanism does not close everywhere, or start is not below stop.
    """

    moved: OneInput
    start: float = -np.pi
    stop: float = np.pi

    def __post_init__(self) -> None:
        if not (np.isfinite(self.start) and np.isfinite(self.stop) and self.start < self.stop):
            raise MechanismError(f"from {self.start} to {self.stop}", allowed="a start below the stop, both finite")
        self.moved.motion(spaced(self.breaks, 8)).require()

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.moved.plan.mechanism

    @property
    def closed(self) -> bool:
        """Whether start and stop are one turn of a turning input apart."""
        return self.moved.turns and bool(np.isclose(self.stop - self.start, 2 * np.pi, rtol=1e-12))

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """The ends of 64 equal parts."""
        return np.linspace(self.start, self.stop, 65)

    def bodies(self, parameters: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body, with its rates by the input."""
        motion = self.moved.motion(parameters)
        return {body.name: motion.body(body.name) for body in self.mechanism.bodies}

    def inputs(self, parameters: FloatArray) -> FloatArray:
        """The parameters themselves."""
        return np.asarray(parameters, dtype=float)


def spaced(breaks: Float[np.ndarray, " breaks"], between: int) -> Float[np.ndarray, " parameters"]:
    """The breaks, with each interval divided into equal steps.

    >>> spaced(np.array([0.0, 1.0, 3.0]), 2)
    array([0. , 0.5, 1. , 2. , 3. ])
    """
    share = np.arange(between) / between
    inner = breaks[:-1, None] + np.diff(breaks)[:, None] * share
    return np.append(inner.ravel(), breaks[-1])
