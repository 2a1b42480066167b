"""The simulated picture of a kilim: ribs over its warps, in the colours of its wefts, with its slits and joins."""

import numpy as np
from PIL import Image

from ilmek.arrays import BoolArray, Float32
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.colour import LINEAR
from ilmek.carpet.kilim import DOVETAIL, INTERLOCK, borders, joined
from ilmek.carpet.kilim_cloth import KilimCloth
from ilmek.viz.carpet_picture import LONGEST, WHOLE, DrawnCarpet
from ilmek.viz.tufts import abrash, encoded

_LEAST = 4
"""Least pixels of a cell that its ribs are drawn with."""

_OPEN, _DEPTH = 0.25, 0.3
"""Light in an open slit, and loss of light between two warps."""


def draw_kilim(cloth: KilimCloth, *, longest: int = LONGEST, seed: int = 1) -> DrawnCarpet:
    """The whole kilim without its fringes, at most `longest` pixels along its longer side where it has fewer cells."""
    chart, rng = cloth.chart, np.random.default_rng(seed)
    scale = longest / max(chart.size.width, chart.size.length)
    across = max(_LEAST, round(scale * chart.size.width / chart.columns))
    down = max(1, round(across * chart.columns / chart.size.width * chart.size.length / chart.rows))
    shades = LINEAR[chart.colour_table[: len(chart.yarns)]].astype(np.float32)
    shades = shades[:, np.newaxis] * abrash(len(shades), chart.rows, rng)
    rows, outside = np.arange(chart.rows)[:, np.newaxis], chart.knots == NO_KNOT
    woven = shades[np.where(outside, 0, chart.knots), rows]
    light = np.repeat(np.repeat(woven, down, axis=0), across, axis=1)
    y, x = np.arange(light.shape[0])[:, np.newaxis], np.arange(light.shape[1])
    ribs = 1.0 - _DEPTH * np.cos(np.pi * (x + 0.5) * 2 / across) ** 2
    picks = 0.95 + 0.05 * np.cos(np.pi * (y * cloth.params.step / down + 2 * x / across))
    _join(light, cloth, across, down)
    shade = ribs * picks * rng.normal(1.0, 0.03, (light.shape[0], light.shape[1])).astype(np.float32)
    light = (light * shade[..., np.newaxis]).astype(np.float32)
    light[np.repeat(np.repeat(outside, down, axis=0), across, axis=1)] = 1.0
    return DrawnCarpet(Image.fromarray(encoded(light)), WHOLE)


def _join(light: Float32[np.ndarray, "height width 3"], cloth: KilimCloth, across: int, down: int) -> None:
    """Draw slits and joins on the light of the cells."""
    params, knots = cloth.params, cloth.chart.knots
    joints = np.repeat(joined(knots, params), down, axis=0)
    slits = np.repeat(borders(knots), down, axis=0) & ~joints
    wide = max(1, across // 4)
    for column in np.flatnonzero(joints.any(axis=0) | slits.any(axis=0)).tolist():
        x = (column + 1) * across
        light[slits[:, column], x - 1 : x + wide // 2] *= _OPEN
        rows: BoolArray = joints[:, column]
        if params.join == DOVETAIL:
            turn = (np.arange(len(rows)) * params.step // (2 * down)) % 2 == 0
            light[rows & turn, x - wide : x] = light[rows & turn, x : x + 1]
            light[rows & ~turn, x : x + wide] = light[rows & ~turn, x - 1 : x]
        elif params.join == INTERLOCK:
            light[rows, x - 1 : x + 1] *= 1.0 - _DEPTH
