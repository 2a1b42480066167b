"""The chart of a recipe, and the recipe of a chart."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

from ilmek.arrays import Pixels
from ilmek.carpet.chart import Chart, used_first
from ilmek.carpet.chart_making import chart_of_design
from ilmek.carpet.exact import of_grid
from ilmek.carpet.palette_rules import PaletteParams, names_text, yarn_names
from ilmek.carpet.reading import READINGS
from ilmek.carpet.recipe.anchor import CARPET, KNOTS, MOTIF, REPEATED, Anchor, grid_text
from ilmek.carpet.recipe.composition import Composition, compose
from ilmek.carpet.recipe.edits import Edit, located, named_yarns
from ilmek.carpet.recipe.finish import EditedDesign, finish
from ilmek.carpet.recipe.layout import CarpetLayout
from ilmek.carpet.recipe.outcome import outcome_notes
from ilmek.carpet.recipe.parts import relate_part
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.recipe.structure import DesignStructure, relate
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError, IlmekError, PictureError
from ilmek.io.chart.formats import format_of, read_chart
from ilmek.io.picture import SMALLEST, read_picture
from ilmek.io.recipe_file import LoomKeys, RecipeFile
from ilmek.io.recipe_text import recipe_text
from ilmek.io.rendered.kind import RENDERED
from ilmek.io.rendered.resolution import Rendering
from ilmek.io.toml_text import written_quantity
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.charting import OrderedChart, chart_of_order, drawn_chart, file_key, rendering_of, shown_source
from ilmek.jobs.order import GROUPS, CarpetOrder, ResolvedOrder, check_sheets, recipe_key
from ilmek.jobs.recipe_size import of_its_shape, size_of_recipe
from ilmek.jobs.stages import ANEW, Stages
from ilmek.params import declared
from ilmek.progress import SILENT, Progress
from ilmek.units import counted


def chart_of_recipe(
    order: CarpetOrder, progress: Progress = SILENT, *, with_source: bool = False, stages: Stages = ANEW
) -> OrderedChart:
    """As `charting.chart_of_order`, of an order whose picture is a recipe; the source is the design as composed.

    Raises as it does.
    """
    recipe = order.recipe
    assert recipe is not None
    _check_never(recipe, order.palette)
    given, order = replace(order, fit=order.fit.without_sides), replace(order, palette=_keeping(recipe, order))
    done, made = _designed(order, progress.part(0.0, 0.8), stages, with_source=with_source)
    origins, carrying = _origins(done, order, made, stages)
    yarns = _counted(done.order)
    chart = finish(done.chart, recipe, yarns, made, progress.part(0.85, 1.0, "edits"), origins=origins)
    chart = used_first(chart) if recipe.edits or made is not None else chart
    chart = chart if made is None else made.piled(chart)
    notes = (*done.notes, *carrying, *outcome_notes(chart.reading.edits))
    return replace(done, order=replace(done.order, order=given), chart=chart, notes=notes)


def _designed(
    order: CarpetOrder, progress: Progress, stages: Stages, *, with_source: bool = False
) -> tuple[OrderedChart, Composition | None]:
    """The chart of a recipe without its edits, and its composition; None: it is one whole picture."""
    recipe = order.recipe
    assert recipe is not None
    if recipe.is_composed:
        return _composed_chart(recipe, order, progress, stages, with_source=with_source)
    assert recipe.picture is not None
    picture = replace(order, picture=recipe.picture, recipe=None)
    try:
        edited = bool(recipe.edits)
        done = chart_of_order(picture, progress, with_source=with_source, stages=stages, edited=edited)
    except IlmekError as error:
        with located(recipe.where if isinstance(error, PictureError) else str(recipe.file)):
            raise
    reason = f"{done.chart.reading.reason} (picture of {recipe.file.name})"
    return replace(done, chart=done.chart.read_as(replace(done.chart.reading, reason=reason))), None


def _composed_chart(
    recipe: Recipe, order: CarpetOrder, progress: Progress, stages: Stages, *, with_source: bool
) -> tuple[OrderedChart, Composition]:
    """The chart of a recipe that is more than one whole picture, without its edits."""
    plain = replace(recipe, edits=())
    files = tuple(file_key(path) for path in recipe.pictures)
    read = cache(
        lambda: _pictures(recipe, order.fit.ground, rendering_of(order), progress.part(0.0, 0.3, "picture"), stages)
    )
    if order.size is None:
        quality = order.resolved().quality
        shape = (plain, files, quality, order.fit)
        size = stages.keep("shape", shape, lambda: size_of_recipe(recipe, quality, order.fit, read()[0]))
        order = replace(order, size=size, fit=of_its_shape(order.fit))
    made = order.resolved()
    check_sheets(made.size, made.quality, order)
    key = (plain, files, made.size, made.quality, made.yarns, order.fit, order.reading)

    def composed() -> tuple[Composition, tuple[str, ...]]:
        pictures, notes = read()
        composition = compose(
            recipe,
            made.size,
            made.quality,
            made.yarns,
            pictures,
            fit=order.fit,
            reading=order.reading,
            progress=progress.part(0.4, 0.6, "chart"),
        )
        return composition, (*notes, *composition.notes)

    def charted() -> Chart:
        return chart_of_design(
            stages.shown(key, composition.design),
            made.size,
            made.quality,
            made.yarns,
            knot=made.knot,
            fit=composition.structure.fit,
            reading=order.reading,
            palette=order.palette,
            dyed=order.dyed,
            chosen=stages.in_shades,
            progress=progress.part(0.6, 1.0, "chart"),
        )

    composition, notes = stages.keep("composition", key, composed)
    chart = stages.keep("chart", (key, made.knot, order.palette, order.dyed, stages.in_shades), charted)
    source = shown_source(composition.design.colours) if with_source else None
    return OrderedChart(made.with_dyed(chart.yarns), chart, notes, source), composition


def _origins(
    done: OrderedChart, order: CarpetOrder, made: Composition | None, stages: Stages
) -> tuple[dict[Anchor, EditedDesign | str], tuple[str, ...]]:
    """The designs on the grids that the edits count, where these are not the carpet's, and a note on edits without."""
    recipe, grid = order.recipe, (done.chart.rows, done.chart.columns)
    assert recipe is not None
    found: dict[Anchor, EditedDesign | str] = {}
    target = _structure(recipe, done.chart, made)
    for edit in recipe.edits:
        anchor = edit.anchor
        if anchor in found or (anchor.on in (CARPET, KNOTS) and (anchor.grid == grid or _is_ordered(anchor, order))):
            continue
        with located(edit.where):
            if anchor.on in REPEATED:
                found[anchor] = EditedDesign(relate_part(target, anchor))
            elif (origin := _origin(anchor, done, order, target, stages)) is not None:
                found[anchor] = origin
    return found, _open_note(recipe, grid, found)


def _open_note(recipe: Recipe, grid: tuple[int, int], origins: Mapping[Anchor, EditedDesign | str]) -> tuple[str, ...]:
    """A note on edits that state no grid, with the grid that they count."""
    anchors = [edit.anchor for edit in recipe.edits if edit.knots and edit.anchor.is_open]
    if not anchors:
        return ()
    origin = origins.get(anchors[0])
    counts = grid_text(origin.relation.grid if isinstance(origin, EditedDesign) else grid)
    given = f"{counted(len(anchors), 'edit')} of {recipe.file.name} without a grid: at another size these knots lie "
    cure = f'elsewhere in the design; write [[edits]] with grid = "{counts}" and lines = [...], as --save-recipe does'
    return (given + cure,)


def _is_ordered(anchor: Anchor, order: CarpetOrder) -> bool:
    """Whether edits that state no grid were written for the size and quality of an order."""
    return (
        anchor.grid is None
        and (anchor.size is None or anchor.size == order.size)
        and (anchor.quality is None or anchor.quality == order.quality)
    )


def _origin(
    anchor: Anchor, done: OrderedChart, order: CarpetOrder, target: DesignStructure, stages: Stages
) -> EditedDesign | str | None:
    """The design on the carpet of an anchor, or why its edits cannot be carried; None: it has the grid of this one."""
    recipe = replace(target.recipe, edits=())
    try:
        size, quality = anchor.size or order.size, anchor.quality
        if anchor.grid is not None:
            size, quality = of_grid(anchor.grid, None, quality or done.order.quality)
        fit = order.fit if size is None else order.fit.without_sides
        other = replace(order, size=size, quality=quality, recipe=recipe, pdf=False, fit=fit)
        files = tuple(file_key(path) for path in recipe.pictures)
        key = (recipe, files, size, quality, order.yarns, order.fit, order.reading, order.palette)
        old, made = stages.keep("origin of edits", key, lambda: _designed(other, SILENT, ANEW))
    except IlmekError as error:
        return f"the design cannot be made on the grid that it states: {error.given}"
    if (old.chart.rows, old.chart.columns) == target.grid:
        return None
    if anchor.on == KNOTS:
        return f"its knots are those of a carpet of {grid_text((old.chart.rows, old.chart.columns))} knots"
    try:
        return EditedDesign(relate(_structure(recipe, old.chart, made), target), old.chart)
    except CarpetError as error:
        return error.given


def _structure(recipe: Recipe, chart: Chart, made: Composition | None) -> DesignStructure:
    """Where the parts of a design lie."""
    if made is not None:
        return made.structure
    grid = chart.rows, chart.columns
    return DesignStructure(recipe, grid, CarpetLayout((), (0, 0), grid), chart.reading.fit)


def _check_never(recipe: Recipe, palette: PaletteParams) -> None:
    """Raise CarpetError for a yarn that the recipe names and that the palette rules exclude."""
    never = {name.casefold() for name in yarn_names("never", palette.never)}
    for name, where in recipe.named:
        if name.casefold() in never:
            with located(where):
                raise CarpetError(f"{name!r} is named, and never excludes it", do="leave it out of one")


def _keeping(recipe: Recipe, order: CarpetOrder) -> PaletteParams:
    """The palette rules, where they choose yarns with the yarns that the recipe names among those that are kept.

    Where a yarn is replaced in the whole carpet the old one is kept: its knots become the new one's.
    Raises CarpetError for more of them than colours.
    """
    rules = order.palette
    if rules.colours is None and not rules.least_share:
        return rules
    yarns = order.yarns or default_yarns()
    listed = {yarn.name.casefold(): yarn.name for yarn in yarns}
    names = [name for name, _ in recipe.laid]
    for edit in recipe.edits:
        with located(edit.where):
            edited = [yarns[number].name for number in named_yarns(edit, yarns) if not edit.yarns.startswith("#")]
        names += edited[:1] if edit.kind == "replace" and not edit.knots else edited
    kept = {name.casefold(): name for name in yarn_names("keep", rules.keep)}
    kept |= {name.casefold(): listed[name.casefold()] for name in names if name.casefold() in listed}
    if isinstance(rules.colours, int) and len(kept) > rules.colours:
        raise CarpetError(
            f"{recipe.file}: colours = {rules.colours}, and {len(kept)} yarns are named: {', '.join(kept.values())}",
            do=f"give at least colours = {len(kept)}, or name fewer yarns",
        )
    return replace(rules, keep=names_text(kept.values())) if kept else rules


def _counted(made: ResolvedOrder) -> tuple[Yarn, ...]:
    """The whole list of yarns, as a chart has them."""
    return with_counts(made.yarns, made.quality, made.knot)


def _pictures(
    recipe: Recipe, ground: str | None, rendering: Rendering, progress: Progress, stages: Stages
) -> tuple[Mapping[Path, Pixels], tuple[str, ...]]:
    """The pixels of all pictures, and notes on them; rendering: of the field's picture."""
    found, notes = {}, []
    files = recipe.pictures
    for number, (path, where) in enumerate(files.items()):
        part = progress.part(number / len(files), (number + 1) / len(files))
        with located(where):
            if path == recipe.picture:
                smallest, drawn = SMALLEST, rendering
            elif path.suffix.lower() in RENDERED:
                raise CarpetError(f"{path.name} has no pixels", do="save a tile or a motif as PNG, one pixel one knot")
            else:
                smallest, drawn = 1, None
            key = (file_key(path), smallest, ground, drawn)
            found[path], more = stages.keep("tile", key, partial(picture_pixels, path, smallest, part, ground, drawn))
        notes += [f"{path.name}: {note}" for note in more]
    return found, tuple(notes)


def picture_pixels(
    path: Path, smallest: int, progress: Progress, ground: str | None = None, rendering: Rendering | None = None
) -> tuple[Pixels, tuple[str, ...]]:
    """The pixels of a picture, or of a chart that is none, which has its yarns' colours; and notes."""
    chosen = format_of(path)
    if chosen is None or chosen.picture:
        picture = read_picture(path, progress, smallest=smallest, ground=ground, rendering=rendering)
        return picture.rgb, picture.notes
    chart, notes = read_chart(path, progress=progress)
    bare = () if chart.cells is None else ("its map of cells is not kept: all cells are tied, as those beside",)
    return drawn_chart(chart), (*notes, *bare)


def saved_recipe(made: ResolvedOrder, chart: Chart, folder: Path, loom: LoomKeys | None = None) -> str:
    """The text of the recipe of a chart, for a file in a folder: all that was set, and size, quality, knot and reading
    as they were decided.

    Raises CarpetError for a picture that does not lie in the folder.
    """
    order = made.order
    recipe = _anchored(order.recipe or Recipe(folder / "carpet.toml", order.picture), made, chart)
    decided = {} if recipe.is_composed or chart.reading.kind not in READINGS else {"reading": chart.reading.kind}
    settings = {}
    for group, cls in GROUPS.items():
        values = {**getattr(order, group).as_dict()}
        for parameter in declared(cls):
            value = values[parameter.name]
            if value == parameter.default:
                value = decided.get(parameter.name, value)
            if value != parameter.default:
                is_real = isinstance(value, float) and parameter.unit not in ("", "1")
                settings[recipe_key(parameter)] = written_quantity(value, parameter.unit) if is_real else value
    file = RecipeFile(
        recipe,
        made.size,
        made.quality,
        made.knot,
        order.yarns,
        order.yarn_file,
        order.pdf,
        settings,
        loom or order.loom,
    )
    return recipe_text(file, folder)


def _anchored(recipe: Recipe, made: ResolvedOrder, chart: Chart) -> Recipe:
    """The recipe with the grid that its edits count: that of the chart where they state none and were not carried."""
    counts = {outcome.edit: outcome.grid for outcome in chart.reading.edits}
    own = chart.rows, chart.columns

    def stated(edit: Edit) -> Edit:
        if edit.anchor.grid is not None or edit.anchor.on == MOTIF:
            return edit
        grid = counts.get(edit) or own
        quality = made.quality if grid == own else edit.anchor.quality
        return replace(edit, anchor=replace(edit.anchor, grid=grid, quality=quality, size=None))

    return replace(recipe, edits=tuple(stated(edit) for edit in recipe.edits))
