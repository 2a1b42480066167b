"""Makes a case smaller while it still shows the same finding."""

import time
from collections.abc import Callable, Iterator
from dataclasses import replace

from fuzz.case import Case
from fuzz.pool import Limits, Worker

LONGEST = 60.0
"""Time for one case [s]."""


def reduced(case: Case, key: str, limits: Limits) -> Case:
    """The smallest case found that shows a finding of this key."""
    until = time.monotonic() + LONGEST
    worker = Worker(limits)

    def shows(smaller: Case) -> bool:
        nonlocal worker
        worker.give(smaller)
        while (outcome := worker.taken()) is None:
            worker.pipe.poll(0.2)
        if worker.task is not None:
            worker.end()
            worker = Worker(limits)
        return any(finding.key == key for finding in outcome.findings)

    try:
        if not shows(case):
            return case
        progress = True
        while progress and time.monotonic() < until:
            progress = False
            for smaller in _smaller(case):
                if time.monotonic() > until:
                    break
                if smaller != case and shows(smaller):
                    case, progress = smaller, True
                    break
        return case
    finally:
        worker.end()


def _smaller(case: Case) -> Iterator[Case]:
    """Cases with less of one thing."""
    if case.terminal:
        yield replace(case, terminal=False)
    if case.environment:
        yield replace(case, environment={})
    for name in case.files:
        yield replace(case, files={other: content for other, content in case.files.items() if other != name})
    words = case.arguments
    for count in (2, 1):
        for at in range(1, len(words) - count + 1):
            yield replace(case, arguments=(*words[:at], *words[at + count :]))
    for name, content in case.files.items():
        pieces: Callable[[bytes], list[bytes]] = lambda content: content.splitlines(keepends=True)  # noqa: E731
        for cut in (*_without(pieces(content)), *_without([content[at : at + 1] for at in range(len(content))])):
            yield replace(case, files={**case.files, name: b"".join(cut)})


def _without(pieces: list[bytes]) -> Iterator[list[bytes]]:
    """All but a part: halves first, then smaller ones; parts below a 64th only of few pieces."""
    size = len(pieces) // 2
    while size >= 1 and (size * 64 >= len(pieces) or len(pieces) < 200):
        yield from (pieces[:at] + pieces[at + size :] for at in range(0, len(pieces), size))
        size //= 2
