"""What must hold after every input: exit code, messages, files, and what is in them."""

import csv
import io
import json
import re
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import sha256
from itertools import pairwise
from typing import Any

from fuzz.case import OLD, shortened
from fuzz.execution import Run
from fuzz.mutations import IMAGE, SCRIPT
from ilmek.io.output import MANIFEST
from ilmek.machines.invariants import SOURCE

CODES = (0, 2, 3)
LONGEST_MESSAGE = 2050
UNANNOUNCED = 2.0
"""Time of a run on a terminal after which something must have been shown [s of the processor]."""

MOST_MEMORY = 1_500_000_000
"""Largest growth of the memory in one run [bytes]."""

_STYLES = re.compile(r"\x1b\[[\d;?]*[A-Za-z]|\r")
_INTERNAL = re.compile(r"object at 0x|<class |Traceback|\b\w+Error\b|<built-in|np\.float64|Errno")
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_PARTIAL = re.compile(r"\.part$|\.old$|^\.~|\.tmp$")


@dataclass(frozen=True)
class Finding:
    """What does not hold: its class, a key that is the same for the same defect, and details."""

    kind: str
    key: str
    detail: str


def judged(run: Run, timing: bool = True) -> list[Finding]:
    """All findings of a run; without `timing` none of time and memory."""
    oracles = (_exit, _messages, _streams, _warnings, _inputs, _refused, _outputs, _folders, _invariants, _json_alone)
    found = [finding for oracle in oracles for finding in oracle(run)]
    return found + list(_costs(run)) if timing else found


def _exit(run: Run) -> Iterator[Finding]:
    if run.error:
        last = run.error.strip().splitlines()[-1]
        frames = re.findall(r'File ".*?([^/"]+/[^/"]+\.py)", line \d+, in (\S+)', run.error)
        own = [f"{file}:{name}" for file, name in frames if "fuzz/" not in file]
        where = [f"{file}:{name}" for path, file, name in _own_frames(run.error)] or own
        kind = last.partition(":")[0].rpartition(".")[2]
        yield Finding("traceback", f"{kind} in {where[-1] if where else ''}", run.error[-3000:])
    elif run.code not in CODES:
        yield Finding("exit code", f"{run.case.command} ends with {run.code}", run.stderr)


def _own_frames(text: str) -> list[tuple[str, str, str]]:
    return re.findall(r'File "(.*?/ilmek/)([^"]+\.py)", line \d+, in (\S+)', text)


def _messages(run: Run) -> Iterator[Finding]:
    shown = _STYLES.sub("", run.stderr) if run.case.terminal else run.stderr
    lines = [line for line in shown.splitlines() if line.strip()]
    errors = [line for line in lines if line.startswith("ilmek: ")]
    others = [line for line in lines if not line.startswith(("ilmek: ", "note: "))]
    if run.code == 2 and not run.error:
        if len(errors) != 1 or (len(lines) != 1 and not run.case.terminal):
            yield Finding("message", f"{run.case.command} prints {len(errors)} errors of {len(lines)} lines", shown)
        elif len(errors[0]) < 12 or len(errors[0]) > LONGEST_MESSAGE:
            yield Finding(
                "message", f"{run.case.command} message of {len(errors[0])} letters {errors[0][:60]}", errors[0]
            )
        if run.stdout and not run.case.terminal:
            yield Finding("message", f"{run.case.command} prints before it fails", run.stdout[:500])
    elif errors or (others and not run.case.terminal):
        yield Finding("message", f"{run.case.command} exit {run.code} with {' '.join(errors + others)[:60]}", shown)
    for line in errors:
        internal = _INTERNAL.search(line)
        if internal and internal.group() not in " ".join(run.case.arguments):
            yield Finding("message", f"{run.case.command} shows {internal.group()}", line)


def _streams(run: Run) -> Iterator[Finding]:
    for name, text in (("stdout", run.stdout), ("stderr", run.stderr)):
        plain = _STYLES.sub("", text) if run.case.terminal else text
        control = {
            one for one in plain if unicodedata.category(one) in ("Cc", "Cs") or one in "\u202a\u202b\u202d\u202e"
        }
        control -= set("\n\r") if "--csv" in run.case.arguments else set("\n")
        if control:
            letters = " ".join(f"U+{ord(one):04X}" for one in sorted(control))
            yield Finding("control characters", f"{run.case.command} {name}", f"{letters}: {plain[:2000]!r}")
    if run.raw:
        yield Finding(
            "library output", shortened(run.raw.decode(errors="replace"), 60), run.raw.decode(errors="replace")
        )


def _warnings(run: Run) -> Iterator[Finding]:
    for one in run.warnings:
        yield Finding("warning", " ".join(one.split()[:6]), one)
    for one in run.left:
        yield Finding("left behind", f"{run.case.command} {one.split()[0]}", one)


def _inputs(run: Run) -> Iterator[Finding]:
    forced = "--force" in run.case.arguments
    for name, content in run.before.items():
        gone = name not in run.after
        if not gone and run.after[name] == content:
            continue
        foreign = content == b"mine" or not name.startswith(OLD)
        if not forced or (gone and foreign):
            yield Finding("input changed", f"{run.case.command} exit {run.code} {'gone' if gone else ''}", name)
    for name in run.after:
        if any(_PARTIAL.search(part) for part in name.split("/")) and name not in run.before:
            yield Finding("left behind", f"{run.case.command} leaves a partial output", name)


def _refused(run: Run) -> Iterator[Finding]:
    new = [name for name in run.after if name not in run.before]
    if new and run.code not in (0, 3):
        yield Finding("left behind", f"{run.case.command} exit {run.code}", ", ".join(new[:5]))


def _outputs(run: Run) -> Iterator[Finding]:
    for name, content in run.after.items():
        if content is None or name in run.before or run.code not in (0, 3):
            continue
        ending = name.rpartition(".")[2].lower()
        check = _CHECKS.get(ending)
        problem = check(content) if check else ""
        if problem:
            yield Finding(f"{ending} file", f"{run.case.command} {problem[:50]}", f"{name}: {problem}")


def _folders(run: Run) -> Iterator[Finding]:
    """Every new folder has a manifest that lists what is in it."""
    for folder in [name for name, content in run.after.items() if content is None and name not in run.before]:
        inside = {name[len(folder) + 1 :]: data for name, data in run.after.items() if name.startswith(f"{folder}/")}
        if inside and all(data is None or "/" in name for name, data in inside.items()):
            continue  # made for the folder in it
        try:
            listed = json.loads(inside.pop(MANIFEST) or b"")["files"]
        except (KeyError, ValueError):
            yield Finding("folder", f"{run.case.command} writes no manifest", folder)
            continue
        found = {
            name: {"size": len(data or b""), "sha256": sha256(data or b"").hexdigest()} for name, data in inside.items()
        }
        if found != listed or not found:
            yield Finding("folder", f"{run.case.command} manifest does not agree", f"{sorted(listed)} {sorted(found)}")


def _invariants(run: Run) -> Iterator[Finding]:
    """No design breaks an invariant: that would be a failed check."""
    new = [
        content for name, content in run.after.items() if content and name not in run.before and name.endswith("json")
    ]
    for text in (run.stdout, *(content.decode(errors="replace") for content in new)):
        if SOURCE in text and text.startswith("{"):
            broken = sorted({check["name"] for check in _broken(json.loads(text))})
            yield Finding("invariant", f"{run.case.command} {broken[0]}", ", ".join(broken))
        elif SOURCE in text:
            yield Finding("invariant", f"{run.case.command} a check", text[-2000:])


def _broken(tree: Any) -> Iterator[dict[str, Any]]:
    """Failed checks of invariants anywhere in a tree."""
    if isinstance(tree, dict) and tree.get("source") == SOURCE:
        yield tree
    elif isinstance(tree, dict | list):
        for one in tree.values() if isinstance(tree, dict) else tree:
            yield from _broken(one)


def _json_alone(run: Run) -> Iterator[Finding]:
    words = run.case.arguments
    targets = [after for word, after in pairwise(words) if word == "--json"]
    others = {"--help", "-h", "--as", "--version", "-V"}
    if targets[-1:] == ["-"] and run.code in (0, 3) and run.stdout and not others & set(words):
        if run.stdout.startswith(("{", "[")):
            problem = _json_problem(run.stdout.encode())
            if problem:
                yield Finding("json", f"{run.case.command} {problem[:50]}", problem)
        else:
            yield Finding("json", f"{run.case.command} prints more than JSON", run.stdout[:500])


def _costs(run: Run) -> Iterator[Finding]:
    if run.case.terminal and run.seconds > UNANNOUNCED and run.first_shown > UNANNOUNCED:
        yield Finding("delay", f"{run.case.command} shows nothing", f"{run.seconds:.1f} s")
    if run.grown > MOST_MEMORY:
        yield Finding("memory", run.case.command, f"{run.grown / 1e9:.1f} GB more")


def _json_problem(content: bytes) -> str:
    def refuse(word: str) -> Any:
        raise ValueError(f"{word} is no JSON")

    try:
        data = json.loads(content.decode(), parse_constant=refuse)
    except (ValueError, RecursionError) as error:
        return f"JSON: {error}"
    return "" if data else "empty"


def _csv_problem(content: bytes) -> str:
    try:
        rows = list(csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), strict=True))
    except (ValueError, csv.Error) as error:
        return f"CSV: {error}"
    for row in rows:
        for cell in row:
            if cell[:1] in ("=", "+", "-", "@", "\t", "\r") and not _NUMBER.fullmatch(cell):
                return f"cell that a spreadsheet runs: {cell[:40]!r}"
            if cell.lower() in ("nan", "inf", "-inf"):
                return f"cell {cell}"
    return "" if rows else "empty"


def _markup_problem(content: bytes) -> str:
    text = content.decode(errors="replace")
    found = next((one for one in (SCRIPT, IMAGE[2:]) if one in text), "")
    if found:
        return f"markup of an input: {found}"
    return "" if text.rstrip().endswith((">", "</html>", "</svg>")) else "cut off"


_CHECKS: dict[str, Callable[[bytes], str]] = {
    "json": _json_problem,
    "csv": _csv_problem,
    "html": _markup_problem,
    "svg": _markup_problem,
}
