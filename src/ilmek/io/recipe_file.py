"""Recipes as TOML: the options of the command line as keys, the layout, and edits.

    picture = "quarter.png"                     # or plain = "ivory", or a [repeat]
    mirror = "both"
    size = "120x180cm"
    quality = "25x25/dm"
    edits = ["set 12,40 madder red", "replace ivory by camel in 1,1 50,50"]

    [repeat]
    tile = "gul.png"
    order = "brick"

    [[border]]                                  # from the edge inwards
    yarn = "dark red"
    width = 3

    [[border]]
    tile = "border.png"

    [[motif]]
    picture = "medallion.png"
    transparent = "#ffffff"

    [loom]
    "shedding.law" = "modified-sine"

Pictures and yarn lists are named relative to the recipe's folder and lie in it.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ilmek.carpet.palette_rules import mapped_colours, names_text
from ilmek.carpet.quality import Quality, gereh_note, parse_quality
from ilmek.carpet.recipe.mirror import MIRRORS
from ilmek.carpet.recipe.recipe import (
    MOST_BORDERS,
    MOST_MOTIFS,
    ORDERS,
    POSITIONS,
    Border,
    Breadth,
    Motif,
    Recipe,
    Repeat,
)
from ilmek.carpet.sizes import CarpetSize, parse_open_size
from ilmek.carpet.yarn import Yarn
from ilmek.elements.knot_kinds import parse_knot
from ilmek.errors import CarpetError, IlmekError, ParameterError, restated
from ilmek.io.data_text import read_data, values
from ilmek.io.edits_entry import read_edits
from ilmek.io.file_entry import FileEntry
from ilmek.io.line_numbers import KeyLines
from ilmek.io.schema import SourceText, shown
from ilmek.io.yarn_file import SHIPPED, default_yarns, read_yarns, yarns_from_records
from ilmek.params import Parameter, Setting
from ilmek.sentences import Sentence, location
from ilmek.units import parse_quantity

MOST_KNOTS_WIDE = 10_000
"""Largest width of a border, and largest side of a tile or motif [knots]."""

LAYOUT_KEYS = ("picture", "plain", "mirror", "repeat", "border", "motif", "edits")
CARPET_KEYS = ("size", "quality", "knot", "yarns", "yarn", "pdf")
LOOM_KEYS = ("deadline", "heads", "aim", "warp_pitch", "loom_file", "loom")


@dataclass(frozen=True, slots=True)
class LoomKeys:
    """What is set of the loom that weaves the carpet, as options of `ilmek weave`; where: file and line of `loom`."""

    deadline: str | None = None
    heads: int | None = None
    aim: str | None = None
    warp_pitch: Setting = None
    loom_file: Path | None = None
    loom: Mapping[str, Setting] = field(default_factory=dict)
    where: str = ""

    def __hash__(self) -> int:
        return hash((self.deadline, self.heads, self.aim, tuple(self.loom)))


@dataclass(frozen=True, slots=True)
class RecipeFile:
    """The contents of a recipe's file; what it leaves open is None.

    settings   of the parameters of an order, by name      yarn_file  from which the yarns are read, if from a file
    gereh      note on the quality, where its text leaves the gereh open
    """

    recipe: Recipe
    size: CarpetSize | None
    quality: Quality | None
    knot: str | None
    yarns: tuple[Yarn, ...] | None
    yarn_file: Path | None
    pdf: bool | None
    settings: Mapping[str, Setting]
    loom: LoomKeys
    gereh: str = ""

    def __hash__(self) -> int:
        return hash(self.recipe)


def read_recipe(path: Path, parameters: Mapping[str, Parameter]) -> RecipeFile:
    """The recipe of a .toml file; pictures are not opened, but lie in its folder.

    parameters  of an order, each under every name that a key may have
    Raises CarpetError with the file, the line and the key for any error in the file.
    """
    text = read_data(path, "recipe", CarpetError)
    return recipe_of_data(text.data, path, parameters, text.lines)


def recipe_of_data(
    data: Mapping[str, object], path: Path, parameters: Mapping[str, Parameter], lines: KeyLines | None = None
) -> RecipeFile:
    """As `read_recipe`, of the data of a file; lines: of its keys, default: all of them line 0."""
    known = {key: 0 for key, _ in values(data, ())} if lines is None else lines
    with restated(CarpetError):
        return _RecipeReader(FileEntry(data, (), SourceText(str(path), known)), path).read(parameters)


@dataclass(frozen=True, slots=True)
class _RecipeReader:
    root: FileEntry
    file: Path

    def read(self, parameters: Mapping[str, Parameter]) -> RecipeFile:
        root = self.root
        root.keys(*LAYOUT_KEYS, *CARPET_KEYS, *parameters, *LOOM_KEYS)
        yarns, yarn_file = self._yarns()
        size, sides = self._parsed("size", parse_open_size) or (None, dict[str, Setting]())
        settings = self._settings(parameters)
        if root.has("size") and (beside := [key for key in ("width", "length") if key in settings]):
            root.refuse(CarpetError(f"{' and '.join(beside)} beside size", do="leave one of them out"), beside[0])
        return RecipeFile(
            self._recipe(size),
            size,
            self._parsed("quality", parse_quality),
            self._parsed("knot", parse_knot),
            yarns,
            yarn_file,
            root.flag("pdf") if root.has("pdf") else None,
            {**settings, **sides},
            self._loom(),
            self._parsed("quality", gereh_note) or "",
        )

    def _where(self, entry: FileEntry, key: str | int | None = None) -> str:
        """The file, line and key of an entry, for messages."""
        path = entry.path if key is None else (*entry.path, key)
        line = next(
            entry.source.lines[path[:size]] for size in range(len(path), -1, -1) if path[:size] in entry.source.lines
        )
        return location(str(self.file), line, ".".join(str(part) for part in path))

    @contextmanager
    def _at(self, entry: FileEntry, key: str) -> Iterator[None]:
        """Add the line of a key to errors raised inside."""
        try:
            yield
        except IlmekError as error:
            entry.refuse(error, key)

    def _parsed(self, key: str, parse: Callable[[str], Any]) -> Any:
        if not self.root.has(key):
            return None
        text = self.root.text(key)
        with self._at(self.root, key):
            return parse(text)

    def _yarns(self) -> tuple[tuple[Yarn, ...] | None, Path | None]:
        if self.root.has("yarn"):
            if self.root.has("yarns"):
                self.root.refuse(CarpetError("both yarn and yarns are given", do="leave one of them out"), "yarns")
            records = [row.data for row in self.root.rows("yarn")]
            with self._at(self.root, "yarn"):
                return yarns_from_records(records), None
        if (name := self.root.data.get("yarns")) in SHIPPED:
            return default_yarns(str(name)), None
        file = self._file(self.root, "yarns")
        if file is None:
            return None, None
        with self._at(self.root, "yarns"):
            return read_yarns(file), file

    def _file(self, entry: FileEntry, key: str) -> Path | None:
        """A file in the recipe's folder; None if the key is missing."""
        if not entry.has(key):
            return None
        text = entry.text(key)
        with self._at(entry, key):
            return file_inside(self.file.parent, text)

    def _settings(self, parameters: Mapping[str, Parameter]) -> dict[str, Setting]:
        settings: dict[str, Setting] = {}
        for key, parameter in parameters.items():
            if not self.root.has(key):
                continue
            value = self.root.data[key]
            with self._at(self.root, key):
                if parameter.name in settings:
                    raise ParameterError(f"{parameter.name} is given twice", do="leave one of them out")
                if isinstance(value, dict) and parameter.name == "mapped":
                    value = self._map(self.root.table(key))
                if isinstance(value, list) and all(isinstance(one, str | int | float) for one in value):
                    names = parameter.name in ("keep", "never")
                    value = names_text(map(str, value)) if names else ", ".join(str(one) for one in value)
                if not isinstance(value, str | int | float):
                    raise ParameterError(f"{shown(value)} is not a value", do='write it like "8mm", 8, true or "auto"')
                parameter.check(parameter.read(value))
                settings[parameter.name] = value
        return settings

    def _map(self, table: FileEntry) -> str:
        """The pairs of colours and yarns of a table as one text."""
        pairs = []
        for colour, yarn in table.data.items():
            with self._at(table, colour):
                if not isinstance(yarn, str):
                    raise ParameterError(f"{shown(yarn)} is no name of a yarn", do='write it like "dark green"')
                pairs.append(f"{colour}={yarn}")
                mapped_colours(pairs[-1])
        text = "; ".join(pairs)
        mapped_colours(text)
        return text

    def _loom(self) -> LoomKeys:
        root = self.root
        heads = root.whole("heads") if root.has("heads") else None
        for key, unit in (("deadline", "h"), ("warp_pitch", "mm")):
            if root.has(key):
                with self._at(root, key):
                    parse_quantity(root.text(key), unit)
        table = root.table("loom")
        return LoomKeys(
            root.text("deadline") if root.has("deadline") else None,
            heads,
            root.text("aim") if root.has("aim") else None,
            root.text("warp_pitch") if root.has("warp_pitch") else None,
            self._file(root, "loom_file"),
            dict(table.settings()),
            self._where(root, "loom"),
        )

    def _recipe(self, size: CarpetSize | None) -> Recipe:
        root = self.root
        picture = self._file(root, "picture")
        plain, has_tile = root.text("plain", ""), root.has("repeat")
        if picture is None and not plain and not has_tile:
            root.refuse(
                CarpetError(
                    Sentence("recipe.no-field"), allowed="picture, plain or [repeat]", do='like plain = "ivory"'
                )
            )
        if picture is not None and (plain or has_tile):
            root.refuse(
                CarpetError("the field has a picture already", do="leave one of them out"),
                "plain" if plain else "repeat",
            )
        return Recipe(
            self.file,
            picture,
            plain,
            self._repeat() if has_tile else None,
            _choice(root, "mirror", MIRRORS),
            tuple(self._border(row) for row in self._rows("border", MOST_BORDERS)),
            tuple(self._motif(row) for row in self._rows("motif", MOST_MOTIFS)),
            read_edits(root, self._where, size, self._parsed("quality", parse_quality)),
            self._where(root, "picture" if picture is not None else "plain"),
        )

    def _rows(self, key: str, most: int) -> list[FileEntry]:
        rows = self.root.rows(key)
        if len(rows) > most:
            self.root.refuse(CarpetError(f"has {len(rows):,} entries", allowed=f"at most {most}"), key)
        return rows

    def _repeat(self) -> Repeat:
        entry = self.root.table("repeat")
        entry.keys("tile", "width", "length", "order", "cut", needs=("tile",))
        tile = self._file(entry, "tile")
        assert tile is not None
        sides = _knots(entry, "width"), _knots(entry, "length")
        order = _choice(entry, "order", ORDERS) or ORDERS[0]
        return Repeat(tile, *sides, order, entry.flag("cut"), self._where(entry))

    def _border(self, entry: FileEntry) -> Border:
        entry.keys("width", "yarn", "teeth", "tile", "length", "corner", "alternate", "adjust", "pile")
        kinds = [key for key in ("yarn", "teeth", "tile") if entry.has(key)]
        if len(kinds) != 1:
            given = f"has {' and '.join(kinds)}" if kinds else "has nothing to be made of"
            entry.refuse(CarpetError(given, allowed="one of yarn, teeth and tile"))
        if kinds[0] != "tile" and not entry.has("width"):
            entry.refuse(CarpetError("the border has no width", do='give it in knots, or like "3cm"'))
        for key in ("length", "corner", "alternate"):
            if entry.has(key) and kinds[0] != "tile":
                entry.refuse(CarpetError(f"{key} is that of a tile, which is not given", do=f"leave {key} out"), key)
        return Border(
            _breadth(entry),
            entry.text("yarn", ""),
            _teeth(entry),
            self._file(entry, "tile"),
            _knots(entry, "length"),
            self._file(entry, "corner"),
            entry.flag("alternate"),
            entry.flag("adjust"),
            entry.text("pile", ""),
            self._where(entry),
        )

    def _motif(self, entry: FileEntry) -> Motif:
        entry.keys("picture", "position", "mirror", "width", "length", "transparent", "pile", needs=("picture",))
        picture = self._file(entry, "picture")
        assert picture is not None
        sides = _knots(entry, "width"), _knots(entry, "length")
        mirror = _choice(entry, "mirror", MIRRORS)
        where = self._where(entry)
        texts = entry.text("transparent", ""), entry.text("pile", "")
        return Motif(picture, _position(entry), mirror, *sides, *texts, where)


def file_inside(folder: Path, text: str) -> Path:
    """The file of a relative path in a folder. Raises CarpetError for one outside, also through a link.

    Whether the file is there is seen when it is opened, but it must exist for its links to be followed.
    """
    path = Path(text)
    do = Sentence("recipe.copy")
    if not text.strip() or "\0" in text:
        raise CarpetError(f"{text!r} names no file", do='give one, like "tile.png"')
    if path.is_absolute() or ".." in path.parts or "\\" in text or path.drive:
        raise CarpetError(Sentence("recipe.outside-folder", file=shown(text)), allowed=Sentence("recipe.below"), do=do)
    try:
        inside = (folder / path).resolve(strict=True)
        base = folder.resolve(strict=True)
    except OSError:
        raise CarpetError(Sentence("recipe.not-there", file=shown(text)), do=Sentence("recipe.put")) from None
    if not inside.is_relative_to(base):
        raise CarpetError(f"{shown(text)} is a link to a file outside the recipe's folder", do=do)
    if not inside.is_file():
        raise CarpetError(f"{shown(text)} is no file", do="give the path of a picture")
    return folder / path


def _choice(entry: FileEntry, key: str, known: tuple[str, ...]) -> str:
    text = entry.text(key, "")
    if entry.has(key) and text not in known:
        entry.refuse(CarpetError(f"{shown(text)} is unknown", allowed=f"one of {', '.join(known)}"), key)
    return text


def _knots(entry: FileEntry, key: str) -> int | None:
    """A number of knots; None if the key is missing."""
    value = entry.data.get(key)
    if value is not None and (
        isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= MOST_KNOTS_WIDE
    ):
        entry.refuse(CarpetError(f"{shown(value)} is no number of knots", allowed=f"1 to {MOST_KNOTS_WIDE:,}"), key)
    return value


def _breadth(entry: FileEntry) -> Breadth | None:
    value = entry.data.get("width")
    if not isinstance(value, str):
        return None if (knots := _knots(entry, "width")) is None else Breadth(knots=knots)
    length = entry.quantity("width", "mm")
    if not 0 < length <= 10:
        entry.refuse(CarpetError(f"{shown(value)} cannot be a width", allowed="above 0 mm, at most 10 m"), "width")
    return Breadth(length=length)


def _teeth(entry: FileEntry) -> tuple[str, ...]:
    value = entry.data.get("teeth", [])
    if entry.has("teeth") and not (
        isinstance(value, list) and len(value) == 2 and all(isinstance(one, str) for one in value)
    ):
        entry.refuse(
            CarpetError(f"{shown(value)} does not name two yarns", do='like ["ivory", "indigo navy"]'), "teeth"
        )
    return tuple(value)


def _position(entry: FileEntry) -> str | tuple[int, int]:
    value = entry.data.get("position", POSITIONS[0])
    if isinstance(value, list) and len(value) == 2 and all(type(one) is int and 0 < one < 10**6 for one in value):
        return value[0], value[1]
    if value not in POSITIONS:
        allowed = f"one of {', '.join(POSITIONS)}, or [row, column]"
        entry.refuse(CarpetError(f"{shown(value)} is no position", allowed=allowed), "position")
    return str(value)
