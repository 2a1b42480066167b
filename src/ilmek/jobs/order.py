"""The order of a carpet, read from texts and checked before any work is done.

Its parameters stand in groups, `GROUPS`. Each parameter of a group is an option of the command line, `--least-patch`,
and a key of a recipe, `least_patch`; no two groups have a parameter of the same name.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType

from ilmek.carpet.design import knot_grid
from ilmek.carpet.fitting import FitParams
from ilmek.carpet.palette_rules import PaletteParams, check_palette
from ilmek.carpet.quality import Quality, gereh_note, parse_quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.recipe.edits import located
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.shape import ShapeParams
from ilmek.carpet.sizes import AUTO, CarpetSize, carpet_size, parse_open_size, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, ParameterError, did_you_mean
from ilmek.io.chart.sheets import cut, require_wall
from ilmek.io.recipe_file import LoomKeys, RecipeFile, read_recipe, recipe_of_data
from ilmek.io.schema import Table
from ilmek.io.yarn_file import default_yarns, read_yarns
from ilmek.jobs.carpet_files import FileParams
from ilmek.params import Parameter, Params, Setting, declared
from ilmek.records import JsonObject
from ilmek.viz.carpet_picture import check_carpet_width

SIZE, QUALITY, KNOT = "seccade", "25x25/dm", "symmetric"
"""What holds where neither the user nor the picture gives it."""

SIDES = ("width", "length")
"""Parameters of the fit that give the size, or the side that the picture leaves open."""

MOST_SHEETS = 400
"""Largest number of sheets for which chart.pdf is written by default; the same of rows.pdf."""

MOST_PRINTED = 2_000
"""Largest number of sheets of a chart.pdf: 50 s, 13 MB and 300 MB of memory."""

RECIPE = ".toml"
"""Ending of a recipe's file."""

GROUPS: Mapping[str, type[Params]] = MappingProxyType(
    {
        "fit": FitParams,
        "shape": ShapeParams,
        "reading": ReadParams,
        "palette": PaletteParams,
        "plan": YarnPlanParams,
        "files": FileParams,
    }
)
"""The groups of parameters of an order, by the name of the field."""


@dataclass(frozen=True, slots=True)
class CarpetOrder:
    """The order of a carpet.

    picture  file of the picture
    size, quality, knot, yarns  default: those of the picture where it is a chart, else that of its shape
             (`size_of_picture`), QUALITY, KNOT and the picture's own shades: wools that come with ilmek where they are
             near, the others dyed to order
    fit      how the picture is fitted to the carpet, and the one side that is given of an open size
    shape    outline, flat weave and pile
    reading  how it is read
    palette  which yarns of the list are taken              plan     the yarn      files  the files of the folder
    pdf      print the chart; default: if it has few enough sheets (`MOST_SHEETS`)
    recipe   of the carpet, if `picture` is its file; default: the carpet is the picture
    yarn_file  of the yarns, if they are from a file      loom  what the recipe sets of the loom
    notes    on what the texts of the order leave open
    """

    picture: Path
    size: CarpetSize | None = None
    quality: Quality | None = None
    knot: str | None = None
    yarns: tuple[Yarn, ...] | None = None
    fit: FitParams = field(default_factory=FitParams)
    shape: ShapeParams = field(default_factory=ShapeParams)
    reading: ReadParams = field(default_factory=ReadParams)
    palette: PaletteParams = field(default_factory=PaletteParams)
    plan: YarnPlanParams = field(default_factory=YarnPlanParams)
    files: FileParams = field(default_factory=FileParams)
    pdf: bool | None = None
    recipe: Recipe | None = None
    yarn_file: Path | None = None
    loom: LoomKeys = field(default_factory=LoomKeys)
    notes: tuple[str, ...] = ()

    @property
    def inputs(self) -> dict[str, Path]:
        """The files that the carpet is read from, by their name in messages."""
        pictures = () if self.recipe is None else self.recipe.pictures
        yarns = {} if self.yarn_file is None else {"the yarn list": self.yarn_file}
        return {"PICTURE": self.picture, **{f"{path.name} of the recipe": path for path in pictures}, **yarns}

    @property
    def dyed(self) -> bool:
        """Whether the yarns are the picture's own shades: no list is given."""
        return self.yarns is None

    def resolved(self) -> "ResolvedOrder":
        """The order with the defaults for all that is left open, SIZE for its size; each yarn has its count.

        Where no list is given its yarns are the wools in stock; those that are dyed follow from the picture.
        """
        quality, knot = self.quality or parse_quality(QUALITY), self.knot or KNOT
        wools = default_yarns()
        listed = self.plan.priced(wools) if self.yarns in (None, wools) else self.yarns
        yarns = self.plan.counted(listed, quality, knot)
        return ResolvedOrder(self, self.size or parse_size(SIZE), quality, knot, yarns)


@dataclass(frozen=True, slots=True)
class ResolvedOrder:
    """An order with nothing left open: what the carpet of a picture is made to."""

    order: CarpetOrder
    size: CarpetSize
    quality: Quality
    knot: str
    yarns: tuple[Yarn, ...]

    def with_dyed(self, yarns: Sequence[Yarn]) -> "ResolvedOrder":
        """The order with the yarns of a chart that its list does not have, those dyed for it, after the others."""
        names = {yarn.name for yarn in self.yarns}
        return replace(self, yarns=(*self.yarns, *(yarn for yarn in yarns if yarn.name not in names)))

    def as_dict(self) -> JsonObject:
        """The order as plain data, SI."""
        return {
            "picture": str(self.order.picture),
            "size": {"width": self.size.width, "length": self.size.length, "name": self.size.name},
            "quality": {"across": self.quality.across, "along": self.quality.along},
            "knot": self.knot,
            "yarns": [yarn.name for yarn in self.yarns],
            **{name: value for group in GROUPS for name, value in getattr(self.order, group).as_dict().items()},
            "pdf": self.order.pdf,
            "recipe": None if self.order.recipe is None else self.order.recipe.as_dict(),
        }


def read_order(
    picture: Path,
    *,
    size: str | None = None,
    quality: str | None = None,
    knot: str | None = None,
    yarn_file: Path | None = None,
    pdf: bool | None = None,
    **settings: Setting,
) -> CarpetOrder:
    """The order from texts; the picture is not opened, but a recipe is read.

    picture   a picture, or a recipe (.toml); what is given here overrides the recipe's keys
    settings  of the parameters of `GROUPS`, by name; None: the default
    Raises CarpetError, YarnError or ParameterError.
    """
    found = _read_recipe(picture) if picture.suffix.lower() == RECIPE else None
    base = CarpetOrder(picture) if found is None else _order_of(picture, found)
    keys = by_name(_given(settings))
    sized, sides = (None, {}) if size is None else read_size(size, keys)
    if size is not None or keys.keys() & SIDES:
        base = replace(base, size=None)
        sides = {**dict.fromkeys(SIDES), **keys, **sides}
    given: JsonObject = {
        "size": sized,
        "quality": None if quality is None else parse_quality(quality),
        "knot": None if knot is None else parse_knot(knot),
        "yarns": None if yarn_file is None else read_yarns(yarn_file),
        "yarn_file": None if yarn_file is None or not yarn_file.exists() else yarn_file,
        "pdf": pdf,
        "notes": None if quality is None else tuple(filter(None, (gereh_note(quality),))),
    }
    groups = read_groups({**({} if found is None else found.settings), **keys, **sides})
    return _checked(replace(base, **_given(given), **groups))


def read_size(size: str | CarpetSize, settings: Mapping[str, Setting]) -> tuple[CarpetSize | None, dict[str, Setting]]:
    """A size or that of a text, or None and the sides of the parameters `SIDES` that give it with the picture.

    settings  by name, among which a side may be given instead of a size
    Raises CarpetError for what is no size; ParameterError where a side is given beside one.
    """
    beside = [name for name in SIDES if settings.get(name) is not None]
    whole = not isinstance(size, str) or size.strip().lower() != AUTO
    if beside and whole:
        raise ParameterError(
            f"{' and '.join(beside)} given beside the size {str(size)!r}",
            allowed="a size, or one side or both",
            do="leave one of them out",
        )
    if not isinstance(size, str):
        return carpet_size(size), {}
    stated, sides = parse_open_size(size)
    return stated, {**sides}


def order_of_data(path: Path, data: Table) -> CarpetOrder:
    """The order of a recipe from its data, as `read_order` of a file at this path that holds them."""
    file = recipe_of_data(data, path, recipe_parameters())
    with located(str(path)):
        groups = read_groups(file.settings)
    return _checked(replace(_order_of(path, file), **groups))


def _checked(order: CarpetOrder) -> CarpetOrder:
    """The order with a size where both sides are given, after the checks that need no picture."""
    if order.fit.size is not None:
        order = replace(order, size=order.fit.size, fit=order.fit.without_sides)
    if order.yarns is not None:
        check_palette(order.palette, order.yarns)
    if order.size is not None:
        check_carpet_width(order.size, order.files.carpet_width)
    if order.size is not None and order.quality is not None:
        check_sheets(order.size, order.quality, order)
    return order


def _read_recipe(path: Path) -> RecipeFile:
    """The recipe of a file, all of its keys checked."""
    file = read_recipe(path, recipe_parameters())
    with located(str(path)):
        read_groups(file.settings)
    return file


def _order_of(path: Path, found: RecipeFile) -> CarpetOrder:
    """The order of a recipe, without its groups of parameters."""
    return CarpetOrder(
        path,
        found.size,
        found.quality,
        found.knot,
        found.yarns,
        pdf=found.pdf,
        recipe=found.recipe,
        yarn_file=found.yarn_file,
        loom=found.loom,
        notes=tuple(filter(None, (found.gereh,))),
    )


def recipe_parameters() -> dict[str, Parameter]:
    """The parameters of all groups by the keys that a recipe may have for them: the option's name, and their own."""
    parameters = [parameter for cls in GROUPS.values() for parameter in declared(cls)]
    return {key: one for one in parameters for key in (recipe_key(one), one.name)}


def recipe_key(parameter: Parameter) -> str:
    """The key of a parameter in a recipe, as the option's name."""
    return (parameter.alias or parameter.name).replace("-", "_")


def _given(settings: Mapping[str, object]) -> JsonObject:
    return {name: setting for name, setting in settings.items() if setting is not None}


def read_groups(settings: Mapping[str, Setting]) -> JsonObject:
    """The groups of parameters from settings by name or by option; None: the default. Raises ParameterError.

    >>> read_groups({"read": "photo"})["reading"].reading
    'photo'
    """
    sorted_settings: dict[str, dict[str, Setting]] = {group: {} for group in GROUPS}
    groups = {parameter.name: group for group, cls in GROUPS.items() for parameter in declared(cls)}
    for name, setting in by_name(settings).items():
        if setting is not None:
            sorted_settings[groups[name]][name] = setting
    return {group: cls.read(sorted_settings[group]) for group, cls in GROUPS.items()}


def by_name(settings: Mapping[str, Setting]) -> dict[str, Setting]:
    """Settings by the names of their parameters, of settings by name or by option.

    Raises ParameterError for an unknown name, and for a parameter set by its name and by its option.
    """
    known = recipe_parameters()
    named: dict[str, Setting] = {}
    for name, setting in settings.items():
        if name not in known:
            raise ParameterError(f"unknown parameter {name!r} of a carpet", do=did_you_mean(name, known))
        own = known[name].name
        if own in named:
            raise ParameterError(f"{own} is set twice, once as {name}", do="set it once")
        named[own] = setting
    return named


def check_sheets(size: CarpetSize, quality: Quality, order: CarpetOrder) -> None:
    """Raise CarpetError for a carpet of too few or too many knots, and for printed charts that are too large."""
    rows, columns = knot_grid(size, quality)
    sheets = cut(rows, columns, quality.across / quality.along).count
    if order.pdf and sheets > MOST_PRINTED:
        raise CarpetError(
            f"--pdf: the chart of {size} at {quality} has {sheets:,} sheets",
            allowed=f"at most {MOST_PRINTED:,}",
            do="leave --pdf out, or take a coarser quality",
        )
    if order.files.wall:
        require_wall(rows * columns)
    for written in order.files.formats:
        written.require(rows * columns)
