"""Notes of a run in a pipe, where there is no screen: what a loom that stands waits for."""

from collections.abc import Callable

from ilmek.loom.control.view import Snapshot

PATIENCE = 2.0
"""Time after which an alarm or a question that lasts is noted [s]; what is repaired at once is not."""


class WaitingNotes:
    """Notes each alarm and question that lasts, once."""

    def __init__(self, note: Callable[[str], object]) -> None:
        self._note = note
        self._since: dict[str, float] = {}
        self._noted: set[str] = set()

    def show(self, snapshot: Snapshot, now: float) -> None:
        """Take the state at a time [s]."""
        waits = [*(alarm.cause for alarm in snapshot.alarms), *(f"asks: {request}" for request in snapshot.requests)]
        self._since = {text: self._since.get(text, now) for text in waits}
        self._noted &= set(waits)
        for text in waits:
            if now - self._since[text] >= PATIENCE and text not in self._noted:
                self._noted.add(text)
                self._note(f"the loom waits: {text}")
