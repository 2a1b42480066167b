"""The warp on the shedding cams: its force from the parameters, and the yarn draped over the cam."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN
from ilmek.machines.shedding.params import SheddingParams
from ilmek.weaving.draping import Bridges, DrapedWarp, bridges, draped_warp
from ilmek.weaving.shed import ShedWarp

LIFTED = 1e-12
"""Share of the lift up to which a warp lies on its line; below it the cam's rounding."""

ANGLES = np.arange(720) * (TURN / 720)
"""Cam angles of the polygon that stands for the cam [rad]."""


def shed_warp(params: SheddingParams) -> ShedWarp | None:
    """The warp with its tension; None where only its force across the cam is given."""
    spans, length = params.spans_of_warp, params.warp_length
    if spans is None:
        return None
    stiffness = params.cloth.carpet_yarns.warp.stiffness
    rate = 0.0 if length is None else (1 - params.compensation) * stiffness / length
    return ShedWarp(params.cloth.warp_tension, spans[0], spans[1], rate)


def warp_force(params: SheddingParams, s: FloatArray) -> FloatArray:
    """Force [N] of a warp across the cam at lifts [m]: as given, or from its tension."""
    warp = shed_warp(params)
    return np.full_like(s, params.warp_force) if warp is None else warp.force(s)


def lifting_work(params: SheddingParams) -> float:
    """Work [J] of lifting one warp: F L where its force is given, else the work of its elongation."""
    warp = shed_warp(params)
    return params.warp_force * params.lift if warp is None else warp.work(params.lift)


def bridged(cam: PlateCam) -> Bridges | None:
    """Where a yarn bridges the cam; None where the cam is convex all round."""
    return bridges(cam.surface(ANGLES))


def draped(params: SheddingParams, cam: PlateCam) -> DrapedWarp | None:
    """A warp draped over the cam; None where its holds are not known, or stand within the reach of the nose."""
    warp = shed_warp(params)
    if warp is None:
        return None
    return draped_warp(cam.surface(ANGLES), warp, cam.prime_radius - cam.roller_radius, ANGLES[::2])


def nose_radius(cam: PlateCam) -> float:
    """Radius of curvature of the cam's surface where it is farthest from the axis [m]."""
    at = ANGLES[int(np.argmax(np.abs(cam.surface(ANGLES))))]
    return 1 / float(cam.curvature(np.array(at))) - cam.roller_radius
