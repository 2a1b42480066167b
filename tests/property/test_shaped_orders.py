"""Random orders with shapes and flat weave: chart, programme, files, proof, twin; every knot once, none outside."""

from pathlib import Path

import numpy as np
import pytest
from plain_proof import broken_rules
from shaped_orders import compiled, random_chart, woven_by_twin

from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.shape import SHAPES
from ilmek.io.programme_file import open_programme, write_programme
from ilmek.io.programme_text import open_programme_text, write_programme_text
from ilmek.loom.explicit import CompiledProgramme
from ilmek.loom.operations import EMPTY, LoomProgramme
from ilmek.loom.proof.prove import prove
from ilmek.loom.twin.comparison import chart_digest, compare


def woven_by_hand(programme: LoomProgramme) -> tuple[np.ndarray, np.ndarray]:
    """How often each knot is tied, and the yarn that its tube has then, row 0 at the bottom; in plain loops."""
    setup = programme.setup
    times, yarns = np.zeros((setup.rows, setup.columns), int), np.full((setup.rows, setup.columns), EMPTY)
    loaded = setup.loading.copy()
    for number in range(setup.rows):
        row = programme.operations(number)
        done = row.starts[:-1].tolist()
        for phase in range(row.phases):
            for change in [one for stop in row.stops if stop.phase == phase for one in stop.tubes]:
                loaded[change.head, change.tube] = change.yarn
            for head in range(setup.heads):
                for knot in range(done[head], done[head] + int(row.counts[head, phase])):
                    times[number, row.columns[knot]] += 1
                    yarns[number, row.columns[knot]] = loaded[head, row.tubes[knot]]
                done[head] += int(row.counts[head, phase])
    return times, yarns


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("seed", range(200))
def test_every_knot_of_a_shaped_order_is_tied_once_and_none_outside(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    chart = random_chart(rng, [*SHAPES, "rectangle"][seed % (len(SHAPES) + 1)])
    setup, programme = compiled(rng, chart)
    made, expected = CompiledProgramme(setup, programme), chart.knots[::-1]
    write_programme(tmp_path / "a.ilmek", made)
    write_programme_text(tmp_path / "a.txt", made)
    with open_programme(tmp_path / "a.ilmek") as read, open_programme_text(tmp_path / "a.txt") as text:
        assert read.digest == text.digest == made.digest
        assert read.totals.knots == chart.tally().knots
        assert read.totals.counts == chart.counts
        proof = prove(read)
        times, yarns = woven_by_hand(read)
    assert proof.ok, proof.faults[:3]
    assert proof.totals.knots == setup.knots == chart.tally().knots
    assert proof.totals.time / 1e9 == pytest.approx(programme.duration, abs=1e-3)
    assert programme.bound <= programme.duration * (1 + 1e-9)
    assert broken_rules(made) == []
    assert np.array_equal(times, expected != NO_KNOT)
    assert np.array_equal(yarns, np.where(expected == NO_KNOT, EMPTY, expected))
    result = compare(woven_by_twin(made), made)
    assert result.complete
    assert result.digest == chart_digest(made)
