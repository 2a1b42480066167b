"""The assembly manual of a machine: what comes in which order, from where, past what stands; screws, torques, pictures.

The order and the moves are those of `part.insertion`.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby

import numpy as np

from ilmek.elements.machine_screws import screw_of
from ilmek.part.assemblies import machine_of
from ilmek.part.contacts import joined_by
from ilmek.part.fastenings import fastenings
from ilmek.part.insertion import Insertion
from ilmek.part.insertion_units import Direction, InsertedUnit
from ilmek.part.part import Part
from ilmek.part.part_lists import FASTENER
from ilmek.part.poses import chains
from ilmek.part.projection import PieceOutline, View, outlines
from ilmek.part.stacks import StackPiece, StackRun
from ilmek.part.straight_moves import Vector
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.report import Check, Column, Drawing, Paper, PaperSection, Stroke, Table, at_most
from ilmek.sentences import Sentence, joined
from ilmek.units import format_quantity

MOST_CURVES = 400
"""Most outlines of a picture: the largest; a smaller one would be a spot."""


UP = np.array([0.0, 1.0, 0.0])
"""From the floor, from below which nothing comes."""


@record
class AssemblyStep:
    """A row of the manual: what comes, of which bodies, by which moves, onto what.

    parts  how many of each come      moves  directions by which each comes, in turn; none: it stands, or comes built
    onto   bodies that it touches     built  how many come whose parts came on the bench, in the steps before; 0: parts
    stack  the order of parts that alternate along an axis
    """

    bodies: tuple[str, ...]
    parts: Mapping[Part, int]
    moves: tuple[tuple[Direction, ...], ...]
    onto: tuple[str, ...]
    built: int = 0
    stack: tuple[StackRun, ...] = ()

    @property
    def mass(self) -> float:
        """Mass of what comes [kg]."""
        return math.fsum(number * part.mass for part, number in self.parts.items() if not math.isnan(part.mass))


def assembly_check(steps: Sequence[Insertion]) -> Check:
    """Whether all that comes can reach its seat past what stands, at the machine and on the bench."""
    held = [step for step in _every(steps) if step.blocking]
    named = (f"{_names(step.units)} by {_names(step.blocking)}" for step in held[:3])
    parts = (piece.part.id for step in held for unit in step.units for piece in unit.pieces[:1])
    source = "; ".join(named) or "straight moves past all that stands"
    check = at_most("assembly: parts that cannot reach their seats", len(held), 0, "1", source)
    return check.with_cure("leave room for it, or bolt what blocks it", *dict.fromkeys(parts))


def fastening_check(screwed: Tree) -> Check:
    """Whether a weld, screw, key or fit, its neighbours or its own means hold each part of a tree with its screws."""
    loose, titles = fastenings(screwed).loose, {part.id: part.title for part, _ in screwed.occurrences()}
    source = "; ".join(dict.fromkeys(titles[name] for name in loose)) or "welds, screws, keys, fits, neighbours"
    check = at_most("assembly: parts without a fastening", len(loose), 0, "1", source)
    return check.with_cure("screw, weld, key or press in the parts named", *loose)


def _every(steps: Sequence[Insertion]) -> Iterator[Insertion]:
    for step in steps:
        yield step
        yield from _every(step.bench)


def _names(units: Sequence[InsertedUnit]) -> str:
    return " and ".join(dict.fromkeys(unit.pieces[0].part.title for unit in units[:3]))


def assembly_steps(steps: Sequence[Insertion]) -> Iterator[AssemblyStep]:
    """The rows of steps, those on the bench before; like parts of a body that come one after the other in one."""
    return _rows(steps, _benches(steps))


def _benches(steps: Sequence[Insertion]) -> dict[str, tuple[Insertion, ...]]:
    """By what comes built how it is put together: bodies that are there several times are so once."""
    benches: dict[str, tuple[Insertion, ...]] = {}
    for step in steps:
        benches |= _benches(step.bench)
        if step.bench:
            benches[_alike(step)[1]] = step.bench
    return benches


def _rows(steps: Sequence[Insertion], benches: dict[str, tuple[Insertion, ...]]) -> Iterator[AssemblyStep]:
    for (bodies, name, simple), some in groupby(steps, key=_alike):
        alike = tuple(some)
        onto = tuple(dict.fromkeys(unit.name for step in alike for unit in step.onto))
        moves = tuple(dict.fromkeys(tuple(map(_direction, step.moves)) for step in alike if step.moves))
        counted = Counter[Part]()
        for step in alike:
            for unit in step.units:
                counted.update(unit.parts)
        if not simple:
            yield from _rows(benches.pop(name, ()), benches)
        stack = alike[0].units[0].stack if simple else ()
        yield AssemblyStep(bodies, counted, moves, onto, 0 if simple else len(alike), stack)


def _alike(step: Insertion) -> tuple[tuple[str, ...], str, bool]:
    """What steps of one row have in common: bodies, part or group of them, and whether nothing was built before."""
    first = step.units[0]
    alone = len(step.units) == 1 and (len(first.parts) == 1 or bool(first.stack))
    bodies = tuple(dict.fromkeys(unit.name for unit in step.units))
    return bodies, first.pieces[0].part.id if alone else "+".join(bodies), alone


def _direction(move: Vector) -> Direction:
    """Direction of a move, rounded."""
    return tuple((move / np.linalg.norm(move)).round(2).tolist())


def _with_screws(steps: Iterable[AssemblyStep], tree: Tree) -> tuple[AssemblyStep, ...]:
    """The rows with the screws of fixed joints: each comes with the second of the parts that it joins."""
    rows, come = list(steps), dict[str, int]()
    for number, step in enumerate(rows):
        for part in () if step.built else step.parts:
            come.setdefault(part.id, number)
    screws: dict[int, dict[Part, int]] = defaultdict(dict)
    for part, pieces in tree.occurrences():
        if part.joins and part.purchase:
            screws[max(come.get(name, 0) for name in part.joins)][part] = pieces
    return tuple(replace(step, parts={**step.parts, **screws[number]}) for number, step in enumerate(rows))


def tree_manual(tree: Tree, steps: Sequence[Insertion], view: View, screwed: Tree) -> Paper:
    """A section for the rows of each machine that follow each other, with a picture from a side and its steps.

    screwed  the tree with the screws of its fixed joints, which the steps are without
    """
    seen, standing = outlines(tree, view), set[str]()
    fasteners = frozenset(part.id for part, _ in screwed.occurrences() if part.process == FASTENER)
    titles = {part.id: part.title for part, _ in screwed.occurrences()}
    joins = {name: [titles[one] for one in own] for name, own in joined_by(screwed, fasteners).items()}
    sections = [PaperSection(Sentence("manual.order"), (Sentence("manual.order-how"),))]
    last = (links[-1] for links in chains(tree))
    machines = {link.name: machine_of(link.body) for link in last if link.body.occurrences}
    numbered = enumerate(_with_screws(assembly_steps(steps), screwed), 1)
    for machine, grouped in groupby(numbered, key=lambda row: machines[row[1].bodies[0]]):
        rows = tuple(grouped)
        coming = {body for _, step in rows for body in step.bodies}
        sections.append(_section(machine, rows, joins, _picture(seen, standing, coming, _CAPTIONS[view])))
        sections += [_stack_section(number, step.stack) for number, step in rows if step.stack]
        standing |= coming
    return Paper("assembly-manual", Sentence("manual.title"), Sentence("manual.lead"), tuple(sections))


def _stack_section(number: int, stack: Sequence[StackRun]) -> PaperSection:
    """The order along their axis of the parts of a step: a row for each run."""
    title = Sentence("manual.stack", step=str(number))
    heads = Column(Sentence("manual.times")), Column(Sentence("manual.run"))
    rows = tuple((run.times, "; ".join(map(_stacked, run.pieces))) for run in stack)
    return PaperSection(title, (Sentence("manual.stack-how"),), Table(f"stack-{number}", title, heads, rows))


def _stacked(piece: StackPiece) -> str:
    part, angle = piece
    return f"{part.title}, {format_quantity(angle, 'deg', 3)}" if angle else part.title


def _section(
    machine: str, steps: Sequence[tuple[int, AssemblyStep]], joins: Mapping[str, Sequence[str]], picture: Drawing
) -> PaperSection:
    first, last = str(steps[0][0]), str(steps[-1][0])
    title = Sentence("manual.machine", machine=machine.replace("-", " "), first=first, last=last)
    heads = (
        Column(Sentence("manual.step")),
        Column(Sentence("manual.body")),
        Column(Sentence("manual.onto")),
        Column(Sentence("manual.moves")),
        Column(Sentence("manual.comes")),
        Column(Sentence("manual.mass"), "kg", 3),
        Column(Sentence("manual.tighten")),
        Column(Sentence("manual.joins")),
    )
    table = Table("steps", title, heads, tuple(_row(number, step, joins) for number, step in steps))
    return PaperSection(title, (picture.title,), table, boxes=True, figure=picture)


def _row(number: int, step: AssemblyStep, joins: Mapping[str, Sequence[str]]) -> tuple[float | int | str, ...]:
    parts = {} if step.built else step.parts
    fasteners = [part for part in parts if part.process == FASTENER]
    named = [f"{parts[part]} × {part.title}" for part in parts if part.process != FASTENER]
    return (
        number,
        ", ".join(body.rpartition("/")[2] for body in step.bodies),
        ", ".join(one.rpartition("/")[2] for one in step.onto),
        _from(step),
        Sentence("manual.built", count=str(step.built)) if step.built else "; ".join(named),
        step.mass,
        "; ".join(_tightened(part, parts[part]) for part in fasteners),
        "; ".join(", ".join(joins[part.id]) for part in fasteners),
    )


def _from(step: AssemblyStep) -> str:
    """From where it comes, in words."""
    words = [_in_turn([_FROM.get(move, Sentence("manual.slanting")) for move in moves]) for moves in step.moves]
    text = ""
    for word in dict.fromkeys(words):
        text = joined(text, word)
    return text


def _in_turn(words: Sequence[str]) -> str:
    first, *others = words
    for other in others:
        first = Sentence("manual.then-from", first=first, second=other)
    return first


def _tightened(part: Part, number: int) -> str:
    """A screw with its torque, or a key."""
    assert part.purchase is not None
    screw = screw_of(part.purchase.row)
    torque = "" if screw is None else f", {format_quantity(screw.torque, 'Nm', 3)}"
    return f"{number} × {part.purchase.row}{torque}"


def _picture(seen: Sequence[PieceOutline], standing: set[str], coming: set[str], caption: str) -> Drawing:
    """What stands, dashed, and what comes, in bold lines: the largest outlines of both."""
    shown = sorted((own for own in seen if own.body in standing | coming), key=_extent, reverse=True)[:MOST_CURVES]
    strokes = [
        Stroke(curve, "outline" if own.body in coming else "construction", closed=True)
        for own in sorted(shown, key=lambda own: own.body in coming)
        for curve in own.curves
    ]
    return Drawing("assembly", caption, tuple(strokes), unit="mm")


def _extent(outline: PieceOutline) -> float:
    return max(float(abs(curve - outline.middle).max()) for curve in outline.curves)


_FROM: dict[Direction, str] = {
    (-1.0, 0.0, 0.0): Sentence("manual.from-right"),
    (1.0, 0.0, 0.0): Sentence("manual.from-left"),
    (0.0, -1.0, 0.0): Sentence("manual.from-above"),
    (0.0, 1.0, 0.0): Sentence("manual.from-below"),
    (0.0, 0.0, -1.0): Sentence("manual.from-front"),
    (0.0, 0.0, 1.0): Sentence("manual.from-rear"),
}
"""Moves in words: x to the weaver's right, y up, z to the front."""

_CAPTIONS = {
    View.SIDE: Sentence("manual.picture"),
    View.FRONT: Sentence("joint.from-front"),
    View.TOP: Sentence("joint.from-top"),
}
