"""In which order the parts of a tree are put together, and by which straight moves each reaches its seat.

The order is that of taking apart, backwards: a unit leaves as soon as it can move straight to the outside past all that
still stands, and leaves nothing in the air; the parts of a body one after the other, or all at once. Where none can,
those leave together that hold each other: along a direction, a unit and all that it would meet, and what these would
meet [non-directional blocking graph; Wilson and Latombe 1994]. Such a group is put together on the bench by the same
rule. Where no group can either, a unit or a group leaves by up to `MOST_MOVES` moves, those before the last of the
lengths `MOVES`. What cannot leave at all is taken with what the fewest units block, and names these.
"""

from collections import defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

import numpy as np

from ilmek.arrays import Float
from ilmek.part.insertion_units import MAIN, Direction, InsertedUnit, units_of
from ilmek.part.straight_moves import FIT, Vector, meets, swept_box, through
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.units import mm

MOVES, MOST_MOVES, UNHOOKED = (20 * mm, 60 * mm, 180 * mm, 600 * mm), 3, 0.6
"""Lengths of moves before the last [m], most moves of a path, and a first move over its own size, of a fork."""

_SHORT = 20 * mm
"""Move by which it is found what holds each other [m]."""

_SIZES = (3, 8, 24)
"""Most units of a group that is put together on the bench: first small ones are tried."""

_MOST_INNER = 400
"""Most units of which the order on the bench is searched: a larger body comes as it is built elsewhere."""

_LEVEL = 0.05
"""Slope below which a direction counts as level."""


@record
class Insertion:
    """A step of putting together: what comes, by which moves, onto what.

    moves     straight ones, the last ends at the seat [m]; none: it is the first, and stands
    onto      what it then touches      blocking  what is in the way where no moves lead to the seat
    bench     the steps by which what comes was put together before
    """

    units: tuple[InsertedUnit, ...]
    moves: tuple[Vector, ...] = ()
    onto: tuple[InsertedUnit, ...] = ()
    blocking: tuple[InsertedUnit, ...] = ()
    bench: tuple["Insertion", ...] = ()


def insertions(tree: Tree, up: Vector, welded: frozenset[str] = frozenset()) -> tuple[Insertion, ...]:
    """The steps in which a tree is put together.

    up  direction from the floor, from below which nothing comes      welded  ids of bodies to which all others come
    """
    return _with_benches(_Plan(units_of(tree), up, welded))


@dataclass(frozen=True)
class _Known:
    """What a search has learned of units, as far as it goes [m]: it stays true while what it names stands.

    met       whether one that moves by a length meets another       watched  what is in the way of one to the outside
    known     what is in the way of a move from a distance           stuck    by what a search among units ended
    """

    reach: float
    met: dict[tuple[InsertedUnit, InsertedUnit, Direction, float], bool] = field(default_factory=dict)
    known: dict[tuple[InsertedUnit, Direction, Direction], InsertedUnit] = field(default_factory=dict)
    watched: dict[tuple[InsertedUnit, Direction], InsertedUnit] = field(default_factory=dict)
    stuck: dict[Hashable, frozenset[InsertedUnit]] = field(default_factory=dict)


class _Plan:
    """Taking units apart: what still stands, and what is known to be in the way of what.

    up  direction against which nothing leaves; default: all are open      welded  bodies that leave after all others
    """

    def __init__(
        self,
        units: Sequence[InsertedUnit],
        up: Vector | None = None,
        welded: frozenset[str] = frozenset(),
        learned: _Known | None = None,
    ) -> None:
        self.welded = welded
        self.units = sorted(units, key=lambda unit: unit.number)
        self.standing = set(self.units)
        self.up = np.zeros(3) if up is None else up
        self.boxes = np.stack([unit.solid.box for unit in self.units])
        self.learned = learned or _Known(float(np.linalg.norm(np.ptp(self.boxes.reshape(-1, 3), axis=0))))
        self.met, self.known = self.learned.met, self.learned.known
        self.watched, self.stuck = self.learned.watched, self.learned.stuck
        self.floor = float((self.boxes @ self.up).min())
        self.leaving: dict[InsertedUnit, list[Direction]] = {}
        self.near: dict[tuple[InsertedUnit, Direction], list[InsertedUnit]] = {}
        self.through: set[frozenset[InsertedUnit]] = set()
        self.beside: dict[InsertedUnit, set[InsertedUnit]] = {unit: set() for unit in self.units}
        self.carried = {
            own: [unit for unit in self.units if own.name in unit.carriers and not own.fastens] for own in self.units
        }
        for first, other in _near(self.boxes):
            pair = self.units[first], self.units[other]
            touch = through(pair[0].grown, pair[1].grown)
            if touch:
                self.beside[pair[0]].add(pair[1])
                self.beside[pair[1]].add(pair[0])
            if (touch and pair[0].yields != pair[1].yields) or through(pair[0].solid, pair[1].solid):
                self.through.add(frozenset(pair))

    def steps(self) -> tuple[Insertion, ...]:
        """The steps, the first first."""
        taken: list[Insertion] = []
        while len(self.standing) > 1:
            steps = self._next()
            if steps[0].blocking:
                own, near = self.standing | set(steps[0].units), (*steps[0].units, *steps[0].blocking)
                beside = (unit for unit in self.units if unit.name == steps[0].units[0].name)
                every = [unit for unit in (*near, *beside, *self.units) if unit.inner and unit in own]
                built = [unit for unit in every if unit.fastens or not self.welded or unit in near]
                if built:  # it is put together in its place
                    rest = [*(own - {built[0]}), *built[0].inner]
                    parts = _Plan(rest, self.up, self.welded, self.learned).steps()
                    return (*parts, *reversed(taken))
            taken += steps
        return (*(Insertion((unit,)) for unit in self.units if unit in self.standing), *reversed(taken))

    def _next(self) -> list[Insertion]:
        """The steps in which a body leaves, the last of the tree first; else a part of one, a group, by two moves."""
        bodies: dict[str, list[InsertedUnit]] = defaultdict(list)
        for unit in sorted(self.standing, key=lambda unit: (unit.name in self.welded and unit.is_stock, -unit.number)):
            bodies[unit.name].append(unit)
        for units in bodies.values():
            alone = len(units) == len(self.standing)
            if not alone and units[0].name not in self.welded and (steps := self._body(units)):
                return steps
        last = all(name in self.welded for name in bodies)
        leaving = [units for name, units in bodies.items() if last or name not in self.welded]
        apart = ([[unit for unit in units if unit.is_stock is own] for units in leaving] for own in (False, True))
        searches, parted = (self._single, self._group, self._by_moves), apart if last else (leaving,)
        tries = (search(units) for some in parted for search in searches for units in some)
        step = next(filter(None, tries), None) or self._held()
        self.standing -= set(step.units)
        return [step]

    def _body(self, units: list[InsertedUnit]) -> list[Insertion]:
        """The steps in which the parts of a body leave, all one after the other, or all at once; none: they cannot."""
        before, steps, left = set(self.standing), list[Insertion](), list(units)
        while left and (step := self._single(left)):
            steps.append(step)
            self.standing -= set(step.units)
            left.remove(step.units[0])
        if not left:
            return steps
        self.standing = before
        if len(units) > 1:
            for direction in dict.fromkeys(own for unit in units for own in self._directions(unit)):
                group = self._held_along(units, direction, len(units) + _SIZES[0])
                if group is not None and self._whole(group) and self._may_leave(group):
                    self.standing -= group
                    return [self._step(group, (self._far(direction),))]
        return []

    def _directions(self, unit: InsertedUnit) -> Sequence[Direction]:
        """In which a unit may leave, along its seat first, then upwards; into the floor only what stands on it."""
        if unit not in self.leaving:
            on_floor = float((unit.solid.box @ self.up).min()) < self.floor + FIT
            order = sorted(
                unit.directions, key=lambda own: (own not in unit.directions[:2], -round(self._rise(own), 2))
            )
            self.leaving[unit] = [own for own in order if on_floor or self._open(own)]
        return self.leaving[unit]

    def _open(self, direction: Direction) -> bool:
        """Whether a direction does not lead into the floor."""
        return self._rise(direction) > -_LEVEL

    def _rise(self, direction: Direction) -> float:
        return float(self.up @ np.array(direction))

    def _single(self, units: Iterable[InsertedUnit]) -> Insertion | None:
        for unit in units:
            for direction in self._directions(unit):
                if self._in_the_way(unit, direction) is None and self._may_leave({unit}):
                    return self._step({unit}, (self._far(direction),))
        return None

    def _in_the_way(self, unit: InsertedUnit, direction: Direction) -> InsertedUnit | None:
        """Something that stands in the way of a unit to the outside."""
        known = self.watched.get((unit, direction))
        if known not in self.standing:
            others = (other for other in self._before(unit, direction) if self._meets(unit, other, direction))
            known = next(others, None)
            if known is not None:
                self.watched[unit, direction] = known
        return known

    def _before(self, unit: InsertedUnit, direction: Direction) -> Iterator[InsertedUnit]:
        """What stands and may be in the way of a unit by their boxes, what touches it first."""
        key = unit, direction
        if key not in self.near:
            low, high = swept_box(unit.opened.box, self._far(direction))
            within = ((low <= self.boxes[:, 1]) & (self.boxes[:, 0] <= high)).all(1)
            others = [self.units[k] for k in np.flatnonzero(within).tolist() if self.units[k] is not unit]
            self.near[key] = sorted(others, key=lambda other: other not in self.beside[unit])
        return (other for other in self.near[key] if other in self.standing)

    def _meets(self, unit: InsertedUnit, other: InsertedUnit, direction: Direction, length: float = 0.0) -> bool:
        key = unit, other, direction, length
        if key not in self.met:
            move = length * np.array(direction) if length else self._far(direction)
            free = frozenset((unit, other)) in self.through
            self.met[key] = not free and meets(unit.opened, other.solid, move)
        return self.met[key]

    def _far(self, direction: Direction) -> Vector:
        return self.learned.reach * np.array(direction)

    def _may_leave(self, leaving: set[InsertedUnit]) -> bool:
        """Whether what touched what leaves still hangs together, and nothing stays that a body carries of which nothing
        but screws stays.
        """
        rest = self.standing - leaving
        carrying = {own.name for own in leaving for unit in self.carried[own] if unit in rest}
        if carrying and not carrying <= {unit.name for unit in rest if not unit.fastens}:
            return False
        around = {other for unit in leaving for other in self.beside[unit]} & rest
        if around:
            reached = [around.pop()]
            rest.discard(reached[0])
            while reached and around:
                near = self.beside[reached.pop()] & rest
                rest -= near
                around -= near
                reached += near
        return not around

    def _whole(self, group: set[InsertedUnit]) -> bool:
        """Whether the units of a group touch, leave no part of their bodies behind but screws, and are not the most."""
        names = {unit.name for unit in group}
        rest = self.standing - group
        whole = {unit.name for unit in self.units} == names  # the bench of one body
        left = not whole and any(unit.name in names and not unit.fastens for unit in rest)
        least = bool(self.welded) or sum(len(unit.pieces) for unit in group) <= sum(len(unit.pieces) for unit in rest)
        return least and not left and _groups(group, self.beside) == 1

    def _group(self, units: Sequence[InsertedUnit]) -> Insertion | None:
        """Of some units one leaves together with those that hold it, a small group first."""
        for most in _SIZES:
            for unit in units:
                for direction in self._directions(unit):
                    group = self._held_along([unit], direction, most)
                    if group is not None and self._whole(group) and self._may_leave(group):
                        return self._step(group, (self._far(direction),))
        return None

    def _held_along(
        self, units: Sequence[InsertedUnit], direction: Direction, most: int, length: float = 0.0
    ) -> set[InsertedUnit] | None:
        """Some units and all that must move along with them in a direction; None: more than a number, or everything, or
        what is welded and stays.

        length  of the move [m]; default: to the outside
        """
        key = tuple(units), direction, most, length
        if self._still_stuck(key):
            return None
        group, rest = set(units), list(units)
        while rest:
            unit = rest.pop()
            along = (own for own in self._before(unit, direction) if self._meets(unit, own, direction, length))
            for other in chain((own for own in self.carried[unit] if own in self.standing), along):
                if other not in group:
                    stays = other.name in self.welded and units[0].name not in self.welded
                    if stays or len(group) >= min(most, len(self.standing) - 1):
                        self.stuck[key] = frozenset((*group, other))
                        return None
                    group.add(other)
                    rest.append(other)
        return group

    def _still_stuck(self, key: Hashable) -> bool:
        """Whether all still stand by which something was found not to move: as less stands, it moves no worse."""
        return key in self.stuck and self.stuck[key] <= self.standing

    def _by_moves(self, units: Sequence[InsertedUnit]) -> Insertion | None:
        """Of some units one leaves, alone or with those that hold it, by several moves."""
        tried: set[frozenset[InsertedUnit]] = set()
        for unit in units:
            held = (self._held_along([unit], along, _SIZES[1], _SHORT) for along in unit.directions)
            groups = (own for own in held if own is not None and len(own) > 1 and self._whole(own))
            for group in chain(({unit},), groups):
                key = frozenset(group)
                if key not in tried and not self._still_stuck(key) and self._may_leave(group):
                    tried.add(key)
                    if moves := self._path(group, unit):
                        return self._step(group, moves)
        return None

    def _path(self, group: set[InsertedUnit], unit: InsertedUnit) -> tuple[Vector, ...]:
        """Moves by which a group of which a unit is one comes to the outside: the fewest, `MOST_MOVES` at most."""
        ends, met = list[tuple[Vector, ...]]([()]), set[InsertedUnit](group)
        size = np.ptp(unit.solid.box, axis=0)
        for _ in range(MOST_MOVES - 1):
            longer: list[tuple[Vector, ...]] = []
            for moves in ends:
                last = moves[-1] if moves else np.zeros(3)
                for direction in MAIN if moves else unit.directions:
                    along = np.array(direction)
                    if abs(along @ last) > FIT:
                        continue
                    longer += [
                        (*moves, length * along)
                        for length in (MOVES if moves else (*unit.first_moves, *MOVES, UNHOOKED * (size @ abs(along))))
                        if self._clear(group, length * along, sum(moves, np.zeros(3)), met)
                    ]
            for moves in longer:
                for direction in filter(self._open, MAIN):
                    if self._clear(group, self._far(direction), sum(moves, np.zeros(3)), met):
                        return (*moves, self._far(direction))
            ends = longer
        self.stuck[frozenset(group)] = frozenset(met)
        return ()

    def _clear(self, group: set[InsertedUnit], move: Vector, start: Vector, met: set[InsertedUnit]) -> bool:
        """Whether a group, moved from a distance to its seat [m], meets nothing; what it meets joins `met`."""
        for unit in group:
            key = unit, tuple(move.tolist()), tuple(start.tolist())
            known = self.known.get(key)
            if known in self.standing and known not in group:
                met.add(known)
                return False
            low, high = swept_box(unit.opened.box + start, move)
            within = ((low <= self.boxes[:, 1]) & (self.boxes[:, 0] <= high)).all(1)
            others = {self.units[k] for k in np.flatnonzero(within).tolist()} & self.standing - group
            for other in sorted(others, key=lambda own: own not in met):  # what was in the way, often is again
                if frozenset((unit, other)) not in self.through and meets(unit.opened, other.solid, move, start):
                    self.known[key] = other
                    met.add(other)
                    return False
        return True

    def _held(self) -> Insertion:
        """Of what nothing leads to the outside, what the fewest stand in the way of."""
        blocked = (
            ([other for other in self._before(unit, along) if self._meets(unit, other, along)], unit, along)
            for unit in self.units
            if unit in self.standing and unit.name not in self.welded
            for along in self._directions(unit)
        )
        blocking, unit, along = min(blocked, key=lambda own: len(own[0]))
        return replace(self._step({unit}, (self._far(along),)), blocking=tuple(blocking))

    def _step(self, leaving: set[InsertedUnit], moves: Sequence[Vector]) -> Insertion:
        units = tuple(sorted(leaving, key=lambda unit: unit.number))
        touched = {other for unit in units for other in self.beside[unit]} & (self.standing - leaving)
        onto = tuple(sorted(touched, key=lambda unit: unit.number))
        return Insertion(units, tuple(0.0 - move for move in reversed(moves)), onto)


def _with_benches(plan: _Plan) -> tuple[Insertion, ...]:
    """The steps of a plan with those on the bench, which has no floor: what is in whose way holds there too."""
    steps = plan.steps()
    learned = replace(plan.learned, stuck={})
    return tuple(replace(step, bench=_bench(step.units, learned)) for step in steps)


def _bench(units: tuple[InsertedUnit, ...], learned: _Known) -> tuple[Insertion, ...]:
    """The steps by which some units are put together before they come."""
    if len(units) > 1 and len({unit.name for unit in units}) > 1:
        return _with_benches(_Plan(units, learned=learned))
    inner = tuple(own for unit in units for own in (not unit.fastens and unit.inner) or (unit,))
    return _with_benches(_Plan(inner, learned=learned)) if 1 < len(inner) <= _MOST_INNER else ()


def _near(boxes: Float[np.ndarray, "units 2 3"]) -> Iterator[tuple[int, int]]:
    """Numbers of each two units whose boxes are nearer than four fits."""
    for number in range(1, len(boxes)):
        apart = np.maximum(boxes[:number, 0] - boxes[number, 1], boxes[number, 0] - boxes[:number, 1]).max(1)
        yield from ((int(other), number) for other in np.flatnonzero(apart < 4 * FIT))


def _groups(units: Iterable[InsertedUnit], beside: Mapping[InsertedUnit, set[InsertedUnit]]) -> int:
    """Number of groups of units that touch."""
    left, number = set(units), 0
    while left:
        number += 1
        reached = [left.pop()]
        while reached:
            near = beside[reached.pop()] & left
            left -= near
            reached += near
    return number
