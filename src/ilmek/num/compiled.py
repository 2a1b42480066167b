"""Compiled kernels: formulas in a loop, as machine code.

Kernels are functions of modules with the decorator `compiled`. Nothing is compiled, and no compiler is loaded (0.5 s),
before a kernel is called; the machine code is kept for the next run (`ilmek.num.machine_code`).
"""

import functools
import inspect
from collections.abc import Callable
from importlib import import_module
from types import FunctionType
from typing import Any, TypeVar, cast

F = TypeVar("F", bound=Callable[..., Any])


class Kernel:
    """A function that is compiled on its first call. Kernels call each other without leaving the machine code.

    inline  its code becomes part of the kernels that call it
    counts  references to arrays are counted, as a kernel needs that makes one
    """

    def __init__(self, function: FunctionType, *, inline: bool = False, counts: bool = True) -> None:
        functools.update_wrapper(self, function)
        self.function, self.inline, self.counts = function, inline, counts
        self.counted = "" if counts else " uncounted"

    def __call__(self, *args: object) -> object:
        """The function's value, computed by machine code."""
        return self.dispatcher(*args)

    @functools.cached_property
    def dispatcher(self) -> Any:
        """Numba's dispatcher, which compiles the function for each set of argument types."""
        return import_module("ilmek.num.machine_code").dispatcher(self)

    @functools.cached_property
    def inner_dispatcher(self) -> Any:
        """Numba's dispatcher for calls by other kernels, which need no way through Python."""
        return import_module("ilmek.num.machine_code").dispatcher(self, called_by_kernels=True)

    @property
    def _numba_type_(self) -> object:
        """The type of this kernel for the compiler of another one."""
        return self.inner_dispatcher._numba_type_


def compiled(function: F) -> F:
    """`function` compiled on its first call: division by zero gives inf, NaN tests hold, multiply-adds may be fused."""
    # Under pytest a type checker may be wrapped around the function; the compiler needs the function itself.
    return cast(F, Kernel(cast(FunctionType, inspect.unwrap(function))))


def inlined(function: F) -> F:
    """As `compiled`, for a small kernel that passes arrays on: its code becomes part of the kernels that call it."""
    return cast(F, Kernel(cast(FunctionType, inspect.unwrap(function)), inline=True))


def uncounted(function: F) -> F:
    """As `compiled`, for a kernel that makes no array: without the counts of references, each an atomic step."""
    return cast(F, Kernel(cast(FunctionType, inspect.unwrap(function)), counts=False))


def embedded(function: F) -> F:
    """As `uncounted`, and its code becomes part of the kernels that call it. For a kernel that is called for every knot
    with a tuple of arrays: to hand over ten arrays takes longer than most of what is done with them.
    """
    return cast(F, Kernel(cast(FunctionType, inspect.unwrap(function)), inline=True, counts=False))


class Compilations:
    """The compilations of this process: their number, and who is notified of each before it begins."""

    def __init__(self) -> None:
        self.number = 0
        self.listener: Callable[[int], object] | None = None

    def begin(self) -> None:
        """Count a compilation and notify the listener."""
        self.number += 1
        if self.listener is not None:
            self.listener(self.number)


COMPILATIONS = Compilations()
"""Counted by `ilmek.num.machine_code`; a command on a terminal listens, since a first run takes half a minute."""
