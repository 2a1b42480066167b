"""Symbols of welds, ISO 2553, system A: arrow, reference line with its dashed one, fillet or bevel, size, length.

Behind the tail stands what the part is welded to; a table has the position of each seam.
"""

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np

from ilmek.arrays import Float
from ilmek.part.part_lists import cut_length
from ilmek.part.welds import PITCH, STITCH, Weld
from ilmek.plane.contours import circle
from ilmek.report.sheet import LineKind, SheetLine
from ilmek.sentences import Sentence
from ilmek.viz.drawings.feature_note import LETTER
from ilmek.viz.drawings.joined import PIECES, span_words
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import CAPITAL, SheetPicture, millimetres
from ilmek.viz.drawings.view import DrawnView
from ilmek.viz.font import text_width

Foot = Callable[[Weld], complex]
"""Where the arrow of a weld ends in a view [mm of the paper]."""

_UPWARDS = np.exp(1j * np.deg2rad([25, 75])).tolist()
"""Directions between which the arrow line leaves what it points to."""

_SPACE = "\N{EM SPACE}"


def weld_symbols(view: DrawnView, welds: Sequence[Weld], foot: Foot) -> None:
    """The symbols of welds in a view, those of one spot and kind with one arrow."""
    spots: dict[tuple[complex, str, str, bool, bool], list[str]] = {}
    for weld in welds:
        at = foot(weld)
        spot = complex(round(at.real, 1), round(at.imag, 1)), weld.mark, seam_lengths(weld), weld.all_round, weld.bevel
        spots.setdefault(spot, []).append(weld.other.rpartition("/")[2])
    for (at, mark, length, all_round, bevel), others in sorted(spots.items(), key=lambda spot: -spot[0][0].real):
        _symbol(view, at, (mark, length), ", ".join(sorted({*others})), all_round=all_round, bevel=bevel)


def seam_lengths(weld: Weld) -> str:
    """Lengths of the seams of a weld [mm], to 0.1 mm; equal ones once: `2×54.6`; of stitches with the gap between."""
    counts = Counter(millimetres(round(length, 4)) for length in weld.lengths)
    words = " + ".join(f"{number}×{length}" if number > 1 else length for length, number in counts.items())
    return f"{words} ({millimetres(PITCH - STITCH)})" if weld.stitched else words


def _symbol(view: DrawnView, at: complex, sizes: tuple[str, str], others: str, *, all_round: bool, bevel: bool) -> None:
    size, length = sizes
    lead = f"{size}{_SPACE * 3}{length}"
    words = f"{lead}{_SPACE * 2}{others}" if others else lead
    elbow = view.leader(words, at, 0.0, kind=None, sector=(at + _UPWARDS[0], at + _UPWARDS[1]), lead=lead)
    width = text_width(lead, LETTER / CAPITAL) + 1.5
    end, fillet = elbow + width, elbow + 2.0 + text_width(size, LETTER / CAPITAL) + 1.5
    leg = np.array([LETTER * 1j, 0j, complex(LETTER, LETTER)] if bevel else [0j, LETTER * 1j, complex(LETTER, 0.0)])
    lines = [SheetLine(LineKind.WELD, fillet + leg, closed=not bevel)]
    if not all_round:
        lines.append(SheetLine(LineKind.WELD, fillet + leg.conj(), closed=not bevel))
    else:
        ring = circle(elbow, 1.2)
        lines.append(SheetLine(LineKind.WELD, ring.points, ring.bulges, closed=True))
        lines.append(SheetLine(LineKind.HIDDEN, np.array([elbow + 1.2, end]) - 1.2j))
    if others:
        lines.append(SheetLine(LineKind.WELD, end + np.array([1.8 + 1.8j, 0j, 1.8 - 1.8j])))
    view.draw(lines)


def weld_table(welds: Sequence[Weld], low: Float[np.ndarray, " 3"], pieces: int) -> SheetPicture:
    """Each weld with its position on the part: from where to where its contact is; low  least corner [m]."""
    rows = []
    for weld in welds:
        ends = [span_words(*axis) for axis in np.round(weld.box - low, 4).T.tolist()]
        seam = Sentence("sheet.weld-all-round" if weld.all_round else "sheet.weld-edges")
        other = weld.other.rpartition("/")[2] or "—"
        hot = f"{weld.preheat:.0f}"
        mark = Sentence("sheet.preheated", weld=weld.mark, temperature=hot) if weld.preheat else weld.mark
        number = f"{min(weld.pieces, pieces)}/{pieces}"
        rows.append((other, mark, weld.process, seam, seam_lengths(weld), *ends, number))
    return table(WELD_HEADER, rows, Sentence("sheet.welds"))


WELD_HEADER = (
    Sentence("sheet.weld-to"), "a, s", "ISO 4063", Sentence("sheet.seam"), Sentence("sheet.length"), "X", "Y", "Z",
    Sentence("sheet.pieces"),
)  # fmt: skip


def cut_list(cut: tuple[str, float], pieces: int) -> SheetPicture:
    """What is cut for a part: section of stock and length [mm], ends square."""
    row = ("1", str(pieces), cut[0], cut_length(cut[1]), "90° / 90°")
    return table((*PIECES, Sentence("sheet.ends")), [row], Sentence("sheet.cut-list"))
