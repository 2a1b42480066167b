"""`make cuts`: power cuts and kills while carpets are woven, and what came of them; ends with 1 for a finding."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from small_programme import small_programme

from ilmek.io.programme_file import write_programme
from ilmek.loom.twin.comparison import chart_digest
from ilmek.loom.twin.model import NO_FAULTS
from loom_cuts.cuts import FAULTY, woven_through_cuts
from loom_cuts.processes import woven_through_kills

CASES = ((1, NO_FAULTS), (8, NO_FAULTS), (1, FAULTY), (64, FAULTY))
"""Group commit and rates of faults of the carpets, in turn."""


def main() -> int:
    """Weave, print a line for each carpet, and end with 1 for a finding."""
    parser = argparse.ArgumentParser(prog="python -m loom_cuts", description=__doc__)
    parser.add_argument("--carpets", type=int, default=8, help="carpets that power cuts meet; default: 8")
    parser.add_argument("--runs", type=int, default=4, help="carpets of `ilmek run`, which is killed; default: 4")
    parser.add_argument("--seed", type=int, default=1, help="of the instants; default: 1")
    given = parser.parse_args()
    found = [*_cuts(given.carpets, given.seed), *_kills(given.runs, given.seed)]
    _show(*found, f"{len(found)} findings")
    return int(bool(found))


def _cuts(carpets: int, seed: int) -> list[str]:
    programme = small_programme(40, 120, 3, 5, package=12.0)
    meant, findings, total = chart_digest(programme), [], 0
    for number in range(carpets):
        group, rates = CASES[number % len(CASES)]
        begin = time.monotonic()
        found = woven_through_cuts(programme, seed + number, group=group, rates=rates, mean=30.0)
        total += found.cuts
        findings += [f"carpet {seed + number}: {one}" for one in found.findings]
        if found.woven.digest != meant:
            findings.append(f"carpet {seed + number}: another digest")
        faults = "sound" if rates is NO_FAULTS else "faulty"
        _show(
            f"{seed + number}: commit {group}, {faults}: {found.cuts:,} power cuts, {found.woven.knots:,} knots, "
            f"{found.woven.missing} missing, {found.woven.double} double, {time.monotonic() - begin:.0f} s"
        )
    if carpets:
        _show(f"{total:,} power cuts in {carpets} carpets")
    return findings


def _kills(runs: int, seed: int) -> list[str]:
    findings: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        programme = Path(folder) / "carpet.ilmek"
        write_programme(programme, small_programme(40, 60, 2, 4))
        for number in range(runs):
            found = woven_through_kills(programme, Path(folder) / f"{number}", seed + number, CASES[number % 4][0])
            findings += [f"run {seed + number}: {one}" for one in found.findings]
            _show(
                f"run {seed + number}: {found.kills} signals, {found.result.get('knots', 0)} knots, "
                f"{found.result.get('faults')} faults"
            )
    return findings


def _show(*lines: str) -> None:
    sys.stdout.write("\n".join(lines) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
