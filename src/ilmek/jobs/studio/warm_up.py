"""What a worker imports before its first request, so that the first answer comes as quickly as the next."""

from importlib import import_module

MODULES = ("numpy", "ilmek.machines.catalogue", "ilmek.jobs.design")


def warm_up() -> None:
    """Import what nearly every request needs."""
    for module in MODULES:
        import_module(module)
