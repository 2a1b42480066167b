"""Programmes of small carpets in memory, for tests of everything that executes a programme."""

from dataclasses import replace

import numpy as np

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.yarn_file import default_yarns
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import LoomSetup, OperationTimes, RowOperations
from ilmek.loom.programme import Programme, make_programme
from ilmek.loom.times import Times
from ilmek.loom.tube_plan import YarnSupply
from ilmek.timing.cyclogram import Cyclogram

TIMES = OperationTimes(2.0, 0.47, 0.016, (18.0, 30.0, 51.0, 62.0, 69.8), 60.0)


def small_programme(
    rows: int = 6,
    columns: int = 24,
    heads: int = 2,
    yarns: int = 3,
    *,
    seed: int = 1,
    weft_rows: int = 4,
    tubes: int | None = None,
    package: float = 1000.0,
    loom_times: OperationTimes = TIMES,
    cyclograms: tuple[Cyclogram, ...] = (),
) -> CompiledProgramme:
    """A carpet of patches of random colours, with changes of the bobbins of weft.

    tubes  of a head; default: one for each yarn; with fewer, packages are changed
    package  length of yarn on one [m]; a knot takes 4 cm
    """
    random = np.random.default_rng(seed)
    coarse = random.integers(0, yarns, (rows // 2 + 1, columns // 3 + 1)).astype(np.uint8)
    knots = np.ascontiguousarray(np.kron(coarse, np.ones((2, 3), np.uint8))[:rows, :columns])
    wefts = (Bobbin("straight weft", weft_rows, 90.0), Bobbin("sinuous weft", 2 * weft_rows, 90.0))
    times = Times(loom_times.knot, loom_times.colour_change, loom_times.travel, loom_times.row_ends[-1])
    supply = YarnSupply(tubes or yarns, (package,) * yarns, (0.04,) * yarns)
    programme = make_programme(
        knots, yarns, heads, times, bobbins=wefts, supply=supply, tube_change=loom_times.tube_change
    )
    quality = Quality(250.0, 250.0)
    setup = LoomSetup(
        loom="0" * 64,
        size=CarpetSize(columns / quality.across, rows / quality.along),
        quality=quality,
        knot="symmetric",
        yarns=tuple(default_yarns())[:yarns],
        warp_pitch=0.5 / quality.across,
        rows=rows,
        columns=columns,
        heads=heads,
        tubes=supply.tubes,
        spacing=2,
        times=loom_times,
        loading=programme.tubes.loading,
        packages=programme.tubes.packages,
        knot_yarn=supply.knot_yarn,
        wefts=wefts,
        cyclograms=cyclograms,
    )
    return CompiledProgramme(setup, programme)


def rows_of(programme: Programme) -> tuple[RowOperations, ...]:
    """The operations of every row of a programme."""
    setup = replace(small_programme().setup, rows=programme.rows, columns=programme.columns, heads=programme.heads)
    compiled = CompiledProgramme(setup, programme)
    return tuple(compiled.operations(number) for number in range(programme.rows))


def head_knots(row: RowOperations, head: int) -> tuple[list[int], list[int]]:
    """Columns and tubes of a head's knots in their order."""
    low, high = row.starts[head : head + 2]
    return row.columns[low:high].tolist(), row.tubes[low:high].tolist()
