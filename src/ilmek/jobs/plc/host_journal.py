"""The host's journal of a carpet on a PLC: the last row that it gave, durable before the PLC can weave it.

A journal of `loom.control.journal` with records of the kind GIVEN alone: the PLC itself keeps what of that row is in
the carpet. It is compared with the row that the PLC requests.
"""

import secrets

from ilmek.loom.control.journal import JournalStore, RecordKind, encode_record, read_journal
from ilmek.loom.control.opening import open_journal
from ilmek.loom.operations import LoomProgramme


class HostJournal:
    """Of a programme, on a store.

    row      last row that was given, -1: none
    awaited  rows were taken out: the PLC is to request `row`, and gets no other one
    Raises JournalError for a journal that is damaged or of another programme; OSError where it cannot be written.
    """

    def __init__(self, programme: LoomProgramme, store: JournalStore) -> None:
        content = store.read()
        opened = open_journal(content, programme, nonce=secrets.randbits(64))
        if opened.cut:
            store.truncate(opened.size)
        if opened.begin:
            store.append(opened.begin)
        self._store, self._number, self._crc, self._seed = store, opened.records, opened.crc, opened.seed
        self.row, self.awaited = -1, False
        kept = read_journal(content)
        given = () if kept is None else kept.records[kept.records["kind"] == RecordKind.GIVEN]
        for last in given[-1:]:
            self.row, self.awaited = int(last["row"]), bool(last["flag"])

    def give(self, row: int, *, awaited: bool = False) -> None:
        """A row is given from here on; durable when it returns."""
        fields = (self._number, 0, RecordKind.GIVEN, 0, row, 0, int(awaited), 0, 0)
        data, self._crc = encode_record(self._seed, self._crc, fields)
        self._store.append(data)
        self._store.sync()
        self._number += 1
        self.row, self.awaited = row, awaited
