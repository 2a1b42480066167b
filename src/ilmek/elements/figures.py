"""Figures of elements: the deflection of a beam, the section of a tube."""

import math

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.report import Axis, Dot, Drawing, Plot, Series, Stroke
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
