"""Looks: a body or quantity has one colour and one marker in all figures of a report.

A look is a number. It gives the colour (`style.PALETTE`), the marker, and beyond the palette the dashes of a line.
Bodies come first, in the order in which they are drawn; other curves get the first look that no curve of their figures
has, and where bodies leave enough colours, the colour of none.
"""

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.errors import UnitError
from ilmek.report import (
    Animation,
    Drawing,
    Figure,
    Gantt,
    Lane,
    MovingStroke,
    Plot,
    Series,
    StackedBars,
    Stroke,
    Timing,
)
from ilmek.units import parse_unit
from ilmek.viz.style import DASHED, DOTTED, PALETTE

_ARM = np.array([3 - 1j, 3 + 1j, 1 + 1j]) / 3
_CROSS = (_ARM * np.array([[1], [1j], [-1], [-1j]])).ravel()
MARKERS: Mapping[str, ComplexArray] = {
    "disc": 0.9 * np.exp(2j * np.pi * np.arange(12) / 12),
    "square": 0.8 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]),
    "triangle": 1.1 * np.exp(2j * np.pi * np.array([0.25, 0.25 + 1 / 3, 0.25 + 2 / 3])),
    "diamond": 1.15 * np.array([1, 1j, -1, -1j]),
    "triangle down": 1.1 * np.exp(-2j * np.pi * np.array([0.25, 0.25 + 1 / 3, 0.25 + 2 / 3])),
    "bar": np.array([0.35 + 1.2j, -0.35 + 1.2j, -0.35 - 1.2j, 0.35 - 1.2j]),
    "plus": 1.1 * _CROSS,
    "cross": 1.1 * _CROSS * np.exp(0.25j * np.pi),
}
"""Shapes of markers, in the order of the palette, of a radius of about 1."""

RESERVED = 5
"""Largest number of bodies whose colours no other curve takes: of eight colours three are left."""

Item = TypeVar("Item", Series, Stroke, MovingStroke, Lane)

_QUANTITY = re.compile(r"(.*\S)\s+[+−-]?\d[\d.,]*\s?(\S+)")


def looked(figures: Iterable[Figure]) -> tuple[Figure, ...]:
    """Figures that belong together with the look of each label; one that has looks keeps them."""
    figures = tuple(figures)
    looks = looks_of(figures)
    return tuple(figure if _has_looks(figure) else _looked(figure, looks) for figure in figures)


def _has_looks(figure: Figure) -> bool:
    if isinstance(figure, Gantt | StackedBars):
        return bool(figure.looks)
    items: tuple[Series | Stroke | MovingStroke | Lane, ...]
    match figure:
        case Plot():
            items = figure.series
        case Timing():
            items = figure.lanes
        case Drawing():
            items = figure.strokes
        case Animation():
            items = (*figure.still.strokes, *figure.strokes)
    return any(item.look >= 0 for item in items)


def _looked(figure: Figure, looks: Mapping[str, int]) -> Figure:
    match figure:
        case Plot():
            numbers = numbered((one.label for one in figure.series), looks)
            return replace(figure, series=_with_looks(figure.series, numbers))
        case Timing():
            numbers = numbered((lane.name for lane in figure.lanes), looks)
            return replace(figure, lanes=_with_looks(figure.lanes, numbers))
        case Drawing():
            return replace(figure, strokes=_with_looks(figure.strokes, _coloured(figure.strokes, looks)))
        case Animation():
            still, count = figure.still, len(figure.still.strokes)
            numbers = _coloured((*still.strokes, *figure.strokes), looks)
            still = replace(still, strokes=_with_looks(still.strokes, numbers[:count]))
            return replace(figure, still=still, strokes=_with_looks(figure.strokes, numbers[count:]))
        case Gantt() | StackedBars():
            return replace(figure, looks=tuple(numbered(figure.kinds, looks)))


def _with_looks(items: Iterable[Item], numbers: Iterable[int]) -> tuple[Item, ...]:
    return tuple(replace(item, look=number) for item, number in zip(items, numbers, strict=True))


def _coloured(strokes: Iterable[Stroke | MovingStroke], looks: Mapping[str, int]) -> list[int]:
    """The look of each stroke; -1 of those whose role has a colour of its own."""
    strokes = tuple(strokes)
    order = [index for role in COLOURED for index, stroke in enumerate(strokes) if stroke.role == role]
    look = dict(zip(order, numbered([strokes[index].label for index in order], looks), strict=True))
    return [look.get(index, -1) for index in range(len(strokes))]


def looks_of(figures: Iterable[Figure]) -> dict[str, int]:
    """The look of each label of the figures; labels of the same subject share one.

    >>> from ilmek.report import Stroke
    >>> import numpy as np
    >>> bars = tuple(Stroke(np.array([0j, 1]), "link", label) for label in ("crank 60 mm", "rocker 231.6 mm"))
    >>> looks_of([Drawing("d", "", bars), Drawing("d", "", (Stroke(np.array([0j, 1]), "link", "rocker"),))])
    {'crank 60 mm': 0, 'rocker 231.6 mm': 1, 'rocker': 1}
    """
    figures = tuple(figures)
    bodies = list(dict.fromkeys(subject(label) for figure in figures for label in _bodies(figure)))
    shown = [tuple(dict.fromkeys(label for label, _ in _labels(figure) if label)) for figure in figures]
    subjects = _subjects(figures, bodies)
    numbers = {body: number for number, body in enumerate(bodies)}
    beside: dict[str, set[str]] = {}
    for labels in shown:
        together = {subjects[label] for label in labels}
        for one in together:
            beside.setdefault(one, set()).update(together)
    reserved = range(len(bodies)) if len(bodies) <= RESERVED else range(0)
    for fromkey in dict.fromkeys(subjects[label] for labels in shown for label in labels):
        used = {numbers[other] for other in beside[fromkey] if other in numbers}
        if fromkey not in numbers:
            numbers[fromkey] = next(n for n in itertools.count() if n % len(PALETTE) not in reserved and n not in used)
    return {label: numbers[of] for label, of in subjects.items()}


def subject(label: str) -> str:
    """The body or quantity that a label names: the label without a length or angle at its end.

    >>> subject("crank 59.95 mm"), subject("rod from 258.2 deg"), subject("roller CF 5"), subject("0.8 mm")
    ('crank', 'rod', 'roller CF 5', '0.8 mm')
    """
    matched = _QUANTITY.fullmatch(label)
    if matched is None or not _is_unit(matched[2]):
        return label
    return matched[1].removesuffix(" from").rstrip(",")


def _is_unit(text: str) -> bool:
    try:
        parse_unit(text)
    except UnitError:
        return False
    return True


def _subjects(figures: tuple[Figure, ...], bodies: list[str]) -> dict[str, str]:
    """The subject of each label; what stands before a comma, where that is a body: `left arm, link 2`.

    The whole label where the shorter one would give two curves of a figure the same look.
    """
    subjects: dict[str, str] = {}
    whole: set[str] = set()
    for figure in figures:
        seen: dict[tuple[str, bool], str] = {}
        for label, dashed in _labels(figure):
            head = subject(label).partition(",")[0]
            subjects[label] = head if head in bodies else subject(label)
            other = seen.setdefault((subjects[label], dashed), label)
            if isinstance(figure, Plot) and other != label:
                whole |= {label, other}
    return {label: label if label in whole and label not in bodies else of for label, of in subjects.items() if label}


def _bodies(figure: Figure) -> Iterator[str]:
    """Labels of bars and wheels."""
    if isinstance(figure, Drawing | Animation):
        yield from (stroke.label for stroke in figure.strokes if stroke.role in ("link", "wheel") and stroke.label)


def _labels(figure: Figure) -> Iterator[tuple[str, bool]]:
    """Labels of all that is drawn in colour, and whether it is dashed."""
    if isinstance(figure, Plot):
        yield from ((one.label, one.dashed) for one in figure.series)
    elif isinstance(figure, Timing):
        yield from ((lane.name, False) for lane in figure.lanes)
    elif isinstance(figure, Gantt | StackedBars):
        yield from ((name, False) for name in figure.kinds)
    else:
        still = figure.still if isinstance(figure, Animation) else figure
        roles = [(stroke.role, stroke.label) for stroke in still.strokes]
        if isinstance(figure, Animation):
            roles += [(stroke.role, stroke.label) for stroke in figure.strokes]
        yield from ((label, False) for wanted in COLOURED for role, label in roles if role == wanted)


COLOURED = ("link", "wheel", "path")
"""Roles of strokes that have the colour of their body."""


def numbered(labels: Iterable[str], looks: Mapping[str, int]) -> list[int]:
    """The look of each label of one figure; one that has none, or is empty, gets the first that is free in the figure.

    >>> numbered(["crank", "", "rocker", ""], {"crank": 1, "rocker": 0})
    [1, 2, 0, 3]
    """
    labels = list(labels)
    used = {looks[label] for label in labels if label in looks}
    found = []
    for label in labels:
        free = next(number for number in itertools.count() if number not in used)
        found.append(looks.get(label, free))
        used.add(found[-1])
    return found


def marker(number: int) -> str:
    """The marker of a look; looks of one colour have different ones.

    >>> marker(0), marker(8), marker(9)
    ('disc', 'square', 'triangle')
    """
    return tuple(MARKERS)[(number + number // len(PALETTE)) % len(MARKERS)]


def marker_shape(number: int, radius: float) -> ComplexArray:
    """The corners of the marker of a look about its middle [pt]."""
    return radius * MARKERS[marker(number)]


def dashes(number: int, *, dashed: bool = False) -> tuple[float, ...]:
    """Dash, gap, dash ... of a line [line widths]: of a dashed curve, and of looks beyond the palette."""
    rounds = number // len(PALETTE)
    if dashed:
        return DASHED[rounds % len(DASHED)]
    return DOTTED[(rounds - 1) % len(DOTTED)] if rounds else ()
