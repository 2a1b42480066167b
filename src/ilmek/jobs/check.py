"""Proof of a programme from its file, with the line of each error in its text form."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from ilmek.io.any_programme import OpenProgramme, open_any_programme, row_texts
from ilmek.io.programme_file import ProgrammeFile
from ilmek.io.programme_text import ProgrammeText, header_lines
from ilmek.io.programme_text_rows import RowText
from ilmek.loom.operations import LoomSetup
from ilmek.loom.proof import MOST_FAULTS, FaultyPart, Proof, ProvedTotals, RuleFault, prove
from ilmek.progress import SILENT, Progress
from ilmek.report import Json
from ilmek.units import BILLION

_SAME = 1e-9
"""Relative difference of a sum of floating point numbers and one of whole nanoseconds."""


@dataclass(frozen=True, slots=True)
class ProgrammeError:
    """A rule that a programme breaks, and the line of its text form, from 1."""

    line: int
    what: str


@dataclass(frozen=True, slots=True)
class CheckResult:
    """A proved programme: the first MOST_FAULTS errors in the order of lines, and the number of all."""

    file: Path
    setup: LoomSetup
    digest: str
    errors: tuple[ProgrammeError, ...]
    count: int
    totals: ProvedTotals

    @property
    def ok(self) -> bool:
        """Whether no rule is broken."""
        return self.count == 0

    def as_json(self) -> dict[str, Json]:
        """The outcome, SI. Lines count from 1."""
        totals, setup = self.totals, self.setup
        return {
            "ok": self.ok,
            "knots": totals.knots,
            "errors": [{"line": error.line, "what": error.what} for error in self.errors],
            "error_count": self.count,
            "digest": self.digest,
            "loom": setup.loom,
            "rows": setup.rows,
            "columns": setup.columns,
            "heads": setup.heads,
            "totals": {
                "time": totals.time / BILLION,
                "colour_changes": totals.changes,
                "travel": totals.moved,
                "idle_travel": totals.idle,
                "stops": totals.stops,
                "bobbin_changes": totals.wefts,
                "package_changes": totals.packages,
            },
        }


def check_programme(file: Path, loom: Path | None = None, *, progress: Progress = SILENT) -> CheckResult:
    """Prove the programme of a file.

    loom  file of the loom that it must be for; default: any loom
    Raises LoomError for a file that is no programme, and for one that is no loom.
    """
    digest = None if loom is None else _digest_of(loom)
    with open_any_programme(file, lenient=True, progress=progress.part(0.0, 0.5, "reading")) as programme:
        proof = prove(programme, progress.part(0.5, 0.9, "proof"))
        errors = [*_of_the_loom(programme.setup, digest), *_of_the_totals(programme, proof)]
        errors += _of_the_rows(programme, proof.faults)
        count = proof.count + len(errors) - len(proof.faults)
        if isinstance(programme, ProgrammeText):
            known = {error.line for error in errors}
            more = [
                ProgrammeError(remark.line, remark.what) for remark in programme.remarks if remark.line not in known
            ]
            errors, count = errors + more, count + len(more)
        errors.sort(key=lambda error: error.line)
        return CheckResult(file, programme.setup, programme.digest, tuple(errors[:MOST_FAULTS]), count, proof.totals)


def _digest_of(loom: Path) -> str:
    from ilmek.jobs.existing_loom import read_existing_loom  # a loom is designed: all machines
    from ilmek.jobs.loom_setup import loom_digest

    return loom_digest(read_existing_loom(loom).design.params)


def _of_the_loom(setup: LoomSetup, digest: str | None) -> Iterator[ProgrammeError]:
    if digest is not None and digest != setup.loom:
        what = f"the programme is for the loom {setup.loom[:12]}…, the given loom is {digest[:12]}…"
        yield ProgrammeError(_header_line(setup, "loom"), what)


def _of_the_totals(programme: OpenProgramme, proof: Proof) -> Iterator[ProgrammeError]:
    """Totals that the file states, and that are not those of its operations."""
    if not isinstance(programme, ProgrammeFile):
        return
    if programme.stated_digest != programme.digest:
        digests = f"digest {programme.stated_digest[:12]}… stated, {programme.digest[:12]}… by its operations"
        yield ProgrammeError(1, f"{digests}: the file was changed")
    stated, totals, time = programme.totals, proof.totals, proof.totals.time / BILLION
    pairs = (
        ("knots", stated.knots, totals.knots),
        ("changes of tube", stated.changes, totals.changes),
        ("pitches of travel", stated.travel, totals.moved),
    )
    for name, given, found in pairs:
        if given != found:
            yield ProgrammeError(1, f"{given} {name} stated, {found} by its operations")
    if abs(stated.duration - time) > _SAME * time:
        yield ProgrammeError(1, f"weaving time {stated.duration:.9f} s stated, {time:.9f} s by its operations")


def _header_line(setup: LoomSetup, key: str) -> int:
    return next(number for number, line in enumerate(header_lines(setup), 1) if line.startswith(f"{key} "))


def _of_the_rows(programme: OpenProgramme, faults: Sequence[RuleFault]) -> list[ProgrammeError]:
    """Faults with the lines of their parts."""
    by_row = {number: list(ones) for number, ones in groupby(faults, key=lambda fault: fault.row)}
    texts = row_texts(programme, by_row)
    return [
        ProgrammeError(_line(text, fault), f"row {fault.row + 1}: {fault.what}")
        for text in texts
        for fault in by_row[text.row.number]
    ]


def _line(text: RowText, fault: RuleFault) -> int:
    if fault.part is FaultyPart.KNOT:
        return int(text.ties[np.searchsorted(text.ties[:, 0], fault.index, side="right") - 1, 1])
    if fault.part is FaultyPart.CHANGE and fault.index < len(text.changes):
        return text.changes[fault.index]
    return text.ends[fault.index] if fault.part is FaultyPart.END else text.line
