"""Draws docs/_static/controller-states.svg: states and transitions of the loom's controller, from its tables.

    python examples/draw_controller.py

Transitions to Stopping and Aborting, and to Holding from other states than Execute, are stated instead of drawn.
"""

from pathlib import Path

import numpy as np

from ilmek.loom.control.packml import COMPLETED, TRANSITIONS, PackCommand, PackState, state_name
from ilmek.viz.sheet import Sheet
from ilmek.viz.style import FONTS, GRID, INK, MUTED, PALETTE, PAPER, SMALL, STRONG, TEXT

OUT = Path(__file__).parents[1] / "docs" / "_static" / "controller-states.svg"
TITLE = "States of the loom's controller"

S = PackState
CELLS = {
    S.UNHOLDING: (1, 4), S.HELD: (2, 4), S.HOLDING: (3, 4),
    S.IDLE: (0, 3), S.STARTING: (1, 3), S.EXECUTE: (2, 3), S.COMPLETING: (3, 3), S.COMPLETE: (4, 3),
    S.RESETTING: (0, 2), S.UNSUSPENDING: (1, 2), S.SUSPENDED: (2, 2), S.SUSPENDING: (3, 2),
    S.STOPPED: (0, 1), S.STOPPING: (1, 1),
    S.CLEARING: (0, 0), S.ABORTED: (1, 0), S.ABORTING: (2, 0),
}  # fmt: skip
"""Column and row of each state."""

STEP_X, STEP_Y, WIDTH, HEIGHT = 128.0, 58.0, 84.0, 27.0
LEFT, BOTTOM = 64.0, 30.0
DETOUR = {(S.COMPLETE, S.RESETTING): 1.62}
"""Rows along which a transition is led between the others."""


def centre(state: PackState) -> complex:
    """Centre of a state's box [pt]."""
    column, row = CELLS[state]
    return complex(LEFT + STEP_X * column, BOTTOM + STEP_Y * row)


def border(state: PackState, towards: complex) -> complex:
    """Where the line from a state's centre leaves its box [pt]."""
    at = centre(state)
    along = towards - at
    across = min(
        0.5 * WIDTH / abs(along.real) if along.real else np.inf,
        0.5 * HEIGHT / abs(along.imag) if along.imag else np.inf,
    )
    return at + across * along


def arrow(sheet: Sheet, before: PackState, after: PackState, words: str) -> None:
    """A transition, with the command above its middle; completed actions are dashed."""
    row = DETOUR.get((before, after))
    corners = []
    if row is not None:
        level = BOTTOM + STEP_Y * row
        corners = [complex(centre(before).real, level), complex(centre(after).real + 14, level)]
        end = complex(centre(after).real + 14, centre(after).imag - 0.5 * HEIGHT)
    else:
        end = border(after, centre(before))
    start = border(before, corners[0] if corners else end)
    points = np.array([start, *corners, end])
    sheet.line(points, color=INK, linewidth=0.9, dashes=() if words else (3.2, 2.2))
    along = (points[-1] - points[-2]) / abs(points[-1] - points[-2])
    sheet.area(end + along * np.array([0, -6 + 2.4j, -6 - 2.4j]), facecolor=INK, zorder=2.5)
    if words:
        middle = (corners[0] + corners[1]) / 2 if corners else (start + end) / 2
        level = start.imag == end.imag
        if level:
            sheet.text(middle + 4j, words, fontsize=SMALL, color=PALETTE[0], ha="center")
        else:
            sheet.text(middle, words, fontsize=SMALL, color=PALETTE[0], ha="center", va="center_baseline", clear=True)


def frame(sheet: Sheet, states: tuple[PackState, ...], words: str, margin: float) -> None:
    """A frame around states, with words in its upper left corner."""
    at = np.array([centre(state) for state in states])
    low = complex(at.real.min() - WIDTH / 2 - margin, at.imag.min() - HEIGHT / 2 - margin)
    high = complex(at.real.max() + WIDTH / 2 + margin, at.imag.max() + HEIGHT / 2 + margin)
    corners = np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag), low])
    sheet.line(corners, color=MUTED, linewidth=0.7, zorder=0.5)
    sheet.text(complex(low.real + 8, high.imag - 15), words, fontsize=SMALL, color=MUTED)


def draw() -> Sheet:
    """The diagram."""
    sheet = Sheet(LEFT + 4 * STEP_X + 66, BOTTOM + 4 * STEP_Y + 34)
    running = tuple(state for state, (_, row) in CELLS.items() if row >= 2)
    frame(sheet, running, "Stop: from all of these", 15)
    for state in CELLS:
        at = centre(state)
        box = at + np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j]).real * WIDTH / 2
        box = box + 1j * np.array([-1, -1, 1, 1]) * HEIGHT / 2
        acts = state in COMPLETED
        sheet.area(box, facecolor=GRID if acts else PAPER, edgecolor=INK, linewidth=1.4 if state is S.EXECUTE else 0.8)
        name = f"{state_name(state)}  {state.value}"
        sheet.text(at, name, fontsize=STRONG, ha="center", va="center_baseline", bold=state is S.EXECUTE)
    for (before, command), after in TRANSITIONS.items():
        everywhere = command in {PackCommand.STOP, PackCommand.ABORT}
        if not everywhere and not (command is PackCommand.HOLD and before is not S.EXECUTE):
            arrow(sheet, before, after, command.name.capitalize() if command is not PackCommand.COMPLETE else "")
    for before, after in COMPLETED.items():
        if (before, after) != (S.EXECUTE, S.COMPLETING):
            arrow(sheet, before, after, "")
    note = complex(LEFT + 2.1 * STEP_X, BOTTOM + STEP_Y)
    for line, words in enumerate((
        "grey: acts, and goes on when its action is complete (dashed)",
        "white: waits for a command",
        "Execute completes when the carpet is woven, or by Complete",
        "Hold: also from Starting, Unholding and the three of suspension",
        "Abort: from every state but Aborting and Aborted",
    )):  # fmt: skip
        sheet.text(note - 12.5j * (line - 1), words, fontsize=TEXT, color=MUTED)
    return sheet


if __name__ == "__main__":
    OUT.write_text(draw().svg(TITLE, FONTS), encoding="utf-8")
