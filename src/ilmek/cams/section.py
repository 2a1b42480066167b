"""Area, centroid and polar moment of a plate cam's face, exact, by integrals along its contour (Green).

With the contact point K, its outward normal n and the speed f of the contact along the surface,
K x dK = -(K . n) f dtheta:

    A = 1/2 int (K . n) f,   A c = 1/3 int K (K . n) f,   I = 1/4 int |K|^2 (K . n) f

I is the second moment of area about the cam's axis; times thickness and density it is the moment of inertia. The
centroid gives the imbalance of the cam. [derived from Green's theorem]
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.trace import CamRole, CamTrace
from ilmek.num.piecewise import integral
from ilmek.plane.vectors import dot


class CamSection(NamedTuple):
    """Area [m^2], centroid in the cam's frame [m] and polar moment about the axis [m^4] of a plate cam's face."""

    area: float
    centre: complex
    polar_moment: float


def section(cam: CamRole) -> CamSection:
    """Area [m²], centroid [m] and polar moment [m⁴] of a plate cam's face.

    The bore is not subtracted, undercut is not considered.

    >>> from ilmek.cams.plate import PlateCam
    >>> from ilmek.cams.programme import TURN, CamProgramme, dwell
    >>> disc = section(PlateCam(CamProgramme((dwell(TURN),)), 0.03, roller_radius=0.01))
    >>> round(disc.polar_moment / disc.area / 0.02**2, 12)
    0.5
    """

    def summed(weight: Callable[[CamTrace], FloatArray]) -> float:
        def density(angle: FloatArray) -> FloatArray:
            trace = cam.trace(angle)
            return np.asarray(weight(trace) * trace.sector)

        return integral(density, cam.knots)

    area = summed(lambda trace: np.full(trace.flow.shape, 0.5))
    x, y = summed(lambda trace: trace.surface.real / 3), summed(lambda trace: trace.surface.imag / 3)
    moment = summed(lambda trace: np.asarray(dot(trace.surface, trace.surface) / 4))
    return CamSection(area, complex(x, y) / area, moment)
