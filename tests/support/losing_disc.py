"""A disc that loses writes: what may be in a file after a power cut, and a disc that is full or fails.

What was synced stays. Of the writes and truncations since then any subset may have reached the disc, in any order, each
write in part: whole sectors, or torn within one. A sector of the file that was never written reads as zeros or as what
a sector of the disc had before.
"""

import errno
import os
import random
from collections.abc import Callable

SECTOR = 512


class PowerCut(BaseException):
    """The power fails: nothing of the process goes on."""


class LosingDisc:
    """One file on such a disc; `cut_at` counts the calls after which the power fails."""

    def __init__(self, content: bytes = b"", *, cut_at: Callable[[], bool] = lambda: False) -> None:
        self.durable, self.now = bytearray(content), bytearray(content)
        self.pending: list[tuple[int, bytes] | int] = []
        self.cut_at = cut_at
        self.room: int | None = None
        self.failing_syncs = self.syncs = self.written = 0
        self.closed = False

    def size(self) -> int:
        return len(self.now)

    def read(self) -> bytes:
        return bytes(self.now)

    def write(self, data: bytes, offset: int) -> int:
        self._cut()
        if self.room is not None:
            data = data[: max(0, self.room - offset)]
            if not data:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        if len(self.now) < offset:
            self.now += bytes(offset - len(self.now))
        self.now[offset : offset + len(data)] = data
        self.pending.append((offset, bytes(data)))
        self.written += len(data)
        self._cut()
        return len(data)

    def truncate(self, length: int) -> None:
        self._cut()
        self.now = self.now[:length] + bytes(max(0, length - len(self.now)))
        self.pending.append(length)

    def sync(self) -> None:
        self._cut()
        self.syncs += 1
        if self.failing_syncs:
            self.failing_syncs -= 1
            self.pending.clear()  # the system takes the pages as written, which they are not
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        self.durable = bytearray(self.now)
        self.pending.clear()
        self._cut()

    def close(self) -> None:
        self.closed = True

    def after_power_cut(self, chance: random.Random) -> bytes:
        """What the disc has when the power returns."""
        content = bytearray(self.durable)
        changes = [one for one in self.pending if chance.random() < 0.6]
        chance.shuffle(changes)
        for change in changes:
            if isinstance(change, int):
                content = content[:change] + bytes(max(0, change - len(content)))
                continue
            offset, data = change
            begin, end = _part(offset, len(data), chance)
            if begin < end:
                if len(content) < offset + begin:
                    content += _unwritten(offset + begin - len(content), chance)
                content[offset + begin : offset + end] = data[begin:end]
        longest = max([len(self.now)] + [one if isinstance(one, int) else one[0] + len(one[1]) for one in self.pending])
        if len(content) < longest and chance.random() < 0.3:  # the length reached the disc, the data did not
            content += _unwritten(chance.randint(1, longest - len(content)), chance)
        return bytes(content)

    def _cut(self) -> None:
        if self.cut_at():
            raise PowerCut


def _part(offset: int, length: int, chance: random.Random) -> tuple[int, int]:
    """Begin and end of the part of a write that reached the disc."""
    kind = chance.randrange(4)
    if kind == 0:
        return 0, length
    if kind == 1:  # torn within a sector
        return 0, chance.randrange(length + 1)
    edge = -offset % SECTOR  # whole sectors alone
    return (0, min(edge, length)) if kind == 2 else (min(edge, length), length)


def _unwritten(length: int, chance: random.Random) -> bytes:
    return bytes(length) if chance.random() < 0.5 else chance.randbytes(length)
