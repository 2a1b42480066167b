"""The way on which a mechanism is looked at: along one of its inputs, or round a circuit through its dead centres.

Whatever is found on a way (crossings of a path, the least clearance) is found at places of it, numbers between start
and stop, and said with the input's value there.
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
    """A way of a mechanism; `circuits.Circuit` is one too."""

    @property
    def mechanism(self) -> Mechanism:
        """What moves."""

    @property
    def closed(self) -> bool:
        """Whether the end is the start."""

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Places from start to stop, between which all is smooth."""

    def bodies(self, places: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body, with its first and second rates by the place."""

    def inputs(self, places: FloatArray) -> FloatArray:
        """Values of the input there [rad, m]."""


@dataclass(frozen=True, slots=True)
class InputPath:
    """The way from one value of the input to another [rad, m]; places are the values. Closed if they are a turn apart.

    Raises MechanismError where the mechanism does not close all along, or start is not below stop.
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
        """What moves."""
        return self.moved.plan.mechanism

    @property
    def closed(self) -> bool:
        """Whether start and stop are one turn of a turning input apart."""
        return self.moved.turns and bool(np.isclose(self.stop - self.start, 2 * np.pi, rtol=1e-12))

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """The way in 64 parts."""
        return np.linspace(self.start, self.stop, 65)

    def bodies(self, places: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body, with its rates by the input."""
        motion = self.moved.motion(places)
        return {body.name: motion.body(body.name) for body in self.mechanism.bodies}

    def inputs(self, places: FloatArray) -> FloatArray:
        """The places themselves."""
        return np.asarray(places, dtype=float)


def spaced(breaks: Float[np.ndarray, " breaks"], between: int) -> Float[np.ndarray, " places"]:
    """The breaks, and evenly between neighbouring ones so many steps.

    >>> spaced(np.array([0.0, 1.0, 3.0]), 2)
    array([0. , 0.5, 1. , 2. , 3. ])
    """
    share = np.arange(between) / between
    inner = breaks[:-1, None] + np.diff(breaks)[:, None] * share
    return np.append(inner.ravel(), breaks[-1])
