"""What slope of the shaft a rolling bearing bears.

>>> [bearing.name for bearing in bearings_for(0.0008)]
['deep-groove ball', 'cylindrical roller']
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Bearing:
    """A kind of rolling bearing and the largest slope [rad] between its shaft and its outer ring."""

    name: str
    slope_limit: float
    source: str


BEARINGS = (
    Bearing("deep-groove ball", 0.004, "thesis 3.1; makers say 2' to 10', 0.0006 to 0.003 rad, by clearance and load"),
    Bearing("cylindrical roller", 0.001, "thesis 3.1; makers say 3' to 4', 0.0009 to 0.0012 rad"),
    Bearing("tapered roller", 0.0005, "thesis 3.1"),
)
"""The thesis' limits. Its own UCF 207 is a deep-groove ball bearing with a spherical outside, which takes up a slope of
some degrees once, when it is mounted, and so only what the load adds later counts against the limit."""


def bearings_for(slope: float) -> tuple[Bearing, ...]:
    """The kinds that bear a slope [rad]."""
    return tuple(bearing for bearing in BEARINGS if slope <= bearing.slope_limit)
