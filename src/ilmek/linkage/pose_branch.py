"""The branch of a group without a closed form: the part of the configuration curve that contains the pose.

Definition: the mechanism's pose is assembled at the input's value that it shows (`initial_pose`). The configuration
curve is followed from there by its length in both directions, up to the dead centres of the input, where the input
reverses and det J = 0. This part is the branch: every value of the input between its two ends has one configuration
on it, whatever the order, the number or the steps of the required values. A value beyond them is reduced by whole turns
of the input where that leads to the branch (350 deg = -10 deg); if the input turns fully, the branch has no ends.

Several inputs: the others are moved first, from their values in the pose straight to those at which they are held.
Several such groups, and closed forms before and between them, have one branch together, the closed forms with their
given signs. Where another curve crosses (a change point) the branch goes straight on; it ends there if a closed form
would change its sign.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, IntArray
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.configuration import Configurations, FreeInput, free_input
from ilmek.linkage.initial_pose import assembled, configuration, inputs_in_pose, newton_steps, on_branches, straight
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.linkage.structure import Plan
from ilmek.linkage.tracing import ConfigurationCurve, trace
from ilmek.records import record
from ilmek.units import format_quantity, turn

LEAST_TURNS, MOST_TURNS = 2.0, 32.0
"""Turns of the input from the pose in either direction up to which a branch is followed: at first, and at most."""

PERIODS = 64
"""Largest number of turns of the input after which a geared mechanism is sought to be the same again."""

CLOSER = 0.5 ** np.arange(1, 31)
"""Nodes next to a dead centre, relative to the distance of the next node; the last at rounding."""

BISECTIONS = 60
"""Halvings in the search for the position between two nodes."""

SAME_EQUATIONS = 1e-9
"""Greatest difference of equal equations, relative to the mechanism's size."""

APART = 0.02
"""Distance of the points through which det [A; t] is interpolated at a crossing, relative to the size."""


@record
class PoseBranch:
    """The configurations of the bodies up to the last group without a closed form, over one input.

    at         nodes, ascending by input        tangents    unit tangents at the nodes, as of `FreeInput`
    ends       whether the first and the last node are ends of the branch: a dead centre, or beyond the reach
    period     whole turns of the input [rad] after which the mechanism is the same, inf if never
    full       the input turns fully: the last node is the first, a period later
    pose       value of the input [rad, m] in the assembled pose
    crossings  values of the input [rad, m] at which another curve crosses, exact: change points
    """

    free: FreeInput
    at: Configurations
    tangents: Float[np.ndarray, "nodes unknowns"]
    ends: tuple[bool, bool]
    period: float
    full: bool
    pose: float
    crossings: tuple[float, ...]

    @property
    def start(self) -> float:
        """Least value of the input [rad, m]."""
        return float(self.at.inputs[0])

    @property
    def stop(self) -> float:
        """Greatest value of the input [rad, m]."""
        return float(self.at.inputs[-1])

    def reduced(self, values: FloatArray) -> FloatArray:
        """Values of the input [rad, m] on the branch, reduced by as few periods as possible; NaN for those beyond."""
        if self.full:
            return np.asarray(self.start + np.mod(values - self.start, self.period))
        found = np.where((values >= self.start) & (values <= self.stop), values, np.nan)
        if np.isfinite(self.period):
            up = values - self.period * np.ceil((values - self.stop) / self.period)
            down = values + self.period * np.ceil((self.start - values) / self.period)
            found = np.where((values > self.stop) & (up >= self.start), up, found)
            found = np.where((values < self.start) & (down <= self.stop), down, found)
        return found

    def ranges(self, start: float, stop: float) -> list[tuple[float, float]]:
        """Parts of a range of the input [rad, m] that are reduced to the branch, ascending."""
        if self.full:
            return [(start, stop)]
        if not np.isfinite(self.period):
            parts = [(self.start, self.stop)]
        else:
            below = range(math.floor((start - self.stop) / self.period), 0)
            above = range(1, math.ceil((stop - self.start) / self.period) + 1)
            parts = [(self.start + k * self.period, min(self.stop + k * self.period, self._first(k))) for k in below]
            parts += [(self.start, self.stop)]
            parts += [(max(self.start + k * self.period, self._last(k)), self.stop + k * self.period) for k in above]
        cut = [(max(low, start), min(high, stop)) for low, high in parts]
        return [(float(low), float(high)) for low, high in cut if low < high]

    def _first(self, turns: int) -> float:
        """Start of the part after the one that is so many periods below."""
        return self.start + (turns + 1) * self.period

    def _last(self, turns: int) -> float:
        """End of the part before the one that is so many periods above."""
        return self.stop + (turns - 1) * self.period

    def bodies(self, values: FloatArray) -> dict[str, BodyMotion]:
        """The bodies at rest at values of the input, interpolated between the nodes; NaN for values off the branch."""
        found = self.near(values)
        rows = {name: k for k, name in enumerate(self.free.mechanism.moving)}
        return {
            name: BodyMotion(PointMotion(found.origins[:, k], 0j, 0j), 0j, found.directions[:, k], 0.0, 0.0)
            for name, k in rows.items()
        }

    def near(self, values: FloatArray) -> Configurations:
        """Configurations at values of the input, interpolated by cubics (Hermite); NaN for values off the branch."""
        inside = self.reduced(np.asarray(values, dtype=float))
        node = np.clip(np.searchsorted(self.at.inputs, inside, side="right") - 1, 0, len(self.at) - 2)
        chords, first, last = (part[node] for part in self._pieces)
        share = _share(chords[:, -1], first[:, -1], last[:, -1], (inside - self.at.inputs[node]) * self.free.per_input)
        step = _hermite(chords.T, first.T, last.T, share).T
        configurations = self.free.stepped(self.at[node], step)
        gone = np.isnan(inside)
        configurations.origins[gone] = np.nan
        configurations.directions[gone] = np.nan
        return configurations

    @property
    def _pieces(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Steps between neighbouring nodes, and the derivatives by the share of the step at both ends.

        The parameter is the projection on the first tangent.
        """
        chords = self.free.chords(self.at)
        first, last = self.tangents[:-1], self.tangents[1:]
        along = np.sum(chords * first, axis=1)[:, None]
        return chords, first * along, last * (along / np.sum(first * last, axis=1)[:, None])


def _hermite(chord: FloatArray, first: FloatArray, last: FloatArray, share: FloatArray) -> FloatArray:
    """The cubic from 0 to `chord` with derivatives `first` and `last`, at shares of 1."""
    found: FloatArray = share * (first + share * (3 * chord - 2 * first - last + share * (first + last - 2 * chord)))
    return found


def _share(chord: FloatArray, first: FloatArray, last: FloatArray, value: FloatArray) -> FloatArray:
    """Share at which a monotone cubic of `_hermite` has a value."""
    low, high = np.zeros(value.shape), np.ones(value.shape)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        below = _hermite(chord, first, last, middle) < value
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)


def pose_branch(plan: Plan, name: str, locked: Mapping[str, float], far: float = 0.0) -> PoseBranch | None:
    """The branch of the mechanism's pose over one input; None where the pose cannot be assembled.

    locked  values [rad, m] of the other inputs
    far     greatest distance [rad] from the pose of the required values of the input. A branch whose input turns
            without end and without repetition (gears) is followed by whole turns up to it
    Raises MechanismError where this takes more than `MOST_TURNS`.
    """
    turns = LEAST_TURNS
    while True:
        found = _pose_branch(plan, name, tuple(sorted(locked.items())), turns)
        whole = found is None or found.full or np.isfinite(found.period) or all(found.ends)
        if whole or found is None or far <= turns * turn:
            return found
        if turns >= MOST_TURNS:
            raise MechanismError(
                f"input {name} is up to {format_quantity(far, 'deg')} from the mechanism's pose, without repetition",
                allowed=f"at most {MOST_TURNS:g} turns",
                do="give a shorter range, or a pose nearer to it",
            )
        turns *= 2


@lru_cache(maxsize=64)
def _pose_branch(plan: Plan, name: str, locked: tuple[tuple[str, float], ...], turns: float) -> PoseBranch | None:
    free = _free(plan, name, dict(locked))
    seed = _seed(plan, free)
    if seed is None:
        return None
    furthest = turns * turn if free.turns else np.inf
    curve = trace(free, seed, branch=True, furthest=furthest)
    if len(curve.at_nodes) < 2:
        return None
    lengths, folded = _nodes(curve)
    at, tangents, _ = curve.at(lengths)
    at.inputs[lengths < 0] -= curve.at_nodes.inputs[-1] - curve.at_nodes.inputs[0]
    full = curve.closed and not any(folded)
    left = np.abs(curve.at_nodes.inputs[[0, -1]] - seed.inputs) > furthest
    ends = (bool(folded[0] or not left[0]), bool(folded[1] or not left[1]))
    if full:
        at.inputs[-1] = at.inputs[0] + round(float(at.inputs[-1] - at.inputs[0]) / turn) * turn
        period = float(at.inputs[-1] - at.inputs[0])
    else:
        period = _period(free, seed) if all(ends) else np.inf
    kept = _ascending(at.inputs)
    if len(kept) < 2:
        return None
    at, tangents = at[kept], tangents[kept]
    crossings = tuple(_crossing(curve, value) for value in curve.crossings)
    branch = PoseBranch(free, at, tangents, ends, period, full, float(seed.inputs[0]), crossings)
    return _cut(plan, branch) if crossings else branch


def _free(plan: Plan, name: str, locked: Mapping[str, float]) -> FreeInput:
    """The mechanism up to the last group without a closed form, with a free input."""
    part = _part(plan.mechanism, {body for step in newton_steps(plan) for body in step.bodies})
    inputs = {entry.name for entry in part.inputs}
    return free_input(part, name, {other: value for other, value in locked.items() if other in inputs})


def _part(mechanism: Mechanism, bodies: set[str]) -> Mechanism:
    """The mechanism of some of the bodies, the ground and the joints, inputs and couplings among them."""
    kept = bodies | {GROUND}
    joints = tuple(joint for joint in mechanism.joints if set(joint.bodies) <= kept)
    names = {joint.name for joint in joints}
    return replace(
        mechanism,
        bodies=tuple(body for body in mechanism.bodies if body.name in kept),
        joints=joints,
        inputs=tuple(entry for entry in mechanism.inputs if entry.joint in names),
        branches={joint: sign for joint, sign in mechanism.branches.items() if joint in names},
        pose={body: pose for body, pose in mechanism.pose.items() if body in kept},
        couplings=tuple(coupling for coupling in mechanism.couplings if set(coupling.bodies) <= kept),
    )


def _seed(plan: Plan, free: FreeInput) -> Configurations | None:
    """The assembled pose, the locked inputs then moved straight to their values."""
    reference = inputs_in_pose(plan.mechanism)
    drawn = replace(free, locked={name: reference[name] for name in free.locked})
    seed = assembled(plan, drawn)
    if seed is None or all(reference[name] == value for name, value in free.locked.items()):
        return seed
    reference[free.name] = float(seed.inputs[0])
    targets = {name: np.array([value]) for name, value in {**reference, **free.locked}.items()}
    moved = straight(plan, drawn.bodies(seed), reference, targets)
    at = configuration(free, {**free.bodies(seed), **moved}, seed.inputs)
    across = np.zeros((1, 3 * at.origins.shape[1] + 1))
    across[0, -1] = 1.0
    at = free.corrected(at, across)
    return at if np.isfinite(at.inputs).all() and on_branches(plan, free, at).all() else None


def _nodes(curve: ConfigurationCurve) -> tuple[FloatArray, tuple[bool, bool]]:
    """Path lengths of the branch's nodes, denser towards its dead centres, and whether its ends are dead centres."""
    folds, lengths, seed = curve.folds(), curve.lengths, curve.lengths[curve.seed]
    if curve.closed and len(folds):
        folds = np.append(folds[-1] - lengths[-1], folds)
        lengths = np.append(lengths[:-1] - lengths[-1], lengths)
    below, above = folds[folds <= seed], folds[folds > seed]
    low = float(below[-1]) if len(below) else float(lengths[0])
    high = float(above[0]) if len(above) else float(lengths[-1])
    inner = lengths[(lengths > low) & (lengths < high)]
    points = [inner, np.array([low, high])]
    if len(below):
        points.append(low + (np.append(inner, high)[0] - low) * CLOSER)
    if len(above):
        points.append(high - (high - np.append(low, inner)[-1]) * CLOSER)
    return np.unique(np.concatenate(points)), (bool(len(below)), bool(len(above)))


def _ascending(inputs: FloatArray) -> IntArray:
    """The nodes with ascending inputs: next to a dead centre where curves cross as well, the correction may fail."""
    before = np.maximum.accumulate(np.concatenate([[-np.inf], np.nan_to_num(inputs, nan=-np.inf)]))[:-1]
    return np.flatnonzero(inputs > before)


def _period(free: FreeInput, seed: Configurations) -> float:
    """Least whole number of turns of the input [rad] after which all equations are the same; inf for none."""
    if not free.turns:
        return np.inf
    if not free.mechanism.couplings:
        return turn
    matrix, value = free.slope(seed)
    for count in range(1, PERIODS + 1):
        again, error = free.slope(Configurations(seed.origins, seed.directions, seed.inputs + count * turn))
        if max(np.max(np.abs(again - matrix)), np.max(np.abs(error - value))) <= SAME_EQUATIONS * free.size:
            return count * turn
    return np.inf


def _crossing(curve: ConfigurationCurve, value: float) -> float:
    """Value of the input [rad, m] at which another curve crosses, near `value` at a node: the zero of det [A; t]."""
    free, node = curve.free_input, np.full(6, int(np.argmin(np.abs(curve.at_nodes.inputs - value))))
    offsets = APART * free.size * np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
    across = curve.tangents[node]
    at = free.corrected(free.stepped(curve.at_nodes[node], across * offsets[:, None]), across)
    matrix = np.concatenate([free.slope(at)[0], free.tangents(at, across)[:, None, :]], axis=1)
    if not np.isfinite(matrix).all():
        return value
    determinants = np.polyfit(offsets, np.linalg.det(matrix), 5)
    zeros = np.roots(determinants)
    nearest = float(np.real(zeros[np.argmin(np.abs(zeros))]))
    return float(np.polyval(np.polyfit(offsets, at.inputs, 5), nearest))


def _cut(plan: Plan, branch: PoseBranch) -> PoseBranch:
    """The branch up to the crossings around the pose beyond which a closed form would change its sign."""
    whole = _twice(branch) if branch.full else branch
    same, inputs = on_branches(plan, whole.free, whole.at), whole.at.inputs
    low, high = whole.start, whole.stop
    for crossing in sorted(whole.crossings):
        following = [c for c in whole.crossings if c > crossing] or [whole.stop]
        leading = [c for c in whole.crossings if c < crossing] or [whole.start]
        if crossing > whole.pose and not _most(same[(inputs > crossing) & (inputs < min(following))]):
            high = min(high, crossing)
        if crossing < whole.pose and not _most(same[(inputs > max(leading)) & (inputs < crossing)]):
            low = max(low, crossing)
    if (low, high) == (whole.start, whole.stop):
        return branch
    inner = np.flatnonzero((inputs > low) & (inputs < high))
    ends = whole.near(np.array([low, high]))
    order = np.array([0, *(inner + 2), 1])
    at = Configurations(
        np.concatenate([ends.origins, whole.at.origins])[order],
        np.concatenate([ends.directions, whole.at.directions])[order],
        np.concatenate([[low, high], inputs])[order],
    )
    tangents = whole.tangents[np.array([inner[0], *inner, inner[-1]])]
    period = _period(branch.free, whole.at[inner[:1]])
    crossings = tuple(crossing for crossing in whole.crossings if low <= crossing <= high)
    return replace(branch, at=at, tangents=tangents, ends=(True, True), period=period, full=False, crossings=crossings)


def _most(same: BoolArray) -> bool:
    """Whether the nodes between two crossings agree; those next to a crossing are within its rounding."""
    return not len(same) or bool(np.mean(same) > 0.5)


def _twice(branch: PoseBranch) -> PoseBranch:
    """A branch over which the input turns fully, over two periods, the pose in the middle."""
    before, at = branch.at[:-1], branch.at
    double = Configurations(
        np.concatenate([before.origins, at.origins]),
        np.concatenate([before.directions, at.directions]),
        np.concatenate([before.inputs - branch.period, at.inputs]),
    )
    tangents = np.concatenate([branch.tangents[:-1], branch.tangents])
    crossings = tuple(c - k * branch.period for c in branch.crossings for k in (1, 0))
    return replace(branch, at=double, tangents=tangents, full=False, period=np.inf, crossings=crossings)
