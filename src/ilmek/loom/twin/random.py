"""Random numbers of the twin: each is a hash of a seed, a stream and an ordinal, in whole numbers alone.

    word(seed, stream, ordinal) = mix(mix(mix(seed) + stream) + ordinal)

There is no state: any number can be drawn by itself, in any order and in any process. With whole numbers the result is
the same on every processor; a logarithm of a mathematical library is not. `mix` is the finaliser of SplitMix64 (Steele,
Lea, Flood, "Fast splittable pseudorandom number generators", 2014); numbers by counter: Salmon, Moraes, Dror, Shaw,
"Parallel random numbers: as easy as 1, 2, 3", 2011.

Fixed-point numbers have the value n / 2^q, given as Qq. A word is a whole number from 0 to 2^63 - 1.
"""

import numpy as np

from ilmek.num.compiled import compiled

CHANCE_BITS = 32
"""Fraction bits of a probability: Q32."""

_GOLDEN, _FIRST, _SECOND = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_LN_2 = 744261118
"""ln 2, Q30."""


@compiled
def _mix(h: np.uint64) -> np.uint64:
    h = (h ^ (h >> np.uint64(30))) * _FIRST
    h = (h ^ (h >> np.uint64(27))) * _SECOND
    return h ^ (h >> np.uint64(31))


@compiled
def word(seed: int, stream: int, ordinal: int) -> int:
    """The random word of an ordinal of a stream of a seed: uniform from 0 to 2^63 - 1.

    seed, stream, ordinal  whole numbers of at least 0, below 2^63
    """
    h = _mix(np.uint64(seed) + _GOLDEN)
    h = _mix(h + np.uint64(stream) + _GOLDEN)
    h = _mix(h + np.uint64(ordinal) + _GOLDEN)
    return int(np.int64(h >> np.uint64(1)))


@compiled
def happens(drawn: int, chance: int) -> bool:
    """Whether an event of a probability [Q32] happens, by a word."""
    return (drawn >> 31) < chance


@compiled
def exponential(drawn: int) -> int:
    """An exponentially distributed number of mean 1 [Q20], by a word: -ln((drawn + 1) / 2^63) to 2^-20.

    The logarithm is taken digit by digit: a number in [1, 2) is squared; where it reaches 2, the digit is 1.
    """
    m = drawn | 1
    n = 0
    for step in (32, 16, 8, 4, 2, 1):
        if m >> (n + step) > 0:
            n += step
    x = (m << (62 - n)) >> 32
    log2 = n
    for _ in range(24):
        x = (x * x) >> 30
        log2 <<= 1
        if x >= 1 << 31:
            x >>= 1
            log2 += 1
    return (((63 << 24) - log2) * _LN_2) >> 34


@compiled
def scaled(mean: int, share: int) -> int:
    """The product mean * share [Q20], rounded down, without overflow for a mean below 2^55."""
    return (mean >> 20) * share + (((mean & 0xFFFFF) * share) >> 20)


@compiled
def exponential_time(mean: int, seed: int, stream: int, ordinal: int) -> int:
    """A time of exponential distribution with a mean, both in ns: of calls, responses, distances of faults."""
    return scaled(mean, exponential(word(seed, stream, ordinal)))


@compiled
def erlang_time(mean: int, seed: int, stream: int, ordinal: int) -> int:
    """A time of Erlang's distribution of four phases with a mean, both in ns: standard deviation half of the mean."""
    total = 0
    for phase in range(4):
        total += scaled(mean, exponential(word(seed, stream, 4 * ordinal + phase)))
    return total >> 2


def chance_of(share: float) -> int:
    """A probability from 0 to 1 as Q32.

    >>> chance_of(0.5) == 2**31, chance_of(1.0) == 2**32
    (True, True)
    """
    return round(share * (1 << CHANCE_BITS))
