"""Edited programmes: the proof agrees with the rules in plain Python, and no edited line of a text goes unseen."""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from edited_programme import EditedProgramme, edited, part_of, with_knot, with_knot_twice, without_knot
from effort import examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from plain_proof import broken_rules
from small_programme import small_programme

from ilmek.errors import LoomError
from ilmek.io.any_programme import open_any_programme
from ilmek.io.programme_text import programme_text_parts
from ilmek.jobs.check import check_programme
from ilmek.loom.operations import RowEnd, RowOperations, Stop, TubeChange
from ilmek.loom.proof import prove


def exchanged(row: RowOperations, one: int, other: int) -> RowOperations:
    order = np.arange(len(row.columns))
    order[[one, other]] = order[[other, one]]
    return replace(row, columns=row.columns[order], tubes=row.tubes[order])


def moved(row: RowOperations, index: int, head: int, phase: int) -> RowOperations:
    """A row with a knot tied by the last of another head and phase."""
    less = without_knot(row, index)
    counts = less.counts.copy()
    counts[head, phase] += 1
    at = int(np.cumsum(counts.ravel())[head * row.phases + phase]) - 1
    columns, tubes = np.insert(less.columns, at, row.columns[index]), np.insert(less.tubes, at, row.tubes[index])
    return replace(less, columns=columns, tubes=tubes, counts=counts)


@st.composite
def edited_programmes(draw: st.DrawFn) -> EditedProgramme:
    heads, columns = draw(st.integers(1, 3)), draw(st.integers(6, 14))
    programme = small_programme(draw(st.integers(3, 5)), columns, heads, 3, seed=draw(st.integers(0, 99)), weft_rows=2)
    row = programme.operations(number := draw(st.integers(0, programme.setup.rows - 1)))
    index, other = draw(st.integers(0, columns - 1)), draw(st.integers(0, columns - 1))
    head, phase = draw(st.integers(0, heads - 1)), draw(st.integers(0, row.phases - 1))
    tube, length = draw(st.integers(0, 2)), draw(st.sampled_from([0.04, 0.1, 0.12, 9.0]))
    edits = {
        "column": with_knot(row, index, column=other),
        "tube": with_knot(row, index, tube=tube),
        "without": without_knot(row, index),
        "twice": with_knot_twice(row, index),
        "exchanged": exchanged(row, index, other),
        "moved": moved(row, index, head, phase),
        "no stops": replace(row, stops=()),
        "package": replace(row, stops=(Stop(number, phase, (), (TubeChange(head, tube, other % 3, length),)),)),
        "bobbins": replace(row, stops=(Stop(number, phase, draw(st.sampled_from([(0,), (1,), (0, 1), (0, 0)]))),)),
        "ends": replace(row, ends=tuple(draw(st.permutations(list(RowEnd))))),
        "fewer ends": replace(row, ends=row.ends[: draw(st.integers(0, 4))]),
    }
    changed = edits[draw(st.sampled_from(sorted(edits)))]
    packages = np.full((heads, 3), draw(st.sampled_from([0.2, 0.4, 1000.0])))
    return edited(programme, number, lambda _: changed, packages=packages, spacing=draw(st.integers(1, 4)))


@examples(70)
@given(edited_programmes())
def test_the_proof_agrees_with_the_plain_rules(programme: EditedProgramme) -> None:
    proof = prove(programme)
    broken = broken_rules(programme)
    assert proof.ok == (not broken), (proof.faults, broken)


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_what_is_compiled_is_proved(data: st.DataObject) -> None:
    """With fewer tubes than yarns, and packages that end within the carpet."""
    heads, yarns = data.draw(st.integers(1, 4)), data.draw(st.integers(2, 7))
    sizes = data.draw(st.integers(3, 12)), data.draw(st.integers(max(3, 2 * heads), 40))
    supply = {"tubes": data.draw(st.integers(1, yarns)), "package": data.draw(st.sampled_from([1.6, 2.5, 1000.0]))}
    seeds = {"seed": data.draw(st.integers(0, 999)), "weft_rows": data.draw(st.integers(1, 5))}
    try:
        programme = small_programme(*sizes, heads, yarns, **seeds, **supply)
    except LoomError as error:
        assume("tubes of a head" not in str(error))
        raise
    proof = prove(programme)
    assert proof.faults == ()
    assert broken_rules(programme) == []


def edited_texts(text: str) -> Iterator[tuple[int, str]]:
    """Texts with one line of a row left out, given twice, or with one number more or less, and that line."""
    lines = text.splitlines(keepends=True)
    first = lines.index("row 1\n")
    for at in range(first, len(lines)):
        yield at + 1, "".join(lines[:at] + lines[at + 1 :])
        yield at + 1, "".join([*lines[: at + 1], *lines[at:]])
        for found in re.finditer(r"\d+", lines[at]):
            for number in (int(found.group()) - 1, int(found.group()) + 1):
                line = lines[at][: found.start()] + str(number) + lines[at][found.end() :]
                yield at + 1, "".join([*lines[:at], line, *lines[at + 1 :]])


def test_no_edited_line_goes_unseen(tmp_path: Path) -> None:
    programme = edited(
        small_programme(3, 12, 2, 2, weft_rows=2), 1, lambda row: replace(row, stops=(Stop(1, 1, (), CHANGES),))
    )
    assert prove(programme).ok
    text, file, seen = b"".join(programme_text_parts(programme)).decode(), tmp_path / "p.txt", Counter[str]()
    for line, other in edited_texts(text):
        file.write_text(other)
        outcome = outcome_of(file)
        assert outcome, (line, other.splitlines()[line - 1])
        seen[outcome] += 1
    assert min(seen[outcome] for outcome in ("refused", "named", "harmless")) > 0
    assert seen["named"] > 50


def outcome_of(file: Path) -> str:
    """What becomes of an edited text; "": its fault goes unseen."""
    try:
        found = check_programme(file)
        if not found.ok:
            return "named" if all(error.line > 0 for error in found.errors) else ""
        with open_any_programme(file) as opened:
            return "" if broken_rules(opened) else "harmless"
    except LoomError as error:
        return "refused" if re.match(rf"{re.escape(str(file))}, line \d+: ", str(error)) else ""


CHANGES = (TubeChange(0, 0, 0, 1.5), TubeChange(1, 1, 1, 2.5))


@pytest.mark.parametrize("knots", [1, 5])
def test_every_knot_that_is_left_out_or_tied_twice_is_seen(knots: int) -> None:
    programme = small_programme(3, 12, 2, 2)
    for number in range(3):
        for index in range(0, 12, knots):
            for edit in (without_knot, with_knot_twice):
                assert not prove(edited(programme, number, lambda row, edit=edit, at=index: edit(row, at))).ok
    assert part_of(programme.operations(0), 0) == (0, 0)
