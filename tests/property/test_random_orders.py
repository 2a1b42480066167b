"""Random orders, from file to record: chart, programme, proof, twin and record have the same knots, each once."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from shaped_orders import compiled, woven_by_twin

from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.shape import SHAPES
from ilmek.io.call_state import chart_digest as name_of_chart
from ilmek.io.chart.png import read_chart_png
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.ordering.verify import verify_record
from ilmek.jobs.ordering.work import work_order
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.proof.prove import prove
from ilmek.loom.twin.comparison import chart_digest, compare


def random_order(rng: np.random.Generator, folder: Path, shape: str) -> int:
    """An order of a drawing of random patches with a shape, kilim ends and colourways; the number of its carpets."""
    columns, rows = rng.integers(16, 36, 2).tolist()
    rows = columns if shape == "round" else rows
    yarns = [default_yarns()[index] for index in rng.permutation(len(default_yarns()))[: int(rng.integers(3, 7))]]
    patches = rng.integers(0, len(yarns), (rows // 4 + 1, columns // 4 + 1))
    cells = np.kron(patches, np.ones((4, 4), int))[:rows, :columns]
    colours = np.array([yarn.srgb for yarn in yarns], np.uint8)[cells]
    Image.fromarray(colours).save(folder / "drawing.png")
    lines = [f'shape = "{shape}"'] if shape != "rectangle" else []
    lines += ['kilim_ends = "4cm"'] if rng.random() < 0.4 else []
    ways = int(rng.integers(1, 4))
    used = [yarns[index].name for index in np.unique(cells)]
    other = next(yarn.name for yarn in default_yarns() if yarn.name not in used)
    maps = [{used[0]: other}, {used[0]: used[1], used[1]: used[0]}]
    for number, changed in enumerate([{}, *maps][:ways]):
        pairs = ", ".join(f'"{one}" = "{two}"' for one, two in changed.items())
        lines += ["[[order.colourway]]", f'name = "way {number}"', f"quantity = {rng.integers(1, 3)}"]
        lines += [f"map = {{ {pairs} }}"] if pairs else []
    head = f'customer = "N-1"\nstart = 2026-12-01\ncurrency = "EUR"\n[price]\nmargin = "{rng.integers(5, 60)}%"\n'
    own = f'[[order]]\nname = "Patches"\npicture = "drawing.png"\nsize = "{2 * columns}x{2 * rows}cm"\n'
    own += 'quality = "5x5/dm"\nread = "exact"\nleast_detail = "0%"\ndue = 2029-01-01\n'
    (folder / "order.toml").write_text(head + own + "\n".join(lines) + "\n", encoding="utf-8")
    return ways


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("seed", range(200))
def test_the_record_of_a_random_order_is_of_the_knots_that_are_tied(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    ways = random_order(rng, tmp_path, [*SHAPES, "rectangle"][seed % (len(SHAPES) + 1)])
    done = work_order(tmp_path / "order.toml", tmp_path / "out", key=tmp_path / "key")
    assert len(done.lines) == ways
    for line, record in zip(done.lines, sorted((tmp_path / "out").glob("*/record-1.json")), strict=True):
        read = read_chart_png(record.parent / "chart.png")
        chart = line.charted.chart
        tied = read.knots != NO_KNOT
        setup, programme = compiled(rng, chart)
        made = CompiledProgramme(setup, programme)
        proof, woven = prove(made), compare(woven_by_twin(made), made)
        assert proof.ok, proof.faults[:3]
        assert woven.complete
        assert woven.digest == chart_digest(made)
        signed = verify_record(str(record))
        design = json.loads(record.read_text(encoding="utf-8"))["record"]["design"]
        assert signed.faults == ()
        assert design["digest"] == name_of_chart(chart)
        assert design["knots"] == proof.totals.knots == int(np.count_nonzero(tied)) == chart.tally().knots
        assert np.array_equal(tied, chart.knots != NO_KNOT)
        names = [yarn.name for yarn in read.yarns]
        assert [names[code] for code in read.knots[tied]] == [chart.yarns[code].name for code in chart.knots[tied]]
