"""Programmes of small carpets in memory, for tests of everything that executes a programme."""

import numpy as np

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.yarn_file import default_yarns
from ilmek.loom.bobbins import Bobbin
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import LoomSetup, OperationTimes
from ilmek.loom.programme import Times, make_programme

TIMES = OperationTimes(2.0, 0.47, 0.016, (18.0, 30.0, 51.0, 62.0, 69.8), 60.0)


def small_programme(
    rows: int = 6, columns: int = 24, heads: int = 2, yarns: int = 3, *, seed: int = 1, weft_rows: int = 4
) -> CompiledProgramme:
    """A carpet of patches of random colours, with changes of the bobbins of weft."""
    random = np.random.default_rng(seed)
    coarse = random.integers(0, yarns, (rows // 2 + 1, columns // 3 + 1)).astype(np.uint8)
    knots = np.ascontiguousarray(np.kron(coarse, np.ones((2, 3), np.uint8))[:rows, :columns])
    wefts = (Bobbin("straight weft", weft_rows, 90.0), Bobbin("sinuous weft", 2 * weft_rows, 90.0))
    times = Times(TIMES.knot, TIMES.colour_change, TIMES.travel, TIMES.row_ends[-1])
    programme = make_programme(knots, yarns, heads, times, bobbins=wefts)
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
        tubes=yarns,
        spacing=2,
        times=TIMES,
        loading=np.tile(np.arange(yarns, dtype=np.uint8), (heads, 1)),
        packages=np.full((heads, yarns), 1000.0),
        knot_yarn=(0.04,) * yarns,
        wefts=wefts,
    )
    return CompiledProgramme(setup, programme)
