"""Public names of a package that are imported when they are first used.

A package with such names stays cheap to import. `dir` lists them; imports under `TYPE_CHECKING` show them to editors
and type checkers.
"""

import importlib
import sys
from collections.abc import Callable, Mapping
from typing import Any


def lazy_names(package: str, names: Mapping[str, str]) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """`__getattr__` and `__dir__` of a package.

    package  its name
    names    public name -> module that defines it; for a module the module itself

    `__getattr__` raises AttributeError, with the nearest public name, for any other name.
    """

    def get(name: str) -> Any:
        if name not in names:
            near = importlib.import_module("difflib").get_close_matches(name, names, n=1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise AttributeError(f"{package} has no {name!r}{hint}", name=name, obj=sys.modules[package])
        module = importlib.import_module(names[name])
        value = module if names[name] == f"{package}.{name}" else getattr(module, name)
        setattr(sys.modules[package], name, value)
        return value

    def listed() -> list[str]:
        return sorted({*vars(sys.modules[package]), *names})

    return get, listed
