"""The journal of a carpet: what is certainly in it, so that no knot is lost and none is tied twice.

A file of fixed records behind a header, to which the controller only appends (little endian):

    header  128 bytes: magic, version, size of a record, group n, rows, columns, heads, tubes, nonce,
            digest of the programme, CRC-32 of all that
    record   32 bytes: sequence number, lag, kind, code, row, head, flag, number, time [ns], CRC-32

The CRC of a record begins with that of the header, which holds a nonce, and that of the record before it (exclusive or;
0 before the first); every opening of the journal appends a START. So records of an older journal, or of a tail that was
cut off, are not valid in this one even where a disc returns them from recycled blocks. `lag` counts the records before
this one that were not yet durable when it was written: it tells damage of what was durable from the torn end.
"""

import struct
from enum import IntEnum
from typing import NamedTuple, Protocol, TypeAlias
from zlib import crc32

import numpy as np

from ilmek.errors import LoomError
from ilmek.records import record, value_record

MAGIC = b"ILMEKJNL"
JOURNAL_VERSION = 1
HEADER_BYTES = 128
RECORD_BYTES = 32
MOST_LAG = 65_535
"""Records between two synchronisations: the largest group."""

_HEADER = struct.Struct("<8sHHIIIIIQ32s")
_BODY = struct.Struct("<IHBBIHHIq")
_CRC = struct.Struct("<I")


class JournalError(LoomError):
    """A journal that is damaged, of another programme, or of another version."""


class RecordKind(IntEnum):
    """What a record states.

    KNOT     a knot is in the carpet: row, head, number of the head's knots; code: tube; flag: `Origin`
    ROW_END  an operation after the knots is done: row; code: operation; flag: `Origin`
    CHANGE   the packages of a stop are changed: row; number: index of the stop in its row; flag: `Origin`
    STATE    the machine is in a state: code; head: mode; flag: operations may be in progress from here on
    ALARM    number: of the alarm; code: `AlarmAction`; row, head where it happened
    ANSWER   of the operator to a request: code: 1 yes, 0 no; row, head, number of the operation
    SPEED    number: speed [1/1000 of the programme's]
    START    the journal was opened: number: how often before
    HOMED    an axis is at home: code: its number in the list of axes; row
    ROWS_BACK  an operator has taken out all from a row on: row; number: whole rows before the row in work
    GIVEN    a row was given to a PLC: row; flag: 1: it was taken out, and the PLC has not requested it yet
    """

    KNOT = 1
    ROW_END = 2
    CHANGE = 3
    STATE = 4
    ALARM = 5
    ANSWER = 6
    SPEED = 7
    START = 8
    ROWS_BACK = 9
    HOMED = 10
    GIVEN = 11


class Origin(IntEnum):
    """Who states that an operation is done."""

    REPORT = 0
    SENSOR = 1
    OPERATOR = 2


class AlarmAction(IntEnum):
    """What happened to an alarm."""

    RAISED = 1
    ENDED = 2
    ACKNOWLEDGED = 3


class JournalRecord(NamedTuple):
    """A record: see `RecordKind` for the meaning of its fields by kind."""

    sequence: int
    lag: int
    kind: int
    code: int
    row: int
    head: int
    flag: int
    number: int
    time: int


@value_record
class JournalHeader:
    """What a journal belongs to.

    programme  SHA-256 of the programme, hexadecimal digits      group  knots in a group commit
    nonce      a number that no other journal has, 0 to 2^64 - 1
    """

    programme: str
    rows: int
    columns: int
    heads: int
    tubes: int
    group: int
    nonce: int

    def encode(self) -> bytes:
        """The header's bytes."""
        body = _HEADER.pack(
            MAGIC, JOURNAL_VERSION, RECORD_BYTES, self.group, self.rows, self.columns, self.heads, self.tubes,
            self.nonce, bytes.fromhex(self.programme),
        ).ljust(HEADER_BYTES - _CRC.size, b"\0")  # fmt: skip
        return body + _CRC.pack(crc32(body))


class JournalStore(Protocol):
    """Where a journal is kept. Errors of the system are OSErrors; after one nothing more is appended."""

    def read(self) -> bytes:
        """The whole content."""

    def append(self, data: bytes) -> None:
        """Write behind the end; durable after the next `sync`."""

    def sync(self) -> None:
        """Make everything durable that was appended."""

    def truncate(self, size: int) -> None:
        """Cut off what is behind a number of bytes, durably, before anything is appended."""


RECORD_FIELDS = np.dtype(
    [("sequence", "<u4"), ("lag", "<u2"), ("kind", "u1"), ("code", "u1"), ("row", "<u4"), ("head", "<u2"),
     ("flag", "<u2"), ("number", "<u4"), ("time", "<i8"), ("crc", "<u4")]
)  # fmt: skip
"""A record as an element of an array."""

RecordArray: TypeAlias = "np.ndarray[tuple[int], np.dtype[np.void]]"


@record
class JournalContent:
    """A journal as it was read.

    records  an array of RECORD_FIELDS: the longest valid beginning      size  its bytes, with the header
    crc      of the last record, 0: there is none                        cut   bytes behind it, which are not valid
    seed     CRC of the header
    """

    header: JournalHeader
    records: RecordArray
    size: int
    crc: int
    cut: int
    seed: int


def encode_record(
    seed: int, before: int, record: tuple[int, int, int, int, int, int, int, int, int]
) -> tuple[bytes, int]:
    """The bytes of a record, the fields of `JournalRecord` in order, and its CRC.

    seed  CRC of the header       before  CRC of the record before it, 0: it is the first
    """
    body = _BODY.pack(*record)
    crc = crc32(body, seed ^ before)
    return body + _CRC.pack(crc), crc


def decode_header(content: bytes) -> JournalHeader | None:
    """The header of a journal; None: it is not whole. Raises JournalError for another version."""
    data = content[:HEADER_BYTES]
    if len(data) < HEADER_BYTES or _CRC.unpack(data[-4:])[0] != crc32(data[:-4]) or not data.startswith(MAGIC):
        return None
    _, version, size, group, rows, columns, heads, tubes, nonce, digest = _HEADER.unpack_from(data)
    if (version, size) != (JOURNAL_VERSION, RECORD_BYTES):
        raise JournalError(f"a journal of version {version}", allowed=f"version {JOURNAL_VERSION}")
    return JournalHeader(digest.hex(), rows, columns, heads, tubes, group, nonce)


def read_journal(content: bytes) -> JournalContent | None:
    """The valid beginning of a journal; None: nothing of it was ever durable, so it is a new one.

    Raises JournalError for a file that is no journal, and where a record is damaged that was durable: it names the
    record. What follows the last valid record and was not durable is the torn end.
    """
    header = decode_header(content)
    number = max(0, len(content) - HEADER_BYTES) // RECORD_BYTES
    records = np.frombuffer(content, RECORD_FIELDS, number, HEADER_BYTES) if number else np.empty(0, RECORD_FIELDS)
    if header is None:
        seed = int.from_bytes(content[HEADER_BYTES - 4 : HEADER_BYTES], "little")
        if number > MOST_UNSYNCED_FIRST or _known_as_durable(content, records, 0, seed) is not None:
            raise JournalError(
                "the header of the journal is damaged, or the file is no journal",
                do="restore the file from a copy, or choose another folder",
            )
        return None
    seed = crc32(content[: HEADER_BYTES - 4])
    crc, valid = _valid(content, records, seed)
    later = _known_as_durable(content, records, valid, seed)
    if later is not None:
        offset = HEADER_BYTES + valid * RECORD_BYTES
        raise JournalError(
            f"record {valid} of the journal (byte {offset}) is damaged",
            allowed=f"it was durable when record {later} was written, so it is not a torn end",
            do="restore the journal from a copy",
        )
    size = HEADER_BYTES + valid * RECORD_BYTES
    return JournalContent(header, records[:valid], size, crc, len(content) - size, seed)


MOST_UNSYNCED_FIRST = 8
"""Records that may follow a header before both are durable for the first time."""


def _valid(content: bytes, records: RecordArray, seed: int) -> tuple[int, int]:
    """CRC of the last record of the longest valid beginning, and how many there are."""
    view, offset, crc = memoryview(content), HEADER_BYTES, 0
    in_order = records["sequence"] == np.arange(len(records))
    for number, (given, right) in enumerate(zip(records["crc"].tolist(), in_order.tolist(), strict=True)):
        found = crc32(view[offset : offset + RECORD_BYTES - 4], seed ^ crc)
        if found != given or not right:
            return crc, number
        crc = found
        offset += RECORD_BYTES
    return crc, len(records)


def _known_as_durable(content: bytes, records: RecordArray, damaged: int, seed: int) -> int | None:
    """A later record, valid behind the one before it, that was written when the damaged one was durable."""
    later = np.arange(len(records)) > damaged
    knows = records["sequence"].astype(np.int64) - records["lag"] > damaged
    for number in np.flatnonzero(later & knows & (records["sequence"] == np.arange(len(records)))).tolist():
        begin = HEADER_BYTES + number * RECORD_BYTES
        before = int(records["crc"][number - 1])
        if crc32(content[begin : begin + RECORD_BYTES - 4], seed ^ before) == records["crc"][number]:
            return int(number)
    return None
