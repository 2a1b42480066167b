"""Barrel and end cams for the workshop: the solid with its exact flanks in space, and its development.

The flanks are those of `cams.barrel`, evaluated on cylinders of constant radius R: the depth rho along the roller at
which the contact lies on it solves rho^2 + Im(w)^2 = R^2, w the contact in the roller's plane.
"""

import math
from functools import lru_cache, partial
from typing import Literal

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray
from ilmek.cams.barrel import Barrel
from ilmek.cams.programme import TURN
from ilmek.machines.cam.design import CamDesign
from ilmek.part.flanked import Flanked
from ilmek.report import Plate, RoundSolid
from ilmek.units import format_quantity, mm

ANGLES, RADII = 181, 5
"""Points of a flank around the cam, and along the roller."""

DEVELOPED = 2881
"""Points of a flank in the development: straight pieces deviate by less than 1 um at radii below 500 mm."""

BEYOND = 1 * mm
"""How far the flank of an end cam reaches beyond its ring on both sides, and that of a groove beyond the barrel."""

LAYERS = 12
"""Radii of Gauss's quadrature of the volume; the flanks are smooth along the roller."""

STEPS_ROUND = 1440
"""Even steps round the axis for the moments."""

STEPS = 6
"""Steps of the iteration for the depth; each divides the error by 50 or more."""


def solid_plate(design: CamDesign, title: str, ends: tuple[float, float]) -> Plate:
    """The development of a barrel or end cam at its outer radius, seen from outside, with the solid.

    ends  lower and upper end of the cam along its axis [m]; of an end cam the upper one counts for nothing
    """
    cam, barrel = design.cam, design.params.led
    assert isinstance(cam, Barrel)
    outer = cam.depths[1]
    low, high = ends
    lower = developed(cam, outer, -1)
    width = TURN * outer
    corners = np.array([1j * low, width + 1j * low])
    outline: ComplexArray = np.concatenate([corners, (width + 1j * high, 1j * high) if barrel else lower[::-1]])
    marks: dict[str, ComplexArray] = {"zero": np.array([1j * low, 1j * (low + 0.1 * (high - low))])}
    depth, groove = format_quantity(design.face_width, "mm"), format_quantity(2 * cam.roller_radius, "mm")
    notes: tuple[str, ...] = (f"laid flat at the radius {format_quantity(outer, 'mm')}, seen from outside",)
    if barrel:
        marks |= {"lower flank": lower, "upper flank": developed(cam, outer, 1), "cutter path": centre_path(cam, outer)}
        notes = (*notes, f"groove {groove} wide, {depth} deep")
    else:
        notes = (*notes, f"ring {depth} wide")
    made = solid(design, (low, high))
    if made.bore is not None:
        notes = (*notes, f"bore {format_quantity(design.hub.bore, 'mm')} H7")
    area = width * (high - low) if barrel else float(_under(lower, low))
    return Plate(
        "cam",
        title,
        outline,
        design.face_width,
        design.params.material,
        marks=marks,
        area=area,
        notes=notes,
        solid=made,
    )


@lru_cache(maxsize=4)
def flanked(design: CamDesign, ends: tuple[float, float]) -> Flanked:
    """The shape of the cam; ends as of `solid_plate`."""
    cam, barrel = design.cam, design.params.led
    assert isinstance(cam, Barrel)
    (inner, outer), (low, high) = cam.depths, ends
    nodes, weights = np.polynomial.legendre.leggauss(LAYERS)
    half = 0.5 * (outer - inner)
    radii = np.concatenate([[inner], inner + half * (1 + nodes), [outer]])
    angle = np.arange(STEPS_ROUND) * (TURN / STEPS_ROUND)

    def heights(side: Literal[1, -1]) -> FloatArray:
        lines = [(developed(cam, radius, side), radius) for radius in radii.tolist()]
        return np.stack([np.interp(angle * radius, line.real, line.imag) for line, radius in lines])

    return Flanked(
        low,
        high,
        radii,
        np.concatenate([[0.0], half * weights, [0.0]]),
        heights(-1),
        heights(1) if barrel else None,
        design.hub.contour if barrel and design.hub.reach < inner else None,
    )


def solid(design: CamDesign, ends: tuple[float, float]) -> RoundSolid:
    """The cam in space."""
    cam, barrel = design.cam, design.params.led
    assert isinstance(cam, Barrel)
    (inner, outer), (low, high) = cam.depths, ends
    first, last = (inner, outer + BEYOND) if barrel else (inner - BEYOND, outer + BEYOND)
    flank = partial(_grid, cam, np.linspace(first, last, RADII))
    shape = flanked(design, ends)
    return RoundSolid(
        inner=0.0 if barrel else inner,
        outer=outer,
        low=low,
        high=high,
        lower=flank(-1),
        upper=flank(1) if barrel else None,
        bore=shape.bore,
        volume=shape.volume,
    )


def flank_on_cylinder(cam: Barrel, angle: FloatArray, radius: float, side: Literal[1, -1]) -> Float[np.ndarray, "n 3"]:
    """Points of a flank [m] at cam angles [rad] on a cylinder about the axis [m]; side as in `Barrel.flank`."""
    depth = np.full(angle.shape, radius)
    for _ in range(STEPS):
        points = cam.flank(angle, depth, side)
        beside = points[:, 0] ** 2 + points[:, 1] ** 2 - depth**2
        depth = np.sqrt(radius**2 - beside)
    return cam.flank(angle, depth, side)


def developed(cam: Barrel, radius: float, side: Literal[1, -1]) -> ComplexArray:
    """A flank on a cylinder, laid flat and seen from outside: x = R phi from 0 to 2 pi R, y along the axis [m]."""
    angle = np.linspace(0.0, TURN, DEVELOPED)
    points = flank_on_cylinder(cam, angle, radius, side)
    return _laid(np.arctan2(points[:, 1], points[:, 0]), points[:, 2], radius)


def centre_path(cam: Barrel, radius: float) -> ComplexArray:
    """The path of the roller's axis on a cylinder, laid flat in the same frame [m]."""
    angle = np.linspace(0.0, TURN, DEVELOPED)
    centre = np.asarray(cam.roller_motion(cam.programme.at(angle))[0])
    around = np.arctan2(centre.imag, np.sqrt(radius**2 - centre.imag**2)) - angle
    return _laid(around, np.broadcast_to(centre.real, angle.shape), radius)


def _laid(around: FloatArray, along: FloatArray, radius: float) -> ComplexArray:
    """A closed curve on a cylinder as a curve over 0 to 2 pi R that begins and ends at the seam."""
    phi = np.unwrap(around)[::-1]
    height = along[::-1]
    low = math.ceil(phi[0] / TURN - 1e-12) * TURN
    cut = int(np.searchsorted(phi, low))
    seam = float(np.interp(low, phi, height))
    inner = np.concatenate([phi[cut:], phi[1:cut] + TURN]) - low
    heights = np.concatenate([height[cut:], height[1:cut]])
    kept = (inner > 1e-9) & (inner < TURN - 1e-9)
    x = np.concatenate([[0.0], inner[kept], [TURN]])
    return np.asarray(radius * x + 1j * np.concatenate([[seam], heights[kept], [seam]]))


def _grid(cam: Barrel, radii: FloatArray, side: Literal[1, -1]) -> FloatArray:
    angle = np.linspace(0.0, TURN, ANGLES)
    return np.stack([flank_on_cylinder(cam, angle, float(radius), side) for radius in radii], axis=1)


def _under(line: ComplexArray, low: float) -> float:
    """Area between a line from left to right and y = low."""
    return float(np.sum(np.diff(line.real) * (0.5 * (line.imag[1:] + line.imag[:-1]) - low)))
