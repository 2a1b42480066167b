"""Where a head stands in a phase in which it ties no knot: spread between the heads beside it that tie.

    x(h) = r + floor((h - a) (l - r) / (b - a)),   a < h < b

    a, b  the nearest heads that tie           r  rightmost knot of a           l  leftmost knot of b

Beyond the outermost heads that tie, the ends of the row take their part. All heads are a least distance s apart if and
only if l - r >= (b - a) s between any two of these: what the proof demands (`loom.proof.kernel`).
"""

from collections.abc import Sequence
from itertools import pairwise

from ilmek.loom.operations import RowOperations


def standing(spans: Sequence[tuple[int, int] | None], columns: int) -> dict[int, int]:
    """The column at which each head stands that ties nothing in a phase; none where no head ties.

    spans  leftmost and rightmost column of each head in the phase; None: it ties no knot      columns  of the row

    >>> standing([None, (6, 8), None, None, (20, 23)], 30)
    {0: 0, 2: 12, 3: 16}
    """
    last = len(spans) - 1
    fixed = [(head, span) for head, span in enumerate(spans) if span is not None]
    if not fixed:
        return {}
    if spans[0] is None:
        fixed.insert(0, (0, (0, 0)))
    if spans[last] is None:
        fixed.append((last, (columns - 1, columns - 1)))
    return {
        head: right + (head - before) * (left - right) // (after - before)
        for (before, (_, right)), (after, (left, _)) in pairwise(fixed)
        for head in range(before, after + 1)
        if spans[head] is None
    }


def asides(row: RowOperations, columns: int) -> list[dict[int, int]]:
    """The column at which each head stands that ties nothing, in each phase of a row of some columns."""
    if row.counts.all():
        return [{} for _ in range(row.phases)]
    ends = row.starts[:-1, None] + row.counts.cumsum(axis=1)
    knots = [
        [row.columns[end - count : end] for end, count in zip(ends[:, phase], row.counts[:, phase], strict=True)]
        for phase in range(row.phases)
    ]
    return [
        standing([(int(one.min()), int(one.max())) if one.size else None for one in tied], columns) for tied in knots
    ]
