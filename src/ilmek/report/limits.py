"""Rounding at a limit: a part made for exactly its limit keeps it."""

import math


def snap_to_limit(value: float, limit: float) -> float:
    """The limit where the value is equal to it but for rounding, else the value.

    >>> snap_to_limit(30.000000000000004, 30.0)
    30.0
    """
    return limit if math.isclose(value, limit, rel_tol=1e-9) else value
