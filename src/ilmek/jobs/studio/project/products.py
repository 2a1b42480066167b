"""What can be written of each file of a project, where below out/ it lies, and the command that writes it."""

import shlex
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath

from ilmek.errors import IlmekError
from ilmek.jobs.design import LOOM
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.project.folder import OUT, ProjectFolder, kind_of, read_bytes
from ilmek.jobs.studio.project.product_python import product_python
from ilmek.jobs.studio.project.tasks import PathRequest
from ilmek.machines.catalogue import find_machine


@dataclass(frozen=True, slots=True)
class Product:
    """What can be written of a file: name, file or folder below out/, and the command line and Python that write it."""

    name: str
    target: str
    command: str
    python: str


@dataclass(frozen=True, slots=True)
class ProductList:
    """What can be written of a file."""

    products: tuple[Product, ...]


_MACHINE = {"page": ".html", "parts": "-parts", "mechanism": ".toml", "space": ".glb", "animation": ".gif"}

PRODUCTS: Mapping[str, Mapping[str, str]] = {
    "carpet": {"carpet": "", "chart": "-chart"},
    "machine": {**_MACHINE, "data": ".json"},
    "synthesis": {**_MACHINE, "data": ".json"},
    "linkage": {"page": ".html", "parts": "-parts", "table": ".csv", "animation": ".gif", "data": ".json"},
    "cyclogram": {"page": ".html", "table": ".csv", "data": ".json"},
}
"""Products by kind of file: what is added to the name of the target."""

OPTIONS = {
    "page": "--report",
    "parts": "--workshop",
    "mechanism": "--to",
    "space": "--glb",
    "animation": "--animation",
    "data": "--json",
    "table": "--csv",
}
"""The options of the commands by product."""

_COMMANDS = {"machine": "design", "synthesis": "design", "linkage": "mechanism", "cyclogram": "cyclogram"}


def products(request: PathRequest, context: Context) -> ProductList:
    """What can be written of a file, each with its command line. Raises ParameterError for another file."""
    folder = ProjectFolder(context.folder.resolve())
    folder.text_path(request.path)
    return ProductList(tuple(product(request.path, name) for name in product_names(folder, request.path)))


def product_names(folder: ProjectFolder, path: str) -> tuple[str, ...]:
    """The names of the products of a file; of a machine file those that the machine in it can have."""
    names = PRODUCTS.get(kind_of(path) or "", {})
    return tuple(name for name in names if name not in ("mechanism", "space") or name in _of_machine(folder, path))


def _of_machine(folder: ProjectFolder, path: str) -> tuple[str, ...]:
    """Which of mechanism file and picture in space the machine of a machine file has; none where it has an error."""
    try:
        machine = find_machine(str(tomllib.loads((read_bytes(folder.base / path) or b"").decode()).get("machine")))
    except (IlmekError, ValueError, RecursionError):
        return ()
    return ("mechanism",) * (machine.mechanism is not None) + ("space",) * (machine.name == LOOM)


def product(path: str, name: str) -> Product:
    """A product of a file by its name."""
    kind, stem = kind_of(path) or "", PurePosixPath(path).stem
    target = f"{OUT}/{'' if kind == 'carpet' else f'{kind}-'}{stem}{PRODUCTS[kind][name]}"
    if kind == "carpet":
        parts = ("ilmek", "weave" if name == "carpet" else "chart", path, "--out", target, "--force")
    else:
        parts = ("ilmek", _COMMANDS[kind], path, OPTIONS[name], target, "--force")
    return Product(name, target, shlex.join(parts), product_python(kind, path, name, target))


def sources(paths: Iterable[str]) -> dict[str, str]:
    """The text file of each file or folder in out/ that a command of `Product` writes."""
    return {product(path, name).target: path for path in paths for name in PRODUCTS.get(kind_of(path) or "", ())}
