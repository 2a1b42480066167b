"""The picture of a carpet on the loom: as far as it is woven, with its faults marked."""

from pathlib import Path

import numpy as np

from ilmek.errors import LoomError, ParameterError
from ilmek.io.any_programme import open_any_programme
from ilmek.io.journal_folder import WOVEN, require_journal
from ilmek.io.woven_file import open_woven
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.comparison import WovenResult, compare
from ilmek.loom.twin.woven import Woven
from ilmek.progress import SILENT, Progress
from ilmek.viz.woven_picture import draw_woven


def require_png(path: Path | None) -> None:
    """Raise ParameterError unless a picture can be written into a file of that ending."""
    if path is not None and path.suffix.lower() != ".png":
        raise ParameterError(f"--picture {path} ends in {path.suffix!r}", allowed="a file .png")


def carpet_png(woven: Woven, programme: LoomProgramme, result: WovenResult, progress: Progress = SILENT) -> bytes:
    """A carpet on the loom, as a PNG file."""
    rows = np.array([woven.yarns(row) for row in range(woven.rows)])
    return draw_woven(programme.setup, rows, result, progress=progress).png


def journal_png(journal: Path, programme: Path | None = None, progress: Progress = SILENT) -> bytes:
    """The carpet of a journal as a PNG file, also while it is woven.

    programme  default: NAME.ilmek beside the journal NAME.journal
    Raises LoomError for a folder without a journal or carpet, and for another programme.
    """
    require_journal(journal)
    path = journal.with_suffix(".ilmek") if programme is None else programme
    if programme is None and not path.exists():
        raise LoomError(f"the programme of {journal} is not at {path}", do="give it with --programme")
    with (
        open_any_programme(path, progress=progress.part(0.0, 0.4)) as found,
        open_woven(journal / WOVEN, found, change=False) as woven,
    ):
        result = compare(woven, found, progress.part(0.4, 0.6))
        return carpet_png(woven, found, result, progress.part(0.6, 1.0))
