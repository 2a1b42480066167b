"""Kernels as machine code, kept in the user's cache folder from run to run, or installed with the package.

An entry is found by a key of everything that is compiled into it: the bytecode of the kernel and of the kernels that it
calls, the global values that they use, the argument types, the processor and the versions of the libraries. An edit
anywhere else recompiles nothing. (Numba's own cache looks at the kernel's file alone and misses an edited callee.)

Entries are unpickled, so they are read only from a folder that only the user can write (`ilmek.num.private_files`),
and from the package itself (`ilmek.num.installed_kernels`). A damaged entry in the folder is removed and rebuilt.

With the environment variable ILMEK_BOUNDS_CHECK=1 every index into an array is checked (slower; kept under other keys):
an index outside raises IndexError.
"""

import dis
import hashlib
import os
import pickle
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from enum import Enum
from functools import cache
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any, cast

import llvmlite.binding
import numba
import numpy as np
from numba.core import compiler, serialize
from numba.core.caching import NullCache

from ilmek.num.compiled import COMPILATIONS, Kernel
from ilmek.num.installed_kernels import baseline, read_installed
from ilmek.num.private_files import ENTRY, private_folder, read_entry, remove_entry, write_entry
from ilmek.records import JsonObject

OPTIONS: JsonObject = {
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract"},
    "no_cfunc_wrapper": True,  # no kernel is passed to a library of C
    "boundscheck": os.environ.get("ILMEK_BOUNDS_CHECK") == "1",
}

PYTHON = f"{sys.implementation.cache_tag}{getattr(sys, 'abiflags', '')} {sys.platform}"
"""What a kernel's bytecode and its calls of Python depend on; a patch release of Python changes neither."""

VERSIONS = f"{PYTHON} {numba.__version__} {np.__version__} {OPTIONS}"

compile_result, dumps = cast(Any, compiler).CompileResult, cast(Any, serialize).dumps

INNER = f".inner{ENTRY}"
"""Ending of entries that are needed only while another kernel is compiled. They are not installed."""

discarded: list[Path] = []
"""Entries that were damaged and removed in this run."""


def dispatcher(kernel: Kernel, *, called_by_kernels: bool = False) -> Any:
    """Numba's dispatcher of a kernel; its machine code is kept if there is a private folder.

    called_by_kernels  without the code with which Python calls it, which takes a third of the time to compile
    """
    function = kernel.function
    inline = {"forceinline": True} if kernel.inline else {}  # without it a kernel follows its caller
    kinds = {"no_cpython_wrapper": called_by_kernels, "_nrt": kernel.counts, **OPTIONS, **inline}
    compiler_of = cast(Any, numba).njit(**kinds)(function)
    with suppress(TypeError, RecursionError):  # no key: compiled in every run
        key = f"{function.__module__}.{function.__qualname__} {kernel.inline}{kernel.counted} {code_key(function)}"
        compiler_of._cache = KernelCache(private_folder("kernels"), key, INNER if called_by_kernels else ENTRY)
    return compiler_of


class KernelCache(NullCache):
    """Numba's interface to kept machine code: one entry for each kernel and set of argument types.

    folder  the user's folder of entries; None: nothing is kept, and only installed entries are read
    key     the kernel's name and `code_key`
    suffix  of the entries: ENTRY, or INNER for code that only other kernels call
    """

    def __init__(self, folder: Path | None, key: str, suffix: str) -> None:
        self.folder, self.key, self.suffix = folder, key, suffix

    def entry(self, types: Iterable[Any], target: Iterable[object]) -> str:
        """The name of the machine code for these argument types and this triple, processor and features."""
        parts = (VERSIONS, self.key, *map(type_key, types), *map(str, target))
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:40] + self.suffix

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled kernel; None without a complete entry, so that it is compiled. A damaged one is removed."""
        target_context.refresh()
        target = target_context.codegen().magic_tuple()
        path = self.folder / self.entry(sig, target) if self.folder else None
        try:
            kept = read_entry(path) if path else None
            kept = kept or self._installed(sig, target[0])
            if kept is not None:
                return compile_result._rebuild(target_context, *pickle.loads(kept))
        except MemoryError:
            return None
        except Exception:  # whatever a damaged entry raises
            if path:
                remove_entry(path)
                discarded.append(path)
        COMPILATIONS.begin()
        return None

    def _installed(self, types: Iterable[Any], triple: str) -> bytes | None:
        """The entry that is installed with the package, if this computer can run its code."""
        processor = baseline(triple)
        if processor is None or not processor_has(processor.features):
            return None
        return read_installed(self.entry(types, (triple, processor.name, "")))

    def save_overload(self, sig: Any, data: Any) -> None:
        """Write an entry atomically; a full disc is no error."""
        if self.folder and not data.lifted and not data.library.has_dynamic_globals:
            write_entry(self.folder / self.entry(sig, data.codegen.magic_tuple()), dumps(data._reduce()))


@cache
def processor_has(features: tuple[str, ...]) -> bool:
    """Whether this computer's processor has all of these features, as LLVM names them."""
    host = llvmlite.binding.get_host_cpu_features() if features else {}
    return all(host.get(feature, False) for feature in features)


def type_key(numba_type: Any) -> str:
    """A type's name, with the names of the fields of named tuples."""
    fields, inner = getattr(numba_type, "fields", ()), getattr(numba_type, "types", ())
    return " ".join((str(numba_type), *map(str, fields), *map(type_key, inner)))


@cache
def code_key(function: FunctionType) -> str:
    """A digest of the bytecode and of all global values that it uses, other kernels by their own keys.

    Raises TypeError for a value of unknown content, and RecursionError for kernels that call each other in a circle.
    """
    digest = hashlib.sha256()
    for code in _codes(function.__code__):
        constants = [const for const in code.co_consts if not isinstance(const, CodeType) and const != function.__doc__]
        names = (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars)
        digest.update(repr((code.co_code, names, constants)).encode())
        for name in sorted({step.argval for step in dis.get_instructions(code) if step.opname == "LOAD_GLOBAL"}):
            if name in function.__globals__:
                digest.update(f"{name} {_content(function.__globals__[name], function, code.co_names)}\n".encode())
    for cell in function.__closure__ or ():
        digest.update(_content(cell.cell_contents, function, ()).encode())
    digest.update(_content(function.__defaults__, function, ()).encode())
    return digest.hexdigest()


def _codes(code: CodeType) -> Iterator[CodeType]:
    """A function's code and that of the functions within it."""
    yield code
    for const in code.co_consts:
        if isinstance(const, CodeType):
            yield from _codes(const)


def _content(value: object, user: FunctionType, names: tuple[str, ...]) -> str:
    """A global value as the compiler sees it in a function that uses these names."""
    match value:
        case Kernel():
            key = value.function.__qualname__ if value.function is user else code_key(value.function)
            return key + (" inline" if value.inline else "") + value.counted
        case None | bool() | int() | float() | complex() | str() | bytes() | Enum() | np.generic() | np.dtype():
            return repr(value)
        case tuple() | list():
            return f"{type(value).__name__} {[_content(item, user, names) for item in value]}"
        case np.ndarray():
            return f"{value.dtype} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
        case ModuleType():
            own = value.__name__.partition(".")[0] == user.__module__.partition(".")[0]
            inside = [_content(vars(value)[name], user, ()) for name in names if own and name in vars(value)]
            return f"{value.__name__} {inside}"
        case _ if callable(value):
            fields = getattr(value, "_fields", "")
            return f"{getattr(value, '__module__', '')} {getattr(value, '__qualname__', repr(value))} {fields}"
    raise TypeError(f"a kernel uses {value!r}, whose content is not known")
