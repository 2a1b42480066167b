"""The ground weave of a carpet as WIF, the file of weaving programs and of the looms that they drive.

Each knot stands on two warps, and a row of knots on two picks: the straight weft in the shed of the odd warps, the
sinuous one in that of the even warps [ilmek.carpet.ground]. So two shafts and two treadles weave it. The edges are
warps without knots; kilim ends and other flat weave are rows like all others.

Format: Weaving Information File 1.1, 1997 (Nielsen, Keates, Sinkler): sections of keys; threads and picks count from 1.
It has no place for knots.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path

from ilmek.carpet.cells import GROUND_COLOUR
from ilmek.carpet.chart import Chart
from ilmek.carpet.mounting import TENS, mounting
from ilmek.progress import SILENT, Progress
from ilmek.units import cm

_PICKS = 2
"""Picks of a row of knots, each in a shed of its own."""


def write_wif(path: Path, chart: Chart, progress: Progress = SILENT) -> None:
    """Write the ground weave of a chart to `path`. Raises OSError."""
    with path.open("w", encoding="ascii", newline="\r\n") as file:
        for name, keys in _sections(chart):
            file.write(f"[{name}]\n")
            file.writelines(f"{key}={value}\n" for key, value in keys.items())
            file.write("\n")
    progress(1.0)


def _sections(chart: Chart) -> Iterator[tuple[str, Mapping[object, object]]]:
    """The sections of the file by name, with their keys."""
    made, picks = mounting(chart), _PICKS * chart.rows
    spacing = {"Units": "centimeters"}
    sections: dict[str, Mapping[object, object]] = {
        "COLOR PALETTE": {"Form": "RGB", "Range": "0,255", "Entries": 1},
        "COLOR TABLE": {1: ",".join(map(str, GROUND_COLOUR))},
        "WEAVING": {"Rising Shed": "true", "Shafts": 2, "Treadles": 2},
        "WARP": {"Threads": made.warps, "Color": 1, **spacing, "Spacing": f"{made.pitch / cm:.6g}"},
        "WEFT": {"Threads": picks, "Color": 1, **spacing, "Spacing": f"{made.row_mark / TENS / _PICKS / cm:.6g}"},
        "TIEUP": {1: 1, 2: 2},
        "THREADING": {warp: 1 + (warp - 1) % 2 for warp in range(1, made.warps + 1)},
        "TREADLING": {pick: 1 + (pick - 1) % 2 for pick in range(1, picks + 1)},
    }
    yield "WIF", {"Version": "1.1", "Date": "April 20, 1997", "Developers": "wif@mhsoft.com", "Source Program": "ilmek"}
    yield "CONTENTS", dict.fromkeys(sections, "true")
    yield from sections.items()
