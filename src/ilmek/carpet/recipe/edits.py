"""Edits: changes of the knots of a chart, each one line, in order.

    set 12,40 madder red              one knot or several: set 12,40 12,41 madder red
    line 1,1 30,30 ivory              a line, 8-connected
    stroke 5 1,1 30,30 40,30 ivory    lines from knot to knot, drawn with a round brush of 5 knots
    fill 100,50 indigo navy           the connected area of one yarn about a knot
    replace ivory by camel            every knot of a yarn
    replace ivory by camel in 1,1 50,50     within a rectangle
    half 12,40 ivory                  two half knots: the cell's yarn on its left warp, this one on its right warp
    jufti 12,40                       one knot on four warps: this cell and the next one, of one yarn
    jufti 1,1 50,50                   within a rectangle: every two neighbours, from the left, of one yarn
    mirror across in 1,1 50,50        the left half of a rectangle, reflected, becomes its right half; along: the upper
                                      half the lower one; both: the upper left quarter all; without `in`: of the carpet
    repeat 1,1 10,10 in 1,1 50,50     a rectangle becomes the tile of another one, or of the carpet
    copy 1,1 10,20 to 40,50           a rectangle again, its lower left knot at 40,50; beyond the edge it is cut;
                                      before, `mirrored across` (or along) reflects it, then `turned 90deg` turns it
                                      clockwise: copy 1,1 10,20 to 40,50 turned 90deg mirrored across
    move 1,1 10,20 to 40,50 ivory     the same, and the rectangle where it was becomes ivory
    border 3 ivory in 1,1 50,50       a border of 3 knots along the edge of a rectangle, inside, or of the carpet

A knot is given as row,column. Rows are counted as they are woven, from 1 at the carpet's lower edge; columns from 1 at
the left edge.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Indices, Int64, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import bands
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.recipe.anchor import BORDER, REPEATED, Anchor
from ilmek.carpet.recipe.border import edges
from ilmek.carpet.recipe.copies import WIDEST_BRUSH, brush_spans, transformed
from ilmek.carpet.recipe.mirror import MIRRORS, complete
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import CarpetError, IlmekError, did_you_mean, shortened
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence, file_of, with_location

Knot = tuple[int, int]

_POINT = re.compile(r"\s*(\d{1,9})\s*,\s*(\d{1,9})(?=\s|$)")
_FLOOD = 1 << 20
FORMS = {
    "set": "set ROW,COLUMN YARN",
    "stroke": f"stroke WIDTH ROW,COLUMN ROW,COLUMN ... YARN, of a width up to {WIDEST_BRUSH}",
    "fill": "fill ROW,COLUMN YARN",
    "line": "line ROW,COLUMN ROW,COLUMN YARN",
    "replace": "replace YARN by YARN, or replace YARN by YARN in ROW,COLUMN ROW,COLUMN",
    "half": "half ROW,COLUMN YARN",
    "jufti": "jufti ROW,COLUMN, or jufti ROW,COLUMN ROW,COLUMN",
    "mirror": "mirror across (or along, both), and in ROW,COLUMN ROW,COLUMN for a part",
    "repeat": "repeat ROW,COLUMN ROW,COLUMN, and in ROW,COLUMN ROW,COLUMN for a part",
    "copy": "copy ROW,COLUMN ROW,COLUMN to ROW,COLUMN, and turned 90deg (180deg, 270deg), mirrored across (or along)",
    "move": "move ROW,COLUMN ROW,COLUMN to ROW,COLUMN YARN, and before the yarn as for copy",
    "border": "border WIDTH YARN, and in ROW,COLUMN ROW,COLUMN for a part",
}
"""How each edit is written."""

_KNOTS = {
    "set": (1, 10_000),
    "stroke": (1, 10_000),
    "fill": (1, 1),
    "line": (2, 2),
    "half": (1, 1),
    "jufti": (1, 2),
    "repeat": (2, 2),
    "copy": (2, 2),
    "move": (2, 2),
}
"""Least and largest number of knots of an edit, without those of the part that it acts on; default: none."""

_WITHIN = ("replace", "mirror", "repeat", "border")
"""Edits that act on the carpet, or on a part."""

_WITHOUT_YARN = ("jufti", "mirror", "repeat", "copy")

_PLACED = re.compile(r"(?:turned\s+(90|180|270)deg\s*)?(?:mirrored\s+(across|along)(?:\s+|$))?")

_OF_CARPET = ("mirror", "repeat", "copy", "move", "border")
"""Edits of a carpet, not of a part that it may show several times."""

_UPRIGHT = ("half", "jufti")
"""Edits of warps, which a border that runs along them cannot have."""


@dataclass(frozen=True, slots=True)
class Edit:
    """An edit as it is written.

    kind   of FORMS      knots  rows and columns, from 1      yarns  the text of the yarns      where  file and line
    direction  of a mirror, of MIRRORS, or of a reflected copy; "": none      width  of a border or a brush [knots]
    turned     right angles by which a copy is turned clockwise      anchor  what rows and columns count
    """

    kind: str
    knots: tuple[Knot, ...]
    yarns: str
    text: str
    where: str = ""
    direction: str = ""
    width: int = 0
    turned: int = 0
    anchor: Anchor = Anchor()


def parse_edit(text: str, where: str = "", anchor: Anchor | None = None) -> Edit:
    """The edit of a line; yarns and bounds are checked when it is applied. Raises CarpetError.

    anchor  what its rows and columns count; default: the knots of the carpet that is made

    >>> parse_edit("line 1,1 30, 30 ivory").knots
    ((1, 1), (30, 30))
    """
    kind, _, rest = text.strip().partition(" ")
    if kind not in FORMS:
        near = did_you_mean(kind, FORMS)
        raise CarpetError(Sentence("recipe.unknown-edit", kind=shortened(kind)), allowed=", ".join(FORMS), do=near)
    part: tuple[Knot, ...] = ()
    fits, direction, width, turned = True, "", 0, 0
    if kind in _WITHIN:
        rest, inside, region = rest.partition(" in ")
        part, left = _points(region)
        fits = not left and len(part) == (2 if inside else 0)
    if kind in ("border", "stroke"):
        digits, _, rest = rest.strip().partition(" ")
        width = int(digits) if re.fullmatch(r"[1-9]\d{0,3}", digits) else 0
        fits = fits and 0 < width <= (WIDEST_BRUSH if kind == "stroke" else width)
    knots, words = ((), rest) if kind == "replace" else _points(rest)
    if kind in ("copy", "move"):
        to, _, target = words.partition(" ")
        part, words = _points(target)
        placed = _PLACED.match(words)
        assert placed is not None  # both parts of it may be missing
        turned, direction, words = int(placed[1] or 0) // 90, placed[2] or "", words[placed.end() :]
        fits = to == "to" and len(part) == 1
    yarns = " ".join(words.split())
    if kind == "mirror":
        yarns, direction = "", yarns
        fits = fits and direction in MIRRORS
    least, most = _KNOTS.get(kind, (0, 0))
    if not (fits and least <= len(knots) <= most) or bool(yarns) == (kind in _WITHOUT_YARN):
        raise CarpetError(
            Sentence("recipe.no-edit", text=shortened(text.strip())), do=Sentence("recipe.write", form=FORMS[kind])
        )
    anchor = anchor or Anchor()
    if (kind in _OF_CARPET and anchor.on in REPEATED) or (kind in _UPRIGHT and anchor.on == BORDER):
        raise CarpetError(f"{kind} is no edit of a {anchor.on}", do='write it under on = "carpet"')
    return Edit(kind, (*knots, *part), yarns, " ".join(text.split()), where, direction, width, turned, anchor)


def _points(text: str) -> tuple[tuple[Knot, ...], str]:
    """The knots at the begin of a text, and the rest."""
    knots = []
    while found := _POINT.match(text):
        knots.append((int(found[1]), int(found[2])))
        text = text[found.end() :]
    return tuple(knots), text.strip()


def yarn_number(name: str, yarns: Sequence[Yarn]) -> int:
    """Index of the yarn of a name, or of the one nearest to a colour #rrggbb. Raises CarpetError."""
    if name.startswith("#"):
        return int(nearest(srgb_to_lab(np.array([srgb_of(name)], dtype=np.uint8)), yarn_labs(yarns))[0][0])
    names = {yarn.name.casefold(): number for number, yarn in enumerate(yarns)}
    if name.casefold() not in names:
        allowed = f"a yarn of the list, or a colour like #9e2b25: {shortened(', '.join(y.name for y in yarns), 400)}"
        raise CarpetError(
            Sentence("recipe.unknown-yarn", name=shortened(name)),
            allowed=allowed,
            do=did_you_mean(name.casefold(), names),
        )
    return names[name.casefold()]


def srgb_of(name: str) -> tuple[int, int, int]:
    """The codes of a colour #rrggbb. Raises CarpetError.

    >>> srgb_of("#9e2b25")
    (158, 43, 37)
    """
    if not re.fullmatch("#[0-9a-fA-F]{6}", name):
        raise CarpetError(f"{shortened(name)!r} is no colour", allowed="# and six hexadecimal digits, like #9e2b25")
    return int(name[1:3], 16), int(name[3:5], 16), int(name[5:7], 16)


def named_yarns(edit: Edit, yarns: Sequence[Yarn]) -> tuple[int, ...]:
    """Indices of the yarns of an edit: one; of `replace` old and new, of `jufti`, `mirror`, `repeat`, `copy` none.

    Raises CarpetError.
    """
    if edit.kind in _WITHOUT_YARN:
        return ()
    if edit.kind != "replace":
        return (yarn_number(edit.yarns, yarns),)
    old, by, new = edit.yarns.partition(" by ")
    if by:
        return yarn_number(old, yarns), yarn_number(new, yarns)
    words = edit.yarns.split(" ")
    splits = [(" ".join(words[:count]), " ".join(words[count:])) for count in range(1, len(words))]
    names = {yarn.name.casefold() for yarn in yarns}
    known = [pair for pair in splits if all(name.startswith("#") or name.casefold() in names for name in pair)]
    if len(known) != 1:
        raise CarpetError(f"{edit.yarns!r} does not name two yarns of the list", do="write replace YARN by YARN")
    return yarn_number(known[0][0], yarns), yarn_number(known[0][1], yarns)


def outside_grid(edit: Edit, rows: int, columns: int) -> str | None:
    """The first knot of an edit that lies outside a grid, in words; None: none does."""
    knots = (knot for knot in edit.knots if not (1 <= knot[0] <= rows and 1 <= knot[1] <= columns))
    return next((Sentence("recipe.knot-outside", row=row, column=column) for row, column in knots), None)


def check_knots(edit: Edit, rows: int, columns: int) -> None:
    """Raise CarpetError for a knot outside the grid."""
    if outside := outside_grid(edit, rows, columns):
        raise CarpetError(outside, allowed=Sentence("recipe.grid", rows=rows, columns=columns))


def apply_edit(knots: Indices, edit: Edit, yarns: tuple[int, ...], progress: Progress = SILENT) -> None:
    """Apply an edit to the knots of a chart, row 0 on top; yarns: indices as of `named_yarns`."""
    at = [(len(knots) - row, column - 1) for row, column in edit.knots]
    if edit.kind in _APPLY:  # half and jufti knots are marks beside the knots
        _APPLY[edit.kind](knots, at, yarns, progress)
    elif edit.kind == "mirror":
        complete(knots_between(knots, at), edit.direction)
    elif edit.kind == "repeat":
        _repeat(knots, at)
    elif edit.kind == "stroke":
        _stroke(knots, at, edit, yarns, progress)
    elif edit.kind in ("copy", "move"):
        _copy(knots, at, edit, yarns)
    elif edit.kind == "border":
        part = knots_between(knots, at)
        rows, columns = part.shape
        for side in edges(rows, columns, (min(edit.width, rows), min(edit.width, columns))):
            part[side] = yarns[0]


def knots_between(knots: Indices, corners: list[Knot]) -> UInt8[np.ndarray, "high wide"]:
    """The part of the knots between two opposite corners, whose knots belong to it; the whole without corners."""
    if not corners:
        return knots
    (top, left), (bottom, right) = np.sort(np.array(corners), axis=0).tolist()
    return knots[top : bottom + 1, left : right + 1]


def _repeat(knots: Indices, at: list[Knot]) -> None:
    """Repeat the part between the first two knots over that between the next two, or the whole; it stays in place."""
    top, left = min(row for row, _ in at[:2]), min(column for _, column in at[:2])
    tile = knots_between(knots, at[:2]).copy()
    first = (min(row for row, _ in at[2:]), min(column for _, column in at[2:])) if at[2:] else (0, 0)
    part = knots_between(knots, at[2:])
    rows = (np.arange(len(part)) + first[0] - top) % len(tile)
    columns = (np.arange(part.shape[1]) + first[1] - left) % tile.shape[1]
    for band in bands(*part.shape):
        part[band] = tile[np.ix_(rows[band], columns)]


def _stroke(knots: Indices, at: list[Knot], edit: Edit, yarns: tuple[int, ...], progress: Progress) -> None:
    knots[stroke_knots(at, edit.width, knots.shape, progress)] = yarns[0]


def stroke_knots(
    at: Sequence[Knot], width: int, shape: tuple[int, ...], progress: Progress = SILENT
) -> tuple[Int64[np.ndarray, " knots"], Int64[np.ndarray, " knots"]]:
    """Rows and columns of the knots of lines from knot to knot, drawn with a round brush, that lie on a grid."""
    spans, drawn = brush_spans(width), np.zeros(shape, dtype=bool)
    for count, ends in enumerate(zip(at, at[1:] or at, strict=False)):
        for row, column in zip(*(line.tolist() for line in line_knots(*ends)), strict=True):
            for down, (left, right) in spans:
                if 0 <= row + down < shape[0]:
                    drawn[row + down, max(column + left, 0) : max(column + right, 0)] = True
        progress((count + 1) / len(at))
    rows, columns = np.nonzero(drawn)
    return rows, columns


def _copy(knots: Indices, at: list[Knot], edit: Edit, yarns: tuple[int, ...]) -> None:
    """A rectangle again at another place, reflected and turned; of `move` its own place gets the yarn first."""
    part = knots_between(knots, at[:2])
    found = transformed(part.copy(), edit.direction, edit.turned)
    if edit.kind == "move":
        part[:] = yarns[0]
    bottom, left = max(row for row, _ in at[2:]), min(column for _, column in at[2:])
    top = bottom + 1 - len(found)
    place = knots[max(top, 0) : bottom + 1, left : left + found.shape[1]]
    place[:] = found[len(found) - len(place) :, : place.shape[1]]


def _set(knots: Indices, at: list[Knot], yarns: tuple[int, ...], progress: Progress) -> None:
    progress(0.0)
    for row, column in at:
        knots[row, column] = yarns[0]


def _line(knots: Indices, at: list[Knot], yarns: tuple[int, ...], progress: Progress) -> None:
    progress(0.0)
    knots[line_knots(*at)] = yarns[0]


def line_knots(begin: Knot, end: Knot) -> tuple[Int64[np.ndarray, " knots"], Int64[np.ndarray, " knots"]]:
    """Rows and columns of an 8-connected line between two knots; the same from either end.

    >>> [line.tolist() for line in line_knots((0, 0), (2, 4))]
    [[0, 0, 1, 1, 2], [0, 1, 2, 3, 4]]
    """
    begin, end = sorted((begin, end))
    steps = max(abs(end[0] - begin[0]), abs(end[1] - begin[1]), 1)
    number = np.arange(steps + 1)
    rows, columns = (
        first + (2 * number * (last - first) + steps - (last > first)) // (2 * steps)
        for first, last in zip(begin, end, strict=True)
    )
    return rows, columns


def _replace(knots: Indices, at: list[Knot], yarns: tuple[int, ...], progress: Progress) -> None:
    knots = knots_between(knots, at)
    for band in bands(*knots.shape):
        part = knots[band]
        part[part == yarns[0]] = yarns[1]
        progress(band.stop / len(knots))


def _fill(knots: Indices, at: list[Knot], yarns: tuple[int, ...], progress: Progress) -> None:
    ((row, column),) = at
    old = int(knots[row, column])
    if old == yarns[0]:
        return
    stack = np.empty((4096, 2), dtype=np.int64)
    stack[0] = row, column
    count = 1
    while count:
        while len(stack) < count + knots.shape[1] + 4:  # a run of a row adds less than a row
            stack = np.concatenate([stack, np.empty_like(stack)])
        count = int(_flood(knots, stack, count, old, yarns[0], _FLOOD))
        progress(0.0)


@compiled
def _flood(knots: Indices, stack: Int64[np.ndarray, "knots 2"], count: int, old: int, new: int, most: int) -> int:  # noqa: C901, PLR0917 - one kernel
    """Fill runs of the row of each knot on the stack, until it is empty or nearly full or `most` knots are filled."""
    rows, columns = knots.shape
    filled = 0
    while count > 0 and filled < most:
        row, column = stack[count - 1, 0], stack[count - 1, 1]
        if knots[row, column] != old:
            count -= 1
            continue
        left = column
        while left > 0 and knots[row, left - 1] == old:
            left -= 1
        right = column
        while right < columns - 1 and knots[row, right + 1] == old:
            right += 1
        if count + right - left + 4 > len(stack):
            return count
        count -= 1
        for at in range(left, right + 1):
            knots[row, at] = new
        filled += right - left + 1
        for near in (row - 1, row + 1):
            if near < 0 or near >= rows:
                continue
            for at in range(left, right + 1):
                if knots[near, at] == old and (at == left or knots[near, at - 1] != old):
                    stack[count, 0], stack[count, 1] = near, at
                    count += 1
    return count


_APPLY: Mapping[str, Callable[[Indices, list[Knot], tuple[int, ...], Progress], None]] = {
    "set": _set,
    "fill": _fill,
    "line": _line,
    "replace": _replace,
}


@contextmanager
def located(where: str) -> Iterator[None]:
    """Add the file and line of an entry to errors raised inside."""
    try:
        yield
    except IlmekError as error:
        if not where or file_of(error.given) == (file_of(where) or where):
            raise
        raise CarpetError(with_location(where, error.given), allowed=error.allowed, do=error.do) from None
