"""Charts with shapes and flat weave at random, and their programmes on looms at random."""

import numpy as np

from ilmek.carpet.cells import PLAIN_GROUND, all_knots
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.shape import ShapeParams, shaped
from ilmek.carpet.sizes import CarpetSize
from ilmek.drivers.twin_port import TwinPort
from ilmek.io.yarn_file import default_yarns
from ilmek.loom.control.ports import Done
from ilmek.loom.control.sequence import Sequence
from ilmek.loom.operations import LoomProgramme, LoomSetup, OperationTimes
from ilmek.loom.programme import Programme, make_programme
from ilmek.loom.sharing import share
from ilmek.loom.times import Times
from ilmek.loom.tube_plan import YarnSupply, most_colours
from ilmek.loom.twin.model import NO_FAULTS, plant_model
from ilmek.loom.twin.state import first_state
from ilmek.loom.twin.woven import Woven, woven_size


def random_chart(rng: np.random.Generator, shape: str) -> Chart:
    """A chart of runs of random colours, with a shape, kilim ends, bands, or single cells without a knot."""
    rows, columns = rng.integers(8, 40, 2).tolist()
    rows = columns if shape == "round" else rows
    yarns, long = int(rng.integers(2, 9)), rng.random((rows, columns)) < rng.uniform(0.1, 0.9)
    knots = rng.integers(0, yarns, (rows, columns))
    for column in range(1, columns):
        knots[:, column] = np.where(long[:, column], knots[:, column - 1], knots[:, column])
    listed = default_yarns()[:yarns]
    made = Chart(knots, listed, CarpetSize(columns / 100, rows / 100), "10x10/dm", "symmetric")
    flat = f"{rows // 2}/{columns // 3}-{columns}" if rng.random() < 0.4 else None
    params = ShapeParams(shape=shape, flat_weave=flat, kilim_ends=float(rng.choice([0.0, 0.01, 0.02])))
    made = shaped(made, params)
    if rng.random() < 0.3:
        grid = made.knots.shape  # kilim ends have added rows
        cells = (made.cells or all_knots(*grid)).woven(rng.random(grid) < 0.3, PLAIN_GROUND)
        made = Chart(made.knots, made.yarns, made.size, made.quality, made.knot, cells=cells)
    return made


def compiled(rng: np.random.Generator, chart: Chart) -> tuple[LoomSetup, Programme]:
    """The programme of a chart on a loom of random times, heads, tubes and packages."""
    heads, yarns = int(rng.integers(1, max(2, min(8, chart.columns // 4)))), len(chart.yarns)
    knot, change, travel, weft = rng.uniform((1.0, 0.1, 0.01, 10.0), (5.0, 2.0, 0.5, 60.0)).tolist()
    tubes = max(min(int(rng.integers(3, 10)), yarns), most_colours(chart.knots, yarns, heads))
    supply = YarnSupply(tubes, (float(rng.uniform(5, 50)),) * yarns, (0.03,) * yarns)
    times = Times(knot=knot, colour_change=change, travel=travel, weft=weft)
    programme = make_programme(chart.knots, yarns, heads, times, supply=supply, tube_change=60.0)
    spacing = 1 if heads == 1 else int(np.diff(share(chart.columns, heads))[1:-1].min()) + 1
    in_rows = np.count_nonzero(chart.knots[::-1] != NO_KNOT, axis=1)
    setup = LoomSetup(
        loom="0" * 64,
        size=chart.size,
        quality=chart.quality,
        knot=chart.knot,
        yarns=chart.yarns,
        warp_pitch=0.005,
        rows=chart.rows,
        columns=chart.columns,
        heads=heads,
        tubes=tubes,
        spacing=spacing,
        times=OperationTimes(knot, change, travel, tuple(weft * part / 5 for part in range(1, 6)), 60.0),
        loading=programme.tubes.loading,
        packages=programme.tubes.packages,
        knot_yarn=supply.knot_yarn,
        row_knots=None if chart.cells is None else tuple(in_rows.tolist()),
    )
    return setup, programme


def woven_by_twin(programme: LoomProgramme) -> Woven:
    """The carpet that a loom without faults weaves, operation by operation of the sequence."""
    setup = programme.setup
    woven = Woven(setup, bytearray(woven_size(setup)))
    woven.keep(first_state(plant_model(setup)))
    port, sequence = TwinPort(setup, woven, rates=NO_FAULTS), Sequence(programme)
    while not sequence.finished:
        order = sequence.frontier()[0]
        port.send((order,))
        done = False
        while not done:
            done = any(isinstance(one, Done) and one.order == order for one in port.receive(0.0))
        sequence.done(order)
    assert sequence.knots == setup.knots
    return woven
