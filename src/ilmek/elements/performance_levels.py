"""Performance levels of safety functions: which one a hazard requires, and which one a chain of devices reaches.

    required   by severity S, frequency F and possibility of avoiding P              [ISO 13849-1, annex A, figure A.1]
    l   = 0.1 c / B10d             dangerous failures of a contact in an hour, c operations in an hour        [annex C]
    PFH = (1 - b)² l² (DC T2 + (1 - DC) T1) + b l      two alike channels           [IEC 62061, 6.7.8, architecture D]
    reached    by the sum over all devices in the chain                                        [ISO 13849-1, table 2]

DC diagnostic coverage, T2 time between two tests, T1 mission time, b share of failures of a common cause.
"""

import math

HARMLESS_ENERGY, HARMLESS_FORCE = 4.0, 75.0
"""Energy [J] and force [N] up to which what moves does no lasting harm: ISO 14120, 5.2.5.2."""

MISSION = 20 * 365.25 * 24
"""Mission time of ISO 13849-1 [h]."""

COMMON, COVERED = 0.05, 0.99
"""Share of failures of a common cause, and coverage of contacts that a safety relay compares: annexes E, F."""

_MASKED = ((1, COVERED), (4, 0.9), (30, 0.6))


def masked(contacts: int) -> float:
    """Most coverage of rarely used contacts in series on one relay, of which the next one hides a failure.

    As the classes medium, low and none of ISO/TR 24119 (now ISO 14119, annex K), for devices none of which is used
    often; at the least value of each class.

    >>> [masked(number) for number in (1, 4, 5, 31)]
    [0.99, 0.9, 0.6, 0.0]
    """
    return next((coverage for most, coverage in _MASKED if contacts <= most), 0.0)


_LEVELS = (("e", 1e-7), ("d", 1e-6), ("c", 3e-6), ("b", 1e-5), ("a", 1e-4))


def required_level(*, lasting: bool, often: bool, avoidable: bool) -> str:
    """The performance level that a hazard requires.

    lasting  S2: it may do lasting harm      often  F2: more than once in 15 minutes      avoidable  P1

    >>> required_level(lasting=True, often=False, avoidable=False)
    'd'
    """
    return "abcde"[2 * lasting + often + (not avoidable)]


def limit_of(level: str) -> float:
    """The failures in an hour below which a level is reached [1/h].

    >>> limit_of("d")
    1e-06
    """
    return dict(_LEVELS)[level]


def reached_level(failures: float) -> str:
    """The best level that is reached with dangerous failures in an hour [1/h]; "": none.

    >>> reached_level(2e-8), reached_level(4e-7), reached_level(1.0) == ""
    ('e', 'd', True)
    """
    return next((level for level, limit in _LEVELS if failures < limit), "")


def mean_years(b10d: float, hourly: float) -> float:
    """Mean time to a dangerous failure MTTFd of a contact [years], of its mean life and operations in an hour.

    >>> round(mean_years(1e5, 0.125))
    913
    """
    return b10d / (0.1 * hourly) / (365.25 * 24)


def contact_failures(b10d: float, hourly: float, covered: float = COVERED) -> float:
    """Dangerous failures of two contacts side by side in an hour [1/h], of the mean life and operations in an hour.

    covered  diagnostic coverage

    >>> round(contact_failures(1e5, 0.125) * 1e9, 2)
    6.27
    """
    each = 0.1 * hourly / b10d
    both = covered / hourly + (1 - covered) * MISSION if hourly else math.inf
    return (1 - COMMON) ** 2 * each**2 * both + COMMON * each if each else 0.0
