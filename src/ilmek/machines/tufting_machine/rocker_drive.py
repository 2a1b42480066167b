"""A crank-rocker on the crank shaft of the loopers, which swings a shaft along the machine: of loopers or of knives.

    ground Q-P      crank Q-A, an eccentric     coupler A-B     rocker P-B on the shaft P

Q is the crank shaft of the loopers, which turns with the main shaft by a toothed belt 1:1. The linkages are those of a
family by their swing (`synthesis.crank_rocker`), mirrored in the ground link. Forward is clockwise for the sense +1:

    deviation = s (alpha(-theta) - alpha_0)      theta of the crank, from the ground link      alpha of the rocker
"""

import cmath

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation
from ilmek.records import computed, record, result
from ilmek.synthesis.crank_rocker.dead_centres import LinkRatios, beta_of_ratio, transmission_angle_min
from ilmek.synthesis.crank_rocker.motion import moved
from ilmek.synthesis.crank_rocker.selection import Member
from ilmek.units import turn

TIP = "tip"
"""Point of a rocker that works on the yarn."""


@record
class RockerDrive:
    """A drive.

    name     of what it swings              linkage  lengths over the ground link
    ground   length of the ground link [m]  leaning  its direction from Q to P [rad]
    sense    of the rocker forward: +1 clockwise, -1 counter-clockwise
    offset   crank angle from the ground link where the main shaft's is 0 [rad]
    """

    name: str
    linkage: Member
    ground: float
    leaning: float
    sense: int
    offset: float
    swing: float = result("deg", "swing of the shaft")
    rotation: float = result("deg", "crank between the ends of the swing", name="crank_rotation")

    links = computed("mm", "lengths of the crank-rocker", lambda it: it.lengths)
    transmission = computed(
        "deg", "least acute angle of its coupler and rocker", lambda it: float(transmission_angle_min(it.linkage.links))
    )
    phase = computed("deg", "angle of its crank where the main shaft's is 0", lambda it: it.crank(0.0) % turn)

    @property
    def lengths(self) -> dict[str, float]:
        """Lengths of its links [m]."""
        scale, links = self.ground, self.linkage
        return {
            "ground": scale,
            "crank": scale * links.crank,
            "coupler": scale * links.coupler,
            "rocker": scale * links.rocker,
        }

    @property
    def bodies(self) -> tuple[str, str, str]:
        """Names of crank, coupler and rocker."""
        return f"{self.name} crank", f"{self.name} coupler", f"{self.name} rocker"

    def crank(self, angle: float | FloatArray) -> float | FloatArray:
        """Crank angle in the axes of the machine [rad] at crank angles of the main shaft [rad]."""
        return angle + self.offset + self.leaning

    def deviation(self, angle: FloatArray) -> FloatArray:
        """Swing from its middle, forward positive [rad], at crank angles of the main shaft [rad]."""
        return deviation(self.linkage, self.swing, self.sense, np.asarray(angle) + self.offset)

    @property
    def forward_end(self) -> float:
        """Crank angle of the main shaft at the forward end [rad]: the extended dead centre for the sense -1."""
        turned = 0.0 if self.sense < 0 else self.rotation
        return -self.linkage.beta - turned - self.offset

    @property
    def middle(self) -> float:
        """Direction of the rocker in the middle of its swing [rad]."""
        return self.leaning - rocker_angle(self.linkage, self.swing)

    def mechanism(self, shaft: complex, tip: complex) -> Mechanism:
        """The linkage about its shaft P [m], with a point of the rocker, from P in the middle of the swing [m]."""
        lengths, (crank, coupler, rocker) = self.lengths, self.bodies
        return Mechanism(
            name=self.name,
            bodies=(
                Body(GROUND, {"Q": shaft - cmath.rect(self.ground, self.leaning), "P": shaft}),
                Body(crank, {"Q": 0, "A": lengths["crank"]}),
                Body(coupler, {"A": 0, "B": lengths["coupler"]}),
                Body(rocker, {"P": 0, "B": lengths["rocker"], TIP: tip * cmath.exp(-1j * self.middle)}),
            ),
            joints=(
                Pin("Q", GROUND, crank),
                Pin("A", crank, coupler),
                Pin("B", coupler, rocker),
                Pin("P", GROUND, rocker),
            ),
            inputs=(Rotation(crank, "Q"),),
            branches={"B": -1},
        )


def deviation(linkage: Member, swing: float, sense: int, angle: FloatArray) -> FloatArray:
    """Swing from the middle, forward positive [rad]: a mirrored rocker turns the other way.

    angle  of the crank [rad], from the ground link
    """
    rocker = moved(linkage.links, -angle).rocker
    return np.asarray(sense * np.angle(rocker * np.exp(-1j * rocker_angle(linkage, swing))))


def rocker_angle(linkage: Member, swing: float) -> float:
    """Direction alpha_0 of the rocker in the middle of its swing, against the ground link [rad], before mirroring."""
    extended = (linkage.crank + linkage.coupler) * cmath.exp(1j * linkage.beta) - 1
    return cmath.phase(extended) + swing / 2


def coupled(links: LinkRatios, swing: float, rotation: float) -> Member:
    """The crank-rocker of links [ground links], a swing and a rotation of its crank [rad]."""
    crank, coupler, rocker = (float(link) for link in links)
    return Member(crank, coupler, rocker, float(beta_of_ratio(swing, rotation, crank / coupler)))
