"""Write plates, drawings and cam tables of a design as files for workshop and controller, with an index."""

import importlib
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import TypeVar

from ilmek.errors import OutputError, ParameterError, UnitError
from ilmek.io.cam_tables import FORMATS
from ilmek.io.cam_tables.format import Format
from ilmek.io.cam_tables.sampling import sample, stroke
from ilmek.io.dxf import read_dxf, write_dxf
from ilmek.io.json_file import write_json
from ilmek.io.output import Outputs, joined
from ilmek.io.schema import Table
from ilmek.jobs.drawings import write_drawings
from ilmek.jobs.machine_space import machine_file
from ilmek.jobs.workshop_papers import PAPER_KINDS, write_index, write_papers
from ilmek.part.plates import of_tree, tolerated
from ilmek.part.tree import Tree
from ilmek.plane.contours import area
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report import NO_PAPERS, CamTable, Check, Json, Papers, Plate, Report, WorkPiece, at_most
from ilmek.report.left_out import made_or_left_out
from ilmek.report.sheet import Issue
from ilmek.units import counted, deg, format_quantity, parse_quantity, parse_unit, si_unit, turn, um

_Named = TypeVar("_Named", Plate, CamTable, WorkPiece)

INDEX = "workshop.json"
UNDATED = Issue()
"""Drawings without owner, date and revision."""

AREA_ERROR = 1e-4
"""Allowed relative difference between the area of a file and that of the design."""


FINEST = {parse_unit("m").dimension: 1 * um, parse_unit("rad").dimension: 1e-3 * deg}
"""Finest default tolerance by the dimension of the slave axis [m or rad]."""

SHARE = 1e-5
"""Default tolerance as a share of the stroke; at least `FINEST`."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """Allowed deviation of a controller's motion from the exact one.

    share     of each stroke; default: `SHARE`
    quantity  for slave axes of the dimension `kind` [SI]; default: none
    kind      exponents of the dimension of `quantity`
    """

    share: float | None = None
    quantity: float | None = None
    kind: tuple[int, int, int, int] | None = None

    def of(self, table: CamTable) -> float:
        """The tolerance of a table [SI]."""
        kind = parse_unit(table.unit).dimension
        if self.quantity is not None and self.kind == kind:
            return self.quantity
        travel = stroke(table) or 1.0
        return max(SHARE * travel, FINEST.get(kind, 0.0)) if self.share is None else self.share * travel


@record
class Workshop:
    """The files that were written.

    entries   of the index, one per file: part, error, number of points
    left_out  warnings of parts whose files cannot be made      found  checks made for the papers
    """

    folder: Path
    entries: tuple[JsonObject, ...]
    left_out: tuple[str, ...] = ()
    found: tuple[Check, ...] = ()

    @property
    def files(self) -> list[str]:
        """The paths of all files, the index last."""
        written = (entry[name] for entry in self.entries for name in ("file", "remarks") if name in entry)
        return [str(self.folder / name) for name in (*written, INDEX)]

    @property
    def summary(self) -> str:
        """The numbers of files by kind, in one line."""
        kinds = [entry["kind"] for entry in self.entries]
        drawn = [f"{kinds.count(kind)} {kind.upper()}" for kind in ("dxf", "step") if kind in kinds]
        more = {
            "cam table": sum(kind in FORMATS for kind in kinds),
            "sheet": kinds.count("sheet") + kinds.count("assembly"),
            "space file": kinds.count("space"),
            "paper": len({entry["title"] for entry in self.entries if entry["kind"] in PAPER_KINDS}),
        }
        parts = ", ".join((*drawn, *(counted(number, what) for what, number in more.items() if number)))
        return f"{self.folder}: {parts}; errors in {INDEX}"

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes: why parts are left out, axes that move at master angle 0, STEP not installed."""
        return (*self.left_out, *self._moving(), *self._without_step())

    @property
    def checks(self) -> tuple[Check, ...]:
        """Whether every part has its files, and every cam table its tolerance: that of the worst, and all that miss."""
        cure = "see the notes: change the part, or order it otherwise"
        complete = at_most("parts without files", len(self.left_out), 0, "1", "plates and motions").with_cure(cure)
        tables = sorted(
            (entry for entry in self.entries if "tolerance" in entry),
            key=lambda entry: entry["error"] / entry["tolerance"],
            reverse=True,
        )
        missed = sum(not entry["kept"] for entry in tables)
        return (complete, *self.found, *(_table_check(entry) for entry in tables[: max(missed, 1)]))

    def judged(self, report: Report) -> Report:
        """A report with the checks of the files that were written for it."""
        return replace(report, checks=(*report.checks, *self.checks))

    def _moving(self) -> Iterator[str]:
        moving = sorted({entry["of"] for entry in self.entries if abs(entry.get("start_speed", 0.0)) > _STILL})
        for name in moving:
            yield f"{name} moves at master angle 0: couple it while the master stands still, or ramp in"

    def _without_step(self) -> Iterator[str]:
        kinds = {entry["kind"] for entry in self.entries}
        if "dxf" in kinds and "step" not in kinds:
            yield "no STEP files: they need the extra step, pip install 'ilmek[step]'"


_STILL = 1e-9
"""Speed below which a slave axis stands still [m/s or rad/s]."""


def read_tolerance(text: str) -> Tolerance:
    """A tolerance as written: `1um`, `0.01deg`, or a share like `0.001%`.

    Raises ParameterError unless it is a length, an angle or a share above 0.

    >>> read_tolerance("1um").quantity, read_tolerance("0.01%").share
    (1e-06, 0.0001)
    """
    for unit in ("1", "m", "rad"):
        try:
            value = parse_quantity(text, unit)
        except UnitError:
            continue
        if value <= 0 or (unit == "1" and value >= 1):
            break
        return Tolerance(share=value) if unit == "1" else Tolerance(quantity=value, kind=parse_unit(unit).dimension)
    raise ParameterError(
        f"tolerance {text!r}", allowed="a length, an angle, or a share of the stroke", do="write 1um, 0.01deg or 0.001%"
    )


def write_workshop(
    report: Report,
    folder: Path,
    tolerance: Tolerance | None = None,
    *,
    papers: Papers = NO_PAPERS,
    tree: Tree | None = None,
    outputs: Outputs | None = None,
    force: bool = False,
    issue: Issue = UNDATED,
    progress: Progress = SILENT,
) -> Workshop:
    """Write the report's plates, pieces, drawings and cam tables into a folder, with papers and an index.

    tolerance  of the cam tables; default: see `SHARE`
    tree       its parts in space, for one file of them at rest (STEP) and one in motion (GLB); default: none
    outputs    of the caller, who commits them; default: committed here
    force      replace a folder that ilmek wrote; for outputs of the caller, theirs holds
    issue      owner, date and revision on the drawings
    Raises OutputError if there is nothing to write, a plate does not enclose the area of its design, or the folder
    cannot be written; then nothing is written.
    """
    if not (report.all_plates or report.all_cam_tables or report.all_pieces):
        raise OutputError(
            f"{report.machine} has no plates and no cam tables", do="leave out --workshop; its page: --report FILE.html"
        )
    plates = _own_names([tolerated(of_tree(plate, papers.tree)) for plate in report.all_plates])
    pieces = _own_names([tolerated(of_tree(piece, papers.tree)) for piece in report.all_pieces])
    tables = _own_names(report.all_cam_tables)
    allowed = tolerance or Tolerance()
    with joined(outputs, force=force) as made, made.folder(folder) as work:
        left_out: list[str] = []
        files = [
            *_files(plates, lambda plate, name: tuple(_plate_files(plate, work, name)), work, left_out),
            *_files(pieces, lambda piece, name: tuple(_piece_files(piece, work, name)), work, left_out),
            *_files(tables, lambda table, name: tuple(_table_files(table, work, name, allowed)), work, left_out),
        ]
        cut = {name: plate for name, plate in plates.items() if (work / f"{name}.dxf").is_file()}
        drawn = progress.part(0.5, 1.0, "drawings")
        files += write_drawings(report, cut, pieces, papers.tree, work, left_out, issue, drawn)
        judged = Workshop(folder, tuple(files), tuple(left_out), papers.checks).judged(report)
        files += _in_space(tree, report, work) if tree is not None else ()
        files += write_papers(papers, judged, work, issue)
        files += write_index(judged, papers, tuple(files), work)
        write_json(work / INDEX, {"machine": report.machine, "parameters": report.parameters, "files": files})
    return Workshop(folder, tuple(files), tuple(left_out), papers.checks)


def _files(
    parts: Mapping[str, _Named],
    write: Callable[[_Named, str], tuple[dict[str, Json], ...]],
    work: Path,
    left_out: list[str],
) -> Iterator[dict[str, Json]]:
    """The entries of the files of parts by name; the files of a part that cannot be made are left out together."""
    for name, part in parts.items():
        entries = made_or_left_out(f"part {part.name!r}", partial(write, part, name), left_out)
        if entries is None:
            for path in work.glob(f"{name}.*"):
                path.unlink()
        yield from entries or ()


def _own_names(parts: Sequence[_Named]) -> dict[str, _Named]:
    """The parts by unique file names of letters, digits and hyphens."""
    named: dict[str, _Named] = {}
    for part in parts:
        plain: str = re.sub(r"[^a-z0-9]+", "-", part.name.lower()).strip("-") or "part"
        names = [plain, *(f"{plain}-{number}" for number in range(2, len(parts) + 1))]
        named[next(name for name in names if name not in named)] = part
    return named


def _plate_files(plate: Plate, work: Path, name: str) -> Iterator[JsonObject]:
    shape = write_dxf(work / f"{name}.dxf", plate)
    facts = read_dxf(work / f"{name}.dxf")
    known = area(shape.outline) if plate.area is None else plate.area
    off = abs(facts.area / known - 1)
    if facts.errors or not off <= AREA_ERROR:
        found, required = (format_quantity(value, "cm^2") for value in (facts.area, known))
        raise OutputError(
            f"plate {plate.name} cannot be drawn: its outline encloses {found}, the design requires {required}",
            do="see its checks: the profile of an undercut cam crosses itself",
        )
    common = {
        "of": plate.name,
        "title": plate.title,
        "material": plate.material,
        "thickness": plate.thickness,
        "number": plate.number,
        "area": facts.area - facts.bored,
    }
    yield {
        "file": f"{name}.dxf",
        "kind": "dxf",
        **common,
        "area_error": off,
        "error": shape.error,
        "points": facts.points,
    }
    step = _step()
    if step is not None:
        step.write_step(work / f"{name}.step", plate, shape)
        read = step.read_step_volume(work / f"{name}.step")
        exact = (known - shape.bored) * plate.thickness if plate.solid is None else plate.solid.volume
        off = abs(read / exact - 1)
        if not off <= AREA_ERROR:
            raise OutputError(f"plate {plate.name} gives no valid solid: its volume differs by {off:.2%}")
        yield {"file": f"{name}.step", "kind": "step", **common, "volume": read, "volume_error": off}


def _piece_files(piece: WorkPiece, work: Path, name: str) -> Iterator[dict[str, Json]]:
    """The STEP file of a piece that is turned, sawn or welded, its volume read back."""
    step = _step()
    if step is None:
        return
    step.write_piece(work / f"{name}.step", piece)
    read = step.read_step_volume(work / f"{name}.step")
    off = abs(read / piece.volume - 1)
    if not off <= AREA_ERROR:
        raise OutputError(f"{piece.name} gives no valid solid: its volume differs by {off:.2%}")
    yield {
        "file": f"{name}.step",
        "kind": "step",
        "of": piece.name,
        "title": piece.title,
        "size": piece.size,
        "material": piece.material,
        "number": piece.number,
        "volume": read,
        "volume_error": off,
    }


def _in_space(tree: Tree, report: Report, work: Path) -> Iterator[dict[str, Json]]:
    """The parts of a tree together: in motion as GLB, at rest as a STEP assembly where its writer is installed."""
    kinds = {"--glb": ("assembly.glb", "GLB, in motion")}
    if _step() is not None:
        kinds["--step"] = ("assembly.step", "STEP AP242")
    for option, (file, words) in kinds.items():
        content = machine_file(option, tree, report)
        (work / file).write_bytes(content.encode() if isinstance(content, str) else content)
        yield {"file": file, "kind": "space", "of": report.machine, "title": report.title, "format": words}


def _step() -> ModuleType | None:
    """The writer and reader of STEP; None unless the extra `step` is installed."""
    try:
        return importlib.import_module("ilmek.io.step")
    except ImportError:
        return None


def _table_check(entry: Table) -> Check:
    name, points = f"{entry['file']}: error of the motion", f"tolerance; {entry['points']} points"
    cure = "set a larger --tolerance, or take a controller with more points"
    return at_most(name, entry["error"], entry["tolerance"], entry["file_unit"], points).with_cure(cure)


def _table_files(table: CamTable, work: Path, name: str, tolerance: Tolerance) -> Iterator[dict[str, Json]]:
    named = replace(table, name=name)
    for kind in FORMATS.values():
        yield {"of": table.name} | _table_file(
            named, work, f"{name}.{kind.name}.{kind.suffix}", kind, tolerance.of(table)
        )


def _table_file(table: CamTable, work: Path, file: str, kind: Format, tolerance: float) -> dict[str, Json]:
    sampled = sample(table, kind.rule, tolerance)
    _write_ascii(work / file, kind.text(table, sampled))
    if kind.headless:
        _write_ascii(work / f"{file}.txt", "".join(f"{line}\n" for line in kind.remarks(table, sampled)))
    return {
        "file": file,
        "kind": kind.name,
        "title": table.title,
        "format": kind.title,
        "unit": si_unit(table.unit),
        "file_unit": table.unit,
        "points": len(sampled.nodes.angle),
        "interpolation": sampled.interpolation,
        "error": sampled.error,
        "error_at": sampled.at,
        **({"better_setting": kind.better, "better_error": sampled.better} if sampled.better is not None else {}),
        "tolerance": tolerance,
        "kept": sampled.kept,
        "offset": sampled.offset,
        "revolves": table.revolves,
        "start_speed": float(sampled.nodes.ds[0]) * turn / table.period,
        "advice": kind.advice,
        **({"remarks": f"{file}.txt"} if kind.headless else {}),
        **kind.settings(table, sampled),
    }


def _write_ascii(path: Path, text: str) -> None:
    path.write_text(text, encoding="ascii", errors="replace", newline="\n")
