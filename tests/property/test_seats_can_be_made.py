"""Whether seats of the default loom can be made with stock reamers, and nuts bear on what they press."""

import numpy as np
from default_machines import default_design

from ilmek.elements.locknuts import locknut_of
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.meetings import meetings
from ilmek.part.shapes import Prism
from ilmek.plane.contours import along
from ilmek.units import mm

STEP = 0.1 * mm
"""Of the diameters of seats up to 10 mm; those beyond are bored."""


def test_small_seats_have_the_diameters_of_stock_reamers() -> None:
    sizes = {
        (meeting.bore.part.id, meeting.inner.part.id): meeting.bore.feature.size
        for meeting in meetings(loom_tree(default_design("automated-loom")))
        if not meeting.bore.feature.square and meeting.bore.feature.size < 10 * mm
    }
    assert len(sizes) > 20
    odd = {pair: size for pair, size in sizes.items() if abs(size / STEP - round(size / STEP)) > 1e-6}
    assert odd == {}


def test_a_locknut_bears_all_round_on_what_it_presses() -> None:
    tree = loom_tree(default_design("automated-loom"))
    parts = {part.id: part for part, _ in tree.occurrences()}
    nuts = {name: row for name, part in parts.items() if part.purchase and (row := locknut_of(part.purchase.row))}
    assert nuts
    rings = [part for part in parts.values() if "pressure-ring" in part.id]
    assert rings
    for ring in rings:
        assert isinstance(ring.shape, Prism)
        bore = max(float(np.abs(along(hole, 1e-5)).max()) for hole in ring.shape.section.holes)
        assert all(2 * bore < row.outer - 4 * mm for row in nuts.values())
