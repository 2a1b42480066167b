"""What the host writes into the program for a programme: the carpet's recipe, and each row with its check sum.

check = CRC-32 (ISO 3309) of: the programme's digest (8 words), row (32 bit), knots of the rows before (32 bit), its
        own (16 bit), phases (16 bit); of each knot its column (16 bit) and tube (8 bit); of each head its first knot,
        then of each phase its limit and where it stands aside (16 bit each);
        of each phase whether packages are changed before it (8 bit).  Least significant byte first.
"""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.io.plc.sequence_variables import DIGEST_WORDS, NOT_ASIDE
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.standing import asides
from ilmek.records import record

RECIPE_HEADER, CHECKS_HEADER = "variable,value\n", "row,phases,check\n"


@record
class HostRow:
    """A row as the host writes it: the members of the structure `LoomRow`.

    before  knots of the rows before      limits, aside  (heads, phases)
    """

    number: int
    before: int
    columns: list[int]
    tubes: list[int]
    first: list[int]
    limits: list[list[int]]
    aside: list[list[int]]
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


def host_row(programme: LoomProgramme, number: int) -> HostRow:
    """A row of a programme."""
    row, setup = programme.operations(number), programme.setup
    stops, moves = {stop.phase for stop in row.stops}, asides(row, setup.columns)
    values = HostRow(
        number=row.number,
        before=setup.knots_before(number),
        columns=row.columns.tolist(),
        tubes=row.tubes.tolist(),
        first=row.starts[:-1].tolist(),
        limits=np.cumsum(row.counts, axis=1).tolist(),
        aside=[[move.get(head, NOT_ASIDE) for move in moves] for head in range(row.heads)],
        stop_before=[phase in stops for phase in range(row.phases)],
        check=0,
    )
    return checked(values, programme.digest)


def checked(row: HostRow, digest: str) -> HostRow:
    """The row with its check sum, for the programme with a digest."""
    knots = np.empty(len(row.columns), np.dtype([("column", "<i2"), ("tube", "u1")]))
    knots["column"], knots["tube"] = row.columns, row.tubes
    phases = np.stack([row.limits, row.aside], axis=-1).reshape(len(row.first), -1)
    heads = np.column_stack([row.first, phases]).astype("<i2")
    numbers = (row.number, row.before, len(row.columns), row.phases)
    content = struct.pack(f"<{DIGEST_WORDS}IiiHH", *digest_words(digest), *numbers)
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
        row = host_row(programme, number)
        yield f"{number},{row.phases},{row.check}\n"
