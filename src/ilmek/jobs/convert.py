"""A programme from its file to its text, and back."""

from pathlib import Path

from ilmek.io.any_programme import open_any_programme, require_form, write_any_programme
from ilmek.io.output import Outputs
from ilmek.loom.operations import LoomSetup
from ilmek.progress import SILENT, Progress


def convert_programme(source: Path, target: Path, *, outputs: Outputs, progress: Progress = SILENT) -> LoomSetup:
    """Write the programme of one file into another, in the form of its ending: .ilmek or .txt.

    Raises ParameterError for another ending, LoomError for a file that is no programme, OutputError as `Outputs.file`.
    """
    require_form(target)
    with open_any_programme(source, progress=progress.part(0.0, 0.5, "reading")) as programme:
        with outputs.file(target) as new:
            write_any_programme(new, target.suffix, programme, progress=progress.part(0.5, 1.0, "writing"))
        return programme.setup
