"""Finish: what a recipe fixes on the chart of its design: drawn areas, yarns that it names, and edits."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ilmek.arrays import Bool, FloatArray, Indices, Pixels
from ilmek.carpet.bill import names_to_buy
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import recoded
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import bands
from ilmek.carpet.differences import YarnDifference
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.overlay import overlay_of
from ilmek.carpet.recipe.anchor import Anchor
from ilmek.carpet.recipe.carry import carry
from ilmek.carpet.recipe.composition import Composition
from ilmek.carpet.recipe.edits import (
    Edit,
    Knot,
    apply_edit,
    check_knots,
    knots_between,
    located,
    named_yarns,
    outside_grid,
)
from ilmek.carpet.recipe.marks import EditedMarks
from ilmek.carpet.recipe.outcome import EditOutcome
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.recipe.structure import GridRelation
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress
from ilmek.records import record


@record
class EditedDesign:
    """The design on the grid that edits count.

    relation  of that grid to the carpet's      chart  of the design there, without edits; None: it is not known
    """

    relation: GridRelation
    chart: Chart | None = None


def finish(
    chart: Chart,
    recipe: Recipe,
    yarns: Sequence[Yarn],
    made: Composition | None,
    progress: Progress = SILENT,
    *,
    origins: Mapping[Anchor, EditedDesign | str] | None = None,
) -> Chart:
    """The chart of a recipe from that of its design.

    yarns  the whole list      made  the composition; None: one whole picture
    origins  of the edits that do not count the knots of this chart, by their anchors; a text is the reason why they
             cannot be carried. An edit that has no place on the chart is left out, and is in `reading.edits`
    A yarn that the recipe names is in the chart, whatever the palette rules chose.
    Raises CarpetError, with file and line, for an edit outside the grid that it states, of a yarn that is not in the
    list, and for one on this grid that replaces a yarn which no knot has.
    """
    if made is None and not recipe.edits:
        return chart
    numbers = []
    for edit in recipe.edits:
        with located(edit.where):
            numbers.append(named_yarns(edit, yarns))
    named = {number for found in numbers for number in found}
    named |= {number for _, number in made.yarns} if made is not None else set()
    chart, index = _with_yarns(chart, yarns, named)
    knots = chart.knots.copy()
    if made is not None:
        _draw_composed(knots, chart.yarns, made, index, progress.part(0.0, 0.5))
    if not recipe.edits:
        return _finished(chart, knots, EditedMarks.of(chart.overlay, knots), 0, (), progress)
    before, editing = knots.copy(), progress.part(0.5, 0.9, "edits")
    editor = _Editor(knots, EditedMarks.of(chart.overlay, knots), _sources(origins or {}, yarns, named))
    for count, (edit, found) in enumerate(zip(recipe.edits, numbers, strict=True)):
        part = editing.part(count / len(numbers), (count + 1) / len(numbers))
        with located(edit.where):
            editor.edit(edit, found, index, part)
    changed = sum(int(np.count_nonzero(knots[band] != before[band])) for band in bands(*knots.shape))
    return _finished(chart, knots, editor.marks, changed, tuple(editor.outcomes), progress)


def _finished(  # noqa: PLR0917
    chart: Chart,
    knots: Indices,
    marks: EditedMarks,
    changed: int,
    outcomes: tuple[EditOutcome, ...],
    progress: Progress,
) -> Chart:
    reading = replace(chart.reading, edited=changed, edits=outcomes)
    finished = replace(chart, knots=knots, overlay=marks.overlay(), reading=reading)
    finished.tally(progress.part(0.9, 1.0))
    return finished


@dataclass(slots=True)
class _Source:
    """Knots on the grid that edits count, with those edits that count it so far; indices of the list's yarns."""

    relation: GridRelation
    knots: Indices | None
    index: dict[int, int]


def _sources(
    origins: Mapping[Anchor, EditedDesign | str], yarns: Sequence[Yarn], named: set[int]
) -> dict[Anchor, _Source | str]:
    sources: dict[Anchor, _Source | str] = {}
    for anchor, origin in origins.items():
        if isinstance(origin, str):
            sources[anchor] = origin
        elif origin.chart is None:
            sources[anchor] = _Source(origin.relation, None, {})
        else:
            chart, index = _with_yarns(origin.chart, yarns, named)
            sources[anchor] = _Source(origin.relation, chart.knots.copy(), index)
    return sources


@dataclass(slots=True)
class _Editor:
    """The knots of a chart and their marks while they are edited, in place; what became of edits that are carried."""

    knots: Indices
    marks: EditedMarks
    sources: dict[Anchor, _Source | str]
    outcomes: list[EditOutcome] = field(default_factory=list)

    def edit(self, edit: Edit, numbers: tuple[int, ...], index: dict[int, int], progress: Progress) -> None:
        """Apply an edit, or list it where it has no place."""
        own = tuple(index[number] for number in numbers)
        source = self.sources.get(edit.anchor)
        if source is None:
            outside = outside_grid(edit, *self.knots.shape)
            if outside is not None and edit.anchor.grid is None:
                self.outcomes.append(
                    EditOutcome(edit, None, details=(1, 1), reason=f"{outside}; it states no grid", lost=1.0)
                )
                return
            check_knots(edit, *self.knots.shape)
            self._apply(edit, own, progress)
        elif isinstance(source, str):
            self.outcomes.append(EditOutcome(edit, edit.anchor.grid, details=(1, 1), reason=source, lost=1.0))
        else:
            check_knots(edit, *source.relation.grid)
            self._carry(edit, source, own, progress)
            if source.knots is not None:
                apply_edit(source.knots, edit, tuple(source.index[number] for number in numbers), progress)

    def _carry(self, edit: Edit, source: _Source, own: tuple[int, ...], progress: Progress) -> None:
        before = self.knots.copy()
        carried = carry(edit, source.relation, source.knots, self.knots, own)
        refused: list[tuple[Edit, str]] = []
        for one in carried.edits:
            try:
                self._apply(one, own, progress)
            except CarpetError as error:
                refused.append((one, error.given))
        applied = [one for one in carried.edits if one not in [edit for edit, _ in refused]]
        reason, details = carried.reason, carried.details
        if refused and not (edit.kind == "replace" and applied):  # a yarn needs not be in every part of its place
            reason, details = reason or refused[0][1], (details[0], max(1, details[1]))
        changed = self.knots != before
        part = _part(changed) or _written(applied)
        count = int(np.count_nonzero(changed))
        self.outcomes.append(EditOutcome(edit, source.relation.grid, count, part, details, reason, carried.lost))

    def _apply(self, edit: Edit, own: tuple[int, ...], progress: Progress) -> None:
        if edit.kind == "replace":
            _check_replaced(self.knots, self.marks, edit, own[0])
        apply_edit(self.knots, edit, own, progress)
        self.marks.apply(edit, self.knots, own)


def _part(changed: Bool[np.ndarray, "rows columns"]) -> tuple[Knot, Knot] | None:
    """The lowest and the highest row and column of knots, as edits count them; None: there are none."""
    if not changed.any():
        return None
    rows, columns = (np.flatnonzero(changed.any(axis=axis)) for axis in (1, 0))
    return (len(changed) - int(rows[-1]), int(columns[0]) + 1), (len(changed) - int(rows[0]), int(columns[-1]) + 1)


def _written(edits: Sequence[Edit]) -> tuple[Knot, Knot] | None:
    """The same of the knots that edits name."""
    knots = [knot for edit in edits for knot in edit.knots]
    if not knots:
        return None
    rows, columns = zip(*knots, strict=True)
    return (min(rows), min(columns)), (max(rows), max(columns))


def _check_replaced(knots: Indices, marks: EditedMarks, edit: Edit, old: int) -> None:
    """Raise CarpetError where no knot, and no half knot, has the yarn that is to be replaced."""
    corners = [(len(knots) - row, column - 1) for row, column in edit.knots]
    part = knots_between(knots, corners)
    if any((part[band] == old).any() for band in bands(*part.shape)) or marks.halves(corners, old):
        return
    where = "there" if edit.knots else "in the carpet"
    raise CarpetError(
        f"{edit.text!r} changes nothing: no knot {where} has the first yarn",
        allowed="a yarn that the knots have where the edit is made",
        do="look at the chart without this edit",
    )


def _with_yarns(chart: Chart, yarns: Sequence[Yarn], named: set[int]) -> tuple[Chart, dict[int, int]]:
    """The chart with the named yarns in its own list, and the index in it of each of these."""
    names = {yarn.name for yarn in chart.yarns}
    kept = [number for number, yarn in enumerate(yarns) if yarn.name in names or number in named]
    chosen = tuple(yarns[number] for number in kept)
    if chosen == chart.yarns:
        return chart, {number: at for at, number in enumerate(kept)}
    new = {yarn.name: at for at, yarn in enumerate(chosen)}
    table = np.array([new[name] for name in names_to_buy(chart)], dtype=np.uint8)
    knots = recoded(chart.knots, table)
    known = dict(zip((yarn.name for yarn in chart.yarns), chart.reading.differences, strict=False))
    none = YarnDifference(0.0, 0.0)
    reading = replace(
        chart.reading,
        differences=tuple(known.get(yarn.name, none) for yarn in chosen) if known else (),
        matches=tuple(match._replace(yarn=int(table[match.yarn])) for match in chart.reading.matches),
    )
    seconds = (mark._replace(second=int(table[mark.second])) for mark in chart.overlay)
    made = replace(chart, knots=knots, yarns=chosen, creel=None, overlay=overlay_of(seconds), reading=reading)
    return made, {number: at for at, number in enumerate(kept)}


def _draw_composed(
    knots: Indices, yarns: Sequence[Yarn], made: Composition, index: dict[int, int], progress: Progress
) -> None:
    """Draw into the knots of a chart, of its yarns, areas as they were drawn, and named yarns where they are."""
    colours = made.design.colours
    if made.drawn:
        labs = yarn_labs(yarns)
        for area, shown in made.drawn:
            np.copyto(knots[area], _nearest(colours[area], labs), where=True if shown is None else shown)
            progress(0.5)
    for (rows, columns), number in made.yarns:
        srgb = np.array(yarns[index[number]].srgb, dtype=np.uint8)
        for part in bands(rows.stop - rows.start, columns.stop - columns.start):
            band = (slice(rows.start + part.start, rows.start + part.stop), columns)
            knots[band][(colours[band] == srgb).all(axis=-1)] = index[number]
        progress(1.0)


def _nearest(colours: Pixels, labs: FloatArray) -> Indices:
    """The nearest yarn of each knot of a small area."""
    codes = colours.astype(np.int32) @ np.array([1 << 16, 1 << 8, 1], dtype=np.int32)
    found, at = np.unique(codes, return_inverse=True)
    channels = np.stack([found >> 16, found >> 8 & 255, found & 255], axis=-1).astype(np.uint8)
    return np.asarray(nearest(srgb_to_lab(channels), labs)[0].astype(np.uint8)[at].reshape(codes.shape))
