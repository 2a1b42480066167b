"""A picture fitted in one step, as the jobs do it in two."""

from ilmek.arrays import Rgb
from ilmek.carpet.fitting import Fit, FitParams, fit_prepared, prepare_picture
from ilmek.carpet.sizes import CarpetSize


def fit_picture(
    rgb: Rgb, size: CarpetSize, params: FitParams | None = None, *, grid: tuple[int, int] | None = None
) -> tuple[Rgb, Fit]:
    """The picture as the carpet shows it, and what was done to it."""
    params = params or FitParams()
    prepared, fit = prepare_picture(rgb, params, size=size)
    return fit_prepared(prepared, fit, size, params, grid=grid)
