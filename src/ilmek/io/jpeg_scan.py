"""The coded bytes of a sequential JPEG, walked without decoding a pixel.

A decoder goes on after wrong codes, and the picture is scrambled from there. Here every Huffman code of a scan is read
and counted: a code that does not exist, a block of more than 64 coefficients, bytes that end before the last block, or
go on long after it, show that the file is damaged.    [ITU-T T.81, F.2.2]

Of a progressive, lossless or arithmetically coded file nothing is checked.
"""

import struct
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from ilmek.arrays import IntArray, UInt8
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress

Bytes: TypeAlias = UInt8[np.ndarray, " n"]
"""The bytes of a file up to the end of a scan."""

_SLICE = 1 << 18
"""Blocks of one call of the kernel: about 0.05 s."""

_PADDING = 2
"""Bytes after the last block that are accepted; more only if they are one byte repeated, as cameras pad their files."""

_SEQUENTIAL = (0xC0, 0xC1)
_FRAMES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}


@dataclass(slots=True, eq=False)
class JpegTables:
    """What the segments of a JPEG before a scan state.

    frame       (identifier, blocks across, blocks down) of each component; empty if the coding is not checked
    codes       table of 2^16 codes by (class, number): length × 256 + value, 0 for a code that does not exist
    """

    width: int = 0
    height: int = 0
    frame: tuple[tuple[int, int, int], ...] = ()
    restart: int = 0
    codes: dict[tuple[int, int], IntArray] = field(default_factory=dict)

    def read(self, marker: int, segment: bytes) -> None:
        """Take over the segment of a marker. Raises ValueError for one that is invalid."""
        try:
            if marker == 0xC4:
                self._read_codes(segment)
            elif marker == 0xDD:
                (self.restart,) = struct.unpack_from(">H", segment)
            elif marker in _FRAMES:
                self._read_frame(marker, segment)
        except (IndexError, struct.error):
            raise ValueError(f"segment {marker:02X} is too short") from None

    def _read_frame(self, marker: int, segment: bytes) -> None:
        precision, self.height, self.width, count = struct.unpack_from(">BHHB", segment)
        components = tuple(
            (segment[at], segment[at + 1] >> 4, segment[at + 1] & 15) for at in range(6, 6 + 3 * count, 3)
        )
        plain = all(1 <= across <= 4 and 1 <= down <= 4 for _, across, down in components)
        known = marker in _SEQUENTIAL and precision == 8 and self.width > 0 and self.height > 0 and plain
        self.frame = components if known else ()

    def _read_codes(self, segment: bytes) -> None:
        at = 0
        while at < len(segment):
            table = np.zeros(1 << 16, dtype=np.int32)
            lengths, first, value = segment[at + 1 : at + 17], 0, at + 17
            for length, number in enumerate(lengths, 1):
                for _ in range(number):
                    after = first + (1 << 16 - length)
                    if after > 1 << 16:
                        raise ValueError("too many codes")
                    table[first:after] = length << 8 | segment[value]
                    first, value = after, value + 1
            self.codes[segment[at] >> 4, segment[at] & 15] = table
            at = value

    def check_scan(self, header: bytes, data: bytes, start: int, stop: int, progress: Progress = SILENT) -> None:
        """Check the coded bytes data[start:stop] of a scan. Raises ValueError; Cancelled.

        header  the scan's segment
        """
        if not self.frame:
            return
        try:
            chosen = [(header[1 + 2 * number], header[2 + 2 * number]) for number in range(header[0])]
            sizes = {name: (across, down) for name, across, down in self.frame}
            scan = [(*sizes[name], self.codes[0, which >> 4], self.codes[1, which & 15]) for name, which in chosen]
        except (IndexError, KeyError):
            raise ValueError("a scan without its tables") from None
        if not scan:
            raise ValueError("a scan of nothing")
        if len(scan) == 1:
            order, units = [0], self._units(*scan[0][:2], alone=True)
        else:
            order = [number for number, (across, down, *_) in enumerate(scan) for _ in range(across * down)]
            units = self._units(1, 1, alone=False)
        tables = np.stack([table for _, _, *both in scan for table in both])
        self._walk(np.frombuffer(data, np.uint8, stop, 0), start, tables, np.array(order), units, progress)

    def _units(self, across: int, down: int, *, alone: bool) -> int:
        """Number of the scan's units: blocks of a component alone, or the least rectangles of all components."""
        wide, high = max(each[1] for each in self.frame), max(each[2] for each in self.frame)
        if not alone:
            return _ceil(self.width, 8 * wide) * _ceil(self.height, 8 * high)
        return _ceil(_ceil(self.width * across, wide), 8) * _ceil(_ceil(self.height * down, high), 8)

    def _walk(  # noqa: PLR0917
        self, data: Bytes, start: int, tables: IntArray, order: IntArray, units: int, progress: Progress
    ) -> None:
        state = np.array([start, 0, 0, 0])
        step = max(1, _SLICE // len(order))
        while state[3] < units:
            many = min(step, units - int(state[3]))
            problem = _walk_units(data, tables, order, self.restart, many, state)
            if problem:
                raise ValueError(f"{_PROBLEMS[int(problem)]} in block {int(state[3]) * len(order)}")
            progress(int(state[3]) / units)
        rest = data[int(state[0]) - int(state[2]) // 8 :]
        if len(rest) > _PADDING and (rest != rest[0]).any():
            raise ValueError("codes after the last block")


_PROBLEMS = {1: "wrong code", 2: "too many coefficients", 3: "the codes end", 4: "no restart marker"}


def _ceil(number: int, part: int) -> int:
    return -(-number // part)


@compiled
def _walk_units(  # noqa: PLR0917
    data: Bytes, tables: IntArray, order: IntArray, restart: int, units: int, state: IntArray
) -> int:
    # state: position, bits held, their number, units done; returns a key of _PROBLEMS, or 0.
    at, held, bits = state[0], state[1], state[2]
    for _ in range(units):
        if restart > 0 and state[3] > 0 and state[3] % restart == 0:
            at, held, bits = _after_restart(data, at), 0, 0
            if at < 0:
                return 4
        for which in order:
            problem, at, held, bits = _walk_block(data, tables, which, at, held, bits)
            if problem:
                return problem
        state[0], state[1], state[2] = at, held, bits
        state[3] += 1
    return 0


@compiled
def _walk_block(  # noqa: PLR0917
    data: Bytes, tables: IntArray, which: int, at: int, held: int, bits: int
) -> tuple[int, int, int, int]:
    # The first of 64 coefficients, then codes of (zeros before it) × 16 + (bits of it); 0: the rest is 0; F0: 16 zeros.
    k = 0
    while k < 64:
        at, held, bits = _refilled(data, at, held, bits)
        window = held >> (bits - 16) if bits >= 16 else held << (16 - bits)
        entry = int(np.int64(tables[2 * which + (k > 0), window]))
        length, value = entry >> 8, entry & 255
        if length == 0 or (k == 0 and value > 15):
            return (3 if bits < 16 else 1), at, held, bits
        size = value & 15
        bits -= length + size
        if bits < 0:
            return 3, at, held, bits
        held &= (1 << bits) - 1
        if k == 0 or size > 0:
            k += (0 if k == 0 else value >> 4) + 1
        else:
            k = k + 16 if value == 0xF0 else 64
    return (2 if k > 64 else 0), at, held, bits


@compiled
def _refilled(data: Bytes, at: int, held: int, bits: int) -> tuple[int, int, int]:
    # At least 49 bits are held, or all before the next marker. FF 00 stands for the byte FF.
    while bits <= 48 and at < len(data):
        byte = int(np.int64(data[at]))
        if byte == 0xFF:
            if at + 1 >= len(data) or data[at + 1] != 0:
                break
            at += 1
        at += 1
        held = held << 8 | byte
        bits += 8
    return at, held, bits


@compiled
def _after_restart(data: Bytes, at: int) -> int:
    # The position after a restart marker; -1 where there is none.
    while at + 1 < len(data) and data[at] == 0xFF and data[at + 1] == 0xFF:
        at += 1
    if at + 1 >= len(data) or data[at] != 0xFF or not 0xD0 <= data[at + 1] <= 0xD7:
        return -1
    return at + 2
