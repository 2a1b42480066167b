"""`make fuzz`: run inputs, print a table, write a reduced case for each finding; ends with 1 if there is any."""

import argparse
import os
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from kept import kept

from fuzz.case import read_case, shortened
from fuzz.corpus import ROOT, make_corpus
from fuzz.inputs import make_case, usual_cases
from fuzz.pool import HANG, Limits, Outcome, Task, outcomes
from fuzz.reduction import reduced

CASES = ROOT / "tests" / "fuzz_cases"


def main() -> int:
    """Run the inputs given on the command line."""
    given = _arguments()
    for name in ("ILMEK_BOUNDS_CHECK", "ILMEK_LEAVE_NOTHING_OUT"):
        os.environ.setdefault(name, "1")
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    limits = Limits(hang=given.hang)
    tasks: Sequence[Task] = given.only or range(given.seed, given.seed + given.number)
    if given.cases:
        tasks = [read_case(path.read_text(encoding="utf-8")) for path in given.cases]
    elif not given.only:
        _warm_up(given.jobs)
    began, found = time.monotonic(), list[Outcome]()
    by_key: dict[tuple[str, str], list[Outcome]] = defaultdict(list)
    for outcome in outcomes(tasks, given.jobs, limits, began + given.seconds):
        found.append(outcome)
        for finding in outcome.findings:
            seen = by_key[finding.kind, finding.key]
            seen.append(outcome)
            if len(seen) == 1:
                _show(f"{outcome.name} {finding.kind}: {finding.key}")
        if len(found) % 1000 == 0:
            _show(f"{len(found)} inputs, {time.monotonic() - began:.0f} s")
    _show(_table(found, time.monotonic() - began))
    given.output.mkdir(parents=True, exist_ok=True)
    for (kind, key), seen in sorted(by_key.items()):
        _show(f"\n{kind}: {key} ({len(seen)} inputs: {', '.join(one.name for one in seen[:5])})")
        _write_case(given.output, (kind, key), seen[0], None if given.whole else limits)
    return int(bool(by_key))


def _warm_up(jobs: int) -> None:
    """Run what is right once, so that the kernels are compiled; complain where that fails."""
    _show("compiling the kernels with checked indices (about two minutes, once)")
    for outcome in outcomes(usual_cases(kept(make_corpus)), jobs, Limits(hang=600.0, timing=False)):
        if outcome.code not in (0, 3):  # 3: a check of the design fails
            _show(f"an input that is right ends with {outcome.code}: {outcome.task}")


def _write_case(folder: Path, key: tuple[str, str], outcome: Outcome, limits: Limits | None) -> None:
    """Show a finding's detail and write its case, reduced if there are limits."""
    case = outcome.case
    if key[0] == "harness":
        _show(outcome.findings[0].detail)
        return
    if case is None:  # the process died with it
        case = make_case(kept(make_corpus), outcome.task) if isinstance(outcome.task, int) else outcome.task
    if limits:
        case = reduced(case, key[1], limits)
    name = f"{key[0]}-{case.command}-{sha256(key[1].encode()).hexdigest()[:8]}".replace(" ", "-")
    path = folder / f"{name}.json"
    path.write_text(case.as_json(), encoding="utf-8")
    detail = next((one.detail for one in outcome.findings if one.key == key[1]), "")
    _show("\n".join((f"  {case.line}", *(f"    {shortened(one)}" for one in detail.splitlines()[-12:]), f"  {path}")))


def _table(found: list[Outcome], seconds: float) -> str:
    """Inputs by command with their exit codes, and what was slowest and largest."""
    codes: dict[str, Counter[str]] = defaultdict(Counter)
    spent: dict[str, float] = defaultdict(float)
    for one in found:
        codes[one.command][str(one.code)] += 1
        spent[one.command] += one.seconds
    lines = [f"{'command':<12}{'inputs':>8}{'exit 0':>8}{'exit 2':>8}{'exit 3':>8}{'other':>8}{'s':>8}"]
    for name, counted in sorted(codes.items()):
        rest = counted.total() - counted["0"] - counted["2"] - counted["3"]
        shares = "".join(f"{counted[code]:>8}" for code in ("0", "2", "3"))
        lines.append(f"{name:<12}{counted.total():>8}{shares}{rest:>8}{spent[name]:>8.0f}")
    slow = sorted(found, key=lambda one: -one.seconds)[:8]
    lines.append("slowest: " + ", ".join(f"{one.name} {one.command} {one.seconds:.1f} s" for one in slow))
    memory = max((one.memory for one in found), default=0)
    number = sum(bool(one.findings) for one in found)
    lines.append(f"{len(found)} inputs in {seconds:.0f} s, at most {memory / 1e6:.0f} MB, {number} with findings")
    return "\n".join(lines)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__)
    parser.add_argument("cases", nargs="*", type=Path, help="cases to run; default: inputs by number")
    parser.add_argument("--number", type=int, default=20_000, help="inputs")
    parser.add_argument("--seed", type=int, default=0, help="number of the first input")
    parser.add_argument("--only", type=int, action="append", help="only the input of this number; may be repeated")
    parser.add_argument("--jobs", type=int, default=2, help="processes at a time")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no input after this time")
    parser.add_argument("--hang", type=float, default=HANG, help="processor time that counts as a hang")
    parser.add_argument("--whole", action="store_true", help="do not reduce cases")
    parser.add_argument("--output", type=Path, default=ROOT / "out" / "fuzz", help="folder of reduced cases")
    return parser.parse_args()


def _show(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
