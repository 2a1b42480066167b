"""Chains of tolerances: how far a distance may be off when each of its links is anywhere within its tolerance.

    closure = sum r_i x_i,   |x_i| <= t_i,        worst case  W = sum |r_i| t_i
    statistical  S = min(W, 3 sqrt(sum r_i² s_i²)),   s = t / 3 of sizes as made, s = t / sqrt(3) of play

r is the ratio by which a link's deviation appears in the closure. Sizes are normal, their tolerance three standard
deviations; a pin lies anywhere in its play. 99.7 % of all assemblies keep S.
[sum of variances; Shigley, 1-14: statistical and worst-case stack-ups]
"""

import math

from ilmek.records import record


@record
class ToleranceLink:
    """A link of a chain.

    deviation  to each side [m]      ratio  of the closure's deviation to its own      play  it lies anywhere in it
    """

    name: str
    deviation: float
    ratio: float = 1.0
    play: bool = False

    @property
    def share(self) -> float:
        """Its largest deviation of the closure [m]."""
        return abs(self.ratio) * self.deviation

    @property
    def scatter(self) -> float:
        """Standard deviation of its share [m]."""
        return self.share / (math.sqrt(3) if self.play else 3)


@record
class ToleranceStack:
    """A chain, and the room to each side that its closure has [m]."""

    title: str
    room: float
    links: tuple[ToleranceLink, ...]

    @property
    def worst(self) -> float:
        """Worst case [m]: every link at its limit.

        >>> ToleranceStack("", 1.0, (ToleranceLink("", 1.0), ToleranceLink("", 2.0, -0.5))).worst
        2.0
        """
        return math.fsum(link.share for link in self.links)

    @property
    def statistical(self) -> float:
        """What 99.7 % of all assemblies keep [m].

        >>> ToleranceStack("", 1.0, (ToleranceLink("", 3.0), ToleranceLink("", 4.0))).statistical
        5.0
        """
        return min(self.worst, 3 * math.hypot(*(link.scatter for link in self.links)))
