"""The size of a carpet whose recipe leaves it open: the picture of its field keeps its proportions."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from ilmek.arrays import Pixels
from ilmek.carpet.design import knot_grid
from ilmek.carpet.fitting import FitParams, prepare_picture
from ilmek.carpet.quality import Quality
from ilmek.carpet.recipe.layout import lay_out
from ilmek.carpet.recipe.mirror import part_grid
from ilmek.carpet.recipe.recipe import Recipe
from ilmek.carpet.size_of_picture import USUAL_SIZE, size_of_picture
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError

_MANY = 1000


def size_of_recipe(recipe: Recipe, quality: Quality, fit: FitParams, pixels: Mapping[Path, Pixels]) -> CarpetSize:
    """The size of the carpet of a recipe, of which the fit may give one side.

    pixels  of the recipe's pictures
    Without a picture in its field it has the proportions of USUAL_SIZE, and so it has where its borders do not go
    around a carpet in the shape of the picture.
    """
    usual = USUAL_SIZE.width / USUAL_SIZE.length
    if recipe.picture is None:
        return _sized(usual, quality, fit)
    prepared, _ = prepare_picture(pixels[recipe.picture], fit)
    rows, columns = part_grid(recipe.mirror, (_MANY, _MANY))
    field = prepared.shape[1] / prepared.shape[0] * (rows / columns)
    usual = usual if field <= 1 else 1 / usual
    shapes = {path: (int(rgb.shape[0]), int(rgb.shape[1])) for path, rgb in pixels.items()}
    proportions = field
    for _ in range(2):  # the borders may be in knots, which the first size turns into metres
        size = _sized(proportions, quality, fit)
        try:
            layout = lay_out(recipe, size, quality, knot_grid(size, quality), shapes)
        except CarpetError:
            return _sized(usual, quality, fit)
        margins = 2 * layout.inset[1] / quality.across, 2 * layout.inset[0] / quality.along
        proportions = _around(field, margins, size, fit)
    size = _sized(proportions, quality, fit)
    try:
        lay_out(recipe, size, quality, knot_grid(size, quality), shapes)
    except CarpetError:
        return _sized(usual, quality, fit)
    return size


def of_its_shape(fit: FitParams) -> FitParams:
    """The fit of a carpet in the shape of its picture: what is left of a difference is stretched, not cropped."""
    return replace(fit.without_sides, fit="stretch" if fit.fit == "auto" else fit.fit)


def _sized(proportions: float, quality: Quality, fit: FitParams) -> CarpetSize:
    return size_of_picture(proportions, quality, width=fit.width, length=fit.length)


def _around(field: float, margins: tuple[float, float], size: CarpetSize, fit: FitParams) -> float:
    """Proportions of the carpet of a size's area, or of a side that is given, whose field within margins has `field`.

    (w - a)/(l - b) = p,   w l = A:   p l² + (a - p b) l - A = 0
    """
    across, along = margins
    if fit.width is not None:
        return fit.width / (along + (fit.width - across) / field)
    if fit.length is not None:
        return (across + field * (fit.length - along)) / fit.length
    middle = across - field * along
    length = (-middle + math.sqrt(middle**2 + 4 * field * size.area)) / (2 * field)
    return size.area / length**2
