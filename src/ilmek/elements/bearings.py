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
    Bearing("deep-groove ball", 0.004, "thesis 3.1; Shigley, Mechanical Engineering Design, table 7-2"),
    Bearing("cylindrical roller", 0.001, "thesis 3.1; Shigley, Mechanical Engineering Design, table 7-2"),
    Bearing("tapered roller", 0.0005, "thesis 3.1; Shigley, Mechanical Engineering Design, table 7-2"),
)


def bearings_for(slope: float) -> tuple[Bearing, ...]:
    """The kinds that bear a slope [rad]."""
    return tuple(bearing for bearing in BEARINGS if slope <= bearing.slope_limit)
