"""Which yarn is in which tube of a head when, over the whole carpet, and the stops in which packages are changed.

All colours of a part of a row must be in the head's tubes when it begins, for the loom stops only before a phase. Where
a carpet has more colours than a head has tubes, the colour that is needed again last makes room: that gives the fewest
changes [Belady, A study of replacement algorithms for a virtual-storage computer, IBM Systems Journal 5 (1966)]. Of
several that are not needed again, the one with least yarn on its package does. The first loading is free: as many
colours as there are tubes, those that are needed first. A package that would run out in a part is changed before it.

A package may be changed in any stop since its tube was last used. Stops are chosen as late as possible so that they are
as few as possible, beside those for the bobbins of weft: every change joins one of these where it can.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from ilmek.arrays import FloatArray, Indices, Int64, IntArray, UInt8
from ilmek.errors import LoomError
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.operations import EMPTY, Stop, TubeChange
from ilmek.loom.replay import TUBES, part_of, whole
from ilmek.loom.sharing import halves, share
from ilmek.num.compiled import compiled
from ilmek.records import record

_ENOUGH = 1 + 1e-9
"""A package has this many times the yarn that is drawn from it at least: sums of knots in another order."""


@dataclass(frozen=True, slots=True)
class YarnSupply:
    """Tubes of a head, and the packages on them.

    packages   length of yarn on a full package of each yarn [m]
    knot_yarn  pile yarn of a knot of each yarn [m]
    """

    tubes: int
    packages: tuple[float, ...]
    knot_yarn: tuple[float, ...]

    @staticmethod
    def endless(yarns: int) -> "YarnSupply":
        """A tube for each yarn, with packages that never run out."""
        return YarnSupply(yarns, (1e9,) * yarns, (0.0,) * yarns)


@record
class TubePlan:
    """Yarns in the tubes of the heads.

    loading   yarn in each tube when the carpet begins, uint8 (heads, tubes); EMPTY: none
    packages  length of yarn in each tube then [m]       changes  (number, 4): point, head, tube, yarn; in order
    full      length of a full package of each yarn [m]  phases   of a row; a point is row * phases + phase
    """

    loading: UInt8[np.ndarray, "heads tubes"]
    packages: FloatArray
    changes: Int64[np.ndarray, "changes 4"]
    full: tuple[float, ...]
    phases: int

    def stops(self, wefts: Sequence[Bobbin], rows: int) -> tuple[Stop, ...]:
        """All stops of the carpet, those for bobbins of weft with them."""
        due: dict[int, list[int]] = {}
        for index, bobbin in enumerate(wefts):
            for row in range(bobbin.rows, rows, bobbin.rows):
                due.setdefault(row * self.phases, []).append(index)
        changed = {
            point: tuple(TubeChange(head, tube, yarn, float(self.full[yarn])) for _, head, tube, yarn in ones)
            for point, ones in groupby(self.changes.tolist(), key=lambda change: change[0])
        }
        return tuple(
            Stop(point // self.phases, point % self.phases, tuple(due.get(point, ())), changed.get(point, ()))
            for point in sorted({*due, *changed})
        )

    def loaded(self, point: int) -> UInt8[np.ndarray, "heads tubes"]:
        """Yarn in each tube at a point, after its stop."""
        loaded = self.loading.copy()
        number = int(np.searchsorted(self.changes[:, 0], point, side="right"))
        for _, head, tube, yarn in self.changes[:number].tolist():
            loaded[head, tube] = yarn
        return loaded

    def lines(self, knots: Indices, first: int, last: int, loaded: UInt8[np.ndarray, "heads tubes"]) -> Indices:
        """Tube of each knot of the loom rows from `first` to before `last`, uint8, loom row first.

        knots   the chart, row 0 = top      loaded  at the first row before its stops; updated to the last row's end
        """
        rows = knots.shape[0]
        lines = knots[rows - last : rows - first][::-1]
        heads, tubes = loaded.shape
        same = np.arange(tubes, dtype=np.uint8)
        begin, end = np.searchsorted(self.changes[:, 0], (first * self.phases, last * self.phases))
        if begin == end and np.all((loaded == same) | (loaded == EMPTY)):
            return np.ascontiguousarray(lines)
        out = np.empty(lines.shape, np.uint8)
        edges = share(knots.shape[1], heads)
        _to_tubes(np.ascontiguousarray(lines), edges, first, self.changes[begin:end], loaded, out)
        return out


def most_colours(knots: Indices, yarns: int, heads: int) -> int:
    """The largest number of colours of a part of a row: as many tubes does every head need."""
    return int(_most_colours(np.ascontiguousarray(knots), share(knots.shape[1], heads), yarns))


def plan_tubes(knots: Indices, heads: int, supply: YarnSupply, wefts: Sequence[Bobbin] = ()) -> TubePlan:
    """The plan for a chart, uint8 (rows, columns), row 0 = top.

    Raises LoomError where a part of a row has more colours than a head has tubes, or takes more yarn than a package
    has.
    """
    edges, yarns, phases = share(knots.shape[1], heads), len(supply.packages), halves(heads)
    chart = np.ascontiguousarray(knots)
    totals = np.zeros((heads, yarns), np.int64)
    _head_totals(chart, np.ascontiguousarray(edges[::phases]), totals)
    used = np.flatnonzero(totals.sum(axis=0))
    if yarns <= supply.tubes:
        used = np.arange(yarns)
    if len(used) > supply.tubes:
        _require_tubes(most_colours(knots, yarns, heads), supply.tubes)
    full, knot_yarn = np.array(supply.packages), np.array(supply.knot_yarn)
    loading = np.full((heads, supply.tubes), EMPTY, np.uint8)
    found: list[IntArray] = []
    for head in range(heads):
        fits = len(used) <= supply.tubes
        enough = np.all(totals[head] * knot_yarn * _ENOUGH <= full)
        if fits:
            loading[head, : len(used)] = used
        if not fits or not enough:
            counts = np.zeros((knots.shape[0] * phases, yarns), np.int32)
            _head_counts(chart, edges, head, phases, counts)
            if not fits:
                first = _first_used(counts, supply.tubes)
                loading[head, : len(first)] = first
            found.append(_changes_of(head, counts, loading[head], full, knot_yarn))
    packages = np.where(loading == EMPTY, 0.0, np.append(full, np.zeros(TUBES - yarns))[loading])
    windows = np.concatenate(found) if found else np.zeros((0, 5), np.int64)
    points = np.unique([row * phases for weft in wefts for row in range(weft.rows, knots.shape[0], weft.rows)])
    return TubePlan(loading, packages, join_changes(windows, points.astype(np.int64)), supply.packages, phases)


def _require_tubes(needed: int, tubes: int) -> None:
    if needed > tubes:
        raise LoomError(
            f"{needed} colours in a part of a row for {tubes} tubes of a head",
            allowed="a tube for each colour of a part",
            do="use more heads, fewer colours, or more tubes",
        )


def _first_used(counts: IntArray, tubes: int) -> IntArray:
    """The yarns that are used first, as many as there are tubes, in ascending order."""
    ever = np.flatnonzero(counts.any(axis=0))
    order = np.argsort((counts[:, ever] > 0).argmax(axis=0), kind="stable")
    return np.sort(ever[order[:tubes]])


def _changes_of(
    head: int, counts: IntArray, loading: UInt8[np.ndarray, " tubes"], full: FloatArray, knot_yarn: FloatArray
) -> IntArray:
    """Changes of a head: earliest point, latest point, head, tube, yarn."""
    after = np.empty_like(counts)
    _next_use(counts, after)
    most = 1024
    while True:
        out = np.zeros((most, 5), np.int64)
        number = _plan_head(counts, after, loading.astype(np.int64), full, knot_yarn, out)
        if number < 0:
            raise LoomError(
                "a part of a row takes more yarn than a package has",
                allowed="at least the yarn of a part on a package",
                do="use larger packages, or more heads",
            )
        if number <= most:
            out[:, 2] = head
            return out[:number]
        most = number


def join_changes(windows: IntArray, fixed: IntArray) -> Int64[np.ndarray, "changes 4"]:
    """Changes (point, head, tube, yarn) in order, at as few points beside the fixed ones as possible.

    windows  (changes, 5): earliest point, latest point, head, tube, yarn       fixed  points, in order

    >>> windows = np.array([[0, 4, 0, 1, 2], [3, 6, 1, 0, 2], [5, 9, 0, 0, 1]])
    >>> join_changes(windows, np.array([8])).tolist()
    [[4, 0, 1, 2], [4, 1, 0, 2], [8, 0, 0, 1]]
    """
    windows = windows[np.argsort(windows[:, 1], kind="stable")]
    index = np.searchsorted(fixed, windows[:, 1], side="right") - 1
    point = np.where(index >= 0, np.append(fixed, -1)[index], -1)
    free = point < windows[:, 0]
    last = -1
    for number in np.flatnonzero(free).tolist():
        earliest, latest = windows[number, :2].tolist()
        last = last if last >= earliest else latest
        point[number] = last
    changes = np.column_stack([point, windows[:, 2:]])
    return np.ascontiguousarray(changes[np.lexsort(changes.T[::-1])])


@compiled
def _head_totals(chart: Indices, blocks: IntArray, totals: IntArray) -> None:
    """Knots of each yarn of each head."""
    for row in range(chart.shape[0]):
        for head in range(blocks.shape[0] - 1):
            for column in range(blocks[head], blocks[head + 1]):
                if chart[row, column] != EMPTY:
                    totals[head, chart[row, column]] += 1


@compiled
def _most_colours(chart: Indices, edges: IntArray, yarns: int) -> int:
    seen, most, mark = np.zeros(yarns, np.int64), 0, 0
    for row in range(chart.shape[0]):
        for part in range(edges.shape[0] - 1):
            mark += 1
            found = 0
            for column in range(edges[part], edges[part + 1]):
                yarn = chart[row, column]
                if yarn != EMPTY and seen[yarn] != mark:
                    seen[yarn] = mark
                    found += 1
            most = max(most, found)
    return most


@compiled
def _head_counts(chart: Indices, edges: IntArray, head: int, phases: int, counts: IntArray) -> None:
    """Knots of each yarn in each part of a head, in order of time."""
    rows = chart.shape[0]
    for step in range(rows * phases):
        row = step // phases
        part = part_of(head, step % phases, phases, row % 2 == 0)
        for column in range(edges[part], edges[part + 1]):
            if chart[rows - 1 - row, column] != EMPTY:
                counts[step, chart[rows - 1 - row, column]] += 1


@compiled
def _next_use(counts: IntArray, after: IntArray) -> None:
    """For each part and yarn the first part from then on that has the yarn; the number of parts: none."""
    parts, yarns = counts.shape
    for yarn in range(yarns):
        point = parts
        for step in range(parts - 1, -1, -1):
            if counts[step, yarn] > 0:
                point = step
            after[step, yarn] = point


@compiled
def _plan_head(  # noqa: C901, PLR0917 - the loop of a kernel and its arrays
    counts: IntArray, after: IntArray, loaded: IntArray, full: FloatArray, knot_yarn: FloatArray, out: IntArray
) -> int:
    """Write the changes of a head as far as there is room; returns their number, -1 for a package that is too small."""
    parts, yarns = counts.shape
    tubes, found = loaded.shape[0], 0
    tube_of, left = np.full(yarns, -1, np.int64), np.zeros(tubes)
    used = np.full(tubes, -1, np.int64)
    for tube in range(tubes):
        if loaded[tube] != EMPTY:
            tube_of[loaded[tube]], left[tube] = tube, full[loaded[tube]]
    for step in range(parts):
        for yarn in range(yarns):
            if counts[step, yarn] == 0:
                continue
            needed = counts[step, yarn] * knot_yarn[yarn] * _ENOUGH
            if needed > full[yarn]:
                return -1
            tube = tube_of[yarn]
            if tube < 0 or left[tube] < needed:
                if tube < 0:
                    tube = _victim(step, loaded, left, after)
                    if loaded[tube] != EMPTY:
                        tube_of[loaded[tube]] = -1
                if found < out.shape[0]:
                    out[found, 0], out[found, 1], out[found, 3], out[found, 4] = used[tube] + 1, step, tube, yarn
                found += 1
                loaded[tube], left[tube], tube_of[yarn] = yarn, full[yarn], tube
            left[tube] -= needed
            used[tube] = step
    return found


@compiled
def _victim(step: int, loaded: IntArray, left: FloatArray, after: IntArray) -> int:
    """The tube whose yarn is needed again last, and of these the one with least yarn; an empty one before all."""
    best, latest = 0, -1
    for tube in range(loaded.shape[0]):
        point = after.shape[0] + 1 if loaded[tube] == EMPTY else whole(after[step, loaded[tube]])
        if point > latest or (point == latest and left[tube] < left[best]):
            best, latest = tube, point
    return best


@compiled
def _to_tubes(  # noqa: PLR0917 - the arrays of a kernel
    lines: Indices, edges: IntArray, first: int, changes: IntArray, loaded: Indices, out: Indices
) -> None:
    """Write the tube of each knot, EMPTY where there is none; `loaded` is updated by the changes."""
    heads, tubes = loaded.shape
    phases = (edges.shape[0] - 1) // heads
    tube_of, at = np.zeros((heads, TUBES), np.uint8), 0
    for head in range(heads):
        for tube in range(tubes):
            tube_of[head, loaded[head, tube]] = tube
        tube_of[head, EMPTY] = EMPTY
    for row in range(lines.shape[0]):
        for phase in range(phases):
            point = (first + row) * phases + phase
            while at < changes.shape[0] and changes[at, 0] <= point:
                head, tube, yarn = changes[at, 1], changes[at, 2], changes[at, 3]
                loaded[head, tube] = yarn
                tube_of[head, yarn] = tube
                at += 1
            for head in range(heads):
                part = part_of(head, phase, phases, (first + row) % 2 == 0)
                for column in range(edges[part], edges[part + 1]):
                    out[row, column] = tube_of[head, lines[row, column]]
