"""The family of crank-rockers with one swing and one rotation of the crank, as arrays of members and their quantities.

Members are evenly spaced in the ratio a / b, which identifies them for every phi (`beta` does not). The first and last
are half a step from the ends of the open interval; at the ends themselves the linkages are at a toggle position.
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, RealField
from ilmek.records import record
from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    OpenInterval,
    beta_of_ratio,
    dead_centres,
    grashof_margin,
    links_of_ratio,
    ratio_limits,
    transmission_angle_min,
)
from ilmek.synthesis.crank_rocker.motion import beat_acceleration, rocker_extremes
from ilmek.synthesis.crank_rocker.selection import require_rotation

COUNT = 1000
"""Default number of members of a family."""


@record
class CrankRockerFamily:
    """Crank-rockers with one swing and one rotation of the crank [rad], by ascending ratio crank / coupler."""

    swing: float
    rotation: float
    ratio: Float[np.ndarray, " members"]

    def __len__(self) -> int:
        return self.ratio.size

    @property
    def links(self) -> LinkRatios:
        """Link lengths [ground links], one value per member."""
        return links_of_ratio(self.swing, self.rotation, self.ratio)

    @property
    def beta(self) -> FloatArray:
        """Crank angles of the extended dead centre [rad], one per member."""
        return np.broadcast_to(beta_of_ratio(self.swing, self.rotation, self.ratio), self.ratio.shape)

    def geometry(self, reach: RealField | None = None) -> dict[str, FloatArray]:
        """Geometric quantities by name, one value per member.

        reach  distance of the rocker's far end from its pivot [ground links]; default: that of its pin

        crank_coupler_ratio [1], transmission_angle_min [rad], link_ratio [1], grashof_margin and size [ground links]
        """
        links = self.links
        return {
            "crank_coupler_ratio": self.ratio,
            "transmission_angle_min": np.asarray(transmission_angle_min(links)),
            "link_ratio": np.asarray(link_ratio(links)),
            "grashof_margin": np.asarray(grashof_margin(links)),
            "size": np.asarray(size(links, self.beta, reach)),
        }

    def kinematics(self, speed: float) -> dict[str, FloatArray]:
        """Quantities of the rocker's motion by name at a constant speed of the crank [rad/s], one value per member.

        rocker_speed_max [rad/s], rocker_acceleration_max, rocker_acceleration_at_beat [rad/s^2]
        """
        most = rocker_extremes(self.links)
        return {
            "rocker_speed_max": most.speed * abs(speed),
            "rocker_acceleration_max": most.acceleration * speed**2,
            "rocker_acceleration_at_beat": np.asarray(beat_acceleration(self.links)) * speed**2,
        }


def family(
    swing: float, rotation: float, count: int = COUNT, *, within: OpenInterval | None = None
) -> CrankRockerFamily:
    """Members of the family of a swing and a rotation of the crank.

    swing, rotation  psi, phi [rad]
    count            number of members
    within           range of the ratio crank / coupler, ends included; default: the whole family

    Raises ParameterError where no crank-rocker has this swing and rotation of the crank.

    >>> family(np.radians(30), np.pi, 4).ratio.round(9).tolist()
    [0.125, 0.375, 0.625, 0.875]
    """
    require_rotation(swing, rotation)
    low, high = ratio_limits(swing, rotation)
    if within is None:
        return CrankRockerFamily(swing, rotation, low + (high - low) * (np.arange(count) + 0.5) / count)
    return CrankRockerFamily(swing, rotation, np.linspace(within.low, within.high, count))


def link_ratio(links: LinkRatios) -> RealField:
    """Longest link / shortest link [1], including the ground link.

    >>> float(link_ratio(LinkRatios(0.25, 0.5, 0.75)))
    4.0
    """
    crank, coupler, rocker = links
    longest: RealField = np.maximum(np.maximum(coupler, rocker), 1.0) / np.minimum(np.minimum(crank, coupler), rocker)
    return longest


def size(links: LinkRatios, beta: RealField, reach: RealField | None = None) -> RealField:
    """Overall size: greatest distance between positions of the linkage's points over a turn [ground links].

        max(1 + a,  2 a + b,  a + |1 + r e^{i angle(AB at the beat)}|,  c,  r,  2 max(c, r) sin(swing / 2))

    beta   crank angle of the extended dead centre [rad]
    reach  r: distance of the rocker's far end E from A, on the line A-B; default: that of B

    The terms are the distances from the crank's circle to A, to B and to E at their farthest from D; from A to B and to
    E; and the stroke of B or E from end to end, longer than c and r for swings above 60 degrees.      [derived]

    >>> float(size(LinkRatios(0.25, 0.5, 0.75), 0.7))
    1.25
    """
    crank, coupler, rocker = links
    reach = rocker if reach is None else reach
    along = ((crank + coupler) * np.exp(1j * np.asarray(beta)) - 1) / rocker
    stroke = 2 * np.maximum(rocker, reach) * np.sin(np.abs(dead_centres(links).swing) / 2)
    distances = (1 + crank, 2 * crank + coupler, crank + np.abs(1 + reach * along), rocker, reach, stroke)
    greatest: RealField = np.max(np.stack(np.broadcast_arrays(*distances)), axis=0)
    return greatest
