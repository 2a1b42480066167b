"""The screen of `ilmek run`: what a person at the loom needs, in a terminal of any width."""

import io
from dataclasses import replace

from rich.console import Console

from ilmek.cli.run_screen import MOST_HEADS, drawn
from ilmek.io.yarn_file import default_yarns
from ilmek.loom.control.view import AlarmView, HeadView, Snapshot

YARNS = default_yarns()
HEAD = HeadView(30, 2, 1, 4, 150, 0)
SNAPSHOT = Snapshot(
    "0" * 64, "Held", "Production", ("unhold", "stop"), 11, 450, 3_456, 135_000, 1, 7_290 * 10**9, 3_600 * 10**9,
    0.5, 2, "bobbin of sinuous weft", (HEAD, replace(HEAD, column=None, tube=None, yarn=None, next_yarn=None)),
    (AlarmView("pile yarn break", "pile yarn break, row 12, head 1: \x1b[31mred", "thread it", True, 0),), (), (),
    ("is the knot tied?",),
)  # fmt: skip


def shown(snapshot: Snapshot, width: int = 110) -> str:
    text = io.StringIO()
    console = Console(file=text, width=width, markup=False, highlight=False, force_terminal=False)
    console.print(drawn(snapshot, YARNS, "Ctrl-C stops", "; here 8 s"))
    return text.getvalue()


def test_the_screen_shows_state_heads_alarms_and_time() -> None:
    text = shown(SNAPSHOT)
    for part in ("Held   row 12 of 450   knot 3,456 of 135,000   2.6%", "left about 1 h 0 min; here 8 s",
                 "30 knots/min", "faults mended 2", "change: bobbin of sinuous weft", "4 / 150",
                 YARNS[1].name, YARNS[0].name,
                 "? is the knot tied?", "ilmek resume --answer yes|no", "Ctrl-C stops"):  # fmt: skip
        assert part in text
    assert "! pile yarn break, row 12, head 1" in text
    assert "\x1b" not in text


def test_many_heads_and_alarms_are_cut() -> None:
    many = replace(SNAPSHOT, heads=(HEAD,) * (MOST_HEADS + 6), alarms=SNAPSHOT.alarms * 9)
    text = shown(many)
    assert "6 more" in text
    assert "5 more alarms" in text
    assert len(text.splitlines()) < MOST_HEADS + 25
