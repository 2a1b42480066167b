"""Public names of a package that are imported when they are first used.

A package with such names stays cheap to import. Its stub, `__init__.pyi`, has a line for each of them: type checkers
read it, and so does the package, so that a name is written once. `dir` lists them.
"""

import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any


def lazy_names(package: str, file: str) -> tuple[list[str], Callable[[str], Any], Callable[[], list[str]]]:
    """`__all__`, `__getattr__` and `__dir__` of a package.

    package  its name      file  its `__init__.py`; the stub beside it has lines `from package.module import x as x`

    `__getattr__` raises AttributeError, with the nearest public name, for any other name.
    """
    words = (line.split() for line in Path(file).with_suffix(".pyi").read_text(encoding="utf-8").splitlines())
    sources = {word[3]: word[1] for word in words if word and word[0] == "from"}

    def get(name: str) -> Any:
        if name not in sources:
            near = importlib.import_module("difflib").get_close_matches(name, sources, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise AttributeError(f"{package} has no {name!r}{hint}", name=name, obj=sys.modules[package])
        source = sources[name]
        is_module = source == package
        module = importlib.import_module(f"{package}.{name}" if is_module else source)
        value = module if is_module else getattr(module, name)
        setattr(sys.modules[package], name, value)
        return value

    def listed() -> list[str]:
        return sorted({*vars(sys.modules[package]), *sources})

    return list(sources), get, listed
