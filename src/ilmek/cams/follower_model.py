"""Model of a follower: masses in a row on springs and dampers, the first on the cam; return springs to the frame."""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError


@dataclass(frozen=True, slots=True)
class Stage:
    """A mass and its connections.

    mass         [kg], above 0
    stiffness    of the spring to the mass before it, or to the cam [N/m], above 0
    damping      of the damper beside that spring [N s/m]
    return_rate  of a return spring to the frame [N/m]
    """

    mass: float
    stiffness: float
    damping: float = 0.0
    return_rate: float = 0.0


@dataclass(frozen=True, slots=True)
class FollowerModel:
    """Stages in a row, the first one on the cam, and the preload on the cam at rest [N].

    Raises ParameterError without stages, and for masses, stiffnesses or damping of the wrong sign.
    """

    stages: tuple[Stage, ...]
    preload: float = 0.0

    def __post_init__(self) -> None:
        if not self.stages:
            raise ParameterError("a follower without a mass", allowed="one mass or more")
        for stage in self.stages:
            if not (stage.mass > 0 and stage.stiffness > 0 and stage.damping >= 0 and stage.return_rate >= 0):
                shown = f"mass {stage.mass:g} kg, stiffness {stage.stiffness:g} N/m, damping {stage.damping:g} N s/m"
                raise ParameterError(
                    f"a follower of {shown}", allowed="mass and stiffness above 0, the rest at least 0"
                )

    @property
    def masses(self) -> FloatArray:
        """Masses [kg], (masses,)."""
        return np.array([stage.mass for stage in self.stages])

    @property
    def return_rates(self) -> FloatArray:
        """Rates of the return springs [N/m], (masses,)."""
        return np.array([stage.return_rate for stage in self.stages])

    @property
    def stiffness(self) -> FloatArray:
        """Stiffness matrix K [N/m], (masses, masses)."""
        return _row([stage.stiffness for stage in self.stages]) + np.diag(self.return_rates)

    @property
    def damping(self) -> FloatArray:
        """Damping matrix C [N s/m], (masses, masses)."""
        return _row([stage.damping for stage in self.stages])

    @property
    def frequencies(self) -> FloatArray:
        """Natural angular frequencies without damping [rad/s], ascending."""
        root = 1.0 / np.sqrt(self.masses)
        return np.asarray(np.sqrt(np.linalg.eigvalsh(root[:, None] * self.stiffness * root)))


def one_mass(
    mass: float, stiffness: float, damping_ratio: float = 0.0, return_rate: float = 0.0, preload: float = 0.0
) -> FollowerModel:
    """A follower of one mass.

    mass         [kg]        stiffness  of the linkage [N/m]      damping_ratio  share of the critical damping [-]
    return_rate  [N/m]       preload    on the cam at rest [N]

    >>> round(float(one_mass(2.0, 200.0).frequencies[0]), 9)
    10.0
    """
    critical = 2.0 * math.sqrt(mass * (stiffness + return_rate)) if mass > 0 and stiffness > 0 else 0.0
    return FollowerModel((Stage(mass, stiffness, damping_ratio * critical, return_rate),), preload)


def _row(rates: list[float]) -> FloatArray:
    """Matrix of springs (or dampers) in a row, the first one to the cam."""
    own = np.array(rates)
    following = np.append(own[1:], 0.0)
    return np.diag(own + following) - np.diag(own[1:], 1) - np.diag(own[1:], -1)
