"""The assembly manual of a machine: what comes in which order, from where, past what stands; screws, torques, pictures.

The order and the moves are those of `part.insertion`.
"""

import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import reduce
from itertools import chain, groupby

import numpy as np

from ilmek.machines.manual_tools import moving_bodies, step_tools, tools_section
from ilmek.part.assemblies import machine_of
from ilmek.part.contacts import joined_by
from ilmek.part.fastenings import fastenings
from ilmek.part.insertion import Insertion
from ilmek.part.insertion_units import Box, Direction, InsertedUnit, StandingPart, is_screw, standing_parts
from ilmek.part.part import Part
from ilmek.part.part_lists import FASTENER, distinct_titles
from ilmek.part.poses import chains
from ilmek.part.projection import PieceOutline, View, outlines
from ilmek.part.stacks import StackPiece, StackRun
from ilmek.part.straight_moves import Vector
from ilmek.part.tightening import tightening_of
from ilmek.part.tree import Tree
from ilmek.part.welds import welds_of
from ilmek.records import record
from ilmek.report import Check, Column, Drawing, Paper, PaperSection, Stroke, Table, at_most
from ilmek.sentences import Sentence, joined
from ilmek.units import format_quantity, in_mm, mm

MOST_CURVES = 400
"""Most outlines of a picture: the largest; a smaller one would be a spot."""


UP = np.array([0.0, 1.0, 0.0])
"""From the floor, from below which nothing comes."""


@record
class AssemblyStep:
    """A row of the manual: what comes, of which bodies, by which moves, onto what.

    pieces  the parts that come where they stand      moves  directions by which each comes, in turn; none: it stands
    onto    bodies that it touches     built  how many come whose parts came on the bench, in the steps before; 0: parts
    stack   the order of parts that alternate along an axis      screws  how many of each hold what comes in this step
    welds   ids of the two parts that each weld joins which is made in this step, with its sizes: `a4, s8`
    """

    bodies: tuple[str, ...]
    pieces: tuple[StandingPart, ...]
    moves: tuple[tuple[Direction, ...], ...]
    onto: tuple[str, ...]
    built: int = 0
    stack: tuple[StackRun, ...] = ()
    screws: Mapping[Part, int] = field(default_factory=dict)
    welds: tuple[tuple[str, str, str], ...] = ()

    @property
    def parts(self) -> Mapping[Part, int]:
        """How many of each part come."""
        return Counter(piece.part for piece in self.pieces)

    @property
    def mass(self) -> float:
        """Mass of what comes [kg]."""
        every = (*self.parts.items(), *self.screws.items())
        return math.fsum(number * part.mass for part, number in every if not math.isnan(part.mass))

    @property
    def lifted(self) -> float:
        """Mass of what comes at once [kg]: of several that are alike each comes by itself."""
        counts = (number for part, number in self.parts.items() if part.process != FASTENER)
        return self.mass / (self.built or math.gcd(*counts) or 1)


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


def weld_check(screwed: Tree) -> Check:
    """Whether each weld of a tree burns through no wall."""
    bad = [(name, weld.other) for name, own in welds_of(screwed).items() for weld in own if weld.too_thick]
    titles = {part.id: part.title for part, _ in screwed.occurrences()}
    named = (f"{titles[name]} to {titles.get(other, 'itself')}" for name, other in bad[:3])
    source = "; ".join(named) or "DIN EN 1993-1-8/NA, NCI to 4.5.2: 0.7 of the thinner wall"
    check = at_most("assembly: welds that burn through a wall", len(bad), 0, "1", source)
    return check.with_cure("thicken the wall, or share the force by more seams", *dict(bad))


def _every(steps: Sequence[Insertion]) -> Iterator[Insertion]:
    for step in steps:
        yield step
        yield from _every(step.bench)


def _names(units: Sequence[InsertedUnit]) -> str:
    return " and ".join(dict.fromkeys(unit.pieces[0].part.title for unit in units[:3]))


def assembly_steps(steps: Sequence[Insertion]) -> Iterator[AssemblyStep]:
    """The rows of steps, those on the bench before; like parts of a body that come one after the other in one.

    Screws have no rows: they come with the second of what they join.
    """
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
    coming = (step for step in steps if not all(is_screw(unit.pieces[0].part) for unit in step.units))
    for (bodies, name, simple), some in groupby(coming, key=_alike):
        alike = tuple(some)
        onto = tuple(dict.fromkeys(unit.name for step in alike for unit in step.onto))
        moves = tuple(dict.fromkeys(tuple(map(_direction, step.moves)) for step in alike if step.moves))
        pieces = tuple(piece for step in alike for unit in step.units for piece in unit.pieces)
        if not simple:
            yield from _rows(benches.pop(name, ()), benches)
        stack = alike[0].units[0].stack if simple else ()
        yield AssemblyStep(bodies, pieces, moves, onto, 0 if simple else len(alike), stack)


def _alike(step: Insertion) -> tuple[tuple[str, ...], str, bool]:
    """What steps of one row have in common: bodies, part or group of them, and whether nothing was built before."""
    first = step.units[0]
    alone = len(step.units) == 1 and (len(first.parts) == 1 or bool(first.stack))
    bodies = tuple(dict.fromkeys(unit.name for unit in step.units))
    return bodies, first.pieces[0].part.id if alone else "+".join(bodies), alone


def _direction(move: Vector) -> Direction:
    """Direction of a move, rounded."""
    return tuple((move / np.linalg.norm(move)).round(2).tolist())


def with_screws(
    steps: Iterable[AssemblyStep], tree: Tree, joins: Mapping[str, Sequence[str]]
) -> tuple[AssemblyStep, ...]:
    """The rows with the screws of a tree: each comes with the second of the pieces that it joins.

    joins  the ids of the parts that a screw joins, by its id

    What comes built several times is screwed on the bench as often; the bench shows one of it.
    """
    rows = tuple(steps)
    pieces: dict[str, dict[bytes, tuple[Box, list[int]]]] = defaultdict(dict)
    for number, step in enumerate(rows):
        for piece in step.pieces:
            known = pieces[piece.part.id].setdefault(piece.position.origin.round(6).tobytes(), (piece.box, []))
            known[1].append(number)
    screws: dict[int, Counter[Part]] = defaultdict(Counter)
    for links in chains(tree):
        for screw in standing_parts(links):
            if is_screw(screw.part):
                names = [name for name in joins[screw.part.id] if pieces[name]]
                joined_pieces = [_nearest(screw, tuple(pieces[name].values())) for name in names]
                number = _together(joined_pieces)
                benched = any(len(own) > 1 for name in names for _, own in pieces[name].values())
                if not (rows[number].built and benched and all(number in own for own in joined_pieces)):
                    screws[number][screw.part] += 1
    return tuple(replace(step, screws=screws[number]) for number, step in enumerate(rows))


def with_welds(steps: Iterable[AssemblyStep], tree: Tree) -> Iterator[AssemblyStep]:
    """The rows with the welds of a tree, each with the second of its parts."""
    pairs, hot = dict[tuple[str, str], str](), set[tuple[str, str]]()
    for name, weld in ((name, weld) for name, own in welds_of(tree).items() for weld in own if weld.other):
        known = pairs.setdefault((name, weld.other), weld.mark)
        hot |= set() if weld.brazed else {(name, weld.other)}
        if weld.mark not in known.split(", "):
            pairs[name, weld.other] = f"{known}, {weld.mark}"
    welded, boxes = frozenset(chain(*pairs)), defaultdict[str, list[Box]](list)
    for step in steps:
        pieces = [piece for piece in step.pieces if piece.part.id in welded]
        for piece in () if step.built else pieces:
            boxes[piece.part.id].append(piece.box)
        names = {piece.part.id for piece in pieces}
        joined_now = dict.fromkeys(
            pair
            for piece in pieces
            for pair in pairs
            if piece.part.id in pair and not (step.built and names.issuperset(pair))
            for other in boxes[pair[pair[0] == piece.part.id]]
            if _touch(piece.box, other)
        )
        words = ("manual.weld" if pair in hot else "manual.braze" for pair in joined_now)
        seams = ((*pair, Sentence(key, size=pairs[pair])) for key, pair in zip(words, joined_now, strict=True))
        yield replace(step, welds=tuple(seams))


def _touch(first: Box, second: Box) -> bool:
    return bool((first[0] < second[1] + mm).all() and (second[0] < first[1] + mm).all())


def _nearest(screw: StandingPart, pieces: Sequence[tuple[Box, list[int]]]) -> list[int]:
    """The rows of the piece that is nearest to a screw, by boxes."""
    low, high = screw.box
    lows, highs = np.array([box for box, _ in pieces]).swapaxes(0, 1)
    apart = np.maximum(np.maximum(lows - high, low - highs), 0.0)
    return pieces[int(np.linalg.norm(apart, axis=1).argmin())][1]


def _together(pieces: Sequence[Sequence[int]]) -> int:
    """The row in which pieces meet that come in rows, those on a bench before that of all that was built on it."""
    shared = set(pieces[0]).intersection(*pieces[1:]) if pieces else {0}
    last = min(shared, default=math.inf)
    before = [number for own in pieces for number in own if number < last]
    return max(before, default=min(shared, default=0))


def tree_manual(tree: Tree, steps: Sequence[Insertion], view: View, screwed: Tree) -> Paper:
    """A section for the rows of each machine that follow each other, with a picture from a side and its steps.

    screwed  the tree with the screws of its fixed joints, which the steps are without
    """
    seen, standing = outlines(tree, view), set[str]()
    fasteners = frozenset(part.id for part, _ in screwed.occurrences() if part.process == FASTENER)
    titles = distinct_titles(screwed)
    joined_parts = joined_by(screwed, fasteners)
    sections = [PaperSection(Sentence("manual.order"), (Sentence("manual.order-how"),)), tools_section(screwed)]
    moving = moving_bodies(tree)
    last = (links[-1] for links in chains(tree))
    machines = {link.name: machine_of(link.body) for link in last if link.body.occurrences}
    rows_of = with_welds(with_screws(assembly_steps(steps), screwed, joined_parts), screwed)
    numbered = enumerate(rows_of, 1)
    for machine, grouped in groupby(numbered, key=lambda row: machines[row[1].bodies[0]]):
        rows = tuple(grouped)
        coming = {body for _, step in rows for body in step.bodies}
        sections.append(
            _section(
                machine,
                [_row(*row, joined_parts, titles, moving) for row in rows],
                _picture(seen, standing, coming, _CAPTIONS[view]),
            )
        )
        sections += [_stack_section(number, step) for number, step in rows if step.stack]
        standing |= coming
    return Paper("assembly-manual", Sentence("manual.title"), Sentence("manual.lead"), tuple(sections))


def _stack_section(number: int, step: AssemblyStep) -> PaperSection:
    """The order along their axis of the parts of a step: a row for each run; and how long they are together."""
    title = Sentence("manual.stack", step=str(number))
    heads = Column(Sentence("manual.times")), Column(Sentence("manual.run"))
    rows = tuple((run.times, "; ".join(map(_stacked, run.pieces))) for run in step.stack)
    lows, highs = np.array([piece.box for piece in step.pieces]).swapaxes(0, 1)
    axis = np.abs(step.pieces[0].position.rotation[:, 2])
    text = Sentence("manual.stack-how", length=in_mm(float(axis @ (highs.max(0) - lows.min(0)))))
    return PaperSection(title, (text,), Table(f"stack-{number}", title, heads, rows))


def _stacked(piece: StackPiece) -> str:
    part, angle = piece
    return f"{part.title}, {format_quantity(angle, 'deg', 3)}" if angle else part.title


def _section(machine: str, rows: Sequence[tuple[float | int | str, ...]], picture: Drawing) -> PaperSection:
    title = Sentence("manual.machine", machine=machine.replace("-", " "), first=str(rows[0][0]), last=str(rows[-1][0]))
    heads = (
        Column(Sentence("manual.step")),
        Column(Sentence("manual.body")),
        Column(Sentence("manual.onto")),
        Column(Sentence("manual.moves")),
        Column(Sentence("manual.comes")),
        Column(Sentence("manual.mass"), "kg", 3),
        Column(Sentence("manual.tighten")),
        Column(Sentence("manual.joins")),
        Column(Sentence("manual.tools")),
    )
    table = Table("steps", title, heads, tuple(rows))
    return PaperSection(title, (picture.title,), table, boxes=True, figure=picture)


def _row(
    number: int,
    step: AssemblyStep,
    joins: Mapping[str, Sequence[str]],
    titles: Mapping[str, str],
    moving: frozenset[str],
) -> tuple[float | int | str, ...]:
    parts = {} if step.built else step.parts
    fasteners = {part: parts[part] for part in parts if part.process == FASTENER} | dict(step.screws)
    fastened = [
        (_tightened(part, count), joins.get(part.id, (part.id,)))
        for part, count in {**parts, **fasteners}.items()
        if part.process == FASTENER or tightening_of(part)
    ]
    fastened += [(seam, pair) for *pair, seam in step.welds]
    fastened += [(part.fixing, (part.id,)) for part in parts if part.fixing]
    named = [f"{parts[part]} × {titles[part.id]}" for part in parts if part.process != FASTENER]
    tools = step_tools({**parts, **fasteners}, step.lifted, moving=not moving.isdisjoint(step.bodies))
    return (
        number,
        ", ".join(body.rpartition("/")[2] for body in step.bodies),
        ", ".join(one.rpartition("/")[2] for one in step.onto),
        _from(step),
        Sentence("manual.built", count=str(step.built)) if step.built else "; ".join(named),
        step.mass,
        reduce(joined, (text for text, _ in fastened), ""),
        "; ".join(", ".join(titles[name] for name in own) for _, own in fastened),
        reduce(joined, tools, ""),
    )


def _from(step: AssemblyStep) -> str:
    """From where it comes, in words."""
    words = [_in_turn([_FROM.get(move, Sentence("manual.slanting")) for move in moves]) for moves in step.moves]
    return reduce(joined, dict.fromkeys(words), "")


def _in_turn(words: Sequence[str]) -> str:
    first, *others = words
    for other in others:
        first = Sentence("manual.then-from", first=first, second=other)
    return first


def _tightened(part: Part, number: int) -> str:
    """A screw with its torque, or a key."""
    assert part.purchase is not None
    turned = tightening_of(part)
    return f"{number} × {part.purchase.row}" if turned is None else turned.text(number)


def _picture(seen: Sequence[PieceOutline], standing: set[str], coming: set[str], caption: str) -> Drawing:
    """What comes, in bold lines, and what stands about it, dashed: the largest outlines of both."""
    drawn = [own for own in seen if own.body in coming] or seen  # what comes may have no shape
    points = np.concatenate([curve for own in drawn for curve in own.curves])
    low, high = (complex(end(points.real), end(points.imag)) for end in (np.min, np.max))
    middle, half = (low + high) / 2, (high - low) * _ABOUT / 2
    near = (own for own in seen if own.body in coming or (own.body in standing and _within(own, middle, half)))
    shown = sorted(near, key=_extent, reverse=True)[:MOST_CURVES]
    strokes = [
        Stroke(curve, "outline" if own.body in coming else "construction", closed=True)
        for own in sorted(shown, key=lambda own: own.body in coming)
        for curve in own.curves
    ]
    return Drawing("assembly", caption, tuple(strokes), unit="mm")


_ABOUT = 1.5
"""Width and height of a picture over those of what comes."""


def _within(outline: PieceOutline, middle: complex, half: complex) -> bool:
    """Whether all of an outline is in a window about its middle."""
    away = np.concatenate(outline.curves) - middle
    return bool((np.abs(away.real) <= half.real).all() and (np.abs(away.imag) <= half.imag).all())


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
