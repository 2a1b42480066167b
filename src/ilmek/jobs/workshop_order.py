"""An order of workshop files, without the libraries that write them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ilmek.io.output import Outputs

if TYPE_CHECKING:
    from ilmek.jobs.workshop import Workshop


@dataclass(frozen=True, slots=True)
class WorkshopOrder:
    """A folder for the workshop files of a design: drawings (PDF, DXF), plates (DXF, STEP) and cam tables.

    tolerance  of the cam tables, like `1um` or `0.01%` of the stroke; default: see `jobs.workshop.SHARE`
    """

    folder: Path
    tolerance: str | None = None


def workshop_writer(order: WorkshopOrder | None, outputs: Outputs) -> "Callable[..., Workshop] | None":
    """Writes the workshop files of a report; None where none are ordered. Their libraries are imported only here.

    Raises OutputError for a folder that cannot be written, ParameterError for a tolerance that cannot be read.
    """
    if order is None:
        return None
    outputs.expect_folder(order.folder, "--workshop")
    from ilmek.jobs.workshop import Tolerance, read_tolerance, write_workshop

    tolerance = Tolerance() if order.tolerance is None else read_tolerance(order.tolerance)
    return partial(write_workshop, folder=order.folder, outputs=outputs, tolerance=tolerance)
