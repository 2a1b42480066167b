"""Following a mechanism's configuration curve from one configuration until it closes.

Predictor along the tangent, corrector square to it; the step is fitted to how far the tangent turns.
[Allgower, Georg: Numerical Continuation Methods, chapter 6.]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.linkage.configuration import Configurations, FreeInput
from ilmek.num.brackets import bracketed_roots

TURN = 0.3
"""Most that the tangent may turn in a step [rad]; a step that turns it less than half is followed by a longer one."""

LONGEST, SHORTEST = 0.4, 1e-7
"""Bounds of a step, of the mechanism's size."""

ACROSS = 0.01
"""Step with which a crossing of two curves is passed, of the mechanism's size."""

STEPS = 20_000
"""Steps after which a curve is given up as open."""

REACH = 100.0
"""Distance from the origin, of the mechanism's size, at which a curve is taken to run to infinity."""


@dataclass(frozen=True, slots=True)
class ConfigurationCurve:
    """A configuration curve: nodes on it, their unit tangents, and lengths from the first (measured by the chords).

    crossings  values of the input at which another curve is crossed
    """

    freed: FreeInput
    at_nodes: Configurations
    tangents: Float[np.ndarray, "nodes unknowns"]
    lengths: Float[np.ndarray, " nodes"]
    closed: bool
    crossings: tuple[float, ...]

    def at(self, places: FloatArray) -> tuple[Configurations, FloatArray, FloatArray]:
        """Exact configurations at places along the curve, taken round if it is closed.

        With them, the unit tangents there, and the directions along which the places are measured (the last node's).
        """
        places = np.atleast_1d(np.asarray(places, dtype=float))
        if self.closed:
            places = np.where(places == self.lengths[-1], places, np.mod(places, self.lengths[-1]))
        node = np.clip(np.searchsorted(self.lengths, places, side="right") - 1, 0, len(self.lengths) - 2)
        return self._from(places, node)

    def folds(self) -> Float[np.ndarray, " folds"]:
        """Places at which the input turns back: where the tangent has no part along it."""
        part = self.tangents[:, -1]
        (changed,) = np.nonzero(np.sign(part[:-1]) * np.sign(part[1:]) < 0)
        if not len(changed):
            return np.empty(0)

        def along_input(places: FloatArray) -> FloatArray:
            along: FloatArray = self._from(places, changed)[1][:, -1]
            return along

        return bracketed_roots(along_input, self.lengths[changed], self.lengths[changed + 1])

    def _from(self, places: FloatArray, node: np.ndarray) -> tuple[Configurations, FloatArray, FloatArray]:
        """As `at`, from given nodes."""
        across = self.tangents[node]
        near = self.freed.stepped(self.at_nodes[node], across * (places - self.lengths[node])[:, None])
        found = self.freed.corrected(near, across)
        return found, self.freed.tangents(found, across), across


def trace(freed: FreeInput, seed: Configurations) -> ConfigurationCurve:
    """The curve through a configuration: followed until it closes; else to both ends, where it leaves the reach."""
    ahead = np.zeros((1, 3 * len(freed.moved.plan.mechanism.moving) + 1))
    ahead[0, -1] = 1.0
    first = freed.tangents(seed, ahead)
    nodes, tangents, closed, crossings = _followed(freed, seed, first)
    if not closed:
        back, against, _, further = _followed(freed, seed, -first)
        crossings += further
        nodes, tangents = back[:0:-1] + nodes, [-t for t in against[:0:-1]] + tangents
    at_nodes = Configurations(
        np.concatenate([one.origins for one in nodes]),
        np.concatenate([one.directions for one in nodes]),
        np.concatenate([one.inputs for one in nodes]),
    )
    stacked = np.concatenate(tangents)
    chords = freed.between(at_nodes[:-1], at_nodes[1:])
    chords[:, -1] = np.diff(at_nodes.inputs) * freed.per_input
    along = np.sum(chords * stacked[:-1], axis=1)
    lengths = np.concatenate([[0.0], np.cumsum(along)])
    return ConfigurationCurve(freed, at_nodes, stacked, lengths, closed, tuple(crossings))


def _followed(
    freed: FreeInput, seed: Configurations, first: FloatArray
) -> tuple[list[Configurations], list[FloatArray], bool, list[float]]:
    """Nodes and tangents from the seed on, the seed repeated at the end if the curve closes; inputs at crossings.

    A step over which det [A; t] changes its sign has gone from one of two near curves to the other, and is shortened;
    where the shortest still does, they cross.
    """
    nodes, tangents, crossings = [seed], [first], list[float]()
    began = side = freed.oriented(seed, first)[1]
    step, gone = 0.2 * LONGEST * freed.size, 0.0
    for _ in range(STEPS):
        at, t = nodes[-1], tangents[-1]
        home = freed.between(at, seed)
        if gone > 3 * step and side == began and _is_home(home, t, first, step):
            end = Configurations(seed.origins, seed.directions, at.inputs + _input_left(freed, at, seed))
            return [*nodes, end], [*tangents, first], True, crossings
        new, new_t, new_side = _step(freed, at, t, step)
        bend = float(np.arccos(np.clip(np.sum(t * new_t), -1, 1)))
        if not (bend <= TURN and new_side == side):
            if step > SHORTEST * freed.size:
                step *= 0.5
                continue
            crossings.append(float(at.inputs[0]))
            step = ACROSS * freed.size
            new, new_t, side = _step(freed, at, t, step)
        if not np.isfinite(new_t).all() or np.max(np.abs(new.origins)) > REACH * freed.size:
            break
        gone += step
        nodes.append(new)
        tangents.append(new_t)
        step = min(step * (1.6 if bend < 0.5 * TURN else 1.0), LONGEST * freed.size)
    return nodes, tangents, False, crossings


def _step(
    freed: FreeInput, at: Configurations, t: FloatArray, step: float
) -> tuple[Configurations, FloatArray, FloatArray]:
    """The configuration a step on, its tangent, and the sign of det [A; t] there."""
    new = freed.corrected(freed.stepped(at, step * t), t)
    return new, *freed.oriented(new, t)


def _is_home(home: FloatArray, t: FloatArray, first: FloatArray, step: float) -> bool:
    """Whether the seed is the next node: within a step, ahead, on the tangent but for its bend, passed the same way."""
    shadow = float(np.sum(home[:, :-1] * t[:, :-1]))
    own = float(np.sum(t[:, :-1] ** 2))
    aside = float(np.linalg.norm(home[:, :-1] - t[:, :-1] * (shadow / max(own, 1e-12))))
    far = float(np.linalg.norm(home[:, :-1]))
    return far <= 1.05 * step and shadow >= 0 and aside <= 2 * TURN * max(far, 1e-12) and float(np.sum(t * first)) > 0.9


def _input_left(freed: FreeInput, at: Configurations, seed: Configurations) -> FloatArray:
    """What the input has still to go to the seed's value, up to whole turns."""
    left = seed.inputs - at.inputs
    shortest: FloatArray = (left + np.pi) % (2 * np.pi) - np.pi if freed.moved.turns else left
    return shortest
