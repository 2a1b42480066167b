"""`make kills`: kill commands at random instants, print what came of it; ends with 1 if anything was lost or false."""

import argparse
import os
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from statistics import median

from kills.case import SIGNALS, Bench, Kill, Result, bench, interrupted, killed
from kills.commands import COMMANDS, LONG, prepare

LIMIT = 0.5
"""Largest time from a signal to the end of the process [s], on a machine that does nothing else."""


def main() -> int:
    """Run, print the table, and end with 1 for a finding."""
    given = _arguments()
    begin = time.monotonic()
    if given.long:
        return long(given.number, given.seed)
    chosen = [command for command in COMMANDS if command.name in given.only] if given.only else list(COMMANDS)
    with tempfile.TemporaryDirectory() as folder, ProcessPoolExecutor(given.jobs) as pool:
        made = list(pool.map(bench, [Path(folder) / command.name for command in chosen], chosen))
        shares = shared(given.number, made)
        work = [pool.submit(series, one, share, given.seed + share) for one, share in zip(made, shares, strict=True)]
        results = [result for part in work for result in part.result()]
    found = [f"{result.kill}: {text}" for result in results for text in findings(result, given.jobs)]
    _show(table(results, given.jobs), *found, f"{len(found)} findings, {time.monotonic() - begin:.0f} s")
    return int(bool(found))


def shared(number: int, made: Sequence[Bench]) -> list[int]:
    """The numbers of kills of each command: the quicker it is, the more."""
    rates = [1 / one.seconds for one in made]
    shares = [max(1, int(number * rate / sum(rates))) for rate in rates]
    shares[rates.index(max(rates))] += number - sum(shares)
    return shares


def series(made: Bench, number: int, seed: int) -> list[Result]:
    """So many kills of one command."""
    results = []
    for index, kill in enumerate(kills(made, number, seed)):
        results.append(killed(made, kill, again=index % 8 == 0))
        if results[-1].findings:
            _show(f"{kill}: {'; '.join(results[-1].findings)}")
    return results


def long(number: int, seed: int) -> int:
    """Interrupt the long commands, and print how long they take to end."""
    chance, found = random.Random(seed), 0
    with tempfile.TemporaryDirectory() as folder:
        prepare(Path(folder) / "long", large=True)
        for command in LONG:
            kills = [Kill(command, SIGNALS[1], chance.uniform(0.3, 20.0)) for _ in range(number // len(LONG))]
            results = [interrupted(Path(folder) / "long", kill) for kill in kills]
            met = [one for one in results if not one.ended]
            wrong = [one for one in met if one.delay > LIMIT or one.status != 130]
            _show(" ".join(command.line(1)), f"    {len(met)} met: {', '.join(f'{one.delay:.2f}' for one in met)} s")
            _show(*(f"    {one.kill}: {one.delay:.2f} s, {one.status}, {one.errors[-300:]!r}" for one in wrong))
            found += len(wrong)
    return int(bool(found))


def kills(made: Bench, number: int, seed: int) -> Iterator[Kill]:
    """Kills in turn by all signals: half of them in a call of the write protocol, the others at any time."""
    chance = random.Random(seed)
    for index in range(number):
        at = chance.randint(1, made.calls) if index // len(SIGNALS) % 2 else chance.uniform(0, made.seconds)
        yield Kill(made.command, SIGNALS[index % len(SIGNALS)], at, after=chance.random() < 0.5)


def findings(result: Result, jobs: int) -> list[str]:
    """What is wrong, with a late answer if the machine did nothing else."""
    late = result.delay > LIMIT and not result.ended and os.getloadavg()[0] < jobs + 1
    return [*result.findings, *([f"ended {result.delay:.2f} s after the signal"] if late else [])]


def table(results: Sequence[Result], jobs: int) -> str:
    """A line for each command and one for each signal."""
    heads = ("", "kills", "ended", "old", "new", "both", "left", "median", "p95", "most", "found")
    lines = ["".join(f"{head:>9}" if head else " " * 12 for head in heads)]
    names = {name: [one for one in results if one.kill.command.name == name] for name in _names(results)}
    signals = {number.name: [one for one in results if one.kill.signal == number] for number in SIGNALS}
    for name, part in {**names, **signals, "all": list(results)}.items():
        if not part:
            continue
        outcomes = Counter(one.outcome for one in part)
        delays = sorted(one.delay for one in part if not one.ended) or [0.0]
        shown = (median(delays), delays[int(0.95 * len(delays))], delays[-1])
        cells: list[object] = [len(part), sum(one.ended for one in part), *map(outcomes.get, ("old", "new", "both"))]
        cells += [sum(one.left for one in part), *(f"{1e3 * delay:.0f} ms" for delay in shown)]
        cells += [sum(bool(findings(one, jobs)) for one in part)]
        lines.append(f"{name:12}" + "".join(f"{cell or 0:>9}" for cell in cells))
    return "\n".join(lines)


def _names(results: Sequence[Result]) -> list[str]:
    return list(dict.fromkeys(one.kill.command.name for one in results))


def _show(*lines: str) -> None:
    sys.stdout.write("\n".join(lines) + "\n")
    sys.stdout.flush()


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m kills", description=__doc__)
    parser.add_argument("--number", type=int, default=500, help="kills; default: 500")
    parser.add_argument("--jobs", type=int, default=2, help="processes; default: 2")
    parser.add_argument("--seed", type=int, default=1, help="of the instants; default: 1")
    parser.add_argument("--only", nargs="*", choices=[command.name for command in COMMANDS], help="these commands")
    parser.add_argument("--long", action="store_true", help="interrupt long commands instead, and measure the delays")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
