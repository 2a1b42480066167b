"""The warps of the shedding cams as taut yarns draped over them [`ilmek.weaving.draping`]."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.limits import PlateCam
from ilmek.cams.programme import TURN
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.phases import Shed
from ilmek.machines.shedding.warp import shed_warp
from ilmek.weaving.draping import Bridges, DrapedWarp, bridges, draped_warp

POINTS = 720
ANGLES = np.arange(POINTS) * (TURN / POINTS)
"""Cam angles of the polygon that stands for the cam [rad]."""


def bridged(cam: PlateCam) -> Bridges | None:
    """Where a yarn bridges the cam; None where the cam is convex all round."""
    return bridges(cam.surface(ANGLES))


def draped(params: SheddingParams, cam: PlateCam) -> DrapedWarp | None:
    """A warp draped over the cam; None where its holds are not known, or stand within the reach of the nose."""
    warp = shed_warp(params)
    if warp is None:
        return None
    return draped_warp(cam.surface(ANGLES), warp, cam.prime_radius - cam.roller_radius, ANGLES[::2])


def stack_torque(shed: Shed, one: DrapedWarp) -> FloatArray:
    """Torque of all draped warps [N m] at `one.angle`."""
    total = np.zeros_like(one.angle)
    for parity, later in ((shed.even, 0.0), (shed.odd, TURN / 2)):
        for number, offset in zip(parity.numbers, shed.offsets, strict=True):
            total += number * np.interp(one.angle - later - offset, one.angle, one.torque, period=TURN)
    return total


def nose_radius(cam: PlateCam) -> float:
    """Radius of curvature of the cam's surface where it stands out farthest [m]."""
    angle = np.linspace(0.0, TURN, POINTS, endpoint=False)
    at = angle[int(np.argmax(np.abs(cam.surface(angle))))]
    return 1 / float(cam.curvature(np.array(at))) - cam.roller_radius
