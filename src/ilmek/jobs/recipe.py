"""The chart of a recipe, and the recipe of a chart."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

from ilmek.arrays import Pixels
from ilmek.carpet.chart import Chart, chart_of_design, used_first
from ilmek.carpet.palette_rules import PaletteParams, names_text, yarn_names
from ilmek.carpet.reading import READINGS
from ilmek.carpet.recipe.composition import Composition, compose
from ilmek.carpet.recipe.edits import located, named_yarns
from ilmek.carpet.recipe.finish import finish
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.usual_pile import with_counts
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError, IlmekError, PictureError
from ilmek.io.chart.formats import format_of, read_chart
from ilmek.io.picture import SMALLEST, read_picture
from ilmek.io.recipe_file import LoomKeys, RecipeFile
from ilmek.io.recipe_text import recipe_text
from ilmek.io.toml_text import written_quantity
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.charting import OrderedChart, chart_of_order, drawn_chart, file_key, shown_source
from ilmek.jobs.order import GROUPS, CarpetOrder, ResolvedOrder, check_sheets, recipe_key
from ilmek.jobs.recipe_size import of_its_shape, size_of_recipe
from ilmek.jobs.stages import ANEW, Stages
from ilmek.params import declared
from ilmek.progress import SILENT, Progress


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
    if not recipe.is_composed:
        assert recipe.picture is not None
        picture = replace(order, picture=recipe.picture, recipe=None)
        try:
            done = chart_of_order(picture, progress.part(0.0, 0.8), with_source=with_source, stages=stages)
        except IlmekError as error:
            with located(recipe.where if isinstance(error, PictureError) else str(recipe.file)):
                raise
        reading = replace(done.chart.reading, reason=f"{done.chart.reading.reason} (picture of {recipe.file.name})")
        chart = replace(done.chart, reading=reading)
        chart = finish(chart, recipe, _counted(done.order), None, progress.part(0.8, 1.0, "edits"))
        chart = used_first(chart) if recipe.edits else chart
        return replace(done, order=replace(done.order, order=given), chart=chart)
    made = _composed_chart(recipe, order, progress, stages, with_source=with_source)
    return replace(made, order=replace(made.order, order=given))


def _composed_chart(
    recipe: Recipe, order: CarpetOrder, progress: Progress, stages: Stages, *, with_source: bool
) -> OrderedChart:
    """The chart of a recipe that is more than one whole picture."""
    plain = replace(recipe, edits=())
    files = tuple(file_key(path) for path in recipe.pictures)
    read = cache(lambda: _pictures(recipe, order.fit.ground, progress.part(0.0, 0.3, "picture"), stages))
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
            progress=progress.part(0.3, 0.5, "chart"),
        )
        return composition, (*notes, *composition.notes)

    def charted() -> Chart:
        return chart_of_design(
            stages.shown(composition.design),
            made.size,
            made.quality,
            made.yarns,
            knot=made.knot,
            fit=composition.fit,
            reading=order.reading,
            palette=order.palette,
            dyed=order.dyed,
            progress=progress.part(0.5, 0.8, "chart"),
        )

    composition, notes = stages.keep("composition", key, composed)
    chart = stages.keep("chart", (key, made.knot, order.palette, order.dyed), charted)
    made = made.with_dyed(chart.yarns)
    source = shown_source(composition.design.colours) if with_source else None
    chart = finish(chart, recipe, _counted(made), composition, progress.part(0.8, 1.0, "edits"))
    return OrderedChart(made, used_first(chart), notes, source)


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
    recipe: Recipe, ground: str | None, progress: Progress, stages: Stages
) -> tuple[Mapping[Path, Pixels], tuple[str, ...]]:
    """The pixels of all pictures, and notes on them."""
    found, notes = {}, []
    files = recipe.pictures
    for number, (path, where) in enumerate(files.items()):
        part = progress.part(number / len(files), (number + 1) / len(files))
        with located(where):
            smallest = SMALLEST if path == recipe.picture else 1
            key = (file_key(path), smallest, ground)
            found[path], more = stages.keep("tile", key, partial(picture_pixels, path, smallest, part, ground))
        notes += [f"{path.name}: {note}" for note in more]
    return found, tuple(notes)


def picture_pixels(
    path: Path, smallest: int, progress: Progress, ground: str | None = None
) -> tuple[Pixels, tuple[str, ...]]:
    """The pixels of a picture, or of a chart that is none, which has its yarns' colours; and notes."""
    chosen = format_of(path)
    if chosen is None or chosen.picture:
        picture = read_picture(path, progress, smallest=smallest, ground=ground)
        return picture.rgb, picture.notes
    chart, notes = read_chart(path, progress=progress)
    return drawn_chart(chart), notes


def saved_recipe(made: ResolvedOrder, chart: Chart, folder: Path, loom: LoomKeys | None = None) -> str:
    """The text of the recipe of a chart, for a file in a folder: all that was set, and size, quality, knot and reading
    as they were decided.

    Raises CarpetError for a picture that does not lie in the folder.
    """
    order = made.order
    recipe = order.recipe or Recipe(folder / "carpet.toml", order.picture)
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
    found = RecipeFile(
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
    return recipe_text(found, folder)
