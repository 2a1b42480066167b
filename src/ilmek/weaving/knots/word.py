"""Words of yarns and knots: the passages of the yarn behind warps, in the free group of the warps of a row.

In the section across the warps every warp is a hole in the plane. A cut runs from each hole away from the pile. A yarn
from the pile and back to it crosses the cuts in sequence, and each crossing is a letter:

    +k   the yarn passes behind warp k from left to right            -k   from right to left

The pile side, the region in front of the warps, has no cut and no hole. It is the base point, so both ends may move
freely in it. Two yarns can be deformed into each other without crossing a warp if and only if their words are equal
after all neighbouring pairs +k -k and -k +k are cancelled (the fundamental group
of the plane without n points is free on n letters; any topology, e.g. Hatcher, Algebraic Topology, 2002, section 1.2).

With A the left and B the right warps of a knot, u(G) the letters of G upwards (behind all of G from left to right) and
~ the inverse, the knots are

    symmetric                  ~u(A) ~u(B)      down between, round the left ones, across in front, round the right ones
    asymmetric, open left       u(A) ~u(B)      behind the left ones, up between, round the right ones
    asymmetric, open right     ~u(B)  u(A)      its mirror image
    single-warp (Spanish)       u(A)  u(A)      one and a half turns round one warp

and their inverses, for the yarn from its other end. A knot is open on the side whose warps it only passes behind. The
symmetric knot and the single-warp knot are their own mirror images, from the other end. With two warps each in A and B
it is the jufti form of the knot; groups of different numbers are recognised too.
"""

from dataclasses import dataclass
from itertools import groupby
from typing import TypeAlias

from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError

Word: TypeAlias = tuple[int, ...]
"""Signed numbers of warps, from 1; never 0."""

SINGLE = "single-warp"
_SIDES = ("left", "right")


def reduced(word: Word) -> Word:
    """The word with all neighbouring inverses cancelled until none remain; the result is unique.

    >>> reduced((1, 2, -2, -1, 3))
    (3,)
    """
    kept: list[int] = []
    for letter in word:
        if kept and kept[-1] == -letter:
            kept.pop()
        else:
            kept.append(letter)
    return tuple(kept)


def inverse(word: Word) -> Word:
    """The word of the same yarn from its other end.

    >>> inverse((1, -2))
    (2, -1)
    """
    return tuple(-letter for letter in reversed(word))


def passes(word: Word) -> tuple[Word, ...]:
    """The word divided where the yarn rises into the pile: each part passes behind neighbouring warps at once.

    >>> passes((-2, -1, -4, -3, 1))
    ((-2, -1), (-4, -3), (1,))
    """
    parts: list[list[int]] = []
    for letter in word:
        if parts and letter == parts[-1][-1] + 1:
            parts[-1].append(letter)
        else:
            parts.append([letter])
    return tuple(tuple(part) for part in parts)


def listed(warps: Word) -> str:
    """`warp 3`, `warps 3 and 4`, `warps 3, 4 and 5`."""
    numbers = [str(warp) for warp in warps]
    if len(numbers) == 1:
        return f"warp {numbers[0]}"
    return f"warps {', '.join(numbers[:-1])} and {numbers[-1]}"


def word_text(word: Word) -> str:
    """The word in plain text.

    >>> word_text((-1, -3, -2))
    'behind warp 1 from right to left, behind warps 3 and 2 from right to left'
    """
    return ", ".join(
        f"behind {listed(tuple(abs(letter) for letter in part))} from "
        + ("left to right" if part[0] > 0 else "right to left")
        for part in passes(word)
    )


@dataclass(frozen=True, slots=True)
class Knot:
    """A knot on warps of a row, numbered from 1 at the left.

    kind   symmetric, asymmetric or single-warp        left, right  neighbouring warps left and right of its middle;
    opens  left or right of an asymmetric knot, else ""             a single-warp knot has its warp at the left
    Raises CarpetError for kinds, sides and warps that form no knot; `knot` builds one from fewer arguments.
    """

    kind: str
    left: Word
    right: Word
    opens: str = ""

    def __post_init__(self) -> None:
        _check_kind(self)
        first, count = (self.warps or (0,))[0], len(self.warps)
        if first < 1 or self.warps != tuple(range(first, first + count)):
            raise CarpetError(
                f"a knot on {listed(self.warps or (0,))}",
                allowed="neighbouring warps, counted from 1 at the left, left ones first",
            )

    @property
    def warps(self) -> Word:
        """All its warps, from the left."""
        return self.left + self.right

    @property
    def jufti(self) -> bool:
        """Whether it is tied over more than two warps."""
        return len(self.warps) > 2

    @property
    def word(self) -> Word:
        """Its word; from the other end the knot has the inverse."""
        left, right = self.left, self.right
        if self.kind == SINGLE:
            return left + left
        if self.kind == "symmetric":
            return inverse(left) + inverse(right)
        return left + inverse(right) if self.opens == "left" else inverse(right) + left

    @property
    def name(self) -> str:
        """The knot in words."""
        kind = f"jufti {self.kind}" if self.jufti else self.kind
        if self.jufti and len(self.left) != len(self.right):
            kind = f"uneven {kind}"
        side = f", open {self.opens}," if self.opens else ""
        return f"{kind} knot{side} over {listed(self.warps)}"


def _check_kind(knot: Knot) -> None:
    kinds = ("symmetric", "asymmetric", SINGLE)
    if knot.kind not in kinds:
        raise CarpetError(f"knot of kind {knot.kind!r}", allowed=", ".join(kinds))
    if (knot.opens in _SIDES) != (knot.kind == "asymmetric") or (knot.opens and knot.opens not in _SIDES):
        raise CarpetError(
            f"{knot.kind} knot open {knot.opens or 'on no side'}",
            allowed="an asymmetric knot opens left or right, every other on no side",
        )
    if not knot.left or bool(knot.right) == (knot.kind == SINGLE) or (knot.kind == SINGLE and len(knot.left) > 1):
        raise CarpetError(
            f"{knot.kind} knot with {len(knot.left)} warps at the left and {len(knot.right)} at the right",
            allowed="one or more on each side; a single-warp knot has one at the left only",
        )


def knot(kind: str, first: int = 1, *, opens: str = "left", each: int = 1) -> Knot:
    """The knot over 2 `each` warps from warp `first` on.

    kind   symmetric, asymmetric, one of their trade names, or single-warp     first  its first warp at the left, from 1
    opens  open side of an asymmetric knot; ignored for the others             each   1; 2 for the jufti form
    Raises CarpetError for an unknown kind or side, and for warps below 1.

    >>> knot("Ghiordes", 3).word, knot("senneh", 3, opens="right").word, knot("symmetric", each=2).word
    ((-3, -4), (-4, 3), (-2, -1, -4, -3))
    """
    if each < 1:
        raise CarpetError(f"a knot over {each} warps on each side", allowed="1, or 2 for the jufti form")
    if kind == SINGLE:
        return Knot(SINGLE, (first,), ())
    kind = parse_knot(kind)
    left, right = tuple(range(first, first + each)), tuple(range(first + each, first + 2 * each))
    return Knot(kind, left, right, opens if kind == "asymmetric" else "")


def mirrored(knot: Knot) -> Knot:
    """The mirror image about the knot's middle: on the same warps, open on the other side.

    >>> mirrored(knot("asymmetric", 5)).opens
    'right'
    """
    warps, cut = knot.warps, len(knot.right)
    if knot.kind == SINGLE:
        return knot
    opens = {"left": "right", "right": "left"}.get(knot.opens, "")
    return Knot(knot.kind, warps[:cut], warps[cut:], opens)


def recognised(word: Word) -> Knot | None:
    """The knot of a reduced word, in either direction, or None.

    >>> recognised((4, 3)) == knot("symmetric", 3), recognised((3, 4))
    (True, None)
    """
    parts = passes(word)
    if len(parts) != 2:
        return None
    groups = [tuple(sorted(abs(letter) for letter in part)) for part in parts]
    if groups[0] == groups[1]:
        found = Knot(SINGLE, groups[0], ()) if len(groups[0]) == 1 else None
        return found if parts[0] == parts[1] else None
    left, right = sorted(groups)
    if left[-1] + 1 != right[0]:
        return None
    candidates = [Knot("symmetric", left, right), *(Knot("asymmetric", left, right, side) for side in _SIDES)]
    return next((known for known in candidates if word in (known.word, inverse(known.word))), None)


def verdict(word: Word) -> str:
    """The knot of a reduced word in words, or the reason for no knot.

    >>> verdict((-1, -1, -2))
    'no knot: but for a turn too many round warp 1, a symmetric knot over warps 1 and 2'
    """
    known = recognised(word)
    if known:
        return known.name
    parts = passes(word)
    if not parts:
        return "no knot: pulled, the yarn comes away from every warp"
    if len(parts) == 1:
        return f"no knot: the yarn only passes {word_text(word)}"
    once = tuple(part for part, _ in groupby(parts))
    nearly = recognised(tuple(letter for part in once for letter in part))
    if nearly:
        extra = sorted({abs(letter) for part, run in groupby(parts) if len(list(run)) > 1 for letter in part})
        return f"no knot: but for a turn too many round {listed(tuple(extra))}, a {nearly.name}"
    return f"no knot: the yarn passes {word_text(word)}"
