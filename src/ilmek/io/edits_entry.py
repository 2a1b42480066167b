"""The edits of a recipe: a list of lines, or tables of lines that state what these count.

edits = ["replace ivory by camel"]

[[edits]]
on = "carpet"               # or "picture", "motif 1", "border 1", "corner 1", "knots"
grid = "300x450"            # columns x rows
quality = "25x25/dm"        # of the carpet on which they were made, where borders have their width in mm
lines = ["set 12,40 madder red"]
"""

from collections.abc import Callable
from typing import Any

from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.recipe.anchor import CARPET, KNOTS, PICTURE, Anchor, parse_anchor, parse_grid
from ilmek.carpet.recipe.edits import FORMS, Edit, parse_edit
from ilmek.carpet.recipe.recipe import MOST_EDITS
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.io.file_entry import FileEntry
from ilmek.io.schema import shown
from ilmek.report import Json
from ilmek.sentences import Sentence

EXAMPLE = 'write edits = ["set 12,40 ivory"], or [[edits]] with lines = [...]'


def read_edits(
    root: FileEntry, where: Callable[[FileEntry], str], size: CarpetSize | None, quality: Quality | None
) -> tuple[Edit, ...]:
    """The edits of a recipe.

    where  file and line of an entry, for messages
    size, quality  that the recipe states: those of edits that state nothing
    Raises IlmekError with the line for an edit or a table that cannot be read, and for too many.
    """
    entries = root.data.get("edits", [])
    if not isinstance(entries, list):
        root.refuse(CarpetError(f"{shown(entries)} is not a list", do=EXAMPLE), "edits")
    own = Anchor(size=size, quality=quality)
    lines: list[tuple[FileEntry, Any, Anchor]] = []
    for number, entry in enumerate(entries):
        if isinstance(entry, dict):
            table = FileEntry(entry, ("edits", number), root.source)
            anchor = _anchor(table)
            lines += [
                (_entry(root, "edits", number, "lines", at), line, anchor) for at, line in enumerate(_lines(table))
            ]
        else:
            lines.append((_entry(root, "edits", number), entry, own))
    if len(lines) > MOST_EDITS:
        root.refuse(CarpetError(f"has {len(lines):,} edits", allowed=f"at most {MOST_EDITS:,}"), "edits")
    return tuple(_edit(entry, line, where, anchor) for entry, line, anchor in lines)


def _entry(root: FileEntry, *path: str | int) -> FileEntry:
    return FileEntry({}, path, root.source)


def _edit(entry: FileEntry, line: object, where: Callable[[FileEntry], str], anchor: Anchor) -> Edit:
    if not isinstance(line, str):
        entry.refuse(CarpetError(f"{shown(line)} is no edit", allowed=", ".join(FORMS.values())))
    with entry.located():
        return parse_edit(line, where(entry), anchor)


def _lines(table: FileEntry) -> list[Json]:
    lines = table.data["lines"]
    if not isinstance(lines, list):
        table.refuse(CarpetError(f"{shown(lines)} is not a list", do='write lines = ["set 12,40 ivory"]'), "lines")
    return lines


def _anchor(table: FileEntry) -> Anchor:
    """What the edits of a table count."""
    table.keys("on", "grid", "quality", "lines", needs=("lines",))
    with table.located():
        on, number = parse_anchor(table.text("on", CARPET))
        grid = parse_grid(table.text("grid")) if table.has("grid") else None
        quality = parse_quality(table.text("quality")) if table.has("quality") else None
    if grid is None and on in (PICTURE, KNOTS):
        table.refuse(CarpetError(Sentence("recipe.no-grid", on=on), do=Sentence("recipe.give-grid")))
    return Anchor(on, number, grid, quality=quality)
