"""Values that take seconds to make and follow from the sources alone: made once, kept for all processes of all runs."""

import hashlib
import pickle
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar

Value = TypeVar("Value")
ROOT = Path(__file__).parents[2]
SOURCES = ("src/ilmek", "tests/support", "examples")


@cache
def digest_of_sources() -> str:
    """A digest of everything that a kept value may follow from."""
    found = hashlib.sha256()
    for folder in SOURCES:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                found.update(f"{path.relative_to(ROOT)} {path.stat().st_size}\n".encode())
                found.update(path.read_bytes())
    return found.hexdigest()


def kept(make: Callable[[], Value], folder: Path = ROOT / ".pytest_cache" / "kept") -> Value:
    """The value of a function of no arguments, by its name and the sources; files of other sources are removed."""
    path = folder / f"{make.__module__}.{make.__qualname__}.{digest_of_sources()}"
    if path.exists():
        value: Value = pickle.loads(path.read_bytes())
        return value
    value = make()
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob(f"{make.__module__}.{make.__qualname__}.*"):
        old.unlink(missing_ok=True)
    with tempfile.NamedTemporaryFile(dir=folder, delete=False) as file:
        file.write(pickle.dumps(value))
    Path(file.name).replace(path)
    return value
