"""`make mutants`: sample mutants, show each to the tests that concern it, write those that survive."""

import argparse
import compileall
import fnmatch
import hashlib
import json
import os
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

from mutants.operators import Mutant, mutants_of, mutated
from mutants.table import TestFile, concerned, table
from mutants.worker import CAUGHT, SURVIVED, Task, load_libraries, outcomes

ROOT = Path(__file__).parents[3]
SOURCES = ROOT / "src"
ACCEPTED_LIST = Path(__file__).with_name("accepted.txt")
CHOSEN = (
    *("ilmek.linkage.*", "ilmek.plane.*", "ilmek.num.*", "ilmek.dynamics.*", "ilmek.cams.*", "ilmek.timing.*"),
    *("ilmek.carpet.*", "ilmek.weaving.*", "ilmek.synthesis.*", "ilmek.elements.*", "ilmek.loom.*", "ilmek.machines.*"),
    *("ilmek.params.*", "ilmek.report.*", "ilmek.records", "ilmek.units"),
)
"""Modules that compute: the engines and the machines."""
LEFT_OUT = ("*figures", "*.plots", "*.animation", "*.workshop", "*.data.*", "*.__main__")
"""Of these, modules whose output is looked at."""

GOAL = 0.92
ACCEPTED = "accepted"


def main() -> int:
    """Run, print a line for each survivor, and end with 1 where fewer than the goal are caught."""
    given = _arguments()
    accepted = read_accepted(ACCEPTED_LIST.read_text(encoding="utf-8"))
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    sys.dont_write_bytecode = True
    compileall.compile_dir(SOURCES, quiet=2)
    load_libraries()
    files = table(ROOT, "ilmek", given.output / "table.json", jobs=given.jobs, show=_show, stale=given.stale)
    sample = sampled(all_mutants(given.modules), given.number, given.seed)
    begin = time.monotonic()
    kept = given.output / "caught.json"
    known = set(json.loads(kept.read_text(encoding="utf-8"))) if given.again and kept.exists() else set()
    found = {mutant: CAUGHT for mutant in sample if mutant.position in known}
    found |= {mutant: ACCEPTED for mutant in sample if given.again and mutant.key in accepted}
    with tempfile.TemporaryDirectory() as cache:
        _copy_kernels(Path(cache))
        left = [mutant for mutant in sample if mutant not in found]
        tasks = ((mutant, _task(mutant, concerned(files, mutant, given.seconds))) for mutant in left)
        for mutant, outcome in outcomes(ROOT, tasks, given.jobs):
            unseen = outcome.verdict == SURVIVED
            found[mutant] = ACCEPTED if unseen and mutant.key in accepted else outcome.verdict
            _show(f"{len(found)}/{len(sample)} {found[mutant]}: {mutant.key} (line {mutant.line}) {outcome.test}")
            caught = [one.position for one, verdict in found.items() if verdict == CAUGHT]
            kept.write_text(json.dumps(caught), encoding="utf-8")
    text = report(found, accepted, given.seed, time.monotonic() - begin)
    (given.output / "survivors.md").write_text(text, encoding="utf-8")
    _show(text)
    return int(share_caught(Counter(found.values())) < GOAL)


def all_mutants(patterns: Iterable[str]) -> list[Mutant]:
    """All mutants of the modules that a pattern names and that are not left out."""
    found = []
    for path in sorted((SOURCES / "ilmek").rglob("*.py")):
        module = ".".join(path.relative_to(SOURCES).with_suffix("").parts).removesuffix(".__init__")
        wanted = any(fnmatch.fnmatch(module, pattern) for pattern in patterns)
        if wanted and not any(fnmatch.fnmatch(module, pattern) for pattern in LEFT_OUT):
            found += mutants_of(module, path.read_text(encoding="utf-8"))
    return found


def sampled(found: list[Mutant], number: int, seed: int) -> list[Mutant]:
    """So many of them, by a hash of each and the seed: an edit elsewhere leaves the others in the sample."""
    return sorted(found, key=lambda one: hashlib.sha256(f"{seed} {one.position}".encode()).hexdigest())[:number]


def read_accepted(text: str) -> dict[str, str]:
    """Accepted survivors with their reasons: a line `mutant # reason` each."""
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    return {key.strip(): reason.strip() for key, _, reason in (line.partition(" # ") for line in lines)}


def share_caught(verdicts: Mapping[str, int]) -> float:
    """The share of mutants that some test noticed, of all that are not accepted."""
    judged = sum(number for name, number in verdicts.items() if name != ACCEPTED)
    return 1 - verdicts.get(SURVIVED, 0) / max(judged, 1)


def report(found: Mapping[Mutant, str], accepted: Mapping[str, str], seed: int, seconds: float) -> str:
    """The survivors, and how many mutants met which end."""
    survivors = [mutant for mutant, verdict in found.items() if verdict in (SURVIVED, ACCEPTED)]
    rows = [
        f"| `{mutant.key}` | {mutant.line} | {accepted.get(mutant.key, '')} |"
        for mutant in sorted(survivors, key=lambda one: one.key)
    ]
    verdicts = Counter(found.values())
    counts = ", ".join(f"{number} {name}" for name, number in sorted(verdicts.items()))
    of_all = 1 - len(survivors) / max(len(found), 1)
    shares = f"{100 * share_caught(verdicts):.1f} % caught of those not accepted, {100 * of_all:.1f} % of all"
    head = f"Seed {seed}: {len(found)} mutants; {counts}; {shares}; {seconds:.0f} s."
    return "\n".join([head, "", "| survivor | line | accepted because |", "| --- | --- | --- |", *rows, ""])


def _task(mutant: Mutant, files: list[TestFile]) -> Task:
    path = SOURCES / Path(*mutant.module.split("."))
    source = path.with_suffix(".py") if path.with_suffix(".py").exists() else path / "__init__.py"
    text = source.read_text(encoding="utf-8")
    doctests = [str(source.relative_to(ROOT))] if ">>>" in text else []
    seconds = sum(file.seconds for file in files)
    return Task(
        (*doctests, *(file.path for file in files)), (mutant.module, mutated(text, mutant)), timeout=30 + 3 * seconds
    )


def _copy_kernels(cache: Path) -> None:
    """Let all kernels be kept in another folder from now on: the machine code of mutants is not for keeping."""
    usual = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "ilmek" / "kernels"
    if usual.exists():
        shutil.copytree(usual, cache / "ilmek" / "kernels")
    os.environ["XDG_CACHE_HOME"] = str(cache)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="mutants", description=__doc__)
    parser.add_argument("modules", nargs="*", default=CHOSEN, help="patterns of modules, like 'ilmek.linkage.*'")
    parser.add_argument("--number", type=int, default=320, help="mutants sampled")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="processes at a time")
    parser.add_argument("--seconds", type=float, default=30.0, help="tests of a mutant, by the time that they take")
    parser.add_argument("--stale", action="store_true", help="use the table of tests of an earlier state")
    parser.add_argument("--again", action="store_true", help="leave out what the last run caught and what is accepted")
    parser.add_argument("--output", type=Path, default=ROOT / "out" / "mutants", help="folder of table and survivors")
    return parser.parse_args()


def _show(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
