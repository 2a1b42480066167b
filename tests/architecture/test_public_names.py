"""The public names of a package: names that exist, and a package that stays cheap to import."""

import importlib
import sys
from pathlib import Path

import pytest
from processes import printed, python

import ilmek

PACKAGE = Path(ilmek.__file__).parent
INITS = [PACKAGE / "__init__.py", *sorted(PACKAGE.glob("*/__init__.py"))]
LAZY = [
    ".".join(("ilmek", *path.parent.relative_to(PACKAGE).parts))
    for path in INITS
    if "lazy_names" in path.read_text(encoding="utf-8")
]
"""Packages whose public names are imported when they are first used."""


@pytest.mark.parametrize("package", LAZY)
def test_public_names_exist_and_are_documented(package: str) -> None:
    module = importlib.import_module(package)
    assert len(module.__all__) <= (90 if package == "ilmek" else 31)
    for name in module.__all__:
        assert getattr(module, name).__doc__, name
    assert set(module.__all__) <= set(dir(module))


@pytest.mark.parametrize("package", LAZY)
def test_no_public_name_is_that_of_a_module(package: str) -> None:
    module = importlib.import_module(package)
    folder = Path(module.__file__ or "").parent
    modules = {path.stem for path in folder.iterdir() if path.suffix == ".py" or path.is_dir()}
    namespaces = {name for name in module.__all__ if getattr(module, name) is sys.modules.get(f"{package}.{name}")}
    assert (set(module.__all__) & modules) == namespaces


def test_packages_are_cheap_to_import() -> None:
    script = (
        f"import {', '.join(LAZY)}; import sys; print([m for m in ('numpy', 'scipy', 'numba') if m in sys.modules])"
    )
    assert printed(python("-c", script)) == "[]\n"


def test_unknown_name_offers_the_nearest() -> None:
    with pytest.raises(AttributeError, match="did you mean 'four_bar'"):
        _ = ilmek.fourbar
