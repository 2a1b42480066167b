"""Notes of a run in a pipe while its loom waits."""

from ilmek.cli.waiting_notes import WaitingNotes
from ilmek.loom.control.view import AlarmView, Snapshot

FULL = AlarmView("disc full", "disc full: make room", "make room", stops=True, time=0)


def snapshot(*alarms: AlarmView, requests: tuple[str, ...] = ()) -> Snapshot:
    return Snapshot("", "Aborted", "Production", (), 0, 1, 0, 1, 0, 0, 0, 0.0, 0, "", (), alarms, (), (), requests)


def test_an_alarm_that_lasts_is_noted_once_and_again_when_it_comes_back() -> None:
    noted: list[str] = []
    notes = WaitingNotes(noted.append)
    for second in range(5):
        notes.show(snapshot(FULL), float(second))
    assert noted == ["the loom waits: disc full: make room"]
    notes.show(snapshot(), 5.0)
    notes.show(snapshot(FULL), 6.0)
    notes.show(snapshot(FULL, requests=("is knot 3 tied?",)), 8.0)
    notes.show(snapshot(FULL, requests=("is knot 3 tied?",)), 10.0)
    assert noted[1:] == ["the loom waits: disc full: make room", "the loom waits: asks: is knot 3 tied?"]


def test_what_is_repaired_at_once_is_not_noted() -> None:
    noted: list[str] = []
    notes = WaitingNotes(noted.append)
    for second in range(6):
        notes.show(snapshot(*[FULL][second % 2 :]), float(second))
    assert not noted
