"""`make campaigns`: much random input for every law, other input for each seed; ends with 1 for a finding.

    python -m campaigns                          all parts, whole: hours
    python -m campaigns --share --seed 7         what continuous integration runs: a share of some parts, five minutes
    python -m campaigns kills cuts --seed 7      these parts, whole

The seed of a share is the number of the commit, so that the parts and their cases rotate; a line states it.
"""

import argparse
import ast
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from engine_paths import CHECKED, engine_paths
from processes import python, start
from sources import tree_of

ROOT = Path(__file__).parents[2]
SHARES = 6
"""Parts of the files of a campaign by pytest: a share has one of them."""

AT_ONCE = 2
"""Parts of a share."""

NO_FINDING = "no finding"
SHARE_LIMIT = 12 * 60.0
"""Longest time of a part of a share [s]: a law that hangs is a finding, not the end of continuous integration."""

PYTEST = ("-m", "pytest", "-n", "2", "--dist", "worksteal", "-o", "faulthandler_timeout=300")


@dataclass(frozen=True)
class Run:
    """A command of a part: arguments of Python, and changes of the environment."""

    arguments: Sequence[str]
    changes: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Part:
    """A campaign: what it does, its run by seed and whether a share is wanted; whole: it has no share."""

    name: str
    title: str
    run: Callable[[int, bool], Run]
    whole: bool = False


def rotated(paths: Sequence[str], seed: int, share: bool) -> list[str]:
    """All paths, or a share of them by the seed; a seed and the next ones have them all."""
    return list(paths[seed % SHARES :: SHARES] if share else paths)


def _laws(seed: int, share: bool) -> Run:
    paths = rotated([str(path.relative_to(ROOT)) for path in lawful(ROOT / "tests")], seed, share)
    return Run((*PYTEST, f"--hypothesis-seed={seed}", *paths), {"ILMEK_CAMPAIGN": str(seed)})


@cache
def lawful(tests: Path) -> tuple[Path, ...]:
    """The test files that try more in a campaign: by hypothesis, `effort`, or marks that leave cases out."""
    lawful_files = []
    for path in sorted(tests.glob("*/test_*.py")):
        if path.parent.name == "browser":
            continue
        nodes = [node for node in ast.walk(tree_of(path)) if isinstance(node, ast.ImportFrom) and node.module]
        marks = {node.attr for node in ast.walk(tree_of(path)) if isinstance(node, ast.Attribute)}
        if marks & {"matrix", "one_in"} or {node.module for node in nodes} & {"hypothesis", "effort"}:
            lawful_files.append(path)
    return tuple(lawful_files)


def _shapes(seed: int, share: bool) -> Run:
    paths = rotated(list(engine_paths()), seed, share)
    return Run((*PYTEST, *CHECKED, *paths))


def _browser(seed: int, share: bool) -> Run:
    paths = rotated(
        [str(path.relative_to(ROOT)) for path in sorted((ROOT / "tests/browser").glob("test_*.py"))], seed, share
    )
    monkey = {"ILMEK_MONKEY": "120" if share else "1800", "ILMEK_MONKEY_SEED": str(seed)}
    return Run(("-m", "pytest", "-n", "2", "--dist", "loadfile", *paths), {"ILMEK_CAMPAIGN": str(seed), **monkey})


def _fuzz(seed: int, share: bool) -> Run:
    first = ("--seed", str(100_000 * seed))
    return Run(("-m", "fuzz", *first, *(("--seconds", "90") if share else ())))


def _numbered(module: str, share_of_it: Sequence[str]) -> Callable[[int, bool], Run]:
    def run(seed: int, share: bool) -> Run:
        return Run(("-m", module, "--seed", str(seed), *(share_of_it if share else ())))

    return run


PARTS = (
    Part(
        "laws", "properties, random linkages, designs, power cuts, exact syntheses, knots: other and more cases", _laws
    ),
    Part("fuzz", "hostile input for every command", _fuzz),
    Part("kills", "signals at random instants of real commands", _numbered("kills", ("--number", "60"))),
    Part("shapes", "the engine's tests with the shapes of all arrays checked", _shapes),
    Part("browser", "every view in every state, and random input on the studio's pages", _browser),
    Part(
        "cuts",
        "power cuts and kills while carpets are woven",
        _numbered("loom_cuts", ("--carpets", "2", "--runs", "1")),
    ),
    Part("sheets", "photographed sheets of squared paper", _numbered("sheet_readings", ()), whole=True),
    Part("weights", "masses of 200 looms and machines, measured on meshes", _numbered("made_parts", ()), whole=True),
    Part("looms", "every loom of a table of choices: the least was chosen", _numbered("every_loom", ()), whole=True),
    Part(
        "faults",
        "faults planted in a loom, found by its own measure and by a judge of its file",
        _numbered("planted_faults", ()),
        whole=True,
    ),
    Part(
        "briefs",
        "what an agent asks of `ilmek mcp` for briefs of a designer's day",
        _numbered("briefs", ()),
        whole=True,
    ),
    Part("mutants", "small wrong changes of the sources that a test must notice", _numbered("mutants", ()), whole=True),
)


def chosen(names: Sequence[str], seed: int, share: bool) -> list[Part]:
    """The parts that are named; else those of a share, by the seed, or all."""
    if names:
        return [part for part in PARTS if part.name in names]
    if not share:
        return list(PARTS)
    able = [part for part in PARTS if not part.whole]
    return [able[(AT_ONCE * seed + index) % len(able)] for index in range(AT_ONCE)]


def seed_of_the_commit() -> int:
    """The number of the commit; where the history is not there, a number from its name, or the day."""

    def git(*words: str) -> str:
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()

    if git("rev-parse", "--is-shallow-repository") == "false":
        return int(git("rev-list", "--count", "HEAD"))
    name = git("rev-parse", "HEAD")
    return int(name, 16) % 10_000 if name else datetime.now(UTC).toordinal() % 10_000


def main() -> int:
    """Run the parts of the command line, one after the other."""
    parser = argparse.ArgumentParser(
        prog="python -m campaigns", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument(
        "parts", nargs="*", metavar="PART", help="\n".join(f"{part.name:8} {part.title}" for part in PARTS)
    )
    parser.add_argument("--seed", type=int, help="of the cases; default: the number of the commit")
    parser.add_argument("--share", action="store_true", help="a share of some minutes")
    given = parser.parse_args()
    if unknown := set(given.parts) - {part.name for part in PARTS}:
        parser.error(f"no part {', '.join(sorted(unknown))}; parts: {', '.join(part.name for part in PARTS)}")
    seed = seed_of_the_commit() if given.seed is None else given.seed
    failed = []
    for part in chosen(given.parts, seed, given.share):
        begin, run = time.monotonic(), part.run(seed, given.share)
        _show(f"{part.name}, seed {seed}: {part.title}")
        outcome = _outcome(run, SHARE_LIMIT if given.share else None)
        _show(f"{part.name}: {outcome}, {time.monotonic() - begin:.0f} s")
        if outcome != NO_FINDING:
            failed.append(part.name)
    if failed:
        share = " SHARE=1" if given.share else ""
        _show(f'to repeat: make campaigns PARTS="{" ".join(failed)}" SEED={seed}{share}')
    return int(bool(failed))


def _outcome(run: Run, limit: float | None) -> str:
    """How a run ended; after the limit it is killed with all that it has started."""
    with start(python(*run.arguments), changes=run.changes, cwd=ROOT, stdout=None, stderr=None) as process:
        try:
            return "FAILED" if process.wait(limit) else NO_FINDING
        except subprocess.TimeoutExpired:
            return "NOT ENDED in its time"


def _show(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
