"""Finish: what a recipe fixes on the chart of its design: drawn areas, yarns that it names, and edits."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray, Indices, Pixels
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import nearest
from ilmek.carpet.design import bands
from ilmek.carpet.differences import YarnDifference
from ilmek.carpet.overlay import overlay_of
from ilmek.carpet.recipe.composition import Composition
from ilmek.carpet.recipe.edits import Edit, apply_edit, check_knots, knots_between, located, named_yarns
from ilmek.carpet.recipe.marks import EditedMarks
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress


def finish(
    chart: Chart, recipe: Recipe, yarns: Sequence[Yarn], made: Composition | None, progress: Progress = SILENT
) -> Chart:
    """The chart of a recipe from that of its design.

    yarns  the whole list      made  the composition; None: one whole picture
    A yarn that the recipe names is in the chart, whatever the palette rules chose.
    Raises CarpetError, with file and line, for an edit outside the grid, of a yarn that is not in the list, and for
    one that replaces a yarn which no knot has.
    """
    if made is None and not recipe.edits:
        return chart
    numbers = []
    for edit in recipe.edits:
        with located(edit.where):
            check_knots(edit, chart.rows, chart.columns)
            numbers.append(named_yarns(edit, yarns))
    named = {number for found in numbers for number in found}
    named |= {number for _, number in made.yarns} if made is not None else set()
    chart, index = _with_yarns(chart, yarns, named)
    knots = chart.knots.copy()
    if made is not None:
        _draw_composed(knots, chart.yarns, made, index, progress.part(0.0, 0.5))
    before = knots.copy() if recipe.edits else knots
    editing = progress.part(0.5, 0.9, "edits")
    marks = EditedMarks()
    marks.start(chart.overlay, knots)
    for count, (edit, found) in enumerate(zip(recipe.edits, numbers, strict=True)):
        part = editing.part(count / len(numbers), (count + 1) / len(numbers))
        own = tuple(index[number] for number in found)
        with located(edit.where):
            if edit.kind == "replace":
                _check_replaced(knots, marks, edit, own[0])
            apply_edit(knots, edit, own, part)
            marks.apply(edit, knots, own)
    changed = sum(int(np.count_nonzero(knots[band] != before[band])) for band in bands(*knots.shape))
    reading = replace(chart.reading, edited=changed)
    finished = replace(chart, knots=knots, overlay=marks.overlay(), reading=reading)
    finished.tally(progress.part(0.9, 1.0))
    return finished


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
    table = np.array([new[yarn.name] for yarn in chart.yarns], dtype=np.uint8)
    knots: Indices = np.empty_like(chart.knots)
    for band in bands(*knots.shape):
        knots[band] = table[chart.knots[band]]
    known = dict(zip((yarn.name for yarn in chart.yarns), chart.reading.differences, strict=False))
    none = YarnDifference(0.0, 0.0)
    reading = replace(
        chart.reading,
        differences=tuple(known.get(yarn.name, none) for yarn in chosen) if known else (),
        matches=tuple(match._replace(yarn=int(table[match.yarn])) for match in chart.reading.matches),
    )
    seconds = (mark._replace(second=int(table[mark.second])) for mark in chart.overlay)
    made = replace(chart, knots=knots, yarns=chosen, overlay=overlay_of(seconds), reading=reading)
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
