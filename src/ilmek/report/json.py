"""Plain data of any value of a report."""

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ilmek.errors import encodable

if TYPE_CHECKING:
    Json: TypeAlias = float | int | bool | str | Mapping[str, "Json"] | Sequence["Json"] | None
else:  # a checker at run time cannot follow what is inside
    Json: TypeAlias = float | int | bool | str | Mapping[str, object] | Sequence[object] | None
"""A value that JSON can hold."""


def plain(value: object) -> Any:
    """The value as JSON holds it: arrays become lists, complex numbers [x, y], numbers that are not finite None."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {encodable(str(key)): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, str | PurePath):
        return encodable(str(value))
    return None if isinstance(value, float) and not np.isfinite(value) else value
