"""Outcome: what became of an edit that was written on another grid, or that has no place on the carpet."""

from ilmek.carpet.recipe.anchor import grid_text
from ilmek.carpet.recipe.edits import Edit, Knot
from ilmek.records import record
from ilmek.report import Json
from ilmek.report.check import Check, at_most
from ilmek.sentences import Sentence
from ilmek.units import counted, format_quantity

MOST_CARRIED, MOST_LEFT_OUT = 10, 100
"""Largest numbers of edits that have a note of their own: of those that are carried, and of those that are not."""


@record
class EditOutcome:
    """What became of an edit.

    grid     rows and columns that it counts; None: it states none
    knots    that it changed      part  its lowest and its highest row and column on the carpet; None: it has none
    details  separate groups of knots that it gives, and how many of them are left out as a whole
    reason   why it, or a part of it, is left out; "": it is not
    lost     share that is left out of the knots that it gives on its own grid: of a fill those of its area, of an edit
             of a rectangle those of it, of a copy those of the copy
    """

    edit: Edit
    grid: tuple[int, int] | None
    knots: int = 0
    part: tuple[Knot, Knot] | None = None
    details: tuple[int, int] = (1, 0)
    reason: str = ""
    lost: float = 0.0

    @property
    def words(self) -> str:
        """The outcome as a sentence."""
        written = "" if self.grid is None else f" (of {self.edit.anchor.name} {grid_text(self.grid)})"
        given = f"edit {self.edit.text!r}{written}"
        if self.part is None:
            return f"{given} is left out: {self.reason}"
        (low, left), (high, right) = self.part
        done = f"{given}: rows {low} to {high}, columns {left} to {right}, {counted(self.knots, 'knot')} changed"
        groups = f"{self.details[1]} of {counted(self.details[0], 'detail')}, " if self.details[1] else ""
        share = f"{format_quantity(self.lost, '%', 3)} of its knots" if self.lost else "a part of it"
        return done + (f"; left out of it: {groups}{share}: {self.reason}" if self.reason else "")

    def as_plain(self) -> dict[str, Json]:
        """The outcome by its JSON names; rows and columns are lists of the first and the last one."""
        part = self.part or (None, None)
        sides = [[low, high] if part[0] else None for low, high in zip(*(end or (0, 0) for end in part), strict=True)]
        return {
            "edit": self.edit.text,
            "on": self.edit.anchor.name,
            "grid": None if self.grid is None else grid_text(self.grid),
            "knots": self.knots,
            "rows": sides[0],
            "columns": sides[1],
            "details": self.details[0],
            "left_out": self.details[1],
            "lost": self.lost,
            "reason": self.reason,
        }


def outcome_notes(outcomes: tuple[EditOutcome, ...]) -> tuple[str, ...]:
    """A note on each edit that is left out, then on those that are carried."""
    notes: list[str] = []
    for is_whole, most, what in ((False, MOST_LEFT_OUT, "left out"), (True, MOST_CARRIED, "carried")):
        words = [outcome.words for outcome in outcomes if (not outcome.reason) == is_whole]
        more = len(words) - most
        notes += words[:most]
        notes += [f"{counted(more, 'more edit')} {what}: results.edits in the JSON lists all"] if more > 0 else []
    return tuple(notes)


def edit_checks(outcomes: tuple[EditOutcome, ...]) -> tuple[Check, ...]:
    """A check that every edit has its place on the carpet, where any was carried or left out."""
    if not outcomes:
        return ()
    lost = sum(1 for outcome in outcomes if outcome.reason)
    cure, source = Sentence("check.edits-cure"), Sentence("check.edits-source")
    return (at_most(Sentence("check.edits"), lost, 0, "", source).with_cure(cure),)
