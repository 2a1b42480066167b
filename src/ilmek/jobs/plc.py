"""The control program of a loom for PLCs: structured text, PLCopen XML, the list of I/O, and the rows for its host."""

from dataclasses import dataclass
from pathlib import Path

from ilmek.io.any_programme import open_any_programme
from ilmek.io.output import Outputs
from ilmek.io.plc.io_list import io_csv, io_rows
from ilmek.io.plc.plcopen_xml import plcopen_xml
from ilmek.io.plc.project import plc_project
from ilmek.io.plc.rows_table import rows_csv
from ilmek.loom.operations import LoomSetup
from ilmek.progress import SILENT, Progress

MOST_LISTED = 5_000_000
"""Largest number of knots of which rows.csv is written."""

FILES = {
    "loom.xml": "the control program as a PLCopen XML project",
    "loom.st": "the same as structured text",
    "io.csv": "inputs and outputs with their addresses",
    "rows.csv": "the knots of each row in the order of tying, for the host",
}


@dataclass(frozen=True, slots=True)
class PlcResult:
    """What was written: names of the files, number of units and of signals with an address."""

    setup: LoomSetup
    files: tuple[str, ...]
    units: int
    signals: int
    notes: tuple[str, ...] = ()


def write_plc(file: Path, folder: Path, *, outputs: Outputs, progress: Progress = SILENT) -> PlcResult:
    """Write the control program for the programme of a file into a folder.

    Raises LoomError for a file that is no programme, and for rows that are too wide for a PLC; OutputError.
    """
    outputs.expect_folder(folder, "--out")
    with open_any_programme(file, progress=progress.part(0.0, 0.3, "programme")) as programme:
        project = plc_project(programme)
        program = project.units[-1]
        names, notes = list(FILES), []
        if programme.setup.knots > MOST_LISTED:
            names.remove("rows.csv")
            notes.append(f"rows.csv is left out: {programme.setup.knots:,} knots, at most {MOST_LISTED:,}")
        with outputs.folder(folder) as work:
            (work / "loom.xml").write_bytes(plcopen_xml(project))
            (work / "loom.st").write_text(project.text, encoding="utf-8")
            (work / "io.csv").write_text(io_csv(program), encoding="utf-8")
            if "rows.csv" in names:
                with (work / "rows.csv").open("w", encoding="utf-8") as listed:
                    listed.writelines(rows_csv(programme, progress.part(0.3, 1.0, "rows")))
        signals = sum(1 for row in io_rows(program) if row[3])
        return PlcResult(programme.setup, tuple(names), len(project.units), signals, tuple(notes))
