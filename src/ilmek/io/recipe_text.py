"""Recipes as text: what `io.recipe_file` reads."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.quality import shortest_quality
from ilmek.carpet.recipe.recipe import plain_data
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError
from ilmek.io.recipe_file import RecipeFile
from ilmek.io.schema import Table
from ilmek.io.toml_text import toml_list, toml_section, toml_text
from ilmek.io.yarn_file import WOOL, default_yarns
from ilmek.report import Json
from ilmek.units import cm

SECTIONS = ("repeat", "border", "motif")


def recipe_text(made: RecipeFile, folder: Path) -> str:
    """The text of a recipe that lies in a folder; read from there it is the same recipe.

    Raises CarpetError for a picture outside the folder, which it could not name.
    """
    data = plain_data(made.recipe, lambda path: _inside(path, folder))
    edits = data.pop("edits", [])
    stated = any(isinstance(entry, Mapping) for entry in edits)
    sections = {key: data.pop(key) for key in SECTIONS if key in data}
    loom = made.loom
    data |= {
        "size": None if made.size is None else _size(made.size),
        "quality": None if made.quality is None else shortest_quality(made.quality),
        "knot": made.knot,
        "yarns": _yarn_file(made, folder),
        "pdf": made.pdf,
        **made.settings,
        "deadline": loom.deadline,
        "heads": loom.heads,
        "aim": loom.aim,
        "warp_pitch": loom.warp_pitch,
        "loom_file": None if loom.loom_file is None else _inside(loom.loom_file, folder),
    }
    parts = [toml_text({key: value for key, value in data.items() if value is not None}).rstrip()]
    if edits and not stated:
        parts[0] += "\n" + toml_list("edits", edits)
    parts += [_edit_table(table) for table in edits if stated]
    for key, section in sections.items():
        many = isinstance(section, list)
        parts += [toml_section((key,), entry, many=many) for entry in (section if many else [section])]
    if loom.loom:
        parts.append(toml_section(("loom",), loom.loom))
    if made.yarns is not None and "yarns" not in {key for key, value in data.items() if value is not None}:
        yarns = (_yarn(yarn, place) for place, yarn in enumerate(made.yarns, start=1))
        parts += [toml_section(("yarn",), entry, many=True) for entry in yarns]
    return "\n\n".join(parts) + "\n"


def _edit_table(table: Table) -> str:
    """A table of edits, one line for each."""
    keys = {key: value for key, value in table.items() if key != "lines"}
    return "\n".join([toml_section(("edits",), keys, many=True), toml_list("lines", table["lines"])])


def _inside(path: Path, folder: Path) -> str:
    """The path of a file as a recipe in a folder names it. Raises CarpetError for a file outside the folder."""
    file, base = path.resolve(), folder.resolve()
    if not file.is_relative_to(base):
        given = f"{path} does not lie in the folder of the recipe, {folder}"
        raise CarpetError(given, allowed="a recipe's files lie in its folder", do=f"save the recipe in {file.parent}")
    return file.relative_to(base).as_posix()


def _yarn_file(made: RecipeFile, folder: Path) -> str | None:
    """The file of the yarns, if it lies in the folder, or WOOL; else the recipe has the yarns themselves."""
    if made.yarns == default_yarns():
        return WOOL
    file = made.yarn_file
    return None if file is None or not file.resolve().is_relative_to(folder.resolve()) else _inside(file, folder)


def _size(size: CarpetSize) -> str:
    """The size as text that is read as the same size."""
    sides = size.width / cm, size.length / cm
    texts = [size.name] if size.name else []
    texts += [f"{sides[0]:.{digits}g}x{sides[1]:.{digits}g}cm" for digits in (4, 8, 12)]
    same = (text for text in texts if _same(parse_size(text), size))
    return next(same, f"{size.width!r}x{size.length!r}m")


def _same(one: CarpetSize, other: CarpetSize) -> bool:
    return (one.width, one.length) == (other.width, other.length)


def _yarn(yarn: Yarn, place: int) -> Table:
    """A yarn as an entry of a yarn list, in which it has a place from 1."""
    lab = tuple(srgb_to_lab(np.array(yarn.srgb, dtype=np.uint8)).tolist())
    colour: dict[str, Json] = {"srgb": yarn.hex} if lab == yarn.lab else {"lab": list(yarn.lab)}
    count = {} if yarn.metric_count is None else {"nm": yarn.metric_count, "ply": yarn.ply}
    price = {} if yarn.price is None else {"price": yarn.price}
    number = {} if yarn.number in (None, place) else {"number": yarn.number}
    material = {} if yarn.material is None else {"material": yarn.material}
    return {"name": yarn.name, **colour, **count, **price, **number, **material}
