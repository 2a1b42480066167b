"""The journal of a carpet: what is certainly in it, so that no knot is lost and none is tied twice.

A file of fixed records behind a header, to which the controller only appends (little endian):

    header  128 bytes: magic, version, size of a record, group n, rows, columns, heads, tubes, nonce,
            digest of the programme, CRC-32 of all that
    record   32 bytes: sequence number, lag, kind, code, row, head, flag, number, time [ns], CRC-32

The CRC of a record begins with that of the header, which holds a nonce: records of an older journal that lie in
recycled blocks of a disc are not valid in this one. `lag` counts the records before this one that were not yet durable
when it was written; so a damaged record that a later one knows as durable is told from the torn end of the file.
"""

import struct
from enum import IntEnum
from typing import NamedTuple, Protocol
from zlib import crc32

from ilmek.errors import LoomError
from ilmek.records import value_record

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
    """

    KNOT = 1
    ROW_END = 2
    CHANGE = 3
    STATE = 4
    ALARM = 5
    ANSWER = 6
    SPEED = 7


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

    @property
    def seed(self) -> int:
        """The value that the CRC of every record begins with."""
        return crc32(self.encode())


class JournalStore(Protocol):
    """Where a journal is kept. Errors of the system are OSErrors; after one nothing more is appended."""

    def read(self) -> bytes:
        """The whole content."""

    def append(self, data: bytes) -> None:
        """Write behind the end; durable after the next `sync`."""

    def sync(self) -> None:
        """Make everything durable that was appended."""

    def truncate(self, size: int) -> None:
        """Cut off what is behind a number of bytes; durable after the next `sync`."""


def encode_record(seed: int, record: tuple[int, int, int, int, int, int, int, int, int]) -> bytes:
    """The bytes of a record: the fields of `JournalRecord` in order."""
    body = _BODY.pack(*record)
    return body + _CRC.pack(crc32(body, seed))
