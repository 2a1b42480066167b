"""Solutions of a task from those of another one, in threads."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import Bool, Complex, Float, Int
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.alt_burmester.tracking import ENDED, track_all

SLICE = 24
"""Paths that are tracked without a pause: some 40 ms."""

SHARES, DISTANCES = (0.004, 0.02, 0.1, 0.5), (0.003, 0.01, 0.03)
"""Tasks near the straight line: share of the first task in them, and distances from the line relative to it."""

OTHER_LINES = (0.2, 0.3, 0.4)
"""Distances from the straight line, in sizes of the task, of tasks in its middle that at last all paths pass."""

FEW, SHARE = 4, 0.02
"""Number of lacking paths, and share of all, above which the task is special and none is tracked again."""

POLISHED = 1e-6
"""Last Newton step, relative to the unknowns, up to which an end is a solution that stands alone."""

SAME_SOLUTION = 1e-8
"""Relative difference of their keys below which two solutions are the same."""


@record
class SolvedTask:
    """A task in isotropic coordinates with solutions: see `equations`.

    pose       whether each position is a pose; poses come first
    task       displacements d and d', and rotations T (of points any)
    unknowns   u, one row for each solution      rotations  T, one row for each
    """

    pose: Bool[np.ndarray, " positions"]
    task: Complex[np.ndarray, "3 positions"]
    unknowns: Complex[np.ndarray, "solutions 8"]
    rotations: Complex[np.ndarray, "solutions positions"]

    @property
    def nine_points(self) -> bool:
        """Whether all angles are free: solutions then come in classes of three cognates."""
        return not bool(self.pose.any())

    def aligned(self, task: Complex[np.ndarray, "3 positions"]) -> "SolvedTask":
        """The same task rotated, scaled and stretched in the complex sense towards another one, with its solutions."""
        factors = np.array([_factor(self.task[row], task[row]) for row in range(2)])
        scaled = self.task * np.append(factors, 1.0)[:, None]
        return SolvedTask(self.pose, scaled, self.unknowns * np.tile(factors, 4), self.rotations)

    def only(self, which: Int[np.ndarray, " some"]) -> "SolvedTask":
        """The selected solutions."""
        return SolvedTask(self.pose, self.task, self.unknowns[which], self.rotations[which])

    def keys(self) -> Complex[np.ndarray, " solutions"]:
        """A number for each solution that cognates and the exchange of the links leave as it is."""
        return solution_keys(self.unknowns, self.nine_points)


@record
class Tracked:
    """Ends of paths: the task and its solutions; how each path ended, its steps, and the last relative change."""

    solved: SolvedTask
    ends: Int[np.ndarray, " paths"]
    steps: Int[np.ndarray, " paths"]
    moved: Float[np.ndarray, " paths"]

    @property
    def good(self) -> Bool[np.ndarray, " paths"]:
        """Whether a path ended at a solution that stands alone."""
        return np.asarray((self.ends == ENDED) & (self.moved <= POLISHED))

    @property
    def distinct_keys(self) -> Complex[np.ndarray, " paths"]:
        """The keys of the ends; numbers that no other has for paths without an end."""
        return np.where(self.good, self.solved.keys(), 1e9 * np.arange(1, len(self.ends) + 1))

    def only(self, which: Int[np.ndarray, " some"]) -> "Tracked":
        """The selected paths."""
        return Tracked(self.solved.only(which), self.ends[which], self.steps[which], self.moved[which])


def solution_keys(u: Complex[np.ndarray, "solutions 8"], nine_points: bool) -> Complex[np.ndarray, " solutions"]:
    """A number for each solution: a fixed combination of the sums of the ground pivots and of their conjugates.

    Of nine points the third pivot counts too, so that the six solutions of a Roberts class have one key.
    """
    A, A1, x, x1, B, B1, y, y1 = u.T
    plain, primed = A + B, A1 + B1
    if nine_points:  # C0 = A0 + z (B0 - A0), z = (P - A)/(B - A): see `cognates`
        plain = plain + A - x / (y - x) * (B - A)
        primed = primed + A1 - x1 / (y1 - x1) * (B1 - A1)
    return np.asarray(plain + (0.31 + 0.77j) * primed)


def repeated(keys: Complex[np.ndarray, " solutions"]) -> Bool[np.ndarray, " solutions"]:
    """Whether another solution has the same key."""
    order = np.argsort(keys.real, kind="stable")
    sorted_keys, found = keys[order], np.zeros(len(keys), dtype=bool)
    for k, key in enumerate(sorted_keys):
        tolerance = SAME_SOLUTION * (1 + abs(key))
        end = int(np.searchsorted(sorted_keys.real, key.real + tolerance, side="right"))
        near = np.flatnonzero(np.abs(sorted_keys[k + 1 : end] - key) <= tolerance)
        if len(near):
            found[k] = found[k + 1 + near] = True
    back = np.empty_like(found)
    back[order] = found
    return back


def track(begin: SolvedTask, task: Complex[np.ndarray, "3 positions"], progress: Progress = SILENT) -> Tracked:
    """Solutions of a task, each followed from one of `begin` along the straight line between both tasks. Cancelled."""
    count = len(begin.unknowns)
    unknowns, rotations = begin.unknowns.copy(), begin.rotations.copy()
    ends, steps, moved = np.zeros(count, np.int64), np.zeros(count, np.int64), np.full(count, np.nan)
    change = task - begin.task

    def part(rows: slice) -> None:
        track_all(unknowns[rows], rotations[rows], begin.pose, begin.task, change, ends[rows], steps[rows], moved[rows])

    for rows, _ in in_threads(part, _slices(count)):
        progress(min(rows.stop, count) / count)
    return Tracked(SolvedTask(begin.pose, task, unknowns, rotations), ends, steps, moved)


def complete(begin: SolvedTask, task: Complex[np.ndarray, "3 positions"], progress: Progress = SILENT) -> Tracked:
    """As `track`; for paths that break off, or meet, other lines lead to the ends that lack.

    A path that passes near infinity breaks off for rounding alone. It is tracked again through tasks beside the line,
    some near its end. If ends still lack, all paths are followed on other lines, where others pass near infinity.
    A special task, where solutions merge or form families, lacks many ends: none is tracked again. The lines are the
    same in every run. Raises Cancelled.
    """
    tracked = track(begin, task, progress)
    collected = Collected(tracked)
    followed = collected.slots.copy()
    if not 0 < len(followed) <= max(FEW, SHARE * len(begin.unknowns)):
        return tracked
    collected.add(tracked.only(np.flatnonzero(repeated(tracked.distinct_keys))))
    tries = [(share, share * distance, followed) for distance in DISTANCES for share in SHARES]
    tries += [(0.5, distance, np.arange(len(begin.unknowns))) for distance in OTHER_LINES]
    for seed, (share, distance, which) in enumerate(tries):
        if not len(collected.slots):
            break
        between = share * begin.task + (1 - share) * task
        between += distance * random_task(np.random.default_rng(seed), begin.pose)
        first = track(begin.only(which), between, progress.part(1.0, 1.0))
        collected.add(track(first.solved.only(np.flatnonzero(first.good)), task, progress.part(1.0, 1.0)))
    return collected.result


class Collected:
    """Ends of paths, each once: those of a first run, and ends of further runs in the slots of those that lack."""

    def __init__(self, found: Tracked) -> None:
        lacking = ~found.good | repeated(found.distinct_keys)
        self.slots = np.flatnonzero(lacking)
        self.solved = found.solved
        self.columns = [found.solved.unknowns.copy(), found.solved.rotations.copy(), found.ends.copy()]
        self.columns += [found.steps.copy(), found.moved.copy()]
        self.columns[4][self.slots] = np.nan
        self.keys = found.solved.keys()[~lacking]

    def add(self, again: Tracked) -> None:
        """Fill slots with the ends that are new."""
        for k in np.flatnonzero(again.good):
            key = again.solved.keys()[k]
            if not len(self.slots) or np.min(np.abs(self.keys - key), initial=np.inf) <= SAME_SOLUTION * (1 + abs(key)):
                continue
            values = (again.solved.unknowns, again.solved.rotations, again.ends, again.steps, again.moved)
            for column, value in zip(self.columns, values, strict=True):
                column[self.slots[0]] = value[k]
            self.slots, self.keys = self.slots[1:], np.append(self.keys, key)

    @property
    def result(self) -> Tracked:
        """The ends; `moved` is NaN where one lacks."""
        unknowns, rotations, ends, steps, moved = self.columns
        return Tracked(SolvedTask(self.solved.pose, self.solved.task, unknowns, rotations), ends, steps, moved)


def random_task(rng: np.random.Generator, pose: Bool[np.ndarray, " positions"]) -> Complex[np.ndarray, "3 positions"]:
    """A general complex task: displacements of mean square 1, rotations near the unit circle."""
    count = len(pose)
    normal = rng.normal(size=(4, count)) / np.sqrt(2)
    turns = np.exp(1j * rng.uniform(0, 2 * np.pi, count) + 0.3 * rng.normal(size=count))
    return np.array([normal[0] + 1j * normal[1], normal[2] + 1j * normal[3], turns])


def rotations_of(
    u: Complex[np.ndarray, "solutions 8"],
    task: Complex[np.ndarray, "3 positions"],
    pose: Bool[np.ndarray, " positions"],
) -> Complex[np.ndarray, "solutions positions"]:
    """The coupler's rotations T: both links' equations are linear in T and 1/T."""
    d, primed = task[0], task[1]
    rows = []
    for link in (u[:, :4], u[:, 4:]):
        A, A1, x, x1 = (link[:, k, None] for k in range(4))
        rows.append((x * (primed - A1), x1 * (d - A), (d - A) * (primed - A1) + x * A1 + x1 * A - A * A1))
    (a, b, c), (a2, b2, c2) = rows
    with np.errstate(divide="ignore", invalid="ignore"):
        found = (b * c2 - b2 * c) / (a * b2 - a2 * b)
    return np.asarray(np.where(pose, task[2], found))


def _slices(count: int) -> Iterator[slice]:
    return (slice(first, first + SLICE) for first in range(0, count, SLICE))


def _factor(of: Complex[np.ndarray, " positions"], towards: Complex[np.ndarray, " positions"]) -> complex:
    """Factor that brings a vector to the size of another one, and as near as this allows."""
    along = complex(np.vdot(of, towards))
    size = float(np.linalg.norm(towards) / np.linalg.norm(of))
    return size * along / abs(along) if along else complex(size)
