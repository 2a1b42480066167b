"""What the host writes into the program for a programme: the carpet's recipe, and each row with its check sum.

check = CRC-32 (ISO 3309) of: the programme's digest (8 words), row (32 bit), phases (16 bit);
        of each knot its column (16 bit) and tube (8 bit); of each head its first knot and its limits (16 bit each);
        of each phase whether packages are changed before it (8 bit).  Least significant byte first.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.io.plc.sequence_variables import DIGEST_WORDS
from ilmek.loom.operations import LoomProgramme, RowOperations
from ilmek.records import record

RECIPE_HEADER, CHECKS_HEADER = "variable,value\n", "row,phases,check\n"


@record
class HostRow:
    """A row as the host writes it: the members of the structure `LoomRow`; limits: (heads, phases)."""

    number: int
    columns: list[int]
    tubes: list[int]
    first: list[int]
    limits: list[list[int]]
    stop_before: list[bool]
    check: int

    @property
    def phases(self) -> int:
        """Number of phases."""
        return len(self.stop_before)


def digest_words(digest: str) -> tuple[int, ...]:
    """A digest as words of 32 bits.

    >>> digest_words("0000000a" + 56 * "0")[:2]
    (10, 0)
    """
    return tuple(int(digest[8 * word : 8 * word + 8], 16) for word in range(DIGEST_WORDS))


def host_row(row: RowOperations, digest: str) -> HostRow:
    """A row of the programme with a digest."""
    stops = {stop.phase for stop in row.stops}
    values = HostRow(
        number=row.number,
        columns=row.columns.tolist(),
        tubes=row.tubes.tolist(),
        first=row.starts[:-1].tolist(),
        limits=np.cumsum(row.counts, axis=1).tolist(),
        stop_before=[phase in stops for phase in range(row.phases)],
        check=0,
    )
    return checked(values, digest)


def checked(row: HostRow, digest: str) -> HostRow:
    """The row with its check sum, for the programme with a digest."""
    knots = np.empty(len(row.columns), np.dtype([("column", "<i2"), ("tube", "u1")]))
    knots["column"], knots["tube"] = row.columns, row.tubes
    heads = np.array([[first, *limits] for first, limits in zip(row.first, row.limits, strict=True)], "<i2")
    content = struct.pack(f"<{DIGEST_WORDS}IiH", *digest_words(digest), row.number, row.phases)
    return replace(row, check=zlib.crc32(content + knots.tobytes() + heads.tobytes() + bytes(row.stop_before)))


def recipe_csv(programme: LoomProgramme) -> str:
    """The carpet as the host writes it into `Recipe`; its last row is that of the host's own journal."""
    setup = programme.setup
    words = [(f"Programme[{number}]", word) for number, word in enumerate(digest_words(programme.digest))]
    values = [*words, ("Rows", setup.rows), ("Columns", setup.columns), ("Tubes", setup.tubes)]
    return RECIPE_HEADER + "".join(f"{name},{value}\n" for name, value in values)


def checks_csv(programme: LoomProgramme) -> Iterator[str]:
    """Lines of a CSV file: phases and check sum of each row."""
    yield CHECKS_HEADER
    for number in range(programme.setup.rows):
        row = host_row(programme.operations(number), programme.digest)
        yield f"{number},{row.phases},{row.check}\n"
