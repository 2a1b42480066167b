"""Plain data of any value of a report."""

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any, TypeAlias

import numpy as np

from ilmek.errors import encodable

Json: TypeAlias = float | int | bool | str | Mapping[str, Any] | Sequence[Any] | None
"""A value that JSON can hold; what is inside of groups is Json again, which a checker at run time cannot follow."""


def plain(value: Any) -> Any:
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
