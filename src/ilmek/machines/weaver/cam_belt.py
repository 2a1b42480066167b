"""The belt from a head's motor to its cam shaft: its pulleys by the torque, their places in the side view.

    z = 2 pi T S / p F,   F = f w m        T torque, S margin, p pitch, m teeth in mesh

A tooth bears f for each width w.

The small pulley is on the reducer, in front of the case; the belt runs in a station of its own beside the last cam.
"""

import math

from ilmek.elements.belts import BELTS, MESHING
from ilmek.elements.duty import MARGIN
from ilmek.records import record
from ilmek.units import mm, turn

PROFILE, SMALL = BELTS["AT5"], 30
"""The belt, and the teeth of its small pulley, of which as many mesh as may share the pull."""

PULL = (PROFILE.pull or 0.0) * MESHING
"""Allowed pull of the belt over its width [N/m]."""


@record
class CamBelt:
    """A belt on two pulleys: teeth of the one on the cam shaft, its width [m], and the torque that it gives [N m]."""

    large: int
    width: float
    torque: float

    @property
    def ratio(self) -> float:
        """Turns of the reducer for one of the shaft."""
        return self.large / SMALL

    @property
    def radii(self) -> tuple[float, float]:
        """Pitch radii on the shaft and on the reducer [m]."""
        return PROFILE.pitch * self.large / turn, PROFILE.pitch * SMALL / turn

    @property
    def pull(self) -> float:
        """Greatest pull by the torque [N]."""
        return self.torque / self.radii[0]

    @property
    def allowed(self) -> float:
        """The greatest pull that it bears [N]."""
        return PULL * self.width


HUB = 6 * mm
"""Metal and keyway between a pulley's bore and its teeth [m]; assumed by this project."""


def cam_belt(torque: float, room: float, width: float, shaft: float) -> CamBelt:
    """The belt of a width [m] for a torque on the cam shaft [N m], of a diameter [m].

    Its large pulley is no larger than a room's radius [m], but that its hub has room about the shaft.
    """
    groove = PROFILE.groove.offset + PROFILE.groove.depth
    least = math.ceil(turn * (shaft / 2 + HUB + groove) / PROFILE.pitch)
    needed = math.ceil(turn * MARGIN * torque / (PROFILE.pitch * PULL * width) - 1e-9)
    most = math.floor(turn * room / PROFILE.pitch)
    return CamBelt(max(SMALL, least, min(needed, most)), width, torque)
