"""Where the calling of a chart stopped: a small file for each chart in the user's state folder.

The folder is `$XDG_STATE_HOME/ilmek/call` if that is an absolute path, else `~/.local/state/ilmek/call`. A chart is
known by a digest of its knots and overlay, so that a renamed or rewritten file of the same chart goes on. A state is
written whole and synced before it takes the name of the old one: a power cut or `kill -9` leaves one of both.
"""

import hashlib
import json
import os
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ilmek.carpet.chart import Chart
from ilmek.io.output import disk
from ilmek.io.regular_file import open_regular

_LARGEST = 2_000
"""Largest size of a state that is read [bytes]."""

_VERSION = 1


class CallState(NamedTuple):
    """Where a call stopped.

    row   from 1, one more than the rows of the chart where all are done      step  of the row, from 0
    by, direction  how it was called; in another manner the row is begun anew
    """

    row: int
    step: int
    by: str
    direction: str


class DamagedStateError(Exception):
    """The file of a state is damaged, or of something else."""


def chart_digest(chart: Chart) -> str:
    """A name for what is tied: knots, overlay, colours, piles, size and density. Colourways have names of their own."""
    colours = [(index, *chart.yarns[index].srgb) for index in chart.used]
    size, quality = (chart.size.width, chart.size.length), (chart.quality.across, chart.quality.along)
    kinds = chart.cells and [(kind.weave, kind.height, kind.loop) for kind in chart.cells.kinds]
    carved = () if chart.cells is None or chart.cells.carving is None else (chart.cells.carving,)
    digest = hashlib.sha256(repr((chart.rows, chart.columns, size, quality, colours, kinds, *carved)).encode())
    overlay, cells = chart.overlay, () if chart.cells is None else (chart.cells.index,)
    for array in (chart.knots, *cells, overlay.rows, overlay.columns, overlay.kinds, overlay.seconds):
        digest.update(np.ascontiguousarray(array).data)
    return digest.hexdigest()[:32]


def state_file(chart: Chart) -> Path:
    """Where the state of a chart is kept. Raises OSError where the user has no home folder."""
    given = Path(os.environ.get("XDG_STATE_HOME", ""))
    try:
        base = given if given.is_absolute() else Path.home() / ".local" / "state"
    except RuntimeError as error:
        raise OSError(str(error)) from None
    return base / "ilmek" / "call" / f"{chart_digest(chart)}.json"


def read_state(path: Path, rows: int) -> CallState | None:
    """The state in a file; None if there is none. Raises DamagedStateError, and OSError where it cannot be read.

    rows  of the chart
    """
    try:
        file, size = open_regular(path, follow=False)
    except FileNotFoundError:
        return None
    with file:
        data = file.read(_LARGEST + 1) if size <= _LARGEST else b""
    try:
        found = json.loads(data.decode("utf-8"))
        state = CallState(found["row"], found["step"], found["by"], found["direction"])
        known = isinstance(found["version"], int) and found["version"] == _VERSION
    except (ValueError, TypeError, KeyError, RecursionError) as error:
        raise DamagedStateError(str(error)) from error
    numbers = all(type(one) is int for one in state[:2]) and all(isinstance(one, str) for one in state[2:])
    if not (known and numbers and 1 <= state.row <= rows + 1 and 0 <= state.step < 1_000_000):
        raise DamagedStateError("a number out of bounds")
    return state


def write_state(path: Path, state: CallState) -> None:
    """Write a state, complete and synced. Raises OSError."""
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    for left in path.parent.glob(f".{path.stem}.*.part"):  # by a call that was killed
        with suppress(OSError):
            disk.unlink(left)
    new = path.with_name(f".{path.stem}.{os.getpid()}.part")
    text = json.dumps({"version": _VERSION, **state._asdict()})
    try:
        disk.write(new, text.encode("utf-8"))
        disk.sync(new, 0o600)
        disk.replace(new, path)
    except BaseException:
        with suppress(OSError):
            disk.unlink(new)
        raise
    disk.sync(path.parent)
