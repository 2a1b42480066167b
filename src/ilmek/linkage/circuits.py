"""Circuits and branches: all assemblies of a mechanism, and the range of its input in each.

A circuit is a connected part of the configuration curve (see `configuration`): the configurations within reach without
disassembly. Where the input reverses (a dead centre of the input, links in line) one branch ends and another begins.
The curve is followed through these points by its length, so that the ends of the input's range are simple roots, found
to rounding. Every assembly of the closed forms, and the assembly of a pose for Newton's method, is on one circuit.
[Chase, Mirth: Circuits and Branches of Single-Degree-of-Freedom Planar Linkages, 1993: the definitions.]
"""

import dataclasses
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.configuration import Configurations, FreeInput, free_input
from ilmek.linkage.model import Mechanism
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.outputs import Output, output_history_of_bodies
from ilmek.linkage.structure import plan
from ilmek.linkage.tracing import ConfigurationCurve, trace
from ilmek.num.piecewise import roots
from ilmek.records import record

SEEDS = 180
"""Values of the input, over a turn or the mechanism's reach, at which assemblies are sought."""

ASIDE = 0.382
"""Start of the tracing within a run of closing values; not the middle, where symmetric curves often cross."""

SAME = 1e-6
"""Greatest distance of equal configurations, relative to the mechanism's size."""


@record
class Branch:
    """A part of a circuit between two dead centres of the input.

    start, stop  least and greatest value of the input [rad, m], start within (-pi, pi]; a turn apart if it turns fully
    branches     signs of the closed forms along it, in the form of `Mechanism.branches`; {} where no closed form has it
    full         the input turns fully: the branch has no ends
    """

    start: float
    stop: float
    branches: Mapping[str, int]
    full: bool = False


@dataclass(frozen=True, slots=True)
class Circuit:
    """A closed path of configurations with its branches in order; a `ConfigurationPath`.

    dead_centres  values of the input [rad, m] at which it reverses, in order      turns  of the input per circuit
    crossings     values of the input at which another circuit crosses: a change point, where the motion is uncertain
    closed        False where the path leaves the mechanism's reach, or exceeds the allowed number of steps
    """

    branches: tuple[Branch, ...]
    dead_centres: tuple[float, ...]
    crossings: tuple[float, ...]
    turns: int
    free_input: FreeInput
    trace: ConfigurationCurve

    @property
    def closed(self) -> bool:
        """Whether the path returns to its start."""
        return self.trace.closed

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
        return self.free_input.mechanism

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Path lengths of the nodes from 0 to the whole, by chords [m]; rotations are scaled to lengths."""
        return self.trace.lengths

    @property
    def stop(self) -> float:
        """Length of the whole path [m]."""
        return float(self.trace.lengths[-1])

    def bodies(self, lengths: FloatArray) -> Mapping[str, BodyMotion]:
        """Every body at path lengths [m], with its rates by the path length."""
        return self.free_input.moving(*self.trace.at(lengths))

    def inputs(self, lengths: FloatArray) -> FloatArray:
        """Values of the input [rad, m] at path lengths [m]."""
        return self.trace.at(lengths)[0].inputs

    def toggles(self, output: Output) -> tuple[tuple[float, float], ...]:
        """Limit positions of an output along the circuit: (input, output) [rad, m] of each, in order.

        Unlike `extremes`, on all branches and at the dead centres of the input too.
        """

        def rate(lengths: FloatArray) -> FloatArray:
            return output_history_of_bodies(self.mechanism, self.bodies(lengths), output).rate

        at = roots(rate, self.trace.lengths)
        if not len(at):
            return ()
        reached = output_history_of_bodies(self.mechanism, self.bodies(at), output).value
        return tuple(zip(self.inputs(at).tolist(), reached.tolist(), strict=True))


def circuits(moved: OneInput, *, seeds: int = SEEDS) -> tuple[Circuit, ...]:
    """All circuits of a mechanism over one of its inputs; () where it closes nowhere.

    Every combination of the closed forms' signs is tried at `seeds` values of the input; a circuit with its whole range
    between two of these is not found. Groups for Newton's method are followed from the mechanism's pose only.

    >>> import math
    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> found = circuits(one_input(plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1))))
    >>> len(found), [round(math.degrees(angle), 3) for angle in found[0].dead_centres]
    (1, [117.226, -117.226])
    """
    circuits: list[Circuit] = []
    assemblies = list(_assemblies(moved))
    for assembly in assemblies:
        for seed in _seeds(assembly, seeds):
            if not any(_passes(circuit, seed) for circuit in circuits):
                circuits.append(_circuit(assembly, seed, assemblies))
    return tuple(circuits)


def assembly_ranges(moved: OneInput, *, seeds: int = SEEDS) -> tuple[tuple[float, float], ...]:
    """Intervals of the input [rad, m] in which the mechanism closes with its branches, ascending; (-pi, pi) if all.

    The ends are dead centres of the input, exact to rounding. See `circuits` for the limits of the search.

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
        yield OneInput(plan(dataclasses.replace(mechanism, branches=branches)), moved.name, moved.locked)


def _seeds(assembly: OneInput, count: int) -> Iterator[Configurations]:
    """One configuration in each run of input values at which an assembly closes."""
    if assembly.turns:
        values = -np.pi + (np.arange(count) + 0.5) * (2 * np.pi / count)
    else:
        reach = sum(abs(point) for body in assembly.plan.mechanism.bodies for point in body.points.values())
        values = np.linspace(-reach, reach, 4 * count)
    (closing,) = np.nonzero(assembly.motion(values).status == 0)
    runs = np.split(closing, np.flatnonzero(np.diff(closing) > 1) + 1) if len(closing) else []
    for run in runs:
        yield _posed(assembly, values[run[int(ASIDE * len(run)) :][:1]])


def _posed(assembly: OneInput, values: FloatArray) -> Configurations:
    """The configurations of an assembly at values of the input [rad, m], (rows,)."""
    motion = assembly.motion(values)
    names = assembly.plan.mechanism.moving
    origins = np.stack([motion.origin(name) for name in names], axis=-1)
    directions = np.stack([motion.direction(name) for name in names], axis=-1)
    return Configurations(origins, directions, np.asarray(values, dtype=float))


def _passes(circuit: Circuit, seed: Configurations) -> bool:
    """Whether a configuration lies on a circuit: on the curve near the circuit's nearest node."""
    free, line = circuit.free_input, circuit.trace
    everywhere = Configurations(*(np.broadcast_to(part, shape) for part, shape in _spread(seed, len(line.at_nodes))))
    apart = free.between(line.at_nodes, everywhere)
    node = int(np.argmin(np.max(np.abs(apart), axis=1)))
    length = line.lengths[node] + np.sum(apart[node] * line.tangents[node]) * _stretch(line.tangents[node])
    nearest, *_ = line.at(np.clip(np.array([length]), line.lengths[0], line.lengths[-1]))
    for _ in range(4):  # the path length by projection on the tangent
        t = free.tangents(nearest, line.tangents[node][None])
        length += float(np.sum(free.between(nearest, seed) * t) * _stretch(t[0]))
        nearest, *_ = line.at(np.clip(np.array([length]), line.lengths[0], line.lengths[-1]))
    return bool(np.max(np.abs(free.between(nearest, seed))) <= SAME * free.size)


def _stretch(tangent: FloatArray) -> float:
    """Ratio of the length along the curve to the length without the input's component."""
    return float(1 / max(np.sum(tangent[:-1] ** 2), 1e-12))


def _spread(seed: Configurations, rows: int) -> list[tuple[np.ndarray, tuple[int, ...]]]:
    parts = (seed.origins, seed.directions, seed.inputs)
    return [(part, (rows, *part.shape[1:])) for part in parts]


def _circuit(assembly: OneInput, seed: Configurations, assemblies: list[OneInput]) -> Circuit:
    """The circuit through a configuration."""
    free = free_input(assembly.plan.mechanism, assembly.name, assembly.locked)
    line = trace(free, seed)
    folds = line.folds()
    turns = round(float(line.at_nodes.inputs[-1] - line.at_nodes.inputs[0]) / (2 * np.pi)) if assembly.turns else 0
    inputs = line.at(folds)[0].inputs if len(folds) else np.empty(0)
    parts = _parts(free, line, folds, inputs, assemblies)
    shown = tuple(_principal(value, assembly.turns) for value in inputs)
    crossings = tuple(_principal(value, assembly.turns) for value in line.crossings)
    return Circuit(parts, shown, crossings, abs(turns), free, line)


def _parts(
    free: FreeInput,
    line: ConfigurationCurve,
    folds: Float[np.ndarray, " folds"],
    inputs: FloatArray,
    assemblies: list[OneInput],
) -> tuple[Branch, ...]:
    """The branches between the folds; one branch without folds."""
    end = float(line.lengths[-1])
    if not len(folds):
        first, last = float(line.at_nodes.inputs[0]), float(line.at_nodes.inputs[-1])
        if free.turns and line.closed:
            first, last = -np.pi, np.pi
        label = _label(free, line.at(np.array([0.5 * end]))[0], assemblies)
        return (Branch(min(first, last), max(first, last), label, full=line.closed),)
    if line.closed:
        turned = line.at_nodes.inputs[-1] - line.at_nodes.inputs[0]
        bounds, values = np.append(folds, folds[0] + end), np.append(inputs, inputs[0] + turned)
    else:
        bounds = np.concatenate([[0.0], folds, [end]])
        values = line.at(bounds)[0].inputs
    middles = 0.5 * (bounds[:-1] + bounds[1:])  # beyond the end: periodic
    parts = []
    for k, middle in enumerate(middles):
        low, high = sorted((float(values[k]), float(values[k + 1])))
        shift = _principal(low, free.turns) - low
        label = _label(free, line.at(np.array([middle]))[0], assemblies)
        parts.append(Branch(low + shift, high + shift, label))
    return tuple(parts)


def _label(free: FreeInput, at: Configurations, assemblies: list[OneInput]) -> Mapping[str, int]:
    """The signs of the closed forms of a configuration; {} for none."""
    for assembly in assemblies:
        given = _posed(assembly, at.inputs)
        if np.max(np.abs(free.between(at, given))) <= SAME * free.size:
            return dict(assembly.plan.mechanism.branches)
    return {}


def _principal(value: float, turns: bool) -> float:
    """An angle in (-pi, pi]; a length as it is."""
    return float(-((np.pi - value) % (2 * np.pi)) + np.pi) if turns else float(value)
