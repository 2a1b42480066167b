"""A brief of a designer's day: what is wanted, and the calls of tools that an agent makes for it."""

from dataclasses import dataclass
from typing import Any

Call = tuple[str, dict[str, Any]]


@dataclass(frozen=True)
class Brief:
    """A brief: its kind, what is wanted, the calls; the last answer has the checks of what was made."""

    kind: str
    wanted: str
    calls: tuple[Call, ...]


def designed(kind: str, wanted: str, machine: str, /, *first: Call, **settings: str) -> Brief:
    """A brief that ends in a machine of the catalogue; two underlines of a name stand for a dot."""
    named = {name.replace("__", "."): value for name, value in settings.items()}
    return Brief(kind, wanted, (*first, ("design", {"name": machine, "settings": named})))


def called(kind: str, wanted: str, tool: str, /, *first: Call, **arguments: Any) -> Brief:
    """A brief that ends in a call of a tool."""
    return Brief(kind, wanted, (*first, (tool, arguments)))
