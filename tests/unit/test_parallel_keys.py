"""Keys: pressure by hand, grooves that leave the key no room to turn, ends in list and space, ends that fail."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.parallel_keys import LONGEST, keyed_end, lengths_of
from ilmek.errors import ParameterError
from ilmek.machines.shedding import MACHINE as SHEDDING
from ilmek.machines.shedding import SheddingParams
from ilmek.machines.shedding.tree import tree as shedding_tree
from ilmek.machines.warp_tension import MACHINE as TENSION
from ilmek.machines.warp_tension import WarpTensionParams
from ilmek.machines.warp_tension.cylinders import cylinders
from ilmek.machines.warp_tension.tree import tree as tension_tree
from ilmek.part import catalogue
from ilmek.part.bill import bill
from ilmek.part.placement import IDENTITY
from ilmek.part.tree import Tree


@given(st.floats(0.008, 0.1), st.floats(1.0, 900.0))
def test_the_shortest_key_that_bears_the_torque(diameter, torque) -> None:
    """The force at the shaft's surface, on the flank beyond the groove; the next shorter key would not bear it."""
    end = keyed_end(diameter, torque, 490e6)
    row = end.keyway
    flank = (row.height - row.in_shaft) * end.length
    assert end.pressure == pytest.approx(torque / (diameter / 2) / flank / (1.5 if end.number == 2 else 1))
    assert end.length in lengths_of(row)
    assert end.length <= LONGEST * diameter
    shorter = [length for length in lengths_of(row) if length < end.length]
    if shorter and end.number == 1:
        assert end.pressure * end.length / shorter[-1] > end.allowed
    check = end.check("shaft", "set another", ())
    of_size = 490e6 if diameter <= 0.016 else 430e6 if diameter <= 0.040 else 370e6  # C45 +QT, EN 10083-2
    assert check.ok == (end.pressure <= of_size / 1.5)


@given(st.floats(0.008, 0.1), st.sampled_from((1, 2)))
def test_shaft_and_key_fill_what_the_groove_takes(diameter, number) -> None:
    """Area of the grooved section by a grid of points; the key's foot stands on the groove's ground."""
    end = replace(keyed_end(diameter, 1.0, 490e6), number=number)
    row = end.keyway
    x, y = np.meshgrid(*(np.linspace(-diameter / 2, diameter / 2, 801),) * 2)
    inside = np.hypot(x, y) < diameter / 2
    groove = ((x if number == 1 else np.abs(x)) > diameter / 2 - row.in_shaft) & (np.abs(y) < row.width / 2)
    area = (inside & ~groove).sum() / 800**2 * diameter**2
    assert catalogue.keyed_journal(end).volume / end.length == pytest.approx(area, rel=5e-3)
    keys = catalogue.keys("key", "key", end, IDENTITY)
    assert len(keys.positions) == number
    assert keys.part.shape is not None
    assert keys.part.shape.volume == pytest.approx(row.width * row.height * end.length)
    assert row.in_shaft + row.in_hub >= row.height


@pytest.mark.parametrize("diameter", [0.005, 0.2])
def test_no_key_outside_the_table(diameter) -> None:
    with pytest.raises(ParameterError, match="no parallel key"):
        keyed_end(diameter, 10.0, 490e6)


def keys_of(tree: Tree) -> list[int]:
    """Numbers of keys of the ends."""
    return [len(one.positions) for body in tree.bodies for one in body.occurrences if "key" in one.part.title]


def test_every_driven_end_has_its_key_in_the_list() -> None:
    shed = SHEDDING.design(SheddingParams(shafts=2, front_span=0.5, back_span=0.6))
    warp = TENSION.design(WarpTensionParams())
    cams, drives = [shaft.driven_end for shaft in shed.shafts], [one.driven_end for one in cylinders(warp)]
    assert (len(cams), len(drives)) == (2, 3)
    for tree, ends in ((shedding_tree(shed), cams), (tension_tree(warp), drives)):
        assert sorted(keys_of(tree)) == sorted(end.number for end in ends)
        lines = [line for line in bill(tree) if line.name.startswith("key of")]
        assert sum(line.number for line in lines) == sum(keys_of(tree))
        assert all(line.description.startswith("DIN 6885-1 B ") for line in lines)


def test_a_thin_journal_has_no_key_that_bears_its_torque() -> None:
    report = SHEDDING.report(SHEDDING.design(SheddingParams(bearing="UCF 204")))
    key = next(check for check in report.checks if check.name == "key of the cam shaft")
    assert not key.ok
    assert key.cure
