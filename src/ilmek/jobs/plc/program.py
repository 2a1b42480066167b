"""The control program of a loom for a PLC, its list of I/O, and what its host writes: the carpet and its rows."""

from dataclasses import dataclass
from pathlib import Path

from ilmek.io.any_programme import open_any_programme
from ilmek.io.output import Outputs
from ilmek.io.plc.host_data import checks_csv, recipe_csv
from ilmek.io.plc.io_list import io_rows
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.rows_table import rows_csv
from ilmek.io.plc.targets import TARGETS
from ilmek.loom.operations import LoomSetup
from ilmek.progress import SILENT, Progress

MOST_LISTED = 5_000_000
"""Largest number of knots of which rows.csv is written."""

FILES = {
    "loom.xml": "the control program as a PLCopen XML project",
    "loom.st": "the control program as structured text",
    "loom.scl": "the control program as a source of SCL",
    "io.csv": "inputs and outputs with their addresses",
    "recipe.csv": "the carpet, for the host",
    "checks.csv": "the check sum of each row, for the host",
    "rows.csv": "the knots of each row in the order of tying, for the host",
}
"""Files by name; of the first three a target has its own."""


@dataclass(frozen=True, slots=True)
class PlcResult:
    """What was written: names of the files, number of units and of signals with an address."""

    setup: LoomSetup
    files: tuple[str, ...]
    units: int
    signals: int
    notes: tuple[str, ...] = ()


def write_plc(
    file: Path, folder: Path, *, target: str = "codesys", outputs: Outputs, progress: Progress = SILENT
) -> PlcResult:
    """Write the control program for the programme of a file into a folder. target: a name of `TARGETS`.

    Raises LoomError for a file that is no programme, and for rows that are too wide for a PLC; OutputError.
    """
    outputs.expect_folder(folder, "--out")
    with open_any_programme(file, progress=progress.part(0.0, 0.3, "programme")) as programme:
        project = plc_project(programme)
        written = TARGETS[target].files(project) | {"recipe.csv": recipe_csv(programme).encode()}
        rows = {"checks.csv": checks_csv(programme), "rows.csv": rows_csv(programme, progress.part(0.3, 1.0, "rows"))}
        notes = []
        if programme.setup.knots > MOST_LISTED:
            del rows["rows.csv"]
            notes.append(f"rows.csv is left out: {programme.setup.knots:,} knots, at most {MOST_LISTED:,}")
        with outputs.folder(folder) as work:
            for name, content in written.items():
                (work / name).write_bytes(content)
            for name, lines in rows.items():
                with (work / name).open("w", encoding="utf-8") as listed:
                    listed.writelines(lines)
        signals = sum(1 for row in io_rows(project.units[-1]) if row[3])
        return PlcResult(programme.setup, (*written, *rows), len(project.units), signals, tuple(notes))
