"""Interference of a plate cam with its follower, near the contact or far from it.

Undercut is local: it depends on the curvature at the contact. A surface without undercut can still enter the follower
elsewhere, for example two lobes that are too close for a large roller, or a groove that crosses itself. So every pose
is compared with the whole surface.                                                         [derived here]
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.trace import CamRole, CamTrace
from ilmek.num.piecewise import Extremum
from ilmek.plane.vectors import dot

_SHARE = 1e-9
"""Depth over the prime radius that counts as rounding."""


def interference(cam: CamRole, *, both_flanks: bool = False, count: int = 720) -> Extremum | None:
    """The deepest interference of a plate cam with its follower: cam angle [rad] and depth [m]; None: no interference.

    both_flanks  check the outer flank of the groove too
    count        of poses, and of points on the surface, evenly over the turn; a depth much smaller than the distance
                 between neighbouring points may be missed
    """
    angle = np.linspace(float(cam.knots[0]), float(cam.knots[-1]), count, endpoint=False)
    trace = cam.trace(angle)
    flanks = [trace.surface, *([trace.parallel(cam.roller_radius)] if both_flanks else [])]
    depth = np.max([_depth(cam, trace, flank) for flank in flanks], axis=0)
    worst = int(np.argmax(depth))
    if depth[worst] <= _SHARE * cam.prime_radius:
        return None
    return Extremum(float(angle[worst]), float(depth[worst]))


def _depth(cam: CamRole, trace: CamTrace, flank: ComplexArray) -> FloatArray:
    """Depth [m] of the deepest point of a flank inside the roller, or behind the face, in each pose."""
    if cam.flat:
        across = dot(trace.normal[:, None], flank[None, :] - trace.pitch[:, None])
        return np.asarray(np.max(across, axis=1))
    apart = np.abs(trace.pitch[:, None] - flank[None, :])
    return np.asarray(cam.roller_radius - np.min(apart, axis=1))
