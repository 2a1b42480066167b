"""Opening a journal: what is certainly in the carpet, and whether operations may have been in progress."""

from collections.abc import Iterable

import numpy as np

from ilmek.errors import LoomError
from ilmek.loom.control.exchange import Operation
from ilmek.loom.control.journal import (
    AlarmAction,
    JournalContent,
    JournalError,
    JournalHeader,
    JournalRecord,
    RecordArray,
    RecordKind,
    read_journal,
)
from ilmek.loom.control.ports import EndRow, Tie
from ilmek.loom.control.sequence import Sequence
from ilmek.loom.operations import LoomProgramme, RowEnd
from ilmek.records import record
from ilmek.units import counted

LARGEST_GROUP = 10_000
"""Most knots in a group commit."""

_OPERATIONS = (RecordKind.KNOT, RecordKind.ROW_END, RecordKind.CHANGE, RecordKind.ROWS_BACK)


@record
class OpenedJournal:
    """A journal as a controller continues it.

    size      valid bytes: what is behind them is cut off before anything is appended; 0: a new journal
    begin     bytes that a new journal begins with       cut        bytes that are not valid, behind `size`
    records   how many there are                         crc        of the last, 0: none
    seed      CRC of the header
    sequence  what is in the carpet                      uncertain  operations may have been in progress
    openings  how often it was opened before             alarms     numbers of those that were active
    speed     as a fraction of the programme's           time       of the last record [ns]
    """

    group: int
    size: int
    begin: bytes
    cut: int
    records: int
    crc: int
    seed: int
    sequence: Sequence
    uncertain: bool
    openings: int
    alarms: tuple[int, ...]
    speed: float
    time: int


def open_journal(content: bytes, programme: LoomProgramme, *, group: int = 1, nonce: int = 0) -> OpenedJournal:
    """The journal of a programme, from the bytes of its file; empty: a new one.

    group  knots in a group commit, 1 to LARGEST_GROUP       nonce  of a new journal: a number that no other has
    Raises JournalError for a journal of another programme, and for one that is damaged: it names the record.
    """
    if not 1 <= group <= LARGEST_GROUP:
        raise JournalError(f"a group commit of {counted(group, 'knot')}", allowed=f"1 to {LARGEST_GROUP}")
    setup = programme.setup
    found = read_journal(content)
    if found is None:
        header = JournalHeader(
            programme.digest, setup.rows, setup.columns, setup.heads, setup.tubes, group, nonce % 2**64
        )
        begin = header.encode()
        seed = int.from_bytes(begin[-4:], "little")
        return OpenedJournal(group, 0, begin, len(content), 0, 0, seed, Sequence(programme), False, 0, (), 1.0, 0)
    header = found.header
    sizes = (header.rows, header.columns, header.heads, header.tubes)
    if header.programme != programme.digest or sizes != (setup.rows, setup.columns, setup.heads, setup.tubes):
        raise JournalError(
            f"a journal of the programme {header.programme[:12]}, {header.rows} x {header.columns} knots",
            allowed=f"one of the programme {programme.digest[:12]}, {setup.rows} x {setup.columns} knots",
            do="choose the programme that it was begun with, or another folder",
        )
    return _continued(found, programme, group)


def _continued(found: JournalContent, programme: LoomProgramme, group: int) -> OpenedJournal:
    records = found.records
    kinds = records["kind"]
    states = records[kinds == RecordKind.STATE]
    speeds = records[kinds == RecordKind.SPEED]
    return OpenedJournal(
        group=group,
        size=found.size,
        begin=b"",
        cut=found.cut,
        records=len(records),
        crc=found.crc,
        seed=found.seed,
        sequence=_position(records, programme),
        uncertain=bool(len(states) and states["flag"][-1]),
        openings=int(np.count_nonzero(kinds == RecordKind.START)),
        alarms=_active(records[kinds == RecordKind.ALARM]),
        speed=float(speeds["number"][-1]) / 1000 if len(speeds) else 1.0,
        time=int(records["time"][-1]) if len(records) else 0,
    )


def _active(records: RecordArray) -> tuple[int, ...]:
    """Numbers of the alarms that were raised and have not ended, in order."""
    active: dict[int, None] = {}
    for number, action in zip(records["number"].tolist(), records["code"].tolist(), strict=True):
        if action == AlarmAction.RAISED:
            active[number] = None
        elif action == AlarmAction.ENDED:
            active.pop(number, None)
    return tuple(active)


def _position(records: RecordArray, programme: LoomProgramme) -> Sequence:
    """The position behind the recorded operations. Raises JournalError where they do not follow the programme."""
    records = records[np.isin(records["kind"], _OPERATIONS)]
    sequence = Sequence(programme)
    for woven in np.split(records, np.flatnonzero(records["kind"] == RecordKind.ROWS_BACK)):
        begin = int(len(woven) > 0 and woven["kind"][0] == RecordKind.ROWS_BACK)
        if begin:
            _follow(sequence, JournalRecord(*woven[0].item()[:-1]))
        if len(woven) > begin:
            sequence = _woven(woven[begin:], sequence, programme)
    return sequence


def _woven(records: RecordArray, sequence: Sequence, programme: LoomProgramme) -> Sequence:
    """The position behind recorded operations that were done from a position on."""
    last = int(records["row"][-1])
    if last >= programme.setup.rows:
        raise _misfit(records[-1:])
    begin = 0
    if _whole_rows(records, sequence.row, last, programme):
        begin = int(np.searchsorted(records["row"], last))
        changes = records[:begin][records[:begin]["kind"] == RecordKind.CHANGE]
        for row, number in zip(changes["row"][-1:].tolist(), changes["number"][-1:].tolist(), strict=True):
            sequence.stop_row = row + (programme.operations(row).stops[number].phase > 0)
        if begin:
            sequence = Sequence(programme, last, sequence.stop_row)
    for one in _decoded(records[begin:]):
        _follow(sequence, one)
    return sequence


def _follow(sequence: Sequence, one: JournalRecord) -> None:
    """What a record states is done. Raises JournalError where it does not follow the programme."""
    try:
        if one.kind == RecordKind.ROWS_BACK:
            sequence.take_out(sequence.row - one.row)
        else:
            sequence.done(_operation(one, sequence))
    except (LoomError, IndexError) as error:
        raise JournalError(
            f"record {one.sequence} of the journal does not follow the programme: {error}",
            do="restore journal and programme from copies that belong together",
        ) from error


def _whole_rows(records: RecordArray, first: int, last: int, programme: LoomProgramme) -> bool:
    """Whether the rows from the first to before the last one are recorded whole and in order: each knot once."""
    rows = records["row"]
    setup = programme.setup
    if np.any(np.diff(rows.astype(np.int64)) < 0):
        return False
    bounds = np.searchsorted(rows, np.arange(first, last + 1))
    for number, (begin, end) in enumerate(zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True), start=first):
        row = records[begin:end]
        knots = row[row["kind"] == RecordKind.KNOT]
        heads, numbers = knots["head"], knots["number"]
        order = np.argsort(heads, kind="stable")
        counts = np.bincount(heads, minlength=setup.heads)
        starts = np.repeat(np.cumsum(counts) - counts, counts)
        right = len(knots) == setup.knots_of(number) and np.array_equal(numbers[order], np.arange(len(knots)) - starts)
        ends = row["code"][row["kind"] == RecordKind.ROW_END]
        if not right or not np.array_equal(ends, np.arange(len(RowEnd))):
            return False
    return True


def _decoded(records: RecordArray) -> Iterable[JournalRecord]:
    return (JournalRecord(*one[:-1]) for one in records.tolist())


def _operation(one: JournalRecord, sequence: Sequence) -> Operation:
    """The operation that a record is about: of the frontier, or one that is refused."""
    if one.row != sequence.row:
        raise LoomError(f"row {one.row}", allowed=f"row {sequence.row}")
    if one.kind == RecordKind.KNOT:
        found = sequence.of_head(one.head) if one.head < len(sequence.upcoming) else None
        if found is None or (found.number, found.tube) != (one.number, one.code):
            raise LoomError(f"knot {one.number} of head {one.head} with tube {one.code}")
        return found
    if one.kind == RecordKind.ROW_END:
        return EndRow(one.row, RowEnd(one.code))
    change = sequence.of_loom()
    if change is None or isinstance(change, EndRow | Tie):
        raise LoomError(f"change of packages {one.number}")
    return change


def _misfit(record_: RecordArray) -> JournalError:
    return JournalError(
        f"record {int(record_['sequence'][0])} of the journal is of row {int(record_['row'][0])}",
        allowed="a row of the carpet",
    )


def journal_records(content: bytes) -> tuple[JournalHeader, tuple[JournalRecord, ...]] | None:
    """Header and records of a journal, for its history; None: an empty one. Raises JournalError if it is damaged."""
    found = read_journal(content)
    return None if found is None else (found.header, tuple(_decoded(found.records)))
