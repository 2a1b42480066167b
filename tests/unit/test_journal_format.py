"""The bytes of a journal: torn ends are cut, damage is named, foreign journals are refused."""

from functools import cache
from itertools import pairwise
from zlib import crc32

import pytest
from fake_loom import FakeLoom, MemoryStore, run, step
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Commanded
from ilmek.loom.control.journal import (
    HEADER_BYTES,
    RECORD_BYTES,
    JournalError,
    JournalHeader,
    RecordKind,
    decode_header,
    encode_record,
)
from ilmek.loom.control.opening import LARGEST_GROUP, journal_records, open_journal
from ilmek.loom.control.packml import PackCommand
from ilmek.loom.control.ports import SensorsChanged

PROGRAMME = small_programme(rows=5, columns=12, yarns=2, heads=2)


@cache
def woven(group: int = 1) -> tuple[bytes, tuple[int, ...]]:
    """The journal of a whole carpet, and its lengths at which it was durable."""

    class Store(MemoryStore):
        marks: list[int] = []  # noqa: RUF012

        def sync(self) -> None:
            super().sync()
            self.marks.append(self.durable)

    loom, store = FakeLoom(), Store()
    controller = Controller(PROGRAMME, open_journal(b"", PROGRAMME, group=group, nonce=5))
    step(controller, loom, store, (SensorsChanged(loom.sensors(), 0), Commanded(PackCommand.RESET)))
    step(controller, loom, store, (Commanded(PackCommand.START),))
    run(controller, loom, store)
    return store.read(), tuple(store.marks)


def test_a_header_is_read_as_it_was_written() -> None:
    header = JournalHeader("ab" * 32, 3, 40, 2, 7, 5, 2**64 - 1)
    assert decode_header(header.encode()) == header
    assert len(header.encode()) == HEADER_BYTES
    assert HEADER_BYTES % RECORD_BYTES == 0


def test_a_whole_journal_states_every_operation_once() -> None:
    content, _ = woven()
    opened = open_journal(content, PROGRAMME)
    assert (opened.size, opened.cut) == (len(content), 0)
    assert opened.sequence.finished
    assert not opened.uncertain
    found = journal_records(content)
    assert found is not None
    kinds = [one.kind for one in found[1]]
    assert kinds.count(RecordKind.KNOT) == PROGRAMME.setup.knots
    assert kinds.count(RecordKind.ROW_END) == 5 * PROGRAMME.setup.rows
    assert [one.sequence for one in found[1]] == list(range(len(kinds)))


@pytest.mark.parametrize("group", [1, 5])
def test_a_journal_cut_at_any_byte_is_read_to_its_last_whole_record(group: int) -> None:
    content, _ = woven(group)
    reference: dict[int, tuple[int, ...]] = {}
    for length in range(0, HEADER_BYTES + 40 * RECORD_BYTES + 1, 3):
        opened = open_journal(content[:length], PROGRAMME)
        whole = 0 if length < HEADER_BYTES else length - length % RECORD_BYTES
        assert (opened.size, opened.cut) == (whole, length - whole)
        reference.setdefault(whole, opened.sequence.position())
        assert opened.sequence.position() == reference[whole]


@pytest.mark.parametrize("group", [1, 5])
def test_what_was_not_durable_may_be_missing_or_wrong_in_any_part(group: int) -> None:
    content, marks = woven(group)
    for before, after in pairwise(marks[3:26]):
        for at in range(before, after, RECORD_BYTES):
            for hole in (bytes(RECORD_BYTES), b"\xff" * RECORD_BYTES, content[:RECORD_BYTES]):
                torn = content[:at] + hole + content[at + RECORD_BYTES : after]
                assert open_journal(torn, PROGRAMME).size == at


@pytest.mark.parametrize("byte", range(RECORD_BYTES))
def test_a_bit_flipped_in_a_durable_record_is_an_error_that_names_the_record(byte: int) -> None:
    content, _ = woven()
    for number in (0, 7, 19):
        at = HEADER_BYTES + number * RECORD_BYTES + byte
        damaged = content[:at] + bytes([content[at] ^ 4]) + content[at + 1 :]
        with pytest.raises(JournalError, match=f"record {number} of the journal"):
            open_journal(damaged, PROGRAMME)


def test_a_bit_flipped_in_the_last_record_makes_it_uncertain() -> None:
    """No later record knows that it was durable: it is cut off as a torn one, and its knot is queried."""
    content, _ = woven()
    length = HEADER_BYTES + 19 * RECORD_BYTES
    opened = open_journal(content[: length - 1] + b"\x00", PROGRAMME)
    assert opened.cut == RECORD_BYTES
    assert opened.uncertain


@pytest.mark.parametrize("byte", range(0, HEADER_BYTES, 3))
def test_a_bit_flipped_in_the_header_is_an_error(byte: int) -> None:
    content, _ = woven()
    damaged = content[:byte] + bytes([content[byte] ^ 1]) + content[byte + 1 :]
    with pytest.raises(JournalError, match="header of the journal is damaged"):
        open_journal(damaged, PROGRAMME)


def test_records_of_an_older_journal_are_not_valid_in_this_one() -> None:
    content, _ = woven()
    other = JournalHeader(PROGRAMME.digest, 5, 12, 2, 2, 1, 6).encode()
    assert open_journal(other + content[HEADER_BYTES:], PROGRAMME).records == 0


def test_stale_records_behind_a_cut_are_not_valid() -> None:
    """What was cut off and comes back from recycled blocks behind newer records is not taken for them."""
    content, marks = woven(5)
    begin, end = next((one, after) for one, after in pairwise(marks) if after - one == 5 * RECORD_BYTES)
    store = MemoryStore(content[:begin])
    controller = Controller(PROGRAMME, open_journal(store.read(), PROGRAMME, group=5))
    step(controller, FakeLoom(), store)
    assert begin < len(store.content) < end
    stale = store.read() + content[len(store.content) : end]
    assert open_journal(stale, PROGRAMME).size == len(store.content)


def test_a_journal_of_another_programme_is_refused() -> None:
    content, _ = woven()
    other = small_programme(rows=5, columns=12, yarns=2, heads=2, seed=2)
    with pytest.raises(JournalError, match=f"a journal of the programme {PROGRAMME.digest[:12]}.*another folder"):
        open_journal(content, other)


def test_a_journal_of_another_version_is_refused() -> None:
    body = bytearray(woven()[0][: HEADER_BYTES - 4])
    body[8] = 9
    with pytest.raises(JournalError, match="a journal of version 9; version 1"):
        open_journal(bytes(body) + crc32(bytes(body)).to_bytes(4, "little"), PROGRAMME)


def test_a_file_that_is_no_journal_is_refused() -> None:
    with pytest.raises(JournalError, match="no journal"):
        open_journal(b"a letter to the weaver\n" * 100, PROGRAMME)


@pytest.mark.parametrize("group", [0, LARGEST_GROUP + 1])
def test_a_group_has_limits(group: int) -> None:
    with pytest.raises(JournalError, match=f"a group commit of {group:,} knots; 1 to 10000"):
        open_journal(b"", PROGRAMME, group=group)


def test_records_that_do_not_follow_the_programme_are_named() -> None:
    """Whole records in a wrong order, written by another hand: row 0 lacks a knot."""
    header = JournalHeader(PROGRAMME.digest, 5, 12, 2, 2, 1, 6).encode()
    seed = int.from_bytes(header[-4:], "little")
    data, _ = encode_record(seed, 0, (0, 0, RecordKind.KNOT, 0, 0, 0, 0, 1, 0))
    with pytest.raises(JournalError, match="record 0 of the journal does not follow the programme: knot 1 of head 0"):
        open_journal(header + data, PROGRAMME)
