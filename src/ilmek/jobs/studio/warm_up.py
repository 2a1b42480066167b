"""What a worker does before its first request, and while it has none, so that the first answers come quickly."""

import pkgutil
from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module

MODULES = ("numpy", "ilmek.machines.catalogue", "ilmek.jobs.design")
DESIGNS = ("beat-up", "cam")
"""Machines whose design loads the compiled kernels that most others have too."""


def warm_up() -> None:
    """Import what nearly every request needs."""
    for module in MODULES:
        import_module(module)


def preparations() -> Iterator[Callable[[], object]]:
    """What a worker without requests does, in steps of less than a second: tasks, machines, compiled kernels."""
    tasks = import_module("ilmek.jobs.studio").__path__
    for module in pkgutil.walk_packages(tasks, "ilmek.jobs.studio."):
        yield partial(import_module, module.name)
    yield import_module("ilmek.jobs.studio.carpet.tasks").prepare
    machines = import_module("ilmek.machines.catalogue").MACHINES
    for name in machines:
        yield partial(machines.__getitem__, name)
    design = import_module("ilmek.jobs.design").design_machine
    for name in DESIGNS:
        yield partial(design, name, {})
