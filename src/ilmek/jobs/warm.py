"""Compile the kernels ahead of the first job: `python -m ilmek.jobs.warm`, once after installing.

A kernel is compiled when it is first called and kept in the user's cache folder (`ilmek.num.compiled`); this calls each
one that a job needs on a carpet of a few knots, so that the first real job does not wait for the compiler.
"""

import numpy as np

from ilmek.carpet.chart import make_chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import Size
from ilmek.io.yarn_file import default_yarns
from ilmek.loom.programme import Times, heads_for, make_programme


def warm() -> int:
    """Chart and programme a carpet of 16 x 16 knots; the number of heads that its deadline needs."""
    noise = np.random.default_rng(1).integers(0, 256, (24, 24, 3), dtype=np.uint8)
    chart = make_chart(noise, Size(0.16, 0.16), Quality(100.0, 100.0), default_yarns(), colours=8)
    times = Times(knot=2.0, colour_change=0.5, travel=0.01, weft=10.0)
    make_programme(chart.knots, len(chart.yarns), 2, times).row(0).ties()
    return heads_for(chart.knots, len(chart.yarns), 1e6, times, 4)


if __name__ == "__main__":
    warm()
