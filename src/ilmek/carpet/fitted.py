"""From a prepared picture to the design: a drawing is taken before the fit changes it, else it is fitted and read."""

from collections.abc import Callable
from dataclasses import replace

from ilmek.arrays import Rgb
from ilmek.carpet.design import knot_grid
from ilmek.carpet.fitting import Fit, FitParams, fit_prepared
from ilmek.carpet.flat import Flatness, looks_flat
from ilmek.carpet.projection import MadeRgb
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import Design, ReadParams, exact_design, read_design
from ilmek.carpet.size_of_picture import size_of_picture, unrounded_size
from ilmek.carpet.sizes import CarpetSize
from ilmek.progress import SILENT, Progress


def shaped_size(prepared: Rgb, quality: Quality, fitting: FitParams) -> CarpetSize:
    """The size of a carpet in the shape of a prepared picture, of which the fit may give one side."""
    height, width = prepared.shape[:2]
    return size_of_picture(width / height, quality, width=fitting.width, length=fitting.length)


def unfitted_design(
    prepared: Rgb,
    size: CarpetSize | None,
    quality: Quality | None,
    *,
    fitting: FitParams,
    reading: ReadParams,
    drawn: bool = False,
    progress: Progress = SILENT,
) -> tuple[Design, CarpetSize, Quality] | None:
    """As `reading.exact_design`, of a picture that is not fitted yet.

    A fit that is given may still make the grid of the knots, so an exact reading is not required before it. Where the
    fit gives one side of the carpet, the other has the proportions of the pixels.
    """
    if reading.reading == "exact" and fitting.fit != FitParams().fit:
        reading = replace(reading, reading="auto")
    if size is None and (fitting.width is not None or fitting.length is not None):
        height, width = prepared.shape[:2]
        size = unrounded_size(width / height, width=fitting.width, length=fitting.length)
    return exact_design(prepared, size, quality, reading, drawn=drawn, progress=progress)


def fitted_design(
    prepared: Rgb,
    fit: Fit,
    size: CarpetSize,
    quality: Quality,
    *,
    fitting: FitParams,
    reading: ReadParams,
    grid: tuple[int, int] | None = None,
    look: Callable[[Rgb], Flatness] = looks_flat,
    progress: Progress = SILENT,
) -> tuple[Design, MadeRgb, Fit]:
    """The design of a prepared picture, the picture as it is fitted, and all that was done to it.

    fit   what was done to it before      grid  rows and columns of knots; default: those of size and quality
    look  tells whether the picture is a drawing
    Raises CarpetError where the reading is to be exact and the fitted pixels are not the knots.
    """
    grid = grid or knot_grid(size, quality)
    fitted, fit = fit_prepared(prepared, fit, size, fitting, progress.part(0.0, 0.1), grid=grid)
    exact = exact_design(fitted, size, quality, reading, progress=progress.part(0.1, 0.3))
    if exact is not None:
        return exact[0], fitted, fit
    return read_design(fitted, grid, reading, progress.part(0.3, 1.0), judged=prepared, look=look), fitted, fit
