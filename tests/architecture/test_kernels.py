"""Every kernel's machine code can be kept: the values that it uses are known."""

import importlib
import pkgutil

import ilmek
from ilmek.num.compiled import Kernel
from ilmek.num.machine_code import code_key


def test_every_kernel_has_a_key():
    modules = [found.name for found in pkgutil.walk_packages(ilmek.__path__, "ilmek.") if "__main__" not in found.name]
    kernels = {
        value for name in modules for value in vars(importlib.import_module(name)).values() if isinstance(value, Kernel)
    }
    assert len({code_key(kernel.function) for kernel in kernels}) > 100
