"""The shoulder of a journal: notch factors of its fillet, stress and safety against fatigue.

    Kt = 1 + 1 / sqrt(A r/t + 2 B (r/d) (1 + 2 r/d)^2 + C (r/t)^z d/D),   t = (D - d) / 2       [DIN 743-2:2012, A.2]

    bending  A = 0.62   B = 5.8   C = 0.2   z = 3          torsion  A = 3.4   B = 19   C = 1   z = 2

D and d are the diameters of shaft and journal, r the radius of the fillet. A square bar counts as a round one of its
side. The bending moment of a bearing's force turns with the shaft: M = R e, e from the shoulder to the middle of the
bearing. The fatigue notch factor and the endurance limit are those of `fatigue`.
"""

import math

from ilmek.elements.fatigue import Loading, endurance_limit, goodman, notch_factor
from ilmek.elements.sections import round_section
from ilmek.records import record

FILLET = 0.05
"""Radius of a journal's fillet over its diameter: 1 mm at 20 mm, as much as the chamfer of the inner ring leaves."""


LEAST_SAFETY = 1.2
"""Against fatigue and against yielding: DIN 743-1."""


@record
class Shoulder:
    """A journal at its shoulder; a shaft that is no thicker than the journal has no notch.

    shaft, journal   diameters D and d [m]             tensile     strength [Pa]
    moment           at the shoulder, turning [N m]    torque      largest [N m]
    alternating      whether the torque changes its sign with each turn; else it stands
    """

    shaft: float
    journal: float
    tensile: float
    moment: float
    torque: float
    alternating: bool = True

    @property
    def fillet(self) -> float:
        """Radius of the fillet [m], at most the height of the shoulder."""
        return min(FILLET * self.journal, (self.shaft - self.journal) / 2)

    @property
    def stress(self) -> float:
        """Nominal von Mises stress [Pa] of the journal."""
        return float(round_section(self.journal).equivalent_stress(self.moment, self.torque))

    @property
    def safety(self) -> float:
        """Safety against fatigue with the notch, machined, reliability 99 % [Goodman]."""
        limit = endurance_limit(self.tensile, self.journal)
        swing, mean = (self.torque, 0.0) if self.alternating else (0.0, self.torque)
        loading = Loading(self.moment, mean, torque_amplitude=swing)
        return goodman(loading, round_section(self.journal), endurance=limit, tensile=self.tensile, notch=self.notches)

    @property
    def notches(self) -> tuple[float, float]:
        """Fatigue notch factors Kf of bending and of torsion."""
        if self.fillet <= 0:
            return 1.0, 1.0
        bending, torsion = concentrations(self.shaft, self.journal, self.fillet)
        return (
            notch_factor(bending, self.fillet, self.tensile),
            notch_factor(torsion, self.fillet, self.tensile, torsion=True),
        )


def concentrations(shaft: float, journal: float, fillet: float) -> tuple[float, float]:
    """Stress concentration factors Kt of bending and of torsion; diameters and radius above 0, shaft > journal [m].

    >>> [round(factor, 2) for factor in concentrations(0.050, 0.040, 0.002)]
    [2.02, 1.51]
    """
    rounded, slender = 2 * fillet / (shaft - journal), fillet / journal
    bend = slender * (1 + 2 * slender) ** 2
    bending = 0.62 * rounded + 11.6 * bend + 0.2 * rounded**3 * journal / shaft
    torsion = 3.4 * rounded + 38.0 * bend + rounded**2 * journal / shaft
    return 1 + 1 / math.sqrt(bending), 1 + 1 / math.sqrt(torsion)
