"""Anchors: what the rows and columns of an edit count.

carpet   the knots of a carpet of a stated grid; on another grid the edit follows the design: a border stays a border,
         a motif a motif, and what lies in the picture follows the picture
picture  the cells of a grid over the picture of the field, default: its pixels; also in its reflections
motif 2  the knots of the second motif of the recipe, in each of its copies
border 2 the knots of the repeat of the second border, as it stands on the upper side, in each repeat on all four sides
corner 2 the knots of the upper left corner of the second border, where it has a picture of its own, in all four corners
knots    the knots of a carpet of a stated grid, and of no other one
"""

import re
from dataclasses import dataclass

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError, did_you_mean, shortened

CARPET, PICTURE, MOTIF, BORDER, CORNER, KNOTS = ANCHORS = ("carpet", "picture", "motif", "border", "corner", "knots")
REPEATED = (PICTURE, MOTIF, BORDER, CORNER)
"""Parts of a design that a carpet may show several times."""

NUMBERED = (MOTIF, BORDER, CORNER)
"""Parts of which a recipe has several, from 1."""

LARGEST_GRID = 1_000_000
"""Largest number of rows or columns of a grid."""


@dataclass(frozen=True, slots=True)
class Anchor:
    """What the rows and columns of an edit count.

    on       of ANCHORS      number  of a part of NUMBERED, from 1
    grid     rows and columns; None: those of the carpet of `size` and `quality`, or of the carpet that is made
    size, quality  of the carpet on which the edit was made; None: not stated
    """

    on: str = CARPET
    number: int = 0
    grid: tuple[int, int] | None = None
    size: CarpetSize | None = None
    quality: Quality | None = None

    @property
    def is_open(self) -> bool:
        """Whether it states nothing: the edits count the knots of the carpet that is made."""
        return self.on == CARPET and self.grid is None

    @property
    def name(self) -> str:
        """As in a file: `motif 2`."""
        return f"{self.on} {self.number}" if self.number else self.on


def parse_anchor(text: str) -> tuple[str, int]:
    """Kind and number of an anchor's name. Raises CarpetError.

    >>> parse_anchor("motif 2"), parse_anchor("carpet")
    (('motif', 2), ('carpet', 0))
    """
    kind, _, number = text.strip().partition(" ")
    if kind not in ANCHORS or bool(number) != (kind in NUMBERED) or not re.fullmatch(r"([1-9]\d?)?", number):
        allowed = "carpet, picture, motif 1 (or 2, 3, ...), border 1, corner 1, knots"
        raise CarpetError(
            f"{shortened(text)!r} is nothing to count on", allowed=allowed, do=did_you_mean(kind, ANCHORS)
        )
    return kind, int(number or 0)


def parse_grid(text: str) -> tuple[int, int]:
    """Rows and columns of a text, columns first. Raises CarpetError.

    >>> parse_grid("300x450")
    (450, 300)
    """
    found = re.fullmatch(r"\s*(\d{1,7})\s*[x×]\s*(\d{1,7})\s*", text)
    columns, rows = (int(found[1]), int(found[2])) if found else (0, 0)
    if not (1 <= rows <= LARGEST_GRID and 1 <= columns <= LARGEST_GRID):
        raise CarpetError(f"{shortened(text)!r} is no grid", allowed='columns x rows, like "300x450"')
    return rows, columns


def grid_text(grid: tuple[int, int]) -> str:
    """A grid as text, columns first.

    >>> grid_text((450, 300))
    '300x450'
    """
    return f"{grid[1]}x{grid[0]}"
