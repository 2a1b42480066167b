"""Circuits and branches: all ways in which a mechanism goes together, and how far its input can move in each.

A circuit is a connected part of the configuration curve (see `configuration`): what can be reached without taking the
mechanism apart. Where its input turns back (a dead centre of the input, links in line) one branch ends and another
begins. The curve is followed through these points by its length, so that the ends of the input's range are found as
simple roots, to rounding. Every assembly that the closed forms give, and that which a pose gives to Newton's method,
is on one of the circuits.
[Chase, Mirth: Circuits and Branches of Single-Degree-of-Freedom Planar Linkages, 1993: the definitions.]
"""

import dataclasses
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.configuration import Configurations, FreeInput, freed
from ilmek.linkage.model import Mechanism
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.outputs import Output, followed_bodies
from ilmek.linkage.structure import plan
from ilmek.linkage.tracing import ConfigurationCurve, trace
from ilmek.num.piecewise import roots

SEEDS = 180
"""Values of the input, over a turn or the mechanism's reach, at which assemblies are looked for."""

ASIDE = 0.382
"""Where within a run of them the tracing starts: not in the middle, which crossings of curves like for symmetry."""

SAME = 1e-6
"""Distance of two configurations, of the mechanism's size, below which they are one."""


@dataclass(frozen=True, slots=True)
class Branch:
    """A part of a circuit between two dead centres of the input.

    start, stop  least and greatest value of the input [rad, m], start within (-pi, pi]; a turn apart if it turns fully
    branches     signs of the closed forms along it, as a Mechanism takes them; {} where none of them gives it
    full         the input turns fully: the branch has no ends
    """

    start: float
    stop: float
    branches: Mapping[str, int]
    full: bool = False


@dataclass(frozen=True, slots=True)
class Circuit:
    """A closed way through configurations: its branches in the order in which they are passed; a `ConfigurationPath`.

    dead_centres  values of the input [rad, m] at which it turns back, in order      turns  of the input, all round
    crossings     values of the input at which another circuit is crossed: a change point, the motion uncertain there
    closed        False where the way runs out of the mechanism's reach, or beyond the steps allowed
    """

    branches: tuple[Branch, ...]
    dead_centres: tuple[float, ...]
    crossings: tuple[float, ...]
    turns: int
    freed: FreeInput
    trace: ConfigurationCurve

    @property
    def closed(self) -> bool:
        """Whether the way comes back to where it began."""
        return self.trace.closed

    @property
    def mechanism(self) -> Mechanism:
        """What moves."""
        return self.freed.moved.plan.mechanism

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Places of the nodes, from 0 to the length of the whole by its chords [m, scaled turns among them]."""
        return self.trace.lengths

    @property
    def stop(self) -> float:
        """The last place."""
        return float(self.trace.lengths[-1])

    def bodies(self, lengths: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body at places along the circuit, with its rates by the place."""
        return self.freed.moving(*self.trace.at(lengths))

    def inputs(self, lengths: FloatArray) -> FloatArray:
        """Values of the input at places along the circuit [rad, m]."""
        return self.trace.at(lengths)[0].inputs

    def toggles(self, output: Output) -> tuple[tuple[float, float], ...]:
        """Where an output turns back along the circuit: (input, output) at each, in order; its limit positions.

        Unlike `extremes` it sees those on all branches, and those at the dead centres of the input.
        """

        def rate(lengths: FloatArray) -> FloatArray:
            return followed_bodies(self.mechanism, self.bodies(lengths), output).rate

        at = roots(rate, self.trace.lengths)
        if not len(at):
            return ()
        reached = followed_bodies(self.mechanism, self.bodies(at), output).value
        return tuple(zip(self.inputs(at).tolist(), reached.tolist(), strict=True))


def circuits(moved: OneInput, *, seeds: int = SEEDS) -> tuple[Circuit, ...]:
    """All circuits of a mechanism over one of its inputs; none where it closes nowhere.

    Every combination of the closed forms' signs is tried at `seeds` values of the input; a circuit whose whole range
    lies between two of these is not seen. Groups left to Newton's method are followed from the pose given only.

    >>> import math
    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> found = circuits(one_input(plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1))))
    >>> len(found), [round(math.degrees(angle), 3) for angle in found[0].dead_centres]
    (1, [117.226, -117.226])
    """
    found: list[Circuit] = []
    ways = list(_assemblies(moved))
    for way in ways:
        for seed in _seeds(way, seeds):
            if not any(_passes(circuit, seed) for circuit in found):
                found.append(_circuit(way, seed, ways))
    return tuple(found)


def assembly_ranges(moved: OneInput, *, seeds: int = SEEDS) -> tuple[tuple[float, float], ...]:
    """Intervals of the input in which the mechanism closes with the branches that it has, ascending; (-pi, pi) if all.

    The ends are dead centres of the input, exact to rounding. See `circuits` for what is looked at.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> assembly_ranges(one_input(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))))
    ((-3.141592653589793, 3.141592653589793),)
    """
    own = dict(moved.plan.mechanism.branches)
    parts = [part for circuit in circuits(moved, seeds=seeds) for part in circuit.branches if part.branches == own]
    return tuple(sorted((part.start, part.stop) for part in parts))


def _assemblies(moved: OneInput) -> Iterator[OneInput]:
    """The mechanism with every combination of signs of its branches."""
    mechanism = moved.plan.mechanism
    for signs in product((+1, -1), repeat=len(mechanism.branches)):
        branches = dict(zip(mechanism.branches, signs, strict=True))
        yield OneInput(plan(dataclasses.replace(mechanism, branches=branches)), moved.name, moved.held)


def _seeds(way: OneInput, count: int) -> Iterator[Configurations]:
    """One configuration of each run of input values at which an assembly closes."""
    free = freed(way)
    if way.turns:
        values = -np.pi + (np.arange(count) + 0.5) * (2 * np.pi / count)
    else:
        reach = sum(abs(point) for body in way.plan.mechanism.bodies for point in body.points.values())
        values = np.linspace(-reach, reach, 4 * count)
    (closing,) = np.nonzero(way.motion(values).status == 0)
    runs = np.split(closing, np.flatnonzero(np.diff(closing) > 1) + 1) if len(closing) else []
    for run in runs:
        yield free.posed(values[run[int(ASIDE * len(run)) :][:1]])


def _passes(circuit: Circuit, seed: Configurations) -> bool:
    """Whether a configuration lies on a circuit: from the circuit's nearest node, it is where the curve leads."""
    free, line = circuit.freed, circuit.trace
    everywhere = Configurations(*(np.broadcast_to(part, shape) for part, shape in _spread(seed, len(line.at_nodes))))
    apart = free.between(line.at_nodes, everywhere)
    node = int(np.argmin(np.max(np.abs(apart), axis=1)))
    place = line.lengths[node] + np.sum(apart[node] * line.tangents[node]) * _stretch(line.tangents[node])
    near, *_ = line.at(np.clip(np.array([place]), line.lengths[0], line.lengths[-1]))
    for _ in range(4):  # the place along the curve by its shadow on the tangent
        t = free.tangents(near, line.tangents[node][None])
        place += float(np.sum(free.between(near, seed) * t) * _stretch(t[0]))
        near, *_ = line.at(np.clip(np.array([place]), line.lengths[0], line.lengths[-1]))
    return bool(np.max(np.abs(free.between(near, seed))) <= SAME * free.size)


def _stretch(tangent: FloatArray) -> float:
    """Length along the curve for a way measured without the input's part."""
    return float(1 / max(np.sum(tangent[:-1] ** 2), 1e-12))


def _spread(seed: Configurations, rows: int) -> list[tuple[np.ndarray, tuple[int, ...]]]:
    parts = (seed.origins, seed.directions, seed.inputs)
    return [(part, (rows, *part.shape[1:])) for part in parts]


def _circuit(way: OneInput, seed: Configurations, ways: list[OneInput]) -> Circuit:
    """The circuit through a configuration."""
    free = freed(way)
    line = trace(free, seed)
    folds = line.folds()
    turns = round(float(line.at_nodes.inputs[-1] - line.at_nodes.inputs[0]) / (2 * np.pi)) if way.turns else 0
    inputs = line.at(folds)[0].inputs if len(folds) else np.empty(0)
    parts = _parts(free, line, folds, inputs, ways)
    shown = tuple(_principal(value, way.turns) for value in inputs)
    crossings = tuple(_principal(value, way.turns) for value in line.crossings)
    return Circuit(parts, shown, crossings, abs(turns), free, line)


def _parts(
    free: FreeInput,
    line: ConfigurationCurve,
    folds: Float[np.ndarray, " folds"],
    inputs: FloatArray,
    ways: list[OneInput],
) -> tuple[Branch, ...]:
    """The branches between the folds; the whole, where there are none."""
    end = float(line.lengths[-1])
    if not len(folds):
        first, last = float(line.at_nodes.inputs[0]), float(line.at_nodes.inputs[-1])
        if free.moved.turns and line.closed:
            first, last = -np.pi, np.pi
        label = _label(free, line.at(np.array([0.5 * end]))[0], ways)
        return (Branch(min(first, last), max(first, last), label, full=line.closed),)
    if line.closed:
        turned = line.at_nodes.inputs[-1] - line.at_nodes.inputs[0]
        bounds, values = np.append(folds, folds[0] + end), np.append(inputs, inputs[0] + turned)
    else:
        bounds = np.concatenate([[0.0], folds, [end]])
        values = line.at(bounds)[0].inputs
    middles = 0.5 * (bounds[:-1] + bounds[1:])  # beyond the end: taken round
    found = []
    for k, middle in enumerate(middles):
        low, high = sorted((float(values[k]), float(values[k + 1])))
        shift = _principal(low, free.moved.turns) - low
        label = _label(free, line.at(np.array([middle]))[0], ways)
        found.append(Branch(low + shift, high + shift, label))
    return tuple(found)


def _label(free: FreeInput, at: Configurations, ways: list[OneInput]) -> Mapping[str, int]:
    """The signs under which the closed forms give a configuration."""
    for way in ways:
        given = freed(way).posed(at.inputs)
        if np.max(np.abs(free.between(at, given))) <= SAME * free.size:
            return dict(way.plan.mechanism.branches)
    return {}


def _principal(value: float, turns: bool) -> float:
    """An angle in (-pi, pi]; a length as it is."""
    return float(-((np.pi - value) % (2 * np.pi)) + np.pi) if turns else float(value)
