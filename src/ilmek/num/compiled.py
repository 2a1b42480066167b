"""Compiled kernels: the leaf formulas in a loop, as machine code.

Kernels stand at module level and are decorated with `compiled`. The compiled code is kept in the user's cache folder,
under a key made of the package's sources: numba's own cache goes stale when a callee in another file changes.
"""

import hashlib
import inspect
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., Any])


def compiled(kernel: F) -> F:
    """`kernel` compiled on its first call: division by zero gives inf, NaN tests hold, multiply-adds may be fused."""
    # Under pytest a type checker is wrapped around every function; the compiler wants the bare one.
    bare = inspect.unwrap(kernel)
    return cast(F, numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})(bare))


def _sources_key() -> str:
    """A key that changes with any source file of the package."""
    package = Path(__file__).resolve().parents[1]
    digest = hashlib.sha256(f"{sys.version}{numba.__version__}".encode())
    for source in sorted(package.rglob("*.py")):
        seen = source.stat()
        digest.update(f"{source.relative_to(package)}:{seen.st_size}:{seen.st_mtime_ns}\n".encode())
    return digest.hexdigest()[:16]


def _cache_folder() -> Path:
    """The user's cache folder, or a temporary one where that cannot be written."""
    home = os.environ.get("XDG_CACHE_HOME") or (Path.home() / ".cache")
    folder = Path(home) / "ilmek" / "numba" / _sources_key()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = tempfile.NamedTemporaryFile(dir=folder)  # noqa: SIM115 - opened only to see whether it can be
        probe.close()
    except OSError:
        return Path(tempfile.gettempdir()) / f"ilmek-numba-{_sources_key()}"
    return folder


if "NUMBA_CACHE_DIR" not in os.environ:
    vars(numba.config)["CACHE_DIR"] = str(_cache_folder())
