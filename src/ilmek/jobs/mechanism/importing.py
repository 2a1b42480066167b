"""A mechanism of another program's file, written as a mechanism file."""

from pathlib import Path

from ilmek.io.imports.reading import ImportedMechanism, imported_mechanism
from ilmek.io.mechanism_file import writer_for
from ilmek.io.output import Outputs


def import_mechanism(source: Path, target: Path, *, outputs: Outputs) -> ImportedMechanism:
    """Write the mechanism of one file into another, .toml or .json.

    Raises MechanismError for a file that is damaged, of another form, or cannot be solved; OutputError.
    """
    writer = writer_for(target)
    imported = imported_mechanism(source)
    outputs.write(target, writer(imported.file.machine))
    return imported
