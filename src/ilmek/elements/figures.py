"""Figures of elements: a beam's moment and deflection, a tube's section, a pair of gears to scale."""

import math
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.elements.beam import uniform
from ilmek.elements.beam.result import BeamResult
from ilmek.elements.gear_pair import GearPair
from ilmek.elements.involute import outline
from ilmek.report import Axis, Dot, Drawing, Mark, Plot, Series, Stroke
from ilmek.units import format_quantity


def deflection_plot(load: float, length: float, modulus: float, inertia: float, limit: float) -> Plot:
    """Deflection line of a simply supported, uniformly loaded beam, drawn downwards, and its limit [m]."""
    x = np.linspace(0.0, length, 121)
    series = (
        Series("deflection", x, -uniform.deflection(x, load, length, modulus, inertia=inertia)),
        Series("limit", np.array([0.0, length]), np.full(2, -limit), dashed=True),
    )
    title = "Deflection along the width"
    return Plot("deflection", title, Axis("position between the bearings", "mm"), Axis("deflection", "mm"), series)


def tube_drawing(outer_radius: float, inner_radius: float, least_outer_radius: float) -> Drawing:
    """Section of a tube to scale, and the least outer radius for the slope alone [m]."""
    note = f"dashed: the least outer radius for the slope, {format_quantity(least_outer_radius, 'mm')}"
    circle = np.exp(1j * np.linspace(0.0, 2 * math.pi, 361))
    below = outer_radius * (np.array([-1.0, 1.0]) - 1.15j)
    strokes = (
        Stroke(outer_radius * circle, "outline", closed=True),
        Stroke(
            inner_radius * circle, "outline", f"wall {format_quantity(outer_radius - inner_radius, 'mm')}", closed=True
        ),
        Stroke(least_outer_radius * circle, "construction", closed=True),
        Stroke(below, "dimension", f"diameter {format_quantity(2 * outer_radius, 'mm')}"),
    )
    return Drawing("section", "Section of the cylinder, to scale", strokes, (Dot(0j, "", "point"),), note=note)


def beam_plots(
    bent: BeamResult, rigidity: float, planes: tuple[str, str] = ("vertical", "horizontal")
) -> tuple[Plot, Plot]:
    """Moment and deflection along a beam of rigidity E I [N m²], in each plane with loads."""
    breaks = bent.breaks
    x = np.unique(np.concatenate([np.linspace(left, right, 33) for left, right in pairwise(breaks)]))
    moment, deflection = bent.moment(x), bent.deflection(x, rigidity)
    position = Axis("position along the beam", "mm")
    most, sag = bent.moment_max, bent.deflection_max(rigidity)
    marks = (Mark(most.at, format_quantity(most.size, "Nm")),), (Mark(sag.at, format_quantity(sag.size, "mm")),)
    return (
        Plot("moment", "Bending moment", position, Axis("moment", "Nm"), _parts(x, moment, planes), marks[0]),
        Plot("deflection", "Deflection", position, Axis("deflection", "mm"), _parts(x, deflection, planes), marks[1]),
    )


def _parts(x: FloatArray, values: ComplexArray, planes: tuple[str, str]) -> tuple[Series, ...]:
    """The curves of both planes and their magnitude; one curve for one plane."""
    parts = [
        Series(name, x, part) for name, part in zip(planes, (values.real, values.imag), strict=True) if np.any(part)
    ]
    return (*parts, Series("magnitude", x, np.abs(values), dashed=True)) if len(parts) == 2 else tuple(parts)


def gear_drawing(pair: GearPair) -> Drawing:
    """Two gears in mesh, to scale: outlines, rolling circles, line of action."""
    circle = np.exp(1j * np.linspace(0.0, 2 * math.pi, 181))
    tips, rolling, distance = pair.tip_radii, pair.rolling_radii, pair.distance
    turn = math.pi / pair.second.teeth + math.pi
    strokes = [
        Stroke(outline(pair.first, tips[0]), "outline", closed=True),
        Stroke(distance + outline(pair.second, tips[1]) * np.exp(1j * turn), "outline", closed=True),
        *(
            Stroke(centre + r * circle, "construction", closed=True)
            for centre, r in zip((0.0, distance), rolling, strict=True)
        ),
    ]
    reach = 0.35 * rolling[0] * np.exp(1j * (math.pi / 2 + pair.pressure_angle))
    strokes.append(Stroke(rolling[0] + np.array([-reach, reach]), "path", "line of action"))
    note = f"contact ratio {pair.contact_ratio:.3f}; root fillets are not drawn"
    dots = (Dot(0j, "", "point"), Dot(distance + 0j, "", "point"))
    return Drawing("gears", "Gears, to scale", tuple(strokes), dots, note=note)
