"""Marks: half knots and jufti knots that edits set, and that other edits drop where they change a cell.

`replace` also replaces the second yarn of half knots.
"""

from dataclasses import dataclass, field

import numpy as np

from ilmek.arrays import Indices
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, Overlay, overlay_of
from ilmek.carpet.recipe.edits import Edit
from ilmek.errors import CarpetError


@dataclass(slots=True, eq=False)
class EditedMarks:
    """The marks of a chart while it is edited, by cell, row 0 on top; of each also the yarn of its cell."""

    marks: dict[tuple[int, int], tuple[KnotMark, int]] = field(default_factory=dict)

    @classmethod
    def of(cls, overlay: Overlay, knots: Indices) -> "EditedMarks":
        """The marks of a chart."""
        found = cls()
        for mark in overlay:
            found._put(mark, knots)
        return found

    def apply(self, edit: Edit, knots: Indices, yarns: tuple[int, ...]) -> None:
        """Follow an edit that has been applied to the knots; yarns: its indices. Raises CarpetError."""
        at = [(len(knots) - row, column - 1) for row, column in edit.knots]
        if edit.kind == "half":
            if knots[at[0]] == yarns[0]:
                given = f"half {edit.knots[0][0]},{edit.knots[0][1]}: its cell has this yarn already"
                raise CarpetError(given, allowed="another yarn on its right warp", do="leave the edit out")
            self._put(KnotMark(*at[0], HALF, yarns[0]), knots)
        elif edit.kind == "jufti":
            self._jufti(at, knots)
        elif self.marks:
            if edit.kind == "replace":
                self._replace(at, yarns)
            kept = self.marks.items()
            self.marks = {cell: found for cell, found in kept if self._stands(found[0], found[1], knots)}

    def halves(self, corners: list[tuple[int, int]], second: int) -> list[tuple[int, int]]:
        """Cells of the half knots with a second yarn, between two opposite corners, or in the whole carpet."""
        ends = sorted(row for row, _ in corners), sorted(column for _, column in corners)
        return [
            cell
            for cell, (mark, _) in self.marks.items()
            if mark.kind == HALF
            and mark.second == second
            and (not corners or all(low <= number <= high for number, (low, high) in zip(cell, ends, strict=True)))
        ]

    def overlay(self) -> Overlay:
        """The marks as an overlay. Raises CarpetError for too many."""
        return overlay_of(mark for mark, _ in self.marks.values())

    def _put(self, mark: KnotMark, knots: Indices) -> None:
        cells = [(mark.row, mark.column + step) for step in ((0, 1) if mark.kind == JUFTI else (0,))]
        left = (mark.row, mark.column - 1)
        if left in self.marks and self.marks[left][0].kind == JUFTI:
            cells.append(left)
        for cell in cells:
            self.marks.pop(cell, None)
        self.marks[mark.row, mark.column] = mark, int(knots[mark.row, mark.column])

    def _jufti(self, at: list[tuple[int, int]], knots: Indices) -> None:
        if len(at) == 1:
            row, column = at[0]
            if column + 1 >= knots.shape[1] or knots[row, column] != knots[row, column + 1]:
                given = f"jufti {len(knots) - row},{column + 1}: this cell and the next one are not of one yarn"
                raise CarpetError(given, allowed="two neighbours of one yarn")
            self._put(KnotMark(row, column, JUFTI), knots)
            return
        (top, left), (bottom, right) = np.sort(np.array(at), axis=0).tolist()
        for row in range(top, bottom + 1):
            column = left
            while column < right:
                if knots[row, column] == knots[row, column + 1]:
                    self._put(KnotMark(row, column, JUFTI), knots)
                    column += 1
                column += 1

    def _replace(self, at: list[tuple[int, int]], yarns: tuple[int, ...]) -> None:
        for cell in self.halves(at, yarns[0]):
            mark, yarn = self.marks[cell]
            self.marks[cell] = mark._replace(second=yarns[1]), yarn

    @staticmethod
    def _stands(mark: KnotMark, yarn: int, knots: Indices) -> bool:
        cells = knots[mark.row, mark.column : mark.column + (2 if mark.kind == JUFTI else 1)]
        return bool((cells == yarn).all()) and not (mark.kind == HALF and mark.second == yarn)
