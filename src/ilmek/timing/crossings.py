"""Instants at which a track passes a position, and stays between two positions: exact roots of the law.

A motion from begin to finish passes the position p at the share u of its time with begin + (finish - begin) s(u) = p.
The master angle is start + u (end - start): linear in start and end for any law. The solver depends on this.
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.errors import ParameterError
from ilmek.num.brackets import bracketed_roots
from ilmek.timing.track import MotionLaw, Track, TrackSegment
from ilmek.timing.windows import WHOLE, Windows, windows_of
from ilmek.units import format_quantity, turn

_GRID = np.linspace(0.0, 1.0, 129)
_SAME, _AT_END = 1e-9, 1e-12
"""Tolerances: of equal positions [SI], and of the ends of a law [-]."""


@dataclass(frozen=True, slots=True)
class TrackInstant:
    """An instant on a track's motions: index of the motion, share of its time [-], whole turns later."""

    motion: int
    share: float
    turns: int = 0

    def angle(self, track: Track) -> float:
        """Master angle [rad], counted on through the turns."""
        return track.segments[self.motion].angle(self.share) + turn * self.turns


@dataclass(frozen=True, slots=True)
class Passage:
    """A stay of a track in a zone: entry and exit."""

    entry: TrackInstant
    exit: TrackInstant


def turning_shares(law: MotionLaw) -> FloatArray:
    """Shares of the time [-], ascending, at which a law reverses, with both ends; 0 and 1 for a monotonic law."""
    v = np.asarray(law.v(_GRID), dtype=float)
    still = np.abs(v) <= _SAME
    signs = np.where(still, 0.0, np.sign(v))
    found = np.flatnonzero(signs[:-1] * signs[1:] < 0)
    roots = bracketed_roots(lambda u: np.asarray(law.v(u), dtype=float), _GRID[found], _GRID[found + 1])
    zeros = [u for u, left, here, right in zip(_GRID[1:], signs, signs[1:], signs[2:], strict=False)
             if here == 0 and left * right < 0]  # fmt: skip
    return np.unique(np.concatenate([[0.0, 1.0], roots, zeros]))


def crossing_shares(segment: TrackSegment, position: RealField) -> tuple[float, ...]:
    """Shares of a motion's time [-] at which it is at a position [SI], ascending, exact to rounding."""
    found = (_crossed(segment, piece, float(position)) for piece in _pieces(segment.law))
    return tuple(sorted({u for u in found if u is not None}))


def passing_share(track: str, segment: TrackSegment, position: float, unit: str = "mm") -> float:
    """The share of a motion's time [-] at which it first reaches a position [SI].

    track, unit  name and unit of the track for the message
    Raises ParameterError where the motion never passes the position.
    """
    shares = crossing_shares(segment, position)
    if not shares:
        ends = " to ".join(format_quantity(end, unit) for end in (segment.begin, segment.finish))
        raise ParameterError(
            f"{track}: {segment.name} never passes {format_quantity(position, unit)}", allowed=f"it goes from {ends}"
        )
    return shares[0]


def zone_windows(track: Track, low: float, high: float) -> Windows:
    """Windows of the master angle [rad] in which a track is strictly between two positions [SI], exact to rounding."""
    stays = passages(track, low, high)
    if stays is None:
        return WHOLE
    return windows_of((stay.entry.angle(track), stay.exit.angle(track)) for stay in stays)


def passages(track: Track, low: float, high: float) -> tuple[Passage, ...] | None:
    """Stays of a track strictly between two positions [SI], in the order of the turn; None where it never leaves."""
    if not track.segments:
        return None if low < 0 < high else ()
    passages: list[Passage] = []
    for number, segment in enumerate(track.segments):
        for inside in _inside(segment, low, high):
            here = Passage(TrackInstant(number, inside[0]), TrackInstant(number, inside[1]))
            if passages and inside[0] == 0 and _rests_on(track, passages[-1], number, low, high):
                passages[-1] = Passage(passages[-1].entry, here.exit)
            else:
                passages.append(here)
    return _closed(track, passages, low, high)


def _closed(track: Track, found: list[Passage], low: float, high: float) -> tuple[Passage, ...] | None:
    """The stays with the last one joined to the first where the track rests in the zone through the turn's end."""
    if (
        not found
        or found[0].entry != TrackInstant(0, 0.0)
        or not _rests_on(track, found[-1], len(track.segments), low, high)
    ):
        return tuple(found)
    if len(found) == 1:
        return None
    first, last = found[0], found[-1]
    end = TrackInstant(first.exit.motion, first.exit.share, 1)
    return (*found[1:-1], Passage(last.entry, end))


def _rests_on(track: Track, stay: Passage, number: int, low: float, high: float) -> bool:
    """Whether a stay goes on to the start of the motion of that number, the track resting in the zone."""
    before = track.segments[number - 1]
    meets = stay.exit == TrackInstant(number - 1, 1.0) and _within(before.finish, low, high)
    return meets and _within(track.segments[number % len(track.segments)].begin, low, high)


def _within(position: float, low: float, high: float) -> bool:
    return low + _SAME < position < high - _SAME


def _inside(segment: TrackSegment, low: float, high: float) -> Iterator[tuple[float, float]]:
    """Ranges of the share in which the motion is between both positions, ascending and apart."""
    if segment.stroke == 0:
        if _within(segment.begin, low, high):
            yield 0.0, 1.0
        return
    last: tuple[float, float] | None = None
    for piece in _pieces(segment.law):
        span = _piece_inside(segment, piece, low, high)
        if last and span and span[0] == last[1]:
            last = (last[0], span[1])
            continue
        if last:
            yield last
        last = span
    if last:
        yield last


@lru_cache(maxsize=500)
def _pieces(law: MotionLaw) -> tuple[tuple[float, float], ...]:
    """Ranges of the share in which a law is monotonic."""
    return tuple(itertools.pairwise(turning_shares(law).tolist()))


def _piece_inside(
    segment: TrackSegment, piece: tuple[float, float], low: float, high: float
) -> tuple[float, float] | None:
    ends = [_position(segment, u) for u in piece]
    if min(ends) >= high - _SAME or max(ends) <= low + _SAME:
        return None
    enter, leave = (low, high) if ends[0] < ends[1] else (high, low)
    start, end = (_crossed(segment, piece, at) for at in (enter, leave))
    return piece[0] if start is None else start, piece[1] if end is None else end


def _position(segment: TrackSegment, u: float) -> float:
    return segment.begin + segment.stroke * float(segment.law.s(u))


def _crossed(segment: TrackSegment, piece: tuple[float, float], position: float) -> float | None:
    """The share within a piece at which the motion is at a position; None where it is not."""
    if segment.stroke == 0 or not np.isfinite(position):
        return None
    return _share_of(segment.law, piece, (position - segment.begin) / segment.stroke)


@lru_cache(maxsize=5000)
def _share_of(law: MotionLaw, piece: tuple[float, float], goal: float) -> float | None:
    """The share within a piece at which s of a law is `goal`; None where it is not.

    It does not depend on the master angle: while motions are moved in time, it is found once.
    """
    ends = np.array([float(law.s(u)) - goal for u in piece])
    for u, off in zip(piece, ends, strict=True):
        if abs(off) <= _AT_END:
            return u
    if ends[0] * ends[1] > 0:
        return None
    low, high = np.array([piece[0]]), np.array([piece[1]])
    return float(bracketed_roots(lambda u: np.asarray(law.s(u), dtype=float) - goal, low, high)[0])
