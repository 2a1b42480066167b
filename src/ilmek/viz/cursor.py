"""The cursor of a plot: a line at a value of the abscissa, a dot on each curve, and what its script needs.

The script (`chart.js`) reads ordinates off the drawn curves, so that no data is written twice; a curve is drawn to
`thinning.TOLERANCE`, about 1/4000 of the height of a plot. Ordinates are written to 1/1000 of their range.
"""

import json
from xml.sax.saxutils import escape

import numpy as np

from ilmek.report import Plot
from ilmek.units import parse_unit, turn
from ilmek.viz.frame import Box
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import INK, PAPER, colour, in_unit, shown_unit

_MOST_WHOLE = 400
"""Largest number of samples of a curve over whole numbers (rows, heads), between which nothing is read."""


def cursor(
    plot: Plot, sheet: Sheet, box: Box, spans: tuple[tuple[float, float], tuple[float, float]], numbers: list[int]
) -> str:
    """The cursor at rest, hidden, and the data of its script.

    spans    least and greatest value of x and of y at the edges of the box, in the units of their axes
    numbers  look of each curve
    """
    (first, last), (low, high) = spans
    data = {
        **drive(plot.x.label, plot.x.unit, (first, last)),
        "start": _start(plot, first, last),
        "left": round(box.left, 2),
        "right": round(box.right, 2),
        "low": [round(sheet.height - box.low, 2), low],
        "high": [round(sheet.height - box.top, 2), high],
        "whole": int(all(len(one.x) <= _MOST_WHOLE and _whole(in_unit(one.x, plot.x.unit)) for one in plot.series)),
        "decimals": decimals(high - low),
        "measure": shown_unit(plot.y.unit),
    }
    line = f'd="M0 {sheet.height - box.top:.1f}V{sheet.height - box.low:.1f}" stroke="{INK}" stroke-width="1"'
    dots = (
        f'<circle data-dot="" r="3" fill="{colour(number)}" stroke="{PAPER}" stroke-width="1" visibility="hidden"/>'
        for number in numbers
    )
    return f'<path data-cursor="" {line} visibility="hidden"/>{"".join(dots)}{metadata(data)}'


def has_cursor(plot: Plot) -> bool:
    """Whether a plot has a curve with one ordinate for an abscissa."""
    return any(len(one.x) > 0 and bool(np.all(np.diff(one.x) >= 0)) for one in plot.series)


def drive(label: str, unit: str, ends: tuple[float, float]) -> dict[str, object]:
    """What the script needs of the quantity that figures share: its name, its unit with the factor to SI, the ends of
    this figure in the unit, a full turn in the unit (0: it is no angle), and the decimals that are written.
    """
    known = parse_unit(unit)
    whole = turn / known.factor if known.dimension == parse_unit("rad").dimension else 0.0
    return {
        "drive": label.strip(),
        "unit": shown_unit(unit),
        "factor": known.factor,
        "from": round(ends[0], 9),
        "to": round(ends[1], 9),
        "turn": round(whole, 9),
        "digits": decimals(ends[1] - ends[0]),
    }


def decimals(extent: float) -> int:
    """Decimals with which a thousandth of the extent is seen.

    >>> decimals(360.0), decimals(1.2), decimals(25000.0)
    (0, 3, 0)
    """
    return int(np.clip(3 - np.floor(np.log10(extent) + 0.5), 0, 9)) if extent > 0 else 1


def metadata(data: object) -> str:
    """Data of a figure's script as an element of the figure."""
    return f"<metadata>{escape(json.dumps(data, separators=(',', ':'), ensure_ascii=False))}</metadata>"


def _start(plot: Plot, first: float, last: float) -> float:
    """Where the cursor is at first, in the unit of the abscissa: at the first mark, or in the middle."""
    marks = in_unit(np.array([mark.x for mark in plot.marks], dtype=float), plot.x.unit)
    inside = marks[(marks >= first) & (marks <= last)]
    return round(float(inside[0]) if len(inside) else (first + last) / 2, 9)


def _whole(values: np.ndarray) -> bool:
    return bool(np.all(values == np.round(values)))
