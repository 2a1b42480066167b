"""`ilmek run` itself, killed by `kill -9` and signals at random instants until the carpet is complete."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGINT, signal.SIGTERM)


@dataclass
class KilledRun:
    """A carpet: signals that met its run, the result of the last call, what was wrong."""

    kills: int = 0
    result: dict[str, object] = field(default_factory=dict)
    findings: list[str] = field(default_factory=list)


def woven_through_kills(programme: Path, journal: Path, seed: int, commit: int, *, most: float = 1.5) -> KilledRun:
    """Weave a programme, each call of which is ended at an instant up to so long [s] after its journal is locked."""
    chance = random.Random(seed)
    run = KilledRun()
    line = [sys.executable, "-m", "ilmek", "run", str(programme), "--journal", str(journal), "--speed", "1000x"]
    line += ["--commit", str(commit), "--json", "-"]
    knots = 0
    while True:
        number = chance.choice(SIGNALS)
        with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            _wait_for_lock(journal, process)
            try:
                output, errors = process.communicate(timeout=chance.uniform(0, most))
            except subprocess.TimeoutExpired:
                process.send_signal(number)
                output, errors = process.communicate()
                run.kills += 1
        if process.returncode not in (0, -9, 130, 143) or (process.returncode == 0 and errors.count("\n") > 1):
            run.findings.append(f"exit code {process.returncode}: {errors}")
            return run
        if process.returncode == 0:
            run.result = json.loads(output)
            break
        certain = _certain(journal)
        if certain < knots:
            run.findings.append(f"{knots} knots were certain, then {certain}")
        knots = certain
    if (run.result["state"], run.result["faults"], run.result["row_end_faults"]) != ("Complete", 0, 0):
        run.findings.append(str(run.result))
    return run


def _wait_for_lock(journal: Path, process: subprocess.Popen[str]) -> None:
    """Wait until a process has locked the journal, or has ended."""
    lock = journal / "lock"
    while process.poll() is None and not (lock.exists() and lock.read_text() == f"{process.pid}\n"):
        time.sleep(0.01)


def _certain(journal: Path) -> int:
    if not (journal / "journal").exists():
        return 0
    line = [sys.executable, "-m", "ilmek", "status", "--journal", str(journal), "--json", "-"]
    found = subprocess.run(line, capture_output=True, text=True, check=True, env=os.environ)
    return int(json.loads(found.stdout)["knots"])
