"""Tracing of a mechanism's configuration curve from one configuration until it closes, or until the input reverses.

Predictor along the tangent, corrector normal to it; the step length follows the rotation of the tangent and the
distance to the corrected point. [Allgower, Georg: Numerical Continuation Methods, chapter 6.]
"""

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.configuration import Configurations, FreeInput
from ilmek.num.brackets import bracketed_minima, bracketed_roots
from ilmek.records import record

TURN = 0.3
"""Greatest rotation of the tangent in a step [rad], and greatest correction relative to the step; after a step with
less than half of it the step grows."""

LONGEST, SHORTEST = 0.4, 1e-7
"""Bounds of a step, relative to the mechanism's size."""

ACROSS = 0.01
"""Step across a crossing of two curves, relative to the mechanism's size."""

STEPS = 2_000
"""Number of steps after which a curve counts as open: a closed one takes about 100."""

DIP_STEPS = 24
"""Steps of the search for the least component of a tangent between two nodes."""

REACH = 100.0
"""Distance from the origin, relative to the mechanism's size, beyond which a curve counts as unbounded."""


@record
class ConfigurationCurve:
    """A configuration curve: nodes on it, their unit tangents, and path lengths from the first [m], by chords.

    crossings  values of the input [rad, m] at which another curve crosses
    seed       index of the node from which it was followed
    """

    free_input: FreeInput
    at_nodes: Configurations
    tangents: Float[np.ndarray, "nodes unknowns"]
    lengths: Float[np.ndarray, " nodes"]
    closed: bool
    crossings: tuple[float, ...]
    seed: int = 0

    def at(self, lengths: FloatArray) -> tuple[Configurations, FloatArray, FloatArray]:
        """Exact configurations at path lengths [m], periodic on a closed curve.

        Also the unit tangents, and the directions in which the lengths are measured (the tangents of the last nodes).
        """
        lengths = np.atleast_1d(np.asarray(lengths, dtype=float))
        if self.closed:
            lengths = np.where(lengths == self.lengths[-1], lengths, np.mod(lengths, self.lengths[-1]))
        node = np.clip(np.searchsorted(self.lengths, lengths, side="right") - 1, 0, len(self.lengths) - 2)
        return self._from(lengths, node)

    def folds(self) -> Float[np.ndarray, " folds"]:
        """Path lengths [m] at which the input reverses, ascending: the tangent has no component along it."""
        low, high, node = self._reversals()
        if not len(node):
            return np.empty(0)
        return np.sort(bracketed_roots(lambda lengths: self._from(lengths, node)[1][:, -1], low, high))

    def _reversals(self) -> tuple[FloatArray, FloatArray, np.ndarray]:
        """Brackets of the folds, by path length, and the nodes before them.

        Two folds between neighbouring nodes are possible only where the tangent turns as far as to the reversal and
        back, next to the least component along the input; such intervals are divided at it.
        """
        part = self.tangents[:, -1]
        (single,) = np.nonzero(np.sign(part[:-1]) * np.sign(part[1:]) < 0)
        low, high = self.lengths[:-1], self.lengths[1:]
        bends = np.arccos(np.clip(np.sum(self.tangents[:-1] * self.tangents[1:], axis=1), -1, 1))
        size = np.abs(part)
        around = np.append(np.inf, size[:-2]) >= size[:-1], np.append(size[2:], np.inf) >= size[1:]
        dips = (part[:-1] * part[1:] > 0) & (size[:-1] + size[1:] < 2 * bends) & around[0] & around[1]
        (double,) = np.nonzero(dips)
        if not len(double):
            return low[single], high[single], single
        sign = np.sign(part[double])
        least, found = bracketed_minima(
            lambda lengths: sign * self._from(lengths, double)[1][:, -1], low[double], high[double], steps=DIP_STEPS
        )
        least, double = least[found < 0], double[found < 0]
        node = np.concatenate([single, double, double])
        return (
            np.concatenate([low[single], low[double], least]),
            np.concatenate([high[single], least, high[double]]),
            node,
        )

    def _from(self, lengths: FloatArray, node: np.ndarray) -> tuple[Configurations, FloatArray, FloatArray]:
        """`at` from given nodes."""
        across = self.tangents[node]
        near = self.free_input.stepped(self.at_nodes[node], across * (lengths - self.lengths[node])[:, None])
        configurations = self.free_input.corrected(near, across)
        return configurations, self.free_input.tangents(configurations, across), across


def trace(
    free_input: FreeInput, seed: Configurations, *, branch: bool = False, furthest: float = np.inf
) -> ConfigurationCurve:
    """The curve through a configuration, followed until it closes, or to both ends outside the reach.

    branch    it ends just beyond the first reversal of the input on either side
    furthest  distance of the input from its first value [rad, m] at which it ends too
    """
    ahead = np.zeros((1, 3 * len(free_input.mechanism.moving) + 1))
    ahead[0, -1] = 1.0
    first = free_input.tangents(seed, ahead)
    nodes, tangents, closed, crossings = _followed(free_input, seed, first, branch, furthest)
    start = 0
    if not closed:
        back, against, _, further = _followed(free_input, seed, -first, branch, furthest)
        crossings += further
        start = len(back) - 1
        nodes, tangents = back[:0:-1] + nodes, [-t for t in against[:0:-1]] + tangents
    at_nodes = Configurations(
        np.concatenate([node.origins for node in nodes]),
        np.concatenate([node.directions for node in nodes]),
        np.concatenate([node.inputs for node in nodes]),
    )
    stacked = np.concatenate(tangents)
    along = np.sum(free_input.chords(at_nodes) * stacked[:-1], axis=1)
    lengths = np.concatenate([[0.0], np.cumsum(along)])
    return ConfigurationCurve(free_input, at_nodes, stacked, lengths, closed, tuple(crossings), start)


def _followed(
    free_input: FreeInput, seed: Configurations, first: FloatArray, branch: bool, furthest: float
) -> tuple[list[Configurations], list[FloatArray], bool, list[float]]:
    """Nodes and tangents from the seed on, the seed repeated at the end if the curve closes; inputs at crossings.

    A step over which det [A; t] changes its sign has jumped to a neighbouring curve and is shortened; if the shortest
    step still changes it, the curves cross.
    """
    nodes, tangents, crossings = [seed], [first], list[float]()
    began = side = free_input.oriented(seed, first)[1]
    step, travelled = 0.2 * LONGEST * free_input.size, 0.0
    for _ in range(STEPS):
        at, t = nodes[-1], tangents[-1]
        home = free_input.between(at, seed)
        if travelled > 3 * step and side == began and _is_home(home, t, first, step):
            end = Configurations(seed.origins, seed.directions, at.inputs + _input_left(free_input, at, seed))
            return [*nodes, end], [*tangents, first], True, crossings
        new, new_t, new_side, bend = _step(free_input, at, t, step)
        if not (bend <= TURN and new_side == side):
            if step > SHORTEST * free_input.size:
                step *= 0.5
                continue
            crossings.append(float(at.inputs[0]))
            step = ACROSS * free_input.size
            new, new_t, side, _ = _step(free_input, at, t, step)
        if not np.isfinite(new_t).all() or np.max(np.abs(new.origins)) > REACH * free_input.size:
            break
        travelled += step
        nodes.append(new)
        tangents.append(new_t)
        reversed_ = branch and new_t[0, -1] * first[0, -1] < 0
        if reversed_ or abs(new.inputs[0] - seed.inputs[0]) > furthest:
            break
        step = min(step * (1.6 if bend < 0.5 * TURN else 1.0), LONGEST * free_input.size)
    return nodes, tangents, False, crossings


def _step(
    free_input: FreeInput, at: Configurations, t: FloatArray, step: float
) -> tuple[Configurations, FloatArray, FloatArray, float]:
    """The next configuration, its tangent, its sign of det [A; t], and the bend of the curve over the step.

    The bend is the rotation of the tangent [rad], or the correction relative to the step if that is larger.
    """
    expected = free_input.stepped(at, step * t)
    new = free_input.corrected(expected, t)
    new_t, side = free_input.oriented(new, t)
    turned = float(np.arccos(np.clip(np.sum(t * new_t), -1, 1)))
    aside = float(np.linalg.norm(free_input.between(expected, new))) / step
    return new, new_t, side, max(turned, aside)


def _is_home(home: FloatArray, t: FloatArray, first: FloatArray, step: float) -> bool:
    """Whether the seed is the next node: within a step, ahead, near the tangent, with the same direction."""
    shadow = float(np.sum(home[:, :-1] * t[:, :-1]))
    own = float(np.sum(t[:, :-1] ** 2))
    aside = float(np.linalg.norm(home[:, :-1] - t[:, :-1] * (shadow / max(own, 1e-12))))
    far = float(np.linalg.norm(home[:, :-1]))
    return far <= 1.05 * step and shadow >= 0 and aside <= 2 * TURN * max(far, 1e-12) and float(np.sum(t * first)) > 0.9


def _input_left(free_input: FreeInput, at: Configurations, seed: Configurations) -> FloatArray:
    """Difference of the input to the seed's value, modulo whole turns."""
    left = seed.inputs - at.inputs
    shortest: FloatArray = (left + np.pi) % (2 * np.pi) - np.pi if free_input.turns else left
    return shortest
