"""Does any part of a plate cam enter its follower, near the contact or far from it?

Undercut is a local matter, of the curvature where the follower touches. A surface that is regular everywhere can still
reach the follower from elsewhere: two lobes too close for a large roller, a groove that runs into itself. This looks at
every pose against the whole surface.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.trace import CamRole, CamTrace
from ilmek.num.piecewise import Extremum
from ilmek.plane.vectors import dot

_SHARE = 1e-9
"""Share of the cam's size within which a depth is rounding."""


def interference(cam: CamRole, *, both_flanks: bool = False, count: int = 720) -> Extremum | None:
    """The cam angle [rad] at which a plate cam enters its follower deepest, and how deep [m]; None where it never does.

    both_flanks  the outer flank of its groove too     count  poses, and points of the surface, evenly over the turn;
                 the depth is that at the points, so that one much smaller than the way between them may be missed
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
    """How deep [m] the deepest point of a flank lies inside the roller, or behind the face, in each pose."""
    if cam.flat:
        across = dot(trace.normal[:, None], flank[None, :] - trace.pitch[:, None])
        return np.asarray(np.max(across, axis=1))
    apart = np.abs(trace.pitch[:, None] - flank[None, :])
    return np.asarray(cam.roller_radius - np.min(apart, axis=1))
