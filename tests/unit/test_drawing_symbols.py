"""Symbols on sheets, judged by a reader that knows only standards: rectangles, lines and texts of the DXF, by ezdxf."""

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing

from ilmek.jobs.design import design_machine
from ilmek.jobs.workshop_order import WorkshopOrder
from ilmek.machines.catalogue import find_machine
from ilmek.part.tolerances import Characteristic, ToleratedFeature
from ilmek.part.tolerancing import tolerances_of

pytest.importorskip("OCP")


def polylines(document: Drawing, layer: str) -> list[np.ndarray]:
    """Points of the lines of a layer [mm]."""
    lines = document.modelspace().query(f"LWPOLYLINE[layer=='{layer}']")
    return [np.array(line.get_points("xy")) for line in lines]


def texts_in(document: Drawing, low: np.ndarray, high: np.ndarray) -> list[str]:
    """Texts with their middle in a rectangle, from the left."""
    inside = []
    for text in document.modelspace().query("TEXT"):
        foot = text.get_placement()[1]
        at = np.array([foot.x, foot.y + text.dxf.height / 2])
        if ((low < at) & (at < high)).all():
            inside.append((at[0], text.dxf.text))
    return [words for _, words in sorted(inside)]


def frames(document: Drawing) -> Iterator[tuple[Characteristic, str, tuple[str, ...]]]:
    """Feature control frames: boxes 5 mm high that begin with a symbol, and the texts of their cells."""
    lines = polylines(document, "TOLERANCE")
    for box in lines:
        low, high = box.min(0), box.max(0)
        if len(box) != 4 or abs(high[1] - low[1] - 5) > 1e-6 or high[0] - low[0] < 10:
            continue
        cell = low, np.array([low[0] + 6, high[1]])
        drawn = [one for one in lines if (one.min(0) > cell[0]).all() and (one.max(0) < cell[1]).all()]
        zone, *datums = texts_in(document, low, high)
        yield symbol(drawn), zone, tuple(datums)


def symbol(drawn: list[np.ndarray]) -> Characteristic:
    """What the lines of a symbol stand for; ISO 1101: a parallelogram, a circle with lines, one or two arrows."""
    if len(drawn) == 1:
        return Characteristic.FLATNESS
    if not any(len(line) > 8 for line in drawn):
        return Characteristic.RUN_OUT if len(drawn) == 2 else Characteristic.TOTAL_RUN_OUT
    straight = [np.diff(line, axis=0)[0] for line in drawn if len(line) == 2]
    crossing = abs(straight[0] @ straight[1]) < 1e-9
    return Characteristic.POSITION if crossing else Characteristic.CYLINDRICITY


def datum_letters(document: Drawing) -> list[str]:
    """Letters in boxes of 5 by 5 mm below a triangle."""
    lines = polylines(document, "TOLERANCE")
    triangles = [line for line in lines if len(line) == 3]
    letters = []
    for box in lines:
        low, high = box.min(0), box.max(0)
        over = [
            t for t in triangles if abs(t[:, 0].mean() - (low + high)[0] / 2) < 0.1 and 0 < t[:, 1].min() - high[1] < 4
        ]
        if len(box) == 4 and np.allclose(high - low, 5) and over:
            letters += texts_in(document, low, high)
    return letters


def stated(features: tuple[ToleratedFeature, ...]) -> set[tuple[Characteristic, str, tuple[str, ...]]]:
    """Geometric tolerances of a part's features, as frames have them."""
    every = (limit for feature in features for limit in feature.geometric)
    return {
        (one.characteristic, f"{'⌀' if one.round else ''}{f'{one.value * 1e3:.3f}'.rstrip('0')}", one.datums)
        for one in every
    }


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("name", ["beat-up", "warp-tension", "weaver", "hammer"])
def test_control_frames_and_datums_are_drawn_at_their_features(name: str, tmp_path: Path) -> None:
    design_machine(name, {}, WorkshopOrder(tmp_path / "parts"), illustrated=False)
    machine = find_machine(name)
    tree = machine.tree(machine.design(machine.params.read({})))
    kinds: Counter[Characteristic] = Counter()
    for part, features in tolerances_of(tree).items():
        file = tmp_path / "parts" / f"{part.rpartition('/')[2]}.sheet.dxf"
        if not file.is_file():
            continue
        document = ezdxf.readfile(file)
        drawn = list(frames(document))
        assert set(drawn) == stated(features), part
        assert sorted(datum_letters(document)) == sorted({f.datum for f in features if f.datum}), part
        kinds.update(kind for kind, *_ in drawn)
        for roughness in re.findall(r"Ra [\d.]+", " ".join(t.dxf.text for t in document.modelspace().query("TEXT"))):
            assert polylines(document, "TEXTURE"), roughness
    assert kinds
