"""Entries of other packages beside the own ones: machines, motion laws, chart formats, controllers.

Another package declares them as entry points of a group. Its own `pyproject.toml` has, for a motion law,

    [project.entry-points."ilmek.motion_laws"]
    smoothstep = "carpet_laws:FAMILY"

They are read when a name is not ours, or all names are listed: a call with an own name costs nothing.
"""

from collections.abc import Iterator, Mapping, MutableMapping
from functools import cached_property
from importlib import import_module
from typing import Generic, TypeVar

from ilmek.errors import ParameterError

Entry = TypeVar("Entry")


class Registry(MutableMapping[str, Entry], Generic[Entry]):
    """Entries by name: our own, then those of other packages; an own name is never replaced.

    group  of the entry points      own  entries of this package      kind  class of an entry

    Raises ParameterError for an entry of another package that cannot be imported, or is of another class.
    """

    def __init__(self, group: str, own: Mapping[str, Entry], kind: type[Entry]) -> None:
        self.group = group
        self.own = dict(own)
        self.kind = kind

    @cached_property
    def further(self) -> dict[str, Entry]:
        """The entries of other packages."""
        points = import_module("importlib.metadata").entry_points(group=self.group)
        return {point.name: self._loaded(point.name, point) for point in points if point.name not in self.own}

    def _loaded(self, name: str, point: object) -> Entry:
        given = f"{name!r} of another package, an entry point of {self.group},"
        try:
            entry = point.load()  # type: ignore[attr-defined]  # importlib.metadata is imported late
        except Exception as error:
            raise ParameterError(f"{given} fails: {error}", do="mend or uninstall that package") from error
        if not isinstance(entry, self.kind):
            raise ParameterError(f"{given} is a {type(entry).__name__}", allowed=f"a {self.kind.__name__}")
        return entry

    def __getitem__(self, name: str) -> Entry:
        return self.own[name] if name in self.own else self.further[name]

    def __contains__(self, name: object) -> bool:
        return name in self.own or name in self.further

    def __setitem__(self, name: str, entry: Entry) -> None:
        self.own[name] = entry

    def __delitem__(self, name: str) -> None:
        del self.own[name]

    def __iter__(self) -> Iterator[str]:
        yield from self.own
        yield from self.further

    def __len__(self) -> int:
        return len(self.own) + len(self.further)
