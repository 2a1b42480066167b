"""Holes of the sheets of a loom against its solids: each in the table and in a view, where it is, in which pieces.

Sheets are read as DXF files by ezdxf, solids by the kernel; the pieces of a part by where the screws of the tree are.
"""

import re
from collections import Counter
from functools import cache
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from effort import share_of
from sheet_judge import Bore, bores, corners_of, drawn_sheet, made_parts

from ilmek.elements.materials import find_material
from ilmek.io.drawings.dxf import write_sheet_dxf
from ilmek.io.step import part_solid
from ilmek.part.blanks import MILLED, blanks_of, size_of, sold_as
from ilmek.part.bolt_holes import _with_threads
from ilmek.part.bolting import bolted
from ilmek.part.features import drillings, features_of_size
from ilmek.part.guided_widths import guided_widths
from ilmek.part.hole_kinds import hole_kinds
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.shapes import Drilling, Prism, bar, box, shape_box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.units import mm
from ilmek.viz.drawings.drawn_part import DrawnPart

ROUNDED = 6e-3
"""Deviation of a coordinate to 0.01 mm [mm]."""

SHARE = 6
"""One sheet in so many is drawn in `make test`, all in a campaign."""


@cache
def parts(machine: str = "automated-loom") -> tuple[tuple[DrawnPart, Part], ...]:
    return tuple(made_parts(machine))


def rows_of(file: Path) -> tuple[list[tuple[str, ...]], list[str]]:
    """The rows of the hole tables of a sheet, by what stands beside each other, and all its texts."""
    texts = list(ezdxf.readfile(file).modelspace().query("TEXT"))
    places = {(round(own.dxf.insert.y, 2), own.dxf.insert.x): own.dxf.text for own in texts}
    lines: dict[float, list[str]] = {}
    for (y, _), words in sorted(places.items(), key=lambda own: (-own[0][0], own[0][1])):
        lines.setdefault(y, []).append(words)
    rows = []
    for words in lines.values():
        for start, word in enumerate(words):
            if re.fullmatch(r"H\d+", word) and len(words) > start + 5 and words[start + 4][1:] in ("X", "Y", "Z"):
                rows.append(tuple(words[start : start + 6]))
    return rows, [own.dxf.text for own in texts]


def lies_on(row: tuple[str, ...], datum: np.ndarray, inner: list[Bore]) -> bool:
    """Whether a row's mouth is on the axis of a cylinder of its narrowest diameter, in its direction."""
    at = np.array([float(value) for value in row[1:4]]) + datum
    along = np.eye(3)["XYZ".index(row[4][1])]
    first = re.match(r"[⌀M]([\d.]+)", row[5])
    assert first is not None, row
    away = [
        np.abs(np.cross(own.point - at, along)).max() for own in inner if abs(own.diameter - float(first[1])) < 1e-3
    ]
    return min(away, default=np.inf) < ROUNDED


def test_every_drilled_hole_has_its_row_and_its_name_in_a_view(tmp_path: Path) -> None:
    seen = 0
    drilled = [own for own in parts() if drillings(own[0].shape)]
    for drawn, source in share_of(drilled, SHARE, "rows"):
        file = tmp_path / "sheet.dxf"
        sheet = drawn_sheet(drawn)
        write_sheet_dxf(file, sheet)
        rows, texts = rows_of(file)
        names = Counter(texts)
        names[sheet.paper] -= 1
        assert len(rows) >= len(drillings(drawn.shape)), drawn.number
        assert all(names[row[0]] >= 2 for row in rows), (drawn.number, [row for row in rows if names[row[0]] < 2])
        assert len({row[0] for row in rows}) == len(rows), drawn.number
        assert {"X", "Y", "Z"} <= names.keys(), drawn.number
        solid = part_solid(source)
        inner, low = bores(solid), corners_of(solid)[0]
        corners = [low, *(np.array([*own.point[:2], low[2]]) for own in inner if abs(own.axis[2]) > 0.9)]
        assert any(all(lies_on(row, datum, inner) for row in rows) for datum in corners), drawn.number
        seen += len(rows)
    assert seen
    assert sum(len(drillings(own[0].shape)) for own in drilled) > 250


def test_no_hole_is_drilled_deeper_than_a_drill_reaches() -> None:
    """Longer bores are those of tubes; a counterbore is no deeper than six of its diameters."""
    for _, part in parts():
        for feature in features_of_size(part.shape):
            drilled = feature.inside and not feature.square and part.process not in {"steel tube", "welded frame"}
            assert not drilled or feature.length <= 20 * feature.size, (part.id, feature.size)
        sunk = (hole.steps[0] for hole in drillings(part.shape) if len(hole.steps) > 1)
        assert all(deep <= 6 * wide for wide, deep in sunk), part.id


def test_slots_and_what_slides_in_them_have_one_size_and_a_fit() -> None:
    widths = {source.id: [*guided_widths(drawn.features)] for drawn, source in parts()}
    slots = {zone.nominal for zone in (zone for own in widths.values() for slot, zone in own if slot)}
    followers = {name: own for name, own in widths.items() if name.endswith("-follower")}
    assert len(followers) == 6
    for name, own in followers.items():
        assert [slot for slot, _ in own] == [False], name
        assert {zone.nominal for _, zone in own} <= slots, name


def test_the_same_part_with_a_hole_elsewhere_is_seen(tmp_path: Path) -> None:
    drawn, source = next(own for own in parts() if own[0].number == "automated-loom/guide-bar")
    write_sheet_dxf(tmp_path / "bar.dxf", drawn_sheet(drawn))
    rows, _ = rows_of(tmp_path / "bar.dxf")
    solid = part_solid(source)
    low = corners_of(solid)[0]
    assert all(lies_on(row, low, bores(solid)) for row in rows)
    assert not any(lies_on(row, low + 0.02, bores(solid)) for row in rows)


def test_threads_are_called_with_their_depth_and_core(tmp_path: Path) -> None:
    threaded = [drawn for drawn, _ in parts() if any(own.kind.value == "thread" for own in drawn.features)]
    for drawn in share_of(threaded, SHARE, "threads"):
        file = tmp_path / "sheet.dxf"
        write_sheet_dxf(file, drawn_sheet(drawn))
        space = ezdxf.readfile(file).modelspace()
        words = [own.dxf.text for own in (*space.query("TEXT"), *space.query("DIMENSION"))]
        for own in drawn.features:
            call = rf"M{own.nominal * 1e3:g} - 6H( × [\d.]+)? / ⌀[\d.]+( × [\d.]+)?"
            called = any(re.search(call, text) for text in words)
            assert own.kind.value != "thread" or called, (drawn.number, own.nominal)


def test_a_hole_is_in_the_pieces_that_have_its_screw() -> None:
    """Two bars, and a plate on one of them alone."""
    steel = find_material("structural steel")
    post = Part("probe/post", "post", "machined link", box(30 * mm, 30 * mm, 200 * mm), steel)
    plate = Part("probe/plate", "plate", "machined link", box(30 * mm, 60 * mm, 8 * mm), steel)
    both = Occurrence(post, (placement(), placement(x=0.5)))
    on_first = Occurrence(plate, (placement(z=200 * mm),))
    (kinds,) = hole_kinds(bolted(Tree((RigidBody("frame", (both, on_first)),)))).values()
    assert kinds.pieces == (1, 1)
    assert {len(own) for own in kinds.holes} == {1}
    assert not hole_kinds(bolted(Tree((RigidBody("frame", (replace_positions(both), on_first)),))))


def replace_positions(own: Occurrence) -> Occurrence:
    """The first piece alone."""
    return Occurrence(own.part, own.positions[:1])


def test_stock_is_what_is_sold_and_holds_the_part() -> None:
    """Sheets and lists have one size and one designation, of a standard for that form; edges to mill have allowance."""
    for drawn, part in parts():
        blanks = blanks_of(part)
        assert drawn.material == sold_as(part)
        if not drawn.bent:
            assert drawn.size in {size_of(part), ""}, drawn.number
        for blank in blanks:
            name = sold_as(part)
            assert ("10219" in name) == (blank.form == "hollow section" and "S235" in name), drawn.number
            assert not (blank.form in {"round", "tube"} and blank.section[0] < 0.1 and "10025" in name), drawn.number
            assert not (min(blank.section) < 2 * mm and "10083" in name), drawn.number
        if part.process in MILLED and isinstance(part.shape, Prism):
            sides = sorted(np.ptp(np.array(shape_box(part.shape)), axis=0))
            assert min(np.array(blanks[0].sides) - sides[1:]) > 3 * mm, drawn.number


@pytest.mark.parametrize("bored", [False, True])
def test_a_pin_is_cut_from_its_bar_bored_or_not(bored: bool) -> None:
    hole = Drilling(placement(), ((3 * mm, 6 * mm),))
    pin = bar(8 * mm, 50 * mm)
    shape = pin if not bored else with_bore(hole)
    part = Part("probe/pin", "pin", "turned part", shape, find_material("heat-treatable steel"))
    assert size_of(part) == "round 8 mm, 52 mm"


def with_bore(hole: Drilling) -> object:
    """A pin with a blind hole in its end."""
    return _with_threads(bar(8 * mm, 50 * mm), [hole])
