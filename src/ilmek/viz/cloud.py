"""Designs of a study as parallel coordinates: an axis for each column, a line for each design."""

import numpy as np

from ilmek.report import DesignCloud
from ilmek.units import parse_unit
from ilmek.viz.lanes import ROW, WIDTH, draw_key, keys
from ilmek.viz.scale import span, tick_labels, ticks
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import AXIS, MUTED, SMALL, colour, tint, with_unit

HEIGHT, _SIDE, _BOTTOM, _NAMES = 190.0, 70.0, 10.0, 30.0
"""Height of the axes, margin beside them and below, room for two rows of names [pt]."""

MOST_LINES = 300
"""Largest number of designs on paper."""


def draw_cloud(cloud: DesignCloud) -> Sheet:
    """The sheet: the first kinds lie over the later ones, which are paler."""
    used = [number for number in range(len(cloud.kinds)) if (cloud.kind == number).any()]
    entries = keys([(number, cloud.kinds[number]) for number in used], _SIDE / 2)
    top = _NAMES + ROW * (1 + max((row for _, row, _ in entries), default=0))
    sheet = Sheet(WIDTH, _BOTTOM + HEIGHT + top)
    shades = [colour(number) for number in cloud.looks]
    for number, row, left in entries:
        draw_key(sheet, cloud.kinds[number], shades[number], complex(left, sheet.height - 4.0 - ROW * (row + 0.5)))
    across = np.linspace(_SIDE, WIDTH - _SIDE, len(cloud.columns))
    spans = [span(row[np.isfinite(row)]) for row in cloud.values]
    shares = np.array([(row - low) / (high - low) for row, (low, high) in zip(cloud.values, spans, strict=True)])
    points = across[:, None] + 1j * (_BOTTOM + HEIGHT * shares)
    every = max(1, -(-cloud.kind.size // MOST_LINES))
    for design in range(0, cloud.kind.size, every):
        kind = int(cloud.kind[design])
        shade = shades[kind] if kind == 0 else tint(shades[kind], 0.5)
        sheet.line(points[:, design], color=shade, linewidth=0.6 if kind else 1.1, zorder=2.0 - 0.01 * kind)
    for number, (x, axis, (low, high)) in enumerate(zip(across.tolist(), cloud.columns, spans, strict=True)):
        factor = parse_unit(axis.unit).factor
        sheet.line(x + 1j * np.array([_BOTTOM, _BOTTOM + HEIGHT]), color=AXIS, linewidth=0.8, zorder=2.5)
        shown = ticks(low / factor, high / factor, axis.unit, 5)
        for value, words in zip(shown, tick_labels(shown), strict=True):
            at = _BOTTOM + HEIGHT * (value * factor - low) / (high - low)
            sheet.text(complex(x + 3.0, at), words, fontsize=SMALL, color=MUTED, va="center_baseline")
        above = _BOTTOM + HEIGHT + 6.0 + (number % 2) * 12.0
        sheet.text(complex(x, above), with_unit(axis.label, axis.unit), fontsize=SMALL, ha="center")
    return sheet
