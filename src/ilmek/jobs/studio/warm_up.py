"""What a worker does while it has no request, so that the first answers come quickly."""

import pkgutil
from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module

MODULES = ("numpy", "ilmek.machines.catalogue", "ilmek.jobs.design")
"""What nearly every request needs."""

DESIGNS = ("beat-up", "cam")
"""Machines whose design loads the compiled kernels that most others have too."""


def preparations_for(affinity: str = "") -> Iterator[Callable[[], object]]:
    """What a worker does at once that will answer requests of an affinity; "": those of the project's files."""
    yield partial(import_module, "ilmek.jobs.studio.project.tasks")
    if affinity == "carpet":
        yield partial(import_module, "ilmek.jobs.studio.carpet.tasks")
        yield partial(import_module, "ilmek.num.machine_code")
        yield import_module("ilmek.jobs.studio.carpet.tasks").prepare


def preparations() -> Iterator[Callable[[], object]]:
    """What a worker without requests does, in steps of less than a second: tasks, machines, compiled kernels."""
    for module in MODULES:
        yield partial(import_module, module)
    tasks = import_module("ilmek.jobs.studio").__path__
    for found in pkgutil.walk_packages(tasks, "ilmek.jobs.studio."):
        yield partial(import_module, found.name)
    yield import_module("ilmek.jobs.studio.carpet.tasks").prepare
    machines = import_module("ilmek.machines.catalogue").MACHINES
    for name in machines:
        yield partial(machines.__getitem__, name)
    design = import_module("ilmek.jobs.design").design_machine
    for name in DESIGNS:
        yield partial(design, name, {})
