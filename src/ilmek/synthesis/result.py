"""What a synthesis gives: four-bars, the best first, and what was left out, with the reasons.

cos mu = (b² + c² - |A B0|²) / (2 b c)      least transmission angle: of mu and its supplement over the motion
[cosine theorem in the triangle of coupler b, rocker c and A B0]
"""

import math
from collections.abc import Iterator
from typing import Generic, TypeVar

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import ParameterError
from ilmek.linkage.model import Mechanism
from ilmek.records import record, value_record
from ilmek.report.framed import Framed
from ilmek.report.shown import Shown
from ilmek.synthesis.four_bar import FourBar, LinkLengths
from ilmek.units import counted

Details = TypeVar("Details")


@record
class FourBarSolution(Shown, Generic[Details]):
    """A four-bar that a synthesis found; `solve` and `judged` take it as the mechanism that it is.

    four_bar      pins and tracer as drawn
    error         greatest error of the task: of a path or a motion [m], of a function or a swing [rad]
    transmission  least transmission angle over its motion [rad]
    details       what the method gives besides
    """

    four_bar: FourBar
    error: float
    transmission: float
    details: Details

    @property
    def mechanism(self) -> Mechanism:
        """The linkage, driven by its crank: pins A0, A, B, B0, tracer "coupler.P"."""
        return self.four_bar.mechanism()

    @property
    def lengths(self) -> LinkLengths:
        """Ground, crank, coupler, rocker [m]."""
        return self.four_bar.lengths


@value_record
class LeftOut:
    """A reason for which four-bars are not among the solutions, and how many."""

    reason: str
    count: int


@record
class Synthesis(Framed, Generic[Details]):
    """The four-bars for a task, the best first: a sequence of `FourBarSolution`.

    solutions  the best first                       left_out  reasons, each with the number of four-bars
    unit       of the errors, "m" or "rad"          cures     what gives a solution where there is none, as sentences
    """

    solutions: tuple[FourBarSolution[Details], ...]
    left_out: tuple[LeftOut, ...]
    unit: str
    cures: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[FourBarSolution[Details]]:
        return iter(self.solutions)

    def __getitem__(self, index: int) -> FourBarSolution[Details]:
        return self.solutions[index]

    def __repr__(self) -> str:
        return f"<{counted(len(self), 'four-bar')}; left out: {self.reasons or 'none'}>"

    @property
    def reasons(self) -> str:
        """What was left out, with the numbers, as one line."""
        return ", ".join(f"{entry.reason} ({entry.count})" for entry in self.left_out)

    @property
    def best(self) -> FourBarSolution[Details]:
        """The first solution. Raises ParameterError, with what was left out, where there is none."""
        if not self.solutions:
            raise ParameterError(f"no four-bar does the task; left out: {self.reasons}", do="; ".join(self.cures))
        return self.solutions[0]

    def table(self) -> dict[str, FloatArray]:
        """Links, error and least transmission angle by column, one row a four-bar."""
        columns = {"number": [float(number) for number in range(1, len(self) + 1)]}
        for link in LinkLengths._fields:
            columns[f"{link} [m]"] = [getattr(solution.lengths, link) for solution in self]
        columns[f"error [{self.unit}]"] = [solution.error for solution in self]
        columns["least transmission angle [rad]"] = [solution.transmission for solution in self]
        return {heading: np.array(values, float) for heading, values in columns.items()}


def transmission_over(four_bar: FourBar, cranks: object) -> float:
    """Least transmission angle of a four-bar [rad] at crank angles in the ground frame [rad].

    >>> drawn = FourBar(0j, 4 + 0j, 1 + 0j, 2.5 + 1.5j)
    >>> round(math.degrees(transmission_over(drawn, [0.0])), 6)
    90.0
    """
    _, crank, coupler, rocker = four_bar.lengths
    reach = np.abs(four_bar.a0 + crank * np.exp(1j * np.asarray(cranks, float)) - four_bar.b0)
    cosine = (coupler**2 + rocker**2 - reach**2) / (2 * coupler * rocker)
    return math.acos(min(1.0, float(np.max(np.abs(cosine)))))
