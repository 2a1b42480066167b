"""What a textbook's second chapter asks of a mechanism, computed when it is asked for.

Each answer is that of the function that it names; here they share the input, its range and its motion.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import MechanismError
from ilmek.linkage.circuits import Circuit, assembly_ranges, circuits
from ilmek.linkage.configuration_path import InputPath
from ilmek.linkage.coupler_curve import CouplerCurve, coupler_curve
from ilmek.linkage.dimensions import Dimension, link_dimensions
from ilmek.linkage.extremes import Dwell, OutputExtreme, dwells, extremes
from ilmek.linkage.fourbar import link_lengths
from ilmek.linkage.model import Mechanism, degrees_of_freedom
from ilmek.linkage.motion import Motion
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.outputs import Output, output_named
from ilmek.linkage.quality import Grashof, grashof
from ilmek.linkage.sensitivity import Derivatives, OutputTolerance, derivatives, spread
from ilmek.linkage.transmission import mechanical_advantage, transmission_angles, velocity_ratio
from ilmek.report.shown import Shown
from ilmek.units import turn

SAMPLES = 721
"""Samples of the motion over the range of the input."""

EDGE = 1e-6
"""Share of a range that is left out at a dead centre of the input."""

FULL = 1e-9
"""A range shorter than a turn by less [rad] is a full turn."""


class WorstTransmission(NamedTuple):
    """The least transmission angle [rad], the pin, and the value of the input [rad, m]."""

    angle: float
    pin: str
    input: float


@dataclass(frozen=True, eq=False, repr=False)
class JudgedMechanism(Shown):
    """A mechanism with one moving input, judged: each property is computed once, when it is first read.

    An output is named as its results are: "rocker" is the angle of a body, "coupler.P x" and "coupler.P y" are the
    coordinates of a point, "S" is the travel of a slide.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> beat_up = JudgedMechanism(one_input(plan(four_bar(0.300, 0.0597, 0.2007, 0.2308, branch=+1))))
    >>> beat_up.grashof.kind, len(beat_up.circuits), round(float(np.degrees(beat_up.transmission.angle)), 2)
    ('crank-rocker', 2, 67.24)
    >>> back, front = beat_up.limits("rocker")
    >>> round(float(np.degrees(back.value - front.value)), 2), round(beat_up.time_ratio("rocker"), 3)
    (29.98, 1.0)
    """

    moved: OneInput

    def __repr__(self) -> str:
        return (
            f"<judged {self.mechanism.name[:60]}: {self.degrees_of_freedom} degrees of freedom, by {self.moved.name}>"
        )

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.moved.plan.mechanism

    @cached_property
    def degrees_of_freedom(self) -> int:
        """By the count of bodies and joints [Chebyshev, Grübler, Kutzbach]."""
        return degrees_of_freedom(self.mechanism)

    @cached_property
    def grashof(self) -> Grashof:
        """Grashof's class of a four-bar. Raises MechanismError for any other mechanism."""
        lengths = link_lengths(self.mechanism)
        if lengths is None:
            raise MechanismError(f"{self.mechanism.name} has no Grashof class", allowed="a four-bar of four pins")
        return grashof(**lengths)

    @cached_property
    def circuits(self) -> tuple[Circuit, ...]:
        """All circuits, each with its branches and the dead centres of the input."""
        return circuits(self.moved)

    @cached_property
    def ranges(self) -> tuple[tuple[float, float], ...]:
        """Ranges of the input [rad, m] in which the mechanism closes with its branches; (-pi, pi) for a full turn."""
        return assembly_ranges(self.moved)

    @cached_property
    def range(self) -> tuple[float, float]:
        """The longest range of the input [rad, m]. Raises MechanismError for a mechanism that closes nowhere."""
        if not self.ranges:
            raise MechanismError(f"{self.mechanism.name} closes for no {self.moved.name}", do="change a link's length")
        return max(self.ranges, key=lambda ends: ends[1] - ends[0])

    @property
    def turns(self) -> bool:
        """Whether the input turns fully."""
        first, last = self.range
        return self.moved.turns and last - first > turn - FULL

    @cached_property
    def motion(self) -> Motion:
        """The motion over `range`, at unit speed: rates are derivatives by the input."""
        return self.moved.motion(self.values)

    @cached_property
    def transmission(self) -> WorstTransmission:
        """The least transmission angle of all dyads over `range`, at its samples.

        Raises MechanismError for a mechanism without a free pin of a dyad.
        """
        angles = transmission_angles(self.motion)
        if not angles:
            raise MechanismError(f"{self.mechanism.name} has no dyad with a free pin", do="see transmission_angles")
        pin = min(angles, key=lambda name: float(np.nanmin(angles[name])))
        least = int(np.nanargmin(angles[pin]))
        value = np.broadcast_to(self.motion.drives[self.moved.name].value, len(self.motion))[least]
        return WorstTransmission(float(angles[pin][least]), pin, float(value))

    def output(self, name: str) -> Output:
        """The output of a name. Raises MechanismError, with the nearest, for any other."""
        return output_named(self.mechanism, name)

    def limits(self, output: str) -> tuple[OutputExtreme, ...]:
        """Limit positions of an output over `range`, its dead centres, in the order of the input."""
        return extremes(self.moved, self.output(output), *self.inside)

    def dwells(self, output: str, tolerance: float) -> tuple[Dwell, ...]:
        """Dwells of an output about its limits, the longest first; tolerance to either side [rad, m]."""
        first, last = self.inside
        if self.turns:  # a turn begins where the output is quickest, so that no dwell is cut
            first = float(self.values[np.nanargmax(np.abs(self.ratio(output)))])
            last = first + turn
        return dwells(self.moved, self.output(output), tolerance, first, last)

    def time_ratio(self, output: str) -> float:
        """Time ratio of an output with two limits at a constant speed of the input: the slow stroke by the quick one.

        Raises MechanismError where the input does not turn fully, or the output has not two limits.
        """
        ends = self.limits(output)
        if not self.turns or len(ends) != 2:
            given = f"{output} of {self.mechanism.name} has {len(ends)} limits, the input turns fully: {self.turns}"
            raise MechanismError(given, allowed="a time ratio is of two limits in a full turn")
        stroke = abs(ends[1].input - ends[0].input)
        return max(stroke, turn - stroke) / min(stroke, turn - stroke)

    def ratio(self, output: str) -> Float[np.ndarray, " samples"]:
        """Velocity ratio of an output by the input at the samples of `motion`; NaN at dead centres."""
        return velocity_ratio(self.moved, self.output(output), self.values)

    def advantage(self, output: str) -> Float[np.ndarray, " samples"]:
        """Mechanical advantage at the samples of `motion`: the effort at an output by that at the input."""
        return mechanical_advantage(self.moved, self.output(output), self.values)

    def coupler_curve(self, point: str) -> CouplerCurve:
        """The curve of a point, "body.point": length, cusps, crossings, inflections, straights, curvature."""
        body, _, name = point.partition(".")
        self.mechanism.point(body, name)
        return coupler_curve(InputPath(self.moved, *self.inside), body, name)

    @cached_property
    def dimensions(self) -> tuple[Dimension, ...]:
        """The dimensions as on a drawing: lengths between the points of each body, and directions of slides."""
        return link_dimensions(self.mechanism)

    def sensitivity(self, output: str) -> Derivatives:
        """Exact derivatives of an output by `dimensions` at the samples of `motion`."""
        return derivatives(self.motion, self.output(output), self.dimensions)

    def tolerance(self, output: str, length: float, angle: float = 0.0) -> OutputTolerance:
        """Error of an output at the samples of `motion`, all lengths +-length [m] and all directions +-angle [rad]."""
        allowed = [length if dimension.length else angle for dimension in self.dimensions]
        return spread(self.sensitivity(output).value, allowed)

    @cached_property
    def values(self) -> Float[np.ndarray, " samples"]:
        """Values of the input at the samples of `motion` [rad, m]."""
        return np.linspace(*self.inside, SAMPLES)

    @cached_property
    def inside(self) -> tuple[float, float]:
        """The range without its ends, where the input is at a dead centre; a full turn has none."""
        first, last = self.range
        edge = 0.0 if self.turns else EDGE * (last - first)
        return first + edge, last - edge
