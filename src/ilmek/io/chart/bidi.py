"""Display order of a line in which scripts of both directions meet: Persian, Arabic, Hebrew among digits and Latin.

Unicode Bidirectional Algorithm, UAX #9 (Unicode 15): the rules P2-P3, W1-W7, N0-N2, I1-I2, L1-L2 of a text without
explicit embeddings and isolates, which no name has, because their characters are not printable. Joiners (BN) take the
level of the character before them, as after rule X9. The mirroring of brackets, L4, is left to the shaper.
"""

import unicodedata
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

_OPENING, _CLOSING = "([{〈《「『【〔", ")]}〉》」』】〕"
"""Paired brackets (BidiBrackets.txt) of the keyboards in use."""

Item = TypeVar("Item")

_STRONG, _NEUTRAL = ("L", "R", "AL"), ("B", "S", "WS", "ON")


def is_rightward(text: str) -> bool:
    """Whether the line begins at the left: by its first strong character, P2 and P3; True where it has none.

    >>> is_rightward("12 madder"), is_rightward("12 لاکی")
    (True, False)
    """
    return next((kind == "L" for kind in map(unicodedata.bidirectional, text) if kind in _STRONG), True)


def levels(text: str, rightward: bool | None = None) -> list[int]:
    """The embedding level of each character: even ones are read to the right, odd ones to the left.

    rightward  whether the line begins at the left; None: by its first strong character

    >>> levels("a לב 12")
    [0, 0, 1, 1, 1, 2, 2]
    """
    base = 0 if (is_rightward(text) if rightward is None else rightward) else 1
    real = [place for place, letter in enumerate(text) if unicodedata.bidirectional(letter) != "BN"]
    letters = [text[place] for place in real]
    kinds = [unicodedata.bidirectional(letter) for letter in letters]
    _resolve_weak(kinds, "RL"[1 - base])
    _resolve_brackets(kinds, letters, base)
    _resolve_neutral(kinds, base)
    levels = [base] * len(text)
    by_place = dict(zip(real, (_level(kind, base) for kind in kinds), strict=True))
    for place in range(len(text)):
        levels[place] = by_place.get(place, levels[place - 1] if place else base)
    for place in range(len(text) - 1, -1, -1):  # L1: blanks at the end of the line
        if unicodedata.bidirectional(text[place]) not in ("WS", "BN"):
            break
        levels[place] = base
    return levels


def visual_runs(text: str, rightward: bool | None = None) -> list[tuple[str, bool]]:
    """The parts of one direction from left to right, each in reading order, and whether it is read to the right; L2.

    rightward  as of `levels`

    >>> visual_runs("קרם 12")
    [('12', True), ('קרם ', False)]
    """
    found = levels(text, rightward)
    order = list(range(len(text)))
    for level in range(max(found, default=0), 0, -1):
        for first, stop in _spans(order, lambda place, level=level: found[place] >= level):  # type: ignore[misc]
            order[first:stop] = order[first:stop][::-1]
    runs: list[tuple[str, bool]] = []
    for first, stop in _alike([found[place] for place in order]):
        rightward = found[order[first]] % 2 == 0
        places = order[first:stop] if rightward else order[first:stop][::-1]
        runs.append(("".join(text[place] for place in places), rightward))
    return runs


def _level(kind: str, base: int) -> int:
    """I1 and I2."""
    if base == 0:
        return {"R": 1, "AN": 2, "EN": 2}.get(kind, 0)
    return 1 if kind == "R" else 2


def _resolve_weak(kinds: list[str], start: str) -> None:
    """W1 to W7 in place: numbers, their separators and signs, marks."""
    before, strong = start, start
    for place, kind in enumerate(kinds):
        kind = before if kind == "NSM" else kind  # W1
        strong = kind if kind in _STRONG else strong
        kinds[place] = before = "AN" if kind == "EN" and strong == "AL" else kind  # W2
    kinds[:] = ["R" if kind == "AL" else kind for kind in kinds]  # W3
    for place in range(1, len(kinds) - 1):  # W4
        one, kind, two = kinds[place - 1 : place + 2]
        if one == two and ((kind in ("ES", "CS") and one == "EN") or (kind == "CS" and one == "AN")):
            kinds[place] = one
    for first, stop in _spans(kinds, lambda kind: kind == "ET"):  # W5
        if "EN" in (kinds[first - 1] if first else "", kinds[stop] if stop < len(kinds) else ""):
            kinds[first:stop] = ["EN"] * (stop - first)
    kinds[:] = ["ON" if kind in ("ES", "ET", "CS") else kind for kind in kinds]  # W6
    strong = start
    for place, kind in enumerate(kinds):  # W7
        strong = kind if kind in ("L", "R") else strong
        kinds[place] = "L" if kind == "EN" and strong == "L" else kind


def _resolve_brackets(kinds: list[str], letters: list[str], base: int) -> None:
    """N0 in place: a pair of brackets takes the direction of what it encloses."""
    own, other = ("L", "R") if base == 0 else ("R", "L")
    for first, last in _pairs(kinds, letters):
        inside = {_direction(kind) for kind in kinds[first + 1 : last]}
        if own in inside:
            kinds[first] = kinds[last] = own
        elif other in inside:
            before = next((d for kind in reversed(kinds[:first]) if (d := _direction(kind))), own)
            kinds[first] = kinds[last] = other if before == other else own


def _pairs(kinds: list[str], letters: list[str]) -> list[tuple[int, int]]:
    """Places of the paired brackets, by the opening one; BD16."""
    pairs, waiting = [], []
    for place, letter in enumerate(letters):
        if kinds[place] != "ON":
            continue
        if letter in _OPENING:
            waiting.append((_CLOSING[_OPENING.index(letter)], place))
        elif letter in _CLOSING and any(closing == letter for closing, _ in waiting):
            while (top := waiting.pop())[0] != letter:
                pass
            pairs.append((top[1], place))
    return sorted(pairs)


def _resolve_neutral(kinds: list[str], base: int) -> None:
    """N1 and N2 in place: neutrals between characters of one direction take it, others that of the line."""
    own = "L" if base == 0 else "R"
    for first, stop in _spans(kinds, lambda kind: kind in _NEUTRAL):
        before = _direction(kinds[first - 1]) if first else own
        after = _direction(kinds[stop]) if stop < len(kinds) else own
        kinds[first:stop] = [before if before == after else own] * (stop - first)


def _direction(kind: str) -> str:
    """L or R for strong kinds and numbers, which count as R; "" for neutrals."""
    return "L" if kind == "L" else "R" if kind in ("R", "EN", "AN") else ""


def _spans(items: Sequence[Item], inside: Callable[[Item], bool]) -> Iterator[tuple[int, int]]:
    """The longest parts whose items are all inside, as first and stop."""
    whether = [inside(item) for item in items]
    return ((first, stop) for first, stop in _alike(whether) if whether[first])


def _alike(items: Sequence[int]) -> Iterator[tuple[int, int]]:
    """The longest parts of equal items, as first and stop."""
    first = 0
    for place in range(1, len(items) + 1):
        if place == len(items) or items[place] != items[first]:
            yield first, place
            first = place
