"""Random numbers by counter, one at a time: the formula of `random.word` in the interpreter's whole numbers.

    draw(seed, stream, ordinal) = mix(mix(mix(seed) + stream) + ordinal) / 2,   mix of SplitMix64

A compiled kernel would be loaded for half a second and called for a knot at a time; a test keeps the two equal.
"""

_MASK = (1 << 64) - 1
_GOLDEN, _FIRST, _SECOND = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB

DRAW_BITS = 63
"""Bits of a draw."""


def draw(seed: int, stream: int, ordinal: int) -> int:
    """A whole number from 0 to 2^63 - 1, uniform, of three whole numbers of at least 0."""
    return _mix(_mix(_mix(seed) + stream) + ordinal) >> 1


def bound(probability: float) -> int:
    """The number below which a draw falls with a probability from 0 to 1.

    >>> bound(0.5) == 1 << 62, bound(1.0) == 1 << 63
    (True, True)
    """
    return int(probability * (1 << DRAW_BITS))


def _mix(value: int) -> int:
    value = (value + _GOLDEN) & _MASK
    value = ((value ^ (value >> 30)) * _FIRST) & _MASK
    value = ((value ^ (value >> 27)) * _SECOND) & _MASK
    return value ^ (value >> 31)
